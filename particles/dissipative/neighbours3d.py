"""Linked cells and Verlet lists in three dimensions; those of `particles.neighbours` are in two.

Lists hold both directions of a pair, so that each row of a pair sum is written by one thread. In one layer of
cells these take twice as long as those.
"""
from typing import NamedTuple

import numpy as np
from llvmlite import ir
from numba import types
from numba.extending import intrinsic

from continuum.jit import jit
from particles.neighbours import ONE, counting_sort, u32, u64


class Cubes(NamedTuple):
    """Points sorted into cubes: cell c holds order[start[c]:start[c+1]] at x; counts along x, y, z."""
    low: np.ndarray
    side: float
    counts: np.ndarray
    start: np.ndarray
    order: np.ndarray
    x: np.ndarray


class Lists(NamedTuple):
    """Neighbours listed[start[i]:start[i] + length[i]] of row i."""
    start: np.ndarray
    length: np.ndarray
    listed: np.ndarray


@jit
def _cell(cells, x, k):
    """Number of the cell of a point, layer by layer."""
    c = 0
    for axis in range(2, -1, -1):
        c = c*cells.counts[axis] + int((x[k, axis] - cells.low[axis])/cells.side)
    return c


@jit
def _sort(cells, x):
    """Points by cell."""
    cell = np.empty(len(x), np.int64)
    for k in range(len(x)):
        cell[k] = _cell(cells, x, k)
    counting_sort(cell, cells.start, cells.order)
    for k in range(len(x)):
        cells.x[k] = x[cells.order[k]]


def sort_into_cells(x: np.ndarray, side: float) -> Cubes:
    """Linked cells over points (n, 3), one empty around. FloatingPointError: far more cells than points."""
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
    """Copy the points of the 27 cells around `home` one behind the other; how many there are."""
    count, columns, layer = u64(0), cells.counts[0], cells.counts[0]*cells.counts[1]
    for up in range(-1, 2):
        for row in range(-1, 2):
            first = home + up*layer + row*columns
            for k in range(u64(cells.start[first - 1]), u64(cells.start[first + 2])):
                near[0, count], near[1, count], near[2, count] = cells.x[k, 0], cells.x[k, 1], cells.x[k, 2]
                number[count] = cells.order[k]
                count += ONE
    return count


@intrinsic
def lowest_bit(typingctx, word):
    """Number of the lowest bit of a 64-bit word that is one."""
    def build(context, builder, signature, arguments):
        return builder.cttz(arguments[0], ir.Constant(ir.IntType(1), 1))
    return types.uint64(types.uint64), build


@jit
def _within(x, y, z, far2, near, first):
    """Bits of the 64 points near[:, first:] that are nearer to (x, y, z) than the root of far2."""
    bits = u64(0)
    for b in range(u64(64)):
        dx, dy, dz = near[0, first + b] - x, near[1, first + b] - y, near[2, first + b] - z
        bits |= u64(dx*dx + dy*dy + dz*dz < far2) << b
    return bits


@jit
def list_rows(first, last, n, cells, reach, capacity, lists):
    """Write the lists of those of n particles that are first..last in the cells; False without room.

    What is around a cell is compared 64 at a time, in vector instructions.
    """
    most = 27*np.diff(cells.start).max() + 64
    near, number = np.empty((3, most)), np.empty(most, u32)
    far2, used, room, home, count = reach*reach, u64(first*capacity), u64(last*capacity), -1, u64(0)
    for k in range(u64(first), u64(last)):
        i = cells.order[k]
        if i >= n:
            continue
        c = _cell(cells, cells.x, k)
        if c != home:
            home, count = c, _gather(cells, c, near, number)
            near[0, count:count + u64(64)] = np.inf
        if used + count >= room:
            return False
        begin = used
        for word in range(u64(0), count, u64(64)):
            bits = _within(cells.x[k, 0], cells.x[k, 1], cells.x[k, 2], far2, near, word)
            while bits:
                j = number[word + lowest_bit(bits)]
                bits &= bits - ONE
                lists.listed[used] = j
                used += u64(j != i)
        lists.start[i], lists.length[i] = begin, used - begin
    return True
