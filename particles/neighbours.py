"""Neighbour search: cell order, linked cells, and Verlet lists with a skin.

The list of row i holds all points within `reach` = range + skin of it. Each pair is in two lists, so that one
thread writes a row of a sum. Indices are unsigned: a signed one costs numba three instructions at every use.
"""
from collections import namedtuple
from collections.abc import Callable
from typing import Any

import numpy as np

from continuum.jit import jit
from particles.threads import Threads

u32, u64 = np.uint32, np.uint64
ONE = u64(1)
MOST = 2000     # neighbours of a point; with more, particles have collapsed


#: Neighbours listed[start[i]:start[i] + length[i]] of row i.
Lists = namedtuple("Lists", "start length listed")

NO_LISTS = Lists(np.empty(0, u64), np.empty(0, u32), np.empty(0, u32))


#: Points sorted into square cells. Cell c holds order[start[c]:start[c+1]]; x, y are in this order.
Cells = namedtuple("Cells", "left bottom side columns rows start order x y")


@jit
def counting_sort(cell, start, order):
    """Stable sort by cell: cell c has order[start[c]:start[c + 1]]. Initial `start`: zeros (cells + 1,)."""
    for i in range(len(cell)):
        start[cell[i] + 1] += 1
    for c in range(len(start) - 1):
        start[c + 1] += start[c]
    fill = start[:-1].copy()
    for i in range(len(cell)):
        order[fill[cell[i]]] = i
        fill[cell[i]] += 1


@jit
def _sort(x, y, left, bottom, side, columns, start, order):
    """Sort points by cell; cells are numbered row by row."""
    cell = np.empty(len(x), np.int64)
    for i in range(len(x)):
        cell[i] = int((y[i] - bottom)/side)*columns + int((x[i] - left)/side)
    counting_sort(cell, start, order)


def sort_into_cells(x: np.ndarray, y: np.ndarray, side: float) -> Cells:
    """Linked cells [KHP95, Ref. 13] of points (N,), with a margin of two empty cells."""
    left, bottom = float(x.min()) - 2*side, float(y.min()) - 2*side
    across, up = ((float(q.max()) - low)/side + 4 for q, low in ((x, left), (y, bottom)))
    if not across*up <= 64*len(x) + 4096:
        raise FloatingPointError(
            f"the points spread over {across:.4g} x {up:.4g} cells, far more than their number {len(x)}: "
            "some have left the box; lower the step")
    columns, rows = int(across), int(up)
    start, order = np.zeros(columns*rows + 1, np.int64), np.empty(len(x), u32)
    _sort(x, y, left, bottom, side, columns, start, order)
    return Cells(left, bottom, side, columns, rows, start, order, x[order], y[order])


@jit
def _gather(cells, home, ring, x, y, j):
    """Copy the points of the square of cells around `home` into x, y, j. Returns their number."""
    count = u64(0)
    for row in range(-ring, ring + 1):
        first = home + row*cells.columns
        for k in range(u64(cells.start[first - ring]), u64(cells.start[first + ring + 1])):
            x[count], y[count], j[count] = cells.x[k], cells.y[k], cells.order[k]
            count += ONE
    return count


@jit
def list_rows(first, last, cells, x, y, itself, reach, capacity, lists):
    """Write the Verlet lists of rows first..last from first*capacity on. Returns False if they do not fit.

    Row i leaves out the point i + `itself`, which is its own. Rows of one cell share the points gathered
    around it. All of these are compared before the list is compressed, in a loop that LLVM can vectorise.
    """
    ring = int(np.ceil(reach/cells.side))
    most = (2*ring + 1)**2*np.diff(cells.start).max()
    near_x, near_y, near, close = np.empty(most), np.empty(most), np.empty(most, u32), np.empty(most, u32)
    far2, used, end_of_room, home, count = reach*reach, u64(first*capacity), u64(last*capacity), -1, u64(0)
    for i in range(u64(first), u64(last)):
        # a place outside all cells searches the nearest ones
        cx = min(max(int((x[i] - cells.left)/cells.side), 2), cells.columns - 3)
        cy = min(max(int((y[i] - cells.bottom)/cells.side), 2), cells.rows - 3)
        if cy*cells.columns + cx != home:
            home = cy*cells.columns + cx
            count = _gather(cells, home, ring, near_x, near_y, near)
        xi, yi, own, found = x[i], y[i], i + u64(itself), u64(0)
        for k in range(count):
            dx, dy = near_x[k] - xi, near_y[k] - yi
            close[k] = u64(dx*dx + dy*dy < far2) & u64(near[k] != own)
            found += close[k]
        if used + found >= end_of_room:  # the next loop writes one entry too many
            return False
        lists.start[i], lists.length[i] = used, found
        for k in range(count):
            lists.listed[used] = near[k]
            used += close[k]
    return True


def make_lists(threads: Threads, cells: Cells, x: np.ndarray, y: np.ndarray, reach: float, itself: int,
               listed: np.ndarray = NO_LISTS.listed) -> Lists:
    """Lists of points within `reach` of (x, y); row i leaves out point i + `itself`. May reuse `listed`."""
    occupied = max(int(np.count_nonzero(np.diff(cells.start))), 1)
    expected = np.pi*reach**2*len(cells.x)/occupied/cells.side**2
    return fill_lists(threads, list_rows, len(x), len(x), reach, expected, listed, cells, x, y, itself)


def fill_lists(threads: Threads, fill: Callable, n: int, rows: int, reach: float, expected: float,
               listed: np.ndarray, *arguments: Any) -> Lists:
    """Lists of n points that fill(first, last, *arguments, reach, capacity, lists) writes, sharing `rows`.

    expected : neighbours of each. Reuses the memory of `listed` if it is large enough. Raises
    FloatingPointError: there are over 2000 neighbours each.
    """
    room = 4 + int(1.1*expected)
    while room < MOST:
        if len(listed) < rows*room:
            listed = np.empty(int(1.1*rows*room), u32)
        lists = Lists(np.empty(n, u64), np.empty(n, u32), listed)
        if all(threads(fill, rows, *arguments, reach, room, lists)):
            return lists
        room = int(1.3*room) + 1
    raise FloatingPointError(f"more than {int(room/1.3)} neighbours within {reach:g} of each particle: they "
                             "have collapsed onto each other; lower the step or the attraction")


@jit
def farthest(x, anchor):
    """Largest displacement of a point since the lists were made at `anchor`; coordinates (d, n)."""
    far2 = 0.0
    for i in range(x.shape[1]):
        r2 = 0.0
        for axis in range(x.shape[0]):
            r2 += (x[axis, i] - anchor[axis, i])**2
        far2 = max(far2, r2)
    return np.sqrt(far2)
