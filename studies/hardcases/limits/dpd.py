"""The longest step of dissipative particles: their own formula, springs and friction of settled particles, and trial

At kT = 0 particles come to rest where forces balance. About such a place one step is a linear map; motions grow where an
eigenvalue of it is larger than 1. The formula has a uniform fluid in place of settled particles    [Groot & Warren 1997]
"""
from dataclasses import dataclass
from functools import cache
from math import inf
from pathlib import Path
from typing import Any

import numpy as np

from particles.dissipative.dpd import Dpd
from particles.dissipative.integrators import GrootWarren, GrootWarren65, Shardlow, VelocityVerlet
from particles.integral.covariance import jacobian
from particles.integrators import TwoStep
from particles.run import Divergence, Plan, Run, run
from particles.threads import Team
from studies.build.unguarded import GROWN, NOISE, Noise, bisected
from studies.kit.case import Case, Outcome, Report

RHO = 3.0
BOXES: dict[int, tuple[float, ...]] = {2: (6.0, 6.0), 3: (3.0, 3.0, 3.0)}
SETTLING, SHORT = 400.0, 0.02       # time, with GrootWarren: what moves then is below 1e-4 of the noise
STEPS = 8000            # beyond the limit a factor of 10 shows from growth by 3e-4 a step on
UNSEEN = 0.0025          # of a limit: how far beyond it growth may not show
GROWS = 1e-3            # in a step: two eigenvalues meet at -1, and the map is known to 1e-8, its double eigenvalues to 1e-4
INTEGRATORS = {"1/2": GrootWarren, "0.65": GrootWarren65, "Verlet": VelocityVerlet, "Shardlow": Shardlow, "Eqs 40, 41": TwoStep}


class Unguarded(Dpd):
    """Takes any step."""

    def longest_step(self, n: int) -> float:
        """None is too long."""
        return inf


@cache
def settled(d: int) -> np.ndarray:
    """State (3 d, n) of particles that have come to rest."""
    method = Dpd(box=BOXES[d], kT=0.0, integrator=GrootWarren)
    state = run(method, method.random_start(RHO), Plan(dt=SHORT, steps=round(SETTLING/SHORT))).by_id()
    state[d:] = 0
    return state


def one_step(method: Dpd, start: np.ndarray, dt: float) -> Any:
    """(y, out): where one step leads."""
    sums, integrator = method.start(start.shape[1], Team(1)), method.integrator(start.shape, Team(1))
    sums.make_ready(Run(state=start.copy(), ids=np.arange(start.shape[1])), dt)

    def step(y: np.ndarray, out: np.ndarray) -> None:
        out[:] = y
        integrator.step(sums, out, dt)
    return step


def map_grows(method: Dpd, start: np.ndarray, dt: float) -> bool:
    """Whether a small motion grows in a step."""
    return bool(np.abs(np.linalg.eigvals(jacobian(one_step(method, start, dt), start))).max() > 1 + GROWS)


def trial_grows(method: Dpd, start: np.ndarray, dt: float) -> bool:
    """Whether noise of velocities has grown at the end. Particles that move far move on: it need not go on growing."""
    d, noisy = method.d, start.copy()
    noisy[d:2*d] = NOISE*np.random.default_rng(1).standard_normal((d, start.shape[1]))
    quantities: dict[str, Any] = {"noise": Noise(tuple(range(d, 2*d)))}
    try:
        last = run(method, noisy, Plan(dt=dt, steps=STEPS, series=quantities, every=STEPS)).series["noise"][-1]
    except Divergence:
        return True
    return not last < GROWN*NOISE


@dataclass(frozen=True, kw_only=True)
class DpdLimit(Case):
    """One integrator in d dimensions, a = 25, gamma = 4.5, rho = 3."""
    integrator: str
    d: int

    @property
    def cost(self) -> float:
        return 40.0

    @property
    def label(self) -> str:
        return f"limit DPD {self.integrator}, {self.d}D"

    def run(self, report: Report, folder: Path) -> Outcome:
        method = Unguarded(box=BOXES[self.d], kT=0.0, integrator=INTEGRATORS[self.integrator])
        start = settled(self.d)
        predicted = Dpd(box=method.box).longest_step(start.shape[1])
        exact = bisected(lambda dt: map_grows(method, start, dt), predicted)
        report(0.5)
        found = bisected(lambda dt: trial_grows(method, start, dt), predicted)
        return Outcome({"limits": [{"method": f"DPD {self.d}D", "scene": self.integrator, "eta": method.gamma, "k": method.kT,
                                    "integrator": method.integrator.__name__, "predicted": predicted, "margin": 1.0,
                                    "exact": exact.value, "measured": found.value,
                                    "measured_err": found.half + UNSEEN*found.value}]})
