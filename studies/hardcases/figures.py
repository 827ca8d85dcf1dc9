"""Figures of the map, of steps and of the highest Ra; those of shocks are in `shocks`."""
from typing import Any

import pandas as pd
from matplotlib.figure import Figure
from matplotlib.patches import Rectangle

from studies.hardcases.cases import FLUIDS
from studies.hardcases.derive import PART_OF_TIME, finished_grids
from studies.hardcases.high_ra import METHODS, OFF, STEPS
from studies.hardcases.scenes import BOXES, LAYERS, ROWS
from studies.hardcases.shocks import shock_methods, shocks
from studies.kit.figure import below, errorbar, figure, look
from studies.kit.table import Tables

CASES = (*LAYERS, "highest Ra", *BOXES, "shear layer", "shock tube")
#: letter, shade and hatch of an outcome; the darker, the worse
LOOKS = {"right": ("R",
                   "white",
""), "wrong": ("W", "0.85", "/"), "leaks": ("L", "0.85", "\\"), "freezes": ("F", "0.7", "x"),
         "diverges": ("D", "0.5", ""), "refused": ("-", "white", ""), "unjudged": ("?", "white", "")}
WORDS = {"unjudged": "not judged, no two other grids came to their end, or noise"}
CLEAR = 0.2             # between scenes of one method, in rows


def figures(tables: Tables) -> dict[str, Figure]:
    """What the tables allow."""
    return {name: draw(*(tables[source] for source in sources)) for name, (draw, sources) in DRAWINGS.items()
            if all(len(tables.get(source, ())) for source in sources)}


# --- the map --------------------------------------------------------------------------------------


def chart(rows: pd.DataFrame, runs: pd.DataFrame) -> Figure:
    """Cells with the letter of the outcome and the number behind it."""
    rows = rows[rows["variant"] != "ends"]
    tube = rows["case"] == "shock tube"
    rows = rows.assign(case=rows["case"].where(~tube, rows["case"] + " " + rows["variant"]))
    cases = [case for name in CASES for case in sorted(set(rows["case"])) if case.startswith(name)]
    number_of = rows.groupby("method")["case"].nunique()
    methods = sorted(number_of.index, key=lambda method: (-number_of[method], method))
    page, axes = figure(width=1.5 + 0.95*len(cases), height=1.2 + 0.3*len(methods))
    for _, row in rows.iterrows():
        cell(axes, cases.index(row["case"]), methods.index(row["method"]), row)
    axes.set(xlim=(-0.5, len(cases) - 0.5), ylim=(len(methods) - 0.5, -0.5), yticks=range(len(methods)), yticklabels=methods)
    axes.set_xticks(range(len(cases)), fontsize=8, labels=[heading(case, runs) for case in cases])
    axes.grid(False)
    letters = [f"{LOOKS[name][0]}: {WORDS.get(name, name)}" for name in LOOKS if name in set(rows["outcome"])]
    axes.set_xlabel("  ".join(letters) + "  empty: not run\nnumber: flow over the start's, or over that of "
                                         "the grid of so many rows;\nvacuum: K over exact; corner: speed over "
                                         "sound's; shear: growth over linear; tube: ringing; highest Ra: the "
                                         "first that is wrong or ends")
    axes.set_title(f"Which method takes which hard case? Layers of {ROWS} rows")
    return page


def cell(axes: Any, x: int, y: int, row: pd.Series) -> None:
    """One method in one case."""
    letter, shade, hatch = LOOKS[row["outcome"]]
    axes.add_patch(Rectangle((x - 0.5, y - 0.5), 1, 1, facecolor=shade, edgecolor="0.6",
                              hatch=hatch, linewidth=0.5))
    shown = pd.notna(row["measured"]) and row["number"] != PART_OF_TIME
    value = f" {row['measured']:.2g}" if shown else ""
    axes.text(x, y, f"{letter}{value}", ha="center", va="center", fontsize=8,
              bbox={"facecolor": shade, "edgecolor": "none", "pad": 0.6})


def heading(case: str, runs: pd.DataFrame) -> str:
    """A case, and rows of the grid that it is held against."""
    grids = list(finished_grids(runs, case).index) if case in LAYERS else []
    return case.replace(" ", "\n", 1) + (f"\ngrid of {max(grids)}" if len(grids) else "")


