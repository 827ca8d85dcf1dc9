"""Edges of P1 finite elements on the Delaunay triangulation of points: closed and exact on linear fields, no weight."""
from typing import Any

import numpy as np
from scipy.spatial import Delaunay

from particles.edges import Edges, combined
from particles.points import Points


def delaunay(points: Points, weight: Any = None) -> Edges:
    """P1 elements on the Delaunay triangulation: S_ij = A_ij - A_ji, A_ij = int phi_i grad phi_j, V_i = int phi_i.

    Closed and exact on linear fields on any points; the conductances are those of P1, (cot + cot)/2 in 2D. d = 2, 3.

    Raises
    ------
    ValueError
        d = 1, or points of a flat simplex lie on one sphere (a lattice in 3D).
    """
    if points.d == 1:
        raise ValueError("there are no triangles in one dimension: take edges of a weight")
    x, owner = _with_images(points)
    # of four points on a circle all images must get the same diagonal: a shift of 1e-7 spacings decides
    shift = np.random.default_rng(0).uniform(-1e-7, 1e-7, points.x.shape)*points.a
    simplices = Delaunay(x + shift[owner]).simplices
    simplices = simplices[_is_ours(x, simplices, points)]
    corners = x[simplices]                                              # (T, d + 1, d)
    jacobian = corners[:, 1:] - corners[:, :1]
    volume = np.abs(np.linalg.det(jacobian))/(2 if points.d == 2 else 6)
    if volume.min() < 1e-9*points.a**points.d:
        flat = owner[simplices[np.argmin(volume)]]
        raise ValueError(f"points {flat} span a flat simplex: points that lie on one sphere, as on a lattice in 3D, have no "
                         "unique triangulation; shift them a little")
    slopes = np.linalg.inv(jacobian).transpose(0, 2, 1)                 # grad phi_1..d
    slopes = np.concatenate([-slopes.sum(axis=1, keepdims=True), slopes], axis=1)
    return _assembled(points, owner[simplices], corners, volume, slopes)


def _assembled(points: Points, corner: np.ndarray, x: np.ndarray, volume: np.ndarray, slopes: np.ndarray) -> Edges:
    """Sum of all simplices' edges; corner (T, d + 1) are points, slopes (T, d + 1, d) the gradients of phi."""
    n, d = points.n, points.d
    V = np.bincount(corner.ravel(), np.repeat(volume/(d + 1), d + 1), n)
    a, b = np.triu_indices(d + 1, 1)
    i, j = corner[:, a].ravel(), corner[:, b].ravel()
    S = (volume[:, None, None]/(d + 1)*(slopes[:, b] - slopes[:, a])).reshape(-1, d)
    k = -(volume[:, None]*np.einsum("tea,tea->te", slopes[:, a], slopes[:, b])).ravel()
    apart = (x[:, b] - x[:, a]).reshape(-1, d)
    return combined(i, j, S, k, apart, V, points.a)


def _with_images(points: Points) -> tuple[np.ndarray, np.ndarray]:
    """Positions with all images within half a box around, and which point each is of."""
    shifts = np.stack([s.ravel() for s in np.meshgrid(*[[-1, 0, 1]]*points.d, indexing="ij")], axis=1)
    x = (points.x[None] + shifts[:, None]*points.box).reshape(-1, points.d)
    owner = np.tile(np.arange(points.n), len(shifts))
    near = (np.abs(x) < points.box).all(axis=1)
    return x[near], owner[near]


def _is_ours(x: np.ndarray, simplices: np.ndarray, points: Points) -> np.ndarray:
    """Simplices whose middle lies in the box: one of each set of images."""
    middle = x[simplices].mean(axis=1)/points.box
    return ((middle >= -0.5) & (middle < 0.5)).all(axis=1)
