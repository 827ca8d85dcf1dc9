"""Exchange over edges, each evaluated once, many at a time: what one end gains the other loses.

For terms without a branch, so that the loop over edges becomes vector instructions. Dissipation has a branch:
it is added afterwards, on edges that `astir` finds: one by one, or for the whole block, which differs by
round-off. Results do not depend on the number of threads, as blocks of edges do not, and points add up the
exchange of their edges in the order of their rows.
"""

from collections import namedtuple

import numpy as np

from continuum.jit import formula, jit, jit_apart, jit_records
from particles.integral.entropy_fluxes import Dissipation, Logarithmic, astir, jumps, waves
from particles.integral.exchange import At, Conduction, Exchange, Friction, Listing
from particles.integral.lanes import BLOCK, COLUMNS, end_at, read_lanes
from particles.integral.transposed_stress import Mending
from particles.neighbours import u32, u64
from particles.pairs import Face, Faces, pair_at, rate, sweep
from particles.threads import Threads

FEW = 16        # edges of a block that dissipate: if more do, dissipation is computed for the whole block
#: antisymmetric terms of transport: one end gains what the other loses
ALIKE = Friction, Conduction, Mending
Sent = np.dtype([(name, "f8") for name in ("m", "px", "py", "e")])


#: Edges from points i to `near`, each once, as in row i of `Faces`; edges behind the last have no area.
#:
#: edge, sign : of each entry of the rows its edge, and 1 at that edge's point i, -1 at its point `near`.
Once = namedtuple("Once", "i near sx sy k dx dy edge sign")

pair_at.of(Once)(lambda once, h: Face(once.sx[h], once.sy[h], once.k[h], once.dx[h], once.dy[h]))


@formula
def count(edges, stirred):
    number = 0
    for h in edges:
        number += stirred[h]
    return number


