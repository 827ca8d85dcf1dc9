"""Means over seeds, and slopes of errors over h/lambda."""
from collections.abc import Iterator
from typing import Any

import numpy as np
import pandas as pd
from scipy.special import stdtrit

from studies.kit.stats import combine
from studies.kit.table import Tables
from studies.ordering.tables import POINT

OPERATORS = ("gradient", "laplacian")
LEAST = 4       # points of a slope


def derive(tables: Tables) -> dict[str, list[dict[str, Any]]]:
    """Derived rows of the study."""
    if "operators" not in tables:
        return {}
    rows = tables["operators"]
    means = list(over_seeds(rows[rows["gradient"].notna()]))
    return {"means": means, "slopes": list(slopes(pd.DataFrame(means)))}


def over_seeds(rows: pd.DataFrame) -> Iterator[dict[str, Any]]:
    """One row a point of the surface; errors from the scatter between point sets."""
    for key, group in rows.groupby(POINT):
        found = {name: combine([(value, 0.0) for value in group[name]]) for name in OPERATORS}
        yield {**dict(zip(POINT, key, strict=True)), "seeds": len(group), "a_over_h": group["a_over_h"].iloc[0],
               "h_over_lambda": group["h_over_lambda"].iloc[0],
               **{name: found[name].value for name in OPERATORS}, **{f"{name}_err": found[name].err for name in OPERATORS}}


def slopes(means: pd.DataFrame) -> Iterator[dict[str, Any]]:
    """At fixed h/a over the wavelengths, and at a fixed wavelength over h (ranges of 2 spacings and more)."""
    for fixed, by, x in (("h/a", "h", "h_over_lambda"), ("a", "wavelength", "h_over_lambda")):
        for key, group in means.groupby(["maker", "weight", "points", by]):
            group = group[group["h"] >= 2.0] if fixed == "a" else group
            for operator in OPERATORS if len(group) >= LEAST else ():
                slope, err = line(np.log(group[x].to_numpy()), np.log(group[operator].to_numpy()))
                yield {**dict(zip(("maker", "weight", "points", "at"), key, strict=True)), "fixed": fixed, "operator": operator,
                       "slope": slope, "slope_err": err, "floor": group[operator].min()}


def line(x: np.ndarray, y: np.ndarray) -> tuple[float, float]:
    """Slope of least squares and its 95 % interval from the scatter about the line."""
    (slope, constant), n = np.polyfit(x, y, 1), len(x)
    rest = np.sum((y - slope*x - constant)**2)/(n - 2)
    return float(slope), float(stdtrit(n - 2, 0.975)*np.sqrt(rest/np.sum((x - x.mean())**2)))
