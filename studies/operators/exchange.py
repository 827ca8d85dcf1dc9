"""What the brackets conserve and keep, and the viscosities of forces along edges    [RR98 Eqs 13, 34-36, 51]"""
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from continuum.fluid import ConstEta, IdealGas
from particles.integral.dih import Dih, NestedFluxes, Pairwise
from particles.integral.edge_makers import renormalised
from particles.integral.edges import Edges
from particles.integral.interpolants import W
from particles.integral.points import Points
from particles.weights import WendlandC2
from studies.build.disorder import Disorder
from studies.kit.case import Case, Outcome, Report
from studies.operators.lattice import around
from studies.operators.weights import integral

COUNTS = {1: (20,), 2: (10, 12), 3: (6, 6, 7)}
RANGE = {1: 2.7, 2: 2.7, 3: 2.2}
WIND = np.array([0.3, -0.2, 0.1])
TRANSPORT = {"nested": NestedFluxes(), "printed": NestedFluxes(differences=False), "pairwise": Pairwise(mended=False)}
KEPT = ("lost", "uniform")


@dataclass(frozen=True, kw_only=True)
class Invariance(Case):
    """What a random state loses of mass, momentum and energy, and how fast a uniform fluid in a wind changes."""
    maker: str
    make: Callable[[Points, Any], Edges]
    disorder: Disorder
    d: int
    seed: int = 3

    def run(self, report: Report, folder: Path) -> Outcome:
        at = self.disorder.make(COUNTS[self.d], self.disorder.size, self.seed)
        key = {"maker": self.maker, "points": self.disorder.name, "d": self.d}
        try:
            edges = self.make(at, WendlandC2.of(h=RANGE[self.d], d=self.d))
        except ArithmeticError:     # no such edges exist on these points: that is a result
            return Outcome({"invariance": [{**key, "transport": name, **dict.fromkeys(KEPT, np.nan)}
                                           for name in TRANSPORT]})
        return Outcome({"invariance": [{**key, "transport": name, **kept(edges, transport)}
                                       for name, transport in TRANSPORT.items()]})


def kept(edges: Edges, transport: Any) -> dict[str, float]:
    """Columns `lost`, relative to what is exchanged, and `uniform`."""
    dih = Dih(edges=edges, eos=IdealGas(), law=ConstEta(0.3, 0.4), zeta=0.1, transport=transport)
    rng, n, d = np.random.default_rng(0), edges.n, edges.d
    state = dih.state(rng.uniform(0.9, 1.1, n), rng.normal(0, 0.2, (n, d)), rng.uniform(0.9, 1.1, n))
    change = rates(dih, state)
    lost = np.abs(dih.conserved(change))/(np.abs(change)@edges.V)
    uniform = dih.state(np.ones(n), np.ones((n, 1))*WIND[:d], np.ones(n))
    return {"lost": float(lost.max()), "uniform": float(np.abs(rates(dih, uniform)).max())}


def rates(dih: Dih, state: np.ndarray) -> np.ndarray:
    """d(state)/dt."""
    out = np.empty_like(state)
    dih.rates(state, out)
    return out


@dataclass(frozen=True, kw_only=True)
class OneKernel(Case):
    """Momentum that the pressure's kernel P(rho(r), T(r')) alone would not keep    [RR98 Eqs 13, 14]"""
    disorder: Disorder
    d: int
    seed: int

    def run(self, report: Report, folder: Path) -> Outcome:
        at = self.disorder.make(COUNTS[self.d], self.disorder.size, self.seed)
        edges = renormalised(at, WendlandC2.of(h=RANGE[self.d], d=self.d))
        lost = one_kernel(edges, self.seed)
        return Outcome({"one_kernel": [{"points": self.disorder.name, "d": self.d, "seed": self.seed,
                                        "lost": lost}]})


def one_kernel(edges: Edges, seed: int) -> float:
    """Momentum lost over the sum of sizes, P = rho T, rho and T random: i gets S.P_ij/2, j gets S.P_ji/2."""
    rho, T = np.random.default_rng(seed).uniform(0.5, 1.5, (2, edges.n))
    i, j, half = edges.i, edges.j, edges.S/2
    there, back = half*(rho[i]*T[j])[:, None], half*(rho[j]*T[i])[:, None]
    lost = np.abs(back.sum(axis=0) - there.sum(axis=0)).max()
    return float(lost/(np.abs(there) + np.abs(back)).sum(axis=0).max())


#: A(r) and B(r) of Eq. 51 over the range h, as powers of r/h
FORMS = {"A 1/r": ((1.0, -1), (0.0, 0)), "B 1/r": ((0.0, 0), (1.0, -1)),
         "A and B 1/r": ((3.0, -1), (1.0, -1)),
         "A 1, B r^2": ((1.0, 0), (2.0, 2)), "A r, B 1": ((5.0, 1), (1.0, 0))}


@dataclass(frozen=True, kw_only=True)
class Friction(Case):
    """Viscosities of forces A(r) e (e.v_ij) + B(r) v_ij [RR98 Eq. 51]: from long waves on a lattice, and from M_A and M_B."""
    d: int
    form: str
    h: float

    def run(self, report: Report, folder: Path) -> Outcome:
        weight, at, d = WendlandC2.of(h=self.h, d=self.d), around(self.h, self.d), self.d
        A, B = (power(c, p, self.h) for c, p in FORMS[self.form])
        w, ex2 = at.number*W(weight, at.r)*at.r**2/2, (at.x/at.r)**2
        fourth = w@(A(at.r)*ex2**2)
        mixed = w@(A(at.r)*ex2*(1 - ex2))/(d - 1)
        plain = w@(B(at.r)*ex2)
        eta = mixed + plain
        zeta = fourth + plain - 2*(1 - 1/d)*eta
        moments = (second_moment(weight, d, X) for X in (A, B))
        eta_predicted, zeta_predicted = viscosities(d, *moments)
        return Outcome({"friction": [{"d": d, "form": self.form, "h": self.h, "eta": eta, "zeta": zeta,
                                      "eta_predicted": eta_predicted, "zeta_predicted": zeta_predicted}]})


def power(c: float, p: int, h: float) -> Callable[[Any], Any]:
    """c (r/h)^p."""
    return lambda r: c*(r/h)**p


def second_moment(weight: Any, d: int, X: Callable[[Any], Any]) -> float:
    """M_X = int W X r^2 dV."""
    return integral(weight, d, lambda r: W(weight, r)*X(r)*r**2).value


def viscosities(d: int, M_A: float, M_B: float) -> tuple[float, float]:
    """eta = M_A/2d(d+2) + M_B/2d, zeta = M_A/d(d+2) - (1 - 2/d) eta, with M_X = int W X r^2 dV."""
    eta = M_A/(2*d*(d + 2)) + M_B/(2*d)
    return eta, M_A/(d*(d + 2)) - (1 - 2/d)*eta


