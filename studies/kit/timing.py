"""Measurement of run times: CPU seconds, with compile time apart."""
import time
from collections.abc import Callable, Sequence
from typing import Any, TypeVar

import numpy as np
from scipy.special import stdtrit

from continuum.jit import compiling
from studies.kit.stats import Measured

REPEATS = 7
#: half of the interquartile range of 7 repeats -> half width of the 95 % interval of their median:
#: t sqrt(pi/(2n)) for normal scatter, whose quartiles are midway between 0.757 and 0.353 sigma on average
SPREAD_TO_ERR = float(stdtrit(REPEATS - 1, 0.975)*np.sqrt(np.pi/(2*REPEATS))/((0.757 + 0.353)/2))
T = TypeVar("T")


def compile_and_run_seconds(f: Callable[[], T]) -> tuple[T, float, float]:
    """Result of ``f()``, CPU seconds of compiling, and CPU seconds of everything else (all threads)."""
    begin = time.process_time()
    with compiling() as late:
        result = f()
    return result, late.seconds, time.process_time() - begin - late.seconds


def took(f: Callable[[], Any], clock: Callable[[], float] = time.process_time) -> float:
    """Seconds of a call."""
    began = clock()
    f()
    return clock() - began


def median(seconds: Sequence[float] | np.ndarray) -> Measured:
    """Median of repeats, with its error from their quartiles and number."""
    low, middle, high = np.percentile(seconds, [25, 50, 75])
    to_err = SPREAD_TO_ERR*np.sqrt(REPEATS/len(seconds))
    return Measured(float(middle), float(to_err*(high - low)/2))


def of_calls(f: Callable[[], Any]) -> Measured:
    """Median CPU seconds of a call that was made before, so that all is compiled."""
    return median([took(f) for _ in range(REPEATS)])
