"""Linear fluctuations about a layer heated from below    [RR98 Eqs 20-25]

The given flow is linearised by differences of the rates that run, noise is that of `fluctuating`, covariances
solve Lyapunov's equation. Boltzmann's k is 1: linear fluctuations are proportional to it.
"""
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from scipy import sparse
from scipy.optimize import brentq

from continuum.scene import RayleighBenard
from particles.integral.layer import Layer
from particles.limits import jacobian
from particles.threads import Threads
from studies.build.fixed import Scheme, layer
from studies.kit.case import Case, Outcome, Report
from studies.noise.covariance import steady, waves
from studies.noise.partners import noise, transport

LATTICE = Scheme("fixed-lattice")
K_HEIGHT = 3.117        # wave number times height of what grows first


@dataclass(frozen=True, kw_only=True)
class BelowOnset(Case):
    """The motionless layer of KHP95 between plates, `rows` high: waves k = 3.117/L on the way to onset."""
    rows: int
    below: tuple[float, ...]        # 1 - Ra/Ra_c

    def run(self, report: Report, folder: Path) -> Outcome:
        critical = onset(self.rows)
        return Outcome({"onset": [self.row(critical, part) for part in self.below]})

    def row(self, critical: float, below: float) -> dict[str, float]:
        """The variance of vertical velocities, which is 1 in equilibrium."""
        J, Q = matrices(self.rows, critical*(1 - below))
        variances = np.diag(steady(J, Q)).real
        velocity = variances[2*self.rows:3*self.rows].mean()
        return {"rows": self.rows, "below": below, "ra_c": critical, "velocity": float(velocity)}


def onset(rows: int) -> float:
    """Ra_c, where the slowest mode neither grows nor decays."""
    def rate(ra: float) -> float:
        return float(np.linalg.eigvals(matrices(rows, ra)[0]).real.max())
    return float(brentq(rate, 1000, 3000, xtol=1e-6))


def matrices(rows: int, ra: float) -> tuple[np.ndarray, np.ndarray]:
    """J and Q of the waves at one Rayleigh number."""
    counts, k = (5, rows), K_HEIGHT/rows
    scene = RayleighBenard(ra=ra, L=float(rows), aspect=5/rows)
    fluid = layer(scene, LATTICE, 1)
    x, n = fluid.x, len(fluid.x)
    T = scene.T(x[:, 1])
    sums = fluid.start(n, Threads(1))
    first = np.arange(rows)             # points at the left end
    J = jacobian(sums.rates, fluid.state(1.0, 0*x, T), first)
    fields = np.arange(4)[:, None]
    columns = (fields*n + first).ravel()
    Q = layer_noise(fluid, T)[:, columns].toarray()
    return waves(J, counts, k), waves(Q, counts, k)


def layer_noise(fluid: Layer, T: np.ndarray) -> sparse.csr_array:
    """Q of a layer at rest with transport along edges; edges to images have the temperature of their plate.

    Images have -v and 2 T_w - T: friction and heat over an edge to one are k (v_i + v_parent), the noise that
    of its two points alike.
    """
    edges, beyond, law, n = fluid.edges, fluid.beyond, fluid.law, len(T)
    rows = np.concatenate([beyond.i, beyond.parent])
    columns = np.tile(beyond.i, 2)
    T_wall = np.array(fluid.T_plates)[beyond.plate]

    def of_plate(q: np.ndarray) -> sparse.csr_array:
        values = np.tile(beyond.k*q, 2)
        return sparse.csr_array((values, (columns, rows)), shape=(n, n))
    momenta, energies = transport(edges, 1.0, law.eta, 0.0, law.k, T)
    friction = of_plate(2*law.eta*T_wall)
    heat = of_plate(2*law.k*T_wall**2)
    both = sparse.kron(sparse.eye_array(2), friction)
    return noise(edges.V, momenta.Q + both, energies.Q + heat)
