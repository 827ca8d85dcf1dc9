"""Linear fluctuations about given flows, as cases: rest, a layer heated from below    [RR98 Eqs 20-25]

The given flow is linearised by differences of the rates that run, noise is that of `fluctuating`, covariances solve Lyapunov's
equation. Boltzmann's k is 1: linear fluctuations are proportional to it. Units: spacing 1, ideal gas with C_V = 1.
"""
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from scipy import sparse
from scipy.optimize import brentq

from continuum.fluid import ConstEta, IdealGas
from continuum.scene import RayleighBenard
from particles.integral.covariance import jacobian, steady, waves
from particles.integral.dih import Dih, Mixed
from particles.integral.edge_makers import MAKERS
from particles.integral.layer import Layer
from particles.threads import Team
from particles.weights import Lucy
from studies.build.disorder import Disorder
from studies.build.fixed import SCHEMES, layer
from studies.kit.case import Case, Outcome, Report
from studies.noise.fluctuations.matrices import ETA, KAPPA, ZETA, equilibrium, factor, noise, transport

# --- rest -------------------------------------------------------------------------------------------------------------


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
        return 1e-9*(np.prod(self.counts)*(2 + len(self.counts)))**3*30 + 0.3

    @property
    def label(self) -> str:
        return f"rest {self.maker}, {self.disorder.name}, {self.counts}, share {self.share:g}"

    def run(self, report: Report, folder: Path) -> Outcome:
        points, d = self.disorder.make(self.counts, self.disorder.size, self.seed), len(self.counts)
        edges = MAKERS[self.maker](points, Lucy.of(h=self.h, d=d))
        dih = Dih(edges=edges, eos=IdealGas(), law=ConstEta(ETA, KAPPA), zeta=ZETA, transport=Mixed(share=self.share))
        J = jacobian(dih.rates, dih.state(np.ones(edges.n), np.zeros((edges.n, d)), np.ones(edges.n)))
        parts = transport(edges, self.share, ETA, ZETA, KAPPA, 1.0)
        row = {"maker": self.maker, "points": self.disorder.name, "d": d, "share": self.share, "n": edges.n,
               "growth": float(np.linalg.eigvals(J).real.max())}
        exactly, B = equilibrium(edges.V, d), factor(edges, *parts)
        try:
            C = steady(J, (B@B.T).toarray(), np.kron(np.eye(2 + d), edges.V))
        except ArithmeticError:         # edges that do not close let sound grow: that is the result
            return Outcome({"rest": [{**row, "error": np.nan, "kinetic": np.nan}]})
        moving = slice(edges.n, (1 + d)*edges.n)
        kinetic = float(np.trace(C[moving, moving])/np.trace(exactly[moving, moving]))
        return Outcome({"rest": [{**row, "error": float(np.abs(C - exactly).max()/exactly.max()), "kinetic": kinetic}]})


# --- heated from below ------------------------------------------------------------------------------------------------


@dataclass(frozen=True, kw_only=True)
class BelowOnset(Case):
    """The motionless layer of KHP95 between plates, `rows` high: fluctuations of the waves k = 3.117/L on the way to onset."""
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
        onset, found = self.onset(), []
        for fraction in self.below:
            J, Q = self.blocks(onset*(1 - fraction))
            C = steady(J, Q).real
            across, ny = np.arange(2*self.rows, 3*self.rows), self.rows
            found.append({"rows": ny, "below": fraction, "ra_c": onset, "slowest": slowest(J),       # w: 1 in equilibrium
                          "velocity": float(np.trace(C[np.ix_(across, across)])/ny)})
        return Outcome({"onset": found})

    def onset(self) -> float:
        """Ra_c, where the slowest mode neither grows nor decays."""
        return float(brentq(lambda ra: slowest(self.blocks(ra)[0]), 1000, 3000, xtol=1e-6))

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
        return waves(J, counts, self.k_height/self.rows), waves(Q, counts, self.k_height/self.rows)


def layer_noise(fluid: Layer, T: np.ndarray) -> sparse.csr_array:
    """Q of a layer at rest with transport along edges; edges to images have the temperature of their plate.

    Images have -v and 2 T_w - T: friction and heat over an edge to one are k (v_i + v_parent), the noise that of its two points
    alike.
    """
    edges, beyond, law, n = fluid.edges, fluid.beyond, fluid.law, len(T)
    at, wall = (np.tile(beyond.i, 2), np.concatenate([beyond.i, beyond.parent])), np.array(fluid.T_plates)[beyond.plate]
    of_plate = [sparse.csr_array((np.tile(beyond.k*q, 2), at), shape=(n, n)) for q in (2*law.eta*wall, 2*law.k*wall**2)]
    of_p, of_e = transport(edges, 1.0, law.eta, 0.0, law.k, T)
    return noise(edges.V, of_p.Q + sparse.kron(sparse.eye_array(2), of_plate[0]), of_e.Q + of_plate[1])


def slowest(J: np.ndarray) -> float:
    """Largest growth rate."""
    return float(np.linalg.eigvals(J).real.max())
