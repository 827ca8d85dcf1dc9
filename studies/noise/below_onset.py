"""Linear fluctuations about a layer heated from below, solved and sampled    [RR98 Eqs 20-25]

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
from studies.noise.covariance import crank_nicolson, steady, waves
from studies.noise.partners import noise, transport
from studies.noise.sampling import BATCHES, Sampler, of_matrix, ratio

LATTICE = Scheme("fixed-lattice")
K_HEIGHT = 3.117        # wave number times height of what grows first
#: of decay times of the slowest mode in a batch: with 20 of them variances are good to 6 %, 2/sqrt(20*60)
DECAYS = 60
#: far above the decay of short waves; what that slows is counted, as decay times are those of the steps
DT = 10.0


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


@dataclass(frozen=True, kw_only=True)
class LayerSampled(Case):
    """The same waves, 1 - Ra/Ra_c = `below`: sampled velocities, and the slowest mode."""
    rows: int
    below: float
    seed: int
    decays: float = DECAYS

    @property
    def cost(self) -> float:
        return 5e-5*BATCHES*self.decays/(0.025*self.below*DT)

    def run(self, report: Report, folder: Path) -> Outcome:
        rows, ra = self.rows, onset(self.rows)*(1 - self.below)
        J, Q = matrices(rows, ra)
        y = np.pi*(np.arange(rows) + 0.5)/rows
        unit = np.sqrt(2/rows)
        w = np.kron([0, 0, 1, 0], unit*np.sin(y))
        u = np.kron([0, 1, 0, 0], unit*np.cos(y))
        modes = np.array([slowest_amplitude(J), w, u])
        variances = sampled(J, Q, modes, self.seed, report, self.decays)
        key = {"flow": "layer", "strength": self.below, "rows": rows, "wavenumber": K_HEIGHT/rows}
        fields = zip(("slowest", "w", "u"), variances, strict=True)
        return Outcome({"sampled": [{**key, "field": field, **row} for field, row in fields]})


def slowest_amplitude(J: np.ndarray) -> np.ndarray:
    """The row of modulus 1 that gives the amplitude of the slowest mode: a left eigenvector of J."""
    values, vectors = np.linalg.eig(J.T)
    row = vectors[:, np.argmax(values.real)]
    return row/np.linalg.norm(row)


def sampled(J: np.ndarray, Q: np.ndarray, modes: np.ndarray, seed: int, report: Report,
            decays: float) -> list[dict[str, float]]:
    """Variances of `modes` (m, N) of dx = J x dt + noise of covariance Q: exact, samples over that."""
    exact = np.einsum("mi,ij,mj->m", modes, steady(J, Q), modes.conj()).real
    factors = np.linalg.eigvals(crank_nicolson(J, Q, DT).A)
    slow = -np.log(np.abs(factors).max())
    steps = int(np.ceil(decays/slow))
    B = root(Q)/np.sqrt(2)      # of unit variance the real and the imaginary part have a half each
    sampler = Sampler(J=J, kicks=of_matrix(np.hstack([B, 1j*B]), DT), look=lambda x: np.abs(modes@x)**2,
                      dt=DT, steps=steps, seed=seed)
    batches = sampler.batches(np.zeros(len(J), complex), report, BATCHES + 1)
    ratios = batches[1:].mean(axis=1)/exact         # the first one forgets the start
    return [{"exact": float(due), **ratio(values)} for due, values in zip(exact, ratios.T, strict=True)]


def root(Q: np.ndarray) -> np.ndarray:
    """B (N, N) with B B^* = Q of a Hermitian Q. Raises ArithmeticError: it has a negative eigenvalue."""
    values, vectors = np.linalg.eigh(Q)
    if values[0] < -1e-12*values[-1]:       # round-off of sums over some ten edges
        raise ArithmeticError(f"Q has the eigenvalue {values[0]:.3g}, the largest being {values[-1]:.3g}: no "
                              "noise has a negative variance; look at the partners of the dissipation")
    return vectors*np.sqrt(np.maximum(values, 0))
