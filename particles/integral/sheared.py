"""Discretized integral hydrodynamics on a lattice between sliding sides [Lees and Edwards], compiled; in 2D.

The state has a fifth row, how far the images above have slid: its rate is their speed, so that every
integrator and every restart knows the time.
"""
from dataclasses import dataclass
from functools import cached_property
from typing import Any, NamedTuple

import numpy as np

from continuum.jit import jit
from particles.integral.edges import Edges
from particles.integral.fixed import FixedSums, OnPoints
from particles.integral.points import Points
from particles.pairs import Stored
from particles.threads import Threads
from particles.walls.sliding import SlidSides, sides, slide


class Boosted(NamedTuple):
    """Images of points `parent`, seen from a box that moves by -boost."""
    parent: np.ndarray
    boost: np.ndarray

    def fill(self, records: np.ndarray, even: tuple[str, ...], odd: tuple[str, ...] = ()) -> None:
        """What does not change with the speed of the box."""
        first = len(records) - len(self.parent)
        for name in (*even, *odd):
            records[name][first:] = records[name][self.parent]

    def fill_work(self, points: np.ndarray, slopes: np.ndarray, V: np.ndarray) -> None:
        """The work F of images, which have the gradients of their parents and another velocity."""
        boosted_work(self.parent, self.boost, slopes, V, points, len(V))


class Shearing(FixedSums):
    """The compiled sums of a sheared fluid."""
    method: "Sheared"

    def __init__(self, method: "Sheared", threads: Threads):
        made = method.sides
        edges = Stored(*(q.copy() for q in made.edges))      # they follow the sliding
        super().__init__(method, threads, edges, Boosted(made.parent, method.speed*made.up), (0.0, 0.0))

    def rates(self, state: np.ndarray, out: np.ndarray) -> None:
        super().rates(state, out)
        out[4] = self.method.speed

    def surround(self, state: np.ndarray) -> None:
        made, images = self.method.sides, self.at.images
        slide(state[4, 0]/self.method.points.a, made.through, made.number, *made.counts, self.at.edges)
        boosted(images.parent, images.boost, self.points, self.n)

    def through(self, state: np.ndarray) -> np.ndarray:
        """Mass, momentum (2) and energy that enter through the upper side per time."""
        self.look_at(state)
        edges, (entry, up, *_) = self.at.edges, self.method.sides.through
        upper = np.isin(np.arange(len(edges.k)), entry[up > 0])
        alone = edges._replace(sx=upper*edges.sx, sy=upper*edges.sy, k=upper*edges.k)
        return self.exchange.sum(self.at._replace(edges=alone)).sum(axis=0)


@dataclass(frozen=True, kw_only=True)
class Sheared(OnPoints):
    """A fluid on the points of a lattice, periodic in x; images above move faster by rate times height."""
    points: Points
    edges: Edges
    eos: Any
    law: Any
    rate: float

    names = (*OnPoints.names, "slid")
    sums = Shearing

    def __post_init__(self):
        _ = self.sides      # what is wrong with points or edges is told here

    @property
    def x(self) -> np.ndarray:
        return self.points.x

    @cached_property
    def sides(self) -> SlidSides:
        return sides(self.points, self.edges)

    @property
    def speed(self) -> float:
        return self.rate*float(self.points.box[1])

    def state(self, rho: Any, v: np.ndarray, T: Any) -> np.ndarray:
        """(5, n) of densities, velocities (n, 2), temperatures, before anything has slid."""
        return np.concatenate([super().state(rho, v, T), np.zeros((1, self.points.n))])


@jit
def boosted(parent, boost, points, n):
    for m in range(len(parent)):
        a, b, U = points[parent[m]], points[n + m], boost[m]
        b.rho, b.vx, b.vy, b.T = a.rho, a.vx + U, a.vy, a.T
        b.eps = a.eps + a.rho*U*(a.vx + 0.5*U)
        b.ux, b.uy, b.Td, b.eta, b.k = b.vx, b.vy, a.T, a.eta, a.k


@jit
def boosted_work(parent, boost, slopes, V, points, n):
    for m in range(len(parent)):
        i = parent[m]
        a, b, f = points[i], points[n + m], points[i].eta/V[i]*boost[m]
        b.Fx, b.Fy = a.Fx - f*slopes[i, 3], a.Fy + f*slopes[i, 2]
