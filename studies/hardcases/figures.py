"""Figures: the map, shocks, the highest Ra."""
from typing import Any

import numpy as np
import pandas as pd
from matplotlib.figure import Figure
from matplotlib.patches import Rectangle

from studies.hardcases.cases import IN_LAYERS, IN_TUBES
from studies.hardcases.derive import PART_OF_TIME, finished_grids
from studies.hardcases.extremes import BOXES, LAYERS, ROWS
from studies.hardcases.high_ra import OFF
from studies.hardcases.interface import impulse
from studies.hardcases.sod import exact
from studies.hardcases.tubes import ETAS, STEPS
from studies.kit.figure import Drawing, Drawings, figure, look
from studies.kit.table import groups

THIN_LINE: dict[str, Any] = {"color": "black", "linewidth": 0.7, "linestyle": "-", "marker": ""}
DASHED: dict[str, Any] = {"color": "black", "linestyle": "--", "marker": ""}


def dots(number: int, size: float = 2) -> dict[str, Any]:
    """Marks without a line."""
    return {**look(number), "linestyle": "none", "markersize": size}


CASES = (*LAYERS, "highest Ra", *BOXES, "shear layer", "shock tube")
#: letter, shade and hatch of an outcome; the darker, the worse
LOOKS = {"right": ("R", "white", ""), "wrong": ("W", "0.85", "/"), "leaks": ("L", "0.85", "\\"),
         "freezes": ("F", "0.7", "x"), "diverges": ("D", "0.5", ""), "refused": ("-", "white", ""),
         "unjudged": ("?", "white", "")}
WORDS = {"unjudged": "not judged, no two other grids came to their end, or noise"}
KEY = ("  empty: not run\nnumber: flow over the start's, or over that of the grid of so many rows;\n"
       "vacuum: K over exact; corner: speed over sound's; shear: growth over linear; tube: ringing; "
       "highest Ra: the first that is wrong or ends")


def chart(rows: pd.DataFrame, runs: pd.DataFrame) -> Figure:
    """Cells with the letter of the outcome and the number behind it."""
    rows = rows.query("variant != 'ends'")
    named = rows.case + " " + rows.variant
    rows = rows.assign(case=rows.case.where(rows.case != "shock tube", named))
    there = sorted(set(rows.case))
    cases = [case for name in CASES for case in there if case.startswith(name)]
    number_of = rows.groupby("method").case.nunique()
    methods = list(number_of.sort_values(ascending=False, kind="stable").index)
    page, axes = figure(width=1.5 + 0.95*len(cases), height=1.2 + 0.3*len(methods))
    for row in rows.itertuples():
        cell(axes, cases.index(row.case), methods.index(row.method), row)
    axes.set(xlim=(-0.5, len(cases) - 0.5), ylim=(len(methods) - 0.5, -0.5))
    axes.set_yticks(range(len(methods)), labels=methods)
    axes.set_xticks(range(len(cases)), labels=[heading(case, runs) for case in cases], fontsize=8)
    axes.grid(False)
    outcomes = [name for name in LOOKS if name in set(rows.outcome)]
    letters = [f"{LOOKS[name][0]}: {WORDS.get(name, name)}" for name in outcomes]
    axes.set_xlabel("  ".join(letters) + KEY)
    axes.set_title(f"Which method takes which hard case? Layers of {ROWS} rows")
    return page


def cell(axes: Any, x: int, y: int, row: Any) -> None:
    """One method in one case."""
    text, shade, hatch = LOOKS[row.outcome]
    corner = x - 0.5, y - 0.5
    axes.add_patch(Rectangle(corner, 1, 1, facecolor=shade, edgecolor="0.6", hatch=hatch, linewidth=0.5))
    if pd.notna(row.measured) and row.number != PART_OF_TIME:
        text += f" {row.measured:.2g}"
    box = {"facecolor": shade, "edgecolor": "none", "pad": 0.6}
    axes.text(x, y, text, ha="center", va="center", fontsize=8, bbox=box)


def heading(case: str, runs: pd.DataFrame) -> str:
    """A case, and rows of the grid that it is held against."""
    words = case.replace(" ", "\n", 1)
    grids = finished_grids(runs, case).index if case in LAYERS else ()
    return f"{words}\ngrid of {max(grids)}" if len(grids) else words


def shocks(ripples: pd.DataFrame) -> Figure:
    """Height and ripple of a shocked interface in time: means and all seeds by size and steepness."""
    page, (left, right) = figure(1, 2, width=4.4, height=3.2)
    for number, ((steep, scale), rows) in enumerate(groups(ripples, ["steep", "scale"])):
        theory = impulse(scale, steep)
        rows = rows.assign(time=rows.time/theory.meets)
        start = rows.groupby("time").height.mean().iloc[0]
        label = rf"$ka$ = {steep:g}, {scale:g} x printed size"
        band(left, rows, (rows.height - start)/(theory.kick*theory.back), number, label)
        band(right, rows, rows.amplitude/theory.amplitude, number, label)
    expected(left, right, ripples.scale.max(), ripples.steep.max())
    left.set(ylabel="height of the interface / kick x time")
    right.set(ylabel="amplitude / that behind the shock", ylim=(0.4, 2.9))
    for axes, place in ((left, "upper right"), (right, "upper left")):
        axes.set_xlabel("time / time of the shock's arrival")
        axes.legend(loc=place)
    page.suptitle("A shock of Mach 1.5 passes an interface of density ratio 4: smooth particles as printed,\n"
                  "without artificial viscosity; bands: all seeds", fontsize=10)
    return page


