"""Noise and dissipation as matrices: on which points is Q = 2 kT Gamma?    [RR98 Eqs 22-25, 42-44]

States of a gas about rho = T = 1 are densities (rho, p, eps); Boltzmann's k is 1.
"""
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from scipy import sparse

from continuum.fluid import ConstEta, IdealGas
from particles.integral import fluctuating
from particles.integral.closed_faces import Moving
from particles.integral.edge_makers import MAKERS
from particles.integral.edges import Edges
from particles.integral.fluctuating import Partners, mismatch
from particles.integral.points import jittered
from particles.limits import limit_of
from particles.run import Plan, run
from particles.threads import Team
from particles.walls.periodic import periodic
from particles.weights import WendlandC2
from studies.build.disorder import Disorder
from studies.kit.case import Case, Outcome, Report

ETA, ZETA, KAPPA = 0.3, 0.1, 0.4
KT = 0.7
NULL = 1e-12        # of the largest eigenvalue of a dissipation: what is below does not dissipate
ENERGIES = ("heat", "conduction", "heat+conduction")


# --- a gas at rest ----------------------------------------------------------------------------


def transport(edges: Edges, share: float, eta: float, zeta: float, kappa: float,
              T: Any) -> tuple[Partners, Partners]:
    """Viscosity and conduction with their noise, a share of it along edges: of momenta and of energies."""
    T = np.broadcast_to(T, (edges.n,))
    stress = fluctuating.stress(edges, eta, zeta, T)
    heat = fluctuating.heat(edges, kappa, T**2)
    if share == 0:
        return stress, heat
    friction = fluctuating.friction(edges, eta, zeta, T)
    conduction = fluctuating.conduction(edges, kappa, T**2)
    return fluctuating.mixed(stress, friction, share), fluctuating.mixed(heat, conduction, share)


def noise(V: np.ndarray, of_momenta: Any, of_energies: Any) -> sparse.csr_array:
    """Q (N, N) of a state of densities at rest from those of momenta and energies."""
    n, d = len(V), of_momenta.shape[0]//len(V)
    per = sparse.diags_array(np.tile(1/V, 2 + d))
    Q = sparse.block_diag([sparse.csr_array((n, n)), of_momenta, of_energies])
    return sparse.csr_array(per@Q@per)


def factor(edges: Edges, stress: Partners, heat: Partners) -> sparse.csr_array:
    """B of a state of densities from those of momenta and energies."""
    per = sparse.diags_array(np.tile(1/edges.V, edges.d + 1))
    B = per@sparse.block_diag([stress.B, heat.B])
    of_rho = sparse.csr_array((edges.n, B.shape[1]))
    return sparse.csr_array(sparse.vstack([of_rho, B]))


def equilibrium(V: np.ndarray, d: int) -> np.ndarray:
    """Covariance of densities of the gas at rest, all sums fixed.

    rho, v and T are independent, each with variance 1/V: <rho rho> = kT rho/(c_T^2 V), <v v> = kT/(rho V),
    <T T> = kT^2/(rho C_V V).
    """
    to_state = states_of_fields(np.zeros((len(V), d)))
    C = to_state@np.diag(np.tile(1/V, 2 + d))@to_state.T
    sums = np.kron(np.eye(2 + d), V)
    return C - C@sums.T@np.linalg.solve(sums@C@sums.T, sums@C)


def states_of_fields(v: np.ndarray) -> np.ndarray:
    """(N, N), changes of densities from those of (rho, v, T) at v (n, d); eps = rho (T + v^2/2)."""
    n, d = v.shape
    M = np.eye((2 + d)*n)
    rho, eps = slice(n), slice((1 + d)*n, None)
    for a in range(d):
        p = slice((1 + a)*n, (2 + a)*n)
        M[p, rho] = M[eps, p] = np.diag(v[:, a])
    M[eps, rho] = np.diag(1 + (v**2).sum(axis=1)/2)
    return M


# --- partners ---------------------------------------------------------------------------------


