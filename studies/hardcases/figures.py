"""Figures: the map, shocks, the highest Ra."""
from textwrap import fill
from typing import Any

import numpy as np
import pandas as pd
from matplotlib.figure import Figure
from matplotlib.patches import Rectangle

from studies.hardcases.cases import IN_LAYERS, IN_TUBES
from studies.hardcases.derive import NEAR, SPURIOUS
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


CASES = (*LAYERS, *BOXES, "shear layer", "shock tube")
MANY = 3                # cases of a method, and methods of a case, from which on it has a line of its own
FLOWS = 100*SPURIOUS    # speeds of KHP95 over that of sound
#: largest error, face, letters; the darker, the worse
SHADES = ((NEAR, "#DEEBF7", "black"), (0.5, "#F5C26B", "black"), (np.inf, "#D55E00", "black"))
ENDED = "#3B0F4F", "white"
LETTERS = 112           # in a line of the page
KEY = ("A cell is an error in %: of the flow against the finest grid, the exact answer or theory; corner: "
       "speed over that of KHP95's flows; tube: ringing of v. Near 100: the flow froze. Dark: the run ended "
       "early. ?: nothing to judge by. Empty: not tried.")


def judged(rows: pd.DataFrame) -> pd.DataFrame:
    """Rows of cases with `error` (infinite where a run ended early) and a case for each tube."""
    rows = rows[rows.case.str.startswith(CASES)]
    scale = np.where(rows.number == "speed/c", FLOWS, 1.0)
    error: pd.Series = (rows.measured - rows.predicted).abs()/scale
    tube = rows.case.where(rows.case != "shock tube", rows.case + " " + rows.variant)
    error[rows.outcome == "unjudged"] = np.nan
    error[rows.outcome == "diverges"] = np.inf
    return rows.assign(case=tube, error=error)


def chart(rows: pd.DataFrame) -> Figure:
    """Errors of methods in hard cases; what was tried in one or two of them stands below, in words."""
    rows = judged(rows)
    count = rows.groupby("method").case.nunique().sort_values(ascending=False, kind="stable")
    methods = list(count.index[count >= MANY])
    shown = rows[rows.method.isin(methods)]
    shown = shown[shown.groupby("case").method.transform("nunique") >= MANY]
    cases = [case for name in CASES for case in sorted(set(shown.case)) if case.startswith(name)]
    page, axes = figure(width=7.4, height=2.9 + 0.29*len(methods))
    for row in shown.itertuples():
        cell(axes, cases.index(row.case), methods.index(row.method), row)
    axes.set(xlim=(-0.5, len(cases) - 0.5), ylim=(len(methods) - 0.5, -0.5))
    axes.set_yticks(range(len(methods)), labels=methods, fontsize=8)
    axes.set_xticks(range(len(cases)), labels=cases, fontsize=8, rotation=40, ha="right")
    axes.grid(False)
    page.suptitle(f"No method takes every hard case; layers have {ROWS} rows", fontsize=10)
    words = fill(KEY, LETTERS), also_tried(rows.drop(shown.index))
    page.supxlabel("\n".join(words), fontsize=8, x=0.01, ha="left")
    return page


def also_tried(rows: pd.DataFrame) -> str:
    """What has no line of its own, with its errors, by case."""
    words = [f"{case} (" + ", ".join(f"{row.method}: {said(row)}" for row in some.itertuples()) + ")"
             for case, some in groups(rows, "case")]
    text = "Also tried [%]: " + "; ".join(words) + "."
    return fill(text, LETTERS, break_on_hyphens=False) if words else ""


def said(row: Any) -> str:
    """The error in %, or the outcome where there is none."""
    percents = 100*row.error
    digits = ".0f" if percents > 9.95 or percents < 0.01 else ".2g"
    return f"{percents:{digits}}" if np.isfinite(percents) else row.outcome


