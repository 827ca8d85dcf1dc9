"""Fixed points of a layer in two or three dimensions, by sparse matrices: ideal gas, constant coefficients.

The equations of `dih` with transport along edges and corrected heating, and the images of `layer`. Every
bracket consists of a point's own fields and linear sums over its neighbours, such as sum_j S.(rho_i v_j +
rho_j v_i) = rho_i sum_j S.v_j + v_i.sum_j S rho_j. An image has its parent's field or the negative of it,
which the matrices include. Positions are (x, z, y) or (x, y), y upwards. The stress is that of the plane gas,
eta (grad v + grad v^T - 1 div v), so that zeta = -eta/3 in 3D: forces along edges depend on eta alone [Eq.
51, A = 0], and flows uniform along z are those of the plane.
"""
from collections.abc import Callable
from typing import Any

import numpy as np
from scipy import sparse

from continuum.fluid import Fields, IdealGas, conductivity, constant_viscosity, viscosity
from particles.fields import from_densities
from particles.integral.dih import densities
from particles.integral.edges import Edges, check_between
from particles.integral.points import Points, of_positions
from particles.method import OwnRates


class Layer3D(OwnRates):
    """A fluid on points x (n, d) of a `RayleighBenard`, periodic along all axes but the last, with `periods`.

    make : makes edges from points and a weight; edges of mirrored points must be mirrored, as with weights.
    """

    def __init__(self, scene: Any, x: np.ndarray, periods: tuple[float, ...],
                 make: Callable[[Points, Any], Edges], weight: Any):
        check(scene, x, periods)
        super().__init__(scene)
        self.x, self.n, self.names = x, len(x), ("rho", "px", *("pz",)[:len(periods) - 1], "py", "eps")
        self.eta, self.kappa = viscosity(scene.law, 1.0, 1.0), conductivity(scene.law, 1.0, 1.0)
        mirror, up = np.append(np.ones(len(periods)), -1.0), np.append(np.zeros(len(periods)), scene.L/2)
        both = np.concatenate([x - up, (x - up)*mirror])
        edges = make(of_positions(both, (*periods, 2*scene.L)), weight)
        self.V = edges.V[:self.n]
        self.even, self.odd = zip(*(self.folded(S/2) for S in edges.areas), strict=True)
        self.k_even, self.k_odd = self.folded(edges.laplacian)
        self.closure = self.over(self.even, np.ones(self.n))[0]
        beyond = (edges.i < self.n) & (edges.j >= self.n)
        i, parent, upper = edges.i[beyond], edges.j[beyond] - self.n, edges.apart[beyond, -1] > 0
        self.to_plates = [np.bincount(i, edges.k[beyond]*at, self.n) for at in (~upper, upper)]
        rise = 2*x[parent, -1] - np.where(upper, scene.L, -scene.L)     # height of parents above images
        self.hydro = [sparse.csr_array((q, (i, parent)), shape=(self.n, self.n))
                      for q in scene.g*rise*edges.S[beyond].T/2]

    def folded(self, matrix: Any) -> tuple[sparse.csr_array, sparse.csr_array]:
        """The matrix on points, for fields that images share with their parents, and that they reverse."""
        own, image = matrix[:self.n, :self.n], matrix[:self.n, self.n:]
        return own + image, own - image

    def over(self, matrices: Any, *fields: np.ndarray) -> np.ndarray:
        """sum_j S_ij/2 f_j of each field, (fields, d, n)."""
        columns = np.stack(fields, axis=1)
        return np.stack([(M@columns).T for M in matrices], axis=1)

    def state(self, rho: np.ndarray, v: np.ndarray, T: Any) -> np.ndarray:
        """(2 + d, n) of densities (n,), velocities (n, d), temperatures."""
        return densities(self.eos, rho, v, T)

    def fields(self, state: np.ndarray) -> Fields:
        return from_densities(self.eos, self.x, self.V, state[0], state[1:-1], state[-1])

    def rates(self, state: np.ndarray, out: np.ndarray) -> None:
        """d(state)/dt, written to `out`    [Eqs 34-36, 51]"""
        at, d = self.fields(state), len(state) - 2
        rho, p, eps, T, v = state[0], state[1:-1], state[-1], at.T, at.v.T
        even, odd = self.over(self.even, rho, eps, T, *p[:-1], *v[:-1]), self.over(self.odd, p[-1], *v)
        D_rho, D_eps, D_T, *D_p = *even[:2 + d], odd[0]
        flow, hydro = traced([*even[2 + d:], odd[-1]]), np.stack([H@rho for H in self.hydro])
        out[0] = -rho*flow - (v*D_rho).sum(axis=0)
        out[1:-1] = self.eta*(self.k_odd@at.v).T - p*flow - np.einsum("an,ban->bn", v, D_p)
        out[1:-1] -= rho*D_T + T*D_rho + hydro
        out[-1] = self.heat(v, T) - eps*flow - (v*(D_eps + rho*D_T + hydro)).sum(axis=0) - T*traced(D_p)
        out[-1] += self.mended(v, odd[1:] - self.closure*v[:, None])
        out /= self.V
        out[-2:] -= self.scene.g*state[[0, -2]]

    def heat(self, v: np.ndarray, T: np.ndarray) -> np.ndarray:
        """Work of friction along edges, and conduction, through plates as well: (n,)."""
        plates = self.scene.T_hot*self.to_plates[0] + self.scene.T_cold*self.to_plates[1]
        return self.eta/2*(self.k_even@(v**2).sum(axis=0)) + self.kappa*(self.k_odd@T + 2*plates)

    def mended(self, v: np.ndarray, slope: np.ndarray) -> np.ndarray:
        """Correction of heating, S.F, F_a = eta (v_b d_b v_a - v_a div v), slope[a, b] = V d_b v_a: (n,)."""
        F = self.eta/self.V*(np.einsum("bn,abn->an", v, slope) - v*traced(slope))
        through = (M@f for M, f in zip((*self.even[:-1], self.odd[-1]), F, strict=True))
        return sum(through) + (self.closure*F).sum(axis=0)

    def heat_through(self, state: np.ndarray, plate: int) -> float:
        """Heat per time that enters through plate 0 (lower) or 1."""
        T_plate = (self.scene.T_hot, self.scene.T_cold)[plate]
        return float(2*self.kappa*self.to_plates[plate]@(T_plate - self.fields(state).T))


def traced(D: Any) -> Any:
    """Trace of D, the sum of D[a][a]."""
    return sum(q[a] for a, q in enumerate(D))


def check(scene: Any, x: np.ndarray, periods: tuple[float, ...]) -> None:
    """Check fluid, sides, dimensions, and that points are between the plates. Raises ValueError."""
    if not (isinstance(scene.eos, IdealGas) and constant_viscosity(scene.law)
            and scene.sides.axes == (True, False)):
        raise ValueError(f"a layer in space is IdealGas with ConstEta and Periodic() sides, got {scene.eos}, "
                         f"{scene.law}, {scene.sides}: take these, or `Layer` in the plane")
    if x.ndim != 2 or not x.shape[1] == len(periods) + 1 in (2, 3):
        raise ValueError(f"points (n, d), d = 2 or 3, have d - 1 periods, got {x.shape} and {periods}: "
                         "the height is that of the scene")
    check_between(x[:, -2:], scene.L)
