"""Discretized integral hydrodynamics on a lattice between sliding sides, compiled, in 2D    [RR98, Sec. IV]

Images above have slid by s = rate height t = (m + theta) a along x [Lees and Edwards]. A point sees, at each
place of the lattice beyond the side, the two images next to it: one edge with the share 1 - theta of S and k,
one with theta. So nothing is lost, edges close at every s and volumes stay; no share is negative; what is
exchanged is continuous, and second order in the spacing. Each point exchanges in its own frame with images of
velocity v + rate height: which of two boxes is at rest does not matter.

The state has a fifth row, how far the images above have slid: its rate is their speed, so that every
integrator and every restart knows the time.
"""
from collections import namedtuple
from dataclasses import dataclass
from functools import cached_property
from typing import Any, NamedTuple

import numpy as np

from particles.integral.edge_makers import renormalised
from particles.integral.edges import Beyond, Edges, selected
from particles.integral.fixed import FixedSums, OnPoints, stored
from particles.integral.points import Points, lattice
from particles.pairs import Stored
from particles.threads import Threads

#: Entries of stored edges through a side: which, up (1) or down (-1), to the second of two images, with
#: the share theta, or to the first; point at the place to which it leads.
Through = namedtuple("Through", "entry up second place")


def sides(points: Points, edges: Edges) -> tuple[Stored, Through]:
    """Whole edges of a periodic lattice with sliding images in place of the periodic ones above and below.

    They are alike in all columns, and their own mirror images in x, as those of a weight are. Images have
    numbers n.. of those below and 2 n.. of those above, whose place in the lattice comes by sliding.
    """
    # 1 for edges i -> j through the upper side, -1 through the lower, 0 for others
    up = np.round((points.x[edges.i] + edges.apart - points.x[edges.j])[:, 1]/points.box[1]).astype(int)
    inside, through = selected(edges, up == 0), selected(edges, up != 0)
    i, j, S, k, apart = through.i, through.j, through.S, through.k, through.apart
    twice, up = np.concatenate, up[up != 0]
    # each edge in both directions, to both images
    beyond = Beyond(i=twice([i, j, i, j]), parent=twice([j, i, j, i]), S=twice([S, -S, S, -S]),
                    k=np.tile(k, 4), apart=twice([apart, -apart]*2), plate=twice([up, -up]*2))
    made = stored(inside, beyond, points.n + np.arange(4*len(i)))
    entry = np.flatnonzero(made.near >= points.n)
    e = made.near[entry] - points.n
    return made, Through(entry, beyond.plate[e], e//(2*len(i)), beyond.parent[e])


class Boosted(NamedTuple):
    """Images of points `parent`, seen from a box that moves by -boost."""
    parent: np.ndarray
    boost: np.ndarray

    def fill(self, records: np.ndarray, even: tuple[str, ...], odd: tuple[str, ...] = ()) -> None:
        """Copy fields that do not depend on the speed of the box."""
        first = len(records) - len(self.parent)
        for name in (*even, *odd):
            records[name][first:] = records[name][self.parent]

    def fill_fields(self, points: np.ndarray, n: int) -> None:
        """Fields of images, which come after n points."""
        self.fill(points, ("rho", "vx", "vy", "T", "eps", "ux", "uy", "Td", "eta", "k"))
        images, U = points[n:], self.boost
        images["eps"] += images["rho"]*U*(images["vx"] + U/2)
        images["vx"] += U
        images["ux"] += U

    def fill_work(self, points: np.ndarray, slopes: np.ndarray, V: np.ndarray) -> None:
        """Work F of images: their gradients are those of their parents, their velocities are not."""
        self.fill(points, ("Fx", "Fy"))
        images, f = points[len(V):], (points["eta"][:len(V)]/V)[self.parent]*self.boost
        images["Fx"] -= f*slopes[self.parent, 3]
        images["Fy"] += f*slopes[self.parent, 2]


class Shearing(FixedSums):
    """The compiled sums of a sheared fluid."""
    method: "Sheared"

    def __init__(self, method: "Sheared", threads: Threads):
        (self.whole, self.ends), n = sides(method.points, method.edges), method.points.n
        edges = Stored(*(q.copy() for q in self.whole))     # they follow the sliding
        images = Boosted(np.tile(np.arange(n), 2), method.speed*np.repeat([-1, 1], n))
        super().__init__(method, threads, edges, images, (0.0, 0.0))

    def rates(self, state: np.ndarray, out: np.ndarray) -> None:
        super().rates(state, out)
        out[4] = self.method.speed

    def surround(self, state: np.ndarray) -> None:
        """Slide the images above: edges through the sides get other shares and lead to other images."""
        edges, through, (columns, rows) = self.at.edges, self.ends, self.method.counts
        theta, whole = np.modf(state[4, 0]/self.method.points.a % columns)
        share = np.where(through.second, theta, 1 - theta)
        for name in ("sx", "sy", "k"):
            getattr(edges, name)[through.entry] = share*getattr(self.whole, name)[through.entry]
        column = through.place//rows - through.up*(int(whole) + through.second)
        parent = column % columns*rows + through.place % rows
        edges.near[through.entry] = parent + self.n*(1 + (through.up > 0))
        self.at.images.fill_fields(self.points, self.n)

    def through(self, state: np.ndarray) -> np.ndarray:
        """Mass, momentum (2) and energy that enter through the upper side per time."""
        self.look_at(state)
        edges = self.at.edges
        upper = np.isin(np.arange(len(edges.k)), self.ends.entry[self.ends.up > 0])
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

    @property
    def speed(self) -> float:
        return self.rate*float(self.points.box[1])

    def state(self, rho: Any, v: np.ndarray, T: Any) -> np.ndarray:
        """(5, n) of densities, velocities (n, 2), temperatures, before anything has slid."""
        return np.concatenate([super().state(rho, v, T), np.zeros((1, self.points.n))])
