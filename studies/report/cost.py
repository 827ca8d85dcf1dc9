"""Error against CPU seconds, from every table that has both: panels of series, and what errors cost.

A table takes part if it has the columns of REQUIRED; those of SCENE name panels, those of SERIES lines.
What a level of error costs is read from the study's table `needed`, or follows from the runs alone.
"""
import math
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np
import pandas as pd

from studies.build import labels
from studies.report.inventory import Folder, Sheet
from studies.report.numbers import percent, seconds, short, with_error

REQUIRED = {"method", "resolution", "error", "error_err", "cpu_s"}
SCENE = ("scene", "eos", "transport", "sides", "ra", "pr", "quantity")
SERIES = ("method", "variant", "weight", "integrator", "energy")
#: of the scene, not said where it is as in most rows
UNSAID = ("eos", "transport", "sides", "pr")
#: said even if it is the same in all rows
SAID = ("scene", "quantity")
#: series of two points or more from which on a panel is worth showing; series of a table shown at first
LEAST, MOST = 3, 8
#: kinds of methods by how their names begin, in the order of the page
FAMILIES = ("compressible", "MAC", "DIH lattice", "DIH Delaunay", "moving", "SPAM", "py-pde")
#: levels at which members of a family are compared: the first that one of them reaches
DECIDE = (0.01, 0.03, 0.1)
#: of error, whose cost is told; columns of the table that tells it
LEVELS = (0.1, 0.03, 0.01, 0.001)
NEEDED = {"level", "reached", "cpu_s", "low", "high"}


@dataclass(frozen=True)
class Need:
    """CPU seconds with their interval; at most these where the coarsest run has the error already."""

    cpu_s: float
    low: float
    high: float
    at_most: bool = False

    def __str__(self) -> str:
        if self.at_most:
            return f"≤ {seconds(self.cpu_s)}"
        if self.high > 2*self.low:
            return f"{seconds(self.low)} to {seconds(self.high)}"
        if self.high > self.low:
            return with_error(self.cpu_s, (self.high - self.low)/2)
        return seconds(self.cpu_s)


@dataclass(frozen=True)
class Point:
    """A run or a mean of runs: seconds, |error|, their intervals, whether it is too large, and words."""

    cpu_s: float
    spread: float
    size: float
    err: float
    above: bool
    words: list[str]


@dataclass(frozen=True)
class Line:
    """One method; the usual ones are shown at first. needs : level of error -> what it costs."""

    label: str
    family: str
    points: list[Point]
    needs: dict[float, Need]
    usual: bool = False

    @property
    def rank(self) -> tuple[int, float]:
        """Less for less seconds at the first level of DECIDE that it reaches, then for less error."""
        for number, level in enumerate(DECIDE):
            if level in self.needs:
                return number, self.needs[level].cpu_s
        return len(DECIDE), min(point.size for point in self.points)

    @property
    def place(self) -> tuple[int, tuple[int, float]]:
        """Its place in the order of families."""
        return (FAMILIES.index(self.family) if self.family in FAMILIES else len(FAMILIES)), self.rank


@dataclass(frozen=True)
class Panel:
    """One scene and quantity, and the table of what errors cost, if the study has one."""

    title: str
    sheet: Sheet
    lines: list[Line]
    needed: Sheet | None = None

    @property
    def scene(self) -> str:
        """The first words of the title."""
        return self.title.partition(",")[0]


def panels(folders: list[Folder]) -> list[Panel]:
    """All panels: the study of cost first, the scene with most panels, the panel with most series."""
    made = [panel for folder in folders for sheet in folder.sheets
            for panel in of_sheet(sheet, needed_of(folder))]
    scenes = Counter(panel.scene for panel in made)

    def rank(panel: Panel) -> tuple:
        long = sum(len(line.points) > 2 for line in panel.lines)
        return (not panel.title.startswith("cost:"), -scenes[panel.scene], -long, panel.title)
    return sorted(made, key=rank)


def of_sheet(sheet: Sheet, needed: Sheet | None = None) -> Iterator[Panel]:
    """Panels of one table, if it is of this kind."""
    if not set(sheet.frame.columns) >= REQUIRED:
        return
    rows = with_quantity(sheet.frame)
    rows = rows[(rows["cpu_s"] > 0) & rows["error"].notna() & np.isfinite(rows["resolution"])]
    scenes = [name for name in SCENE if name in rows and (name in SAID or rows[name].nunique() > 1)]
    common = {name: rows[name].mode().iloc[0] for name in scenes if name in UNSAID}
    for key, group in rows.groupby(scenes, sort=True):
        about = dict(zip(scenes, key))
        lines = of_panel(group, where(needed.frame, about) if needed else None)
        if sum(len(line.points) > 1 for line in lines) >= LEAST:
            words = [in_words(name, value) for name, value in about.items() if common.get(name) != value]
            yield Panel(f"{sheet.path.parent.name}: {', '.join(words)}", sheet, lines, needed)


