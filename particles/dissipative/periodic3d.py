"""A periodic box in two or three dimensions: cell order, ghosts and neighbour lists of the particles in it.

Two dimensions are treated as three with z = 0: one layer of cells, no ghosts above or below. Each pair is in
two lists, so that one thread writes a row of a pair sum. In two dimensions these lists take twice as long as
those of `particles.neighbours`.
"""

from collections import namedtuple

import numpy as np

from continuum.jit import jit
from particles.neighbours import NO_LISTS, ONE, counting_sort, farthest, fill_lists, u32, u64
from particles.threads import Threads

#: Points sorted into cubes: cell c holds order[start[c]:start[c+1]], x in this order; counts by axis.
Cubes = namedtuple("Cubes", "low side counts start order x")


@jit
def _cell(cells, x, k):
    """Index of the cell of point k; cells are numbered layer by layer."""
    c = 0
    for axis in range(2, -1, -1):
        c = c*cells.counts[axis] + int((x[k, axis] - cells.low[axis])/cells.side)
    return c


@jit
def _sort(cells, x):
    """Sort points by cell."""
    cell = np.empty(len(x), np.int64)
    for k in range(len(x)):
        cell[k] = _cell(cells, x, k)
    counting_sort(cell, cells.start, cells.order)
    for k in range(len(x)):
        cells.x[k] = x[cells.order[k]]


def sort_into_cells(x: np.ndarray, side: float) -> Cubes:
    """Linked cells of points (n, 3), with an empty cell around. Raises FloatingPointError: too many cells."""
    low = x.min(axis=0) - side
    across = (x.max(axis=0) - low)/side + 2
    if not np.prod(across) <= 64*len(x) + 4096:
        raise FloatingPointError(f"the particles spread over {across.round()} cells, far more than their "
                                 f"number {len(x)}: some are no longer in the box; lower the step")
    counts = across.astype(np.int64)
    cells = Cubes(low, side, counts, np.zeros(np.prod(counts) + 1, np.int64), np.empty(len(x), u32),
                  np.empty_like(x))
    _sort(cells, x)
    return cells


@jit
def _gather(cells, home, near, number):
    """Copy the points of the 27 cells around `home` into `near` and `number`. Returns how many there are."""
    count, columns, layer = u64(0), cells.counts[0], cells.counts[0]*cells.counts[1]
    for up in range(-1, 2):
        for row in range(-1, 2):
            first = home + up*layer + row*columns
            for k in range(u64(cells.start[first - 1]), u64(cells.start[first + 2])):
                near[0, count], near[1, count], near[2, count] = cells.x[k, 0], cells.x[k, 1], cells.x[k, 2]
                number[count] = cells.order[k]
                count += ONE
    return count


@jit
def list_rows(first, last, n, cells, reach, capacity, lists):
    """Write the lists of the n particles among points first..last of the cells. Returns False without room.

    All points around a cell are compared before the list is compressed, as in `neighbours`.
    """
    most = 27*np.diff(cells.start).max()
    near, number, close = np.empty((3, most)), np.empty(most, u32), np.empty(most, u32)
    far2, used, room, home, count = reach*reach, u64(first*capacity), u64(last*capacity), -1, u64(0)
    for k in range(u64(first), u64(last)):
        i, c, found = cells.order[k], _cell(cells, cells.x, k), u64(0)
        if i >= n:
            continue
        if c != home:
            home, count = c, _gather(cells, c, near, number)
        x, y, z = cells.x[k]
        for m in range(count):
            dx, dy, dz = near[0, m] - x, near[1, m] - y, near[2, m] - z
            close[m] = u64(dx*dx + dy*dy + dz*dz < far2) & u64(number[m] != i)
            found += close[m]
        if used + found >= room:
            return False
        lists.start[i], lists.length[i] = used, found
        for m in range(count):
            lists.listed[used] = number[m]
            used += close[m]
    return True


@jit
def _ghosts(x, sides, d, margin, parent, shift):
    """Shift n particles into the box, then make ghosts of points within `margin` of a side.

    Reads x (d, n), fills parent (room,), shift (room, 3). Returns the number of points, -1 without room.
    """
    n = count = x.shape[1]
    for i in range(n):
        parent[i], shift[i, 2] = i, 0.0
        for axis in range(d):
            shift[i, axis] = -sides[axis]*np.floor(x[axis, i]/sides[axis] + 0.5)
    for turn in range(d):
        axis = (1, 0, 2)[turn]     # y first, as in committed runs: ghosts set the order of sums
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


class Images:
    """Ghosts and neighbour lists of n particles in a periodic box (d,), d = 2 or 3, centred on the origin.

    reach : of the lists, the range 1 and the skin. parent, shift : index of the particle (points,) and shift
    from its place (points, 3), of particles, then of ghosts.
    """

    def __init__(self, n: int, box: tuple[float, ...], skin: float, threads: Threads):
        self.n, self.box, self.threads = n, np.array(box, float), threads
        self.reach, self.skin = 1.0 + skin, skin
        self.anchor: np.ndarray | None = None
        self.lists = NO_LISTS

    def stale(self, x: np.ndarray) -> bool:
        """True if lists may miss a pair of particles at x (d, n)."""
        return self.anchor is None or 2*farthest(x, self.anchor) > self.skin

    def order(self, x: np.ndarray) -> np.ndarray:
        """Indices of the particles in cell order."""
        places = np.zeros((self.n, 3))
        places[:, :len(x)] = (x - self.box[:, None]*np.floor(x/self.box[:, None] + 0.5)).T
        return sort_into_cells(places, self.reach).order

    def relist(self, x: np.ndarray) -> None:
        """Make ghosts and lists for particles at x (d, n)."""
        reach, d = self.reach, len(self.box)
        self.anchor = x.copy()
        places = self._make_points(x)
        near = (np.pi if d == 2 else 4/3*np.pi)*reach**d*self.n/np.prod(self.box)
        self.lists = fill_lists(self.threads, list_rows, self.n, len(places), reach, near, self.lists.listed,
                                self.n, sort_into_cells(places, reach))

    def _make_points(self, x: np.ndarray) -> np.ndarray:
        """Make `parent` and `shift` of particles in the box, and of ghosts. Returns places (points, 3)."""
        count, room = -1, int(1.1*self.n*np.prod(1 + 2*self.reach/self.box)) + 100
        while count < 0:
            parent, shift = np.empty(room, np.int64), np.empty((room, 3))
            count, room = _ghosts(x, self.box, len(x), self.reach, parent, shift), 2*room
        self.parent, self.shift = parent[:count], shift[:count]
        places = self.shift.copy()
        places[:, :len(x)] += x[:, self.parent].T
        return places
