"""Discretized integral hydrodynamics on a lattice between sliding sides, compiled, in 2D    [RR98, Sec. IV]

Images above have slid by s = rate height t = (m + theta) a along x [Lees and Edwards]. A point sees, at each
place of the lattice beyond the side, the two images next to it: one edge with the share 1 - theta of S and k,
one with theta. So nothing is lost, edges close at every s and volumes stay; no share is negative; what is
exchanged is continuous, and second order in the spacing. Each point exchanges in its own frame with images of
velocity v + rate height: which of two boxes is at rest does not matter.

The state has a fifth row, how far the images above have slid: its rate is their speed, so that every
integrator and every restart knows the time.
"""
from dataclasses import dataclass
from functools import cached_property
from typing import Any, NamedTuple

import numpy as np

from continuum.jit import jit
from particles.integral.edge_makers import renormalised
from particles.integral.edges import Edges
from particles.integral.fixed import FixedSums, OnPoints
from particles.integral.points import Points, lattice
from particles.neighbours import u32, u64
from particles.pairs import Stored
from particles.threads import Threads


class Through(NamedTuple):
    """Entries of the stored edges through a side: which, up (1) or down (-1), share 1 - theta (0) or theta
    (1); S/2 and k of the whole edge; column and row of the place of the lattice to which it leads."""
    entry: np.ndarray
    up: np.ndarray
    second: np.ndarray
    sx: np.ndarray
    sy: np.ndarray
    k: np.ndarray
    column: np.ndarray
    row: np.ndarray


class SlidSides(NamedTuple):
    """Stored edges among the points and to images n.. of points `parent`, which are `up` (1) or down (-1).

    number[0] and number[1]: which image below and above a point has. through: what has to follow the sliding.
    """
    edges: Stored
    through: Through
    parent: np.ndarray
    up: np.ndarray
    number: np.ndarray
    counts: tuple[int, int]


def sides(points: Points, edges: Edges, counts: tuple[int, int]) -> SlidSides:
    """Edges of a periodic lattice with sliding images in place of the periodic ones above and below.

    They are alike in all columns, and their own mirror images in x, as those of a weight are."""
    i, j = np.concatenate([edges.i, edges.j]), np.concatenate([edges.j, edges.i])
    S, k = np.concatenate([edges.S, -edges.S])/2, np.concatenate([edges.k, edges.k])
    up = crossing(points, edges)
    up = np.concatenate([up, -up])
    # edges through a side stand there twice
    split = np.concatenate([np.arange(len(i)), np.flatnonzero(up)])
    second = np.arange(len(split)) >= len(i)
    order = np.lexsort((j[split], i[split]))
    split, second = split[order], second[order]
    i, j, S, k, up = (q[split] for q in (i, j, S, k, up))
    taken = np.bincount(i, minlength=points.n)
    stored = Stored((np.cumsum(taken) - taken).astype(u64), taken.astype(u32), j.astype(u32), S[:, 0].copy(),
                    S[:, 1].copy(), k)
    entry = np.flatnonzero(up)
    through = Through(entry, up[entry], second[entry].astype(int), S[entry, 0], S[entry, 1], k[entry],
                      j[entry]//counts[1], j[entry] % counts[1])
    return SlidSides(stored, through, *images(through, counts), counts)


def images(through: Through, counts: tuple[int, int]) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Parents of the images, which way they lie, their numbers (2, n): all points of rows with edges."""
    n = counts[0]*counts[1]
    column, sides = np.arange(counts[0])[:, None]*counts[1], (-1, 1)
    found = [(column + np.unique(through.row[through.up == side])).ravel() for side in sides]
    parent, up = np.concatenate(found), np.repeat(sides, [len(points) for points in found])
    number = np.zeros((2, n), int)
    number[(up + 1)//2, parent] = n + np.arange(len(parent))
    return parent, up, number


def crossing(points: Points, edges: Edges) -> np.ndarray:
    """1 for edges i -> j through the upper side, -1 through the lower, 0 for others."""
    beyond = (points.x[edges.i] + edges.apart - points.x[edges.j])[:, 1]
    return np.round(beyond/points.box[1]).astype(int)


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
    """A fluid on a lattice of columns and rows one spacing apart, periodic in x, with edges of a weight.

    Images above move faster by rate times height.
    """
    counts: tuple[int, int]
    weight: Any
    eos: Any
    law: Any
    rate: float

    names = (*OnPoints.names, "slid")
    sums = Shearing

    @cached_property
    def points(self) -> Points:
        return lattice(self.counts)

    @cached_property
    def edges(self) -> Edges:       # type: ignore[override]
        return renormalised(self.points, self.weight)

    @property
    def x(self) -> np.ndarray:
        return self.points.x

    @cached_property
    def sides(self) -> SlidSides:
        return sides(self.points, self.edges, self.counts)

    @property
    def speed(self) -> float:
        return self.rate*float(self.points.box[1])

    def state(self, rho: Any, v: np.ndarray, T: Any) -> np.ndarray:
        """(5, n) of densities, velocities (n, 2), temperatures, before anything has slid."""
        return np.concatenate([super().state(rho, v, T), np.zeros((1, self.points.n))])


@jit
def slide(offset, through, number, columns, rows, edges):
    """Let the images above have slid by `offset` spacings."""
    m = int(np.floor(offset))
    theta = offset - m
    for e in range(len(through.entry)):
        entry, up, second = through.entry[e], through.up[e], through.second[e]
        share = theta if second else 1 - theta
        edges.sx[entry], edges.sy[entry] = share*through.sx[e], share*through.sy[e]
        edges.k[entry] = share*through.k[e]
        parent = ((through.column[e] - up*(m + second)) % columns)*rows + through.row[e]
        edges.near[entry] = number[(up + 1)//2, parent]


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
