"""Figures of the study ordering, from its tables."""
from collections.abc import Iterable
from typing import Any

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from studies.kit.drawing import Drawing, Drawings
from studies.kit.figure import below, errorbar, figure, look
from studies.ordering.cases import IRREGULAR, WAVE
from studies.ordering.derive import WANTED
from studies.ordering.tables import WIDTH

#: how a gradient is taken
FORMS = {"single": "$f_j$  [Eq. 1]", "sum": "$f_i + f_j$  [Eqs 14, 34-36]", "difference": "$f_j - f_i$"}
KINDS = ("lattice", "jittered-0.1", "jittered-0.3", "random", "relaxed")
MAKERS = ("printed", "plain", "renormalised", "closed", "exact", "delaunay")
RANGES = [1.2, 2, 3, 4, 6]
VORTEX = {"flow": "taylor-green", "quantity": "velocity"}
LAYER = {"flow": "convection", "quantity": "K"}
NAMES = {"taylor-green": "Taylor-Green, velocity", "convection": "Rayleigh-Benard, $|K/K_{grid} - 1|$"}
SIZES = {"taylor-green": r"\lambda", "convection": "L"}
ROWS = (12, 16, 24, 32, 40, 50)
#: on irregular points; a triangulation has no range
MADE = (("delaunay", 0.0), ("exact", 3.0), ("closed", 3.0), ("renormalised", 3.0))
#: of K on irregular points
SERIES = (("delaunay", 0.0), ("exact", 3.0), ("closed", 2.0), ("closed", 3.0), ("renormalised", 2.0),
          ("renormalised", 3.0), ("plain", 2.0), ("plain", 3.0))
ASIDE = 1.012       # factor between series drawn beside each other


# --- waves --------------------------------------------------------------------------------------------------


def surface(means: pd.DataFrame) -> Figure | None:
    """Errors of gradient and Laplacian of waves over the range of the weight: must a < r0 < lambda hold?"""
    rows = means[(means["maker"] == "renormalised") & (means["weight"] == "Lucy")]
    kinds = [kind for kind in KINDS if kind in set(rows["points"])]
    if not kinds:
        return None
    page, panels = figure(2, len(kinds), width=2.4, height=3.0, sharex=True, sharey="row", squeeze=False)
    for column, kind in zip(panels.T, kinds, strict=True):
        surface_of(column, rows[rows["points"] == kind], sorted(set(rows["wavelength"])))
        column[0].set_title(kind)
        column[1].set_xlabel("range $h/a$")
    panels[0, 0].set_ylabel("relative rms error of grad")
    panels[1, 0].set_ylabel("relative rms error of Laplacian")
    legends = [axes.get_legend_handles_labels() for axes in panels.ravel()]
    curves = {label: handle for handles, labels in legends for handle, label in zip(handles, labels, strict=True)}
    labels = sorted(curves, key=lambda label: float(label.split()[-2]))
    page.legend([curves[label] for label in labels], labels, loc="outside lower center", ncols=len(labels))
    page.suptitle("Must $a < r_0 < \\lambda$ hold?  Lucy's weight, renormalised; bars: 95 % over point sets",
                  fontsize=10)
    return page


def surface_of(column: Iterable[Axes], rows: pd.DataFrame, wavelengths: list[int]) -> None:
    """Gradient and Laplacian on one kind of points, one curve a wavelength."""
    for axes, operator in zip(column, ("gradient", "laplacian"), strict=True):
        for wavelength, group in rows.groupby("wavelength"):
            number, group = wavelengths.index(int(str(wavelength))), group.sort_values("h")
            errorbar(axes, *columns(group, "h", operator), number=number, linestyle="-",
                     label=rf"$\lambda$ = {wavelength} $a$")
        logarithmic(axes, RANGES)


def columns(group: pd.DataFrame, x: str, y: str) -> list[list[float]]:
    """x, y and the error of y."""
    return [group[name].tolist() for name in (x, y, f"{y}_err")]


def logarithmic(axes: Axes, ticks: Iterable[float]) -> None:
    """Both scales."""
    axes.set(xscale="log", yscale="log")
    axes.set_xticks(list(ticks), labels=[f"{tick:g}" for tick in ticks])
    axes.minorticks_off()


