"""Drags extrapolated to infinitely fine points, and orders of errors."""
from collections.abc import Iterator
from typing import Any

import numpy as np
import pandas as pd
from scipy.special import stdtrit

from studies.kit.stats import Measured, combine
from studies.kit.table import Tables
from studies.ordering.derive import line

ERRORS = (("turning wave", "wave", "error"), ("turning cylinder", "torque", "turned"))
LEAST = 3           # sizes of a limit
WIDE = 4.0          # spacings: of a smaller radius the circle is too coarse a polygon for an order to show
SLOW = 1e-3         # Mach number of the streams whose drags are compared with print
ORDERS = {"surface": 2, "surface-unfiltered": 2}        # of the drag's error in the spacing; of a staircase 1


def derive(tables: Tables) -> dict[str, list[dict[str, Any]]]:
    """Derived rows of the study."""
    rows: dict[str, list[dict[str, Any]]] = {}
    if "drag" in tables:
        rows["drag_limits"] = list(limits(tables["drag"]))
    rows["body_orders"] = [order(what, fine(tables[name]), column) for what, name, column in ERRORS
                      if name in tables and len(fine(tables[name])) >= LEAST]
    return {name: found for name, found in rows.items() if found or name == "drag_limits"}


def fine(frame: pd.DataFrame) -> pd.DataFrame:
    """Rows whose circle, if there is one, is no coarse polygon."""
    return frame[frame["radius"] > WIDE] if "radius" in frame else frame


def limits(drags: pd.DataFrame) -> Iterator[dict[str, Any]]:
    """One row a variant and solid fraction."""
    chosen = fine(drags[drags["mach"] < SLOW])
    for (variant, fraction), group in chosen.groupby(["variant", "fraction"]):
        if len(group) < LEAST:
            continue
        drag, rows = group["drag"].to_numpy(), group["rows"].to_numpy(float)
        print_, print_err = group["published"].iloc[0], group["published_err"].iloc[0]
        found = intercept(rows**-ORDERS.get(str(variant), 1), drag)
        err = float(np.hypot(found.err, group["drag_err"].max()))       # what was not steady yet adds to it
        slope = line(np.log(rows), np.log(np.abs(group["error"])))
        known = group["offset"].notna().all()
        offset = combine([(value, 0.0) for value in group["offset"]]) if known else Measured(np.nan, np.nan)
        yield {"variant": variant, "fraction": fraction, "sizes": len(group), "limit": found.value, "limit_err": err,
               "error": found.value/print_ - 1,
               "error_err": float(np.hypot(err, found.value/print_*print_err)/print_),
               "slope": slope[0], "slope_err": slope[1], "offset": offset.value, "offset_err": offset.err}


def intercept(x: np.ndarray, y: np.ndarray) -> Measured:
    """Value at x = 0 of a line by least squares, its 95 % interval from the scatter about the line."""
    n = len(x)
    slope, constant = np.polyfit(x, y, 1)
    rest = np.sum((y - slope*x - constant)**2)/(n - 2)
    err = stdtrit(n - 2, 0.975)*np.sqrt(rest*(1/n + x.mean()**2/np.sum((x - x.mean())**2)))
    return Measured(float(constant), float(err))


def order(what: str, frame: pd.DataFrame, column: str) -> dict[str, Any]:
    """Order of an error in the spacing."""
    slope, err = line(np.log(frame["rows"].to_numpy(float)), np.log(frame[column].abs().to_numpy()))
    return {"what": what, "sizes": len(frame), "order": -slope, "order_err": err}
