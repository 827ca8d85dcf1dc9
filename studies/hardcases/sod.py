"""Sod's shock tube with smooth particles as printed: how near are they to the exact solution?

Density 1 and pressure 1 against 0.125 and 0.1, gamma = 1.4 [Sod 1978]. Particles have one mass, so the thin
gas has eight times fewer of them, and one range, 3 mean spacings    [KHP95, Sec. II]. A periodic strip holds
the tube and its mirror image: dense at |x| < L, thin at L < |x| < 2 L, without walls. At the time 0.4 L the
shock is at 1.70 L.

A viscous gas is followed on a fine grid: one-dimensional Navier-Stokes-Fourier in flux form, between mirrors.
"""
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from scipy.integrate import solve_ivp

from continuum.exact.riemann import GasState, solution
from continuum.fluid import ConstEta, IdealGas, pressure, stress, temperature
from particles.limits import step_limit
from particles.observe import fields_at
from particles.run import STUDIES, Divergence, Plan, run
from particles.threads import Team
from particles.weights import Lucy
from studies.build.periodic_box import at_rest, fluid
from studies.kit.case import Case, Outcome, Report

EOS, GAMMA = IdealGas(cv=2.5), 1.4
DENSE, THIN = GasState(1.0, 0.0, 1.0), GasState(0.125, 0.0, 0.1)
HEIGHT, MASS = 9.0, 9/16        # mean density 9/16 is one particle a unit of area
ROWS = {DENSE: 12, THIN: 4}     # then columns are 0.75 and 2 apart, and fit if L is a multiple of 3
JITTER = 0.05                   # of the columns and rows: a perfect lattice keeps its rows in a flow along one axis
END = 0.4                       # time over L
SKIN = 1.5                      # of neighbour lists: at the diaphragm particles start from rest to their full speed in a step
FINE = 0.25                     # cells of the grid, spacings
ACCURATE = 1e-6                 # relative, of the grid's steps in time: a thousandth of the errors that are compared
NAMES = ("rho", "v", "P")
ERRORS = tuple(f"{name}_{of}" for of in ("exact", "grid") for name in NAMES)


# --- what to expect -------------------------------------------------------------------------------


def exact(L: float, x: np.ndarray) -> np.ndarray:
    """(3, n): rho, v, P of the frictionless gas at the end, 0 < x < 2 L."""
    return solution(DENSE, THIN, GAMMA, (x - L)/(END*L))


def grid(L: float, law: ConstEta, x: np.ndarray) -> np.ndarray:
    """The same of the viscous gas, on the fine grid."""
    cells = (np.arange(round(2*L/FINE)) + 0.5)*FINE
    rho = np.where(cells < L, DENSE.rho, THIN.rho)
    e = EOS.cv*np.where(cells < L, DENSE.P, THIN.P)/rho
    rho, v, e = march(EOS, law, FINE, np.array([rho, 0*rho, e]), END*L)
    return np.array([np.interp(x, cells, q) for q in (rho, v, e*rho/EOS.cv)])


def march(eos: Any, law: ConstEta, dx: float, start: np.ndarray, time: float) -> np.ndarray:
    """rho, v, e (3, n) of cells after a time, from those at the start."""
    rho, v, e = start
    U = np.array([rho, rho*v, rho*(e + v**2/2)])
    done = solve_ivp(lambda t, U: rates(eos, law, dx, U.reshape(3, -1)).ravel(), (0, time), U.ravel(), method="RK45",
                     rtol=ACCURATE, atol=ACCURATE, t_eval=[time])
    return primitive(done.y[:, -1].reshape(3, -1))


def primitive(U: np.ndarray) -> np.ndarray:
    """rho, v, e from densities of mass, momentum and energy."""
    return np.array([U[0], U[1]/U[0], U[2]/U[0] - (U[1]/U[0])**2/2])


def rates(eos: Any, law: ConstEta, dx: float, U: np.ndarray) -> np.ndarray:
    """dU/dt from fluxes on faces; behind both ends is a mirror image."""
    rho, v, e = np.pad(primitive(U), ((0, 0), (1, 1)), "edge")
    v[0], v[-1] = -v[1], -v[-2]
    T, P = temperature(eos, rho, e), pressure(eos, rho, e)
    rho, u, e, P = ((q[1:] + q[:-1])/2 for q in (rho, v, e, P))
    friction = stress(law.eta, 0.0, np.diff(v)/dx, 0.0, 0.0, 0.0)[0]
    heat = law.k*np.diff(T)/dx
    flux = np.array([rho*u, rho*u*u + P - friction, (rho*(e + u*u/2) + P - friction)*u - heat])
    return -np.diff(flux, axis=1)/dx


def errors(fields: np.ndarray, truth: np.ndarray, twin: np.ndarray) -> dict[str, float]:
    """ERRORS: mean |difference| of fields (3, n) from both others, over the range of the exact ones."""
    size = np.ptp(truth, axis=1)
    values = [np.abs(fields - other).mean(axis=1)/size for other in (truth, twin)]
    return dict(zip(ERRORS, np.concatenate(values).tolist(), strict=True))


