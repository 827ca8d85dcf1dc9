"""Discretized integral hydrodynamics: which points, edges and motions converge on the grid?"""
import pandas as pd
from matplotlib.figure import Figure

from studies.convection.figures_errors import RA_SHOWN, floor, loglog, plain_ticks, powers
from studies.convection.pick import LAYER, errors, groups
from studies.kit.figure import figure, look
from studies.kit.table import Tables


def fixed(tables: Tables) -> Figure | None:
    """Errors of K on points that stay, against rows."""
    return of(tables, "What do fixed points and their edges make of $K$?", lambda name: not name.startswith("moving"))


def moving(tables: Tables) -> Figure | None:
    """Errors of K on moving points, with each ingredient left out."""
    return of(tables, "Points that move: what does each ingredient do for $K$?", lambda name: name.startswith("moving"))


def of(tables: Tables, title: str, wanted) -> Figure | None:
    """A panel for each Ra; every variant that is wanted."""
    found = errors(tables, method="dih", energy="Kp", **LAYER)
    found = found[found["variant"].map(wanted).astype(bool) & found["ra"].isin(RA_SHOWN)]
    if found.empty:
        return None
    panels = groups(found, "ra")
    names = sorted(set(found["variant"]))
    page, all_axes = figure(1, len(panels), width=5, height=5.6, sharey=True, squeeze=False)
    for axes, (ra, group) in zip(all_axes[0], panels):
        for name, series in groups(group.sort_values("resolution"), "variant"):
            powers(axes, series, name, look(names.index(name)))
        floor(axes, pd.Series(group["error"].abs()))
        loglog(axes, f"Ra = {ra:g}", "rows over the height $L$")
        plain_ticks(axes, group["resolution"])
    all_axes[0, 0].set_ylabel("relative error  $|K_p/K - 1|$")
    page.suptitle(f"{title}\nOpen marks: too small; bars: 95 % intervals over sets of points", fontsize=10)
    return page
