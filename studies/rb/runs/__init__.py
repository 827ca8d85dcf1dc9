"""What the cases of the study compute."""
from typing import Any

import pandas as pd

from studies.build.names import scene_columns
from studies.kit.timing import SPREAD_TO_ERR, Seconds


def table_rows(key: dict[str, Any], **columns: Any) -> list[dict[str, Any]]:
    """Rows of a table that have one key, from columns of the same length."""
    frame = pd.DataFrame(columns)
    values = frame.itertuples(index=False, name=None)
    return [{**key, **dict(zip(columns, row, strict=True))} for row in values]


def of_step(scene: Any, points: int, dt: float, seconds: Seconds, steps: int) -> dict:
    """Columns of the table `cost`: seconds of one step, measured while no other case runs."""
    where = scene_columns(scene)
    return {"eos": where["eos"], "sides": where["sides"], "points": points, "step_s": seconds.median/steps,
            "step_s_err": seconds.spread*SPREAD_TO_ERR/steps, "dt": dt, "threads": 1}
