"""Orders of errors over the spacing, limits, and means over seeds."""
from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np
import pandas as pd

from studies.kit.stats import Measured, combine
from studies.kit.table import Tables
from studies.ordering.derive import line

LEAST = 3       # sizes of an order


def derive(tables: Tables) -> dict[str, list[dict[str, Any]]]:
    """Derived rows of the study."""
    found: dict[str, list[dict[str, Any]]] = {}
    if "equations" in tables:
        found["orders"] = list(orders(tables["equations"]))
    if "stream" in tables:
        found["stream_means"] = list(means(tables["stream"], ["points", "inner"], ("force", "heat", "asymmetry", "growth")))
    if "distances" in tables:
        found["distance_means"] = list(means(tables["distances"], ["points", "length"], ("off_lattice", "uneven")))
    if "growth" in tables:
        rows = tables["growth"]
        rows = rows[rows["rate"].notna()]
        key = ["maker", "points", "d", "viscosity"]
        worst = rows.groupby(key)["rate"].max()
        found["growth_means"] = [{**row, "largest": float(worst[tuple(row[name] for name in key)])}
                                 for row in means(rows, key, ("rate", "closure"))]
    return found


def orders(rows: pd.DataFrame) -> Iterator[dict[str, Any]]:
    """One row a term: the slope of its error, and its projection in the limit of no spacing."""
    for key, group in rows.groupby(["d", "weight", "h", "operator"]):
        group = group.sort_values("cells")
        if len(group) >= LEAST:
            a = 1/group["cells"].to_numpy()
            order, err = line(np.log(a), np.log(group["error"].to_numpy()))
            limit = extrapolated(a, group["ratio"].to_numpy())
            yield {**dict(zip(("d", "weight", "h", "operator"), key, strict=True)), "order": order, "order_err": err,
                   "ratio": limit.value, "ratio_err": limit.err, "finest": float(group["error"].iloc[-1])}


def extrapolated(a: np.ndarray, values: np.ndarray) -> Measured:
    """Limit of values = limit + C a^2 from the two finest of three; the error is the distance from that of the two coarser."""
    coarse, fine = ((a[n]**2*values[n + 1] - a[n + 1]**2*values[n])/(a[n]**2 - a[n + 1]**2) for n in (-3, -2))
    return Measured(float(fine), float(abs(fine - coarse)))


def means(rows: pd.DataFrame, key: Sequence[str], columns: Sequence[str]) -> Iterator[dict[str, Any]]:
    """Means over seeds with their errors."""
    for which, group in rows.groupby(list(key)):
        found = {name: combine([(value, 0.0) for value in group[name]]) for name in columns}
        yield {**dict(zip(key, which, strict=True)), "seeds": len(group), **{name: m.value for name, m in found.items()},
               **{f"{name}_err": m.err for name, m in found.items()}}
