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

from continuum.exact.riemann import Gas, solution
from continuum.fluid import ConstEta, IdealGas
from particles.limits import step_limit
from particles.observe import fields_at
from particles.run import STUDIES, Divergence, Plan, run
from particles.smooth.spam import Spam
from particles.weights import Lucy
from studies.build.periodic_box import at_rest, fluid
from studies.kit.case import Case, Outcome, Report

EOS, GAMMA = IdealGas(cv=2.5), 1.4
DENSE, THIN = Gas(1.0, 0.0, 1.0), Gas(0.125, 0.0, 0.1)
HEIGHT, MASS = 9.0, 9/16        # mean density 9/16 is one particle a unit of area
ROWS = {DENSE: 12, THIN: 4}     # then columns are 0.75 and 2 apart, and fit if L is a multiple of 3
JITTER = 0.05                   # of the columns and rows: a perfect lattice keeps its rows in a flow along one axis
END = 0.4                       # time over L
SKIN = 1.5                      # of neighbour lists: at the diaphragm particles reach full speed in a step
FINE = 0.25                     # cells of the grid, spacings
ACCURATE = 1e-6                 # relative, of the grid's steps in time: a thousandth of the errors compared
NAMES = ("rho", "v", "P")
ERRORS = tuple(f"{name}_{of}" for of in ("exact", "grid") for name in NAMES)


def exact(L: float, x: np.ndarray) -> np.ndarray:
    """(3, n): rho, v, P of the frictionless gas at the end, 0 < x < 2 L."""
    return solution(DENSE, THIN, GAMMA, (x - L)/(END*L))


def viscous(L: float, eta: float, x: np.ndarray) -> np.ndarray:
    """The same of a gas with viscosity and conductivity eta on the fine grid; not numbers if it has none."""
    if not eta:
        return np.full((3, len(x)), np.nan)
    cells = (np.arange(round(2*L/FINE)) + 0.5)*FINE
    rho, v, P = march(start(cells < L), eta, END*L)
    return np.array([np.interp(x, cells, field) for field in (rho, v, P)])


def start(dense: np.ndarray) -> np.ndarray:
    """rho, v, P (3, n), dense gas in some cells."""
    return np.where(dense, np.array(DENSE)[:, None], np.array(THIN)[:, None])


def march(start: np.ndarray, eta: float, time: float) -> np.ndarray:
    """rho, v, P (3, n) of fine cells after a time."""
    rho, v, P = start
    U = np.array([rho, rho*v, EOS.cv*P + rho*v**2/2])

    def slopes(t: float, U: np.ndarray) -> np.ndarray:
        return rates(U.reshape(3, -1), eta).ravel()
    done = solve_ivp(slopes, (0, time), U.ravel(), rtol=ACCURATE, atol=ACCURATE, t_eval=[time])
    rho, v, e = primitive(done.y.reshape(3, -1))
    return np.array([rho, v, e*rho/EOS.cv])


def primitive(U: np.ndarray) -> np.ndarray:
    """rho, v, e from densities of mass, momentum and energy."""
    rho, p, energy = U
    return np.array([rho, p/rho, energy/rho - (p/rho)**2/2])


def rates(U: np.ndarray, eta: float) -> np.ndarray:
    """dU/dt from fluxes on faces; behind both ends is a mirror image. In 2D friction is eta dv/dx."""
    rho, v, e = np.pad(primitive(U), ((0, 0), (1, 1)), "edge")
    v[[0, -1]] *= -1
    T = e/EOS.cv
    friction, heat = eta*np.diff(v)/FINE, eta*np.diff(T)/FINE
    rho, v, e, P = ((q[1:] + q[:-1])/2 for q in (rho, v, e, rho*T))
    flux = np.array([rho*v, rho*v**2 + P - friction, (rho*(e + v**2/2) + P - friction)*v - heat])
    return -np.diff(flux, axis=1)/FINE


def compared(fields: np.ndarray, truth: np.ndarray, twin: np.ndarray) -> dict[str, float]:
    """ERRORS, mean |difference| of fields (3, n) from both others over the range of the exact ones; wiggles."""
    size = np.ptp(truth, axis=1)
    values = [np.abs(fields - other).mean(axis=1)/size for other in (truth, twin)]
    errors = dict(zip(ERRORS, np.concatenate(values).tolist(), strict=True))
    return {**errors, "wiggles": wiggles(fields[1], truth[1])}


