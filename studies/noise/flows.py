"""Linear fluctuations about rest and a layer heated from below, solved and sampled    [RR98 Eqs 20-25]

The given flow is linearised by differences of the rates that run, noise is that of `fluctuating`, covariances
solve Lyapunov's equation. Samples take steps of Crank-Nicolson, whose steady covariance is that of the solve
at any step. Boltzmann's k is 1: linear fluctuations are proportional to it. Units: spacing 1, ideal gas with
C_V = 1.
"""
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from scipy import sparse
from scipy.optimize import brentq

from continuum.fluid import ConstEta, IdealGas
from continuum.scene import RayleighBenard
from particles.integral.covariance import crank_nicolson, jacobian, steady, waves
from particles.integral.dih import Dih, Mixed
from particles.integral.edge_makers import MAKERS
from particles.integral.edges import Edges
from particles.integral.layer import Layer
from particles.run import Plan
from particles.threads import Team
from particles.weights import Lucy
from studies.build.disorder import Disorder
from studies.build.fixed import SCHEMES, layer
from studies.kit.case import Case, Outcome, Report
from studies.kit.stats import over_seeds
from studies.noise.partners import ETA, KAPPA, ZETA, equilibrium, factor, noise, transport
from studies.noise.sampling import BATCHES, Linear, batches, squares

#: fields of a complex wave as the real state that runs
PARTS = tuple(f"{part} {name}" for part in ("re", "im") for name in ("rho", "px", "py", "eps"))
#: of decay times of the slowest mode in a batch: with 20 of them variances are good to 6 %, 2/sqrt(20*60)
DECAYS = 60
#: far above the decay of short waves; what that slows is counted, as decay times are those of the steps
DT = 10.0


def gas_at_rest(edges: Edges, share: float, eta: float = ETA, zeta: float = ZETA) -> tuple[Dih, np.ndarray]:
    """The gas at rest on these edges, and its J (N, N)."""
    law, mixed = ConstEta(eta, KAPPA), Mixed(share=share)
    dih = Dih(edges=edges, eos=IdealGas(), law=law, zeta=zeta, transport=mixed)
    one = np.ones(edges.n)
    return dih, jacobian(dih.rates, dih.state(one, np.zeros((edges.n, edges.d)), one))


@dataclass(frozen=True, kw_only=True)
class Rest(Case):
    """Fluctuations of a gas at rest on points, in d dimensions, against equilibrium.

    share : of transport along edges.
    """
    maker: str
    disorder: Disorder
    counts: tuple[int, ...]
    share: float
    h: float = 2.0
    seed: int = 1

    @property
    def cost(self) -> float:
        return 3e-8*(np.prod(self.counts)*(2 + len(self.counts)))**3 + 0.3

    @property
    def label(self) -> str:
        return f"rest {self.maker}, {self.disorder.name}, {self.counts}, share {self.share:g}"

    def run(self, report: Report, folder: Path) -> Outcome:
        points, d = self.disorder.make(self.counts, self.disorder.size, self.seed), len(self.counts)
        edges = MAKERS[self.maker](points, Lucy.of(h=self.h, d=d))
        J = gas_at_rest(edges, self.share)[1]
        row = {"maker": self.maker, "points": self.disorder.name, "d": d, "share": self.share, "n": edges.n,
               "growth": largest_rate(J)}
        return Outcome({"rest": [{**row, **self.deviation(edges, J)}]})

    def deviation(self, edges: Edges, J: np.ndarray) -> dict[str, float]:
        """Of the covariance from equilibrium; nan where edges that do not close let sound grow."""
        B = factor(edges, *transport(edges, self.share, ETA, ZETA, KAPPA, 1.0))
        try:
            C = steady(J, (B@B.T).toarray(), np.kron(np.eye(2 + edges.d), edges.V))
        except ArithmeticError:
            return {"error": np.nan, "kinetic": np.nan}
        exact, p = equilibrium(edges.V, edges.d), slice(edges.n, -edges.n)
        kinetic = np.trace(C[p, p])/np.trace(exact[p, p])
        return {"error": float(np.abs(C - exact).max()/exact.max()), "kinetic": float(kinetic)}


