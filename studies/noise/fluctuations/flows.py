"""Linear fluctuations about given flows, as cases: rest, a temperature gradient, a layer heated from below    [RR98 Eqs 20-25]

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
from particles.integral.interpolants import W
from particles.integral.layer import Layer
from particles.integral.points import lattice
from particles.threads import Team
from particles.weights import Lucy
from studies.build.disorder import Disorder
from studies.build.fixed import SCHEMES, layer
from studies.build.symbols import neighbours
from studies.kit.case import Case, Outcome, Report
from studies.noise.fluctuations.matrices import ETA, KAPPA, ZETA, carried_along, equilibrium, factor, noise, transport

# --- rest -------------------------------------------------------------------------------------------------------------


@dataclass(frozen=True, kw_only=True)
class Rest(Case):
    """Fluctuations of a gas on points, in d dimensions, at rest or in a stream along x of some `speed`, against equilibrium.

    share : of transport along edges.
    """
    maker: str
    disorder: Disorder
    counts: tuple[int, ...]
    share: float
    h: float = 2.0
    speed: float = 0.0
    seed: int = 1

    @property
    def cost(self) -> float:
        return 1e-9*(np.prod(self.counts)*(2 + len(self.counts)))**3*30 + 0.3

    @property
    def label(self) -> str:
        return f"rest {self.maker}, {self.disorder.name}, {self.counts}, share {self.share:g}, speed {self.speed:g}"

    def run(self, report: Report, folder: Path) -> Outcome:
        points, d = self.disorder.make(self.counts, self.disorder.size, self.seed), len(self.counts)
        edges = MAKERS[self.maker](points, Lucy.of(h=self.h, d=d))
        dih = Dih(edges=edges, eos=IdealGas(), law=ConstEta(ETA, KAPPA), zeta=ZETA, transport=Mixed(share=self.share))
        v = self.speed*np.tile(np.eye(d)[0], (edges.n, 1))
        J = jacobian(dih.rates, dih.state(np.ones(edges.n), v, np.ones(edges.n)))
        parts = transport(edges, self.share, ETA, ZETA, KAPPA, 1.0)
        row = {"maker": self.maker, "points": self.disorder.name, "d": d, "share": self.share, "n": edges.n,
               "growth": float(np.linalg.eigvals(J).real.max())}
        table, row = ("stream", {**row, "speed": self.speed}) if self.speed else ("rest", row)
        exactly, B = equilibrium(edges.V, d, v), carried_along(factor(edges, *parts), v)
        try:
            C = steady(J, (B@B.T).toarray(), np.kron(np.eye(2 + d), edges.V))
        except ArithmeticError:         # edges that do not close let sound grow: that is the result
            return Outcome({table: [{**row, "error": np.nan, "kinetic": np.nan}]})
        moving = slice(edges.n, (1 + d)*edges.n)
        kinetic = float(np.trace(C[moving, moving])/np.trace(exactly[moving, moving]))
        return Outcome({table: [{**row, "error": float(np.abs(C - exactly).max()/exactly.max()), "kinetic": kinetic}]})


# --- a temperature gradient -------------------------------------------------------------------------------------------


@dataclass(frozen=True, kw_only=True)
class Gradient(Case):
    """T = 1 + contrast sin(2 pi y/period) at uniform pressure, held by constant sources, on a periodic lattice; waves along x.

    k : wave numbers per spacing. Transport along edges.
    """
    period: int
    k: tuple[float, ...]
    contrast: float = 0.01
    eta: float = 0.1
    kappa: float = 0.1

    @property
    def cost(self) -> float:
        return 3e-7*self.period**3*(1 + len(self.k)/4)

    @property
    def label(self) -> str:
        return f"gradient, period {self.period}"

    def run(self, report: Report, folder: Path) -> Outcome:
        J, Q, T = self.columns()
        found = []
        for done, k in enumerate(self.k):
            report(done/len(self.k))
            extra = (self.power(steady(*self.blocks(J, Q, k)), T) - 1)/self.contrast**2
            found.append({"period": self.period, "wavenumber": k, "extra": extra, "predicted": self.predicted(k)})
        return Outcome({"gradient": found})

    def columns(self) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """J and Q of the points at x = 0, five columns of points, which hold the reach of the weight; T there."""
        points, first = lattice((5, self.period)), np.arange(self.period)
        edges = MAKERS["renormalised"](points, Lucy.of(h=2.0))
        dih = Dih(edges=edges, eos=IdealGas(), law=ConstEta(self.eta, self.kappa), transport=Mixed(share=1.0))
        T = 1 + self.contrast*np.sin(2*np.pi*points.x[:, 1]/self.period)
        J = jacobian(dih.rates, dih.state(1/T, 0*points.x, T), first)
        of_p, of_e = transport(edges, 1.0, self.eta, 0.0, self.kappa, T)
        Q = noise(edges.V, of_p.Q, of_e.Q)[:, (np.arange(4)[:, None]*edges.n + first).ravel()].toarray()
        return J, Q, T[first]

    def blocks(self, J: np.ndarray, Q: np.ndarray, k: float) -> tuple[np.ndarray, np.ndarray]:
        """J and Q of the waves k from those columns."""
        return waves(J, (5, self.period), k), waves(Q, (5, self.period), k)

    def power(self, C: np.ndarray, T: np.ndarray) -> float:
        """<T T> of waves that are uniform in y, 1 in equilibrium."""
        pick = self.pick(T)
        return float((pick@C@pick).real)

    @staticmethod
    def pick(T: np.ndarray) -> np.ndarray:
        """The row that takes T, uniform in y, from a state: T = eps/rho at rest."""
        ny = len(T)
        return np.concatenate([-T*T, np.zeros(2*ny), T])/np.sqrt(ny)      # dT = (d eps - T d rho)/rho, rho = 1/T

    def predicted(self, k: float) -> float:
        """What transverse velocities at k and +-q carry into T at k, over contrast^2, by the symbols of the lattice.

        2 (q/2)^2 <v_y v_y>/(D (nu + D)), with <v_y v_y> = k^2/(k^2 + q^2), decays nu (k^2 + q^2) and D k^2, D = kappa/(rho C_P).
        """
        q = 2*np.pi/self.period
        sx, sy = (slope_symbol(p) for p in (k, q))
        D, decay = self.kappa/2*lap_symbol(k, 0.0), self.eta*lap_symbol(k, q)
        return 2*(sy/2)**2*sx**2/(sx**2 + sy**2)/(D*(decay + D))


def slope_symbol(k: float) -> float:
    """What the gradient of Lucy's weight, h = 2, makes of k on a square lattice."""
    return float(slopes_symbol(k, 0.0)[0])


def slopes_symbol(kx: float, ky: float) -> np.ndarray:
    """The same of (kx, ky)."""
    r, w = ring()
    return (w/np.hypot(*r.T)*np.sin(r@np.array([kx, ky])))@r


def lap_symbol(kx: float, ky: float) -> float:
    """The same of k^2."""
    r, w = ring()
    return float((2*w/np.hypot(*r.T))@(1 - np.cos(r@np.array([kx, ky]))))


def ring() -> tuple[np.ndarray, np.ndarray]:
    """Neighbours r (m, 2) and weights with sum_r w r = 2."""
    weight = Lucy.of(h=2.0)
    r = neighbours(weight, 2)
    w = W(weight, np.hypot(*r.T))
    return r, w*2/(w@np.hypot(*r.T))


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
