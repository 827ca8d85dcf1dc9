"""Exchange over edges: the form that all conservative schemes here have, in d = 1, 2, 3    [RR98, Sec. III]

An edge (i, j) has an area vector S_ij = -S_ji and a conductance k_ij = k_ji; points have volumes V_i:

    V_i (div F)_i = sum_j S_ij.(F_i + F_j)/2          conserves, since S is antisymmetric
    V_i (grad f)_i = sum_j S_ij (f_j - f_i)/2         exact on constants; the adjoint of -div where edges close
    V_i (lap f)_i = sum_j k_ij (f_j - f_i)            never grows

RR98's bracket sum_j w_ij e_ij.(...) is this form with S_ij = 2 w_ij V_i V_j e_ji, k_ij = 2 w_ij V_i V_j/r_ij (Eqs 34-36, 51).
Edges close if sum_j S_ij = 0, and are exact on linear fields if 1/2 sum_j S_ij (x_j - x_i) = V_i 1. Physics is written over
edges; schemes differ in who makes them: the functions below take points (and a weight) and give edges.
"""
from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from scipy import sparse
from scipy.sparse.csgraph import connected_components
from scipy.sparse.linalg import eigsh, spsolve, svds
from scipy.spatial import Delaunay

from particles.interpolants import W, check, reach, sphere
from particles.points import Points, of_positions, pairs


@dataclass(frozen=True, kw_only=True)
class Edges:
    """Edges i -> j (each once) with S (E, d), k (E,) and apart = x_j - x_i (E, d); volumes V (n,) of the points."""
    i: np.ndarray
    j: np.ndarray
    S: np.ndarray
    k: np.ndarray
    apart: np.ndarray
    V: np.ndarray

    @property
    def n(self) -> int:
        return len(self.V)

    @property
    def d(self) -> int:
        return self.S.shape[1]

    @cached_property
    def areas(self) -> list[sparse.csr_array]:
        """The antisymmetric matrices S^alpha_ij, one a direction."""
        return [self._matrix(s, -s) for s in self.S.T]

    def _matrix(self, forward: np.ndarray, back: np.ndarray) -> sparse.csr_array:
        rows, columns = np.concatenate([self.i, self.j]), np.concatenate([self.j, self.i])
        return sparse.csr_array((np.concatenate([forward, back]), (rows, columns)), shape=(self.n, self.n))

    @cached_property
    def closure(self) -> np.ndarray:
        """sum_j S_ij, (n, d): zero where edges close."""
        return np.stack([S.sum(axis=1) for S in self.areas], axis=1)

    @cached_property
    def linear(self) -> np.ndarray:
        """(1/2 V_i) sum_j S_ij (x_j - x_i), (n, d, d): the unit matrix where edges are exact on linear fields."""
        half = 0.5*self.S[:, :, None]*self.apart[:, None, :]
        total = np.zeros((self.n, self.d, self.d))
        np.add.at(total, self.i, half)
        np.add.at(total, self.j, half)
        return total/self.V[:, None, None]

    @cached_property
    def laplacian(self) -> sparse.csr_array:
        """L_ij with V lap f = L f: symmetric, rows sum to zero."""
        off = self._matrix(self.k, self.k)
        return sparse.csr_array(off - sparse.diags_array(off.sum(axis=1)))

    @cached_property
    def D(self) -> list[sparse.csr_array]:
        """V div F = sum_alpha D^alpha F^alpha, with the "+" bracket (F_i + F_j)."""
        return [sparse.csr_array((S + sparse.diags_array(c))/2) for S, c in zip(self.areas, self.closure.T, strict=True)]

    @cached_property
    def G(self) -> list[sparse.csr_array]:
        """V grad f = G f with differences f_j - f_i: G = -D^T."""
        return [sparse.csr_array((S - sparse.diags_array(c))/2) for S, c in zip(self.areas, self.closure.T, strict=True)]

    @cached_property
    def fastest(self) -> tuple[float, float]:
        """Largest frequency of sound over its speed, and largest rate of diffusion over the diffusivity."""
        root = sparse.diags_array(1/np.sqrt(self.V))
        slopes = sparse.vstack([root@G@root for G in self.G])
        sound = svds(slopes, k=1, return_singular_vectors=False, random_state=0)
        spread = eigsh(root@self.laplacian@root, k=1, which="LM", return_eigenvectors=False, v0=np.cos(np.arange(self.n)))
        return float(sound[0]), float(-spread[0])

    def div(self, F: np.ndarray) -> np.ndarray:
        """Divergence of F (n, d)."""
        return sum(D@f for D, f in zip(self.D, F.T, strict=True))/self.V

    def grad(self, f: np.ndarray) -> np.ndarray:
        """Gradient (n, d) of f (n,)."""
        return np.stack([G@f for G in self.G], axis=1)/self.V[:, None]

    def lap(self, f: np.ndarray) -> np.ndarray:
        """Laplacian of f (n,)."""
        return self.laplacian@f/self.V


