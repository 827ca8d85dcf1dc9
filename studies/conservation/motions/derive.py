"""The step at which sound neither grows nor decays, and orders in dt."""
from collections.abc import Iterator
from typing import Any

import numpy as np
import pandas as pd

from studies.kit.table import Tables

RUN = ["motion", "flow"]


def derive(tables: Tables) -> dict[str, list[dict[str, Any]]]:
    """Derived rows of the study."""
    found = {}
    if "euler" in tables:
        found["euler_limits"] = list(limits(tables["euler"]))
    if "steps" in tables:
        found["motion_orders"] = list(orders(tables["steps"]))
    return found


def limits(euler: pd.DataFrame) -> Iterator[dict[str, Any]]:
    """Zero of the parabola through growth at 1/2, 1 and 3/2 times the predicted limit."""
    for (transport, wavelength), group in euler.groupby(["transport", "wavelength"]):
        if len(group) >= 3:
            parabola = np.polyfit(group["dt_over_limit"], group["growth"], 2)
            roots = np.roots(parabola)
            at = float(roots[np.argmin(abs(roots - 1))].real)
            slope = float(np.polyval(np.polyder(parabola), at))
            yield {"transport": transport, "wavelength": wavelength, "limit": at, "limit_err": group["growth_err"].max()/slope}


def orders(steps: pd.DataFrame) -> Iterator[dict[str, Any]]:
    """Of errors that were halved steps apart; and errors at the most steps over those of forward Euler."""
    for key, group in steps.groupby(RUN):
        finest = group[group["steps"] == group["steps"].max()].set_index("integrator")
        euler = finest.loc["euler"]
        for name, runs in group.groupby("integrator"):
            (e2, s2), (e1, s1) = runs.sort_values("steps")[["error", "error_err"]].to_numpy()[-2:]
            over = e1/euler["error"]
            yield {**dict(zip(RUN, key, strict=True)), "integrator": name, "order": np.log2(e2/e1),
                   "order_err": (s1/e1 + s2/e2)/np.log(2), "over_euler": over,
                   "over_euler_err": 0.0 if name == "euler" else over*(s1/e1 + euler["error_err"]/euler["error"])}
