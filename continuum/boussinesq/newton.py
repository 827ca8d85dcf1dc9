"""Steady states of the discrete equations by Newton's method with sparse LU factors."""
from functools import cached_property

import numpy as np
from scipy import sparse
from scipy.sparse.linalg import splu

from continuum.boussinesq.flow import BoussinesqCase, Equations, State, roll
from continuum.steady import WITHIN, largest, newton

RELAX = 5.0     # the implicit steps before Newton's are RELAX/(largest rate of change) long


class InStreamfunction(Equations):
    """Newton's method in s = (psi, T), without pressure and divergence: q = C s, residual C^T rate."""

    @cached_property
    def C(self) -> sparse.csr_array:
        """Matrix that gives q = (u, v, T) from s = (psi, T)."""
        cells = self.case.rows*self.case.columns
        return sparse.csr_array(sparse.block_diag([self.mac.curl, sparse.eye_array(cells)]))

    @cached_property
    def inertia(self) -> sparse.csr_array:
        """Matrix that is divided by dt in an implicit step."""
        return self.C.T@self.C

    def residual(self, q: np.ndarray) -> np.ndarray:
        """Rates of change of vorticity and temperature."""
        return self.C.T@(self.diffuse(q) + self.drive(q))

    def jacobian(self, q: np.ndarray) -> sparse.csr_array:
        """Derivative of the residual in s."""
        m = self.mac
        slope = sparse.diags_array(m.B@q)@m.A + sparse.diags_array(m.A@q)@m.B
        return self.C.T@(self.diffusion + m.lift - m.D@slope)@self.C

    def step(self, q: np.ndarray, residual: np.ndarray, dt: float) -> np.ndarray:
        """Change of q in one linearised implicit step; dt = inf makes it Newton's.

        The matrix has a symmetric pattern and a dominant diagonal: minimum degree on A + A^T with mild
        pivoting gives factors half as large as those of column ordering.
        """
        lu = splu((self.inertia/dt - self.jacobian(q)).tocsc(), permc_spec="MMD_AT_PLUS_A",
                  diag_pivot_thresh=0.1, options={"SymmetricMode": True})
        return self.C@lu.solve(residual)


def steady(case: BoussinesqCase, start: State | None = None) -> State:
    """Steady state reached from `start`, a state in the same box on any grid, at any Ra, Pr; default: a roll.

    Implicit steps lengthen as rates of change fall and become Newton's. The steady state need not be stable.
    """
    equations, first = InStreamfunction(case), (start or roll(case)).on(case)

    def relaxed(q: np.ndarray) -> np.ndarray:
        residual = equations.residual(q)
        return equations.step(q, residual, RELAX/max(largest(residual), WITHIN*1e-6))
    s = np.r_[first.psi.ravel(), first.parts[2].ravel()]    # steps in s cannot remove a divergence
    q, changes = newton(equations.C@s, relaxed, f"Ra = {case.ra:g}, Pr = {case.pr} on {case.rows} rows")
    return State(case=case, q=q, changes=changes)
