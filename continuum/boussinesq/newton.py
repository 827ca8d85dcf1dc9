"""Steady states of the discrete equations by Newton's method with sparse LU factors."""
from functools import cached_property

import numpy as np
from scipy import sparse
from scipy.sparse.linalg import eigs, splu

from continuum.boussinesq.flow import BoussinesqCase, Equations, State
from continuum.boussinesq.starts import roll
from continuum.steady import largest, newton

RELAX = 5.0     # the implicit steps that lead to Newton's are RELAX/(largest rate of change) long


class InStreamfunction(Equations):
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
    equations, first = InStreamfunction(case), (start or roll(case)).on(case)

    def relaxed(q: np.ndarray) -> np.ndarray:
        residual = equations.residual(q)
        return equations.step(q, residual, RELAX/max(largest(residual), within*1e-6))
    s = np.r_[first.psi.ravel(), first.parts[2].ravel()]    # steps in s never mend a divergence
    q, changes = newton(equations.C@s, relaxed, within,
                        f"Ra = {case.ra:g}, Pr = {case.pr} on {case.rows} rows")
    return State(case=case, q=q, changes=changes)


def growth_rates(state: State, count: int = 4, near: float = 0.2) -> np.ndarray:
    """The growth rates (complex, fastest first) of disturbances of a steady state; below zero it is stable.

    They are the `count` eigenvalues nearest to `near`, which should be above the fastest: nothing in free
    fall grows faster than 1. Only disturbances with the symmetry of the box count.
    """
    equations = InStreamfunction(state.case)
    slope, inertia = equations.jacobian(state.q).tocsc(), equations.inertia.tocsc()
    first = np.sin(1.0 + np.arange(slope.shape[0]))     # any will do, but the same each time
    found = eigs(slope, count, inertia, sigma=near, v0=first, return_eigenvectors=False)
    return found[np.argsort(-found.real)]
