"""Samples of the full equations, and of heat with current amplitudes, as cases    [RR98 Eqs 42, 43]"""
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from math import inf
from pathlib import Path
from typing import Any

import numpy as np

from continuum.fluid import ConstEta, IdealGas
from particles.integral import fluctuating
from particles.integral.covariance import jacobian
from particles.integral.edge_makers import MAKERS
from particles.integral.fixed import Summing, check_number
from particles.integral.points import jittered, lattice
from particles.integral.thermal import Thermal, fill_pairs
from particles.limits import limit_of
from particles.run import Plan
from particles.threads import Team
from particles.weights import Lucy
from studies.kit.case import Case, Outcome, Report
from studies.kit.stats import over_seeds
from studies.noise.partners import ETA, KAPPA, ZETA
from studies.noise.sampling import BATCHES, CrankNicolson, batches, check_length

FIELDS = ("rho", "v", "T")


@dataclass(frozen=True, kw_only=True)
class Nonlinear(Case):
    """Variances of rho, v and T in the full equations on jittered points, over equilibrium."""
    counts: tuple[int, int]
    share: float
    k: float
    time: float         # of a batch
    of_limit: float = 0.6
    batches: int = BATCHES
    seed: int = 1

    @property
    def cost(self) -> float:
        return self.batches*self.time/0.1*3e-3

    @property
    def label(self) -> str:
        return f"nonlinear, share {self.share:g}, k {self.k:g}"

    def run(self, report: Report, folder: Path) -> Outcome:
        edges = MAKERS["delaunay"](jittered(self.counts, 0.2, self.seed), None)
        method = Thermal(edges=edges, eos=IdealGas(), law=ConstEta(ETA, KAPPA), zeta=ZETA, share=self.share,
                         k=self.k, seed=self.seed)
        state = method.dih.state(np.ones(edges.n), np.zeros((edges.n, 2)), np.ones(edges.n))
        check_length(jacobian(method.dih.rates, state), self.time)
        dt = self.of_limit*limit_of(method, state)
        steps = int(np.ceil(self.time/dt/5))*5
        means = {name: variance(edges.V, self.k, name) for name in FIELDS}
        plan = Plan(dt=dt, steps=steps, every=5, means=means)
        # the first batch forgets the start
        legs = batches(method, state, plan, report, self.batches + 1)[1:]
        sums, before = legs[-1].state@edges.V, state@edges.V
        key = {"share": self.share, "k": self.k, "drift": np.abs(sums - before).max()/before[-1]}
        ratios = {name: over_seeds(np.array([leg.means[name] for leg in legs])) for name in FIELDS}
        return Outcome({"nonlinear": [{**key, "field": name, "ratio": ratio.value, "ratio_err": ratio.err}
                                      for name, ratio in ratios.items()]})


def variance(V: np.ndarray, k: float, name: str) -> Callable[[Any, np.ndarray], float]:
    """Mean square of a field over its equilibrium value, with all sums fixed."""
    def value(sums: Any, state: np.ndarray) -> float:
        flow = sums.dih.flow(state)
        kinetic = flow.rho*(flow.v**2).sum(axis=1)/2
        square = {"rho": (flow.rho - 1)**2, "v": kinetic, "T": (flow.T - 1)**2}[name]
        return float(V@square/(len(V) - 1)/k)
    return value


# --- heat with current amplitudes ------------------------------------------------------------


@dataclass(frozen=True, kw_only=True, eq=False)
class Exchange:
    """Temperatures of points with the heat capacity C (in k) that exchange heat along edges, kappa = C.

    Noise has the amplitude of the current T_i T_j.

    corrected : the flux times 1 + k/C, the part of Ito's rule that current amplitudes need.
    """
    edges: Any
    C: float
    corrected: bool
    seed: int
    names = ("T",)
    integrator = CrankNicolson

    def __repr__(self) -> str:
        return f"Exchange({float(self.edges.k.sum())!r}, {self.C}, {self.corrected}, {self.seed})"

    def start(self, n: int, team: Team) -> "Exchanged":
        check_number(n, self.edges.n)
        return Exchanged(self)


class Exchanged(Summing):
    """Its kicks."""

    def __init__(self, method: Exchange):
        self.method, edges = method, method.edges
        self.across = fluctuating.incidence(edges)
        self.J = (1 + method.corrected/method.C)*edges.laplacian.toarray()/edges.V[:, None]
        self.normals = np.empty((len(edges.i), 1))

    def rates(self, state: np.ndarray, out: np.ndarray) -> None:
        out[0] = self.J@state[0]

    def make_ready(self, now: Any, dt: float) -> None:
        edges, seed = self.method.edges, self.method.seed
        fill_pairs(0, len(self.normals), seed, now.step, edges.i, edges.j, self.normals)

    def kick(self, y: np.ndarray, dt: float) -> np.ndarray:
        """sqrt(2 k kappa T_i T_j k_ij) dW/C; a product below zero, once in very many, does not kick."""
        edges, T = self.method.edges, y[0]
        amplitude = np.sqrt(2*edges.k*np.maximum(T[edges.i]*T[edges.j], 0)/self.method.C*dt)
        return self.across@(amplitude*self.normals[:, 0])/edges.V

    def look_at(self, state: np.ndarray) -> None:
        """Nothing else follows from a state."""

    def fault(self, state: np.ndarray, ids: np.ndarray) -> str:
        return ""


@limit_of.register
def _(method: Exchange, start: np.ndarray) -> float:
    return inf


def dirichlet(n: int, C: float, corrected: bool) -> float:
    """Var T/T^2 of n points with entropies C ln T at fixed total.

    Energies are Dirichlet(C/k + 1), without correction Dirichlet(C/k).
    """
    return (n - 1)/(n*(C + corrected) + 1)


@dataclass(frozen=True, kw_only=True)
class Capacity(Case):
    """Variance of temperature with current amplitudes, with and without Ito's correction."""
    C: float
    corrected: bool
    steps: int
    counts: tuple[int, int] = (6, 6)
    dt: float = 0.05
    seed: int = 1

    @property
    def cost(self) -> float:
        return BATCHES*self.steps*5e-5

    @property
    def label(self) -> str:
        return f"heat capacity {self.C:g} k, {'corrected' if self.corrected else 'current amplitudes'}"

    def run(self, report: Report, folder: Path) -> Outcome:
        edges = MAKERS["renormalised"](lattice(self.counts), Lucy.of(h=1.5))
        method = Exchange(edges=edges, C=self.C, corrected=self.corrected, seed=self.seed)
        check_length(Exchanged(method).J, self.steps*self.dt)
        means: Mapping[str, Any] = {"T": lambda sums, state: state[0].var()}
        plan = Plan(dt=self.dt, steps=self.steps, every=2, means=means)
        legs = batches(method, np.ones((1, edges.n)), plan, report, BATCHES + 1)[1:]
        measured = over_seeds(np.array([float(leg.means["T"]) for leg in legs]))
        # `var` divides by n: (n - 1)/n of the variance of one point about the fixed mean is in it already
        predicted = dirichlet(edges.n, self.C, self.corrected)
        noise = "corrected" if self.corrected else "current"
        return Outcome({"capacity": [{"C": self.C, "noise": noise, "measured": measured.value,
                                      "measured_err": measured.err, "predicted": predicted}]})
