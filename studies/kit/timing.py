"""Measurement of run times: CPU seconds, with compile time apart."""
import statistics
import time
from collections.abc import Callable
from typing import Any, NamedTuple, TypeVar

import numpy as np
from scipy.special import stdtrit

from numba.core import event  # isort: skip

REPEATS = 7
#: half of the interquartile range of 7 repeats -> half width of the 95 % interval of their median:
#: t sqrt(pi/(2n)) for normal scatter, whose quartiles are midway between 0.757 and 0.353 sigma on average
SPREAD_TO_ERR = float(stdtrit(REPEATS - 1, 0.975)*np.sqrt(np.pi/(2*REPEATS))/((0.757 + 0.353)/2))
T = TypeVar("T")


class Seconds(NamedTuple):
    """Median of repeats and half of their interquartile range."""

    median: float
    spread: float


class _Compiling(event.Listener):
    """CPU seconds that this thread spends in numba's compiler; nested calls count once."""

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
    """Result of ``f()``, CPU seconds of compiling, and CPU seconds of everything else (all threads)."""
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
