"""Cell order, linked cells and a Verlet list with skin: who may be near whom.

The list of row i holds all points within `reach` = range + skin of it, in both directions: each row of a pair
sum is written by one thread. Indices are unsigned: signed ones cost numba three instructions at every use.
"""
from typing import NamedTuple

import numpy as np

from continuum.jit import jit
from particles.threads import Threads

u32, u64 = np.uint32, np.uint64
ONE = u64(1)
NOTHING = np.empty(0, u32)


class Cells(NamedTuple):
    """Points sorted into square cells: cell c holds order[start[c]:start[c+1]], at x, y."""
    left: float
    bottom: float
    side: float
    columns: int
    rows: int
    start: np.ndarray
    order: np.ndarray
    x: np.ndarray
    y: np.ndarray


@jit
def counting_sort(cell, start, order):
    """Points by cell, stable: order[start[c]:start[c + 1]] are in cell c; `start` (cells + 1,) zeros."""
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
    """Points by cell, row by row."""
    cell = np.empty(len(x), np.int64)
    for i in range(len(x)):
        cell[i] = int((y[i] - bottom)/side)*columns + int((x[i] - left)/side)
    counting_sort(cell, start, order)


def sort_into_cells(x: np.ndarray, y: np.ndarray, side: float) -> Cells:
    """Linked cells [KHP95, Ref. 13] around the points (N,), two empty cells around them."""
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
    """Copy the points in the square of cells around `home` one behind the other; their number."""
    count = u64(0)
    for row in range(-ring, ring + 1):
        first = home + row*cells.columns
        for k in range(u64(cells.start[first - ring]), u64(cells.start[first + ring + 1])):
            x[count], y[count], j[count] = cells.x[k], cells.y[k], cells.order[k]
            count += ONE
    return count


@jit
def list_rows(first, last, cells, x, y, reach, itself, capacity, start, length, listed):
    """Write the Verlet lists of rows first..last from first*capacity on; False if they do not fit.

    Row i is the listed point i + `itself`, which is left out. Rows of one cell share what is gathered around
    it; comparing all of that before the list is compressed leaves LLVM a loop for vector instructions.
    """
    ring = int(np.ceil(reach/cells.side))
    most = (2*ring + 1)**2*np.diff(cells.start).max()
    near_x, near_y, near, close = np.empty(most), np.empty(most), np.empty(most, u32), np.empty(most, u32)
    far2, used, end_of_room, home, count = reach*reach, u64(first*capacity), u64(last*capacity), -1, u64(0)
    for i in range(u64(first), u64(last)):
        # a place that is outside of all cells looks into the nearest ones
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
        start[i], length[i] = used, found
        for k in range(count):
            listed[used] = near[k]
            used += close[k]
    return True


def make_lists(threads: Threads, cells: Cells, x: np.ndarray, y: np.ndarray, reach: float, itself: int,
               listed: np.ndarray = NOTHING) -> tuple:
    """(start, length, listed) of points within `reach` of (x, y), but for point i + `itself` of row i.

    `listed` of earlier lists is used again where it has room. FloatingPointError: more than 2000 of each.
    """
    occupied = max(int(np.count_nonzero(np.diff(cells.start))), 1)
    density = len(cells.x)/occupied/cells.side**2
    rows, room = len(x), 4 + int(1.1*np.pi*reach**2*density)
    while room < 2000:
        start, length = np.empty(rows, np.uint64), np.empty(rows, u32)
        if len(listed) < rows*room:
            listed = np.empty(int(1.1*rows*room), u32)
        if all(threads(list_rows, rows, cells, x, y, reach, itself, room, start, length, listed)):
            return start, length, listed
        room = int(1.3*room) + 1
    raise FloatingPointError(f"more than {int(room/1.3)} neighbours within {reach:g} of each particle: they "
                             "have collapsed onto each other; lower the step or the attraction")


@jit
def farthest(x, anchor):
    """Largest distance of a point from where it was when the lists were made; coordinates (d, n)."""
    far2 = 0.0
    for i in range(x.shape[1]):
        r2 = 0.0
        for axis in range(x.shape[0]):
            r2 += (x[axis, i] - anchor[axis, i])**2
        far2 = max(far2, r2)
    return np.sqrt(far2)