def wiggles(v: np.ndarray, truth: np.ndarray) -> float:
    """Variation of a velocity beyond that of the exact one, over it."""
    return float(np.abs(np.diff(v)).sum()/np.abs(np.diff(truth)).sum() - 1)


# --- smooth particles -----------------------------------------------------------------------------


def tube(L: float, seed: int) -> tuple[np.ndarray, np.ndarray]:
    """State (5, n) at the start, and which particles are of the dense gas."""
    rng, parts, dense = np.random.default_rng(seed), [], []
    for gas, centre in ((DENSE, 0.0), (THIN, 2*L)):
        rows = ROWS[gas]
        columns = round(2*L*HEIGHT*gas.rho/MASS/rows)
        dx, dy = 2*L/columns, HEIGHT/rows
        x, y = np.meshgrid((np.arange(columns) + 0.5)*dx - L + centre, (np.arange(rows) + 0.5)*dy - HEIGHT/2)
        x, y = (q.ravel() + JITTER*d*rng.uniform(-1, 1, q.size) for q, d in ((x, dx), (y, dy)))
        at = np.stack([(x + 2*L) % (4*L) - 2*L, (y + HEIGHT/2) % HEIGHT - HEIGHT/2], axis=1)
        parts.append(at_rest(at, EOS.cv*gas.P/gas.rho))
        dense.append(np.full(x.size, gas is DENSE))
    return np.concatenate(parts, axis=1), np.concatenate(dense)


@dataclass(frozen=True, kw_only=True)
class ShockTube(Case):
    """One tube. L : half of its length, spacings, a multiple of 3. eta : viscosity and conductivity; 0 has no
    grid beside it.

    keep : whether profiles go to the table.
    """
    L: float
    eta: float
    seed: int = 1
    keep: bool = False

    @property
    def cost(self) -> float:
        return 1e-4*self.L**2 + 1

    @property
    def point(self) -> dict[str, Any]:
        """Key columns."""
        return {"L": self.L, "eta": self.eta, "seed": self.seed}

    def run(self, report: Report, folder: Path) -> Outcome:
        law, (start, dense) = ConstEta(self.eta, self.eta), tube(self.L, self.seed)
        method = fluid(Lucy.of(h=3.0), (4*self.L, HEIGHT), EOS, law, m=MASS, skin=SKIN)
        dt = STUDIES*step_limit(method, start[4])
        steps = round(END*self.L/dt) + 1
        try:
            end = run(method, start, Plan(dt=END*self.L/steps, steps=steps), report).by_id()
        except Divergence as error:
            empty = dict.fromkeys(("wiggles", "overlap", "noise", *ERRORS), np.nan)
            return Outcome({"tubes": [{**self.point, **empty, "diverged": error.step*dt/self.L}]})
        x = np.arange(0.5, 2*self.L)
        fields, truth = smoothed(method, end, x), exact(self.L, x)
        twin = grid(self.L, law, x) if self.eta else np.full_like(truth, np.nan)
        row = {**self.point, **errors(fields, truth, twin), "wiggles": wiggles(fields[1], truth[1]),
               "overlap": overlap(end[0], dense), "noise": float(np.sqrt(np.mean(end[3]**2))/truth[1].max()), "diverged": np.nan}
        return Outcome({"tubes": [row], "tube_profiles": self._profiles(x, fields, truth, twin) if self.keep else []})

    def _profiles(self, x: np.ndarray, *fields: np.ndarray) -> list[dict[str, Any]]:
        """Rows of the particles', the exact and the grid's fields, each (3, n)."""
        names = [f"{name}{of}" for of in ("", "_exact", "_grid") for name in NAMES]
        values = np.concatenate(fields).T.tolist()
        return [{**self.point, "x": float(at)/self.L - 1, **dict(zip(names, row, strict=True))}
                for at, row in zip(x, values, strict=True)]


def smoothed(method: Any, state: np.ndarray, x: np.ndarray) -> np.ndarray:
    """(3, n): smoothed rho, v, P of a tube and its image, means over the height and over both."""
    sums, state = method.start(state.shape[1], Team(1)), state.copy()
    sums.around.relist(state, np.arange(state.shape[1]), 0.0)
    sums.look_at(state)
    y = np.arange(HEIGHT) + 0.5 - HEIGHT/2
    both = [fields_at(sums, state, *np.meshgrid(sign*x, y)) for sign in (1, -1)]
    return np.mean([[at.rho.mean(axis=0), sign*at.vx.mean(axis=0), (at.rho*at.e).mean(axis=0)/EOS.cv]
                    for sign, at in zip((1, -1), both)], axis=0)


def overlap(x: np.ndarray, dense: np.ndarray) -> float:
    """How far dense and thin gas reach into each other, spacings: 0 or less if in order.

    Both ends of the dense gas count.
    """
    inside, outside = np.sort(np.abs(x)[dense]), np.sort(np.abs(x)[~dense])
    return float(inside[-4:].mean() - outside[:4].mean())
