"""What a level of error costs: as the study has it in its table `needed`, else by the runs alone."""
from dataclasses import dataclass

import numpy as np
import pandas as pd

from studies.report.inventory import Part, Sheet
from studies.report.numbers import seconds, with_error

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


def needed_of(part: Part) -> Sheet | None:
    """The study's table of what a level of error costs."""
    sheets = [sheet for sheet in part.sheets if sheet.path.stem == "needed"]
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
