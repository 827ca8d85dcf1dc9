"""Error against CPU seconds, from every table that has both: panels of series, and what errors cost.

A table takes part if it has the columns of REQUIRED; those of SCENE name panels, those of SERIES lines.
What a level of error costs is read from the study's table `needed`, or follows from the runs alone.
"""
from collections import Counter
from collections.abc import Iterator
from typing import NamedTuple

import numpy as np
import pandas as pd

from studies.build.words import name_of
from studies.report.inventory import Folder, Sheet, having, place
from studies.report.numbers import seconds, with_error

REQUIRED = {"method", "resolution", "error", "error_err", "cpu_s"}
SCENE = ("scene", "eos", "transport", "sides", "ra", "pr", "quantity")
SERIES = ("method", "variant", "weight", "integrator", "energy")
#: of the scene, not said where it is as in most rows
UNSAID = ("eos", "transport", "sides", "pr")
#: said even if it is the same in all rows
SAID = ("scene", "quantity")
#: series of two points or more from which on a panel is worth showing
LEAST = 3
#: series of a panel shown at first
MOST = 8
#: kinds of methods by how their names begin, in the order of the page
FAMILIES = ("grid", "mac", "fixed-lattice", "fixed-jittered", "fixed-random", "relaxed", "moving", "spam",
            "py-pde")
#: the schemes of both papers as printed
PRINTED = ("spam", "moving-literal")
#: levels at which members of a family are compared: the first that one of them reaches
DECIDE = (0.01, 0.03, 0.1)
#: of error, whose cost is told; columns of the table that tells it
LEVELS = (0.1, 0.03, 0.01, 0.001)
NEEDED = {"level", "reached", "cpu_s", "low", "high"}


class Need(NamedTuple):
    """CPU seconds with their interval; at most these where the coarsest run has the error already."""
    cpu_s: float
    low: float
    high: float
    at_most: bool

    def __str__(self) -> str:
        if self.at_most:
            return f"≤ {seconds(self.cpu_s)}"
        if self.high > 2*self.low:
            return f"{seconds(self.low)} to {seconds(self.high)}"
        if self.high > self.low:
            return with_error(self.cpu_s, (self.high - self.low)/2)
        return seconds(self.cpu_s)


class Point(NamedTuple):
    """A run or a mean of runs: seconds and error with their intervals; commit of the row."""
    resolution: float
    cpu_s: float
    spread: float
    error: float
    err: float
    particles: float | None
    commit: str

    @property
    def size(self) -> float:
        """|error|"""
        return abs(self.error)


class Line(NamedTuple):
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
    def order(self) -> tuple[int, tuple[int, float]]:
        """By families, in each by rank."""
        return place(self.family, FAMILIES), self.rank


class Panel(NamedTuple):
    """One scene and quantity of a study, and the table of what errors cost, if the study has one."""
    study: str
    words: list[str]
    lines: list[Line]
    sheet: Sheet
    needed: Sheet | None

    @property
    def scene(self) -> str:
        """What is computed."""
        return ", ".join(self.words)

    @property
    def title(self) -> str:
        """Study and scene."""
        return f"{self.study}: {self.scene}"


def panels(folders: list[Folder]) -> list[Panel]:
    """All panels: the study of cost first, the scene with most panels, the panel with most series."""
    made: list[Panel] = []
    for folder in folders:
        needed = needed_of(folder)
        for sheet in folder.sheets:
            made += of_sheet(sheet, needed)
    scenes = Counter((panel.study, panel.words[0]) for panel in made)

    def rank(panel: Panel) -> tuple:
        long = sum(len(line.points) > 2 for line in panel.lines)
        alike = scenes[panel.study, panel.words[0]]
        return panel.study != "cost", -alike, -long, panel.title
    return sorted(made, key=rank)


def needed_of(folder: Folder) -> Sheet | None:
    """The study's table of what a level of error costs."""
    told = (sheet for sheet in folder.sheets if sheet.stem == "needed")
    return next((sheet for sheet in told if NEEDED.issubset(sheet.frame)), None)


