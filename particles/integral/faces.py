"""Faces between moving points that close and are exact on linear fields, in 2D.

With x_ij = x_j - x_i, F = -w'/r of a weight w and volumes V:

    B_i = (sum_j V_j F x x)^-1,  s_i = 2/sum_j V_j F r^2,  k_ij = V_i V_j F (s_i + s_j)
    S_ij = V_i V_j F (B_i + B_j) x_ij + k_ij [phi_j - phi_i + (psi_i + psi_j).x_ij]

phi, psi follow from sum_j S_ij = 0 and 1/2 sum_j S_ij x_ij = V_i 1: symmetric positive equations, solved by
conjugate gradients that start from the last solution.
"""
import numpy as np

from continuum.jit import jit
from particles.lists import PairLists, ghosts_of
from particles.neighbours import u64
from particles.pairs import Faces, pair_term, sweep

#: unknowns of the equations for faces
POTENTIALS = ("phi_x", "psi_xx", "psi_xy", "phi_y", "psi_yx", "psi_yy")
Metric = np.dtype([(name, "f8") for name in ("V", "xx", "xy", "yy", "s")])
Potential = np.dtype([(name, "f8") for name in POTENTIALS])


@pair_term(6)
def Closing(term, a, b, ab):
    """Closure, with a minus, and moments of k [phi_j - phi_i + (psi_i + psi_j).x_ij], for S_x and S_y."""
    gx = ab.k*(b.phi_x - a.phi_x + (a.psi_xx + b.psi_xx)*ab.dx + (a.psi_xy + b.psi_xy)*ab.dy)
    gy = ab.k*(b.phi_y - a.phi_y + (a.psi_yx + b.psi_yx)*ab.dx + (a.psi_yy + b.psi_yy)*ab.dy)
    return -gx, gx*ab.dx, gx*ab.dy, -gy, gy*ab.dx, gy*ab.dy


class FaceMaker:
    """Makes faces between points, closed by at most `iterations` steps, to the relative residual `within`.

    faces : those made last. pull (n, 2) : sum_j V_j F x_ij, towards denser points. ghosts : of the lists.
    """

    def __init__(self, around: PairLists, iterations: int, within: float):
        self.around, self.n, self.threads = around, around.n, around.threads
        self.most, self.within = iterations, within
        self.pull = np.zeros((self.n, 2))
        self.lists_made, self._store = -1, np.empty((5, 0))

    def make(self, state: np.ndarray, V: np.ndarray, solution: np.ndarray) -> None:
        """Make pairs and faces of points at state[:2] with volumes V (n,); solution (6, n) in place."""
        around, n, pairs = self.around, self.n, self.around.pairs
        around.place(state, 1.0)
        if self.lists_made != around.lists_made:        # as many ghosts may have other origins
            self.lists_made, self.ghosts = around.lists_made, ghosts_of(around)
            self.metric, self.potential = (np.zeros(len(around.x), kind) for kind in (Metric, Potential))
        if self._store.shape[1] != len(pairs.near):
            self._store = np.empty((5, len(pairs.near)))
        self.faces = Faces(pairs.first, pairs.taken, pairs.near, *self._store)
        self.metric["V"][:n] = V
        self.ghosts.fill(self.metric, ("V",))
        self.threads(_metric, n, pairs, around.x, around.y, self.metric, self.pull)
        self.ghosts.fill(self.metric, ("xx", "yy", "s"), ("xy",))
        self.threads(_open_faces, n, pairs, around.x, around.y, self.metric, self.faces)
        if self.most:
            self._close(solution)

    def _close(self, solution: np.ndarray) -> None:
        """Correct the faces so that they close and are exact on linear fields."""
        n, (wanted, scale) = self.n, np.empty((2, self.n, 6))
        self.threads(_lacking_faces, n, self.faces, self.metric, wanted, scale)
        x = solution.T.copy()
        self._solve(x, wanted, scale)
        solution[:] = x.T
        _to_records(x, *self.ghosts[:2], self.potential)
        self.threads(_close_faces, n, self.faces, self.potential)

    def _apply(self, x: np.ndarray, out: np.ndarray) -> None:
        _to_records(x, *self.ghosts[:2], self.potential)
        self.threads(sweep, self.n, Closing(), self.potential, self.faces, out)

    def _solve(self, x: np.ndarray, wanted: np.ndarray, scale: np.ndarray) -> None:
        """Solve for x in place by Jacobi-preconditioned conjugate gradients."""
        product = np.empty_like(x)
        self._apply(x, product)
        r = wanted - product
        z = r/scale
        p, rz = z.copy(), inner(r, z)
        enough = self.within**2*inner(wanted, wanted/scale)
        for _ in range(self.most):
            if rz <= enough:
                return
            self._apply(p, product)
            step = rz/inner(p, product)
            x += step*p
            r -= step*product
            z = r/scale
            rz, before = inner(r, z), rz
            p = z + rz/before*p


