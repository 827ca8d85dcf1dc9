"""A 2D triangulation as rings, compiled: the ring of a point lists its neighbours counterclockwise.

Only flips change rings. In the ring of i, the neighbours k after j and l before j determine edge (i, j):
S_ij = R(x_k - x_l)/3, R(x, y) = (y, -x), and k_ij = (cot_k + cot_l)/2, as in linear finite elements. V_i is a
third of the area of the triangles around i. An edge with k_ij < 0 is not Delaunay. The ring of a point on a
side is a chain from one neighbour on the side to the other; there the middle of the edge replaces the missing
corner.
"""

from collections import namedtuple

import numpy as np

from continuum.jit import formula, jit
from particles.integral.edges import NOWHERE
from particles.integral.triangulation import outside, triangles
from particles.neighbours import u32, u64
from particles.pairs import Stored

#: a conductance counts as negative below this; above, it may be round-off of points on one circle
FLAT = -1e-9
#: smallest room of a ring, which exceeds its number of neighbours; points per spare row, see `flips.lengthen`
ROOM, POINTS = 7, 16
#: width of strips in spacings: neighbours lie in few runs of memory; wider strips cost a third more
STRIP = 2.0
LEAST = 8.0         # spacings along a periodic axis: in a narrower box a point may be a neighbour twice


#: edges : rows of neighbours in order, S/2, k. rim (n,) : whether the ring is a chain. size (2,) : of the
#: box; per (2,) : 1/size along periodic axes, else 0. room (n,) : of each row; end (1,) : of all rows.
Rings = namedtuple("Rings", "edges rim size per room end")


def rings(x: np.ndarray, size: tuple[float, float], closed: tuple[bool, bool],
          body: np.ndarray = NOWHERE) -> Rings:
    """Rings of the Delaunay triangulation of points (n, 2) in a box of this size.

    closed : axes along which triangles end at sides. body : points on a convex body, where they end, too.
    Raises ValueError: the box is less than LEAST spacings wide along a periodic axis, triangles around a
    point form no ring, and what `triangulation` raises.
    """
    spacing = float(np.sqrt(size[0]*size[1]/len(x)))
    for name, length, shut in zip("xy", size, closed):
        if not shut and length < LEAST*spacing*(1 - 1e-9):
            raise ValueError(f"the box is {length/spacing:.3g} spacings wide along {name}, where it is "
                             f"periodic: a moving triangulation needs {LEAST:g}, or a point meets its image")
    corner, _ = triangles(x, size, closed)      # counterclockwise
    corner = corner[outside(corner, body)]
    spokes = np.concatenate([corner, np.roll(corner, -1, axis=1), np.roll(corner, -2, axis=1)])
    spokes = spokes[np.lexsort((spokes[:, 1], spokes[:, 0]))]
    count = np.bincount(spokes[:, 0], minlength=len(x))
    table = np.full((len(x), int(count.max()) + 1), -1, np.int32)
    rim, ends = np.zeros(len(x), bool), np.cumsum(count)
    for i in range(len(x)):
        rows = spokes[ends[i] - count[i]:ends[i], 1:]
        ring, rim[i] = _follow(rows)
        if len(set(ring)) < max(2, len(rows) + rim[i]):
            raise ValueError(f"the triangles around point {i} at {x[i]} are no ring: look for points in one "
                             "place, or a side without a row of points")
        table[i, :len(ring)] = ring
    return remade(rows_of(table, rim, np.array(size, float), np.where(closed, 0.0, 1/np.array(size))))


def table_of(rings: Rings) -> np.ndarray:
    """Table of neighbours (n, stride), filled up with -1."""
    at, live = _places(rings)
    return np.where(live, rings.edges.near[at].astype(np.int32), -1)


def spokes(rings: Rings) -> tuple[np.ndarray, ...]:
    """Neighbours, k, S_x/2, S_y/2 of each point, (n, stride) each; rows are filled up with k = S = 0."""
    at, live = _places(rings)
    return rings.edges.near[at], live*rings.edges.k[at], live*rings.edges.sx[at], live*rings.edges.sy[at]


def _places(rings: Rings) -> tuple[np.ndarray, np.ndarray]:
    """Indices of the entries of each point, (n, stride), and whether each of them exists."""
    columns = np.arange(rings.edges.taken.max())
    live = columns < rings.edges.taken[:, None]
    return (rings.edges.first[:, None] + columns.astype(u64)*live), live


def rows_of(table: np.ndarray, rim: np.ndarray, size: np.ndarray, per: np.ndarray) -> Rings:
    """Rings from a table as of `table_of`; S and k are zeros, which take no memory until they are written."""
    n, stride = table.shape
    edges = Stored((stride*np.arange(n)).astype(u64), (table >= 0).sum(axis=1).astype(u32),
                   np.maximum(table, 0).astype(u32).ravel(), *np.zeros((3, n*stride)))
    return Rings(edges, rim, size, per, np.full(n, stride, np.uint8), np.array([n*stride]))


