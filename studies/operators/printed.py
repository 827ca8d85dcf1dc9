"""RR98's discrete sums written out literally: volumes, trace factor, uniform streams, null modes    [RR98 Eqs 21, 26-38]"""
from collections.abc import Iterator
from dataclasses import dataclass
from itertools import product
from pathlib import Path
from typing import Any

import numpy as np
from scipy import sparse

from continuum.fluid import ConstEta, IdealGas
from particles.integral.dih import Dih, NestedFluxes, Pairwise
from particles.integral.edge_makers import plain, renormalised
from particles.integral.edges import Edges
from particles.integral.interpolants import reach
from particles.integral.points import lattice
from particles.weights import Lucy, WendlandC2
from studies.build.disorder import Disorder
from studies.kit.case import Case, Outcome, Report
from studies.operators.equations import arriving
from studies.operators.weights import weight_of

Sums = list[sparse.csr_array]


def brackets(edges: Edges) -> Sums:
    """The matrices W(r_ij) e^alpha_ij of Eqs 29, 33-38, one a direction; e_ij leads from j to i."""
    return [sparse.csr_array(sparse.diags_array(-0.5/edges.V)@S) for S in edges.areas]


def inner(w: Sums, v: np.ndarray) -> np.ndarray:
    """sum_k W e^alpha_jk v^beta_k, (n, d, d): -grad v."""
    return np.stack([M@v for M in w], axis=1)


def kernel(g: np.ndarray, eta: float, zeta: float, trace: float) -> np.ndarray:
    """pi_ij of Eq. 37 without i, for constant viscosities, with the trace factor as given; g as from `inner`."""
    div = np.trace(g, axis1=1, axis2=2)[:, None, None]*np.eye(g.shape[1])
    return -eta*(g + g.transpose(0, 2, 1) - trace*div) - zeta*div


def mass_rate(w: Sums, m: np.ndarray, v: np.ndarray) -> np.ndarray:
    """dm_i/dt    [RR98 Eq. 34]"""
    return sum(m*(M@u) + u*(M@m) for M, u in zip(w, v.T, strict=True))


def convected(w: Sums, p: np.ndarray, v: np.ndarray) -> np.ndarray:
    """What convection brings to dp_i/dt, (n, d)    [RR98 Eq. 35]"""
    return np.stack([mass_rate(w, q, v) for q in p.T], axis=1)


def force(w: Sums, pi: np.ndarray) -> np.ndarray:
    """-sum_j W e^b_ij (pi^ab_i + pi^ab_j)    [RR98 Eq. 35]"""
    one = np.ones(len(pi))
    return -sum(M@pi[:, :, b] + (M@one)[:, None]*pi[:, :, b] for b, M in enumerate(w))


def heat(w: Sums, J: np.ndarray) -> np.ndarray:
    """sum_j W e_ij.(J_i + J_j)    [RR98 Eq. 36]"""
    return sum(M@q + (M@np.ones(len(q)))*q for M, q in zip(w, J.T, strict=True))


def linearised_printed(w: Sums, rho: np.ndarray, v: np.ndarray, d_rho: np.ndarray,
                       dv: np.ndarray) -> np.ndarray:
    """Right-hand side of Eq. 21, as printed."""
    parts = ((M@rho)*du + (M@d_rho)*u + rho*(M@du) + d_rho*(M@u) for M, u, du in zip(w, v.T, dv.T, strict=True))
    return -sum(parts)


def ratio(literal: np.ndarray, true: np.ndarray) -> float:
    """Projection of one field on another."""
    return float(np.sum(literal*true)/np.sum(true**2))


