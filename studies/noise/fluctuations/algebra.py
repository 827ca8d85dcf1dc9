"""Noise and dissipation as matrices, as cases: which are partners, how much printed ones miss    [RR98 Eqs 22-25, 42-44]"""
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from continuum.fluid import ConstEta, IdealGas
from particles.integral import fluctuating
from particles.integral.closed_faces import Moving
from particles.integral.edge_makers import MAKERS
from particles.integral.edges import Edges
from particles.integral.fluctuating import Partners, mismatch
from particles.integral.interpolants import W
from particles.integral.points import jittered, lattice
from particles.limits import limit_of
from particles.run import Plan, run
from particles.threads import Team
from particles.walls.periodic import periodic
from particles.weights import Lucy, WendlandC2
from studies.build.disorder import Disorder
from studies.build.symbols import neighbours
from studies.kit.case import Case, Outcome, Report
from studies.noise.fluctuations.matrices import ETA, KAPPA

KT = 0.7
NULL = 1e-12        # of the largest eigenvalue of a dissipation: what is below does not dissipate


def exact_ones(edges: Edges, eta: Any, zeta: Any, kappa: Any) -> dict[str, Partners]:
    """Noise that is to be exact, by name; without noise along edges where one of these conducts a negative amount."""
    found = {"stress": fluctuating.stress(edges, eta, zeta, KT), "heat": fluctuating.heat(edges, kappa, KT)}
    try:
        found["friction"] = fluctuating.friction(edges, eta, zeta, KT)
        found["conduction"] = fluctuating.conduction(edges, kappa, KT)
    except ValueError:
        return found
    return {**found, "stress+friction": fluctuating.mixed(found["stress"], found["friction"], 0.1),
            "heat+conduction": fluctuating.mixed(found["heat"], found["conduction"], 0.1)}


@dataclass(frozen=True, kw_only=True)
class Partnership(Case):
    """All kinds of noise on one set of points, with coefficients that vary from point to point by factors of five."""
    maker: str
    disorder: Disorder
    counts: tuple[int, ...]
    h: float = 2.7
    seed: int = 1

    @property
    def label(self) -> str:
        return f"partners {self.maker}, {self.disorder.name}, {self.counts}"

    def run(self, report: Report, folder: Path) -> Outcome:
        points, d = self.disorder.make(self.counts, self.disorder.size, self.seed), len(self.counts)
        key = {"maker": self.maker, "points": self.disorder.name, "d": d}
        try:
            edges = MAKERS[self.maker](points, WendlandC2.of(h=self.h, d=d))
        except ArithmeticError:         # no such edges exist on these points: study operators tells
            return Outcome({"partners": []})
        return Outcome({"partners": [{**key, **row} for row in all_kinds(edges, self.seed)]})


@dataclass(frozen=True, kw_only=True)
class MovingPartnership(Case):
    """The same on the faces between points that have moved for so many steps, in a periodic box of 2D."""
    steps: int
    side: int = 8
    h: float = 2.9
    seed: int = 1

    @property
    def label(self) -> str:
        return f"partners moving, {self.steps} steps"

    def run(self, report: Report, folder: Path) -> Outcome:
        method = Moving(weight=WendlandC2.of(h=self.h), eos=IdealGas(), law=ConstEta(ETA, KAPPA), box=(self.side, self.side),
                        walls=(*periodic(self.side), *periodic(self.side, 1)))
        points, rng = jittered((self.side, self.side), 0.2, self.seed), np.random.default_rng(self.seed)
        state = method.state(points.x, rng.normal(0, 0.2, points.x.shape), 1.0, np.ones(points.n))
        end = run(method, state, Plan(dt=0.2*limit_of(method, state), steps=self.steps)).by_id()
        key = {"maker": "moving", "points": f"moved {self.steps} steps", "d": 2}
        return Outcome({"partners": [{**key, **row} for row in all_kinds(edges_between(method, end), self.seed)]})


def edges_between(method: Moving, state: np.ndarray) -> Edges:
    """The faces that a step of moving points begins with, as edges; periodic images are their points."""
    n, now = state.shape[1], state.copy()
    sums = method.start(n, Team(1))
    sums.around.relist(now, np.arange(n), 0.0)
    sums.make_faces(now)
    faces, parent = sums.faces, np.concatenate([np.arange(n), sums.maker.ghosts.origin]).astype(int)
    rows = np.repeat(np.arange(n), faces.taken)
    entry = np.concatenate([np.arange(first, first + taken) for first, taken in zip(faces.first, faces.taken, strict=True)])
    entry = entry.astype(int)
    once = rows < parent[faces.near[entry]]         # each face is stored with both of its points
    i, entry = rows[once], entry[once]
    half, apart = (np.stack([x[entry], y[entry]], axis=1) for x, y in ((faces.sx, faces.sy), (faces.dx, faces.dy)))
    return Edges(i=i, j=parent[faces.near[entry]], S=2*half, k=faces.k[entry], apart=apart, V=now[7])


