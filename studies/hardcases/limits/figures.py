"""Limits of the time step: measured over predicted."""
from typing import Any

import numpy as np
import pandas as pd
from matplotlib.figure import Figure

from studies.hardcases.limits.cases import EULER_SCENES, ROLLS, SCENES
from studies.kit.figure import figure, look
from studies.kit.table import Tables

CLEAR = 0.2             # between scenes of one method, in rows
ROLL = "roll, Ra 1e4, 1e5"
INTEGRATORS = "at rest, five integrators"      # of dissipative particles


def figures(tables: Tables) -> dict[str, Figure]:
    """One: all methods."""
    rows = tables.get("limits")
    if rows is None or rows.empty:
        return {}
    rows = rows[rows["predicted"] > 0]
    alone = tables.get("shorter", pd.DataFrame(columns=["method", "scene", "shorter"]))[["method", "scene", "shorter"]]
    rows = rows.merge(alone, on=["method", "scene"], how="left")
    rows["scene"] = rows["scene"].where(~rows["method"].str.startswith("DPD"), INTEGRATORS)
    page, (axes, single, exact) = figure(1, 3, width=3.9, height=5.0, sharey=True)
    methods = list(dict.fromkeys(rows["method"]))
    rows = rows.assign(scene=rows["scene"].replace({f"Ra {ra:g}": ROLL for ra in ROLLS}))
    place = rows.groupby("method").cumcount() - (rows.groupby("method")["scene"].transform("size") - 1)/2
    rows = rows.assign(at=[methods.index(method) for method in rows["method"]] + CLEAR*place)
    for number, scene in enumerate([*{**SCENES, **EULER_SCENES}, ROLL, INTEGRATORS]):
        some = rows[rows["scene"] == scene]
        if some.empty:
            continue
        for axis, formula in ((axes, some["predicted"]), (single, some["shorter"]), (exact, some["exact"])):
            axis.errorbar(some["measured"]/formula, some["at"], xerr=some["measured_err"]/formula, label=scene,
                          **style(number, scene))
    axes.set(yticks=range(len(methods)), yticklabels=methods, xscale="log", xlabel="measured / the method's own formula")
    axes.set_xticks([0.7, 1, 1.4, 2, 3, 5], labels=["0.7", "1", "1.4", "2", "3", "5"])
    axes.set_xticks([], minor=True)
    single.set(xlabel="measured / for sound or diffusion alone", xlim=(0.85, 1.48))
    exact.set(xlabel="measured / by eigenvalues", xlim=(0.94, max(1.12, farthest(rows) + 0.01)))
    for axis in (axes, single, exact):
        axis.axvline(1, color="black", linewidth=0.8)
        axis.axvspan(0.9, 1.1, color="0.9", zorder=0)
    axes.invert_yaxis()
    page.legend(*axes.get_legend_handles_labels(), loc="outside lower center", ncols=4)
    page.suptitle("At which step does noise begin to grow? Measured over predicted\nbars: half of the last interval of the "
                  "search, and growth that is too slow to be seen; grey: 10 %", fontsize=10)
    return {"limits": page}


def farthest(rows: pd.DataFrame) -> float:
    """Where the last bar of the limits over those by eigenvalues ends."""
    return float(((rows["measured"] + rows["measured_err"])/rows["exact"]).replace(np.inf, np.nan).max())


def style(number: int, scene: str) -> dict[str, Any]:
    """Look of a scene; that of dissipative particles, a ninth, is hollow."""
    return {**look(number), "linestyle": "none"} | ({"markerfacecolor": "white"} if scene == INTEGRATORS else {})
