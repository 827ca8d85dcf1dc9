"""Algebra and arithmetic of printed formulas: Eqs 21-23, 42, 44; dissipative particles as a special case

Eq. 49 with Eq. 51, B = 0, and the zeta term of Eq. 42 beside it, its brackets doubled as in Eq. 35:

    force on i = sum_j w e_ij [P_ij - A e.(v_i - v_j) - 2 sqrt(2 kT zeta V/dt) Y_ij],    W dV = w

With w = 1 - r/rc, A = gamma w, 8 zeta V = 2 gamma these are Groot and Warren's; Y_ij and -Y_ij are alike.
RR98's W, of which the moment int W r dV is d, is c w, c = 15/pi in 3D.
"""
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from particles.dissipative.dpd import Dpd
from particles.integral import fluctuating
from particles.integral.edge_makers import MAKERS
from particles.integral.points import lattice, random
from particles.noise import uniform_of_pair
from particles.run import Run
from particles.threads import Team
from particles.weights import Lucy
from studies.kit.case import Case, Outcome, Report
from studies.noise.printed import isothermal

STEP = 0.02
#: 3D: int (1 - r) r dV = pi/5 over the unit ball is to be 3
SCALE = 15/np.pi


def other_partner() -> float:
    """|Q - 2 kT Gamma| of the eta term of Eq. 42 on random points, Gamma along edges, trace factor 2/d."""
    edges = MAKERS["delaunay"](random((8, 8), 0.5, 1), None)
    k = np.maximum(edges.k, 1e-3)       # any positive number: A and B make it up
    V, S2 = (edges.V[edges.i] + edges.V[edges.j])/2, (edges.S**2).sum(axis=1)
    pair = fluctuating.printed_stress(edges, 0.3, 0.0, 1.0, doubled=False, trace=1.0)
    A = 0.3*S2/(2*V)/k                  # 2D: S S (1 - 2/d) vanishes, B = 0
    wider = type(edges)(i=edges.i, j=edges.j, S=edges.S, k=k, apart=edges.apart, V=edges.V)
    due = 2*fluctuating.between(wider, A, 0*A, np.ones(len(A))).Gamma
    return float(abs(pair.Q - due).max()/abs(due).max())


def finer() -> float:
    """Variance of the literal noise over its due at the spacing 1/2 over that at 1, 2D: a missing volume."""
    def ratio(a: float) -> float:
        edges = MAKERS["renormalised"](lattice((8, 8), a), Lucy.of(h=1.5*a))
        pair = fluctuating.printed_stress(edges, 0.3, 0.1, 1.0, doubled=True, volume=False)
        return float(pair.Q.diagonal().sum()/(2*pair.Gamma.diagonal().sum()))
    return ratio(0.5)/ratio(1.0)


def half_step() -> float:
    """<u u> with increments of unit variance whatever the step, at dt/2 over that at dt; u decays."""
    def variance(dt: float) -> float:
        l = 0.1     # u' = (1 - l dt/2)/(1 + l dt/2) u + dt X/(1 + l dt/2), <X X> = 1
        return dt**2/((1 + l*dt/2)**2 - (1 - l*dt/2)**2)
    return variance(0.5)/variance(1.0)


def inner_k(k: float = 0.5) -> float:
    """<(tr Pi)^2>/<Pi_xy^2> of Eq. 23 in 3D without bulk viscosity, 6 (1 - k): an inner k is left over."""
    tensor = fluctuating.shear(3, 2/3*k).reshape(3, 3, 3, 3)
    return float(np.einsum("aacc->", tensor)/tensor[0, 1, 0, 1])


def wrong_sign() -> float:
    """Largest growth rate of sound at k = 0.4 with the sign of Eq. 21 as printed."""
    J, _ = isothermal(0.4)
    J[0] *= -1
    return float(np.linalg.eigvals(J).real.max())


def bulk(d: int) -> float:
    """Variance of the trace of X, over d^2: noise of a bulk viscosity that is not there."""
    tensor = fluctuating.shear(d, 2/3).reshape(d, d, d, d)
    return float(np.trace(tensor.trace(axis1=0, axis2=1)))/d**2


@dataclass(frozen=True, kw_only=True)
class Formulas(Case):
    """What printed formulas give, each a row of `formulas`."""

    @property
    def label(self) -> str:
        return "formulas"

    def run(self, report: Report, folder: Path) -> Outcome:
        return listed({"growth of Eq. 21": wrong_sign(), "trace of Eq. 23": inner_k(),
                       "partner of Eq. 42": other_partner(), "step of Eq. 42": half_step(),
                       "spacing of Eq. 42": finer(), "trace of Eq. 44": bulk(2)})


def listed(values: dict[str, float]) -> Outcome:
    """Numbers by name as rows."""
    return Outcome({"formulas": [{"name": name, "value": value} for name, value in values.items()]})