def cell(axes: Any, x: int, y: int, row: Any) -> None:
    """One method in one case."""
    face, letters = next((shade[1:] for shade in SHADES if row.error <= shade[0]), ("white", "black"))
    if row.outcome == "diverges":
        face, letters = ENDED
    axes.add_patch(Rectangle((x - 0.5, y - 0.5), 1, 1, facecolor=face, edgecolor="white"))
    words = {"diverges": "ends", "unjudged": "?"}.get(row.outcome, said(row))
    axes.text(x, y, words, ha="center", va="center", fontsize=8, color=letters)


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


ALL = (*IN_TUBES, "spam")
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
            words = f"{method}:\nended at {reached.iloc[-1]:.2g} of the time"
            axes.text(0.98, up + 0.2, words, ha="right", fontsize=8)


BINS = 4                # of Ra, a decade
#: kind of limit -> height beside its line, filled, words
LIMITS = {"wrong": (0.3, False, "open: first"), "ends": (-0.3, True, "filled: first that")}


def highest(rows: pd.DataFrame, summary: pd.DataFrame) -> Figure:
    """K over the fine grid's against Ra, and from which Ra on runs are wrong or end."""
    page, (above, under) = figure(2, 1, width=7.0, height=2.9, sharex=True)
    rows, limits = rows.query("step == 1"), summary.query("step == 1")
    for number, method in enumerate(IN_LAYERS):
        trend(above, rows[rows.method == method], number, method)
        fates(under, rows[rows.method == method], limits[limits.method == method], number)
    for level in (OFF, 1/OFF):
        above.axhline(level, color="grey", linewidth=0.8)
    above.set(xscale="log", ylabel="K / K of 48 rows of the grid",
              title=f"lines: medians of {BINS:g} bins a decade; grey: a factor of {OFF:g}")
    above.legend(loc="lower left")
    under.set(xlabel="Ra", ylim=(len(IN_LAYERS) - 0.4, -0.6), title="bars: " + "; ".join(
        f"{word} {kind}, all starts" for kind, (_, _, word) in LIMITS.items())
        + "\nticks: runs that came to their end; crosses: runs that did not")
    under.set_yticks(range(len(IN_LAYERS)), labels=list(IN_LAYERS), fontsize=8)
    page.suptitle(f"On {ROWS} rows grid and points that stay end near Ra 5e5; moving points go on, but wrong",
                  fontsize=10)
    return page


def trend(axes: Any, rows: pd.DataFrame, number: int, label: str) -> None:
    """All runs that came to their end, pale, and their medians in bins of Ra."""
    rows = rows.dropna(subset=["over"])
    axes.plot(rows.ra, rows.over, **dots(number, 3), alpha=0.4)
    bins = (BINS*np.log10(rows.ra)).round()
    middle = rows.groupby(bins)[["ra", "over"]].median()
    axes.plot(middle.ra, middle.over, **look(number), label=label)


def fates(axes: Any, rows: pd.DataFrame, limits: pd.DataFrame, number: int) -> None:
    """A line of runs and of limits, means over starts and their range."""
    whole = rows.reached >= 1
    for some, marker, side in ((rows[whole], "|", 0.12), (rows[~whole], "x", -0.12)):
        style: dict[str, Any] = {"color": "0.5", "marker": marker, "markersize": 5, "linestyle": ""}
        axes.plot(some.ra, np.full(len(some), number + side), **style)
    for kind, (side, filled, _) in LIMITS.items():
        some = limits[limits.kind == kind]
        style = dots(number, 8) | ({} if filled else {"markerfacecolor": "white"})
        spread = [some.ra - some.ra_low, some.ra_high - some.ra]
        axes.errorbar(some.ra, np.full(len(some), number + side), xerr=spread, **style)


figures = Drawings(
    Drawing("map", ("map",), chart),
    Drawing("high_ra", ("high_ra_trials", "high_ra_summary"), highest),
    Drawing("shocks", ("ripples",), shocks),
    Drawing("shock_methods", ("method_tubes", "method_tube_profiles"), shock_methods))