def with_quantity(rows: pd.DataFrame) -> pd.DataFrame:
    """Rows with the quantity that is measured, which rb's table tells by its column `energy`."""
    if "quantity" in rows:
        return rows
    heat = rows["energy"].eq("Nu") if "energy" in rows else False
    return rows.assign(quantity=np.where(heat, "Nusselt number", "kinetic energy"))


def where(frame: pd.DataFrame, about: dict) -> pd.DataFrame:
    """Rows that have these values in the columns that there are."""
    for column in {*about} & {*frame.columns}:
        frame = frame[frame[column] == about[column]]
    return frame


def in_words(column: str, value: object) -> str:
    """A value of the scene's name: numbers with their column."""
    return f"{column.capitalize()} {value:g}" if isinstance(value, float | int) else f"{value}"


def of_panel(group: pd.DataFrame, needed: pd.DataFrame | None = None) -> list[Line]:
    """Its lines, the usual ones first."""
    names = [name for name in SERIES if name in group]
    lines = []
    for key, rows in group.groupby(names, sort=True):
        about, rows = dict(zip(names, key)), rows.sort_values("resolution")
        needs = by_runs(rows) if needed is None else by_table(where(needed, about))
        points = [point(row) for row in rows.to_dict("records")]
        lines.append(Line(label(about), family(str(about["method"])), points, needs))
    usual = usual_ones(lines)
    return [*(replace(line, usual=True) for line in usual), *(line for line in lines if line not in usual)]


def usual_ones(lines: list[Line]) -> list[Line]:
    """The cheapest of each family, and what is as printed."""
    long = [line for line in lines if len(line.points) > 2] or lines
    best: dict[str, Line] = {}
    for line in sorted(long, key=lambda line: line.rank):
        best.setdefault(line.family, line)
    printed = [line for line in lines if "as printed" in line.label and line not in best.values()]
    return sorted([*best.values(), *printed][:MOST], key=lambda line: line.place)


def family(method: str) -> str:
    """How the name of a method begins; of one that is not known all of it."""
    return next((start for start in FAMILIES if method.startswith(start)), method)


def label(about: dict) -> str:
    """Words for a line: the label where there is one; only smooth particles have several energies."""
    named = labels.label(about["method"], about.get("variant", ""))
    if named and about["method"] != "spam":
        return named
    words = {**about, "method": named, "variant": ""} if named else about
    return ", ".join(str(value) for value in words.values() if value)


def point(row: dict) -> Point:
    """From a row of the table."""
    size, err, cpu = abs(row["error"]), finite(row["error_err"]), row["cpu_s"]
    spread = finite(row.get("cpu_s_err", 0.0))
    count = row.get("particles") or row.get("points")
    words = [f"resolution {short(row['resolution'])}", f"error {percent(row['error'])} ± {100*err:.2g} %",
             f"{seconds(cpu)} CPU seconds" + (f" ± {spread:.2g}" if spread else "")]
    if count:
        words.append(f"{short(count)} points")
    if row.get("commit"):
        words.append(f"commit {row['commit']}")
    return Point(cpu, spread, size, err, row["error"] >= 0, words)


def finite(value: float) -> float:
    """The number, nothing for none."""
    return value if math.isfinite(value) else 0.0


def needed_of(folder: Folder) -> Sheet | None:
    """The study's table of what a level of error costs."""
    sheets = [sheet for sheet in folder.sheets if sheet.path.stem == "needed"]
    return next((sheet for sheet in sheets if set(sheet.frame.columns) >= NEEDED), None)


def by_runs(rows: pd.DataFrame) -> dict[float, Need]:
    """Level -> the coarsest run from which on error and interval stay below it with finer resolution."""
    size = rows["error"].abs() + rows["error_err"].fillna(0.0)
    worst = np.maximum.accumulate(size.to_numpy()[::-1])[::-1]      # of this run and all finer ones
    needs = {}
    for level in LEVELS:
        below = rows["cpu_s"].to_numpy()[worst <= level]
        if len(below):
            needs[level] = Need(below[0], below[0], below[0], len(below) == len(rows))
    return needs


def by_table(rows: pd.DataFrame) -> dict[float, Need]:
    """The same from the study's own table, which interpolates between runs."""
    reached = rows[rows["reached"] != "no"]
    at_most = reached["reached"] == "at most"
    columns = (reached[name] for name in ("level", "cpu_s", "low", "high"))
    return {level: Need(*numbers) for level, *numbers in zip(*columns, at_most, strict=True)}
