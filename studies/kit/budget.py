"""CPU seconds of whole studies: measured as they run, in times.csv, and expected of what is left.

    python -m studies.kit.budget STUDY ...      prints what these studies have still to do, in minutes of CPU
"""
import math
import os
import sys
from collections.abc import Iterable, Sequence
from importlib import import_module
from pathlib import Path
from typing import NamedTuple

import pandas as pd

from studies.kit.case import Case
from studies.kit.csvfile import commit, cpu, put, read, versions
from studies.kit.store import results, seconds
from studies.kit.table import check_size

#: estimate_s: the cases' own, which need not be right; cpu_s: of all threads, compiling with it
COLUMNS = ("study", "size", "cases", "estimate_s", "cpu_s", "commit")


def put_times(out: Path, study: str, size: str, cases: Sequence[Case]) -> None:
    """Replace the row of a study and size, if each of its cases is finished and was measured."""
    spent = sum(seconds(case, out/"raw"/study) for case in cases)
    if not cases or math.isnan(spent):
        return
    estimate = sum(case.cost for case in cases)
    values = study, size, len(cases), estimate, spent, commit()
    new = pd.DataFrame([values], columns=list(COLUMNS))
    put(out/"times.csv", new, by=["study", "size"], order=["study", "size"], head=[versions(), cpu()])


def times(out: Path) -> pd.DataFrame:
    """What was measured; no rows where nothing was."""
    path = out/"times.csv"
    return read(path, COLUMNS) if path.exists() else pd.DataFrame(columns=list(COLUMNS))


class Left(NamedTuple):
    """Cases to do, of how many; expected CPU seconds; whether a whole run of the study was measured."""

    study: str
    todo: int
    cases: int
    cpu_s: float
    measured: bool

    def __str__(self) -> str:
        line = f"{self.study:<14}{self.todo:>5} of {self.cases:<5}cases {self.cpu_s/60:>6.1f} min"
        return line if self.measured else f"{line} (estimated)"


def left(study: str, cases: Iterable[Case], size: str, out: Path) -> Left:
    """The estimates of cases without result, times what a whole run took over its own estimates.

    That run is of the same size, or the longest that was measured; without any, estimates stay as they are.
    """
    every = {case.key: case for case in cases}
    raw = out/"raw"/study
    todo = [case for key, case in every.items() if not (raw/f"{key}.json").exists()]
    runs = times(out).query("study == @study").sort_values("cpu_s")
    of_size = runs[runs["size"] == size]
    measured = runs if of_size.empty else of_size
    ratios = (measured["cpu_s"]/measured["estimate_s"]).tolist() or [1.0]
    cpu_s = ratios[-1]*sum(case.cost for case in todo)
    return Left(study, len(todo), len(every), cpu_s, not measured.empty)


def main(names: Sequence[str]) -> int:
    """The command line; 0, or 2 for an unknown size or a table of another layout."""
    size = os.environ.get("SIZE") or "paper"
    try:
        times(results(check_size(size)))
    except ValueError as error:
        print(f"hours: {error}", file=sys.stderr)
        return 2
    print(f"size {size}, what is left, in minutes of CPU:", flush=True)
    hours = 0.0
    for name in names:
        study = import_module(f"studies.{name}").STUDY
        one = left(study.name, study.cases(size), size, results(size))
        hours += one.cpu_s/3600
        print(one, flush=True)
    print(f"together {hours:.1f} hours of CPU, {hours/2:.1f} on two cores; Ctrl-C keeps what is finished")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
