"""Figures of whole flows over the surface, from the tables of the study ordering."""
from collections.abc import Iterable

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from studies.kit.figure import errorbar, figure, look
from studies.kit.table import Tables
from studies.ordering.flows import WANTED
from studies.ordering.flows_claims import WIDTH

VORTEX = {"flow": "taylor-green", "quantity": "velocity"}
LAYER = {"flow": "convection", "quantity": "K"}
NAMES = {"taylor-green": "Taylor-Green, velocity", "convection": "Rayleigh-Benard, $|K/K_{grid} - 1|$"}
SIZES = {"taylor-green": r"\lambda", "convection": "L"}
KINDS = ("jittered-0.3", "random", "relaxed")
#: on irregular points; a triangulation has no range
MADE = (("delaunay", 0.0), ("exact", 3.0), ("closed", 3.0), ("renormalised", 3.0))
#: of K on irregular points: ranges of each maker
SERIES = {"delaunay": (0.0,), "exact": (3.0,), "closed": (2.0, 3.0), "renormalised": (2.0, 3.0), "plain": (2.0, 3.0)}
ASIDE = 1.012


def figures(tables: Tables) -> dict[str, Figure]:
    """What the tables allow."""
    if "flows" not in tables:
        return {}
    flows = tables["flows"]
    disorder = {"flows_disorder": over_disorder(flows)} if set(flows["maker"][flows["flow"] == "convection"]) & {*SERIES} else {}
    return {"flows_range": over_range(flows), "flows_points": over_points(flows), **disorder}


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
        label += f" (lost: {lost} of {len(rows)})" if lost else ""
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
        decorate(axes, which, "lattice", *([(12, 16, 24, 32)]*(which is LAYER)))
    for axes, kind in zip((rows[0, 1], rows[0, 2], rows[1, 0]), KINDS, strict=True):
        for number, (maker, h) in enumerate(MADE):
            some = pick(flows, **VORTEX, maker=maker, weight="Lucy" if h else "none", h=h, points=kind)
            curve(axes, some, "resolution", number, maker + (f", {h:g} $a$" if h else ""))
        decorate(axes, VORTEX, kind)
    for number, kind in enumerate(KINDS):
        curve(rows[1, 2], pick(flows, **LAYER, maker="delaunay", points=kind), "resolution", number, f"{kind}, delaunay")
    decorate(rows[1, 2], LAYER, "irregular", (12, 16, 24, 32, 40, 50))
    for axes in rows[:, 0]:
        axes.set_ylabel("relative error")
    page.suptitle("Dotted: 1 %; hollow: K too low; bars: 95 % over point sets; lost: a set diverged", fontsize=10)
    return page


def over_disorder(flows: pd.DataFrame) -> Figure:
    """Errors of K over the rows, one panel a kind of irregular points: triangles on plates, edges of weights between images.

    Series are drawn a little beside each other, so that no bar covers another.
    """
    page, row = figure(1, 3, width=3.9, height=4.6, sharey=True)
    for axes, kind in zip(row, KINDS, strict=True):
        number = 0
        for maker, ranges in SERIES.items():
            for h in ranges:
                some = pick(flows, **LAYER, maker=maker, weight="Lucy" if h else "none", h=h, points=kind)
                beside = some.assign(resolution=some["resolution"]*ASIDE**number)
                curve(axes, beside, "resolution", number, maker + (f", {h:g} $a$" if h else ""))
                number += 1
        decorate(axes, LAYER, kind, (12, 16, 24, 32, 40, 50))
    row[0].set_ylabel("relative error of K")
    page.suptitle("Ra 10 000: triangles that end on the plates, Lucy's weight between mirror images.  Dotted: 1 %; hollow: K too "
                  "low; bars: 95 % over\npoint sets; lost: where a set diverged or ended in other rolls; no curve: all did",
                  fontsize=10)
    return page


def decorate(axes: Axes, which: dict[str, str], kind: str, ticks: tuple[int, ...] = (16, 24, 32, 48, 64)) -> None:
    """Axes, a line of second order, the legend."""
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
