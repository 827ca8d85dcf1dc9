"""Compiled loops of `moving_stable`: points that move with their triangulation and an entropy-stable flux."""
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
def _gained(first, last, h, g, total, bench, y, before, after):
    """Add the exchange of a time h to the state; write the densities before and after it."""
    once, flow = bench.once, bench.flow
    for i in range(first, last):
        m, px, py, E, V = y[6, i], y[4, i], y[5, i], y[8, i], y[7, i]
        before[0, i], before[1, i], before[2, i], before[3, i] = m/V, px/V, py/V, E/V
        E, py_new = E + h*(total[i, 3] + once[i, 2] - g*py), py + h*(total[i, 2] + once[i, 1] - g*m)
        m, px, V = m + h*total[i, 0], px + h*(total[i, 1] + once[i, 0]), V + h*flow[i]
        y[6, i], y[4, i], y[5, i], y[8, i], y[7, i] = m, px, py_new, E, V
        after[0, i], after[1, i], after[2, i], after[3, i] = m/V, px/V, py_new/V, E/V


@jit
def _along(first, last, at, rings):
    """Separations dx, dy along edges, at places `at`."""
    (x, y), edges = at, rings.edges
    for i in range(first, last):
        for e in range(edges.first[i], edges.first[i] + edges.taken[i]):
            edges.dx[e], edges.dy[e] = apart(x, y, rings.size, rings.per, i, edges.near[e])


@jit
def _at_sides(first, last, term, points, rings, slopes):
    """Correct slopes of points on sides to the mean over their triangles: at an end of a chain S takes the
    middle of the edge for the missing corner, where a slope takes the point itself."""
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
    """A point with a triangle that has turned over at places `at`, or -1."""
    (x, y), edges = at, rings.edges
    for i in range(first, last):
        begin, end = edges.first[i], edges.first[i] + u64(edges.taken[i])
        for e in range(begin, end - u64(rings.rim[i])):
            following = e + u64(1) if e + u64(1) < end else begin
            if not doubled(x, y, rings.size, rings.per, i, edges.near[e], edges.near[following]) > 0:
                return i
    return -1
