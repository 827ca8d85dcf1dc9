"""Sod's shock tube by the grid, by points, and by smooth particles as printed; none has artificial viscosity.

Density 1 and pressure 1 against 0.125 and 0.1, gamma = 1.4 [Sod 1978]. At the time 0.4 L, with L half of the
tube, the shock is at 0.70 L from the diaphragm. The viscous gas is also solved on a fine grid:
one-dimensional Navier-Stokes-Fourier in flux form, between mirrors.

A periodic strip holds the tube and its mirror image: dense at |x| < L, thin at L < |x| < 2 L, without walls.
The grid has one tube between plates, which its waves do not reach. Points and cells have one spacing in both
gases and less mass in the thin one. Smooth particles have one mass, so that the thin gas has eight times
fewer, and one range, 3 mean spacings    [KHP95, Sec. II].

Viscosities eta = k, in units of spacing and density 1, were chosen beforehand, alike for all methods: zero;
the one with which the contact's velocity behind the shock has cell number v a/nu = 2, beyond which central
differences are expected to ring; and that of smooth particles, 0.5. nu/(c a) of the dense gas is 0, 0.11 and
0.42. Steps are half of the limit at the start, since v + c behind the shock is 1.85 times c of the dense gas.
Runs with a quarter of this step show whether a run ends by its step or by its scheme.
"""
from dataclasses import dataclass
from functools import cache
from math import ceil
from typing import Any

import numpy as np
import pandas as pd
from scipy.integrate import solve_ivp

from continuum.exact.riemann import GasState, middle, solution
from continuum.fluid import ConstEta, IdealGas
from continuum.gas.fields import block, placed, unblock
from particles.run import Divergence, Plan, run
from studies.build.grid import GridForm
from studies.build.scenes import Scene, Slab, Start
from studies.build.setting import Ready
from studies.hardcases.runs import Course, Hard, Row
from studies.kit.case import Outcome, Report

EOS, GAMMA = IdealGas(cv=2.5), 1.4
DENSE, THIN = GasState(1.0, 0.0, 1.0), GasState(0.125, 0.0, 0.1)
END = 0.4                       # time over L
FINE = 0.25                     # size of cells of the fine grid, in spacings
ACCURATE = 1e-6                 # relative tolerance of its time steps: a thousandth of the errors compared
NAMES = ("rho", "v", "P")
HEIGHT = 9.0
PARTS = 16              # parts into which a point is split when it is put into cells
BETWEEN = middle(DENSE, THIN, GAMMA)
CELL_NUMBER = 2.0
BARELY = round(BETWEEN.v*BETWEEN.right/CELL_NUMBER, 3)      # 0.123
ETAS = (0.0, BARELY, 0.5)
STEPS = (0.5, 0.125)                        # over the limit at the start
assert END*BETWEEN.v < 1        # the contact stays in its half of the tube


# --- references ---------------------------------------------------------------------------------------------


def exact(L: float, x: np.ndarray) -> np.ndarray:
    """Exact rho, v, P (3, n) of the frictionless gas at the end, 0 < x < 2 L."""
    return solution(DENSE, THIN, GAMMA, (x - L)/(END*L))


def start(dense: np.ndarray) -> np.ndarray:
    """rho, v, P (3, n) at the start. dense : whether a cell holds dense gas."""
    return np.where(dense, np.array(DENSE)[:, None], np.array(THIN)[:, None])


@cache
def viscous(L: int, eta: float) -> np.ndarray:
    """rho, v, P (3, 2 L) of a viscous gas in cells of one spacing, by the fine grid; nan at eta = 0."""
    if not eta:
        return np.full((3, 2*L), np.nan)
    cells = (np.arange(round(2*L/FINE)) + 0.5)*FINE
    fields = march(start(cells < L), eta, END*L)
    return np.array([np.interp(centres(L), cells, field) for field in fields])


def march(start: np.ndarray, eta: float, time: float) -> np.ndarray:
    """rho, v, P (3, n) in the cells of the fine grid after a time."""
    rho, v, P = start
    U = np.array([rho, rho*v, EOS.cv*P + rho*v**2/2])
    done = solve_ivp(lambda t, U: rates(U.reshape(3, -1), eta).ravel(), (0, time), U.ravel(),
                     rtol=ACCURATE, atol=ACCURATE, t_eval=[time])
    rho, v, e = primitive(done.y.reshape(3, -1))
    return np.array([rho, v, e*rho/EOS.cv])


def primitive(U: np.ndarray) -> np.ndarray:
    """rho, v, e from densities of mass, momentum and energy."""
    rho, p, energy = U
    v = p/rho
    return np.array([rho, v, energy/rho - v**2/2])


def rates(U: np.ndarray, eta: float) -> np.ndarray:
    """dU/dt from fluxes on faces, with mirror images behind both ends; friction is eta dv/dx as in 2D."""
    rho, v, e = np.pad(primitive(U), ((0, 0), (1, 1)), "edge")
    v[[0, -1]] *= -1
    T = e/EOS.cv
    friction, heat = eta*np.diff([v, T])/FINE
    rho, v, e, P = ((q[1:] + q[:-1])/2 for q in (rho, v, e, rho*T))
    momentum = rho*v**2 + P - friction
    energy = (rho*(e + v**2/2) + P - friction)*v - heat
    return -np.diff([rho*v, momentum, energy])/FINE


