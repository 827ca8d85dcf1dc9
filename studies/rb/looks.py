"""Rows that figures show, picked from tables that may lack any of them, and how each kind of row looks."""
from typing import Any

import numpy as np
import pandas as pd
from matplotlib.axes import Axes

from studies.kit.figure import look
from studies.kit.table import Tables
from studies.rb.tables import POINT, rows

#: KHP95's ideal gas in the layer of Fig. 5
LAYER = {"eos": "ideal", "transport": "const-eta", "sides": "periodic", "pr": 1}
GRID = {"method": "compressible", "variant": "flux-form"}
SPAM = {"method": "spam", "variant": "printed"}
#: Rayleigh numbers that have a panel
RA_SHOWN = (5000, 10000)
KHP95_PARTICLES = 5000

#: the same kind of row looks the same in every figure
KIND: dict[str, dict[str, Any]] = {
    "grid": {**look(0), "color": "black"}, "kp": look(1), "kg": {**look(2), "color": "#0072B2"},
    "nu": {**look(3), "linestyle": "-."},
    "khp": {"color": "black", "linestyle": "none", "markerfacecolor": "none", "markersize": 9,
            "markeredgewidth": 1.4, "zorder": 5}}
OPEN = {"markerfacecolor": "white"}
MARKS = {"linestyle": "none"}
#: kind -> column of `means`, words
ENERGIES = {"kp": ("ke", "$K_p$, all particles"), "kg": ("ke_field", "$K_g$, smoothed field")}
NOT_STEADY = "not steady: halves of the mean differ"


def reference(tables: Tables, **scene: Any) -> pd.DataFrame:
    """The compressible grid, extrapolated, by Ra."""
    return rows(tables, "means", **GRID, **scene, resolution=np.inf).sort_values("ra")


def errors(tables: Tables, **scene: Any) -> pd.DataFrame:
    """Relative errors by method, resolution and energy (Kp, Kg or Nu), with `steady`."""
    chosen = rows(tables, "errors", **scene).sort_values("resolution")
    return chosen.assign(steady=steady(tables, chosen))


def steady(tables: Tables, points: pd.DataFrame) -> pd.Series:
    """For each point whether all its runs have settled; a point without runs counts as settled."""
    runs = rows(tables, "kinetic_energy").dropna(subset="ke")
    restless = runs[runs.converged.astype(str) != "True"].set_index(POINT).index   # from CSV, or made
    return pd.Series(~points.set_index(POINT).index.isin(restless), index=points.index)


def diverged(tables: Tables, **scene: Any) -> pd.DataFrame:
    """Points of a method, particles if none is named, at which runs diverged: `lost` of `seeds`."""
    runs = rows(tables, "kinetic_energy", **{"method": SPAM["method"]} | scene)
    by_point = runs.assign(lost=runs.ke.isna()).groupby(POINT)["lost"]
    return by_point.agg(lost="sum", seeds="size").reset_index().query("lost > 0")


def finest(frame: pd.DataFrame) -> pd.DataFrame:
    """The rows of the highest resolution."""
    return frame[frame.resolution == frame.resolution.max()]


def cross_out(axes: Axes, x: pd.Series, y: pd.Series, steady: pd.Series) -> None:
    """A cross on each mark whose runs have not settled; one entry in the legend."""
    if not steady.all():
        labels = axes.get_legend_handles_labels()[1]
        label = "" if NOT_STEADY in labels else NOT_STEADY
        axes.plot(x[~steady], y[~steady], "x", color="black", markersize=8, zorder=6, label=label)
