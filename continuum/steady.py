"""Runs of grids: rules that stop them by their samples of K, their time step, results, Newton's method."""
from collections import namedtuple
from collections.abc import Callable
from dataclasses import dataclass, field
from math import ceil
from typing import Any

import numpy as np

SAFETY = 0.8  # default time step over the stability limit at the start
SMALL = 1e-9  # remaining change of K that is negligible; K of convection is 1e-3
STILL = 1e-12  # largest K that counts as rest; 0.3 % above onset rolls already have 1e-5
WITHIN = 1e-9  # largest change in the last step of Newton's method; the error is about its square
STEPS = 60  # at most, of Newton's method: the slowest converged case took 46 (cavity at Ra = 1e7, 64 rows)
RK4_SOUND, RK4_DECAY = 2.82, 2.78  # ends of RK4's stability region on the imaginary and the real axis


class NewtonFailed(RuntimeError):
    """No steady state was found; the message gives the changes of the last steps."""


#: Time series: K, Nusselt number of the lower plate, mean density.
Series = namedtuple("Series", "t ke nu mass")


@dataclass(frozen=True, kw_only=True)
class GridRun:
    """Result of a run in time.

    `ke`, `ke_err` : K at the end and its error, as the rule that stopped the run estimates them.
    """
    series: Series = field(repr=False)
    ke: float
    ke_err: float
    converged: bool
    rolls: int
    dt: float
    steps: int
    cpu_s: float
    compile_s: float

    @property
    def t(self) -> float:
        return float(self.series.t[-1])

    @property
    def mass_drift(self) -> float:
        return float(self.series.mass[-1]/self.series.mass[0] - 1)


def steps_between(interval: float, limit: float, dt: float | None) -> int:
    """Number of steps between samples, each at most dt, by default SAFETY*limit. ValueError: dt > limit."""
    longest = SAFETY*limit if dt is None else dt
    if not 0 < longest <= limit:
        raise ValueError(f"dt = {dt:.4g} must be positive and not above the stability limit {limit:.4g}: "
                         "lower or omit it")
    return ceil(interval/longest*(1 - 1e-12))


def of_samples(until: Any, samples: list) -> dict[str, Any]:
    """Fields of `GridRun` that follow from samples (t, K, Nu, mass)."""
    series = Series(*np.array(samples).T)
    ke, ke_err = until.estimate(series.ke)
    return {"series": series, "ke": ke, "ke_err": ke_err, "converged": until.settled(series.ke)}


def newton(q: np.ndarray, step: Callable[[np.ndarray], np.ndarray],
           what: str) -> tuple[np.ndarray, tuple[float, ...]]:
    """Iterate q + step(q) until the change is within WITHIN. Returns q and the largest change of each step.
    Raises NewtonFailed: no convergence; its message names the case, `what`."""
    changes: list[float] = []
    while not changes or changes[-1] > WITHIN:
        change = step(q)
        q = q + change
        changes.append(largest(change))
        if not changes[-1] < 1e3 or len(changes) == STEPS:
            last = ", ".join(f"{size:.1e}" for size in changes[-4:])
            raise NewtonFailed(f"no steady state at {what}, last changes {last}: start from one nearby in "
                               "Ra, refine the grid, or run in time")
    return q, tuple(changes)


def largest(a: np.ndarray) -> float:
    """Largest magnitude."""
    return float(np.abs(a).max())


@dataclass(frozen=True)
class Time:
    """Stop at time `t_end`, with `samples` samples at equal intervals."""
    t_end: float
    samples: int = 200

    def __post_init__(self):
        if not (self.t_end > 0 and self.samples >= 1):
            raise ValueError(f"t_end and samples must be positive, got {self}")

    def interval(self, scene) -> float:
        return self.t_end/self.samples

    def done(self, ke) -> bool:
        return len(ke) > self.samples

    def fraction(self, ke) -> float:
        return (len(ke) - 1)/self.samples

    def settled(self, ke) -> bool:
        return False

    def estimate(self, ke) -> tuple[float, float]:
        """K at the end, and its range of values in the last tenth of the time."""
        return float(ke[-1]), float(np.ptp(ke[-max(2, len(ke)//10):]))


@dataclass(frozen=True, kw_only=True)
class Steady:
    """Stop when the remaining change of K is below `rtol` K after three successive blocks.

    K is averaged over blocks, in which sound crosses the box several times. From the means b_n the remaining
    change is d r/(1 - r), d_n = b_n - b_(n-1), r = d_n/d_(n-1): near onset d alone is small long before K is
    steady. `block`, `longest` in L^2/nu; after `longest` the run ends unconverged. `samples` per block.
    """
    rtol: float = 1e-5
    block: float = 0.1
    longest: float = 60.0
    samples: int = 16

    def __post_init__(self):
        if not (0 < self.rtol < 1 and self.block > 0 and self.longest > 0 and self.samples > 0):
            raise ValueError(f"rtol must be in (0, 1), the rest positive, got {self}")

    def interval(self, scene) -> float:
        return self.block*scene.viscous_time/self.samples

    def means(self, ke) -> np.ndarray:
        """Means of K over whole blocks; the first sample, the start, belongs to none."""
        whole = (len(ke) - 1)//self.samples
        return np.reshape(ke[1:1 + whole*self.samples], (whole, self.samples)).mean(axis=1)

    def settled(self, ke) -> bool:
        means = self.means(ke)
        if len(means) < 5:
            return False
        lefts = [abs(left(means[:len(means) - n])) for n in range(3)]
        return max(lefts) < max(self.rtol*means[-1], SMALL)

    def done(self, ke) -> bool:
        at_block = len(ke) > 1 and (len(ke) - 1) % self.samples == 0
        return at_block and (self.settled(ke) or self._time(ke) >= self.longest)

    def _time(self, ke) -> float:
        return (len(ke) - 1)/self.samples*self.block

    def fraction(self, ke) -> float:
        """Progress: towards `rtol` on a logarithmic scale, or of the longest time if that is more."""
        means = self.means(ke)
        near = abs(left(means))/max(means[-1], SMALL) if len(means) else np.inf
        return float(np.clip(np.log(max(near, self.rtol))/np.log(self.rtol), self._time(ke)/self.longest, 1))

    def estimate(self, ke) -> tuple[float, float]:
        """K plus its remaining change, and the error of that; unsettled: mean, scatter of the last half."""
        means = self.means(ke)
        if self.settled(ke):
            rest = left(means)
            return float(means[-1] + rest), float(abs(rest) + abs(means[-1] - means[-2]))
        last = means[len(means)//2:]
        return float(last.mean()), float(last.std())


def left(means: np.ndarray) -> float:
    """Remaining change of a geometric decay after its last value; infinite if the values do not converge."""
    if len(means) < 3:
        return np.inf
    before, last = np.diff(means[-3:])
    if abs(last) <= 1e-10*abs(means[-1]):  # differences are round-off, their ratios mean nothing
        return float(last)
    ratio = last/before if before else np.inf
    return float(last*ratio/(1 - ratio)) if abs(ratio) < 1 else np.inf
