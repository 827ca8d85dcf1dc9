"""The worst of many runs, and means over seeds, of the study conservation."""
from collections.abc import Iterator
from typing import Any

import numpy as np
import pandas as pd

from studies.conservation.tables import FRAME, WAVE
from studies.kit.stats import combine
from studies.kit.table import Tables

SUMS = ("mass", "momentum", "energy", "volume")
GROUP = ["scheme", "mode", "d", "wall", "maker"]
#: by which runs differ
FACTORS = ("mode", "weight", "maker", "points", "wall", "d", "zeta")
RR98 = SUMS[:3]     # volumes are exchanged by the conservative scheme only


def derive(tables: Tables) -> dict[str, list[dict[str, Any]]]:
    """Derived rows of the study."""
    found: dict[str, list[dict[str, Any]]] = {}
    if "drift" in tables:
        found["kept"] = list(kept(tables["drift"]))
        found["factors"] = list(factors(tables["drift"]))
        found["lost"] = list(lost(tables["drift"]))
    if "frames" in tables:
        found["frame_means"] = list(means(tables["frames"], FRAME, RR98))
    if "sound" in tables:
        found["sound_means"] = list(means(tables["sound"], WAVE, ("growth", "ln_energy")))
    return found


def kept(rows: pd.DataFrame) -> Iterator[dict[str, Any]]:
    """Largest changes of each sum in the runs that reached the end."""
    for key, group in rows.groupby(GROUP):
        whole = finished(group)
        yield {**dict(zip(GROUP, key, strict=True)), "runs": len(group), "finished": len(whole),
               **{name: whole[name].max() if len(whole) else np.nan for name in SUMS}, "err": group["err"].max()}


def claimed(rows: pd.DataFrame, name: str) -> pd.Series:
    """Changes of a sum, nothing where it is not claimed."""
    return rows[name].where(np.array([name in text.split() for text in rows["claimed"]], bool))


def factors(rows: pd.DataFrame) -> Iterator[dict[str, Any]]:
    """Each value of each factor; modes of different schemes are told apart."""
    rows = rows.assign(mode=rows["scheme"] + " " + rows["mode"], wall=rows["scheme"] + " " + rows["wall"])
    for factor in FACTORS:
        for value, group in rows.groupby(factor):
            whole, stopped = finished(group), group[group["reached"] < group["steps"]]
            yield {"factor": factor, "value": str(value), "runs": len(group), "finished": len(whole),
                   **{name: claimed(whole, name).max() for name in RR98},
                   "stopped": np.fmax.reduce([claimed(stopped, name).max() for name in RR98])}


def lost(rows: pd.DataFrame) -> Iterator[dict[str, Any]]:
    """Sums that are not claimed."""
    for key, group in rows.groupby(["scheme", "mode", "wall"]):
        for name in RR98:
            change = group[name].where(claimed(group, name).isna()).dropna()
            if len(change):
                yield {**dict(zip(("scheme", "mode", "wall"), key, strict=True)), "sum": name, "runs": len(change),
                       "least": change.min(), "most": change.max()}


def finished(rows: pd.DataFrame) -> pd.DataFrame:
    """Runs that reached the end."""
    return rows[rows["reached"] == rows["steps"]]


def means(rows: pd.DataFrame, key: list[str], columns: tuple[str, ...]) -> Iterator[dict[str, Any]]:
    """Over point sets."""
    for name, group in rows.groupby(key):
        found = {column: combine([(value, 0.0) for value in group[column]]) for column in columns}
        yield {**dict(zip(key, name, strict=True)), "seeds": len(group), **{c: found[c].value for c in columns},
               **{f"{c}_err": found[c].err for c in columns}}
