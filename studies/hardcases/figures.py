"""Figures: the map, shocks, the highest Ra."""
from textwrap import fill
from typing import Any

import numpy as np
import pandas as pd
from matplotlib.colors import ListedColormap
from matplotlib.figure import Figure

from studies.hardcases.cases import IN_LAYERS, TRIED
from studies.hardcases.columns import COLUMNS
from studies.hardcases.derive import NEAR, SPURIOUS
from studies.hardcases.extremes import ALTERNATING, BOXES, LAYERS, ROWS
from studies.hardcases.high_ra import OFF
from studies.hardcases.printed import impulse
from studies.kit.figure import LINES, Drawing, Drawings, figure, look
from studies.kit.table import groups

DASHED: dict[str, Any] = {"color": "black", "linestyle": LINES[-1], "marker": ""}


def dots(number: int, size: float) -> dict[str, Any]:
    """Style of markers without a line."""
    return {**look(number), "linestyle": "none", "markersize": size}


CASES = (*LAYERS, *BOXES, ALTERNATING, *COLUMNS)
MANY, PAIR = 3, 2       # least number of a method's cases, and of a case's methods, that the map shows
LISTED = "entropy-stable"  # ends the names of methods with the entropy-stable flux
#: limits of error/tolerance between the shades, of which the last is for runs that ended early
LEVELS, SHADES = (1.0, 5.0, 1e9), ListedColormap(["#DEEBF7", "#F5C26B", "#D55E00", "#3B0F4F"])
#: outcome -> what stands in place of a number
WORDS = {"diverges": "ends", "freezes": "stops", "refused": "no", "unjudged": "?"}
KEY = ("A cell is the worst error of all sizes, starts and steps over the error that is allowed: 1 is the "
       "limit. Allowed is a tenth, against the finest grid, the exact answer or theory; 4 spacings for the "
       "place of a wave without viscosity, 1 for that of a front. Lightest: right by all that is asked. "
       "ends: a run ended early. stops: the flow came to rest. no: the method refuses. ?: nothing to judge "
       "by. Empty: not tried. Right of the line: with the entropy-stable flux. Methods and cases that were "
       "tried once or twice are in map.csv.")


def judged(rows: pd.DataFrame) -> pd.DataFrame:
    """Rows of the map with `error`, over the tolerance (infinite where a run ended early), its
    `shade` (-1: none)."""
    known = rows.case.map({name: column.within for name, column in COLUMNS.items()})
    allowed = np.where(rows.number == "speed/c", SPURIOUS, known.fillna(NEAR + rows.measured_err))
    error: pd.Series = (rows.measured - rows.predicted).abs()/allowed
    error[rows.outcome.isin(("unjudged", "refused"))] = np.nan
    error[rows.outcome == "diverges"] = np.inf
    dark = np.maximum(np.digitize(error, LEVELS), 1)
    shade = np.select([rows.outcome == "right", error.isna()], [0, -1], dark)
    return rows.assign(error=error, shade=shade)


def chart(rows: pd.DataFrame) -> Figure:
    """Errors of methods in hard cases, without and with the entropy-stable flux."""
    rows = judged(rows).sort_values(["shade", "error"], na_position="first")
    rows = rows.drop_duplicates(["case", "method"], keep="last")
    rows = rows[rows.groupby("method").case.transform("nunique") >= MANY]
    rows = rows[rows.groupby("case").method.transform("nunique") >= PAIR]
    order = [*TRIED, *sorted({*rows.method} - {*TRIED})]
    methods = sorted(set(rows.method), key=lambda name: (name.endswith(LISTED), order.index(name)))
    cases = [case for case in CASES if case in set(rows.case)]
    shades = rows.pivot(index="case", columns="method", values="shade").loc[cases, methods]
    page, axes = figure(width=7.4, height=2.6 + 0.2*len(cases))
    axes.pcolormesh(shades.where(shades >= 0), cmap=SHADES, vmin=0, vmax=len(LEVELS), edgecolors="white")
    for case, method, *cell in rows[["case", "method", "outcome", "error", "shade"]].to_numpy():
        x, y, (outcome, error, shade) = methods.index(method) + 0.5, cases.index(case) + 0.5, cell
        colour = "white" if shade > 1 else "black"
        words = WORDS.get(outcome) or tenths(error)
        axes.text(x, y, words, ha="center", va="center", fontsize=8, color=colour)
    axes.axvline(sum(not name.endswith(LISTED) for name in methods), color="black", linewidth=2)
    axes.invert_yaxis()
    axes.set_xticks(np.arange(len(methods)) + 0.5, labels=methods, fontsize=8, rotation=40, ha="left")
    axes.xaxis.tick_top()
    axes.set_yticks(np.arange(len(cases)) + 0.5, labels=cases, fontsize=8)
    axes.grid(False)
    parts = [rows[rows.method.str.endswith(LISTED) == listed] for listed in (False, True)]
    ends = [f"{(part.outcome == 'diverges').sum()} of {len(part)}" for part in parts]
    page.suptitle(f"Without the entropy-stable flux {ends[0]} trials end early, with it {ends[1]}")
    page.supxlabel(fill(KEY, 112), fontsize=8, x=0.01, ha="left")
    return page


def tenths(error: float) -> str:
    """An error as text: with one decimal below 9.5, without above; near its limit with two."""
    if abs(error - 1) < 0.05:
        return f"{error:.2f}"
    return f"{error:.1f}" if error < 9.5 else f"{error:.0f}" if error < 1e4 else f"{error:.0e}"