def from_weights(points: Points, weight: Any, w: np.ndarray, near: tuple[np.ndarray, ...]) -> Edges:
    """Edges of RR98's bracket with scaled weights w (pairs,): sum_j w_ij V_j e_ij.(...)."""
    i, j, apart, r = near
    both = 2*w*points.V[i]*points.V[j]/r
    return Edges(i=i, j=j, S=both[:, None]*apart, k=both, apart=apart, V=points.V)


def plain(points: Points, weight: Any) -> Edges:
    """Plain quadrature, W(r_ij) dV in place of W(r) dr."""
    check(weight, points.d)
    near = pairs(points, reach(weight))
    return from_weights(points, weight, W(weight, near[3]), near)


def printed(points: Points, weight: Any) -> Edges:
    """RR98 Eq. 29 as printed, in 3D W(r) dV -> 4 pi r^2 dV^(1/3) W(r); |S_d| r^(d-1) dV^(1/d) W in d dimensions.

    Right along one line from a point only: summed over all points around, it multiplies gradients of linear fields by
    (|S_d|/d) M_d (r0/a)^(d-1).
    """
    check(weight, points.d)
    d, near = points.d, pairs(points, reach(weight))
    r = near[3]
    return from_weights(points, weight, sphere(d)*r**(d - 1)*points.a**(1 - d)*W(weight, r), near)


def renormalised(points: Points, weight: Any) -> Edges:
    """Plain quadrature times the number that makes the mean discrete first moment sum_j W r_ij dV equal to d."""
    edges = plain(points, weight)
    first = float(np.einsum("iaa,i->", edges.linear, edges.V)/edges.V.sum())    # d times the factor of linear gradients
    c = points.d/first
    return Edges(i=edges.i, j=edges.j, S=c*edges.S, k=c*edges.k, apart=edges.apart, V=edges.V)


def closed(points: Points, weight: Any) -> Edges:
    """A': S_ij + k_ij (l_j - l_i), l from the graph Laplacian so that all edges close.

    Conserves, keeps uniform flow uniform, is skew; its gradients are wrong by a fixed share that the disorder sets.

    Raises
    ------
    ValueError
        The points fall into parts without an edge between them.
    """
    edges = renormalised(points, weight)
    l = np.stack([_potential(edges, -c) for c in edges.closure.T], axis=1)
    S = edges.S + edges.k[:, None]*(l[edges.j] - l[edges.i])
    return Edges(i=edges.i, j=edges.j, S=S, k=edges.k, apart=edges.apart, V=edges.V)


def _potential(edges: Edges, source: np.ndarray) -> np.ndarray:
    """l with sum_j k_ij (l_j - l_i) = source_i."""
    check_connected(edges)
    L = edges.laplacian.tolil()
    L[0, :] = 0
    L[0, 0] = 1
    fixed = source.copy()
    fixed[0] = 0
    return spsolve(sparse.csc_array(L), fixed)


def check_connected(edges: Edges) -> None:
    """Refuse points in several parts."""
    parts, label = connected_components(edges.laplacian, directed=False)
    if parts > 1:
        lonely = int(np.argmax(label == np.argmin(np.bincount(label))))
        raise ValueError(f"the points fall into {parts} parts without an edge between them (point {lonely} is in the "
                         "smallest): take a wider weight or more points")


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


def combined(i: np.ndarray, j: np.ndarray, S: np.ndarray, k: np.ndarray, apart: np.ndarray, V: np.ndarray, a: float) -> Edges:
    """Edges with i < j, those that join the same points added up.

    Two points may be joined in two directions where the box is a few spacings wide: told apart by where they lead.
    """
    turn = np.where(i > j, -1.0, 1.0)[:, None]
    S, apart, i, j = turn*S, turn*apart, np.minimum(i, j), np.maximum(i, j)
    keys = np.column_stack([i, j, np.round(apart/a*1e6).astype(np.int64)])
    _, first, inverse = np.unique(keys, axis=0, return_index=True, return_inverse=True)
    sums = [np.bincount(inverse.ravel(), q, len(first)) for q in (*S.T, k)]
    return Edges(i=i[first], j=j[first], S=np.stack(sums[:-1], axis=1), k=sums[-1], apart=apart[first], V=V)


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


