"""The worst of many runs, and means over seeds, of the study conservation."""
from collections.abc import Iterator
from typing import Any

import numpy as np
import pandas as pd

from studies.integral.conservation_tables import FRAME, WAVE
from studies.kit.stats import combine
from studies.kit.table import Tables

SUMS = ("mass", "momentum", "energy", "volume")
GROUP = ["scheme", "mode", "d", "wall", "maker"]


def derive(tables: Tables) -> dict[str, list[dict[str, Any]]]:
    """Derived rows of the study."""
    found: dict[str, list[dict[str, Any]]] = {}
    if "drift" in tables:
        found["kept"] = list(kept(tables["drift"]))
    if "frames" in tables:
        found["frame_means"] = list(means(tables["frames"], FRAME, SUMS[:3]))
    if "sound" in tables:
        found["sound_means"] = list(means(tables["sound"], WAVE, ("growth", "ln_energy")))
    return found


def kept(rows: pd.DataFrame) -> Iterator[dict[str, Any]]:
    """Largest changes of each sum in the runs that reached the end."""
    for key, group in rows.groupby(GROUP):
        whole = finished(group)
        yield {**dict(zip(GROUP, key, strict=True)), "runs": len(group), "finished": len(whole),
               **{name: whole[name].max() if len(whole) else np.nan for name in SUMS}, "err": group["err"].max()}


def finished(rows: pd.DataFrame) -> pd.DataFrame:
    """Runs that reached the end."""
    return rows[rows["reached"] == rows["steps"]]


def means(rows: pd.DataFrame, key: list[str], columns: tuple[str, ...]) -> Iterator[dict[str, Any]]:
    """Over point sets."""
    for name, group in rows.groupby(key):
        found = {column: combine([(value, 0.0) for value in group[column]]) for column in columns}
        yield {**dict(zip(key, name, strict=True)), "seeds": len(group), **{c: found[c].value for c in columns},
               **{f"{c}_err": found[c].err for c in columns}}
