"""Sod's shock tube with smooth particles as printed: how near to the exact solution, and does the gas stay in order?

Density 1 and pressure 1 against 0.125 and 0.1, gamma = 1.4 [Sod 1978]. Particles have one mass, so the thin gas has eight times
fewer of them, and one range, 3 mean spacings    [KHP95, Sec. II]. A periodic strip holds the tube and its mirror image: dense at
|x| < L, thin at L < |x| < 2 L, without walls. At the time 0.4 L the shock is at 1.70 L.
"""
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from continuum.exact.riemann import Gas, solution
from continuum.fluid import ConstEta, IdealGas
from particles.limits import step_limit
from particles.observe import fields_at
from particles.run import STUDIES, Divergence, Plan, run
from particles.threads import Team
from particles.weights import Lucy
from studies.build.periodic_box import at_rest, fluid
from studies.hardcases.tube.grid import march
from studies.kit.case import Case, Outcome, Report

EOS, GAMMA = IdealGas(cv=2.5), 1.4
DENSE, THIN = Gas(1.0, 0.0, 1.0), Gas(0.125, 0.0, 0.1)
HEIGHT, MASS = 9.0, 9/16        # mean density 9/16 is one particle a unit of area
ROWS = {DENSE: 12, THIN: 4}     # then columns are 0.75 and 2 apart, and fit if L is a multiple of 3
JITTER = 0.05                   # of the columns and rows: a perfect lattice keeps its rows in a flow along one axis
END = 0.4                       # time over L
SKIN = 1.5                      # of neighbour lists: at the diaphragm particles start from rest to their full speed in a step
FINE = 0.25                     # cells of the grid, spacings
NAMES = ("rho", "v", "P")


def tube(L: float, seed: int) -> tuple[np.ndarray, np.ndarray]:
    """State (5, n) at the start, and which particles are of the dense gas."""
    rng, parts, dense = np.random.default_rng(seed), [], []
    for gas, centre in ((DENSE, 0.0), (THIN, 2*L)):
        rows = ROWS[gas]
        columns = round(2*L*HEIGHT*gas.rho/MASS/rows)
        dx, dy = 2*L/columns, HEIGHT/rows
        x, y = np.meshgrid((np.arange(columns) + 0.5)*dx - L + centre, (np.arange(rows) + 0.5)*dy - HEIGHT/2)
        x, y = (q.ravel() + JITTER*d*rng.uniform(-1, 1, q.size) for q, d in ((x, dx), (y, dy)))
        parts.append(at_rest(np.stack([(x + 2*L) % (4*L) - 2*L, (y + HEIGHT/2) % HEIGHT - HEIGHT/2], axis=1),
                             EOS.cv*gas.P/gas.rho))
        dense.append(np.full(x.size, gas is DENSE))
    return np.concatenate(parts, axis=1), np.concatenate(dense)


def exact(L: float, x: np.ndarray) -> np.ndarray:
    """(3, n): rho, v, P of the frictionless gas at the end, 0 < x < 2 L."""
    return solution(DENSE, THIN, GAMMA, (x - L)/(END*L))


def grid(L: float, law: ConstEta, x: np.ndarray) -> np.ndarray:
    """The same of the viscous gas, on the fine grid."""
    cells = (np.arange(round(2*L/FINE)) + 0.5)*FINE
    rho = np.where(cells < L, DENSE.rho, THIN.rho)
    e = EOS.cv*np.where(cells < L, DENSE.P, THIN.P)/rho
    found = march(EOS, law, FINE, np.array([rho, 0*rho, e]), END*L)
    found[2] *= found[0]/EOS.cv
    return np.array([np.interp(x, cells, q) for q in found])


@dataclass(frozen=True, kw_only=True)
class ShockTube(Case):
    """One tube. L : half of its length, spacings, a multiple of 3. eta : viscosity and conductivity; 0 has no grid beside it.

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
            errors = [f"{name}_{of}" for of in ("exact", "grid") for name in NAMES]
            empty = dict.fromkeys(("wiggles", "overlap", "noise", *errors), np.nan)
            return Outcome({"tubes": [{**self.point, **empty, "diverged": error.step*dt/self.L}]})
        x = np.arange(0.5, 2*self.L)
        return self._rows(x, self._fields(method, end, x), end, dense)

    def _fields(self, method: Any, state: np.ndarray, x: np.ndarray) -> np.ndarray:
        """(3, n): smoothed rho, v, P, means over the height and over both halves."""
        sums, state = method.start(state.shape[1], Team(1)), state.copy()
        sums.around.relist(state, np.arange(state.shape[1]), 0.0)
        sums.look_at(state)
        y = np.arange(HEIGHT) + 0.5 - HEIGHT/2
        both = [fields_at(sums, state, *np.meshgrid(sign*x, y)) for sign in (1, -1)]
        return np.mean([[at.rho.mean(axis=0), sign*at.vx.mean(axis=0), (at.rho*at.e).mean(axis=0)/EOS.cv]
                        for sign, at in zip((1, -1), both)], axis=0)

    def _rows(self, x: np.ndarray, found: np.ndarray, end: np.ndarray, dense: np.ndarray) -> Outcome:
        truth = exact(self.L, x)
        twin = grid(self.L, ConstEta(self.eta, self.eta), x) if self.eta else np.full_like(truth, np.nan)
        size = np.ptp(truth, axis=1)
        errors = {f"{name}_{of}": float(np.abs(found[i] - other[i]).mean()/size[i])
                  for of, other in (("exact", truth), ("grid", twin)) for i, name in enumerate(NAMES)}
        variation = float(np.abs(np.diff(found[1])).sum()/np.abs(np.diff(truth[1])).sum() - 1)
        row = {**self.point, **errors, "wiggles": variation, "overlap": overlap(end[0], dense),
               "noise": float(np.sqrt(np.mean(end[3]**2))/truth[1].max()), "diverged": np.nan}
        profiles = [{**self.point, "x": float(at)/self.L - 1, **{name: float(found[i, n]) for i, name in enumerate(NAMES)},
                     **{f"{name}_exact": float(truth[i, n]) for i, name in enumerate(NAMES)},
                     **{f"{name}_grid": float(twin[i, n]) for i, name in enumerate(NAMES)}} for n, at in enumerate(x)]
        return Outcome({"tubes": [row], "tube_profiles": profiles if self.keep else []})


def overlap(x: np.ndarray, dense: np.ndarray) -> float:
    """How far dense and thin gas reach into each other, spacings: 0 or less if in order. Both ends of the dense gas count."""
    inside, outside = np.abs(x)[dense], np.abs(x)[~dense]
    return float(np.sort(inside)[-4:].mean() - np.sort(outside)[:4].mean())
