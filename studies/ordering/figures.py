"""Figures of the study ordering, from its tables."""
from collections.abc import Iterable, Sequence

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from studies.kit.figure import Drawing, Drawings, below, errorbar, figure, look
from studies.ordering.cases import IRREGULAR, ROWS
from studies.ordering.derive import WANTED
from studies.ordering.tables import WIDTH

KINDS = ("lattice", "jittered-0.1", "jittered-0.3", "random", "relaxed")
MAKERS = ("printed", "plain", "renormalised", "closed", "exact", "delaunay")
RANGES = (1.2, 2, 3, 4, 6)
SIZES = (16, 24, 32, 48, 64)
NAMES = {"taylor-green": "Taylor-Green, velocity", "convection": "Rayleigh-Benard, $|K/K_{grid} - 1|$"}
LENGTHS = {"taylor-green": r"\lambda", "convection": "L"}
#: on irregular points; a triangulation has no range
MADE = (("delaunay", 0.0), ("exact", 3.0), ("closed", 3.0), ("renormalised", 3.0))


def logarithmic(axes: Axes, ticks: Iterable[float]) -> None:
    """Both scales."""
    axes.set(xscale="log", yscale="log")
    axes.set_xticks(list(ticks), labels=[f"{tick:g}" for tick in ticks])
    axes.minorticks_off()


def bars(axes: Axes, group: pd.DataFrame, x: str, y: str, number: int, label: str) -> None:
    """A curve with its errors."""
    group = group.sort_values(x)
    errorbar(axes, *group[[x, y, f"{y}_err"]].to_numpy().T, number=number, linestyle="-", label=label)


# --- waves --------------------------------------------------------------------------------------------------


def surface(means: pd.DataFrame) -> Figure | None:
    """Errors of gradient and Laplacian of waves over the range of the weight: must a < r0 < lambda hold?"""
    rows = means[means["maker"] == "renormalised"]
    kinds = [kind for kind in KINDS if kind in set(rows["points"])]
    if not kinds:
        return None
    page, panels = figure(2, len(kinds), width=2.4, height=3.0, sharex=True, sharey="row", squeeze=False)
    wavelengths = sorted(set(rows["wavelength"]))
    curves = {}
    for line, operator in zip(panels, ("gradient", "laplacian"), strict=True):
        for axes, kind in zip(line, kinds, strict=True):
            for wavelength, group in rows[rows["points"] == kind].groupby("wavelength"):
                number = wavelengths.index(wavelength)
                bars(axes, group, "h", operator, number, rf"$\lambda$ = {wavelength} $a$")
                curves[number] = axes.containers[-1]
            logarithmic(axes, RANGES)
    for axes, kind in zip(panels[0], kinds, strict=True):
        axes.set_title(kind)
    for axes in panels[1]:
        axes.set_xlabel("range $h/a$")
    panels[0, 0].set_ylabel("relative rms error of grad")
    panels[1, 0].set_ylabel("relative rms error of Laplacian")
    page.legend(handles=[curves[number] for number in sorted(curves)], loc="outside lower center",
                ncols=len(curves))
    page.suptitle("Must $a < r_0 < \\lambda$ hold?  Lucy's weight, renormalised; bars: 95 % over point sets",
                  fontsize=10)
    return page


def makers(means: pd.DataFrame) -> Figure:
    """Errors of the gradient with all makers of edges as points get finer: a lattice and jittered points."""
    page, panels = figure(1, 2, width=4.2, height=4.2, sharey=True)
    for axes, kind in zip(panels, ("lattice", "jittered-0.3"), strict=True):
        rows = means[(means["points"] == kind) & means["h"].isin([2.0, 3.0])]
        for number, maker in enumerate(MAKERS):
            group = rows[rows["maker"] == maker]
            group = group[group["h"] == group["h"].max()]       # triangles are the same for all
            if len(group):
                label = maker + ", $h = 3a$"*(maker != "delaunay")
                bars(axes, group, "wavelength", "gradient", number, label)
        x = np.array([16.0, 96.0])
        axes.plot(x, 0.35*(16/x)**2, color="grey", linestyle=":", marker="", label=r"$\lambda^{-2}$")
        axes.set(title=kind, xlabel=r"wavelength $\lambda/a$")
        logarithmic(axes, (*SIZES, 96))
        below(axes, ncols=2, bbox_to_anchor=(0.5, -0.18))
    panels[0].set_ylabel("relative rms error of grad")
    return page


# --- flows --------------------------------------------------------------------------------------------------


