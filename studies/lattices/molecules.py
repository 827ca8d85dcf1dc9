"""Particles that are molecules: do their paths run back?    [KHP95, Sec. III]

Inviscid particles with P/rho^2 = 1 obey dv/dt = -sum_j m 2 grad w: Newton's equations with the potential 2
m^2 w of a pair. `Reversal` turns the velocities: the path comes back, to what truncation or round-off makes
of it, and bit by bit if places and velocities are whole numbers.
"""
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np

from continuum.fluid import VanDerWaals
from particles.integrators import RK4
from particles.limits import step_limit
from particles.run import STUDIES, Plan, run
from particles.smooth.spam import Spam
from particles.threads import Threads
from particles.walls.periodic import wrap
from studies.build.names import START_JITTER
from studies.build.spam import FRICTIONLESS, at_rest, fluid
from studies.kit.case import Case, Outcome, Report

RANGE = 3.0
#: of whole numbers, spacings: sums in another order differ by 1e-16, but all except 1e-8 are rounded alike
GRID = 2.0**-24


def crowd(side: int, seed: int, e: float, speed: float) -> np.ndarray:
    """State (5, side^2): a shifted lattice with random velocities, of so large an rms."""
    rng = np.random.default_rng(seed)
    centres = np.arange(side) + 0.5 - side/2
    x = np.stack(np.meshgrid(centres, centres), axis=-1).reshape(-1, 2)
    state = at_rest(x + rng.uniform(-START_JITTER, START_JITTER, x.shape), e)
    state[2:4] = speed*rng.standard_normal((2, len(x)))
    return state


def whole(q: np.ndarray) -> np.ndarray:
    """The nearest multiples of GRID."""
    return np.rint(q/GRID)*GRID


class Leapfrog:
    """Half a kick, a drift, half a kick [Verlet 1967]: reversible but for round-off; `rounded` is added."""
    evaluations = 2
    rounded: Any = staticmethod(np.asarray)

    def __init__(self, shape: tuple[int, ...], threads: Threads):
        self._k = np.empty(shape)

    def step(self, sums: Any, y: np.ndarray, dt: float) -> None:
        """Advance y = (x, y, vx, vy, e) in place by dt; energies, of which nothing depends, stay."""
        for drift in (dt, 0.0):
            sums.rates(y, self._k)
            y[2:4] += self.rounded(self._k[2:4]*dt/2)
            y[:2] += self.rounded(y[2:4]*drift)


class Whole(Leapfrog):
    """The same in whole numbers, reversible bit by bit    [Levesque & Verlet 1993]"""

    rounded = staticmethod(whole)

#: P = rho^2: van der Waals without excluded volume, of a heat capacity so large that energy adds nothing to
#: the pressure
RHO_SQUARED = VanDerWaals(a=-1.0, b=0.0, cv=1e300)
ENERGY = 1e3        # per mass: any that stays above rho is valid
SPEED = 0.4         # rms of each velocity: m v^2 = 0.32 is about 2 w(0) = 0.35: particles pass each other
METHODS = {"rk4": RK4, "leapfrog": Leapfrog, "whole numbers": Whole}


def whole_crowd(side: int, seed: int) -> np.ndarray:
    """A crowd in whole numbers, without momentum."""
    state = crowd(side, seed, ENERGY, SPEED)
    state[2:4] -= state[2:4].mean(axis=1, keepdims=True)
    state[:4] = whole(state[:4])
    return state


def distance(one: np.ndarray, other: np.ndarray, side: float) -> float:
    """Rms distance of the places of two states in a periodic square."""
    apart = one[:2] - other[:2]
    apart -= side*np.round(apart/side)
    return float(np.sqrt(np.mean(apart**2)*2))


def as_fluid(integrator: type, weight: Any, side: float) -> Spam:
    """The fluid that is one of molecules, in a periodic square."""
    return replace(fluid(weight, (side, side), RHO_SQUARED, FRICTIONLESS), integrator=integrator)


@dataclass(frozen=True, kw_only=True)
class Reversal(Case):
    """Forward for some time, velocities turned, and back: how far from the start. name : of integrator."""
    name: str
    integrator: type
    weight: Any
    times: tuple[float, ...]
    side: int = 16
    seed: int = 1

    @property
    def cost(self) -> float:
        return 0.02*sum(self.times)

    def run(self, report: Report, folder: Path) -> Outcome:
        method = as_fluid(self.integrator, self.weight.of(h=RANGE), float(self.side))
        return Outcome({"reversal": [self.row(method, time) for time in self.times]})

    def row(self, method: Spam, time: float) -> dict[str, Any]:
        """There and back."""
        start, dt = whole_crowd(self.side, self.seed), STUDIES*step_limit(method, ENERGY)
        plan = Plan(dt=dt, steps=round(time/dt))
        there = turned(run(method, start, plan).by_id())
        back = turned(run(method, there, plan).by_id())
        for state in (start, back):     # what has left since the last lists is the same place
            wrap(method.walls, state)
        return {"integrator": self.name, "weight": self.weight.__name__, "seed": self.seed,
                "time": plan.steps*dt, "apart": distance(back, start, self.side),
                "equal": float(np.mean(back[:4] == start[:4]))}


def turned(state: np.ndarray) -> np.ndarray:
    """The same places, velocities the other way."""
    back = state.copy()
    back[2:4] *= -1
    return back
