"""Makers of edges from points and a weight: RR98's Eq. 29 as printed, plain quadrature, and repairs."""
import warnings
from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
from scipy import sparse
from scipy.sparse.csgraph import connected_components
from scipy.sparse.linalg import MatrixRankWarning, spsolve

from particles.integral.edges import Edges
from particles.integral.fluctuating import incidence
from particles.integral.interpolants import W, check, check_ordering, reach, sphere
from particles.integral.points import Points, pairs
from particles.integral.triangulation import delaunay


def from_weights(points: Points, weight: Any, scale: Callable[[np.ndarray], Any] = lambda r: 1.0) -> Edges:
    """Edges of RR98's bracket sum_j w_ij V_j e_ij.(...), w = scale(r) W(r)."""
    i, j, apart, r = pairs(points, reach(weight))
    both = 2*(scale(r)*W(weight, r))*points.V[i]*points.V[j]/r
    return Edges(i=i, j=j, S=both[:, None]*apart, k=both, apart=apart, V=points.V)


def judged(edges: Edges, points: Points, weight: Any) -> Edges:
    """Return the edges; warn if the weight is too narrow for the points    [Eq. 45]"""
    off = edges.linear - np.eye(points.d)
    check_ordering(weight, points.d, points.a, float(np.sqrt((off**2).sum(axis=(1, 2)).mean()/points.d)))
    return edges


def plain(points: Points, weight: Any) -> Edges:
    """Edges of plain quadrature, W(r_ij) dV in place of W(r) dr. Warns if Eq. 45 does not hold."""
    check(weight, points.d)
    return judged(from_weights(points, weight), points, weight)


def printed(points: Points, weight: Any) -> Edges:
    """RR98 Eq. 29 as printed: W(r) dV -> 4 pi r^2 dV^(1/3) W(r) in 3D, |S_d| r^(d-1) dV^(1/d) W in d.

    This is right along one line from a point only: summed over all neighbours, it multiplies gradients of
    linear fields by (|S_d|/d) M_d (r0/a)^(d-1).
    """
    check(weight, points.d)
    d, a = points.d, points.a
    return judged(from_weights(points, weight, lambda r: sphere(d)*r**(d - 1)*a**(1 - d)), points, weight)


def renormalised(points: Points, weight: Any, warn: bool = True) -> Edges:
    """Plain quadrature times the factor that makes the mean discrete first moment sum_j W r_ij dV equal to d.
    Warns if Eq. 45 does not hold. Raises ValueError: no two points are within the weight's range."""
    check(weight, points.d)
    edges = from_weights(points, weight)
    if not edges.k.any():
        raise ValueError(f"no two of the {points.n} points, on average {points.a:.4g} apart, are within the "
                         f"weight's range {reach(weight):.4g}: take a larger h or more points (Eq. 45)")
    # d times the factor by which gradients of linear fields are off
    c = points.d/float(np.einsum("iaa,i->", edges.linear, edges.V)/edges.V.sum())
    made = replace(edges, S=c*edges.S, k=c*edges.k)
    return judged(made, points, weight) if warn else made


def closed(points: Points, weight: Any) -> Edges:
    """Renormalised edges, S_ij + k_ij (l_j - l_i), l from the graph Laplacian so that all close. Gradients
    keep an error that the disorder sets. Raises ValueError: the points fall into unconnected parts."""
    edges = judged(renormalised(points, weight, False), points, weight)
    l = np.stack([_potential(edges, -c) for c in edges.closure.T], axis=1)
    return replace(edges, S=edges.S + edges.k[:, None]*(l[edges.j] - l[edges.i]))


def _potential(edges: Edges, source: np.ndarray) -> np.ndarray:
    """Potential l (n,) with sum_j k_ij (l_j - l_i) = source_i, zero at point 0."""
    check_connected(edges)
    L = edges.laplacian.tolil()
    L[0, :] = 0
    L[0, 0] = 1
    fixed = source.copy()
    fixed[0] = 0
    return spsolve(sparse.csc_array(L), fixed)


def check_connected(edges: Edges) -> None:
    """Raise ValueError unless edges connect all points."""
    parts, label = connected_components(edges.laplacian, directed=False)
    if parts > 1:
        lonely = int(np.argmax(label == np.argmin(np.bincount(label))))
        raise ValueError(f"the points fall into {parts} parts without an edge between them, point {lonely} "
                         "into the smallest: take a wider weight or more points")


def exact(points: Points, weight: Any) -> Edges:
    """Edges that close and are exact on linear fields, nearest to the renormalised ones in sum (dS)^2/k.

    dS_ij = k_ij [lam_i - lam_j + (mu_i + mu_j).(x_j - x_i)/2] for each direction; lam (n,), mu (n, d) follow
    from the constraints. Raises ArithmeticError: the points are too irregular for the reach of the weight.
    """
    edges = renormalised(points, weight, False)     # these become exact
    check_connected(edges)
    B = _constraints(edges)
    M = sparse.csc_array(B@sparse.diags_array(edges.k)@B.T)
    M[0, 0] *= 2       # lam is determined up to a constant
    columns = []
    for alpha in range(points.d):
        missing = np.outer(np.eye(1 + points.d)[1 + alpha], points.V).ravel() - B@edges.S[:, alpha]
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", MatrixRankWarning)      # raised below
            change = edges.k*(B.T@spsolve(M, missing))
            change += edges.k*(B.T@spsolve(M, missing - B@change))     # refined by the residual
        columns.append(edges.S[:, alpha] + change)
    made = replace(edges, S=np.stack(columns, axis=1))
    worst = np.abs(made.linear - np.eye(points.d)).max()
    if not worst < 1e-9:
        raise ArithmeticError(f"no edges of {type(weight).__name__} close and are exact on linear fields: "
                              f"the best miss by {worst:.2g}: take a wider weight or less random points")
    return made


def _constraints(edges: Edges) -> sparse.csr_array:
    """Matrix B ((1 + d) n, E) of B S = (sum_j S_ij, 1/2 sum_j S_ij (x_j - x_i)), for one direction."""
    across = incidence(edges)
    return sparse.vstack([across, *(abs(across).multiply(q/2) for q in edges.apart.T)], format="csr")


#: makers by name; each makes edges from points and a weight, which `delaunay` ignores
MAKERS: dict[str, Callable[[Points, Any], Edges]] = {"printed": printed, "plain": plain,
                                                     "renormalised": renormalised, "closed": closed,
                                                     "exact": exact, "delaunay": delaunay}
