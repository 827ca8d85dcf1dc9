"""Figures of whole flows over the surface, from the tables of the study ordering."""
from collections.abc import Iterable

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from studies.integral.ordering_flows import WANTED
from studies.integral.ordering_flows_claims import WIDTH
from studies.kit.figure import errorbar, figure, look
from studies.kit.table import Tables

VORTEX = {"flow": "taylor-green", "quantity": "velocity"}
LAYER = {"flow": "convection", "quantity": "K"}
NAMES = {"taylor-green": "Taylor-Green, velocity", "convection": "Rayleigh-Benard, $|K/K_{grid} - 1|$"}
SIZES = {"taylor-green": r"\lambda", "convection": "L"}
KINDS = ("jittered-0.3", "random", "relaxed")
#: on irregular points; a triangulation has no range
MADE = (("delaunay", 0.0), ("exact", 3.0), ("closed", 3.0), ("renormalised", 3.0))


def figures(tables: Tables) -> dict[str, Figure]:
    """What the tables allow."""
    if "flows" not in tables:
        return {}
    return {"flows_range": over_range(tables["flows"]), "flows_points": over_points(tables["flows"])}


def pick(rows: pd.DataFrame, **where) -> pd.DataFrame:
    """Rows where columns are as said, with the size of the error as `off`."""
    for column, value in where.items():
        rows = rows[rows[column] == value]
    return rows.assign(off=rows["error"].abs())


def curve(axes: Axes, rows: pd.DataFrame, x: str, number: int, label: str) -> None:
    """Sizes of errors over x, hollow where the error is negative; the label says how many points lost a seed."""
    told = rows[(rows["lost"] == 0) & rows["off"].notna()].sort_values(x)
    lost = len(rows) - len(told)
    if len(rows):
        label += f" (diverged: {lost} of {len(rows)})" if lost else ""
        errorbar(axes, *([told[name].tolist() for name in (x, "off", "error_err")]), number=number, linestyle="-", label=label)
        low = told[told["error"] < 0]
        axes.plot(low[x], low["off"], **{**look(number), "linestyle": "none"}, markerfacecolor="white", zorder=5)


def over_range(flows: pd.DataFrame) -> Figure:
    """Errors over h/a on a lattice, one curve a resolution."""
    page, both = figure(1, 2, width=4.2, height=4.2)
    for axes, which in zip(both, (VORTEX, LAYER), strict=True):
        rows = pick(flows, **which, maker="renormalised", points="lattice")
        for number, (size, group) in enumerate(rows.groupby("resolution")):
            curve(axes, group, "h", number, rf"${SIZES[which['flow']]}$ = {size:g} $a$")
        finish(axes, sorted(set(rows["h"])), "range $h/a$", NAMES[which["flow"]])
        low, _ = axes.get_xlim()
        axes.axvspan(low, 1/WIDTH, color="0.9", zorder=0, label="$r_0 < a$")
        axes.set_xlim(left=low)
        axes.legend(loc="upper center", bbox_to_anchor=(0.5, -0.15), ncols=2)
    both[0].set_ylabel("relative error")
    page.suptitle("Must $a < r_0$ hold?  Lucy's weight, renormalised, on a lattice; dotted: 1 %, hollow: K too low", fontsize=10)
    return page


def over_points(flows: pd.DataFrame) -> Figure:
    """Errors over the points of a wavelength or height, on lattices and on irregular points."""
    page, rows = figure(2, 3, width=3.9, height=4.1)
    for axes, which in ((rows[0, 0], VORTEX), (rows[1, 1], LAYER)):
        lattice = pick(flows, **which, maker="renormalised", points="lattice")
        for number, (h, group) in enumerate(lattice.groupby("h")):
            curve(axes, group, "resolution", number, f"$h = {h:g} a$")
        decorate(axes, which, "lattice")
    for axes, kind in zip((rows[0, 1], rows[0, 2], rows[1, 0]), KINDS, strict=True):
        for number, (maker, h) in enumerate(MADE):
            some = pick(flows, **VORTEX, maker=maker, weight="Lucy" if h else "none", h=h, points=kind)
            curve(axes, some, "resolution", number, maker + (f", {h:g} $a$" if h else ""))
        decorate(axes, VORTEX, kind)
    for number, kind in enumerate(KINDS):
        curve(rows[1, 2], pick(flows, **LAYER, maker="delaunay", points=kind), "resolution", number, f"{kind}, delaunay")
    decorate(rows[1, 2], LAYER, "irregular")
    for axes in rows[:, 0]:
        axes.set_ylabel("relative error")
    page.suptitle("Dotted: 1 %; hollow: K too low; bars: 95 % over point sets", fontsize=10)
    return page


def decorate(axes: Axes, which: dict[str, str], kind: str) -> None:
    """Axes, a line of second order, the legend."""
    ticks = (16, 24, 32, 48, 64) if which is VORTEX else (12, 16, 24, 32)
    x = np.array([ticks[0], ticks[-1]], float)
    axes.plot(x, 0.02*(ticks[0]/x)**2, color="grey", linestyle="--", marker="", label="order 2")
    finish(axes, ticks, rf"${SIZES[which['flow']]}/a$", f"{NAMES[which['flow']]}: {kind}")
    axes.legend(loc="upper center", bbox_to_anchor=(0.5, -0.15), ncols=2, fontsize=7)


def finish(axes: Axes, ticks: Iterable[float], label: str, title: str) -> None:
    """Scales, and where 1 % is."""
    axes.axhline(WANTED, color="black", linestyle=":", linewidth=0.8)
    axes.set(xscale="log", yscale="log", title=title, xlabel=label)
    axes.set_xticks(list(ticks), labels=[f"{tick:g}" for tick in ticks])
    axes.minorticks_off()
