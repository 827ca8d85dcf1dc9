"""P = rho^2: smooth particles are molecules, and their paths run back    [KHP95, Sec. III]

Inviscid particles with P/rho^2 = 1 obey dv/dt = -sum_j m 2 grad w: Newton's equations with the potential 2 m^2 w of a pair.
Sums of both in the same integrator must keep to the same path until round-off has grown; a path that is turned must come back, to
what the integrator's truncation or round-off makes of it, and bit by bit if places and velocities are whole numbers.
"""
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np

from continuum.fluid import VanDerWaals
from particles.integrators import RK4, Leapfrog, Whole, whole
from particles.limits import step_limit
from particles.run import STUDIES, Plan, run
from particles.smooth.spam import Spam
from particles.threads import Team
from particles.walls.periodic import wrap
from particles.weights import value_and_slope
from studies.build.names import START_JITTER
from studies.build.periodic_box import FRICTIONLESS, at_rest, fluid
from studies.kit.case import Case, Outcome, Report

#: P = rho^2: van der Waals without excluded volume, of a heat capacity so large that energy adds nothing to the pressure
RHO_SQUARED = VanDerWaals(a=-1.0, b=0.0, cv=1e300)
ENERGY = 1e3        # per mass: any that stays above rho is valid
SPEED = 0.4         # rms of each velocity: m v^2 = 0.32 is about phi(0) = 2 w(0) = 0.35, so that particles pass each other


def crowd(side: int, seed: int) -> np.ndarray:
    """State (5, side^2) of a shifted lattice with random velocities, momentum zero, all of it on the grid of whole numbers."""
    rng = np.random.default_rng(seed)
    x = np.stack(np.meshgrid(*2*[np.arange(side) + 0.5 - side/2]), axis=-1).reshape(-1, 2)
    state = at_rest(x + rng.uniform(-START_JITTER, START_JITTER, x.shape), ENERGY)
    v = SPEED*rng.standard_normal((2, len(x)))
    state[2:4] = v - v.mean(axis=1, keepdims=True)
    state[:4] = whole(state[:4])
    return state


def apart(one: np.ndarray, other: np.ndarray, side: float) -> np.ndarray:
    """(2, n): distances of places in a periodic square."""
    d = one[:2] - other[:2]
    return d - side*np.round(d/side)


INTEGRATORS = {"rk4": RK4, "leapfrog": Leapfrog, "whole numbers": Whole}


def molecules(integrator: type, weight: Any, side: float) -> Spam:
    """The fluid that is one of molecules, in a periodic square."""
    same = fluid(weight, (side, side), RHO_SQUARED, FRICTIONLESS)
    return replace(same, integrator=integrator)


class Newton:
    """dv/dt = -sum_j 2 grad w of molecules in a periodic square, by sums over all pairs."""

    def __init__(self, weight: Any, side: float):
        self.weight, self.side = weight, side

    def rates(self, state: np.ndarray, out: np.ndarray) -> None:
        """d(x, y, vx, vy, e)/dt."""
        d = state[:2, :, None] - state[:2, None, :]
        d -= self.side*np.round(d/self.side)
        r = np.hypot(*d)
        near = (r < self.weight.h) & (r > 0)
        slope = np.zeros_like(r)
        slope[near] = [value_and_slope(self.weight, one)[1] for one in r[near]]
        out[:2], out[2:4], out[4] = state[2:4], -2*np.sum(slope*d, axis=2), 0.0


@dataclass(frozen=True, kw_only=True)
class Twins(Case):
    """The same path by the compiled sums of smooth particles and as molecules: how far apart after some time."""
    weight: Any
    side: int = 8
    every: float = 2.0
    samples: int = 15
    seed: int = 1

    @property
    def cost(self) -> float:
        return 30.0

    def run(self, report: Report, folder: Path) -> Outcome:
        weight, start = self.weight.of(h=3.0), crowd(self.side, self.seed)
        method = molecules(RK4, weight, float(self.side))
        steps = round(self.every/(STUDIES*step_limit(method, ENERGY)))
        dt, one, other, rows = self.every/steps, start, start.copy(), []
        newton, integrator = Newton(weight, float(self.side)), RK4(start.shape, Team(1))
        for number in range(1, self.samples + 1):
            report(number/self.samples)
            one = run(method, one, Plan(dt=dt, steps=steps)).by_id()
            for _ in range(steps):
                integrator.step(newton, other, dt)
            wrap(method.walls, other)
            rows.append({"weight": self.weight.__name__, "seed": self.seed, "time": number*self.every,
                         "apart": float(np.sqrt(np.mean(apart(one, other, self.side)**2)*2))})
        return Outcome({"twins": rows})


@dataclass(frozen=True, kw_only=True)
class Reversal(Case):
    """Forward for some time, velocities turned, and back: how far from the start."""
    integrator: str
    weight: Any
    times: tuple[float, ...]
    side: int = 16
    seed: int = 1

    @property
    def cost(self) -> float:
        return 0.02*sum(self.times)

    def run(self, report: Report, folder: Path) -> Outcome:
        start = crowd(self.side, self.seed)
        method = molecules(INTEGRATORS[self.integrator], self.weight.of(h=3.0), float(self.side))
        dt = STUDIES*step_limit(method, ENERGY)
        return Outcome({"reversal": [self._row(method, start, dt, time) for time in self.times]})

    def _row(self, method: Spam, start: np.ndarray, dt: float, time: float) -> dict[str, Any]:
        plan = Plan(dt=dt, steps=round(time/dt))
        there = run(method, start, plan).by_id()
        there[2:4] *= -1
        back = run(method, there, plan).by_id()
        back[2:4] *= -1
        wrapped = start.copy()
        for state in (wrapped, back):       # what has left since the last lists is the same place
            wrap(method.walls, state)
        return {"integrator": self.integrator, "weight": self.weight.__name__, "seed": self.seed, "time": plan.steps*dt,
                "apart": float(np.sqrt(np.mean(apart(back, start, self.side)**2)*2)),
                "equal": float(np.mean(back[:4] == wrapped[:4]))}