def shocks(ripples: pd.DataFrame) -> Figure:
    """Height and ripple of a shocked interface in time: means and all seeds by size and steepness."""
    page, (left, right) = figure(1, 2, width=4.4, height=3.2)
    for number, ((steep, scale), rows) in enumerate(groups(ripples, ["steep", "scale"])):
        theory = impulse(scale, steep)
        time = rows.time/theory.meets
        rise = rows.height - rows.height[rows.time == rows.time.min()].mean()
        label = rf"$k$ x amplitude = {steep:g}, {scale:g} x printed size"
        band(left, rise/(theory.kick*theory.back), time, number, label)
        band(right, rows.amplitude/theory.amplitude, time, number, label)
    theory = impulse(ripples.scale.max(), ripples.steep.max())
    times = np.array([0.0, theory.meets, theory.back])
    heights = theory.kick*np.maximum(times - theory.meets, 0) - theory.fall*times
    left.plot(times/theory.meets, heights/(theory.kick*theory.back), **DASHED, label="exact")
    growth = 1 + theory.growth*(theory.back - theory.meets)/theory.amplitude
    right.plot([1, theory.back/theory.meets], [1, growth], **DASHED, label="impulsive theory")
    left.set(ylabel="height of the interface / its rise by the shock")
    right.set(ylabel="amplitude / that behind the shock", ylim=(0.4, 2.9))
    for axes, place in ((left, "upper right"), (right, "upper left")):
        axes.set_xlabel("time / time of the shock's arrival")
        axes.legend(loc=place)
    page.suptitle("Behind a shock of Mach 1.5 ripples of an interface (density ratio 4) grow too slowly:\n"
                  "smooth particles as printed, without artificial viscosity; bands: all seeds")
    return page


def band(axes: Any, values: pd.Series, time: pd.Series, number: int, label: str) -> None:
    """Plot mean and range over seeds against time."""
    of_seeds = values.groupby(time).agg(["mean", "min", "max"])
    style = look(number) | {"marker": ""}
    axes.plot(of_seeds["mean"], **style, label=label)
    axes.fill_between(of_seeds.index, of_seeds["min"], of_seeds["max"], color=style["color"], alpha=0.2)


BINS, FEW = 4, 5        # bins of Ra per decade; least number of runs of a bin with a median
#: kind of limit -> shift from the method's line, style of its markers
LIMITS: dict[str, tuple[float, dict]] = {"wrong": (0.3, {"markerfacecolor": "white"}), "ends": (-0.3, {})}


def highest(rows: pd.DataFrame, summary: pd.DataFrame) -> Figure:
    """K over the fine grid's against Ra, and from which Ra on runs are wrong or end."""
    page, (above, under) = figure(2, 1, width=7.0, height=2.9, sharex=True)
    for number, method in enumerate(IN_LAYERS):
        own = f"step == 1 and method == '{method}'"
        trend(above, rows.query(own).dropna(subset=["over"]), number, method)
        fates(under, rows.query(own), summary.query(own), number)
    for level in (OFF, 1/OFF):
        above.axhline(level, color="grey", linewidth=0.8)
    above.set(xscale="log", ylabel="K / K of the grid, 48 rows",
              title=f"lines: medians of {BINS:g} bins a decade; grey: a factor of {OFF:g}")
    above.text(0.98, 0.05, "no reference beyond Ra 1e6", transform=above.transAxes, ha="right", fontsize=8)
    above.legend(loc="center right")
    under.set(xlabel="Ra", ylim=(len(IN_LAYERS) - 0.4, -0.6),
              title="open: first wrong or ended; filled: first that ends; bars: range over starts\n"
                    "ticks: runs that came to their end; crosses: runs that did not")
    under.set_yticks(range(len(IN_LAYERS)), labels=list(IN_LAYERS), fontsize=8)
    page.suptitle(f"On {ROWS} rows grid and points that stay end near Ra 5e5; moving points go on, but wrong")
    return page


def trend(axes: Any, rows: pd.DataFrame, number: int, label: str) -> None:
    """Plot all runs that reached their end, pale, and their medians in bins of Ra."""
    axes.plot(rows.ra, rows.over, **dots(number, 3), alpha=0.4)
    bins = (BINS*np.log10(rows.ra)).round()
    middle = rows.groupby(bins)[["ra", "over"]].median()[bins.value_counts() >= FEW]
    axes.plot(middle.ra, middle.over, **look(number), label=label)


def fates(axes: Any, rows: pd.DataFrame, limits: pd.DataFrame, number: int) -> None:
    """Plot on a method's line its runs and its limits: means over starts and their range."""
    for whole, marker, side in ((True, "|", 0.12), (False, "x", -0.12)):
        ra = rows.ra[(rows.reached >= 1) == whole]
        axes.plot(ra, 0*ra + number + side, color="0.5", marker=marker, markersize=5, linestyle="")
    for kind, (side, face) in LIMITS.items():
        some = limits[limits.kind == kind]
        spread = [some.ra - some.ra_low, some.ra_high - some.ra]
        axes.errorbar(some.ra, 0*some.ra + number + side, xerr=spread, **dots(number, 8), **face)


figures = Drawings(
    Drawing("map", ("map",), chart),
    Drawing("high_ra", ("high_ra_trials", "high_ra_summary"), highest),
    Drawing("shocks", ("ripples",), shocks))
