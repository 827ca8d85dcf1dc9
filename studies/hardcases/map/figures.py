"""The map: case by method, outcome by letter and shade."""
import pandas as pd
from matplotlib.figure import Figure
from matplotlib.patches import Rectangle

from studies.hardcases.map.derive import PART_OF_TIME, finished_grids
from studies.hardcases.map.scenes import BOXES, LAYERS, ROWS
from studies.kit.figure import below, errorbar, figure, look
from studies.kit.table import Tables

CASES = (*LAYERS, "highest Ra", *BOXES, "shear layer", "shock tube")
#: letter, shade and hatch of an outcome; the darker, the worse
LOOKS = {"right": ("R", "white", ""), "safe": ("s", "white", "."), "wrong": ("W", "0.85", "/"), "leaks": ("L", "0.85", "\\"),
         "freezes": ("F", "0.7", "x"), "pairs": ("P", "0.7", "o"), "clumps": ("C", "0.7", "O"), "diverges": ("D", "0.5", ""),
         "refused": ("-", "white", ""), "unjudged": ("?", "white", "")}
WORDS = {"unjudged": "not judged, no two other grids came to their end, or noise"}


def figures(tables: Tables) -> dict[str, Figure]:
    """The map of runs, and how steady the grid is."""
    drawn = {}
    table, steadiness = tables.get("map"), tables.get("steadiness")
    if table is not None and len(rows := table[table["case"].isin(CASES) & (table["variant"] != "ends")]):
        drawn["map"] = chart(rows, references(tables.get("hard_runs")))
    if steadiness is not None and len(steadiness):
        drawn["steadiness"] = swings(steadiness)
    return drawn


def references(runs: pd.DataFrame | None) -> dict[str, int]:
    """Rows of the finest grid that came to its end, which flows of a layer are held against."""
    grids = {case: finished_grids(runs, case) for case in LAYERS} if runs is not None else {}
    return {case: int(flows.index.max()) for case, flows in grids.items() if len(flows)}


def chart(rows: pd.DataFrame, fine: dict[str, int]) -> Figure:
    """Cells with the letter of the outcome and the number behind it; fine : rows of the grid that a case is held against."""
    tube = rows["case"] == "shock tube"
    rows = rows.assign(case=rows["case"].where(~tube, rows["case"] + " " + rows["variant"]))
    cases = [case for name in CASES for case in sorted(set(rows["case"])) if case.startswith(name)]
    methods = sorted(set(rows["method"]), key=lambda method: (-rows[rows["method"] == method]["case"].nunique(), method))
    page, axes = figure(width=1.5 + 0.95*len(cases), height=1.2 + 0.3*len(methods))
    for _, row in rows.iterrows():
        letter, shade, hatch = LOOKS[row["outcome"]]
        x, y = cases.index(row["case"]), methods.index(row["method"])
        axes.add_patch(Rectangle((x - 0.5, y - 0.5), 1, 1, facecolor=shade, edgecolor="0.6", hatch=hatch, linewidth=0.5))
        shown = pd.notna(row["measured"]) and row["number"] != PART_OF_TIME
        value = f" {row['measured']:.2g}" if shown else ""
        axes.text(x, y, f"{letter}{value}", ha="center", va="center", fontsize=8,
                  bbox={"facecolor": shade, "edgecolor": "none", "pad": 0.6})
    axes.set(xlim=(-0.5, len(cases) - 0.5), ylim=(len(methods) - 0.5, -0.5), yticks=range(len(methods)), yticklabels=methods)
    axes.set_xticks(range(len(cases)), fontsize=8, labels=[
        case.replace(" ", "\n", 1) + (f"\ngrid of {fine[case]}" if case in fine else "") for case in cases])
    axes.grid(False)
    seen = [name for name in LOOKS if name in set(rows["outcome"])]
    axes.set_xlabel("  ".join(f"{LOOKS[name][0]}: {WORDS.get(name, name)}" for name in seen) + "  empty: not run"
                    "\nnumber: flow over the start's, or over that of the grid of so many rows;\n"
                    "vacuum: K over exact; corner: speed over sound's; shear: growth over linear; tube: ringing; "
                    "highest Ra: the first that is wrong or ends")
    axes.set_title(f"Which method takes which hard case? Layers of {ROWS} rows")
    return page


def swings(rows: pd.DataFrame) -> Figure:
    """Swing of K against rows, in the last quarter and in the one before, and the part of the time that was reached."""
    page, (axes, end) = figure(1, 2)
    rows = rows[rows["step"] == 1]
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
