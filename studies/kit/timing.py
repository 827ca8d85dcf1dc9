"""How long things take: CPU seconds, compiling apart; and whole studies, measured as they run, in times.csv.

    python -m studies.kit.timing STUDY ...      prints what these studies have still to do, in minutes of CPU
"""
import os
import statistics
import sys
import time
from collections.abc import Callable, Iterable, Sequence
from importlib import import_module
from pathlib import Path
from typing import Any, NamedTuple, TypeVar

import numpy as np
import pandas as pd
from scipy.special import stdtrit

from numba.core import event  # isort: skip

from studies.kit.case import Case
from studies.kit.csvfile import commit, cpu, put, read, versions
from studies.kit.store import kept, results, seconds
from studies.kit.table import check_size

REPEATS = 7
#: half of the interquartile range of 7 repeats -> half width of the 95 % interval of their median:
#: t sqrt(pi/(2n)) of a normal scatter, whose quartiles are on average 0.757 and 0.353 sigma off
SPREAD_TO_ERR = float(stdtrit(REPEATS - 1, 0.975)*np.sqrt(np.pi/(2*REPEATS))/((0.757 + 0.353)/2))
T = TypeVar("T")


class Seconds(NamedTuple):
    """Median of repeats and the half distance of their quartiles."""

    median: float
    spread: float


class _Compiling(event.Listener):
    """CPU seconds that this thread spends in numba's compiler; calls within a call count once."""

    def __init__(self) -> None:
        self.depth, self.started, self.seconds = 0, 0.0, 0.0

    def on_start(self, event):
        if self.depth == 0:
            self.started = time.thread_time()
        self.depth += 1

    def on_end(self, event):
        self.depth -= 1
        if self.depth == 0:
            self.seconds += time.thread_time() - self.started


def compile_and_run_seconds(f: Callable[[], T]) -> tuple[T, float, float]:
    """Result of ``f()``, CPU seconds of compiling, CPU seconds of everything else (all threads)."""
    compiling, begin = _Compiling(), time.process_time()
    with event.install_listener("numba:compile", compiling):
        result = f()
    return result, compiling.seconds, time.process_time() - begin - compiling.seconds


def median_seconds(f: Callable[[], Any], repeats: int = 7,
                   clock: Callable[[], float] = time.perf_counter) -> Seconds:
    """Seconds that ``f()`` takes, after one call that does not count (it may compile).

    ``clock=time.process_time`` counts the CPU time of all threads instead of the time that passes.

    Raises ValueError: Fewer than 3 repeats.
    """
    if repeats < 3:
        raise ValueError(f"repeats must be at least 3, got {repeats}: a median of fewer is no median")
    f()
    times = []
    for _ in range(repeats):
        begin = clock()
        f()
        times.append(clock() - begin)
    low, median, high = statistics.quantiles(times, n=4, method="inclusive")
    return Seconds(median, (high - low)/2)


# --- whole studies ---------------------------------------------------------------------------------

#: estimate_s: the cases' own, which need not be right; cpu_s: of all threads, compiling with it
COLUMNS = ["study", "size", "cases", "estimate_s", "cpu_s", "commit"]


def put_times(out: Path, study: str, size: str, cases: Sequence[Case]) -> None:
    """Replace the row of a study and size, all of whose cases are finished."""
    if not cases:
        return
    spent = sum(seconds(case, out/"raw"/study) for case in cases)
    estimate = sum(case.cost for case in cases)
    new = pd.DataFrame([[study, size, len(cases), estimate, spent, commit()]], columns=COLUMNS)
    put(out/"times.csv", new, by=["study", "size"], order=["study", "size"], head=[versions(), cpu()])


def left(study: str, cases: Iterable[Case], size: str, out: Path) -> tuple[int, float]:
    """How many cases have no result; their estimates, times what a whole run took over its own estimates.

    That run is of the same size, or the longest that was measured; without any, estimates stay as they are.
    """
    every = {case.key: case for case in cases}
    todo = [case.cost for case in every.values() if kept(case, out/"raw"/study) is None]
    times = read(out/"times.csv", COLUMNS) if (out/"times.csv").exists() else pd.DataFrame(columns=COLUMNS)
    runs = times.query("study == @study").sort_values("cpu_s")
    of_size = runs[runs["size"] == size]
    measured = runs if of_size.empty else of_size
    ratios = [1.0, *measured["cpu_s"]/measured["estimate_s"]]
    return len(todo), ratios[-1]*sum(todo)


def main(names: Sequence[str]) -> int:
    """The command line; 0, or 2 for an unknown size."""
    try:
        size = check_size(os.environ.get("SIZE") or "paper")
    except ValueError as error:
        print(f"hours: {error}", file=sys.stderr)
        return 2
    print(f"size {size}, what is left, in minutes of CPU:", flush=True)
    hours = 0.0
    for name in names:
        study = import_module(f"studies.{name}").STUDY
        todo, cpu_s = left(study.name, study.cases(size), size, results(size))
        hours += cpu_s/3600
        print(f"{name:<14}{todo:>5} cases {cpu_s/60:>6.1f} min", flush=True)
    print(f"together {hours:.1f} hours of CPU, {hours/2:.1f} on two cores; Ctrl-C keeps what is finished")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
