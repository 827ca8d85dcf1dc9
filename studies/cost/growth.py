"""Seconds of a step by the number of particles, and what two threads gain."""
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path
from time import perf_counter, process_time
from typing import Any, ClassVar, NamedTuple

import numpy as np

from continuum.fluid import ConstEta, IdealGas
from continuum.scene import RayleighBenard
from particles.integral.edge_makers import renormalised
from particles.integral.edges import NONE_BEYOND
from particles.integral.layer import Layer
from particles.integral.points import lattice
from particles.integrators import RK4
from particles.run import Plan, run
from particles.threads import Team
from particles.weights import Lucy
from studies.build import ready
from studies.cost import names
from studies.cost.problem import holding
from studies.cost.timing import SHORT, Laps, Timed, array_bytes, of_laps, per_step, took, with_peak
from studies.kit.case import Case, Outcome, Report

WARM = 16           # steps of particles before they are timed, and of a lap: a lattice has no lists to make again
LAPS, WORK = (5, 25), 2e6               # least and most laps; particles times steps that are enough
ETA = 0.5
SMALL = 12          # rows
TURNS, A_TURN = 12, 2                   # of one and two threads; laps of particles in each
BATCH, STAGE = 10, 4e-8                 # times `short` takes the shorter batch over edges, about; seconds a point and stage


class Flock(NamedTuple):
    """Smooth particles of the printed scheme at Ra = 10 000, lists and walls included."""
    method: Any
    first: np.ndarray
    dt: float

    def laps(self, count: int, threads: int = 1, clock: Callable[[], float] = process_time) -> np.ndarray:
        """Seconds of a step in each of so many laps; the one before the first is left out."""
        laps = Laps(clock)
        run(self.method, self.first, Plan(dt=self.dt, steps=WARM*(count + 1), threads=threads), laps)
        return np.diff(laps.at)/WARM


def flock(rows: int) -> Flock:
    """Rows of particles between plates, twice as many columns."""
    scene = RayleighBenard(ra=1e4, L=float(rows))
    return Flock(*ready(scene, "spam"))


class Web(NamedTuple):
    """RK4 over stored edges of a periodic lattice; the step is one that is stable there for sure."""
    state: np.ndarray
    sums: Any
    integrator: RK4

    def advance(self, steps: int) -> None:
        """From the start."""
        now = self.state.copy()
        for _ in range(steps):
            self.integrator.step(self.sums, now, 0.1)


def web(rows: int, threads: int = 1) -> Web:
    """Rows of points, twice as many columns."""
    points = lattice((2*rows, rows))
    method = Layer(x=points.x, edges=renormalised(points, Lucy.of(h=2.0)), beyond=NONE_BEYOND, eos=IdealGas(),
                   law=ConstEta(ETA, ETA), T_plates=(1.0, 1.0), g=0.0)
    state, team = method.state(1.0, 0.01*np.sin(points.x), np.ones(points.n)), Team(threads)
    return Web(state, method.start(points.n, team), RK4((4, points.n), team))


@dataclass(frozen=True, kw_only=True)
class Growth(Case):
    """CPU seconds of steps of so many rows of smooth particles between plates, or of as many fixed points."""
    rows: int
    fixed: bool = False
    short: float = SHORT
    alone: ClassVar[bool] = True

    @property
    def cost(self) -> float:
        return 0.5 + (2.5e-5 if self.fixed else 7.6e-5)*self.points

    @property
    def label(self) -> str:
        return f"growth, {self.name}, {self.points} points"

    @property
    def points(self) -> int:
        return 2*self.rows**2

    @property
    def name(self) -> str:
        return names.LATTICE if self.fixed else names.LUCY

    def run(self, report: Report, folder: Path) -> Outcome:
        replace(self, rows=SMALL)._timed()      # the memory that compiling takes is not that of the points
        (seconds, size), peak = with_peak(self._timed)
        return Outcome({"growth": [self.row(seconds, size, peak)]})

    def row(self, seconds: Timed, size: int, peak: float, threads: int = 1, clock: str = "cpu") -> dict[str, Any]:
        """Of the table."""
        return {"method": self.name, "points": self.points, "threads": threads, "clock": clock, "step_s": seconds.value,
                "step_s_err": seconds.err, "bytes": size, "peak_bytes": peak}

    def _timed(self) -> tuple[Timed, int]:
        if self.fixed:
            made = web(self.rows)
            return per_step(made.advance, self.short), array_bytes(*made)
        birds = flock(self.rows)
        laps = birds.laps(int(np.clip(WORK/(WARM*self.points), *LAPS)))
        return of_laps(laps), array_bytes(holding(birds.method, birds.first)())


@dataclass(frozen=True, kw_only=True)
class Threads(Growth):
    """The time that passes in steps of one thread and of two, which take turns: whatever slows the machine slows both."""
    turns: int = TURNS

    @property
    def cost(self) -> float:
        return 0.5 + (1.0 if self.fixed else 7e-5*self.points)*self.turns

    @property
    def label(self) -> str:
        return f"threads, {self.name}, {self.points} points, one and two in turns"

    def run(self, report: Report, folder: Path) -> Outcome:
        turn, size = self._edges() if self.fixed else self._particles()
        seconds: dict[int, list[float]] = {1: [], 2: []}
        for number in range(self.turns + 1):
            for threads, found in seconds.items():
                one = turn(threads)
                found += one if number else []          # the first loads what is compiled
            report(number/self.turns)
        return Outcome({"growth": [self.row(of_laps(found), size, np.nan, threads, "wall")
                                   for threads, found in seconds.items()]})

    def _particles(self) -> tuple[Callable[[int], list[float]], int]:
        birds = flock(self.rows)
        size = array_bytes(holding(birds.method, birds.first)())
        return lambda threads: list(birds.laps(A_TURN, threads, perf_counter)), size

    def _edges(self) -> tuple[Callable[[int], list[float]], int]:
        """The difference of two lengths, without what every run pays once."""
        made = {threads: web(self.rows, threads) for threads in (1, 2)}
        steps = max(1, round(BATCH*self.short/(RK4.evaluations*STAGE*self.points)))

        def turn(threads: int) -> list[float]:
            one, three = (took(partial(made[threads].advance, n), perf_counter) for n in (steps, 3*steps))
            return [(three - one)/(2*steps)]
        return turn, array_bytes(*made[1])
