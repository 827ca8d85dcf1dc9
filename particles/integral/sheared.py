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
from particles.integral.exchange import At
from particles.integral.fixed import FixedSums, OnPoints, Point
from particles.integral.layer import Layer
from particles.integral.points import Points
from particles.integral.transposed_stress import MENDED
from particles.limits import limit_of
from particles.neighbours import u32
from particles.pairs import Stored
from particles.threads import Team
from particles.walls.sliding import Sides, sides, slide


@dataclass(frozen=True, kw_only=True)
class Sheared(OnPoints):
    """A fluid on the points of a lattice, periodic in x; images above move faster by rate times height.

    edges : periodic, of a weight. transport : listed terms of friction and heat.
    """
    points: Points
    edges: Edges
    eos: Any
    law: Any
    rate: float
    transport: tuple = MENDED

    names = (*OnPoints.names, "slid")

    def __post_init__(self):
        _ = self.sides      # what is wrong with points or edges is told here

    @property
    def x(self) -> np.ndarray:
        """Places (n, 2)."""
        return self.points.x

    @cached_property
    def sides(self) -> Sides:
        """Edges among points and to images."""
        return sides(self.points, self.edges)

    def __repr__(self) -> str:
        """What tells a checkpoint's method from another: edges by their sums."""
        sums = ", ".join(f"{float(np.abs(q).sum())!r}" for q in (self.points.x, self.edges.S, self.edges.k))
        return f"Sheared({self.points.n}, {sums}, {self.eos}, {self.law}, {self.rate}, {self.transport})"

    @property
    def speed(self) -> float:
        """Of the box above relative to this one."""
        return self.rate*float(self.points.box[1])

    def state(self, rho: Any, v: np.ndarray, T: Any) -> np.ndarray:
        """(5, n) of densities, velocities (n, 2), temperatures, before anything has slid."""
        return np.concatenate([super().state(rho, v, T), np.zeros((1, self.points.n))])

    def sums(self, team: Team) -> "Shearing":
        """Of the fluid between its sides."""
        return Shearing(self, team)


limit_of.register(Sheared, limit_of.dispatch(Layer))


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
    method: Sheared

    def __init__(self, method: Sheared, team: Team):
        made, n = method.sides, method.points.n
        edges = Stored(*(q.copy() for q in made.edges))      # they follow the sliding
        images = Boosted(made.parent, method.speed*made.up)
        super().__init__(method, team, At(np.zeros(n + len(made.parent), Point), edges, images,
                                          method.edges.V), (0.0, 0.0))

    def rates(self, state: np.ndarray, out: np.ndarray) -> None:
        """d(state)/dt of a state (5, n), written to `out`    [Eqs 34-36, 51]"""
        super().rates(state, out)
        out[4] = self.method.speed

    def surround(self, state: np.ndarray) -> None:
        """Images, and edges to them, where they are now."""
        made, images = self.method.sides, self.at.images
        slide(state[4, 0]/self.method.points.a, made.through, made.number, *made.counts, self.at.edges)
        boosted(images.parent, images.boost, self.points, self.n)

    def through(self, state: np.ndarray) -> np.ndarray:
        """Mass, momentum (2) and energy that enter through the upper side per time."""
        self.look_at(state)
        return self.exchange.sum(self.at._replace(edges=above(self.at.edges, self.method.sides))).sum(axis=0)


def above(edges: Stored, made: Sides) -> Stored:
    """The edges through the upper side alone."""
    chosen = made.through.entry[made.through.up > 0]
    rows = np.repeat(np.arange(len(edges.taken)), edges.taken)[chosen]
    taken = np.bincount(rows, minlength=len(edges.taken))
    return Stored((np.cumsum(taken) - taken).astype(edges.first.dtype), taken.astype(u32),
                  *(q[chosen] for q in (edges.near, edges.sx, edges.sy, edges.k)))


@jit
def boosted(parent, boost, points, n):
    """Images: their parents seen from a box that moves by -boost."""
    for m in range(len(parent)):
        a, b, U = points[parent[m]], points[n + m], boost[m]
        b.rho, b.vx, b.vy, b.T = a.rho, a.vx + U, a.vy, a.T
        b.eps = a.eps + a.rho*U*(a.vx + 0.5*U)
        b.ux, b.uy, b.Td, b.eta, b.k = b.vx, b.vy, a.T, a.eta, a.k


@jit
def boosted_work(parent, boost, slopes, V, points, n):
    """F of the images, which have the gradients of their parents and another velocity."""
    for m in range(len(parent)):
        i = parent[m]
        a, b, f = points[i], points[n + m], points[i].eta/V[i]*boost[m]
        b.Fx, b.Fy = a.Fx - f*slopes[i, 3], a.Fy + f*slopes[i, 2]