def exact(points: Points, weight: Any) -> Edges:
    """The nearest edges to the renormalised ones, in the norm sum (dS)^2/k, that close and are exact on linear fields.

    dS_ij = k_ij [lam_i - lam_j + (mu_i + mu_j).(x_j - x_i)/2] for each direction, lam (n,), mu (n, d) from the constraints.

    Raises
    ------
    ArithmeticError
        The constraints cannot be met: the points are too irregular for the reach of the weight.
    """
    edges = renormalised(points, weight)
    check_connected(edges)
    B = _constraints(edges)
    M = sparse.csc_array(B@sparse.diags_array(edges.k)@B.T)
    M[0, 0] *= 2       # lam is determined up to a constant
    columns = []
    for alpha in range(points.d):
        wanted = np.zeros((points.n, 1 + points.d))
        wanted[:, 1 + alpha] = points.V
        missing = wanted.ravel(order="F") - B@edges.S[:, alpha]
        columns.append(edges.S[:, alpha] + edges.k*(B.T@spsolve(M, missing)))
    made = Edges(i=edges.i, j=edges.j, S=np.stack(columns, axis=1), k=edges.k, apart=edges.apart, V=edges.V)
    worst = np.abs(made.linear - np.eye(points.d)).max()
    if not worst < 1e-9:
        raise ArithmeticError(f"no edges of {type(weight).__name__} close and are exact on linear fields: the best miss the "
                              f"unit matrix by {worst:.2g}; take a wider weight or less random points")
    return made


def _constraints(edges: Edges) -> sparse.csr_array:
    """B with B S = (sum_j S_ij, 1/2 sum_j S_ij (x_j - x_i)) for one direction: rows (1 + d) n, edges as columns."""
    e, n = np.arange(len(edges.i)), edges.n
    rows, columns = [edges.i, edges.j], [e, e]
    values = [np.ones(len(e)), -np.ones(len(e))]
    for beta in range(edges.d):
        for end in (edges.i, edges.j):
            rows.append((1 + beta)*n + end)
            columns.append(e)
            values.append(edges.apart[:, beta]/2)
    return sparse.csr_array((np.concatenate(values), (np.concatenate(rows), np.concatenate(columns))),
                            shape=((1 + edges.d)*n, len(e)))


#: by name; each makes edges of points and a weight, which `delaunay` does not use
MAKERS: dict[str, Callable[[Points, Any], Edges]] = {"printed": printed, "plain": plain, "renormalised": renormalised,
                                                     "closed": closed, "exact": exact, "delaunay": delaunay}


MIRROR = np.array([1.0, -1.0])


@dataclass(frozen=True, kw_only=True)
class Beyond:
    """Edges from points i to the mirror images of points `parent` behind plate 0 (lower) or 1 (upper), each one way only."""
    i: np.ndarray
    parent: np.ndarray
    S: np.ndarray
    k: np.ndarray
    apart: np.ndarray
    plate: np.ndarray


def symmetric(edges: Edges, a: float) -> Edges:
    """Mean of edges and their mirror image in y = 0, where point m + n/2 is the image of point m."""
    half = edges.n//2
    i, j = ((q + half) % edges.n for q in (edges.i, edges.j))
    joined = np.concatenate
    return combined(joined([edges.i, i]), joined([edges.j, j]), joined([edges.S, edges.S*MIRROR])/2, joined([edges.k]*2)/2,
                    joined([edges.apart, edges.apart*MIRROR]), (edges.V + np.roll(edges.V, half))/2, a)


def between_plates(make: Callable[[Points, Any], Edges], x: np.ndarray, width: float, height: float,
                   weight: Any) -> tuple[Edges, Beyond]:
    """Edges among points x (n, 2), periodic in x, and to their mirror images in the plates y = -+ height/2.

    The maker sees points and images together, a box twice as high that is periodic. What it makes is averaged with its own
    mirror image (two points and their images lie on one circle: a triangulation has to choose one of two diagonals).
    """
    n, shift = len(x), np.array([0.0, height/2])
    lower = x - shift                                        # -height < y < 0; the upper plate is at 0, the lower at the edge
    points = of_positions(np.concatenate([lower, lower*MIRROR]), (width, 2*height))
    edges = symmetric(make(points, weight), points.a)
    ours, images = (edges.i < n) & (edges.j < n), (edges.i < n) != (edges.j < n)
    inner = Edges(**{name: getattr(edges, name)[ours] for name in ("i", "j", "S", "k", "apart")}, V=edges.V[:n])
    turn = np.where(edges.i[images] < n, 1.0, -1.0)
    i, parent = np.minimum(edges.i, edges.j)[images], np.maximum(edges.i, edges.j)[images] - n
    S, apart = turn[:, None]*edges.S[images], turn[:, None]*edges.apart[images]
    upper = lower[i, 1] + apart[:, 1] > 0
    return inner, Beyond(i=i, parent=parent, S=S, k=edges.k[images], apart=apart, plate=upper.astype(int))