def wiggles(v: np.ndarray, truth: np.ndarray) -> float:
    """Variation of a velocity beyond that of the exact one, over it."""
    return float(np.abs(np.diff(v)).sum()/np.abs(np.diff(truth)).sum() - 1)


def profiles(point: dict[str, Any], x: np.ndarray, fields: np.ndarray) -> list[dict[str, Any]]:
    """A row a place x (n,), over L from the diaphragm, of rho, v, P (3, n)."""
    return [{**point, "x": at, "rho": rho, "v": v, "P": P} for at, rho, v, P in np.vstack([x, fields]).T.tolist()]


def jittered(counts: tuple[int, int], cell: tuple[float, float], corner: tuple[float, float], jitter: float,
             rng: np.random.Generator) -> np.ndarray:
    """x, y (2, n) in the middle of columns and rows of cells, shifted by up to `jitter` of a cell."""
    numbers = np.stack(np.meshgrid(*map(np.arange, counts)), axis=-1).reshape(-1, 2)
    shift = rng.uniform(-1, 1, (2, len(numbers))).T
    return ((numbers + 0.5)*cell + corner + jitter*np.array(cell)*shift).T


def within(x: np.ndarray, size: float) -> np.ndarray:
    """Places in a periodic interval about 0."""
    return (x + size/2) % size - size/2


def tube(L: float, seed: int) -> np.ndarray:
    """State (5, n) at the start."""
    rng, gases = np.random.default_rng(seed), []
    for gas, left in ((DENSE, -L), (THIN, L)):
        counts = round(2*L*HEIGHT*gas.rho/MASS/ROWS[gas]), ROWS[gas]
        cell = 2*L/counts[0], HEIGHT/counts[1]
        x, y = jittered(counts, cell, (left, -HEIGHT/2), JITTER, rng)
        at = np.stack([within(x, 4*L), within(y, HEIGHT)], axis=1)
        gases.append(at_rest(at, EOS.cv*gas.P/gas.rho))
    return np.concatenate(gases, axis=1)


@dataclass(frozen=True, kw_only=True)
class ShockTube(Case):
    """One tube. L : half of its length, spacings, a multiple of 3. eta : viscosity and conductivity.

    keep : whether profiles go to the table.
    """
    L: float
    eta: float
    seed: int = 1
    keep: bool = False

    @property
    def cost(self) -> float:
        return 1e-4*self.L**2 + 1

    def run(self, report: Report, folder: Path) -> Outcome:
        point = {"L": self.L, "eta": self.eta, "seed": self.seed}
        law, start = ConstEta(self.eta, self.eta), tube(self.L, self.seed)
        method = fluid(Lucy.of(h=3.0), (4*self.L, HEIGHT), EOS, law, m=MASS, skin=SKIN)
        dt = STUDIES*step_limit(method, start[4])
        steps = round(END*self.L/dt) + 1
        try:
            end = run(method, start, Plan(dt=END*self.L/steps, steps=steps), report).by_id()
        except Divergence as error:
            return Outcome({"tubes": [{**point, "diverged": error.step*dt/self.L}]})
        x = np.arange(0.5, 2*self.L)
        fields, truth, twin = smoothed(method, end, x), exact(self.L, x), viscous(self.L, self.eta, x)
        row = {**point, **compared(fields, truth, twin), "diverged": np.nan}
        lines = profiles(point, x/self.L - 1, fields) if self.keep else []
        return Outcome({"tubes": [row], "tube_profiles": lines})


def smoothed(method: Spam, state: np.ndarray, x: np.ndarray) -> np.ndarray:
    """(3, n): smoothed rho, v, P of a tube and its image, means over the height and over both."""
    sums, state, _ = method.look(state)
    y = np.arange(HEIGHT) + 0.5 - HEIGHT/2
    tubes = []
    for sign in (1, -1):
        at = fields_at(sums, state, *np.meshgrid(sign*x, y))
        tubes.append([at.rho.mean(axis=0), sign*at.vx.mean(axis=0), (at.rho*at.e).mean(axis=0)/EOS.cv])
    return np.mean(tubes, axis=0)