# --- dissipative particles --------------------------------------------------------------------


def neighbours(method: Dpd, rho: float = 3.0) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """A random state (3 d, n), weights w (n, n) by nearest images, unit vectors e_ij (d, n, n)."""
    state, box = method.random_start(rho), np.array(method.box)[:, None, None]
    x = state[:method.d]
    apart = x[:, :, None] - x[:, None, :]
    apart -= box*np.round(apart/box)
    r = np.sqrt((apart**2).sum(axis=0)) + 2*method.rc*np.eye(state.shape[1])
    return state, np.maximum(1 - r/method.rc, 0), apart/r


def forces(method: Dpd, x: np.ndarray, v: np.ndarray) -> np.ndarray:
    """Those that run, (d, n), with the noise of the first step."""
    n, out = x.shape[1], np.empty_like(x)
    sums = method.start(n, Team(1))
    sums.resume(Run(state=np.concatenate([x, v, 0*x]), ids=np.arange(n), step=0))
    sums.dt = STEP
    sums.forces(x, v, 0.0, out)
    return out


def special(d: int) -> float:
    """Largest difference between the forces that run and those of RR98's equations, over the largest."""
    method = Dpd(box=(3.5,)*d)
    state, w, e = neighbours(method)
    x, v, n = state[:d], state[d:2*d], state.shape[1]
    zeta = method.gamma/4      # times V
    seed = method.noise.seed
    Y = np.array([[uniform_of_pair(seed, 1, i, j) for j in range(n)] for i in range(n)])
    apart = (e*(v[:, :, None] - v[:, None, :])).sum(axis=0)
    noise = 2*np.sqrt(2*method.kT*zeta/STEP)*Y
    due = (w*e*(method.a - method.gamma*w*apart + noise)).sum(axis=2)
    return float(np.abs(forces(method, x, v) - due).max()/np.abs(due).max())


def partner() -> float:
    """|Q - 2 kT Gamma|/|Q|: Q of noise of the weight w, Gamma the friction that runs, column by column."""
    method = Dpd(box=(3.0, 3.0, 3.0))
    state, w, e = neighbours(method)
    x, Q = state[:3], 2*method.kT*method.gamma*blocks(w**2, e)
    rest = forces(method, x, 0*x)
    units = np.eye(x.size).reshape(-1, *x.shape)
    Gamma = np.array([(rest - forces(method, x, unit)).ravel() for unit in units]).T
    return float(np.abs(Q - 2*method.kT*Gamma).max()/np.abs(Q).max())


def unmodified() -> float:
    """The same with a friction of the weight of the noise, not its square, and as much energy in all."""
    _, w, e = neighbours(Dpd(box=(3.0, 3.0, 3.0)))
    Q, due = blocks(w**2, e), blocks(w, e)
    return float(np.abs(Q - due*np.trace(Q)/np.trace(due)).max()/np.abs(Q).max())


def blocks(weight: np.ndarray, e: np.ndarray) -> np.ndarray:
    """(d n, d n) of forces weight e e.(v_i - v_j) between the points of each pair."""
    d, n = e.shape[:2]
    pairs = weight*e[:, None]*e[None]                                   # (d, d, n, n)
    own = np.einsum("abij,ik->abik", pairs.sum(axis=3)[..., None]*np.eye(n), np.eye(n))
    return (own - pairs).transpose(0, 2, 1, 3).reshape(d*n, d*n)


def viscosities(rho: float = 3.0, gamma: float = 4.5, doubled: bool = True) -> float:
    """Bulk viscosity that Eq. 42 needs for the noise of these particles, over that of their friction, 3D.

    Noise, with W dV = c w V and the volume that Eq. 42 lacks: c^2 w^2 2 kT zeta V^3, four times that if
    doubled, is 2 gamma kT w^2; V = 1/rho. Friction, by the moments of Eq. 51: zeta = (5/3) eta, eta = 2 pi
    gamma rho^2/1575.
    """
    noise = gamma*rho**3/((4 if doubled else 1)*SCALE**2)
    return noise/(5/3*2*np.pi*gamma*rho**2/1575)


@dataclass(frozen=True, kw_only=True)
class SpecialCase(Case):
    """Dissipative particles beside Eqs 42, 49 and 51, each comparison a row of `formulas`."""

    @property
    def label(self) -> str:
        return "formulas of dissipative particles"

    def run(self, report: Report, folder: Path) -> Outcome:
        values = {"form": max(special(2), special(3)), "partner": partner(), "unmodified": unmodified(),
                  "viscosity doubled": viscosities(), "viscosity single": viscosities(doubled=False)}
        return listed({f"dissipative particles, {name}": value for name, value in values.items()})
