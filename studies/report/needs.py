"""What a level of error costs: as the study has it in its table `needed`, else by the runs alone."""
from dataclasses import dataclass

import numpy as np
import pandas as pd

from studies.report.found import Part, Sheet
from studies.report.numbers import seconds, told

LEVELS = (0.1, 0.03, 0.01, 0.001)


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
        return told(self.cpu_s, (self.high - self.low)/2) if self.high > self.low else seconds(self.cpu_s)


def needed_of(part: Part) -> Sheet | None:
    """The study's table of what a level of error costs."""
    return next((sheet for sheet in part.sheets if sheet.path.stem == "needed"
                 and {"level", "reached", "cpu_s", "low", "high"} <= set(sheet.frame.columns)), None)


def needs(rows: pd.DataFrame) -> dict[float, Need]:
    """Level -> the coarsest run from which on error and interval stay below it with finer resolution."""
    worst, cpu = (rows["error"].abs() + rows["error_err"].fillna(0.0)).to_numpy(), rows["cpu_s"].to_numpy()
    below = np.maximum.accumulate(worst[::-1])[::-1]
    first = {level: int(np.argmax(below <= level)) for level in LEVELS if (below <= level).any()}
    return {level: Need(float(cpu[n]), float(cpu[n]), float(cpu[n]), n == 0) for level, n in first.items()}


def given(rows: pd.DataFrame) -> dict[float, Need]:
    """The same from the study's own table, which interpolates between runs."""
    there = rows[rows["reached"] != "no"].to_dict("records")
    return {row["level"]: Need(row["cpu_s"], row["low"], row["high"], row["reached"] == "at most") for row in there}


def said(need: Need | None) -> str:
    """Seconds for a level of error."""
    return "—" if need is None else f"{need}"
