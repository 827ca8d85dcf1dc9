"""The only pair loops: `weigh` finds pairs in range and their weights, `sweep` sums terms over them."""
from collections import namedtuple
from collections.abc import Callable
from typing import Any

import numpy as np

from continuum.jit import INLINED, ORDERED, generic, jit, jit_records, overload
from particles.neighbours import ONE, Lists, u32, u64
from particles.weights import shape, slope

#: Verlet lists, and the pairs in range among the listed points.
#:
#: The list of row i is listed[start[i]:start[i] + length[i]], its pairs are near, wx, wy [first[i]:first[i]
#: + taken[i]]: near = j, (wx, wy) = grad_i m w(r_ij).
Pairs = namedtuple("Pairs", "start length listed first taken near wx wy")

#: Edges of fixed points: row i has near, sx, sy, k [first[i]:first[i] + taken[i]]; (sx, sy) = S_ij/2.
Stored = namedtuple("Stored", "first taken near sx sy k")

#: Edges of moving points: as `Stored`, with (dx, dy) = x_j - x_i in addition.
Faces = namedtuple("Faces", "first taken near sx sy k dx dy")


def empty_pairs(lists: Lists) -> Pairs:
    """The lists with uninitialised arrays for as many pairs."""
    rows, room = len(lists.start), len(lists.listed)
    return Pairs(*lists, np.empty(rows, u64), np.empty(rows, u32), np.empty(room, u32), *np.empty((2, room)))


def entries(pairs: Any, rows: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Row, and index in the pair arrays, of every pair of some rows, in the order of these rows."""
    first, taken = (q[rows].astype(np.int64) for q in (pairs.first, pairs.taken))
    before = np.cumsum(taken) - taken
    return np.repeat(rows, taken), np.repeat(first - before, taken) + np.arange(taken.sum())


#: Output of sums (rows, columns) for the rows from `begin` on, in place of an array of all rows.
Block = namedtuple("Block", "begin sums")

#: Geometry of a pair, as a pair term reads it: the gradient of m w(r_ab) with respect to r_a.
Pair = namedtuple("Pair", "wx wy")

#: Geometry of an edge, as a pair term reads it: half of the area vector, S_ab/2, and conductance k.
Edge = namedtuple("Edge", "sx sy k")

#: Geometry of an `Edge` with the vector along it, (dx, dy) = x_b - x_a.
Face = namedtuple("Face", "sx sy k dx dy")


@generic
def pair_at(pairs, k):
    """Geometry of the k-th pair, as a term reads it."""


pair_at.of(Pairs)(lambda pairs, k: Pair(pairs.wx[k], pairs.wy[k]))
pair_at.of(Stored)(lambda pairs, k: Edge(pairs.sx[k], pairs.sy[k], pairs.k[k]))
pair_at.of(Faces)(lambda pairs, k: Face(pairs.sx[k], pairs.sy[k], pairs.k[k], pairs.dx[k], pairs.dy[k]))


@jit
def weigh(first, last, weight, m, x, y, pairs, rho):
    """rho_i = sum_j m w(r_ij), the particle itself included, and grad_i m w(r_ij), for rows first..last.

    The list is compressed without a branch, which would be mispredicted for one entry in three. The square
    roots follow in a loop of their own over the pairs in range, which LLVM vectorises.
    """
    h2, per_h, per_slope = weight.h*weight.h, 1/weight.h, m*weight.scale/weight.h**2
    begin = pairs.start[first] if first < last else u64(0)
    for i in range(u64(first), u64(last)):
        xi, yi, end = x[i], y[i], begin
        for k in range(pairs.start[i], pairs.start[i] + pairs.length[i]):
            j = pairs.listed[k]
            dx, dy = xi - x[j], yi - y[j]
            pairs.near[end], pairs.wx[end], pairs.wy[end] = j, dx, dy
            end += u64(dx*dx + dy*dy < h2)
        total = shape(weight, 0.0)
        for k in range(begin, end):
            dx, dy = pairs.wx[k], pairs.wy[k]
            q = np.sqrt(dx*dx + dy*dy)*per_h
            total += shape(weight, q)
            f = per_slope*slope(weight, q)
            pairs.wx[k], pairs.wy[k] = f*dx, f*dy
        rho[i] = m*weight.scale*total
        pairs.first[i], pairs.taken[i], begin = begin, end - begin, end


@generic
def rate(term, a, b, ab):
    """Contribution of the pair (a, b) to the sum of a, a tuple, from both records and the pair's geometry."""


@generic
def zero(term):
    """The empty sum of a term: a tuple of zeros."""


def register_term(kind: type, columns: int, formula: Callable) -> type:
    """Make a formula the `rate` of a type of term, whose sums have so many columns."""
    empty = (0.0,)*columns
    zero.of(kind)(lambda term: empty)
    rate.of(kind)(formula)
    return kind


def pair_term(columns: int, *names: str, **defaults: Any) -> Any:
    """Decorator that turns a formula(term, a, b, ab) into a term, a type with these numbers.

    The formula gives the gain of `a`, a tuple of so many columns. On edges, ab is an `Edge`, points have rho,
    vx, vy, T, P, eps, eta, k, and ux, uy, Td as friction and heat see them; columns are mass, momentum (2),
    energy.
    """
    def term(formula: Callable) -> Any:
        usual: Any = {"defaults": defaults.values(), "module": formula.__module__}
        kind: Any = namedtuple(formula.__name__, [*names, *defaults], **usual)  # type: ignore[misc]
        kind.__doc__ = formula.__doc__
        return register_term(kind, columns, formula)
    return term


def add(one: tuple, other: tuple) -> Any:
    """Sum of two tuples, element by element."""


def store(out: np.ndarray, i: int, k: int, values: tuple) -> Any:
    """out[i, k:] = values; out: an array or a Block."""


@overload(add, jit_options=ORDERED | INLINED)
def _(one, other):
    if len(one) == 1:
        return lambda one, other: (one[0] + other[0],)
    return lambda one, other: (one[0] + other[0],) + add(one[1:], other[1:])


@overload(store, jit_options=ORDERED | INLINED)
def _(out, i, k, values):
    if getattr(out, "instance_class", None) is Block:
        def impl(out, i, k, values):
            store(out.sums, i - u64(out.begin), k, values)
    elif len(values) == 1:
        def impl(out, i, k, values):
            out[i, k] = values[0]
    else:
        def impl(out, i, k, values):
            out[i, k] = values[0]
            store(out, i, k + ONE, values[1:])
    return impl


@jit_records
def sweep(first, last, term, particle, pairs, out):
    """out[i] = sum_j rate(term, i, j, ij) over the pairs of each row, first..last; `particle`: records."""
    for i in range(u64(first), u64(last)):
        a, total, begin = particle[i], zero(term), pairs.first[i]
        for k in range(begin, begin + pairs.taken[i]):
            total = add(total, rate(term, a, particle[pairs.near[k]], pair_at(pairs, k)))
        store(out, i, u64(0), total)


@jit
def interpolate(first, last, weight, m, at_x, at_y, lists, x, y, values, out):
    """out[i] = sum_j m values[j] w(|r_i - r_j|) over the listed points j of place i."""
    start, length, listed = lists
    for i in range(u64(first), u64(last)):
        out[i] = 0.0
        for k in range(start[i], start[i] + length[i]):
            j = listed[k]
            r = np.sqrt((at_x[i] - x[j])**2 + (at_y[i] - y[j])**2)
            w = m*weight.scale*shape(weight, min(r/weight.h, 1.0))
            for c in range(values.shape[1]):
                out[i, c] += w*values[j, c]
