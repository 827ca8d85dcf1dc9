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
from particles.integral.covariance import crank_nicolson, jacobian, steady, waves
from particles.integral.layer import Layer
from particles.threads import Team
from studies.build.fixed import Scheme, layer
from studies.kit.case import Case, Outcome, Report
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

    @property
    def cost(self) -> float:
        return 2e-5*self.rows**3

    @property
    def label(self) -> str:
        return f"below onset, {self.rows} rows"

    def run(self, report: Report, folder: Path) -> Outcome:
        critical = onset(self.rows)
        return Outcome({"onset": [self.row(critical, part) for part in self.below]})

    def row(self, critical: float, below: float) -> dict[str, float]:
        """The variance of vertical velocities, which is 1 in equilibrium."""
        J, Q = matrices(self.rows, critical*(1 - below))
        w = slice(2*self.rows, 3*self.rows)
        velocity = np.trace(steady(J, Q)[w, w].real)/self.rows
        return {"rows": self.rows, "below": below, "ra_c": critical, "velocity": float(velocity)}


def onset(rows: int) -> float:
    """Ra_c, where the slowest mode neither grows nor decays."""
    def rate(ra: float) -> float:
        return float(np.linalg.eigvals(matrices(rows, ra)[0]).real.max())
    return float(brentq(rate, 1000, 3000, xtol=1e-6))


def matrices(rows: int, ra: float) -> tuple[np.ndarray, np.ndarray]:
    """J and Q of the waves at one Rayleigh number."""
    counts, first = (5, rows), np.arange(rows)
    scene = RayleighBenard(ra=ra, L=float(rows), aspect=5/rows)
    fluid = layer(scene, LATTICE, 1)
    T = scene.T(fluid.x[:, 1])
    sums = fluid.start(len(T), Team(1))
    J = jacobian(sums.rates, fluid.state(1.0, 0*fluid.x, T), first)
    columns = (np.arange(4)[:, None]*len(T) + first).ravel()
    Q = layer_noise(fluid, T)[:, columns].toarray()
    return waves(J, counts, K_HEIGHT/rows), waves(Q, counts, K_HEIGHT/rows)


def layer_noise(fluid: Layer, T: np.ndarray) -> sparse.csr_array:
    """Q of a layer at rest with transport along edges; edges to images have the temperature of their plate.

    Images have -v and 2 T_w - T: friction and heat over an edge to one are k (v_i + v_parent), the noise that
    of its two points alike.
    """
    edges, beyond, law, n = fluid.edges, fluid.beyond, fluid.law, len(T)
    columns, rows = np.tile(beyond.i, 2), np.concatenate([beyond.i, beyond.parent])
    wall = np.array(fluid.T_plates)[beyond.plate]

    def of_plate(q: np.ndarray) -> sparse.csr_array:
        return sparse.csr_array((np.tile(beyond.k*q, 2), (columns, rows)), shape=(n, n))
    momenta, energies = transport(edges, 1.0, law.eta, 0.0, law.k, T)
    both = sparse.kron(sparse.eye_array(2), of_plate(2*law.eta*wall))
    return noise(edges.V, momenta.Q + both, energies.Q + of_plate(2*law.k*wall**2))


# --- sampled ----------------------------------------------------------------------------------


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

    @property
    def label(self) -> str:
        return f"sampled layer, {self.rows} rows, {self.below:g} below onset"

    def run(self, report: Report, folder: Path) -> Outcome:
        J, Q = matrices(self.rows, onset(self.rows)*(1 - self.below))
        y = np.pi*(np.arange(self.rows) + 0.5)/self.rows
        across, along = np.sqrt(2/self.rows)*np.array([np.sin(y), np.cos(y)])
        modes = {"slowest": slowest_amplitude(J), "w": np.kron([0, 0, 1, 0], across),
                 "u": np.kron([0, 1, 0, 0], along)}
        variances = sampled(J, Q, np.array(list(modes.values())), self.seed, report, self.decays)
        key = {"flow": "layer", "strength": self.below, "rows": self.rows, "wavenumber": K_HEIGHT/self.rows}
        return Outcome({"sampled": [{**key, "field": name, **row}
                                    for name, row in zip(modes, variances, strict=True)]})


def slowest_amplitude(J: np.ndarray) -> np.ndarray:
    """The row of modulus 1 that gives the amplitude of the slowest mode: a left eigenvector of J."""
    values, vectors = np.linalg.eig(J.T)
    row = vectors[:, np.argmax(values.real)]
    return row/np.linalg.norm(row)


def sampled(J: np.ndarray, Q: np.ndarray, modes: np.ndarray, seed: int, report: Report,
            decays: float) -> list[dict[str, float]]:
    """Variances of `modes` (m, N) of dx = J x dt + noise of covariance Q: exact, samples over that."""
    exact = np.einsum("mi,ij,mj->m", modes, steady(J, Q), modes.conj()).real
    slow = -np.log(np.abs(np.linalg.eigvals(crank_nicolson(J, Q, DT).A)).max())
    B, looks = sparse.csr_array(apart(root(Q))/np.sqrt(2)), apart(modes)    # of unit variance each part has a half
    sampler = Sampler(J=apart(J), kicks=of_matrix(B, DT), look=lambda x: (looks@x)**2, dt=DT,
                      steps=int(np.ceil(decays/slow)), seed=seed)
    batches = sampler.batches(np.zeros(2*len(J)), report, BATCHES + 1)[1:]      # the first one forgets the start
    powers = batches.mean(axis=1).reshape(BATCHES, 2, -1).sum(axis=1)/exact
    return [{"exact": float(due), **ratio(power)} for due, power in zip(exact, powers.T, strict=True)]


def apart(M: np.ndarray) -> np.ndarray:
    """Real (2 m, 2 n) of a complex (m, n) matrix: what it does to real and imaginary parts."""
    return np.block([[M.real, -M.imag], [M.imag, M.real]])


def root(Q: np.ndarray) -> np.ndarray:
    """B (N, N) with B B^* = Q of a Hermitian Q.

    Raises
    ------
    ArithmeticError
        Q has a negative eigenvalue: it is the covariance of no noise.
    """
    values, vectors = np.linalg.eigh(Q)
    if values[0] < -1e-12*values[-1]:       # round-off of sums over some ten edges
        raise ArithmeticError(f"Q has the eigenvalue {values[0]:.3g}, the largest being {values[-1]:.3g}: no "
                              "noise has a negative variance; look at the partners of the dissipation")
    return vectors*np.sqrt(np.maximum(values, 0))
