"""A cylinder that turns inside of one at rest as a case: the torque that edges carry [Taylor-Couette flow, exact]"""
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from continuum.fluid import ConstEta, IdealGas
from particles.integral.bodies import between_circles, together, turning
from particles.integral.stream import Stream
from particles.integral.triangulation import delaunay
from particles.limits import limit_of
from particles.run import Plan, run
from particles.threads import Team
from studies.conservation.bodies.drag import ETA, OF_LIMIT, PRESSURE, TIMES
from studies.kit.case import Case, Outcome, Report

INNER, OUTER = 0.18, 0.42       # radii over the size of the box


@dataclass(frozen=True, kw_only=True)
class TurningCylinder(Case):
    """Points on both circles, Delaunay edges; velocity over radius between them is A + B/r^2, the torque 4 pi eta B."""
    rows: int
    speed: float = 1e-3

    @property
    def label(self) -> str:
        return f"turning cylinder, {self.rows} rows"

    @property
    def cost(self) -> float:
        return 4e-7*self.rows**4

    def turns(self, r: np.ndarray) -> np.ndarray:
        """Angular velocity at r."""
        inner, outer = INNER*self.rows, OUTER*self.rows
        between = (outer**2/np.maximum(r, inner)**2 - 1)/(outer**2/inner**2 - 1)
        return self.speed/inner*np.clip(between, 0, 1)

    def run(self, report: Report, folder: Path) -> Outcome:
        inner, outer = INNER*self.rows, OUTER*self.rows
        points, turned, fixed = between_circles((self.rows, self.rows), inner, outer)
        body = together(turning(points, turned, self.speed/inner, 1.0), turning(points, fixed, 0.0, 1.0))
        method = Stream(x=points.x, edges=delaunay(points), eos=IdealGas(), law=ConstEta(ETA, ETA), held=body, chi=PRESSURE/ETA)
        exact = self.turns(np.hypot(*points.x.T))[:, None]*np.stack([-points.x[:, 1], points.x[:, 0]], axis=1)
        first = method.state(1.0, exact, 1.0)
        dt = OF_LIMIT*limit_of(method, first)
        plan = Plan(dt=dt, steps=round(TIMES*(outer - inner)**2/(np.pi**2*ETA)/dt))
        done = run(method, first, plan, report)
        torques = self._torques(method, done.state)/(4*np.pi*ETA*self.speed*inner/(1 - (inner/outer)**2))
        v = (done.state[1:3]/done.state[0]).T
        return Outcome({"torque": [{"rows": self.rows, "radius": inner, "turned": -torques[0] - 1, "fixed": torques[1] - 1,
                                    "balance": torques[0] + torques[1],
                                    "profile": float(np.abs(v - exact).max()/self.speed), "steps": plan.steps,
                                    "cpu_s": done.cpu_s, "compile_s": done.compile_s}]})

    def _torques(self, method: Stream, state: np.ndarray) -> np.ndarray:
        """On the cylinder that turns and on the fixed one."""
        sums = method.start(state.shape[1], Team(1))
        sums.force(state)
        (x, y), body = method.x[method.held.which].T, method.held.body
        return np.bincount(body, x*sums.received[:, 1] - y*sums.received[:, 0])