def makers(means: pd.DataFrame) -> Figure:
    """Errors of the gradient with all makers of edges as points get finer, on a lattice and on jittered points."""
    page, panels = figure(1, 2, width=4.2, height=4.2, sharey=True)
    for axes, kind in zip(panels, ("lattice", "jittered-0.3"), strict=True):
        for number, maker in enumerate(MAKERS):
            rows = means[(means["maker"] == maker) & (means["points"] == kind) & (means["weight"] == "Lucy")]
            group = rows[rows["h"] == (3.0 if 3.0 in set(rows["h"]) else 2.0)].sort_values("wavelength")
            if len(group):
                label = maker + ", $h = 3a$"*(maker != "delaunay")
                errorbar(axes, *columns(group, "wavelength", "gradient"), number=number, linestyle="-",
                         label=label)
        x = np.array([16.0, 96.0])
        axes.plot(x, 0.35*(16/x)**2, color="grey", linestyle=":", marker="", label=r"$\lambda^{-2}$")
        axes.set(title=kind, xlabel=r"wavelength $\lambda/a$")
        logarithmic(axes, [16, 24, 32, 48, 64, 96])
        below(axes, ncols=2, bbox_to_anchor=(0.5, -0.18))
    panels[0].set_ylabel("relative rms error of grad")
    return page


def brackets(means: pd.DataFrame) -> Figure:
    """Errors of gradients as printed and by differences over the range of the weight, one panel a kind of points."""
    kinds = [kind for kind in KINDS if kind in set(means["points"])]
    page, (panels,) = figure(1, len(kinds), width=2.8, height=3.6, sharey=True, squeeze=False)
    for axes, kind in zip(panels, kinds, strict=True):
        rows = means[(means["points"] == kind) & (means["wavelength"] == WAVE)].sort_values("h")
        for number, (form, words) in enumerate(FORMS.items()):
            group = rows[rows["form"] == form]
            errorbar(axes, *columns(group, "h", "error"), number=number, linestyle="-", label=words)
        axes.axvspan(1.1, 1/WIDTH, color="0.9", zorder=0, label="$r_0 < a$")
        logarithmic(axes, RANGES)
        axes.set(title=kind, xlabel="range $h/a$", xlim=(1.1, 6.6))
    panels[0].set_ylabel("relative rms error of grad")
    page.legend(*panels[0].get_legend_handles_labels(), loc="outside lower center", ncols=4)
    page.suptitle("Gradients as printed, and by differences: Lucy's weight, plain quadrature, "
                  rf"$\lambda$ = {WAVE} $a$; "
                  "bars: 95 % over point sets", fontsize=10)
    return page


# --- flows --------------------------------------------------------------------------------------------------


def pick(flows: pd.DataFrame, **where: Any) -> pd.DataFrame:
    """Rows where columns have these values, with the size of the error."""
    for column, value in where.items():
        flows = flows[flows[column] == value]
    return flows.assign(size=flows["error"].abs())


def of_maker(flows: pd.DataFrame, which: dict[str, str], maker: str, h: float,
             points: str) -> tuple[pd.DataFrame, str]:
    """One series on irregular points and its label."""
    rows = pick(flows, **which, maker=maker, weight="Lucy" if h else "none", h=h, points=points)
    return rows, maker + (f", {h:g} $a$" if h else "")


def curve(axes: Axes, rows: pd.DataFrame, x: str, number: int, label: str) -> None:
    """Sizes of errors over x, hollow where the error is negative; the label says how many points lost a seed."""
    if rows.empty:
        return
    known = rows[(rows["lost"] == 0) & rows["size"].notna()].sort_values(x)
    missing = len(rows) - len(known)
    label += f" (lost: {missing} of {len(rows)})" if missing else ""
    errorbar(axes, known[x].tolist(), known["size"].tolist(), known["error_err"].tolist(), number=number,
             linestyle="-",
             label=label)
    low = known[known["error"] < 0]
    axes.plot(low[x], low["size"], **{**look(number), "linestyle": "none"}, markerfacecolor="white", zorder=5)


def over_range(flows: pd.DataFrame) -> Figure:
    """Errors of whole flows over the range of the weight on a lattice: must a < r0 hold?"""
    page, panels = figure(1, 2, width=4.2, height=4.2)
    for axes, which in zip(panels, (VORTEX, LAYER), strict=True):
        rows = pick(flows, **which, maker="renormalised", points="lattice")
        for number, (size, group) in enumerate(rows.groupby("resolution")):
            curve(axes, group, "h", number, rf"${SIZES[which['flow']]}$ = {size:g} $a$")
        finish(axes, sorted(set(rows["h"])), "range $h/a$", NAMES[which["flow"]])
        left, _ = axes.get_xlim()
        axes.axvspan(left, 1/WIDTH, color="0.9", zorder=0, label="$r_0 < a$")
        axes.set_xlim(left=left)
        axes.legend(loc="upper center", bbox_to_anchor=(0.5, -0.15), ncols=2)
    panels[0].set_ylabel("relative error")
    page.suptitle("Must $a < r_0$ hold?  Lucy's weight, renormalised, on a lattice; dotted: 1 %, hollow: K too low",
                  fontsize=10)
    return page


