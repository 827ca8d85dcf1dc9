"""Figures of the study ordering, from its tables."""
from collections.abc import Sequence

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from particles.integral.edge_makers import MAKERS
from studies.build.setting import DISORDERS
from studies.kit.figure import Drawing, Drawings, bars, below, figure, logarithmic, look
from studies.ordering.cases import IRREGULAR, ROWS
from studies.ordering.tables import WANTED, WIDTH

RANGES = (1.2, 2, 3, 4, 6)
SIZES = (16, 24, 32, 48, 64)
NAMES = {"taylor-green": "Taylor-Green, velocity", "convection": "Rayleigh-Benard, $|K/K_{grid} - 1|$"}
LENGTHS = {"taylor-green": r"$\lambda", "convection": "$L"}
#: makers of edges on irregular points, with h = 3 a; a triangulation has no range
MADE = ("delaunay", "exact", "closed", "renormalised")


def surface(means: pd.DataFrame) -> Figure:
    """Errors of gradient and Laplacian of waves over the range of the weight: must a < r0 < lambda hold?"""
    rows = means.query("maker == 'renormalised'")
    kinds = [kind for kind in DISORDERS if kind in set(rows.points)]
    page, panels = figure(2, len(kinds), width=2.4, height=3.0, sharex=True, sharey="row", squeeze=False)
    for line, operator, name in zip(panels, ("gradient", "laplacian"), ("grad", "Laplacian")):
        for axes, kind in zip(line, kinds):
            for number, (wavelength, group) in enumerate(rows.groupby("wavelength")):
                bars(axes, group[group.points == kind], "h", operator, number=number, linestyle="-",
                     label=rf"$\lambda$ = {wavelength} $a$")
            logarithmic(axes, RANGES)
        line[0].set_ylabel(f"relative rms error of {name}")
    for (upper, lower), kind in zip(panels.T, kinds):
        upper.set_title(kind)
        lower.set_xlabel("range $h/a$")
    page.legend(*axes.get_legend_handles_labels(), loc="outside lower center", ncols=number + 1)
    page.suptitle("On a lattice a short range is best, off it a range of several spacings\n"
                  "Lucy's weight, renormalised; bars: 95 % over point sets")
    return page


def makers(means: pd.DataFrame) -> Figure:
    """Errors of the gradient with all makers of edges as points get finer: a lattice and jittered points."""
    page, panels = figure(1, 2, width=4.2, height=4.2, sharey=True)
    means = means.query("h in (2, 3)")
    for axes, kind in zip(panels, ("lattice", "jittered-0.3")):
        rows = means[means.points == kind]
        for number, maker in enumerate(MAKERS):
            group = rows[rows.maker == maker].query("h == h.max()")     # triangles are the same for all
            if len(group):
                label = maker + ", $h = 3a$"*(maker != "delaunay")
                bars(axes, group, "wavelength", "gradient", number=number, linestyle="-", label=label)
        x = np.array([16.0, 96.0])
        axes.plot(x, 0.35*(16/x)**2, color="grey", linestyle=":", marker="", label=r"$\lambda^{-2}$")
        axes.set(title=kind, xlabel=r"wavelength $\lambda/a$")
        logarithmic(axes, (*SIZES, 96))
    panels[0].set_ylabel("relative rms error of grad")
    page.legend(*panels[0].get_legend_handles_labels(), loc="outside lower center", ncols=4)
    page.suptitle("Off a lattice only exact and Delaunay edges come nearer to the gradient")
    return page


def curves(axes: Axes, rows: pd.DataFrame, by: str, x: str, label: str) -> None:
    """Draw a curve for each value of the column `by`, which completes the label."""
    for number, (value, group) in enumerate(rows.groupby(by)):
        curve(axes, group, x, number, label.format(value))


def curve(axes: Axes, rows: pd.DataFrame, x: str, number: int, label: str) -> None:
    """Draw sizes of errors over x, hollow where negative; the label says how many points lost a seed."""
    if rows.empty:
        return
    known = rows.query("lost == 0").dropna(subset="error")
    missing = len(rows) - len(known)
    label += f" (lost: {missing} of {len(rows)})" if missing else ""
    sizes = known.assign(error=known.error.abs())
    bars(axes, sizes, x, "error", number=number, linestyle="-", label=label)
    low = known.query("error < 0")
    style = look(number) | {"linestyle": "none", "markerfacecolor": "white"}
    axes.plot(low[x], -low.error, **style, zorder=5)


def over_range(flows: pd.DataFrame) -> Figure:
    """Errors of whole flows over the range of the weight on a lattice: must a < r0 hold?"""
    page, panels = figure(1, 2, width=4.2, height=4.2)
    lattices = flows.query("points == 'lattice'")
    for axes, flow in zip(panels, NAMES):
        rows = lattices[lattices.flow == flow]
        curves(axes, rows, "resolution", "h", LENGTHS[flow] + "$ = {:g} $a$")
        finish(axes, sorted(set(rows.h)), "range $h/a$", NAMES[flow])
        left, _ = axes.get_xlim()
        axes.axvspan(left, 1/WIDTH, color="0.9", zorder=0, label="$r_0 < a$")
        axes.set_xlim(left=left)
        below(axes, ncols=2)
    panels[0].set_ylabel("relative error")
    page.suptitle("Errors are least at 1.2 to 1.5 $a$: $a < r_0$ need not hold on a lattice\n"
                  "Lucy's weight, renormalised; dotted: 1 %, hollow: K too low")
    return page


def over_points(flows: pd.DataFrame) -> Figure:
    """Errors of whole flows over the points of a wavelength or height, on irregular points."""
    page, panels = figure(2, 2, width=3.9, height=4.1)
    *vortices, layers = panels.ravel()
    made = flows.query("flow == 'taylor-green' and h in (0, 3)")
    for axes, kind in zip(vortices, IRREGULAR):
        rows = made[made.points == kind]
        for number, maker in enumerate(MADE):
            label = maker + ", 3 $a$"*(maker != "delaunay")
            curve(axes, rows[rows.maker == maker], "resolution", number, label)
        decorate(axes, "taylor-green", kind, SIZES)
    triangles = flows.query("flow == 'convection' and maker == 'delaunay'")
    curves(layers, triangles, "points", "resolution", "{}, delaunay")
    decorate(layers, "convection", "irregular", ROWS)
    for axes in panels[:, 0]:
        axes.set_ylabel("relative error")
    page.suptitle("Errors fall as rows$^{-2}$ on Delaunay edges, whatever the points\n"
                  "dotted: 1 %; hollow: K too low; bars: 95 % over point sets; lost: a set diverged")
    return page


def decorate(axes: Axes, flow: str, kind: str, ticks: Sequence[float]) -> None:
    """Draw axes, a line of second order and the legend."""
    x = np.array([ticks[0], ticks[-1]], float)
    axes.plot(x, 0.02*(ticks[0]/x)**2, color="grey", linestyle="--", marker="", label="order 2")
    finish(axes, ticks, LENGTHS[flow] + "/a$", f"{NAMES[flow]}: {kind}")
    below(axes, ncols=2, fontsize=7)


def finish(axes: Axes, ticks: Sequence[float], label: str, title: str) -> None:
    """Set scales and labels, and mark 1 %."""
    axes.axhline(WANTED, color="black", linestyle=":", linewidth=0.8)
    axes.set(title=title, xlabel=label)
    logarithmic(axes, ticks)


FIGURES = Drawings(
    Drawing("surface", ("means",), surface),
    Drawing("makers", ("means",), makers),
    Drawing("flows_range", ("flows",), over_range),
    Drawing("flows_points", ("flows",), over_points))