def wiggles(v: np.ndarray, truth: np.ndarray) -> float:
    """Total variation of a velocity over that of the exact one, less 1."""
    variation, expected = np.abs(np.diff([v, truth])).sum(axis=1)
    return float(variation/expected - 1)


# --- methods ------------------------------------------------------------------------------------------------

@dataclass(frozen=True, kw_only=True)
class Tubes(Scene):
    """The tube and its mirror image. half : half of the length of one."""
    half: int
    law: ConstEta
    eos: Any = EOS
    L: float = HEIGHT

    @property
    def width(self) -> float:  # type: ignore[override]
        return 4.0*self.half

    @property
    def time(self) -> float:
        return END*self.half

    def fields(self, x: np.ndarray) -> Start:
        rho, _, P = start(np.abs(x[:, 0]) < self.half)
        return rho, np.zeros((len(x), 2)), P/rho


def binned(scene: Tubes, method: Any, state: np.ndarray) -> np.ndarray:
    """rho, v, P (3, 2 L) in cells from points, weighted by volume; means over the height and both tubes.

    A point is spread over a width equal to its volume, with a height of one spacing: in thin gas points lie
    farther apart than cells.
    """
    at, cells = method.fields(state), 2*scene.half
    offsets = (np.arange(PARTS) + 0.5)/PARTS - 0.5
    x = (at.x[:, 0] + at.V*offsets[:, None]).ravel()
    cell = np.minimum(np.abs(x).astype(int), cells - 1)
    points = pd.DataFrame({"V": at.V, "m": at.rho*at.V, "v": at.v[:, 0], "T": at.T})
    parts = pd.concat([points]*PARTS, ignore_index=True)
    weighed = parts.assign(p=parts.m*parts.v*np.sign(x), heat=parts.m*parts["T"])
    sums = weighed.groupby(cell).sum().reindex(range(cells))
    return np.array([sums.m/sums.V, sums.p/sums.m, sums.heat/sums.V])


@dataclass(frozen=True, kw_only=True)
class Upright(Slab):
    """One tube without gravity, |y| < L/2, dense below; plates have the temperature of the gas at them."""
    eos: Any = EOS
    T_hot: float = DENSE.P/DENSE.rho
    T_cold: float = THIN.P/THIN.rho

    @property
    def g(self) -> float:
        return 0.0

    def begin(self, x: np.ndarray, y: np.ndarray) -> tuple[np.ndarray, ...]:
        """rho, v_x, v_y, T; a node on the diaphragm has the mean temperature."""
        T = np.select([y < 0, y > 0], [self.T_hot, self.T_cold], self.T_mean)
        return np.where(y < 0, DENSE.rho, THIN.rho), 0*T, 0*T, T


def cells(form: GridForm, scene: Tubes, seed: int) -> Ready:
    """Set up the compressible grid in one tube, with cells of one spacing and the longest stable step."""
    rows, eta = 2*scene.half, scene.law.eta
    one = Upright(L=float(rows), aspect=2/scene.half, viscosity=eta, heat=eta)
    made = form.ready(one, first=block(placed(one, rows, one.begin)))
    return made._replace(dt=made.limit)


def in_cells(scene: Tubes, method: Any, state: np.ndarray) -> np.ndarray:
    """rho, v, P (3, 2 L) of the grid, means over the width."""
    done = unblock(method.scene, method.block(state))
    v, T = ((q[1:] + q[:-1])[:, :-1].mean(axis=1)/2 for q in (done.at.vy, done.at.T))
    rho = done.cells.mean(axis=1)
    return np.array([rho, v, rho*T])


def centres(L: int) -> np.ndarray:
    """Centres (2 L,) of cells of one spacing."""
    return np.arange(2*L) + 0.5


def sods_row(scene: Tubes, course: Course) -> Row:
    """Columns of a tube: mean errors against the exact gas and the fine grid over ranges; ringing of v."""
    row = {"reached": course.reached}
    if course.reached < 1:
        return row
    last, truth = course.seen[-1], exact(scene.half, centres(scene.half))
    for kind, other in (("exact", truth), ("grid", viscous(scene.half, scene.law.eta))):
        errors = np.abs(last - other).mean(axis=1)/np.ptp(truth, axis=1)
        row |= {f"{name}_{kind}": error for name, error in zip(NAMES, errors)}
    return row | {"wiggles": wiggles(last[1], truth[1])}


class Tube(Hard):
    """A tube that is recorded at its end only."""

    def course(self, ready: Ready, report: Report) -> Course:
        method, start, dt = ready
        steps = ceil(self.time/dt - 1e-9)       # the step divides the time
        plan = Plan(dt=self.time/steps, steps=steps)
        try:
            done = run(method, start.reshape(len(start), -1), plan, report)
        except Divergence as error:
            return Course([], error.step/steps)
        return Course([self.question.look(self.scene, method, done.by_id())])


class Profiled(Tube):
    """A tube whose profile is stored in a table, too."""

    def found(self, course: Course) -> Outcome:
        L, (row,) = self.scene.half, super().found(course).rows.values()
        places = np.vstack([centres(L)/L - 1, course.seen[-1]]).T.tolist() if course.reached == 1 else []
        profile = [self.which | dict(zip(("x", *NAMES), place)) for place in places]
        return Outcome({"method_tubes": row, "method_tube_profiles": profile})