def over_points(flows: pd.DataFrame) -> Figure:
    """Errors of whole flows over the points of a wavelength or height, on lattices and on irregular points."""
    page, panels = figure(2, 3, width=3.9, height=4.1)
    for axes, which, ticks in ((panels[0, 0], VORTEX, ()), (panels[1, 1], LAYER, (ROWS[:4],))):
        rows = pick(flows, **which, maker="renormalised", points="lattice")
        for number, (h, group) in enumerate(rows.groupby("h")):
            curve(axes, group, "resolution", number, f"$h = {h:g} a$")
        decorate(axes, which, "lattice", *ticks)
    for axes, kind in zip((panels[0, 1], panels[0, 2], panels[1, 0]), IRREGULAR, strict=True):
        for number, (maker, h) in enumerate(MADE):
            rows, label = of_maker(flows, VORTEX, maker, h, kind)
            curve(axes, rows, "resolution", number, label)
        decorate(axes, VORTEX, kind)
    for number, kind in enumerate(IRREGULAR):
        rows = pick(flows, **LAYER, maker="delaunay", points=kind)
        curve(panels[1, 2], rows, "resolution", number, f"{kind}, delaunay")
    decorate(panels[1, 2], LAYER, "irregular", ROWS)
    for axes in panels[:, 0]:
        axes.set_ylabel("relative error")
    page.suptitle("Dotted: 1 %; hollow: K too low; bars: 95 % over point sets; lost: a set diverged",
                  fontsize=10)
    return page


def over_disorder(flows: pd.DataFrame) -> Figure | None:
    """Errors of K over the rows on irregular points: triangles on the plates, edges of weights between images.

    Series are drawn a little beside each other, so that no bar covers another.
    """
    if not len(pick(flows, **LAYER)):
        return None
    page, panels = figure(1, 3, width=3.9, height=4.6, sharey=True)
    for axes, kind in zip(panels, IRREGULAR, strict=True):
        for number, (maker, h) in enumerate(SERIES):
            rows, label = of_maker(flows, LAYER, maker, h, kind)
            curve(axes, rows.assign(resolution=rows["resolution"]*ASIDE**number), "resolution", number, label)
        decorate(axes, LAYER, kind, ROWS)
    panels[0].set_ylabel("relative error of K")
    page.suptitle("Ra 10 000: triangles that end on the plates, Lucy's weight between mirror images.  Dotted: 1 %; "
                  "hollow: K too low; bars: 95 % over\n"
                  "point sets; lost: where a set diverged or ended in other rolls; no curve: all did",
                  fontsize=10)
    return page


def decorate(axes: Axes, which: dict[str, str], kind: str,
             ticks: tuple[int, ...] = (16, 24, 32, 48, 64)) -> None:
    """Axes, a line of second order, the legend."""
    x = np.array([ticks[0], ticks[-1]], float)
    axes.plot(x, 0.02*(ticks[0]/x)**2, color="grey", linestyle="--", marker="", label="order 2")
    finish(axes, ticks, rf"${SIZES[which['flow']]}/a$", f"{NAMES[which['flow']]}: {kind}")
    axes.legend(loc="upper center", bbox_to_anchor=(0.5, -0.15), ncols=2, fontsize=7)


def finish(axes: Axes, ticks: Iterable[float], label: str, title: str) -> None:
    """Scales, and where 1 % is."""
    axes.axhline(WANTED, color="black", linestyle=":", linewidth=0.8)
    axes.set(title=title, xlabel=label)
    logarithmic(axes, ticks)


FIGURES = Drawings(Drawing("surface", ("means",), surface), Drawing("makers", ("means",), makers),
                   Drawing("brackets", ("bracket_means",), brackets),
                   Drawing("flows_range", ("flows",), over_range),
                   Drawing("flows_points", ("flows",), over_points),
                   Drawing("flows_disorder", ("flows",), over_disorder))
