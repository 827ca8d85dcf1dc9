"""Edges of P1 finite elements on the Delaunay triangulation: closed, exact on linear fields."""
from itertools import pairwise, product
from typing import Any

import numpy as np
from scipy.spatial import Delaunay, cKDTree

from particles.integral.edges import Edges, combined
from particles.integral.points import Points, of_positions

#: spacings: a shift where several triangulations are right, and the least distance that keeps their order
SHIFT, APART = 1e-7, 1e-6
#: spacings beyond a strip of the box in which points are looked for first, in 2D
MARGIN = 8.0
#: points of a strip in 2D: triangles of a million at once take twice the memory of all else
AT_ONCE = 100_000


def delaunay(points: Points, weight: Any = None) -> Edges:
    """P1 elements on the triangulation: S_ij = A_ij - A_ji, A_ij = int phi_i grad phi_j, V_i = int phi_i.

    Closed and exact on linear fields on any points; the conductances are those of P1, (cot + cot)/2 in 2D.
    Raises ValueError: d = 1, two points overlap, or points lie on one sphere (a lattice in 3D).
    """
    return _assembled(points, *_simplices(points, points.box))


def around(points: Points, body: np.ndarray) -> Edges:
    """The same without triangles that have all corners on a convex body: closed on all points but these."""
    corner, x = _simplices(points, points.box)
    fluid = outside(corner, body)
    return _assembled(points, corner[fluid], x[fluid])


def outside(corner: np.ndarray, body: np.ndarray) -> np.ndarray:
    """Which of the triangles (T, 3) have not all corners on a convex body, (T,)."""
    return ~np.isin(corner, body).all(axis=1)


def between(x: np.ndarray, width: float, height: float, closed: tuple[bool, bool] = (False, True)) -> Edges:
    """The same on points (n, 2), some of which lie on plates: y = -+height/2, and if `closed` says so of the
    first axis, x = -+width/2; along the other axis periodic.

    Closed on all points but those on plates, which lack half of the plate beside the point, outwards. Raises
    ValueError: there is no point on one of the plates, or one beyond them; or two points overlap.
    """
    points = of_positions(x, np.where(closed, 3*np.array([width, height]), (width, height)))
    return _assembled(points, *triangles(x, (width, height), closed))


def triangles(x: np.ndarray, size: tuple[float, float],
              closed: tuple[bool, bool]) -> tuple[np.ndarray, np.ndarray]:
    """Corners of all triangles of `between`: points (T, 3), and where these are, (T, 3, 2)."""
    box, shut = np.array(size), np.array(closed)
    for axis in np.flatnonzero(shut):
        low, high, half = x[:, axis].min(), x[:, axis].max(), box[axis]/2
        if max(abs(low + half), abs(high - half)) > 2e-12*half:
            raise ValueError(f"points lie between {'xy'[axis]} = {low:g} and {high:g}, plates at -+{half:g}: "
                             "put a row of points on each plate")
    # neither those in the gap from plate to plate nor flat ones along a plate
    return _simplices(of_positions(x, np.where(shut, 3*box, box)), np.where(shut, (1 - 1e-9)*box, box))


