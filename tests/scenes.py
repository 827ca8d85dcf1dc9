"""Small scenes that tests share."""
import numpy as np

from continuum.scene import RayleighBenard
from particles.smooth.spam import Spam
from studies.build.spam import PRINTED, Variant, method, start

ROWS = 8


def small(variant: Variant = PRINTED, ra: float = 5000.0, rows: int = ROWS, **scene) -> tuple[Spam,
                                                                                              np.ndarray]:
    """The printed method and its start on 2 rows^2 particles."""
    where = RayleighBenard(ra=ra, L=float(rows), **scene)
    return method(where, variant), start(where, 1)


def rows_of(case, table: str) -> list[dict]:
    """Rows of a case that is run here."""
    return case.run(lambda done: None, None).rows[table]
