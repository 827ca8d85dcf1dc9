"""Exchange over edges, the form of all conservative schemes here, in d = 1, 2, 3    [RR98, Sec. III]

An edge (i, j) has an area vector S_ij = -S_ji and a conductance k_ij = k_ji; points have volumes V_i:

    V_i (div F)_i = sum_j S_ij.(F_i + F_j)/2          conserves, since S is antisymmetric
    V_i (grad f)_i = sum_j S_ij (f_j - f_i)/2         exact on constants; adjoint to -div if edges close
    V_i (lap f)_i = sum_j k_ij (f_j - f_i)            symmetric; no mode grows

RR98's bracket sum_j w_ij e_ij.(...) is this form with S_ij = 2 w_ij V_i V_j e_ji, k_ij = 2 w_ij V_i V_j/r_ij
(Eqs 34-36, 51). Edges close if sum_j S_ij = 0, and are exact on linear fields if 1/2 sum_j S_ij (x_j - x_i) =
V_i 1. Physics is written over edges; schemes differ in how edges are made: `edge_makers` from a weight,
`triangulation` from points alone.
"""
from collections.abc import Callable
from dataclasses import dataclass, fields, replace
from functools import cached_property
from typing import Any

import numpy as np
from scipy import sparse
from scipy.sparse.linalg import eigsh, svds

from particles.integral.points import Points, of_positions


@dataclass(frozen=True, kw_only=True)
class Edges:
    """Edges i -> j, each stored once, with S (E, d), k (E,), apart = x_j - x_i (E, d); volumes V (n,)."""
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
        """The antisymmetric matrices S^alpha_ij, one for each direction alpha."""
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
        """(1/2 V_i) sum_j S_ij (x_j - x_i), (n, d, d): 1 where edges are exact on linear fields."""
        half = 0.5*self.S[:, :, None]*self.apart[:, None, :]
        total = np.zeros((self.n, self.d, self.d))
        np.add.at(total, self.i, half)
        np.add.at(total, self.j, half)
        return total/self.V[:, None, None]

    @cached_property
    def laplacian(self) -> sparse.csr_array:
        """Matrix L with V lap f = L f: symmetric, rows sum to zero."""
        off = self._matrix(self.k, self.k)
        return sparse.csr_array(off - sparse.diags_array(off.sum(axis=1)))

    @cached_property
    def D(self) -> list[sparse.csr_array]:
        """Matrices of V div F = sum_alpha D^alpha F^alpha, with the "+" bracket (F_i + F_j)."""
        return [sparse.csr_array((S + sparse.diags_array(c))/2)
                for S, c in zip(self.areas, self.closure.T, strict=True)]

    @cached_property
    def G(self) -> list[sparse.csr_array]:
        """Matrices of V grad f = G f, with differences f_j - f_i: G = -D^T."""
        return [sparse.csr_array((S - sparse.diags_array(c))/2)
                for S, c in zip(self.areas, self.closure.T, strict=True)]

    @cached_property
    def fastest(self) -> tuple[float, float]:
        """Largest frequency of sound over its speed, largest rate of diffusion over the diffusivity."""
        return _fastest(self.V, self.G, self.laplacian)


def combined(i: np.ndarray, j: np.ndarray, S: np.ndarray, k: np.ndarray, apart: np.ndarray, V: np.ndarray,
             a: float) -> Edges:
    """Edges with i < j; edges between the same points along the same vector are added up."""
    turn = np.where(i > j, -1.0, 1.0)[:, None]
    S, apart, i, j = turn*S, turn*apart, np.minimum(i, j), np.maximum(i, j)
    keys = np.column_stack([i, j, np.round(apart/a*1e6).astype(np.int64)])
    _, first, inverse = np.unique(keys, axis=0, return_index=True, return_inverse=True)
    sums = [np.bincount(inverse.ravel(), q, len(first)) for q in (*S.T, k)]
    return Edges(i=i[first], j=j[first], S=np.stack(sums[:-1], axis=1), k=sums[-1], apart=apart[first], V=V)


def _fastest(V: np.ndarray, G: list[sparse.csr_array], laplacian: sparse.csr_array) -> tuple[float, float]:
    """Largest singular value of the gradient and largest decay rate of the Laplacian, both per volume."""
    root = sparse.diags_array(1/np.sqrt(V))
    slopes = sparse.vstack([root@g@root for g in G])
    sound = svds(slopes, k=1, return_singular_vectors=False, random_state=0)
    spread = eigsh(root@laplacian@root, k=1, which="LM", return_eigenvectors=False,
                   v0=np.cos(np.arange(len(V))))
    return float(sound[0]), float(-spread[0])


