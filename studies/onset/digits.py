"""How many figures of a critical Rayleigh number each way gives."""
from collections.abc import Iterator
from typing import Any

import numpy as np
import pandas as pd

from studies.onset.growth import BOX_NAMES
from studies.onset.tables import POINT

SERIES = POINT[:-1]
WAY = [*SERIES, "way", "reach", "ke_start"]
SCENE = ["eos", "transport", "dT", "sides"]


def figures_given(critical: pd.DataFrame) -> Iterator[dict[str, Any]]:
    """Correct figures of each way and scene: on its finest grid, and extrapolated.

    The reference of Boussinesq rows is linear theory, that of the gas the extrapolated growth rates of KHP95's grid: of
    those themselves their err decides.
    """
    for key, grids in critical[critical["method"] != "linear"].groupby(WAY, dropna=False):
        at = dict(zip(WAY, key))
        reference = reference_of(at, critical)
        if reference is None or (at["eos"] and not at["dT"]):
            continue
        finite = grids.loc[np.isfinite(grids["resolution"]), "resolution"]
        for _, row in grids[np.isinf(grids["resolution"]) | (grids["resolution"] == finite.max())].iterrows():
            off = abs(row["value"] - reference) or row["err"]
            yield {**{name: row[name] for name in SERIES}, "way": in_words(row), "value": row["value"], "err": row["err"],
                   "reference": reference, "figures": float(-np.log10(off/reference))}


def reference_of(at: dict[str, Any], critical: pd.DataFrame) -> float | None:
    """Ra_c of the scene, None if the table lacks it."""
    if not at["eos"]:
        there = (critical["method"] == "linear") & (critical["quantity"] == BOX_NAMES[at["sides"]])
    else:
        there = (critical["method"] == "compressible") & (critical["way"] == "operator") & np.isinf(critical["resolution"])
        there &= (critical[SCENE] == [at[name] for name in SCENE]).all(axis=1)
    return float(critical.loc[there, "value"].iloc[0]) if there.any() else None


def in_words(row: pd.Series) -> str:
    """How the number was found."""
    grid = "extrapolated" if np.isinf(row["resolution"]) else f"{row['resolution']:.0f} rows"
    if row["way"] == "line" and np.isinf(row["resolution"]):
        grid = "lines extrapolated" if "L^-2" in row["quantity"] else "points extrapolated"
    what = {"operator": "growth rates", "line": f"K line to {row['reach']:.3g} Ra_c",
            "run": f"runs from K = {row['ke_start']:g}"}[row["way"]]
    return f"{what}, {grid}"