def of_sheet(sheet: Sheet, needed: Sheet | None) -> Iterator[Panel]:
    """Panels of one table, if it is of this kind."""
    if not REQUIRED.issubset(sheet.frame):
        return
    rows = usable(sheet.frame)
    there = [name for name in SCENE if name in rows]
    scenes = [name for name in there if name in SAID or rows[name].nunique() > 1]
    unsaid = {name: rows[name].mode().iloc[0] for name in scenes if name in UNSAID}
    for key, group in rows.groupby(scenes):
        about = dict(zip(scenes, key))
        costs = having(needed.frame, about) if needed else None
        lines = of_panel(group, costs)
        series = [line for line in lines if len(line.points) > 1]
        if len(series) >= LEAST:
            said = {name: value for name, value in about.items() if unsaid.get(name) != value}
            words = [in_words(name, value) for name, value in said.items()]
            yield Panel(sheet.path.parent.name, words, lines, sheet, needed)


def usable(rows: pd.DataFrame) -> pd.DataFrame:
    """Rows with seconds, an error and a resolution, and the quantity, which rb tells by its `energy`."""
    there = rows["error"].notna() & np.isfinite(rows["resolution"])
    rows = rows[there & (rows["cpu_s"] > 0)].fillna({"error_err": 0.0, "cpu_s_err": 0.0})
    if "quantity" in rows:
        return rows
    heat = rows["energy"].eq("Nu") if "energy" in rows else False
    return rows.assign(quantity=np.where(heat, "Nusselt number", "kinetic energy"))


def in_words(column: str, value: object) -> str:
    """A value of the scene's name: numbers with their column."""
    if isinstance(value, float | int):
        return f"{column.capitalize()} {value:g}"
    return str(value)


def of_panel(group: pd.DataFrame, needed: pd.DataFrame | None) -> list[Line]:
    """Its lines, the usual ones first."""
    lines = list(lines_of(group, needed))
    usual = usual_ones(lines)
    shown = [line._replace(usual=True) for line in usual]
    return shown + [line for line in lines if line not in usual]


def lines_of(group: pd.DataFrame, needed: pd.DataFrame | None) -> Iterator[Line]:
    """A line for each method; what errors cost from the table that tells it, else from the runs."""
    names = [name for name in SERIES if name in group]
    for key, rows in group.groupby(names):
        about = dict(zip(names, key))
        rows = rows.sort_values("resolution")
        if needed is None:
            needs = by_runs(rows)
        else:
            needs = by_table(having(needed, about))
        points = [point(row) for row in rows.to_dict("records")]
        words = label(about)
        yield Line(words, family(words), points, needs)


def usual_ones(lines: list[Line]) -> list[Line]:
    """The cheapest of each family, and what is as printed."""
    long = [line for line in lines if len(line.points) > 2] or lines
    cheapest: dict[str, Line] = {}
    for line in sorted(long, key=lambda line: line.rank):
        cheapest.setdefault(line.family, line)
    usual = list(cheapest.values())
    printed = [line for line in lines if line.label.split(",")[0] in PRINTED]
    usual += [line for line in printed if line not in usual]
    return sorted(usual[:MOST], key=lambda line: line.order)


def family(method: str) -> str:
    """How the name of a method begins; of one that is not known all of it."""
    return next((start for start in FAMILIES if method.startswith(start)), method)


def label(about: dict) -> str:
    """The name of a line's method where it has one; only smooth particles have several energies."""
    method = about["method"]
    name = name_of(method, about.get("variant", ""))
    if name and method != "spam":
        return name
    if name:
        about = {**about, "method": name, "variant": ""}
    return ", ".join(str(value) for value in about.values() if value)


def point(row: dict) -> Point:
    """From a row of the table."""
    return Point(
        resolution=row["resolution"],
        cpu_s=row["cpu_s"],
        spread=row.get("cpu_s_err", 0.0),
        error=row["error"],
        err=row["error_err"],
        particles=row.get("particles") or row.get("points"),
        commit=row.get("commit", ""))


def by_runs(rows: pd.DataFrame) -> dict[float, Need]:
    """Level -> the coarsest run from which on error and interval stay below it with finer resolution."""
    size = rows["error"].abs() + rows["error_err"]
    worst = size[::-1].cummax()[::-1]       # of this run and all finer ones
    needs = {}
    for level in LEVELS:
        below = rows["cpu_s"][worst <= level]
        if len(below):
            cpu = below.iloc[0]
            needs[level] = Need(cpu, cpu, cpu, at_most=len(below) == len(rows))
    return needs


def by_table(rows: pd.DataFrame) -> dict[float, Need]:
    """The same from the study's own table, which interpolates between runs."""
    needs = {}
    for row in rows[rows["reached"] != "no"].to_dict("records"):
        at_most = row["reached"] == "at most"
        needs[row["level"]] = Need(row["cpu_s"], row["low"], row["high"], at_most)
    return needs
