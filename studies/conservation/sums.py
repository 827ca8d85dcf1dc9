"""Random starts, and sums that should stay as they are."""
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from itertools import pairwise
from math import fsum
from typing import Any

import numpy as np

from continuum.fluid import energy
from particles.fields import Fields
from particles.integral.points import Points

ROUND_OFF = 2.2e-16     # of a sum: its terms are rounded twice, adding them up is exact
HARMONICS = 2           # of random starts: two waves to a box at most
RECORDS = 20            # of a run
WIND = 0.1, -0.05, 0.02


def smooth(points: Points, size: float, rng: np.random.Generator) -> np.ndarray:
    """A random field (n,) of rms `size`: long waves of random heights and phases."""
    numbers = np.arange(-HARMONICS, HARMONICS + 1)
    turns = np.stack([q.ravel() for q in np.meshgrid(*[numbers]*points.d)], axis=1)
    turns = turns[np.any(turns != 0, axis=1)]
    phase = 2*np.pi*(points.x/points.box)@turns.T + rng.uniform(0, 2*np.pi, len(turns))
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


def kinetic(fields: Fields) -> float:
    """Kinetic energy of velocities less their mean."""
    m = fields.rho*fields.V
    v = fields.v - m@fields.v/m.sum()
    return float(m@(v**2).sum(axis=1))/2


@dataclass
class Watch:
    """Largest changes of sums: totals (k,) of what a run is at, over sizes (k,)."""

    totals: Callable[[Any], np.ndarray]
    sizes: np.ndarray
    first: np.ndarray = field(default_factory=lambda: np.empty(0))
    worst: np.ndarray = field(default_factory=lambda: np.empty(0))

    def __call__(self, state: Any) -> None:
        """Compare with the first."""
        now = self.totals(state)
        if not len(self.first):
            self.first, self.worst = now, np.zeros(len(now))
        self.worst = np.maximum(self.worst, np.abs(now - self.first)/self.sizes)


def parts(steps: int, records: int = RECORDS) -> Iterator[tuple[int, int]]:
    """A run in equal parts: (steps before, steps of it)."""
    ends = [steps*part//records for part in range(records + 1)]
    return ((a, b - a) for a, b in pairwise(ends) if b > a)
