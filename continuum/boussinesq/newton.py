"""Steady states of the discrete equations by Newton's method with sparse LU factors."""
from functools import cached_property

import numpy as np
from scipy import sparse
from scipy.sparse.linalg import eigs, splu

from continuum.boussinesq.flow import BoussinesqCase, Equations, State
from continuum.boussinesq.starts import roll
from continuum.steady import NewtonFailed

RELAX = 5.0     # the implicit steps that lead to Newton's are RELAX/(largest rate of change) long
STEPS = 60      # the slowest case that got through took 46 (cavity at Ra = 1e7 on 64 rows)


class Newton(Equations):
    """Steps in s = (psi, T), which leave neither pressure nor divergence: q = C s, residual C^T rate."""

    @cached_property
    def C(self) -> sparse.csr_array:
        """(u, v, T) from (psi, T)."""
        cells = self.case.rows*self.case.columns
        return sparse.csr_array(sparse.block_diag([self.mac.curl, sparse.eye_array(cells)]))

    @cached_property
    def inertia(self) -> sparse.csr_array:
        """What the time step divides in an implicit step."""
        return self.C.T@self.C

    def residual(self, q: np.ndarray) -> np.ndarray:
        """Rates of change of vorticity and temperature."""
        return self.C.T@(self.diffuse(q) + self.drive(q))

    def jacobian(self, q: np.ndarray) -> sparse.csr_array:
        """Slope of the residual in s."""
        m = self.mac
        slope = sparse.diags_array(m.B@q)@m.A + sparse.diags_array(m.A@q)@m.B
        return self.C.T@(self.diffusion + m.lift - m.D@slope)@self.C

    def step(self, q: np.ndarray, residual: np.ndarray, dt: float) -> np.ndarray:
        """Change of q in one linearised implicit step; dt = inf makes it Newton's.

        The matrix is symmetric in structure and heavy on the diagonal: minimum degree on A + A^T with mild
        pivoting makes factors half as large as column ordering does.
        """
        lu = splu((self.inertia/dt - self.jacobian(q)).tocsc(), permc_spec="MMD_AT_PLUS_A",
                  diag_pivot_thresh=0.1, options={"SymmetricMode": True})
        return self.C@lu.solve(residual)


def steady(case: BoussinesqCase, start: State | None = None, *, within: float = 1e-9) -> State:
    """The steady state that start leads to: a roll, or a state of any grid, Ra and Pr in the same box.

    Implicit steps lengthen as the rates of change fall and become Newton's, until no value changes by more
    than `within`. The state need not be stable.
    """
    if case.mac.periodic:
        raise ValueError(f"the box is periodic ({case.box}): its steady flows may be shifted, which leaves "
                         "Newton no unique answer; solve the half with SYMMETRY sides, or use transient")
    newton, first = Newton(case), (start or roll(case)).on(case)
    q = newton.C@np.r_[first.psi.ravel(), first.parts[2].ravel()]   # steps in s never mend a divergence
    residual = newton.residual(q)
    sizes = [largest(residual)]
    for _ in range(STEPS):
        change = newton.step(q, residual, RELAX/max(sizes[-1], within*1e-6))
        q = q + change
        residual = newton.residual(q)
        sizes.append(largest(residual))
        if not np.isfinite(sizes[-1]):
            break
        if largest(change) < within:
            return State(case=case, q=q, residuals=tuple(sizes))
    last = ", ".join(f"{size:.1e}" for size in sizes[-5:])
    raise NewtonFailed(f"no steady state in {len(sizes) - 1} steps at Ra = {case.ra}, Pr = {case.pr}, "
                       f"{case.rows} rows; last rates of change {last}: start from the steady state of a "
                       "smaller Ra, refine the grid, or see with transient whether there is one")


def growth_rates(state: State, count: int = 4, near: float = 0.2) -> np.ndarray:
    """The growth rates (complex, fastest first) of disturbances of a steady state; below zero it is stable.

    They are the `count` eigenvalues nearest to `near`, which should be above the fastest: nothing in free
    fall grows faster than 1. Only disturbances with the symmetry of the box count.
    """
    newton = Newton(state.case)
    slope, inertia = newton.jacobian(state.q).tocsc(), newton.inertia.tocsc()
    first = np.sin(1.0 + np.arange(slope.shape[0]))     # any will do, but the same each time
    found = eigs(slope, count, inertia, sigma=near, v0=first, return_eigenvectors=False)
    return found[np.argsort(-found.real)]


def largest(a: np.ndarray) -> float:
    """Largest magnitude."""
    return float(np.max(np.abs(a)))
