"""What points that move with a flux that survives need of their triangulation, compiled."""
import numpy as np

from continuum.fluid import sound_speed
from continuum.jit import jit
from particles.integral.flips import doubled
from particles.integral.rings import apart
from particles.neighbours import u64
from particles.pairs import Face, rate


@jit
def _sound(first, last, eos, y, points):
    for i in range(first, last):
        a = points[i]
        a.c, a.eps = sound_speed(eos, a.rho, a.e), y[8, i]/y[7, i]
        a.T, a.ux, a.uy = a.Td, a.vx, a.vy


@jit
def _along(first, last, at, rings):
    """What leads along edges."""
    (x, y), edges = at, rings.edges
    for i in range(first, last):
        for e in range(edges.first[i], edges.first[i] + edges.taken[i]):
            edges.dx[e], edges.dy[e] = apart(x, y, rings.size, rings.per, i, edges.near[e])


@jit
def _at_sides(first, last, term, points, rings, slopes):
    """Differences along a side once more, so that slopes there are the mean of triangles', too: where an edge
    ends the ring, S has the middle of the edge for a corner, and a slope has the point itself."""
    edges = rings.edges
    for i in range(first, last):
        if rings.rim[i]:
            for e, part in ((edges.first[i], 1/12), (edges.first[i] + u64(edges.taken[i]) - u64(1), -1/12)):
                ab = Face(part*edges.dy[e], -part*edges.dx[e], 0.0, edges.dx[e], edges.dy[e])
                more = rate(term, points[i], points[edges.near[e]], ab)
                for c in range(8):
                    slopes[i, c] += more[c]


@jit
def _turned(first, last, at, rings):
    """A point with a triangle that has turned over, or -1."""
    (x, y), edges = at, rings.edges
    for i in range(first, last):
        begin, end = edges.first[i], edges.first[i] + u64(edges.taken[i])
        for e in range(begin, end - u64(rings.rim[i])):
            following = e + u64(1) if e + u64(1) < end else begin
            if not doubled(x, y, rings.size, rings.per, i, edges.near[e], edges.near[following]) > 0:
                return i
    return -1
