"""The largest stable time step by trial: bisection by whether noise grows."""
from collections.abc import Callable
from math import inf
from typing import Any, NamedTuple

import numpy as np

from particles.limits import limit_of

HALVINGS = 8            # of the factor 2 between a stable and an unstable step: to 0.3 %
WIDENINGS = 6           # factors of 2 on either side before the search gives up


class Unguarded:
    """A method whose time step is not checked against its limit; `integrator` replaces its own, if given."""

    def __init__(self, method: Any, integrator: Any = None):
        self.method = method
        if integrator is not None:
            self.integrator = integrator

    def __getattr__(self, name: str) -> Any:
        return getattr(self.method, name)


@limit_of.register
def _(method: Unguarded, start: np.ndarray) -> float:
    return inf


class Found(NamedTuple):
    """A limit and the half width of its interval; nan if none was found."""
    value: float
    half: float


def bisected(grows: Callable[[float], bool], first: float) -> Found:
    """The step above which `grows` is true: from `first` by factors of 2, then by bisecting the logarithm."""
    low, high = bracket(grows, first)
    for _ in range(HALVINGS if low < high else 0):
        middle = float(np.sqrt(low*high))
        low, high = (low, middle) if grows(middle) else (middle, high)
    return Found((low + high)/2, (high - low)/2)


def bracket(grows: Callable[[float], bool], first: float) -> tuple[float, float]:
    """Two steps a factor of 2 apart, `grows` false at the first and true at the second; nan if not found."""
    step, bad = first, grows(first)
    for _ in range(WIDENINGS):
        other = step/2 if bad else 2*step
        if grows(other) != bad:
            return (other, step) if bad else (step, other)
        step = other
    return np.nan, np.nan