def steadiness(rows: pd.DataFrame) -> Figure:
    """Swing of K in the last two quarters, and the part of the time that was reached, over rows."""
    page, (axes, end) = figure(1, 2)
    for number, (ra, some) in enumerate(rows.groupby("ra")):
        end.plot(some["rows"], some["reached"], label=f"Ra {ra:g}", **look(number))
        some = some.dropna(subset=["swing"])
        mean, half = (some["swing"] + some["before"])/2, (some["swing"] - some["before"]).abs()/2
        errorbar(axes, some["rows"].tolist(), mean.tolist(), half.tolist(), number=number, label=f"Ra {ra:g}")
    axes.axhline(0.01, color="black", linewidth=0.8)
    axes.set(xlabel="rows of the grid", ylabel="(largest - smallest K)/mean K", yscale="log",
             title="bars: from the last quarter to the one before")
    end.set(xlabel="rows of the grid", ylabel="part of the time that was reached", ylim=(0, 1.05))
    below(end, ncols=3)
    return page


# --- the highest Ra, steps ------------------------------------------------------------------------


def highest(rows: pd.DataFrame, summary: pd.DataFrame) -> Figure:
    """K over the fine grid's against Ra, and the part of the time that was reached."""
    page, (above, under) = figure(2, 1, width=6.4, height=2.9, sharex=True)
    for number, method in enumerate(METHODS):
        some = rows[(rows["method"] == method) & (rows["step"] == STEPS[0])].sort_values("ra")
        ra = 10**(0.01*number)*some["ra"]       # that marks on one another are seen
        style = {**look(number), "linestyle": "none", "markersize": 4}
        above.plot(ra, some["over"], **style, label=method)
        under.plot(ra, some["reached"], **style, label=method)
    for level in (OFF, 1/OFF):
        above.axhline(level, color="grey", linewidth=0.8)
    for axes in (above, under):
        axes.axvline(summary["predicted"].dropna().iloc[0], color="black", linestyle=":", linewidth=1)
    above.set(xscale="log", ylabel="K / K of 48 rows of the grid")
    under.set(xlabel="Ra", ylabel="part of the time reached")
    under.legend(loc="lower left")
    page.suptitle(f"How high may Ra be on 16 rows? Grey: a factor of {OFF:g};\n"
                  "dotted: cell number 2 of the fastest flow; all starts and trials", fontsize=10)
    return page


def limits(rows: pd.DataFrame) -> Figure:
    """Measured limits of the step over those of formulas, all methods."""
    page, (own, alone, exact) = figure(1, 3, width=3.9, height=4.4, sharey=True)
    methods = list(dict.fromkeys(rows["method"]))
    group = rows.groupby("method")["scene"]
    place = group.cumcount() - (group.transform("size") - 1)/2
    rows = rows.assign(at=rows["method"].map(methods.index) + CLEAR*place)
    for number, scene in enumerate(FLUIDS):
        some = rows[rows["scene"] == scene]
        for axes, column in ((own, "predicted"), (alone, "shorter"), (exact, "exact")):
            axes.errorbar(some["measured"]/some[column], some["at"], xerr=some["measured_err"]/some[column], label=scene,
                          **{**look(number), "linestyle": "none"})
    own.set(yticks=range(len(methods)), yticklabels=methods, xscale="log",
                             xlabel="measured / the method's own formula")
    own.set_xticks([1, 1.4, 2, 3, 5], labels=["1", "1.4", "2", "3", "5"])
    own.set_xticks([], minor=True)
    alone.set_xlabel("measured / for sound or diffusion alone")
    exact.set_xlabel("measured / by eigenvalues")
    for axes in (own, alone, exact):
        axes.axvline(1, color="black", linewidth=0.8)
        axes.axvspan(0.9, 1.1, color="0.9", zorder=0)
    own.invert_yaxis()
    page.legend(*own.get_legend_handles_labels(), loc="outside lower center", ncols=4)
    page.suptitle("At which step does noise begin to grow? Measured over predicted\nbars: half of the last "
                  "interval of the search, and growth that is too slow to be seen; grey: 10 %", fontsize=10)
    return page


DRAWINGS: dict[str, tuple[Any, tuple[str, ...]]] = {
    "map": (chart, ("map", "hard_runs")), "steadiness": (steadiness, ("steadiness",)),
    "high_ra": (highest, ("high_ra_trials", "high_ra_summary")), "limits": (limits, ("limits",)),
    "shocks": (shocks, ("tube_profiles", "ripples")),
    "shock_methods": (shock_methods, ("method_tubes", "method_tube_profiles", "tubes", "tube_profiles"))}
