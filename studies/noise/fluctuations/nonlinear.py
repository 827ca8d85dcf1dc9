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
from studies.noise.fluctuations.matrices import ETA, KAPPA, ZETA
from studies.noise.fluctuations.sampling import BATCHES, CrankNicolson, batches, check_length


@dataclass(frozen=True, kw_only=True)
class Nonlinear(Case):
    """Variances of rho, v and T in the full equations on jittered points with Delaunay edges, over kT/(rho V) and so on."""
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
        method = Thermal(edges=edges, eos=IdealGas(), law=ConstEta(ETA, KAPPA), zeta=ZETA, share=self.share, k=self.k,
                         seed=self.seed)
        state = method.dih.state(np.ones(edges.n), np.zeros((edges.n, 2)), np.ones(edges.n))
        check_length(jacobian(method.dih.rates, state), self.time)
        dt = self.of_limit*limit_of(method, state)
        steps = int(np.ceil(self.time/dt/5))*5
        plan = Plan(dt=dt, steps=steps, every=5, means={name: variance(edges.V, self.k, name) for name in ("rho", "v", "T")})
        legs = batches(method, state, plan, report, self.batches + 1)[1:]       # the first one forgets the start
        drift = np.abs(legs[-1].state@edges.V - state@edges.V).max()/(edges.V@state[-1])
        found = [(name, over_seeds(np.array([leg.means[name] for leg in legs]))) for name in ("rho", "v", "T")]
        return Outcome({"nonlinear": [{"share": self.share, "k": self.k, "field": name, "ratio": one.value, "ratio_err": one.err,
                                       "drift": drift} for name, one in found]})


def variance(V: np.ndarray, k: float, name: str) -> Callable[[Any, np.ndarray], float]:
    """Mean square of a field over its equilibrium value, with all sums fixed."""
    def value(sums: Any, state: np.ndarray) -> float:
        flow = sums.dih.flow(state)
        square = {"rho": (flow.rho - 1)**2, "v": flow.rho*(flow.v**2).sum(axis=1)/2, "T": (flow.T - 1)**2}[name]
        return float(V@square/(len(V) - 1)/k)
    return value


# --- heat with current amplitudes ------------------------------------------------------------


@dataclass(frozen=True, kw_only=True, eq=False)
class Exchange:
    """Temperatures of points with the heat capacity C (in k) that exchange heat along edges, kappa = C; noise of current T_i T_j.

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
        fill_pairs(0, len(self.normals), self.method.seed, now.step, self.method.edges.i, self.method.edges.j, self.normals)

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
    """Var T/T^2 of n points with entropies C ln T at fixed total: energies are Dirichlet(C/k + 1); without correction (C/k)."""
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
        found = over_seeds(np.array([float(leg.means["T"]) for leg in legs]))
        # `var` divides by n: (n - 1)/n of the variance of one point about the fixed mean is in it already
        return Outcome({"capacity": [{"C": self.C, "noise": "corrected" if self.corrected else "current", "measured": found.value,
                                      "measured_err": found.err, "predicted": dirichlet(edges.n, self.C, self.corrected)}]})
