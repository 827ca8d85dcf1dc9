"""Long runs from random starts, and sums that should stay as they are."""
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from itertools import pairwise
from math import fsum
from pathlib import Path
from typing import Any, ClassVar

import numpy as np

from continuum.fluid import energy
from particles.fields import Fields
from particles.integral.points import Points
from particles.integrators import RK4
from particles.limits import limit_of
from particles.run import Divergence, Plan, run
from particles.starts import Overlap
from particles.threads import Threads
from studies.kit.case import Case, Outcome, Report

ROUND_OFF = 2.2e-16     # of a sum: its terms are rounded twice, adding them up is exact
HARMONICS = 2           # of random starts: two waves to a box at most
RECORDS = 20            # of a run
WIND = 0.1, -0.05, 0.02
OF_LIMIT = 0.5          # of the step to its limit
EVERYTHING = "mass momentum energy"

#: (state, steps) -> the state after these steps, and how many were done
Advance = Callable[[np.ndarray, int], tuple[np.ndarray, int]]


# --- random starts ------------------------------------------------------------------------------


def smooth(points: Points, size: float, rng: np.random.Generator) -> np.ndarray:
    """A random field (n,) of rms `size`: long waves of random heights and phases."""
    numbers = np.arange(-HARMONICS, HARMONICS + 1)
    grids = np.meshgrid(*[numbers]*points.d)
    turns = np.stack([grid.ravel() for grid in grids], axis=1)
    turns = turns[np.any(turns != 0, axis=1)]
    start = rng.uniform(0, 2*np.pi, len(turns))
    phase = 2*np.pi*(points.x/points.box)@turns.T + start
    heights = rng.normal(size=len(turns))
    return size*np.sqrt(2/len(turns))*np.cos(phase)@heights


def random_fields(points: Points, size: float, seed: int,
                  plates: bool = False) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """rho (n,), v (n, d) in a light wind, between plates along these, T (n,)."""
    rng = np.random.default_rng(seed)
    rho, T, *v = (smooth(points, size, rng) for _ in range(2 + points.d))
    wind = np.array(WIND[:points.d])
    if plates:
        wind[1:] = 0
    return 1 + rho, np.stack(v, axis=1) + wind, 1 + T


# --- sums ---------------------------------------------------------------------------------------


def exact_sums(V: np.ndarray, state: np.ndarray) -> np.ndarray:
    """Sums of V times each row, without rounding."""
    return np.array([fsum(V*row) for row in state])


def sizes(eos: Any, fields: Fields) -> np.ndarray:
    """What changes are divided by: mass, sum of |momentum| for each direction, energy."""
    m = fields.rho*fields.V
    squares = (fields.v**2).sum(axis=1)
    momentum = m@np.sqrt(squares)
    total = m@(energy(eos, fields.rho, fields.T) + squares/2)
    return np.array([m.sum(), *[momentum]*fields.v.shape[1], total])


class Changes:
    """Largest changes of sums (k,) from those of the first state, over sizes (k,)."""

    def __init__(self, totals: Callable[[np.ndarray], np.ndarray], sizes: np.ndarray, state: np.ndarray):
        self.totals, self.sizes, self.first = totals, sizes, totals(state)
        self.worst = np.zeros(len(sizes))

    def __call__(self, state: np.ndarray) -> None:
        """Compare with the first."""
        change = np.abs(self.totals(state) - self.first)/self.sizes
        self.worst = np.maximum(self.worst, change)


# --- runs ---------------------------------------------------------------------------------------


@dataclass(frozen=True, kw_only=True)
class WatchedRun(Case):
    """A run from a random start, a row of the table `drift`. scheme : the first word of the row."""

    steps: int = 10_000
    seed: int = 1
    scheme: ClassVar[str]

    def points(self) -> Points:
        """Where the points are."""
        raise NotImplementedError

    def method(self, points: Points) -> Any:
        """The scheme on them; ArithmeticError where no such edges exist."""
        raise NotImplementedError

    def start(self, method: Any, points: Points) -> np.ndarray:
        """A random state."""
        raise NotImplementedError

    def totals(self, method: Any, state: np.ndarray) -> np.ndarray:
        """Mass, momentum along each axis, energy."""
        return exact_sums(method.edges.V, state)

    def sizes(self, method: Any, state: np.ndarray) -> np.ndarray:
        """What changes of these are divided by."""
        return sizes(method.eos, method.fields(state))

    def advance(self, method: Any, state: np.ndarray) -> Advance:
        """Steps of the scheme."""
        return compiled(method, state)

    @property
    def records(self) -> int:
        """How often sums are looked at."""
        return RECORDS

    def changes(self, worst: np.ndarray) -> dict[str, float]:
        """Columns of the largest changes."""
        mass, *momentum, total = worst
        return {"mass": mass, "momentum": max(momentum), "energy": total}

    def columns(self) -> dict[str, Any]:
        """Columns that say which run it is, and which sums should stay."""
        raise NotImplementedError

    def run(self, report: Report, folder: Path) -> Outcome:
        points = self.points()
        try:
            method = self.method(points)
        except ArithmeticError:
            return Outcome({})
        state = self.start(method, points)
        watch = Changes(lambda now: self.totals(method, now), self.sizes(method, state), state)
        advance = self.advance(method, state)
        reached = in_parts(advance, state, self.steps, watch, report, self.records)
        usual = {"d": 2, "wall": "periodic", "zeta": 0.0, "volume": np.nan, "err": ROUND_OFF}
        length = {"seed": self.seed, "n": points.n, "steps": self.steps, "reached": reached}
        known = {"scheme": self.scheme, **usual, **length, **self.columns()}
        return Outcome({"drift": [{**known, **self.changes(watch.worst)}]})


def parts(steps: int, records: int) -> Iterator[tuple[int, int]]:
    """A run in equal parts: (steps before, steps of it)."""
    ends = [steps*part//records for part in range(records + 1)]
    return ((a, b - a) for a, b in pairwise(ends) if b > a)


def in_parts(advance: Advance, state: np.ndarray, steps: int, look: Callable[[np.ndarray], None],
             report: Report, records: int) -> int:
    """Steps done of a run that is looked at after each part."""
    for before, number in parts(steps, records):
        state, done = advance(state, number)
        if done < number:
            return before + done
        look(state)
        report((before + number)/steps)
    return steps


def compiled(method: Any, first: np.ndarray) -> Advance:
    """Steps in the compiled loop, until it diverges, sound in heated gas outruns the step, or points pair."""
    dt = OF_LIMIT*limit_of(method, first)

    def advance(state: np.ndarray, steps: int) -> tuple[np.ndarray, int]:
        if dt > limit_of(method, state):
            return state, 0
        try:
            return run(method, state, Plan(dt=dt, steps=steps)).state, steps
        except Divergence as end:
            return state, end.step
        except Overlap:
            return state, 0
    return advance


def in_numpy(method: Any, first: np.ndarray, dt: float, integrator: Any = RK4) -> Advance:
    """Steps of a scheme in numpy, in place, until it diverges."""
    stepper = integrator(first.shape, Threads(1))

    def advance(state: np.ndarray, steps: int) -> tuple[np.ndarray, int]:
        for step in range(steps):
            try:
                stepper.step(method, state, dt)
            except FloatingPointError:
                return state, step
        return state, steps
    return advance
