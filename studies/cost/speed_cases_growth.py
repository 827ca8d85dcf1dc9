"""Seconds of a step by the number of particles, and what two threads gain."""
from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path
from time import perf_counter, process_time
from typing import ClassVar

import numpy as np

from continuum.fluid import ConstEta, IdealGas
from continuum.scene import RayleighBenard
from particles.edges import NONE_BEYOND
from particles.integrators import RK4
from particles.makers import renormalised
from particles.methods.layer import Layer
from particles.points import lattice
from particles.run import Plan, run
from particles.team import Team
from particles.weights import Lucy
from studies.convection import spam
from studies.cost import speed_names as names
from studies.cost.speed_problem import holding
from studies.cost.speed_timing import SHORT, Laps, Timed, array_bytes, per_step, with_peak
from studies.kit.case import Case, Outcome, Report

WARM = 16           # steps of particles before they are timed, and of a lap: a lattice has no lists to make again
LAPS, WORK = (5, 25), 2e6               # least and most laps; particles times steps that are enough
ETA = 0.5
SMALL = 12          # rows


@dataclass(frozen=True, kw_only=True)
class Growth(Case):
    """Steps of so many rows of smooth particles between plates, twice as many columns, or of as many fixed points."""
    rows: int
    fixed: bool = False
    threads: int = 1
    clock: str = "cpu"
    short: float = SHORT
    alone: ClassVar[bool] = True

    @property
    def cost(self) -> float:
        return 0.5 + (2.5e-5 if self.fixed else 7.6e-5)*self.points

    @property
    def label(self) -> str:
        return f"growth, {self.name}, {self.points} points, {self.threads} threads, {self.clock} time"

    @property
    def points(self) -> int:
        return 2*self.rows**2

    @property
    def name(self) -> str:
        return names.LATTICE if self.fixed else names.LUCY

    def run(self, report: Report, folder: Path) -> Outcome:
        replace(self, rows=SMALL)._timed()      # the memory that compiling takes is not that of the points
        (seconds, size), peak = with_peak(self._timed)
        return Outcome({"growth": [{"method": self.name, "points": self.points, "threads": self.threads, "clock": self.clock,
                                    "step_s": seconds.value, "step_s_err": seconds.err, "early_s": seconds.early,
                                    "late_s": seconds.late, "bytes": size, "peak_bytes": peak}]})

    @property
    def read_clock(self) -> Callable[[], float]:
        return process_time if self.clock == "cpu" else perf_counter

    def _timed(self) -> tuple[Timed, int]:
        return self._fixed() if self.fixed else self._particles()

    def _particles(self) -> tuple[Timed, int]:
        """The printed scheme at Ra = 10 000, lists and walls included: median of laps, the first of which is left out."""
        scene, laps = RayleighBenard(ra=1e4, L=float(self.rows)), Laps(self.read_clock)
        method, dt = spam.method(scene, spam.PRINTED), spam.step(scene, spam.PRINTED)
        count = int(np.clip(WORK/(WARM*self.points), *LAPS))
        first = spam.start(scene, 1)
        run(method, first, Plan(dt=dt, steps=WARM*(count + 1), threads=self.threads), laps)
        return laps.total(1).times(1/WARM), array_bytes(holding(method, first)())

    def _fixed(self) -> tuple[Timed, int]:
        """RK4 over stored edges of a periodic lattice; the step is one that is stable there for sure."""
        points = lattice((2*self.rows, self.rows))
        method = Layer(x=points.x, edges=renormalised(points, Lucy.of(h=2.0)), beyond=NONE_BEYOND, eos=IdealGas(),
                       law=ConstEta(ETA, ETA), T_plates=(1.0, 1.0), g=0.0)
        state, team = method.state(1.0, 0.01*np.sin(points.x), np.ones(points.n)), Team(self.threads)
        sums, integrator = method.start(points.n, team), RK4((4, points.n), team)

        def advance(steps: int) -> None:
            now = state.copy()
            for _ in range(steps):
                integrator.step(sums, now, 0.1)
        return per_step(advance, self.short, self.read_clock), array_bytes(state, sums, integrator)
