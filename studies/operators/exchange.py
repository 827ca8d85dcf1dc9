"""What the brackets conserve and keep, and the viscosities of forces along edges    [RR98 Eqs 13, 34-36, 51]"""
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from continuum.fluid import ConstEta, IdealGas
from particles.integral.dih import Dih, Flow, Fluxes, Nested, Pairwise, carried, take
from particles.integral.edge_makers import renormalised
from particles.integral.edges import Edges
from particles.integral.interpolants import W
from particles.integral.points import Points
from particles.weights import WendlandC2
from studies.build.disorder import Disorder
from studies.kit.case import Case, Outcome, Report
from studies.operators.equations import arriving
from studies.operators.weights import around, integral

COUNTS = {1: (20,), 2: (10, 12), 3: (6, 6, 7)}
RANGE = {1: 2.7, 2: 2.7, 3: 2.2}
WIND = np.array([0.3, -0.2, 0.1])
STREAM = np.array([0.6, 0.8, 0.3])
KEPT = ("lost", "uniform", "wind", "skew")
TRANSPORT = {"nested": Nested(), "printed": Nested(differences=False), "pairwise": Pairwise(mended=False)}


@dataclass(frozen=True, kw_only=True)
class Invariance(Case):
    """What a random state loses of mass, momentum and energy, and what a wind changes, relative to the largest rate."""
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
            return Outcome({"invariance": [{**key, "transport": name, **dict.fromkeys(KEPT, np.nan)} for name in TRANSPORT]})
        skew = max(float(np.abs(c).max()/np.linalg.norm(D.toarray(), 2)) for c, D in zip(edges.closure.T, edges.D, strict=True))
        return Outcome({"invariance": [{**key, "transport": name, "skew": skew, **kept(edges, transport)}
                                       for name, transport in TRANSPORT.items()]})


def kept(edges: Edges, transport: Any) -> dict[str, float]:
    """Columns `lost`, `uniform` and `wind`."""
    dih = Dih(edges=edges, eos=IdealGas(), law=ConstEta(0.3, 0.4), zeta=0.1, transport=transport)
    rng, n, d = np.random.default_rng(0), edges.n, edges.d
    state = dih.state(rng.uniform(0.9, 1.1, n), rng.normal(0, 0.2, (n, d)), rng.uniform(0.9, 1.1, n))
    still = rates(dih, state)
    lost = np.abs(dih.conserved(still))/(np.abs(still)@edges.V)
    wind = WIND[:d]
    blown, found = in_wind(state, wind), rates(dih, in_wind(state, wind))
    carried = np.stack([-sum(u*(D@q)/edges.V for u, D in zip(wind, edges.D, strict=True)) for q in blown])
    uniform = dih.state(np.ones(n), np.ones((n, 1))*wind, np.ones(n))
    return {"lost": float(lost.max()), "uniform": largest(rates(dih, uniform)),
            "wind": largest(found - in_wind(still, wind) - carried)/largest(found)}


def rates(dih: Dih, state: np.ndarray) -> np.ndarray:
    """d(state)/dt."""
    out = np.empty_like(state)
    dih.rates(state, out)
    return out


def in_wind(state: np.ndarray, wind: np.ndarray) -> np.ndarray:
    """The same state, or the same rates, seen by somebody who moves with -wind."""
    rho, p, eps = state[0], state[1:-1], state[-1]
    return np.stack([rho, *(p + rho*wind[:, None]), eps + wind@p + rho*(wind@wind)/2])


@dataclass(frozen=True, kw_only=True)
class Work(Case):
    """Pressure and mass in a uniform stream on renormalised edges    [RR98 Eqs 34, 36], and one kernel alone    [Eqs 13, 14]"""
    disorder: Disorder
    d: int
    seed: int

    def run(self, report: Report, folder: Path) -> Outcome:
        at = self.disorder.make(COUNTS[self.d], self.disorder.size, self.seed)
        edges = renormalised(at, WendlandC2.of(h=RANGE[self.d], d=self.d))
        return Outcome({"work": [{"points": self.disorder.name, "d": self.d, "seed": self.seed, **works(edges, self.seed)}]})


def works(edges: Edges, seed: int) -> dict[str, float]:
    """Columns of the table `work`; rho and T random about 1, |U| = 1."""
    rng, n, half = np.random.default_rng(seed), edges.n, edges.S/2
    U = STREAM[:edges.d]/np.sqrt((STREAM[:edges.d]**2).sum())
    rho, T = rng.uniform(0.5, 1.5, (2, n))
    flow = Flow(rho, np.ones((n, 1))*U, T, np.zeros(n), rho*T)      # no energy to carry: Eq. 36 then is the work of pressure
    push = arriving(edges, through(edges, flow._replace(v=0*flow.v)).momentum)@U
    own = arriving(edges, half@U*(flow.P[edges.i] + flow.P[edges.j]))
    there, back = (half*(rho[a]*T[b])[:, None] for a, b in ((edges.i, edges.j), (edges.j, edges.i)))
    total = np.abs(back.sum(axis=0) - there.sum(axis=0)).max()      # one kernel: i gives S.P_ij/2, j gets S.P_ji/2
    return {"work": largest(arriving(edges, through(edges, flow).energy) - push), "own": largest(own - push),
            "mass": largest(arriving(edges, through(edges, flow._replace(rho=np.ones(n))).mass)),
            "one_kernel": float(total/(np.abs(there) + np.abs(back)).sum(axis=0).max())}


def through(edges: Edges, flow: Flow) -> Fluxes:
    """Brackets of Eqs 34-36 without stress and heat, through all edges."""
    return carried(IdealGas(), edges.S, take(flow, edges.i), take(flow, edges.j))


def largest(f: np.ndarray) -> float:
    """Largest size."""
    return float(np.abs(f).max())


#: A(r) and B(r) of Eq. 51 over the range h, as powers of r/h
FORMS = {"A 1/r": ((1.0, -1), (0.0, 0)), "B 1/r": ((0.0, 0), (1.0, -1)), "A and B 1/r": ((3.0, -1), (1.0, -1)),
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
        fourth, mixed = w@(A(at.r)*ex2**2), w@(A(at.r)*ex2*(1 - ex2))/(d - 1) if d > 1 else 0.0
        plain = w@(B(at.r)*ex2)
        predicted = viscosities(d, *(second_moment(weight, d, X) for X in (A, B)))
        row = {"d": d, "form": self.form, "h": self.h, "eta": mixed + plain, "eta_diagonal": (fourth - mixed)/2 + plain,
               "eta_predicted": predicted[0], "zeta_predicted": predicted[1]}
        return Outcome({"friction": [{**row, "zeta": fourth + plain - 2*(1 - 1/d)*row["eta"]}]})


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


def pairs_of(maker: str, kinds: list[str], dimensions: tuple[int, ...]) -> Iterator[tuple[str, int]]:
    """(points, d) on which a maker has edges: triangles need two dimensions, and points that do not lie on spheres."""
    yield from ((kind, d) for kind in kinds for d in dimensions
                if not (maker == "delaunay" and (d == 1 or (d == 3 and kind == "lattice"))))