def readings(edges: Edges, x: np.ndarray, k: float) -> Iterator[tuple[str, float, float]]:
    """(quantity, literal value over what it stands for, predicted) in a wave along x, in 2D."""
    w, dV, one = brackets(edges), edges.V[0], np.ones(edges.n)
    s, c = np.sin(k*x), np.cos(k*x)
    v, divergence = np.stack([s, c], axis=1), k*c
    yield "divergence, Eq. 33 in Eq. 1", ratio(-(w[0]@s), k*c), 1.0
    yield "mass, v_i = v", ratio(mass_rate(w, dV*one, v), -divergence*dV), 1.0
    yield "mass, v_i = v dV", ratio(mass_rate(w, dV*one, v*dV), -divergence*dV), dV
    carried = -k*np.stack([2*s*c, np.cos(2*k*x)], axis=1)*dV        # -div(v v) dV, rho = 1
    yield "momentum, p_i = m_i v_i, v_i = v", ratio(convected(w, dV*v, v), carried), 1.0
    yield "momentum, p_i = m_i v_i, v_i = v dV", ratio(convected(w, dV*(v*dV), v*dV), carried), dV**2
    P = (1 + 0.1*s)*dV                  # at rest, uniform T: P_ij + P_ji = P_i + P_j, as `heat` sums
    yield "pressure, P_ij = P dV", ratio(heat(w, np.stack([P, 0*P], axis=1)), -0.1*k*c*dV), 1.0
    friction = -k**2*np.stack([s, c], axis=1)*dV            # eta = 1, zeta = 0 in 2D: div Pi = lap v
    yield "stress, v_i = v", ratio(force(w, kernel(inner(w, v), 1.0, 0.0, 1.0)), friction), 1/dV
    yield "stress, v_i = v dV", ratio(force(w, kernel(inner(w, v*dV), 1.0, 0.0, 1.0)), friction), 1.0
    current = inner(w, s[:, None])[:, :, 0]                 # kappa = 1
    yield "heat", ratio(heat(w, current), -k**2*s*dV), 1/dV
    d_rho, dv, rho, v0 = 0.1*c, 0.1*v, 1 + 0.2*s, np.stack([0.3 + 0.1*c, 0*c], axis=1)
    step = 1e-4                             # mass_rate is quadratic: the central difference is exact
    above = mass_rate(w, rho + step*d_rho, v0 + step*dv)
    below = mass_rate(w, rho - step*d_rho, v0 - step*dv)
    true = (above - below)/(2*step)
    yield "linearised mass, Eq. 21", ratio(linearised_printed(w, rho, v0, d_rho, dv), true), -1.0


@dataclass(frozen=True, kw_only=True)
class Volumes(Case):
    """Eqs 21, 26, 27, 33-38 read literally on a lattice of spacing 1/2, where dV is 1/4."""
    rows: int = 64
    a: float = 0.5

    def run(self, report: Report, folder: Path) -> Outcome:
        at = lattice((self.rows, 8), self.a)
        edges = renormalised(at, Lucy.of(h=3*self.a))
        k = 2*np.pi/(self.rows*self.a)
        return Outcome({"volumes": [
            {"quantity": name, "dV": self.a**2, "ratio": value, "predicted": predicted}
            for name, value, predicted in readings(edges, at.x[:, 0], k)]})


@dataclass(frozen=True, kw_only=True)
class Dilation(Case):
    """Mean normal stress of v = x in the middle of a patch, with the trace factor 2/3 as printed or 2/d    [RR98 Eq. 37]"""
    d: int
    eta: float = 1.0
    zeta: float = 0.3

    def run(self, report: Report, folder: Path) -> Outcome:
        at = lattice((12,)*self.d)
        edges = renormalised(at, WendlandC2.of(h=2.5, d=self.d))
        g = inner(brackets(edges), at.x)
        middle = (np.abs(at.x) < 2).all(axis=1)
        rows = []
        for name, trace in (("2/3", 2/3), ("2/d", 2/self.d)):
            pi = kernel(g, self.eta, self.zeta, trace)[middle]
            normal = np.trace(pi, axis1=1, axis2=2).mean()/self.d**2         # div v = d
            bulk = float(normal - self.zeta)/self.eta
            rows.append({"d": self.d, "trace": name, "bulk": bulk, "predicted": 2/self.d - trace})
        return Outcome({"dilation": rows})


@dataclass(frozen=True, kw_only=True)
class Stream(Case):
    """Nested transport off a lattice, its inner sums as printed or by differences: what it does to uniform fields."""
    disorder: Disorder
    seed: int
    counts: tuple[int, int] = (10, 10)

    def run(self, report: Report, folder: Path) -> Outcome:
        at = self.disorder.make(self.counts, self.disorder.size, self.seed)
        edges = renormalised(at, WendlandC2.of(h=3.0))
        key = {"points": self.disorder.name, "seed": self.seed}
        kinds = {"printed": NestedFluxes(differences=False), "differences": NestedFluxes()}
        return Outcome({"stream": [{**key, "inner": name, **stream(edges, nested)}
                                   for name, nested in kinds.items()]})