def empty_once(entries: int) -> Once:
    """Memory for the edges of rows with so many entries in all."""
    size = -(-entries//int(BLOCK))*int(BLOCK)
    (i, near), (sx, sy, k, dx, dy) = np.zeros((2, size), u32), np.zeros((5, size))
    return Once(i, near, sx, sy, k, dx, dy, np.zeros(entries, u32), np.zeros(entries))


@jit
def fill_once(n, edges, once):
    """Store the edges of n rows, return their number. An entry without `way_back` is an edge by itself."""
    count = u64(0)
    for i in range(u64(n)):
        for e in range(edges.first[i], edges.first[i] + edges.taken[i]):
            j = edges.near[e]
            back = way_back(i, e, edges) if j < i else u64(e)
            if back != e:
                once.edge[e], once.sign[e] = once.edge[back], -1.0
                continue
            once.i[count], once.near[count], once.edge[e], once.sign[e] = i, j, count, 1.0
            once.sx[count], once.sy[count], once.k[count] = edges.sx[e], edges.sy[e], edges.k[e]
            once.dx[count], once.dy[count] = edges.dx[e], edges.dy[e]
            count += u64(1)
    once.sx[count:], once.sy[count:] = 0.0, 0.0
    return count


@jit
def way_back(i, e, edges):
    """Entry of the same edge in the row of its other end, or e if there is none. In a narrow box several
    entries of that row lead to i: the one of opposite area is meant."""
    j, sx, sy = edges.near[e], edges.sx[e], edges.sy[e]
    found, least = u64(e), 1e-6*(abs(sx) + abs(sy)) + 1e-300
    for back in range(edges.first[j], edges.first[j] + edges.taken[j]):
        if edges.near[back] == i:
            off = abs(edges.sx[back] + sx) + abs(edges.sy[back] + sy)
            if off < least:
                found, least = back, off
    return found


@jit_apart
def _carry(first, last, terms, own, points, a, b, once, stirred, sent):
    """Exchange by terms over edges, without the pressures of both ends, which `_receive` adds; marks edges
    that dissipate. a, b : lanes of both ends."""
    for h in range(first, last):
        ab, q = pair_at(once, h), sent[h]
        one, other = end_at(a, h - first, points[once.i[h]]), end_at(b, h - first, points[once.near[h]])
        m, px, py, e = rate(terms, one, other, ab)
        less = own*(other.P + other.hydro - one.P)
        q.m, q.px, q.py, q.e = m, px + less*ab.sx, py + less*ab.sy, e
        stirred[h] = astir(one, other, ab, *jumps(one, other, ab))


@jit_apart
def _stir_all(first, last, term, points, a, b, once, stirred, sent):
    """Add the dissipation of marked edges, computed for all: a branch would end vector instructions."""
    for h in range(first, last):
        ab, q, here = pair_at(once, h), sent[h], 1.0*stirred[h]
        one, other = end_at(a, h - first, points[once.i[h]]), end_at(b, h - first, points[once.near[h]])
        m, px, py, e = waves(term.eos, one, other, ab, *jumps(one, other, ab))
        q.m, q.px, q.py, q.e = q.m + here*m, q.px + here*px, q.py + here*py, q.e + here*e


@jit
def _stir_few(first, last, term, points, once, stirred, sent):
    """Add the dissipation of marked edges, one by one."""
    for h in range(first, last):
        if stirred[h]:
            q = sent[h]
            m, px, py, e = rate(term, points[once.i[h]], points[once.near[h]], pair_at(once, h))
            q.m, q.px, q.py, q.e = q.m + m, q.px + px, q.py + py, q.e + e


@jit
def _send(first, last, terms, rough, own, points, lines, once, stirred, sent):
    """Exchange over blocks of edges. rough : `Dissipation`, or None; lines : points as rows of numbers."""
    a, b = np.empty((COLUMNS, BLOCK)), np.empty((COLUMNS, BLOCK))
    for block in range(u64(first), u64(last)):
        begin, end = block*BLOCK, (block + u64(1))*BLOCK
        read_lanes(lines, once.i, begin, a)
        read_lanes(lines, once.near, begin, b)
        _carry(begin, end, terms, own, points, a, b, once, stirred, sent)
        if rough is not None:
            many = count(range(begin, end), stirred)
            if many > FEW:
                _stir_all(begin, end, rough, points, a, b, once, stirred, sent)
            elif many > 0:
                _stir_few(begin, end, rough, points, once, stirred, sent)


@jit_records
def _receive(first, last, own, slopes, edges, once, sent, total):
    """Add to each point the exchange over its edges, and the pressures that `_carry` leaves out."""
    for i in range(u64(first), u64(last)):
        m, px, py, e = total[i, 0], total[i, 1], total[i, 2], total[i, 3]
        for k in range(edges.first[i], edges.first[i] + edges.taken[i]):
            q, sign = sent[once.edge[k]], once.sign[k]
            m, px, py, e = m + sign*q.m, px + sign*q.px, py + sign*q.py, e + sign*q.e
        total[i, 0], total[i, 3] = m, e
        total[i, 1], total[i, 2] = px - own*slopes[i, 6], py - own*slopes[i, 7]


class Sending(Exchange):
    """Sums of listed terms, each edge evaluated once; transport terms not in `ALIKE` are summed by rows.

    slopes (n, 8) : sums of `positive.Slopes` at the state to be summed. `follow` comes before the first sum.
    """

    def __init__(self, flow: tuple, transport: tuple, slopes: np.ndarray, threads: Threads):
        self.n, self.threads, self.slopes, self.stages = len(slopes), threads, slopes, ()
        self.total = np.zeros((self.n, 4))
        self.rough = next((term for term in flow if isinstance(term, Dissipation)), None)
        carried = tuple(term for term in flow if not isinstance(term, Dissipation))
        # pressure terms leave out the pressure of the row's own point
        self.own = float(any(not isinstance(term, Logarithmic) for term in carried))
        alike = tuple(term for term in transport if isinstance(term, ALIKE))
        self.terms = Listing((*carried, *alike) or (Friction(0.0),))
        self.others = tuple(term for term in transport if not isinstance(term, ALIKE))
        self.once, self.sent = empty_once(0), np.zeros(0, Sent)

    def follow(self, edges: Faces) -> None:
        """Sum over these edges from now on."""
        if len(edges.near) != len(self.once.edge):
            self.once = empty_once(len(edges.near))
            self.stirred, self.sent = np.zeros(len(self.once.i), bool), np.zeros(len(self.once.i), Sent)
        self.blocks = -(-int(fill_once(self.n, edges, self.once))//int(BLOCK))

    def over_edges(self, at: At) -> None:
        points, threads, once, sent, total = at.points, self.threads, self.once, self.sent, self.total
        if self.others:
            threads(sweep, self.n, Listing(self.others), points, at.edges, total)
        else:
            total.fill(0)
        lines = points.view("f8").reshape(len(points), -1)
        threads(_send, self.blocks, self.terms, self.rough, self.own, points, lines, once, self.stirred, sent)
        threads(_receive, self.n, self.own, self.slopes, at.edges, once, sent, total)