def curve(axes: Axes, rows: pd.DataFrame, x: str, number: int, label: str) -> None:
    """Sizes of errors over x, hollow where negative; the label says how many points lost a seed."""
    if rows.empty:
        return
    known = rows[(rows["lost"] == 0) & rows["error"].notna()]
    missing = len(rows) - len(known)
    label += f" (lost: {missing} of {len(rows)})" if missing else ""
    bars(axes, known.assign(error=known["error"].abs()), x, "error", number, label)
    low = known[known["error"] < 0]
    style = {**look(number), "linestyle": "none"}
    axes.plot(low[x], -low["error"], **style, markerfacecolor="white", zorder=5)


def over_range(flows: pd.DataFrame) -> Figure:
    """Errors of whole flows over the range of the weight on a lattice: must a < r0 hold?"""
    page, panels = figure(1, 2, width=4.2, height=4.2)
    for axes, flow in zip(panels, NAMES, strict=True):
        rows = flows[(flows["flow"] == flow) & (flows["points"] == "lattice")]
        for number, (size, group) in enumerate(rows.groupby("resolution")):
            curve(axes, group, "h", number, rf"${LENGTHS[flow]}$ = {size:g} $a$")
        finish(axes, sorted(set(rows["h"])), "range $h/a$", NAMES[flow])
        left, _ = axes.get_xlim()
        axes.axvspan(left, 1/WIDTH, color="0.9", zorder=0, label="$r_0 < a$")
        axes.set_xlim(left=left)
        axes.legend(loc="upper center", bbox_to_anchor=(0.5, -0.15), ncols=2)
    panels[0].set_ylabel("relative error")
    page.suptitle("Must $a < r_0$ hold?  Lucy's weight, renormalised, on a lattice; dotted: 1 %, "
                  "hollow: K too low", fontsize=10)
    return page


def over_points(flows: pd.DataFrame) -> Figure:
    """Errors of whole flows over the points of a wavelength or height: lattices and irregular points."""
    page, panels = figure(2, 3, width=3.9, height=4.1)
    first, jittered, random, relaxed, layer, irregular = panels.ravel()
    for axes, flow, ticks in ((first, "taylor-green", SIZES), (layer, "convection", ROWS[:4])):
        rows = flows[(flows["flow"] == flow) & (flows["points"] == "lattice")]
        for number, (h, group) in enumerate(rows.groupby("h")):
            curve(axes, group, "resolution", number, f"$h = {h:g} a$")
        decorate(axes, flow, "lattice", ticks)
    for axes, kind in zip((jittered, random, relaxed), IRREGULAR, strict=True):
        rows = flows[(flows["flow"] == "taylor-green") & (flows["points"] == kind)]
        for number, (maker, h) in enumerate(MADE):
            group = rows[(rows["maker"] == maker) & (rows["h"] == h)]
            curve(axes, group, "resolution", number, maker + (f", {h:g} $a$" if h else ""))
        decorate(axes, "taylor-green", kind, SIZES)
    rows = flows[(flows["flow"] == "convection") & (flows["maker"] == "delaunay")]
    for number, kind in enumerate(IRREGULAR):
        group = rows[rows["points"] == kind]
        curve(irregular, group, "resolution", number, f"{kind}, delaunay")
    decorate(irregular, "convection", "irregular", ROWS)
    for axes in panels[:, 0]:
        axes.set_ylabel("relative error")
    page.suptitle("Dotted: 1 %; hollow: K too low; bars: 95 % over point sets; lost: a set diverged",
                  fontsize=10)
    return page


def decorate(axes: Axes, flow: str, kind: str, ticks: Sequence[float]) -> None:
    """Axes, a line of second order, the legend."""
    x = np.array([ticks[0], ticks[-1]], float)
    axes.plot(x, 0.02*(ticks[0]/x)**2, color="grey", linestyle="--", marker="", label="order 2")
    finish(axes, ticks, rf"${LENGTHS[flow]}/a$", f"{NAMES[flow]}: {kind}")
    axes.legend(loc="upper center", bbox_to_anchor=(0.5, -0.15), ncols=2, fontsize=7)


def finish(axes: Axes, ticks: Iterable[float], label: str, title: str) -> None:
    """Scales, and where 1 % is."""
    axes.axhline(WANTED, color="black", linestyle=":", linewidth=0.8)
    axes.set(title=title, xlabel=label)
    logarithmic(axes, ticks)


FIGURES = Drawings(Drawing("surface", ("means",), surface), Drawing("makers", ("means",), makers),
                   Drawing("flows_range", ("flows",), over_range),
                   Drawing("flows_points", ("flows",), over_points))
