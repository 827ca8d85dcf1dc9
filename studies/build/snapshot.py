"""Particles at one instant: how many neighbours they have, how far apart they are, whether they pair."""
from dataclasses import dataclass
from functools import cached_property
from math import sqrt

import numpy as np
from scipy.spatial import cKDTree

from studies.kit.stats import Measured

RANGE = 3.0     # of the printed weights, in spacings


@dataclass(frozen=True)
class Snapshot:
    """Positions and velocities (points, 2) in spacings: `n` fluid particles, then fixed ones and images."""
    x: np.ndarray
    v: np.ndarray
    n: int
    height: float

    @cached_property
    def tree(self) -> cKDTree:
        """Of all points."""
        return cKDTree(self.x)

    @cached_property
    def bulk(self) -> np.ndarray:
        """Fluid particles farther than the range of the weight from the plates."""
        return np.flatnonzero(np.abs(self.x[:self.n, 1]) < self.height/2 - RANGE)

    def near(self, distance: float) -> np.ndarray:
        """How many others are that close to each particle of the bulk."""
        return self.tree.query_ball_point(self.x[self.bulk], distance, return_length=True) - 1

    @property
    def neighbours(self) -> Measured:
        """Mean number within the range; counts of particles that share neighbours are one sample."""
        counts = self.near(RANGE)
        samples = max(1.0, len(counts)/counts.mean())
        return Measured(float(counts.mean()), float(1.96*counts.std()/sqrt(samples)))

    @property
    def spacing(self) -> Measured:
        """Distance where the first peak of the pair distribution is, by bins of 0.1."""
        edges = np.arange(0.3, 2.01, 0.1)
        bulk = cKDTree(self.x[self.bulk])
        pairs = bulk.sparse_distance_matrix(self.tree, 2.0, output_type="ndarray")
        counts, _ = np.histogram(pairs["v"], edges)
        peak = np.argmax(counts/np.diff(edges**2))
        return Measured(float(edges[peak] + 0.05), 0.05)

    @property
    def pairing(self) -> Measured:
        """Median of second over first neighbour distance; partners of a pair are one sample."""
        distances, _ = self.tree.query(self.x[self.bulk], 3)
        _, first, second = np.transpose(distances)
        around = 0.98/sqrt(len(first)/2)*np.array([-1, 0, 1])
        low, middle, high = np.quantile(second/first, 0.5 + around)
        return Measured(float(middle), float(high - low)/2)

    @property
    def occupancy(self) -> float:
        """Particles a site: bulk particles joined with those closer than half a spacing."""
        return 1 + float(np.median(self.near(0.5)))

    @property
    def fastest(self) -> float:
        """The largest v^2 of the fluid."""
        return float((self.v[:self.n]**2).sum(axis=1).max())
