"""Error against CPU seconds, from every table that has both: panels of series of points, and what an error costs.

A table takes part if it has the columns of NEEDED; those of SCENE name its panels, those of SERIES the series within.
"""
import math
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
import pandas as pd

from studies.convection.figures_names import METHODS, WORDS
from studies.convection.pick import LABELS
from studies.report.behind import plain
from studies.report.found import Part, Sheet
from studies.report.numbers import percent, seconds, short, signed

NEEDED = {"method", "resolution", "error", "error_err", "cpu_s"}
SCENE = ("scene", "eos", "transport", "sides", "ra", "pr", "quantity")
SERIES = ("method", "variant", "weight", "integrator", "energy")
LEVELS = (0.1, 0.03, 0.01, 0.001)
#: of the scene, not said where it is as in most rows
UNSAID = ("eos", "transport", "sides", "pr")
#: said even if it is the same in all rows
SAID = ("scene", "quantity")
#: series of two points or more from which on a panel is worth showing
LEAST = 3


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
    """One method; the usual ones are shown at first."""

    label: str
    usual: bool
    points: list[Point]
    #: level of error -> seconds of the coarsest run from which on all are below it, with their intervals
    needs: dict[float, float]


@dataclass(frozen=True)
class Panel:
    """One scene and quantity."""

    title: str
    sheet: Sheet
    series: list[Series]


def panels(found: list[Part]) -> list[Panel]:
    """All panels, those with most series first; of a study about speed before the others."""
    made = [panel for part in found for sheet in part.sheets for panel in of_sheet(sheet)]
    return sorted(made, key=lambda panel: (not panel.sheet.name.startswith("speed/"),
                                           -sum(len(series.points) > 2 for series in panel.series), panel.title))


def of_sheet(sheet: Sheet) -> Iterator[Panel]:
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
        series, about = list(of_panel(group)), dict(zip(scenes, key))
        if sum(len(one.points) > 1 for one in series) >= LEAST:
            words = [named(*pair) for pair in about.items() if common.get(pair[0]) != pair[1]]
            yield Panel(f"{sheet.path.parent.name}: {', '.join(words)}", sheet, series)


def named(column: str, value: object) -> str:
    """A value of the scene's name: numbers with their column."""
    return f"{column.capitalize()} {value:g}" if isinstance(value, float | int) else f"{value}"


def of_panel(group: pd.DataFrame) -> Iterator[Series]:
    """Its series, the usual ones first."""
    names = [name for name in SERIES if name in group]
    made = []
    for key, rows in group.groupby(names, sort=True):
        about = dict(zip(names, key))
        rows = rows.sort_values("resolution")
        made.append((about, rows))
    usual = usual_ones(made)
    for number in sorted(range(len(made)), key=lambda n: (n not in usual, n)):
        about, rows = made[number]
        yield Series(label(about), number in usual, [point(row) for row in rows.to_dict("records")], needs(rows))


def usual_ones(made: list[tuple[dict, pd.DataFrame]]) -> set[int]:
    """Those that figures know; in a table of others all with three points or more, at most eight."""
    known = {n for n, (about, _) in enumerate(made) if is_known(about)}
    return known or set([n for n, (_, rows) in enumerate(made) if len(rows) > 2][:8]) or set(range(min(8, len(made))))


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


def needs(rows: pd.DataFrame) -> dict[float, float]:
    """Level -> CPU seconds from which on error and interval stay below it with finer resolution."""
    worst = (rows["error"].abs() + rows["error_err"].fillna(0.0)).to_numpy()
    below = np.maximum.accumulate(worst[::-1])[::-1]
    return {level: float(rows["cpu_s"].to_numpy()[np.argmax(below <= level)]) for level in LEVELS if (below <= level).any()}


def said(level: float, cpu: float | None) -> str:
    """Seconds for a level of error."""
    return signed("—") if cpu is None else seconds(cpu)
