"""Samples of linear fluctuations about a layer heated from below, as cases    [RR98 Eqs 20-25]

The matrices are those of `fluct_flows`, wave by wave; steps of Crank-Nicolson, whose steady covariance is that of the Lyapunov
solve at any step. A complex system of waves runs as the real one of its real and imaginary parts.
"""
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from scipy import sparse

from particles.integral.covariance import crank_nicolson, steady
from particles.run import Plan
from studies.kit.case import Case, Outcome, Report
from studies.kit.stats import over_seeds
from studies.noise.fluctuations.flows import BelowOnset
from studies.noise.fluctuations.sampling import BATCHES, Linear, batches

FIELDS = tuple(f"{part} {name}" for part in ("re", "im") for name in ("rho", "px", "py", "eps"))
#: of decay times of the slowest mode in a batch: with 20 of them variances are good to 6 %, 2/sqrt(20*60)
DECAYS = 60
#: far above the decay of short waves; what that slows is counted, as decay times are those of the steps
DT = 10.0


def apart(M: np.ndarray) -> np.ndarray:
    """Real (2 m, 2 n) of a complex (m, n) matrix: what it does to real and imaginary parts."""
    return np.block([[M.real, -M.imag], [M.imag, M.real]])


def factor(Q: np.ndarray) -> np.ndarray:
    """B (N, N) with B B^* = Q of a Hermitian Q.

    Raises
    ------
    ArithmeticError
        Q has a negative eigenvalue: it is the covariance of no noise.
    """
    values, vectors = np.linalg.eigh(Q)
    if values[0] < -1e-12*values[-1]:       # round-off of sums over some ten edges
        raise ArithmeticError(f"Q has the eigenvalue {values[0]:.3g}, the largest being {values[-1]:.3g}: no noise has a "
                              "negative variance; look at the partners of the dissipation")
    return vectors*np.sqrt(np.maximum(values, 0))


def sampled(J: np.ndarray, Q: np.ndarray, modes: np.ndarray, seed: int, report: Report, decays: float) -> list[dict[str, float]]:
    """Variances of `modes` (m, N) of dx = J x dt + noise of covariance Q, complex: exact, and the ratio of samples to that."""
    exact = np.einsum("mi,ij,mj->m", modes, steady(J, Q), modes.conj()).real
    slow = -np.log(np.abs(np.linalg.eigvals(crank_nicolson(J, Q, DT).A)).max())
    # a complex random number of unit variance has two parts of a half
    method = Linear(J=apart(J), B=sparse.csr_array(apart(factor(Q))/np.sqrt(2)), seed=seed, modes=apart(modes), names=FIELDS)
    means: dict[str, Any] = {"modes": lambda sums, state: sums.found**2}
    plan = Plan(dt=DT, steps=int(np.ceil(decays/slow)), every=1, means=means)
    start = np.zeros((len(FIELDS), len(J)//4))
    legs = batches(method, start, plan, report, BATCHES + 1)[1:]        # the first one forgets the start
    powers = np.array([leg.means["modes"].reshape(2, -1).sum(axis=0) for leg in legs])/exact
    found = [over_seeds(power) for power in powers.T]
    return [{"exact": float(due), "ratio": one.value, "ratio_err": one.err} for due, one in zip(exact, found, strict=True)]


@dataclass(frozen=True, kw_only=True)
class LayerSampled(Case):
    """Waves k = 3.117/L in the motionless layer between plates, 1 - Ra/Ra_c = `below`: velocities, the slowest mode."""
    rows: int
    below: float
    seed: int
    decays: float = DECAYS

    @property
    def cost(self) -> float:
        return 5e-5*BATCHES*self.decays/(0.025*self.below*DT)

    @property
    def label(self) -> str:
        return f"sampled layer, {self.rows} rows, {self.below:g} below onset"

    def run(self, report: Report, folder: Path) -> Outcome:
        given = BelowOnset(rows=self.rows, below=(self.below,))
        J, Q = given.blocks(given.onset()*(1 - self.below))
        y = (np.arange(self.rows) + 0.5)/self.rows
        across, along = np.sqrt(2/self.rows)*np.sin(np.pi*y), np.sqrt(2/self.rows)*np.cos(np.pi*y)
        of = {"slowest": slowest_amplitude(J), "w": np.kron([0, 0, 1, 0], across), "u": np.kron([0, 1, 0, 0], along)}
        found = sampled(J, Q, np.array(list(of.values())), self.seed, report, self.decays)
        return Outcome({"sampled": [{"flow": "layer", "strength": self.below, "rows": self.rows,
                                     "wavenumber": given.k_height/self.rows, "field": name, **row}
                                    for name, row in zip(of, found, strict=True)]})


def slowest_amplitude(J: np.ndarray) -> np.ndarray:
    """The row of modulus 1 that takes the amplitude of the slowest mode from a state: a left eigenvector of J."""
    values, vectors = np.linalg.eig(J.T)
    row = vectors[:, np.argmax(values.real)]
    return row/np.linalg.norm(row)