def all_kinds(edges: Edges, seed: int) -> list[dict[str, Any]]:
    """A row for each kind of noise, coefficients random from point to point; viscosities of Eq. 42 constant once."""
    rng, d = np.random.default_rng(seed), edges.d
    eta, kappa, part = rng.uniform(0.2, 1, edges.n), rng.uniform(0.2, 1, edges.n), rng.uniform(0, 1, edges.n)
    zeta = 0.9*(1 + 2/d)*part*eta
    kinds = exact_ones(edges, eta, zeta, kappa)
    kinds["eq42"] = fluctuating.printed_stress(edges, eta, zeta, KT, doubled=True)
    kinds["eq42 constant"] = fluctuating.printed_stress(edges, 0.3, 0.1, KT, doubled=True)
    kinds["eq43"] = fluctuating.printed_heat(edges, kappa, KT, np.ones(edges.n), doubled=True)
    return [{"noise": name, **judged(pair, d if of_momenta(name) else 1)} for name, pair in kinds.items()]


def of_momenta(name: str) -> bool:
    """Does this noise act on momenta?"""
    return name not in ("heat", "conduction", "heat+conduction", "eq43")


def judged(pair: Partners, components: int) -> dict[str, float]:
    """Relative sizes of what must be zero: Q - 2 kT Gamma, its asymmetry, sums over points, uniform motion; null modes."""
    n, size = pair.Gamma.shape[0]//components, float(abs(pair.Gamma).max())
    sums = np.kron(np.eye(components), np.ones(n))
    values = np.linalg.eigvalsh((pair.Gamma + pair.Gamma.T).toarray()/2)
    return {"mismatch": mismatch(pair, 2*KT), "asymmetry": float(abs(pair.Gamma - pair.Gamma.T).max())/size,
            "sums": float(np.abs(sums@pair.B).max()/abs(pair.B).max()), "uniform": float(np.abs(pair.Gamma@sums.T).max())/size,
            "nulls": int(np.count_nonzero(np.abs(values) < NULL*np.abs(values).max())), "negative": float(min(values[0], 0)/size)}


# --- the printed ones, wave by wave -----------------------------------------------------------------------------------


@dataclass(frozen=True, kw_only=True)
class PrintedWaves(Case):
    """Variance of printed noise over its due, 2 kT Gamma of Eq. 37 or 38, for waves along x on a lattice; at T = 0.7.

    term : "eta" across k, "zeta" along k, "kappa". h 1.5 in 1D and 1.2 in 2D: nearest neighbours.
    """
    equation: str
    term: str
    doubled: bool
    d: int
    h: float
    waves: int = 32

    @property
    def cost(self) -> float:
        return 0.1

    @property
    def reading(self) -> str:
        """Of the bracket: pi_ij + pi_ji (Eq. 35), or pi_ij (Eq. 22)."""
        return "doubled" if self.doubled else "single"

    @property
    def label(self) -> str:
        return f"Eq. {self.equation} {self.term} {self.reading}, {self.d}D, h {self.h:g}"

    def run(self, report: Report, folder: Path) -> Outcome:
        counts = (self.waves, *[2*int(np.ceil(self.h)) + 1]*(self.d - 1))
        points, weight = lattice(counts), Lucy.of(h=self.h, d=self.d)
        edges = MAKERS["renormalised"](points, weight)
        pair, twice = self.printed(edges)
        found = []
        for turns in range(1, self.waves//2):
            k = 2*np.pi*turns/self.waves
            components = np.zeros((pair.Gamma.shape[0]//edges.n, edges.n), complex)
            components[1 if self.term == "eta" else 0] = np.exp(1j*k*points.x[:, 0])
            wave = components.ravel()
            ratio = float(((wave.conj()@(pair.Q@wave))/(twice*(wave.conj()@(pair.Gamma@wave)))).real)
            found.append({"equation": self.equation, "term": self.term, "reading": self.reading, "d": self.d, "h": self.h,
                          "wavenumber": k, "ratio": ratio, "predicted": self.predicted(weight, k)})
        return Outcome({"printed": found})

    def printed(self, edges: Edges) -> tuple[Partners, float]:
        """The noise, and 2 kT or 2 k T^2."""
        if self.term == "kappa":
            return fluctuating.printed_heat(edges, KAPPA, 1.0, np.full(edges.n, KT), doubled=self.doubled,
                                            of25=self.equation == "25"), 2*KT**2
        eta, zeta = (ETA, 0.0) if self.term == "eta" else (0.0, ETA)
        return fluctuating.printed_stress(edges, eta, zeta, KT, doubled=self.doubled,
                                          bulk=2.0 if self.equation == "23" else 1.0), 2*KT

    def predicted(self, weight: Any, k: float) -> float:
        """From sums over the lattice: c^2 sum w^2 (1 - cos k.r) g/(sum w e_x sin k.r)^2, c = 2 if doubled.

        g = 2 [1 + (1 - 2/3) e_y^2] for eta, e_x^2 for zeta (2 e_x^2 of Eq. 23), 1/T for kappa (2 of Eq. 25).
        """
        r = neighbours(weight, self.d)
        size = np.sqrt((r**2).sum(axis=1))
        w = W(weight, size)
        w *= self.d/(w@size)
        g = {"eta": 2*(1 + (r[:, -1]/size)**2/3), "zeta": (2.0 if self.equation == "23" else 1.0)*(r[:, 0]/size)**2,
             "kappa": 2.0 if self.equation == "25" else 1/KT}[self.term]
        slope = float((w*r[:, 0]/size)@np.sin(k*r[:, 0]))
        return (4 if self.doubled else 1)*float((w**2*g)@(1 - np.cos(k*r[:, 0])))/slope**2