def largest_rate(J: np.ndarray) -> float:
    """Of the mode that grows fastest or decays slowest."""
    return float(np.linalg.eigvals(J).real.max())


# --- heated from below ------------------------------------------------------------------------


@dataclass(frozen=True, kw_only=True)
class BelowOnset(Case):
    """The motionless layer of KHP95 between plates, `rows` high: waves k = 3.117/L on the way to onset."""
    rows: int
    below: tuple[float, ...]        # 1 - Ra/Ra_c
    k_height: float = 3.117

    @property
    def cost(self) -> float:
        return 2e-5*self.rows**3

    @property
    def label(self) -> str:
        return f"below onset, {self.rows} rows"

    def run(self, report: Report, folder: Path) -> Outcome:
        onset, n, made = self.onset(), self.rows, []
        w = slice(2*n, 3*n)         # its variance is 1 in equilibrium
        for fraction in self.below:
            J, Q = self.blocks(onset*(1 - fraction))
            C = steady(J, Q).real
            made.append({"rows": n, "below": fraction, "ra_c": onset, "slowest": largest_rate(J),
                         "velocity": float(np.trace(C[w, w])/n)})
        return Outcome({"onset": made})

    def onset(self) -> float:
        """Ra_c, where the slowest mode neither grows nor decays."""
        return float(brentq(lambda ra: largest_rate(self.blocks(ra)[0]), 1000, 3000, xtol=1e-6))

    def blocks(self, ra: float) -> tuple[np.ndarray, np.ndarray]:
        """J and Q of the waves at one Rayleigh number."""
        counts, first = (5, self.rows), np.arange(self.rows)
        scene = RayleighBenard(ra=ra, L=float(self.rows), aspect=5/self.rows)
        fluid = layer(scene, SCHEMES["fixed-lattice"], 1)
        T = scene.T(fluid.x[:, 1])
        sums = fluid.start(len(T), Team(1))
        J = jacobian(sums.rates, fluid.state(1.0, 0*fluid.x, T), first)
        columns = (np.arange(4)[:, None]*len(T) + first).ravel()
        Q = layer_noise(fluid, T)[:, columns].toarray()
        k = self.k_height/self.rows
        return waves(J, counts, k), waves(Q, counts, k)


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
    """Waves k = 3.117/L in the same layer, 1 - Ra/Ra_c = `below`: velocities, the slowest mode."""
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
        across, along = (np.sqrt(2/self.rows)*f(np.pi*y) for f in (np.sin, np.cos))
        modes = {"slowest": slowest_amplitude(J), "w": np.kron([0, 0, 1, 0], across),
                 "u": np.kron([0, 1, 0, 0], along)}
        variances = sampled(J, Q, np.array(list(modes.values())), self.seed, report, self.decays)
        key = {"flow": "layer", "strength": self.below, "rows": self.rows,
               "wavenumber": given.k_height/self.rows}
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
    # a complex random number of unit variance has two parts of a half
    B = sparse.csr_array(apart(root(Q))/np.sqrt(2))
    method = Linear(J=apart(J), B=B, seed=seed, modes=apart(modes), names=PARTS)
    means: dict[str, Any] = {"modes": squares}
    plan = Plan(dt=DT, steps=int(np.ceil(decays/slow)), every=1, means=means)
    start = np.zeros((len(PARTS), len(J)//4))
    legs = batches(method, start, plan, report, BATCHES + 1)[1:]        # the first one forgets the start
    powers = np.array([leg.means["modes"].reshape(2, -1).sum(axis=0) for leg in legs])/exact
    ratios = [over_seeds(power) for power in powers.T]
    return [{"exact": float(due), "ratio": ratio.value, "ratio_err": ratio.err}
            for due, ratio in zip(exact, ratios, strict=True)]


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