@dataclass(frozen=True, kw_only=True)
class Partnership(Case):
    """All kinds of noise on one set of points, with coefficients that vary by factors of five."""
    maker: str
    disorder: Disorder
    counts: tuple[int, ...]
    h: float = 2.7
    seed: int = 1

    @property
    def label(self) -> str:
        return f"partners {self.maker}, {self.disorder.name}, {self.counts}"

    def run(self, report: Report, folder: Path) -> Outcome:
        d = len(self.counts)
        points = self.disorder.make(self.counts, self.disorder.size, self.seed)
        try:
            edges = MAKERS[self.maker](points, WendlandC2.of(h=self.h, d=d))
        except ArithmeticError:         # these points have no such edges: see the study operators
            return Outcome({"partners": []})
        key = {"maker": self.maker, "points": self.disorder.name, "d": d}
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
        box, walls = (self.side, self.side), (*periodic(self.side), *periodic(self.side, 1))
        method = Moving(weight=WendlandC2.of(h=self.h), eos=IdealGas(), law=ConstEta(ETA, KAPPA), box=box,
                        walls=walls)
        points, rng = jittered(box, 0.2, self.seed), np.random.default_rng(self.seed)
        state = method.state(points.x, rng.normal(0, 0.2, points.x.shape), 1.0, np.ones(points.n))
        plan = Plan(dt=0.2*limit_of(method, state), steps=self.steps)
        edges = edges_between(method, run(method, state, plan).by_id())
        key = {"maker": "moving", "points": f"moved {self.steps} steps", "d": 2}
        return Outcome({"partners": [{**key, **row} for row in all_kinds(edges, self.seed)]})


def edges_between(method: Moving, state: np.ndarray) -> Edges:
    """The faces that a step of moving points begins with, as edges; periodic images are their points."""
    n, now = state.shape[1], state.copy()
    sums = method.start(n, Team(1))
    sums.around.relist(now, np.arange(n), 0.0)
    sums.make_faces(now)
    faces = sums.faces
    parent = np.concatenate([np.arange(n), sums.maker.ghosts.origin]).astype(int)
    i = np.repeat(np.arange(n), faces.taken)
    ends = faces.first + faces.taken
    entry = np.concatenate([np.arange(*range_) for range_ in zip(faces.first, ends, strict=True)])
    entry = entry.astype(int)
    j = parent[faces.near[entry]]
    once = i < j            # each face is stored with both of its points
    entry = entry[once]
    half = np.stack([faces.sx[entry], faces.sy[entry]], axis=1)
    apart = np.stack([faces.dx[entry], faces.dy[entry]], axis=1)
    V = method.fields(now).V
    return Edges(i=i[once], j=j[once], S=2*half, k=faces.k[entry], apart=apart, V=V)


def all_kinds(edges: Edges, seed: int) -> list[dict[str, Any]]:
    """A row for each kind of noise, coefficients random from point to point; in Eq. 42 constant once."""
    rng, d = np.random.default_rng(seed), edges.d
    eta, kappa = rng.uniform(0.2, 1, edges.n), rng.uniform(0.2, 1, edges.n)
    zeta = 0.9*(1 + 2/d)*rng.uniform(0, 1, edges.n)*eta
    kinds = exact_kinds(edges, eta, zeta, kappa)
    kinds["eq42"] = fluctuating.printed_stress(edges, eta, zeta, KT, doubled=True)
    kinds["eq42 constant"] = fluctuating.printed_stress(edges, 0.3, 0.1, KT, doubled=True)
    kinds["eq43"] = fluctuating.printed_heat(edges, kappa, KT, np.ones(edges.n), doubled=True)
    scalar = (*ENERGIES, "eq43")
    return [{"noise": name, **properties(pair, 1 if name in scalar else d)} for name, pair in kinds.items()]


def exact_kinds(edges: Edges, eta: Any, zeta: Any, kappa: Any) -> dict[str, Partners]:
    """Noise that is to be exact, by name; along edges only where all conduct a positive amount."""
    stress = fluctuating.stress(edges, eta, zeta, KT)
    heat = fluctuating.heat(edges, kappa, KT)
    kinds = {"stress": stress, "heat": heat}
    try:
        friction = fluctuating.friction(edges, eta, zeta, KT)
        conduction = fluctuating.conduction(edges, kappa, KT)
    except ValueError:
        return kinds
    mixtures = {"stress+friction": fluctuating.mixed(stress, friction, 0.1),
                "heat+conduction": fluctuating.mixed(heat, conduction, 0.1)}
    return {**kinds, "friction": friction, "conduction": conduction, **mixtures}


def properties(pair: Partners, components: int) -> dict[str, float]:
    """Relative sizes of what must be zero: Q - 2 kT Gamma, asymmetry, sums, uniform motion; null modes."""
    Gamma, n = pair.Gamma, pair.Gamma.shape[0]//components
    size = float(abs(Gamma).max())
    uniform = np.kron(np.eye(components), np.ones(n))
    values = np.linalg.eigvalsh((Gamma + Gamma.T).toarray()/2)
    return {"mismatch": mismatch(pair, 2*KT),
            "asymmetry": float(abs(Gamma - Gamma.T).max())/size,
            "sums": float(np.abs(uniform@pair.B).max()/abs(pair.B).max()),
            "uniform": float(np.abs(Gamma@uniform.T).max())/size,
            "nulls": int(np.count_nonzero(np.abs(values) < NULL*np.abs(values).max())),
            "negative": float(min(values[0], 0)/size)}
