"""Error against CPU seconds, from every table that has both: panels of series of points, and what an error costs.

A table takes part if it has the columns of NEEDED; those of SCENE name its panels, those of SERIES the series within. What a
level of error costs is read from the study's table `needed` where it has one.
"""
import math
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
import pandas as pd

from studies.rb.figures.names import METHODS, WORDS
from studies.rb.looks import LABELS
from studies.report.behind import plain
from studies.report.found import Part, Sheet
from studies.report.needs import Need, given, needed_of, needs
from studies.report.numbers import percent, seconds, short

NEEDED = {"method", "resolution", "error", "error_err", "cpu_s"}
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
    """A run or the mean of runs: seconds, |error| and their intervals, and what is said about it."""

    cpu_s: float
    size: float
    low: float
    high: float
    fast: float
    slow: float
    above: bool
    told: list[str]


@dataclass(frozen=True)
class Series:
    """One method; the usual ones are shown at first. `needs`: level of error -> what it costs, of those that are reached."""

    label: str
    usual: bool
    points: list[Point]
    needs: dict[float, Need]


@dataclass(frozen=True)
class Panel:
    """One scene and quantity, and the table of what errors cost, if the study has one."""

    title: str
    sheet: Sheet
    series: list[Series]
    needed: Sheet | None = None


def panels(found: list[Part]) -> list[Panel]:
    """All panels, of the scene with most of them first, there those with most series; a study about speed before others."""
    made = [panel for part in found for sheet in part.sheets for panel in of_sheet(sheet, needed_of(part))]
    scenes = Counter(panel.title.partition(",")[0] for panel in made)
    return sorted(made, key=lambda panel: (not panel.sheet.name.startswith("speed/"), -scenes[panel.title.partition(",")[0]],
                                           -sum(len(series.points) > 2 for series in panel.series), panel.title))


def of_sheet(sheet: Sheet, needed: Sheet | None = None) -> Iterator[Panel]:
    """Panels of one table, if it is of this kind."""
    if not set(sheet.frame.columns) >= NEEDED:
        return
    rows = sheet.frame[(sheet.frame["cpu_s"] > 0) & sheet.frame["error"].notna() & np.isfinite(sheet.frame["resolution"])]
    if "quantity" not in rows:
        heat = rows.get("energy", pd.Series("", index=rows.index)).eq("Nu")
        rows = rows.assign(quantity=np.where(heat, "Nusselt number", "kinetic energy"))
    scenes = [name for name in SCENE if name in rows and (rows[name].nunique() > 1 or name in SAID)]
    common = {name: rows[name].mode().iloc[0] for name in scenes if name in UNSAID}
    for key, group in rows.groupby(scenes, sort=True):
        about = dict(zip(scenes, key))
        series = list(of_panel(group, None if needed is None else where(needed.frame, about)))
        if sum(len(one.points) > 1 for one in series) >= LEAST:
            words = [named(*pair) for pair in about.items() if common.get(pair[0]) != pair[1]]
            yield Panel(f"{sheet.path.parent.name}: {', '.join(words)}", sheet, series, needed)


def where(frame: pd.DataFrame, about: dict) -> pd.DataFrame:
    """Rows that have these values in the columns that there are."""
    for column in {*about} & {*frame.columns}:
        frame = frame[frame[column] == about[column]]
    return frame


def named(column: str, value: object) -> str:
    """A value of the scene's name: numbers with their column."""
    return f"{column.capitalize()} {value:g}" if isinstance(value, float | int) else f"{value}"


def of_panel(group: pd.DataFrame, needed: pd.DataFrame | None = None) -> Iterator[Series]:
    """Its series, the usual ones first."""
    names = [name for name in SERIES if name in group]
    made = []
    for key, rows in group.groupby(names, sort=True):
        about, rows = dict(zip(names, key)), rows.sort_values("resolution")
        made.append(Made(about, rows, needs(rows) if needed is None else given(where(needed, about))))
    usual = usual_ones(made)
    for one in (*usual, *(one for one in made if one not in usual)):
        yield Series(label(one.about), one in usual, [point(row) for row in one.rows.to_dict("records")], one.needs)


@dataclass(frozen=True, eq=False)
class Made:
    """A series before it is known whether it is shown at first."""

    about: dict
    rows: pd.DataFrame
    needs: dict[float, Need]

    @property
    def family(self) -> str:
        """How its method's name begins; of a method that is not known all of it."""
        name = str(self.about.get("method", ""))
        return next((start for start in FAMILIES if name.startswith(start)), label(self.about))

    @property
    def rank(self) -> tuple[int, float]:
        """Less for less seconds at the first level of DECIDE that it reaches, then for less error."""
        reached = [(number, self.needs[level].cpu_s) for number, level in enumerate(DECIDE) if level in self.needs]
        return reached[0] if reached else (len(DECIDE), float(self.rows["error"].abs().min()))

    @property
    def place(self) -> tuple:
        """Its place in the order of families."""
        return (FAMILIES.index(self.family) if self.family in FAMILIES else len(FAMILIES), self.rank)


def usual_ones(made: list[Made]) -> list[Made]:
    """Those that figures of convection know; in other tables the cheapest of each family, and what is as printed."""
    if known := [one for one in made if is_known(one.about)]:
        return known
    best: dict[str, Made] = {}
    for one in sorted([one for one in made if len(one.rows) > 2] or made, key=lambda one: one.rank):
        best.setdefault(one.family, one)
    chosen = [*best.values(), *(one for one in made if "as printed" in label(one.about) and one not in best.values())]
    return sorted(chosen[:MOST], key=lambda one: one.place)


def is_known(about: dict) -> bool:
    """Whether figures of convection have a look for it."""
    what = (about.get("method", ""), about.get("variant", ""))
    return what in METHODS or what == ("spam", "printed")


def label(about: dict) -> str:
    """Words for a series."""
    what = (about.get("method", ""), about.get("variant", ""))
    energy = LABELS.get(str(about.get("energy", "")).lower(), "") if about.get("method") == "spam" else ""
    if what in METHODS:
        words = METHODS[what][0]
    elif what == ("spam", "printed"):
        words = "smooth particles as printed"
    elif what[1] in WORDS:
        words = f"{WORDS[what[1]]} ({what[1]})"
    else:
        words = ", ".join(str(value) for name, value in about.items() if value and name != "energy")
    return plain(f"{words}: {energy}" if energy else words)


def point(row: dict) -> Point:
    """From a row of the table."""
    size, err, cpu = abs(row["error"]), finite(row["error_err"]), row["cpu_s"]
    spread = finite(row.get("cpu_s_err", 0.0))
    told = [f"{short(row['resolution'])} rows" if "ra" in row else f"resolution {short(row['resolution'])}",
            f"error {percent(row['error'])} ± {100*err:.2g} %",
            f"{seconds(cpu)} CPU seconds" + (f" ± {spread:.2g}" if spread else "")]
    count = row.get("particles") or row.get("points")
    told += [f"{short(count)} points"]*bool(count) + [f"commit {row['commit']}"]*bool(row.get("commit"))
    return Point(cpu, size, max(size - err, 0.0), size + err, max(cpu - spread, 0.0), cpu + spread, row["error"] >= 0, told)


def finite(value: float) -> float:
    """The number, nothing for none."""
    return value if math.isfinite(value) else 0.0
