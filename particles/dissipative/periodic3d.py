"""A periodic box in two or three dimensions: cell order, ghosts and neighbour lists of the particles in it.

Two dimensions are three with z = 0: one layer of cells, no ghosts above or below.
"""
from typing import NamedTuple

import numpy as np

from continuum.jit import jit
from particles.dissipative.neighbours3d import Lists, list_rows, sort_into_cells
from particles.neighbours import farthest, u32, u64
from particles.threads import Threads

MOST = 2000     # neighbours of a particle: beyond, they have collapsed


@jit
def _ghosts(x, sides, d, margin, parent, shift):
    """Shifts of n points into the box, then ghosts of what is within `margin` of a side.

    x (d, n); parent (room,), shift (room, 3) are filled; the number of points, or -1 if they do not fit.
    """
    n = count = x.shape[1]
    for i in range(n):
        parent[i], shift[i, 2] = i, 0.0
        for axis in range(d):
            shift[i, axis] = -sides[axis]*np.floor(x[axis, i]/sides[axis] + 0.5)
    for turn in range(d):
        axis = (1, 0, 2)[turn]     # y first, as in committed runs: sums have the order of ghosts
        for k in range(count):
            at = x[axis, parent[k]] + shift[k, axis]
            for way in (1, -1):
                if way*at < margin - sides[axis]/2:
                    if count == len(parent):
                        return -1
                    parent[count], shift[count] = parent[k], shift[k]
                    shift[count, axis] += way*sides[axis]
                    count += 1
    return count


@jit
def place(first, last, x, images, out):
    """out[k] = (x, y, z) of points first..last."""
    for k in range(first, last):
        i = images.parent[k]
        out[k, 0] = x[0, i] + images.shift[k, 0]
        out[k, 1] = x[1, i] + images.shift[k, 1]
        out[k, 2] = x[2, i] + images.shift[k, 2] if len(x) == 3 else 0.0


class WithGhosts(NamedTuple):
    """Particles, then ghosts: of which particle, where from there (points, 3)."""
    parent: np.ndarray
    shift: np.ndarray


class Images:
    """Ghosts and lists of n particles in a periodic box (d,), d = 2 or 3, centred on the origin."""

    def __init__(self, n: int, box: tuple[float, ...], reach: float, skin: float, threads: Threads):
        self.n, self.box, self.threads = n, np.array(box, float), threads
        self.reach, self.skin = reach, skin
        self.anchor: np.ndarray | None = None
        self.lists = Lists(np.empty(n, u64), np.empty(n, u32), np.empty(0, u32))
        self.points = WithGhosts(np.empty(0, np.int64), np.empty((0, 3)))

    def stale(self, x: np.ndarray) -> bool:
        """True if lists may miss a pair of particles at x (d, n)."""
        return self.anchor is None or 2*farthest(x, self.anchor) > self.skin

    def order(self, x: np.ndarray) -> np.ndarray:
        """Numbers of the particles in the order of cells."""
        places = np.zeros((self.n, 3))
        places[:, :len(x)] = (x - self.box[:, None]*np.floor(x/self.box[:, None] + 0.5)).T
        return sort_into_cells(places, self.reach + self.skin).order

    def relist(self, x: np.ndarray) -> None:
        """Ghosts and lists for particles at x (d, n)."""
        reach, d = self.reach + self.skin, len(self.box)
        self.anchor = x.copy()
        places = self._make_points(x)
        cells = sort_into_cells(places, reach)
        room = 4 + int(1.1*(np.pi if d == 2 else 4/3*np.pi)*reach**d*self.n/np.prod(self.box))
        while room < MOST:
            if len(self.lists.listed) < len(places)*room:
                self.lists = self.lists._replace(listed=np.empty(int(1.1*len(places)*room), u32))
            if all(self.threads(list_rows, len(places), self.n, cells, reach, room, self.lists)):
                return
            room = int(1.3*room) + 1
        raise FloatingPointError(f"more than {int(room/1.3)} neighbours within {reach:g} of each particle: "
                                 "they have collapsed onto each other; lower the step")

    def _make_points(self, x: np.ndarray) -> np.ndarray:
        """Particles in the box and ghosts; their places (points, 3)."""
        margin, count = self.reach + self.skin, -1
        room = int(1.1*self.n*np.prod(1 + 2*margin/self.box)) + 100
        while count < 0:
            parent, shift = np.empty(room, np.int64), np.empty((room, 3))
            count, room = _ghosts(x, self.box, len(x), margin, parent, shift), 2*room
        self.points = WithGhosts(parent[:count], shift[:count])
        out = np.empty((count, 3))
        place(0, count, x, self.points, out)
        return out
