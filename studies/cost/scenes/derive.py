"""What leaving out saves and costs, from the table `measured`."""
from collections.abc import Iterator
from typing import Any

import numpy as np
import pandas as pd

from studies.build.read import ratio
from studies.kit.stats import Measured
from studies.kit.table import Tables
from studies.rb.looks import groups

COST = ("step_s", "step_s_err", "time_s", "time_s_err")
NOT_TOLD = Measured(np.nan, np.nan)     # times that scatter as much as they last, on a busy machine
MATTERS = 0.01      # of the answer: the error at which methods are compared


def derive(tables: Tables) -> dict[str, list[dict[str, Any]]]:
    """Ratios to the whole of each base."""
    frame: pd.DataFrame = tables.get("measured", pd.DataFrame())
    return {"scenes": list(scenes(frame))} if len(frame) else {}


def scenes(frame: pd.DataFrame) -> Iterator[dict[str, Any]]:
    """One row a variant; a base whose whole is not there has none."""
    for _, group in groups(frame, ["scene", "base"]):
        whole = group[group["left_out"] == "nothing"].to_dict("records")
        for row in group.to_dict("records") if whole else ():
            yield {**{str(name): value for name, value in row.items()
                      if name in ("scene", "base", "left_out", "quantity", "step_s", "step_s_err", "bytes", "loops", "error",
                               "changed")},
                   **compared(row, whole[0])}


def compared(row: dict, whole: dict) -> dict[str, Any]:
    """Ratios, and whether what is changed matters; a run that diverges does, and what it took to do so is no cost."""
    found: dict[str, Any] = {}
    if np.isnan(row["changed"]):
        row = {**row, **dict.fromkeys(COST, np.nan)}
        found = {name: np.nan for name in COST if name in ("step_s", "step_s_err")}
    for name in ("step", "time"):
        one, all_ = (Measured(of[f"{name}_s"], of[f"{name}_s_err"]) for of in (row, whole))
        found[f"{name}_ratio"], found[f"{name}_ratio_err"] = ratio(one, all_) if abs(all_.value) > all_.err else NOT_TOLD
    return {**found, "bytes_ratio": row["bytes"]/whole["bytes"], "needed": "no" if row["changed"] <= MATTERS else "yes"}
