"""Error against CPU seconds, from every table that has both: panels of series, and what errors cost.

A table takes part if it has the columns of REQUIRED; those of SCENE name its panels, those of SERIES its
series. What a level of error costs is read from the study's table `needed` where it has one.
"""
import math
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np
import pandas as pd

from studies.build import labels
from studies.report.inventory import Part, Sheet
from studies.report.levels import Need, by_runs, by_table, needed_of
from studies.report.numbers import percent, seconds, short

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
class Series:
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
    series: list[Series]
    needed: Sheet | None = None

    @property
    def scene(self) -> str:
        """The first words of the title."""
        return self.title.partition(",")[0]


def panels(known: list[Part]) -> list[Panel]:
    """All panels: the study of cost first, the scene with most panels, the panel with most series."""
    made = [panel for part in known for sheet in part.sheets for panel in of_sheet(sheet, needed_of(part))]
    scenes = Counter(panel.scene for panel in made)

    def rank(panel: Panel) -> tuple:
        long = sum(len(series.points) > 2 for series in panel.series)
        return (not panel.title.startswith("cost:"), -scenes[panel.scene], -long, panel.title)
    return sorted(made, key=rank)


def of_sheet(sheet: Sheet, needed: Sheet | None = None) -> Iterator[Panel]:
    """Panels of one table, if it is of this kind."""
    if not set(sheet.frame.columns) >= REQUIRED:
        return
    rows = with_quantity(sheet.frame)
    rows = rows[(rows["cpu_s"] > 0) & rows["error"].notna() & np.isfinite(rows["resolution"])]
    scenes = [name for name in SCENE if name in rows and (rows[name].nunique() > 1 or name in SAID)]
    common = {name: rows[name].mode().iloc[0] for name in scenes if name in UNSAID}
    for key, group in rows.groupby(scenes, sort=True):
        about = dict(zip(scenes, key))
        series = list(of_panel(group, None if needed is None else where(needed.frame, about)))
        if sum(len(one.points) > 1 for one in series) >= LEAST:
            words = [in_words(name, value) for name, value in about.items() if common.get(name) != value]
            yield Panel(f"{sheet.path.parent.name}: {', '.join(words)}", sheet, series, needed)


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


def of_panel(group: pd.DataFrame, needed: pd.DataFrame | None = None) -> Iterator[Series]:
    """Its series, the usual ones first."""
    names = [name for name in SERIES if name in group]
    made = []
    for key, rows in group.groupby(names, sort=True):
        about, rows = dict(zip(names, key)), rows.sort_values("resolution")
        needs = by_runs(rows) if needed is None else by_table(where(needed, about))
        points = [point(row) for row in rows.to_dict("records")]
        made.append(Series(label(about), family(str(about["method"])), points, needs))
    usual = usual_ones(made)
    yield from (replace(one, usual=True) for one in usual)
    yield from (one for one in made if one not in usual)


def usual_ones(made: list[Series]) -> list[Series]:
    """The cheapest of each family, and what is as printed."""
    long = [one for one in made if len(one.points) > 2] or made
    best: dict[str, Series] = {}
    for one in sorted(long, key=lambda one: one.rank):
        best.setdefault(one.family, one)
    printed = [one for one in made if "as printed" in one.label and one not in best.values()]
    return sorted([*best.values(), *printed][:MOST], key=lambda one: one.place)


def family(method: str) -> str:
    """How the name of a method begins; of one that is not known all of it."""
    return next((start for start in FAMILIES if method.startswith(start)), method)


def label(about: dict) -> str:
    """Words for a series: those that all studies use where there are some; only smooth particles have several energies."""
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
    words += [f"{short(count)} points"]*bool(count) + [f"commit {row['commit']}"]*bool(row.get("commit"))
    return Point(cpu, spread, size, err, row["error"] >= 0, words)


def finite(value: float) -> float:
    """The number, nothing for none."""
    return value if math.isfinite(value) else 0.0
