"""Are dissipative particles a special case of RR98, and does their noise have the viscosity of their friction? [RR98 Sec. III B]

Eq. 49 with Eq. 51, B = 0, and the zeta term of Eq. 42 beside it, its brackets doubled as in Eq. 35:

    force on i = sum_j w e_ij [P_ij - A e.(v_i - v_j) - 2 sqrt(2 kT zeta V/dt) Y_ij],    W dV = w

With w = 1 - r/rc, A = gamma w, 8 zeta V = 2 gamma these are Groot and Warren's; Y_ij and -Y_ij are alike. RR98's W, of which the
moment int W r dV is d, is c w, c = 15/pi in 3D.
"""
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from particles.dissipative.dpd import Dpd
from particles.noise import uniform_of_pair
from particles.run import Run
from particles.threads import Team
from studies.kit.case import Case, Outcome, Report

STEP = 0.02
#: 3D: int (1 - r) r dV = pi/5 over the unit ball is to be 3
SCALE = 15/np.pi


def neighbours(method: Dpd, rho: float = 3.0) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """A random state (3 d, n), the weights w (n, n) of its pairs by the nearest images, unit vectors e_ij (d, n, n)."""
    state, box = method.random_start(rho), np.array(method.box)[:, None, None]
    apart = state[:method.d, :, None] - state[:method.d, None, :]
    apart -= box*np.round(apart/box)
    r = np.sqrt((apart**2).sum(axis=0)) + 2*method.rc*np.eye(state.shape[1])
    return state, np.maximum(1 - r/method.rc, 0), apart/r


def forces(method: Dpd, x: np.ndarray, v: np.ndarray) -> np.ndarray:
    """Those that run, (d, n), with the noise of the first step."""
    n, found = x.shape[1], np.empty_like(x)
    sums = method.start(n, Team(1))
    sums.resume(Run(state=np.concatenate([x, v, 0*x]), ids=np.arange(n), step=0))
    sums.dt = STEP
    sums.forces(x, v, 0.0, found)
    return found


def special(d: int) -> float:
    """Largest difference between the forces that run and those of RR98's equations, over the largest."""
    method = Dpd(box=(3.5,)*d)
    state, w, e = neighbours(method)
    x, v, n, zeta = state[:d], state[d:2*d], state.shape[1], method.gamma/4      # zeta V
    Y = np.array([[uniform_of_pair(method.noise.seed, 1, i, j) for j in range(n)] for i in range(n)])
    apart = (e*(v[:, :, None] - v[:, None, :])).sum(axis=0)
    due = (w*e*(method.a - method.gamma*w*apart + 2*np.sqrt(2*method.kT*zeta/STEP)*Y)).sum(axis=2)
    return float(np.abs(forces(method, x, v) - due).max()/np.abs(due).max())


def partner() -> float:
    """|Q - 2 kT Gamma|/|Q|: Q of noise of the weight w, Gamma the friction that runs, column by column."""
    method = Dpd(box=(3.0, 3.0, 3.0))
    state, w, e = neighbours(method)
    x, Q = state[:3], 2*method.kT*method.gamma*blocks(w**2, e)
    rest = forces(method, x, 0*x)
    Gamma = np.array([(rest - forces(method, x, one.reshape(x.shape))).ravel() for one in np.eye(x.size)]).T
    return float(np.abs(Q - 2*method.kT*Gamma).max()/np.abs(Q).max())


def unmodified() -> float:
    """The same with a friction that has the weight of the noise, not its square, and takes as much energy in all."""
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
    """Bulk viscosity that Eq. 42 needs for the noise of dissipative particles, over that of their friction, in 3D.

    Noise, with W dV = c w V and the volume that Eq. 42 lacks: c^2 w^2 2 kT zeta V^3, four times that if doubled, is 2 gamma kT
    w^2; V = 1/rho. Friction, by the moments of Eq. 51: zeta = (5/3) eta, eta = 2 pi gamma rho^2/1575.
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
        values = {"form": max(special(d) for d in (2, 3)), "partner": partner(), "unmodified": unmodified(),
                  "viscosity doubled": viscosities(), "viscosity single": viscosities(doubled=False)}
        return Outcome({"formulas": [{"name": f"dissipative particles, {name}", "value": value}
                                     for name, value in values.items()]})
