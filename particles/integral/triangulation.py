"""Edges of P1 finite elements on the Delaunay triangulation: closed, exact on linear fields."""
from itertools import pairwise, product
from typing import Any

import numpy as np
from scipy.spatial import Delaunay, cKDTree

from particles.integral.edges import Edges, combined
from particles.integral.points import Points, of_positions

#: in spacings: shift that decides between equally valid triangulations; least distance of two points
SHIFT, APART = 1e-7, 1e-6
#: margin around a strip of the box from which points are taken at the first attempt, in spacings, in 2D
MARGIN = 8.0
#: points per strip in 2D: to triangulate a million points at once takes twice the memory of all else
AT_ONCE = 100_000


def delaunay(points: Points, weight: Any = None) -> Edges:
    """Edges of P1 elements: S_ij = A_ij - A_ji, A_ij = int phi_i grad phi_j, V_i = int phi_i.

    Closed and exact on linear fields on any points; the conductances are those of P1, (cot + cot)/2 in 2D.
    Raises ValueError: d = 1, two points overlap, or points lie on one sphere (a lattice in 3D).
    """
    return _assembled(points, *_simplices(points, points.box))


def around(points: Points, body: np.ndarray) -> Edges:
    """Edges of `delaunay` without triangles inside a convex body; closed on all points but the body's."""
    corner, x = _simplices(points, points.box)
    fluid = outside(corner, body)
    return _assembled(points, corner[fluid], x[fluid])


def outside(corner: np.ndarray, body: np.ndarray) -> np.ndarray:
    """Which triangles (T, 3) are outside a convex body: not all of their corners are on it, (T,)."""
    return np.logical_not(np.isin(corner, body).all(axis=1))


def between(x: np.ndarray, width: float, height: float, closed: tuple[bool, bool] = (False, True)) -> Edges:
    """Edges of `delaunay` on points (n, 2) between plates, on which some of the points lie.

    closed : whether there are plates at x = -+width/2, at y = -+height/2; other axes are periodic. Closed on
    all points but those on plates, which lack the outward area of the half segments of plate beside them.
    Raises ValueError: a plate has no point, a point is beyond a plate, or two points overlap.
    """
    points = of_positions(x, np.where(closed, 3*np.array([width, height]), (width, height)))
    return _assembled(points, *triangles(x, (width, height), closed))


def triangles(x: np.ndarray, size: tuple[float, float],
              closed: tuple[bool, bool]) -> tuple[np.ndarray, np.ndarray]:
    """Corners of all triangles of `between`: numbers of points (T, 3), and their positions (T, 3, 2)."""
    box, shut = np.array(size), np.array(closed)
    for axis in np.flatnonzero(shut):
        low, high, half = x[:, axis].min(), x[:, axis].max(), box[axis]/2
        if max(abs(low + half), abs(high - half)) > 2e-12*half:
            raise ValueError(f"points lie between {'xy'[axis]} = {low:g} and {high:g}, plates at -+{half:g}: "
                             "put a row of points on each plate")
    # leaves out triangles in the gap from plate to plate, and flat ones along a plate
    return _simplices(of_positions(x, np.where(shut, 3*box, box)), np.where(shut, (1 - 1e-9)*box, box))


def _simplices(points: Points, size: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Corners of all simplices in the box `size`: points (T, d + 1), and their positions (T, d + 1, d)."""
    if points.d == 1:
        raise ValueError("there are no triangles in one dimension: take edges of a weight")
    _check_apart(points)
    # all images of four points on a circle must get the same diagonal: a small shift decides
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
    """Simplices (T, d + 1) of points and images with centroids in the box, low <= x/size_x < high."""
    near = np.abs(x[:, 0] - (low + high)/2*size[0]) <= (high - low)/2*size[0] + margin
    some = np.flatnonzero(near).astype(np.int32)
    simplices = some[Delaunay(shifted[some]).simplices]
    middle = x[np.sort(simplices, axis=1)].mean(axis=1)/size        # bitwise the same in two strips
    inside = (middle >= -0.5) & (middle < 0.5)      # keeps one of all images of a simplex
    inside[:, 0] = (middle[:, 0] >= low) & (middle[:, 0] < high)
    return simplices[inside.all(axis=1)]


def _diameters(x: np.ndarray) -> np.ndarray:
    """Diameters (T,) of the circumcircles of triangles (T, 3, 2), in which no omitted point may lie."""
    a, b, c = (x[:, s] - x[:, s - 1] for s in range(3))
    area = np.abs(a[:, 0]*b[:, 1] - a[:, 1]*b[:, 0])
    return np.sqrt((a**2).sum(axis=1)*(b**2).sum(axis=1)*(c**2).sum(axis=1))/np.maximum(area, 1e-300)


def _check_apart(points: Points) -> None:
    """Check that no points are so near that the shift could reverse them. Raises ValueError."""
    tree = cKDTree((points.x + points.box/2) % points.box, boxsize=points.box*(1 + 1e-15))
    met = tree.query_pairs(APART*points.a, output_type="ndarray")
    if len(met):
        i, j = sorted(met[0])
        raise ValueError(f"points {i} and {j} overlap at {points.x[i]}, or nearly so, where triangles need "
                         f"{APART:g} spacings: move one of them")


def _assembled(points: Points, corner: np.ndarray, x: np.ndarray) -> Edges:
    """Edges, summed over all simplices, of points `corner` (T, d + 1) at x (T, d + 1, d)."""
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
    """Positions of points and of all images within `margin` around the box, and the point of each."""
    images = []
    for shift in product((-1, 0, 1), repeat=points.d):
        x = points.x + shift*points.box
        near = np.flatnonzero((np.abs(x) < points.box/2 + margin).all(axis=1)).astype(np.int32)
        images.append((x[near], near))
    x, owner = map(np.concatenate, zip(*images))
    return x, owner