def band(axes: Any, rows: pd.DataFrame, values: pd.Series, number: int, label: str) -> None:
    """Mean and range over seeds, in time."""
    of_seeds = values.groupby(rows.time).agg(["mean", "min", "max"])
    style = look(number) | {"marker": ""}
    axes.plot(of_seeds["mean"], **style, label=label)
    axes.fill_between(of_seeds.index, of_seeds["min"], of_seeds["max"], color=style["color"], alpha=0.2)


def expected(height: Any, amplitude: Any, scale: float, steep: float) -> None:
    """The exact height of the interface, and impulsive growth of its ripple."""
    theory = impulse(scale, steep)
    times = np.array([0.0, theory.meets, theory.back])
    heights = theory.kick*np.maximum(times - theory.meets, 0) - theory.fall*times
    height.plot(times/theory.meets, heights/(theory.kick*theory.back), **DASHED, label="exact")
    growth = 1 + theory.growth*(times[1:] - theory.meets)/theory.amplitude
    amplitude.plot(times[1:]/theory.meets, growth, **DASHED, label="impulsive theory")


ALL = (*IN_TUBES, "spam printed")
SHIFT = 0.5             # between methods' densities, upwards


def shock_methods(rows: pd.DataFrame, profiles: pd.DataFrame) -> Figure:
    """Densities, one method above the other, without viscosity, with little, with that of smooth particles.

    Of the shorter step: what ends with it is not the step's fault.
    """
    page, all_axes = figure(1, len(ETAS), width=4.0, height=4.4)
    rows = rows[rows.step != max(STEPS)]
    profiles = profiles[profiles.step != max(STEPS)]
    for axes, eta in zip(all_axes, ETAS):
        some = profiles[np.isclose(profiles.eta, eta)]
        densities(axes, some, rows[np.isclose(rows.eta, eta)])
        axes.set(title=rf"$\eta = k = {eta:g}$", xlabel="distance from the diaphragm / $L$",
                 xlim=(-0.8, 1.0), ylim=(-0.1, SHIFT*(len(ALL) - 1) + 1.15), yticks=[])
    all_axes[0].set_ylabel("density, methods one above the other")
    page.suptitle("Sod's shock tube at $t = 0.4 L$ without artificial viscosity; thin: exact, frictionless",
                  fontsize=10)
    return page


def densities(axes: Any, profiles: pd.DataFrame, rows: pd.DataFrame) -> None:
    """Each method's own, or when its longest run ended."""
    rows = rows.query("seed == 1").sort_values("L")
    for number, method in enumerate(ALL):
        up = SHIFT*number
        profile = profiles[profiles.method == method]
        reached = rows[rows.method == method].reached
        if len(profile):
            x, L = profile.x.to_numpy(), profile.L.iloc[0]
            rho, _, _ = exact(L, (x + 1)*L)
            axes.plot(x, up + rho, **THIN_LINE)
            axes.plot(x, up + profile.rho, **dots(number))
            axes.text(0.98, up + 0.02, f"{method}, $L$ = {L:g}", ha="right", fontsize=8)
        elif len(reached):
            words = f"{method}: ended at {reached.iloc[-1]:.2g} of the time"
            axes.text(0.98, up + 0.2, words, ha="right", fontsize=8)


def highest(rows: pd.DataFrame, summary: pd.DataFrame) -> Figure:
    """K over the fine grid's against Ra, and the part of the time that was reached."""
    page, (above, under) = figure(2, 1, width=6.4, height=2.9, sharex=True)
    rows = rows.query("step == 1").sort_values("ra")
    for number, method in enumerate(IN_LAYERS):
        some = rows[rows.method == method]
        ra = 10**(0.01*number)*some.ra      # that marks on one another are seen
        above.plot(ra, some.over, **dots(number, 4), label=method)
        under.plot(ra, some.reached, **dots(number, 4), label=method)
    for level in (OFF, 1/OFF):
        above.axhline(level, color="grey", linewidth=0.8)
    predicted = summary.predicted.dropna().iloc[0]
    for axes in (above, under):
        axes.axvline(predicted, color="black", linestyle=":", linewidth=1)
    above.set(xscale="log", ylabel="K / K of 48 rows of the grid")
    under.set(xlabel="Ra", ylabel="part of the time reached")
    under.legend(loc="lower left")
    page.suptitle(f"How high may Ra be on 16 rows? Grey: a factor of {OFF:g};\n"
                  "dotted: cell number 2 of the fastest flow; all starts and trials", fontsize=10)
    return page


figures = Drawings(
    Drawing("map", ("map", "hard_runs"), chart),
    Drawing("high_ra", ("high_ra_trials", "high_ra_summary"), highest),
    Drawing("shocks", ("ripples",), shocks),
    Drawing("shock_methods", ("method_tubes", "method_tube_profiles"), shock_methods))