def selected(edges: Any, some: np.ndarray) -> Any:
    """Some of the `Edges`, or of the edges `Beyond`; some (E,) : mask or indices."""
    return replace(edges, **{field.name: getattr(edges, field.name)[some] for field in fields(edges)
                             if field.name != "V"})


#: signs of the components of a vector that is mirrored in a plate
MIRROR = np.array([1.0, -1.0])


@dataclass(frozen=True, kw_only=True)
class Beyond:
    """Edges from points i to mirror images of points `parent` behind plate 0 (lower) or 1 (upper)."""
    i: np.ndarray
    parent: np.ndarray
    S: np.ndarray
    k: np.ndarray
    apart: np.ndarray
    plate: np.ndarray


NOWHERE = np.empty(0, int)
#: no images
NONE_BEYOND = Beyond(i=NOWHERE, parent=NOWHERE, S=np.empty((0, 2)), k=np.empty(0), apart=np.empty((0, 2)),
                     plate=NOWHERE)


def fastest(edges: Edges, beyond: Beyond) -> tuple[float, float]:
    """`Edges.fastest` between plates: images have their parents' pressure, and opposite velocity and T."""
    def seen(q: np.ndarray, sign: float) -> sparse.csr_array:
        own, image = (sparse.csr_array((q, (beyond.i, to)), shape=(edges.n, edges.n))
                      for to in (beyond.i, beyond.parent))
        return sparse.csr_array(sign*image - own)
    return _fastest(edges.V, [G + seen(S/2, 1.0) for G, S in zip(edges.G, beyond.S.T, strict=True)],
                    edges.laplacian + seen(beyond.k, -1.0))


def symmetric(edges: Edges, a: float) -> Edges:
    """Mean of edges and their mirror image in y; point m + n/2 is the image of point m."""
    half = edges.n//2
    i, j = ((q + half) % edges.n for q in (edges.i, edges.j))
    joined = np.concatenate
    return combined(joined([edges.i, i]), joined([edges.j, j]), joined([edges.S, edges.S*MIRROR])/2,
                    joined([edges.k]*2)/2, joined([edges.apart, edges.apart*MIRROR]),
                    (edges.V + np.roll(edges.V, half))/2, a)


def check_between(x: np.ndarray, height: float) -> None:
    """Raise ValueError unless all points (n, 2) lie strictly between the plates."""
    out = np.flatnonzero(~(np.abs(x[:, 1]) < height/2*(1 - 1e-9)))
    if len(out):
        i = out[0]
        raise ValueError(f"point {i} at y = {x[i, 1]:g} is not between the plates y = -+{height/2:g} "
                         f"({len(out)} of {len(x)} are not), where its mirror image would be another point's "
                         "or its own: move it inside")


def between_plates(make: Callable[[Points, Any], Edges], x: np.ndarray, width: float, height: float,
                   weight: Any) -> tuple[Edges, Beyond]:
    """Edges among points x (n, 2), periodic in x, and to mirror images in the plates y = -+ height/2.

    The maker gets points and images in a periodic box of twice the height. Its edges are averaged with their
    mirror image, since a triangulation has to choose one of two diagonals. Raises ValueError: a point is on a
    plate or beyond it; and what the maker raises.
    """
    check_between(x, height)
    n = len(x)
    # -height < y < 0: the upper plate is at 0, the lower at the end of the box
    lower = x - np.array([0.0, height/2])
    points = of_positions(np.concatenate([lower, lower*MIRROR]), (width, 2*height))
    try:
        edges = symmetric(make(points, weight), points.a)
    except (ValueError, ArithmeticError) as error:
        error.add_note(f"asked for were edges of {n} points between plates and of their mirror images, point "
                       f"m + {n} that of point m, in a box twice as high")
        raise
    ours, images = (edges.i < n) & (edges.j < n), (edges.i < n) != (edges.j < n)
    inner = replace(selected(edges, ours), V=edges.V[:n])
    back = np.where(edges.i[images] < n, 1.0, -1.0)
    i, parent = np.minimum(edges.i, edges.j)[images], np.maximum(edges.i, edges.j)[images] - n
    S, apart = back[:, None]*edges.S[images], back[:, None]*edges.apart[images]
    upper = lower[i, 1] + apart[:, 1] > 0
    return inner, Beyond(i=i, parent=parent, S=S, k=edges.k[images], apart=apart, plate=upper.astype(int))