def _simplices(points: Points, size: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Corners of all simplices in the box `size`: points (T, d + 1), and where these are, (T, d + 1, d)."""
    if points.d == 1:
        raise ValueError("there are no triangles in one dimension: take edges of a weight")
    _check_apart(points)
    # of four points on a circle all images must get the same diagonal: a small shift decides
    shift = np.random.default_rng(0).uniform(-SHIFT, SHIFT, points.x.shape)*points.a
    for margin in (MARGIN*points.a, points.box.max()/2)[points.d - 2:]:
        x, owner = _with_images(points, np.minimum(margin, points.box/2))
        cuts = pairwise(np.linspace(-0.5, 0.5, 2 + (points.n//AT_ONCE if points.d == 2 else 0)))
        simplices = np.concatenate([_strip(x, x + shift[owner], size, margin, *ends) for ends in cuts])
        at = x[simplices]
        if points.d > 2 or _diameters(at).max() < margin:
            break
    return owner[simplices], at


def _strip(x: np.ndarray, shifted: np.ndarray, size: np.ndarray, margin: float, low: float,
           high: float) -> np.ndarray:
    """Simplices (T, d + 1) of points and images whose middles are in the box, low <= x/size_x < high."""
    near = np.abs(x[:, 0] - (low + high)/2*size[0]) <= (high - low)/2*size[0] + margin
    some = np.flatnonzero(near).astype(np.int32)
    simplices = some[Delaunay(shifted[some]).simplices]
    middle = x[np.sort(simplices, axis=1)].mean(axis=1)/size        # the same to the last bit in two strips
    inside = (middle >= -0.5) & (middle < 0.5)      # one of each set of images
    inside[:, 0] = (middle[:, 0] >= low) & (middle[:, 0] < high)
    return simplices[inside.all(axis=1)]


def _diameters(x: np.ndarray) -> np.ndarray:
    """Of the circles through triangles (T, 3, 2): no point that is left out may lie in one."""
    a, b, c = (x[:, s] - x[:, s - 1] for s in range(3))
    area = np.abs(a[:, 0]*b[:, 1] - a[:, 1]*b[:, 0])
    return np.sqrt((a**2).sum(axis=1)*(b**2).sum(axis=1)*(c**2).sum(axis=1))/np.maximum(area, 1e-300)


def _check_apart(points: Points) -> None:
    """Refuse points that the shift could move past each other, and too thin triangles."""
    tree = cKDTree((points.x + points.box/2) % points.box, boxsize=points.box*(1 + 1e-15))
    met = tree.query_pairs(APART*points.a, output_type="ndarray")
    if len(met):
        i, j = sorted(met[0])
        raise ValueError(f"points {i} and {j} overlap at {points.x[i]}, or nearly so, where triangles need "
                         f"{APART:g} spacings: move one of them")


def _assembled(points: Points, corner: np.ndarray, x: np.ndarray) -> Edges:
    """Sum of all simplices' edges; corner (T, d + 1) are points, at x (T, d + 1, d)."""
    n, d = points.n, points.d
    jacobian = x[:, 1:] - x[:, :1]
    volume = np.abs(np.linalg.det(jacobian))/(2 if d == 2 else 6)
    if volume.min() < 1e-9*points.a**d:
        raise ValueError(f"points {corner[np.argmin(volume)]} span a flat simplex, as on one sphere or on a "
                         "lattice in 3D: shift them, or let a weight make the edges")
    slopes = np.linalg.inv(jacobian).transpose(0, 2, 1)                 # grad phi_1..d
    slopes = np.concatenate([-slopes.sum(axis=1, keepdims=True), slopes], axis=1)
    V = np.bincount(corner.ravel(), np.repeat(volume/(d + 1), d + 1), n)
    a, b = np.triu_indices(d + 1, 1)
    i, j = corner[:, a].ravel(), corner[:, b].ravel()
    S = (volume[:, None, None]/(d + 1)*(slopes[:, b] - slopes[:, a])).reshape(-1, d)
    k = -(volume[:, None]*np.einsum("tea,tea->te", slopes[:, a], slopes[:, b])).ravel()
    apart = (x[:, b] - x[:, a]).reshape(-1, d)
    return combined(i, j, S, k, apart, V, points.a)


def _with_images(points: Points, margin: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Positions with all images within `margin` around the box, and which point each is of."""
    images = []
    for shift in product((-1, 0, 1), repeat=points.d):
        x = points.x + shift*points.box
        near = np.flatnonzero((np.abs(x) < points.box/2 + margin).all(axis=1)).astype(np.int32)
        images.append((x[near], near))
    x, owner = map(np.concatenate, zip(*images))
    return x, owner