def stream(edges: Edges, transport: NestedFluxes) -> dict[str, float]:
    """Columns of the table `stream`, eta = kappa = rho = 1."""
    dih = Dih(edges=edges, eos=IdealGas(), law=ConstEta(1.0, 1.0), transport=transport)
    one = np.ones(edges.n)
    wind = dih.flow(dih.state(one, one[:, None]*np.array([0.6, 0.8]), one))
    fluxes = transport.fluxes(dih, wind)
    still = transport.fluxes(dih, wind._replace(v=0*wind.v))
    K = operator(edges, transport)
    root = 1/np.sqrt(edges.V)
    return {"force": rms(arriving(edges, fluxes.momentum)),
            "heat": rms(arriving(edges, still.energy)[:, None]),
            "asymmetry": float(np.linalg.norm(K - K.T)/np.linalg.norm(K)),
            "growth": float(np.linalg.eigvals(root[:, None]*K*root).real.max())}


def operator(edges: Edges, transport: NestedFluxes) -> np.ndarray:
    """The matrix K with V div(grad T) = K T."""
    slopes = edges.G if transport.differences else [S/2 for S in edges.areas]
    per_volume = sparse.diags_array(1/edges.V)
    parts = [(D@per_volume@M).toarray() for D, M in zip(edges.D, slopes, strict=True)]
    return np.sum(parts, axis=0)


def rms(f: np.ndarray) -> float:
    """Root mean square length of vectors (n, d)."""
    return float(np.sqrt((f**2).sum(axis=1).mean()))


@dataclass(frozen=True, kw_only=True)
class Nulls(Case):
    """What nested and pairwise Laplacians see of waves that change sign from point to point, at every Nyquist corner."""
    kind: Any
    d: int
    h: float

    def run(self, report: Report, folder: Path) -> Outcome:
        weight = weight_of(self.kind, self.h, self.d)
        at = lattice((2*int(reach(weight) + 1),)*self.d)
        edges = plain(at, weight)
        corners = [c for c in product((0, 1), repeat=self.d) if any(c)]
        waves = [np.cos(np.pi*((at.x - at.x[0])@np.array(c))) for c in corners]
        nested = max(float(np.abs(edges.grad(wave)).max()) for wave in waves)
        pairwise = min(float((-wave*edges.lap(wave)).min()) for wave in waves)
        return Outcome({"nulls": [{"weight": self.kind.__name__, "d": self.d, "h": self.h,
                                   "corners": len(corners),
                                   "nested": nested, "pairwise": pairwise}]})


@dataclass(frozen=True, kw_only=True)
class Rotation(Case):
    """Heating of a rigid rotation by forces along edges, in the middle of a patch    [RR98 Eq. 51]

    Along edges nothing changes, so only the force along v_ij heats: with 2 B omega^2, B = eta (1/2 + 1/d) - zeta/2.
    """
    d: int
    zeta: float

    def run(self, report: Report, folder: Path) -> Outcome:
        at = lattice((24, 24) if self.d == 2 else (14, 14, 14))
        edges, omega = renormalised(at, WendlandC2.of(h=2.2, d=self.d)), 0.05
        v = np.zeros_like(at.x)
        v[:, 0], v[:, 1] = -omega*at.x[:, 1], omega*at.x[:, 0]
        middle = np.sqrt((at.x**2).sum(axis=1)) < 2.5      # two ranges from where the rotation ends
        key, work = {"d": self.d, "zeta": self.zeta}, 1 + 2/self.d - self.zeta
        rows = []
        for mended, name, predicted in ((False, "no", work), (True, "yes", 0.0)):
            rate = heating(edges, v, Pairwise(mended=mended), self.zeta)[middle].mean()/omega**2
            rows.append(key | {"mended": name, "heating": float(rate), "predicted": predicted})
        return Outcome({"rotation": rows})


def heating(edges: Edges, v: np.ndarray, transport: Any, zeta: float) -> np.ndarray:
    """d(internal energy)/dt by friction at uniform density and temperature, eta = 1."""
    one = np.ones(edges.n)
    dih = Dih(edges=edges, eos=IdealGas(), law=ConstEta(1.0, 1.0), zeta=zeta, transport=transport)
    fluxes = transport.fluxes(dih, dih.flow(dih.state(one, v, one)))
    return arriving(edges, fluxes.energy) - (v*arriving(edges, fluxes.momentum)).sum(axis=1)