def inner(a: np.ndarray, b: np.ndarray) -> float:
    """Sum of products, without BLAS, whose threads would sum in another order."""
    return float((a*b).sum())


@jit
def _metric(first, last, pairs, x, y, metric, shift):
    """B, s and the pull sum_j V_j F x_ij of each point, which is zero at even spacing."""
    for i in range(first, last):
        xx, xy, yy, px, py = 0.0, 0.0, 0.0, 0.0, 0.0
        for k in range(pairs.first[i], pairs.first[i] + pairs.taken[i]):
            j = pairs.near[k]
            V, dx, dy = metric[j].V, x[j] - x[i], y[j] - y[i]
            fx, fy = V*pairs.wx[k], V*pairs.wy[k]        # V F x_ij
            xx, xy, yy, px, py = xx + fx*dx, xy + fx*dy, yy + fy*dy, px + fx, py + fy
        a, det = metric[i], xx*yy - xy*xy
        a.xx, a.xy, a.yy, a.s = yy/det, -xy/det, xx/det, 2/(xx + yy)
        shift[i, 0], shift[i, 1] = px, py


@jit
def _open_faces(first, last, pairs, x, y, metric, faces):
    for i in range(u64(first), u64(last)):
        a = metric[i]
        for k in range(pairs.first[i], pairs.first[i] + pairs.taken[i]):
            j = pairs.near[k]
            b, dx, dy, wx, wy = metric[j], x[j] - x[i], y[j] - y[i], pairs.wx[k], pairs.wy[k]
            VV, xx, xy, yy = a.V*b.V, a.xx + b.xx, a.xy + b.xy, a.yy + b.yy
            faces.sx[k], faces.sy[k] = 0.5*VV*(xx*wx + xy*wy), 0.5*VV*(xy*wx + yy*wy)
            faces.k[k] = VV*(wx*dx + wy*dy)/(dx*dx + dy*dy)*(a.s + b.s)
            faces.dx[k], faces.dy[k] = dx, dy


@jit
def _lacking_faces(first, last, faces, metric, wanted, scale):
    """Residuals of closure and exactness, for S_x and S_y, and the diagonal of the equations for phi, psi."""
    for i in range(first, last):
        cx, cy, xx, xy, yx, yy, k0, kx, ky = 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
        for k in range(faces.first[i], faces.first[i] + faces.taken[i]):
            sx, sy, c, dx, dy = 2*faces.sx[k], 2*faces.sy[k], faces.k[k], faces.dx[k], faces.dy[k]
            cx, cy, xx, xy, yx, yy = cx + sx, cy + sy, xx + sx*dx, xy + sx*dy, yx + sy*dx, yy + sy*dy
            k0, kx, ky = k0 + c, kx + c*dx*dx, ky + c*dy*dy
        two_V = 2*metric[i].V
        wanted[i, 0], wanted[i, 1], wanted[i, 2] = cx, two_V - xx, -xy
        wanted[i, 3], wanted[i, 4], wanted[i, 5] = cy, -yx, two_V - yy
        for c in range(0, 6, 3):
            scale[i, c], scale[i, c + 1], scale[i, c + 2] = k0, kx, ky


@jit
def _to_records(x, origin, turn, potential):
    n = len(x)
    for i in range(n):
        a = potential[i]
        a.phi_x, a.psi_xx, a.psi_xy, a.phi_y, a.psi_yx, a.psi_yy = x[i]
    for g in range(len(origin)):
        a, s = potential[n + g], turn[g]
        phi_x, psi_xx, psi_xy, phi_y, psi_yx, psi_yy = x[origin[g]]
        a.phi_x, a.psi_xx, a.psi_xy = phi_x, psi_xx, s*psi_xy
        a.phi_y, a.psi_yx, a.psi_yy = s*phi_y, s*psi_yx, psi_yy


@jit
def _close_faces(first, last, faces, potential):
    for i in range(u64(first), u64(last)):
        a = potential[i]
        for k in range(faces.first[i], faces.first[i] + faces.taken[i]):
            b, half, dx, dy = potential[faces.near[k]], 0.5*faces.k[k], faces.dx[k], faces.dy[k]
            faces.sx[k] += half*(b.phi_x - a.phi_x + (a.psi_xx + b.psi_xx)*dx + (a.psi_xy + b.psi_xy)*dy)
            faces.sy[k] += half*(b.phi_y - a.phi_y + (a.psi_yx + b.psi_yx)*dx + (a.psi_yy + b.psi_yy)*dy)
