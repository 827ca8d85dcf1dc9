"""How claims of this study read its tables."""
import numpy as np

from studies.build.read import Value, select
from studies.kit.claim import CannotTell
from studies.kit.stats import Measured
from studies.kit.table import Tables


def column(table: str, name: str, err: str = "", **where) -> Value:
    """One number of one row."""
    def value(tables: Tables) -> Measured:
        row = select(tables, table, **where).iloc[0]
        if np.isnan(row[name]):
            raise CannotTell(f"table {table} has no {name} where {where}")
        return Measured(float(row[name]), float(row[err]) if err else 0.0)
    return value
