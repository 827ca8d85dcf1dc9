"""Random starts, and what becomes of sums that should stay as they are."""
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from itertools import pairwise
from math import fsum
from typing import Any

import numpy as np

from particles.integral.points import Points

ROUND_OFF = 2.2e-16     # of a sum: its terms are rounded twice, adding them up is exact
HARMONICS = 2           # of random starts: two waves to a box at most
RECORDS = 20            # of a run
WIND = 0.1, -0.05, 0.02


def smooth(points: Points, size: float, rng: np.random.Generator) -> np.ndarray:
    """A random field (n,) of rms `size`: long waves of random heights and phases."""
    turns = np.stack([q.ravel() for q in np.meshgrid(*[np.arange(-HARMONICS, HARMONICS + 1)]*points.d)], axis=1)
    turns = turns[np.any(turns != 0, axis=1)]
    phase = 2*np.pi*(points.x/points.box)@turns.T + rng.uniform(0, 2*np.pi, len(turns))
    return size*np.sqrt(2/len(turns))*np.cos(phase)@rng.normal(size=len(turns))


def random_fields(points: Points, size: float, seed: int, plates: bool = False) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """rho (n,), v (n, d) in a light wind, between plates along these, T (n,)."""
    rng = np.random.default_rng(seed)
    rho, T, *v = (smooth(points, size, rng) for _ in range(2 + points.d))
    wind = WIND[:1] + (0.0,)*(points.d - 1) if plates else WIND[:points.d]
    return 1 + rho, np.stack(v, axis=1) + np.array(wind), 1 + T


def exact_sums(V: np.ndarray, state: np.ndarray) -> np.ndarray:
    """Sums of V times each row."""
    return np.array([fsum(V*row) for row in state])


@dataclass
class Watch:
    """Largest changes of sums: totals (k,) of what a run is at, sizes (k,) over which changes are told."""
    totals: Callable[[Any], np.ndarray]
    sizes: np.ndarray
    first: np.ndarray = field(default_factory=lambda: np.empty(0))
    worst: np.ndarray = field(default_factory=lambda: np.empty(0))

    def __call__(self, state: Any) -> None:
        """Take note."""
        now = self.totals(state)
        if not len(self.first):
            self.first, self.worst = now, np.zeros(len(now))
        self.worst = np.maximum(self.worst, np.abs(now - self.first)/self.sizes)


def parts(steps: int) -> Iterator[tuple[int, int]]:
    """A run in equal parts: (steps before, steps of it)."""
    ends = [steps*part//RECORDS for part in range(RECORDS + 1)]
    return ((a, b - a) for a, b in pairwise(ends) if b > a)


def kinetic(mass: np.ndarray, momentum: np.ndarray) -> float:
    """Kinetic energy of masses (n,) with momenta (d, n), less that of their mean."""
    return float(((momentum**2).sum(axis=0)/mass).sum() - (momentum.sum(axis=1)**2).sum()/mass.sum())/2
