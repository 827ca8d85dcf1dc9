"""When a run of a grid may stop: rules that look at its samples of K; its step; what it ends with."""
from collections.abc import Callable
from dataclasses import dataclass, field
from math import ceil
from typing import Any, NamedTuple

import numpy as np

SAFETY = 0.8  # of the stability limit, which is taken at the start
SMALL = 1e-9  # remaining change of K that no longer matters, K of convection being 1e-3
STILL = 1e-12  # K of a fluid at rest; rolls have 1e-5 already 0.3 % above onset
WITHIN = 1e-9  # largest change in the last step of Newton's method: the error is then about its square
STEPS = 60  # of Newton's method: the slowest case that got through took 46 (cavity at Ra = 1e7 on 64 rows)
RK4_SOUND, RK4_DECAY = 2.82, 2.78  # where RK4's stability region ends on the imaginary and on the real axis


class NewtonFailed(RuntimeError):
    """No steady state was found; the message has the changes of the last steps."""


class Series(NamedTuple):
    """Samples in time: K, Nusselt number of the lower plate, mean density."""
    t: np.ndarray
    ke: np.ndarray
    nu: np.ndarray
    mass: np.ndarray


@dataclass(frozen=True, kw_only=True)
class GridRun:
    """What a run in time ended with.

    `ke` is K at the end with what is left of its decay added, `ke_err` the size of that.
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
    """Steps from one sample to the next, of at most dt, or safe ones. ValueError: dt is above the limit."""
    longest = SAFETY*limit if dt is None else dt
    if not 0 < longest <= limit:
        raise ValueError(f"dt = {dt:.4g} must be positive and not above the stability limit {limit:.4g}: "
                         "lower or omit it")
    return ceil(interval/longest*(1 - 1e-12))


def of_samples(until: Any, samples: list) -> dict[str, Any]:
    """What samples (t, K, Nu, mass) tell of `GridRun`."""
    series = Series(*np.array(samples).T)
    ke, ke_err = until.estimate(series.ke)
    return {"series": series, "ke": ke, "ke_err": ke_err, "converged": until.settled(series.ke)}


def newton(q: np.ndarray, step: Callable[[np.ndarray], np.ndarray],
           what: str) -> tuple[np.ndarray, tuple[float, ...]]:
    """The q that no step(q) changes by more than WITHIN, and the largest change of each step. Raises
    NewtonFailed: no convergence, of `what`."""
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
    """Stop at time `t_end` with `samples` samples on the way."""
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
        """K at the end and how far it went in the last tenth of the time."""
        return float(ke[-1]), float(np.ptp(ke[-max(2, len(ke)//10):]))


@dataclass(frozen=True, kw_only=True)
class Steady:
    """Stop when what is left of the decay of K is below `rtol` K in three blocks running.

    K is averaged over blocks (sound passes several times); their means b give what is left, d r/(1 - r) with
    d_n = b_n - b_(n-1), r = d_n/d_(n-1): near onset one difference is small long before K is steady.
    `block`, `longest` in units of L^2/nu; after `longest` the run ends unconverged. `samples` a block.
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
        """Means over whole blocks; the first sample is the start."""
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
        """Of the way to `rtol` on a logarithmic scale, or of the longest time."""
        means = self.means(ke)
        near = abs(left(means))/max(means[-1], SMALL) if len(means) else np.inf
        return float(np.clip(np.log(max(near, self.rtol))/np.log(self.rtol), self._time(ke)/self.longest, 1))

    def estimate(self, ke) -> tuple[float, float]:
        """(K with what is left of its decay, size of what is left), or mean and spread of the last half."""
        means = self.means(ke)
        if self.settled(ke):
            rest = left(means)
            return float(means[-1] + rest), float(abs(rest) + abs(means[-1] - means[-2]))
        last = means[len(means)//2:]
        return float(last.mean()), float(last.std())


def left(means: np.ndarray) -> float:
    """What is left of a geometric decay after its last value; infinite where the values do not converge."""
    if len(means) < 3:
        return np.inf
    before, last = np.diff(means[-3:])
    if abs(last) <= 1e-10*abs(means[-1]):  # round-off: its ratios mean nothing
        return float(last)
    ratio = last/before if before else np.inf
    return float(last*ratio/(1 - ratio)) if abs(ratio) < 1 else np.inf