def remade(rings: Rings, order: np.ndarray | None = None) -> Rings:
    """Copy of rings with S = k = 0 and spare capacity for flips; rows in another order if one is given."""
    order = np.arange(len(rings.rim)) if order is None else order
    taken = rings.edges.taken[order]
    room = np.maximum(ROOM, taken + u32(1))
    ends = np.cumsum(room, dtype=u64)
    entries = int(ends[-1]) + 2*ROOM*(1 + len(order)//POINTS)
    edges = Stored(ends - room, taken, np.zeros(entries, u32), *np.zeros((3, entries)))
    _renumber(order, np.argsort(order), rings.edges, edges)
    return rings._replace(edges=edges, room=room.astype(np.uint8), end=np.array([ends[-1]], int))


@jit
def _renumber(order, place, old, new):
    """Copy the neighbours of rows `order`, numbered by their `place` in it."""
    for i in range(len(order)):
        shift = old.first[order[i]] - new.first[i]
        for e in range(new.first[i], new.first[i] + new.taken[i]):
            new.near[e] = place[old.near[e + shift]]


def in_order(x: np.ndarray, size: np.ndarray) -> np.ndarray:
    """Order of points (2, n) along strips of STRIP spacings: neighbours are near each other in memory."""
    strip = np.floor(x[0]/(STRIP*np.sqrt(size.prod()/x.shape[1])))
    return np.lexsort((x[1], strip))


def _follow(rows: np.ndarray) -> tuple[list[int], bool]:
    """Ring from rows (b, c), in which c follows b, and whether it is a chain: its first one follows none."""
    after = dict(rows.tolist())
    first = [b for b in after if b not in after.values()]
    ring = [*first[-1:], *after][:1]
    while ring and ring[-1] in after:
        ring.append(after.pop(ring[-1]))
    return (ring, True) if first else (ring[:-1], False)


@formula
def apart(x, y, size, per, i, j):
    """x_j - x_i, to the nearest image of j."""
    dx, dy = x[j] - x[i], y[j] - y[i]
    return dx - size[0]*np.rint(dx*per[0]), dy - size[1]*np.rint(dy*per[1])


@jit
def geometry(first, last, at, rings, V, pull, spread, crossed, only=None):
    """S/2 and k of rows first..last, V, spread: sum_j k_ij/V_i, pull: from points to their triangles' centre.

    crossed[i] : whether an edge to a point j > i must be flipped. V is nan where a triangle has turned over.
    only (n,) : which of the rows to compute; None for all.
    """
    (x, y), size, per, near = at, rings.size, rings.per, rings.edges.near
    for i in range(u64(first), u64(last)):
        if only is not None and not only[i]:
            continue
        begin, count, rim = rings.edges.first[i], u64(rings.edges.taken[i]), rings.rim[i]
        end = begin + count - u64(1)
        lx, ly = apart(x, y, size, per, i, near[end])
        jx, jy = apart(x, y, size, per, i, near[begin])
        low = lx*jy - ly*jx                                   # twice the area before edge e
        cot = 0.0 if rim else (lx*(lx - jx) + ly*(ly - jy))/low
        if rim:
            lx, ly, low = 0.5*jx, 0.5*jy, 0.0
        total, px, py, ks, least, crossed[i] = 0.0, 0.0, 0.0, 0.0, 1.0, False
        for e in range(begin, begin + count):
            following = e + u64(1) if e < end else begin
            kx, ky = apart(x, y, size, per, i, near[following])
            if rim and e == end:
                rings.edges.sx[e], rings.edges.sy[e] = (0.5*jy - ly)/6, (lx - 0.5*jx)/6
                rings.edges.k[e] = 0.5*cot
                ks += rings.edges.k[e]
                break
            area = jx*ky - jy*kx
            k = (kx*(kx - jx) + ky*(ky - jy))/area
            rings.edges.sx[e], rings.edges.sy[e] = (ky - ly)/6, (lx - kx)/6
            rings.edges.k[e] = 0.5*(cot + k)
            if rings.edges.k[e] < FLAT and near[e] > i and not (rim and e == begin):
                crossed[i] = True
            ks += rings.edges.k[e]
            total += area
            px += area*(jx + kx)
            py += area*(jy + ky)
            least = min(least, area)
            cot = (jx*(jx - kx) + jy*(jy - ky))/area
            lx, ly, jx, jy = jx, jy, kx, ky
        V[i], spread[i] = total/6 if least > 0 else np.nan, 6*ks/total
        pull[i, 0], pull[i, 1] = px/(3*total), py/(3*total)
