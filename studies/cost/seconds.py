"""Seconds of a step: how they are measured; how seconds grow with the number of points."""
from collections.abc import Callable, Iterator
from concurrent.futures import ProcessPoolExecutor
from multiprocessing import get_context
from time import perf_counter, process_time
from typing import Any, ClassVar, NamedTuple

import numpy as np

from continuum.scene import RayleighBenard
from particles.run import Plan, run
from studies.build.memory import resident
from studies.kit.case import Case, Report
from studies.kit.stats import Measured, with_errors
from studies.kit.table import Row
from studies.kit.timing import REPEATS, median, took

Clock = Callable[[], float]
SHORT = 0.01        # least CPU seconds of the steps of the shorter of two runs
MANY = 100_000      # most steps of that run

WARM = 16           # steps of particles before they are timed, and of a lap: enough to make lists anew
LAPS, WORK = (5, 25), 2e6               # least and most laps; particles times steps that are enough
A_POINT = 7.6e-5                        # seconds that a case takes per point
TURNS, A_TURN = 12, 2                   # turns of one and two threads; laps in each


# --- how they are measured ----------------------------------------------------------------------------------


def per_step(advance: Callable[[int], Any], short: float = SHORT, clock: Clock = process_time) -> Measured:
    """Seconds of one step of advance(steps), from the difference of two runs: it leaves out the fixed cost.

    The steps of the shorter run take at least `short`, and at least the fixed cost, since its scatter counts.
    """
    def lap(steps: int) -> float:
        return took(lambda: advance(steps), clock)
    lap(1)
    steps = 1
    while steps < MANY:
        one, three = lap(steps), lap(3*steps)
        spent = (three - one)/2
        if spent >= max(short, one - spent):
            break
        steps *= 2
    more = [lap(3*steps) - lap(steps) for _ in range(REPEATS)]
    return median(more)*(0.5/steps)


# --- many points --------------------------------------------------------------------------------------------


class Flock(NamedTuple):
    """Moving points in convection at Ra 10 000, with lists or flips and walls; 2 rows columns wide."""
    method: Any
    start: np.ndarray
    dt: float
    threads: int

    @classmethod
    def of(cls, variant: Any, rows: int, threads: int = 1) -> "Flock":
        method, start, dt = variant.ready(RayleighBenard(ra=1e4, L=float(rows)))
        return cls(method, start, dt, threads)

    def laps(self, count: int, clock: Clock) -> np.ndarray:
        """Seconds of a step in each of `count` laps; one lap more before them does not count."""
        at, steps = list[float](), WARM*(count + 1)
        plan = Plan(dt=self.dt, steps=steps, threads=self.threads, every=WARM)

        def progress(done: float) -> None:
            if round(done*steps) % WARM == 0:       # some methods report after fewer steps
                at.append(clock())
        run(self.method, self.start, plan, progress)
        return np.diff(at)/WARM


class StepTime(Case, table="growth", same="method"):
    """CPU seconds of a step of so many rows of points. method : its name, variant : of `studies.build`."""
    method: str
    variant: Any
    rows: int
    alone: ClassVar[bool] = True
    what: ClassVar[str] = "growth"

    @property
    def cost(self) -> float:
        return 0.5 + A_POINT*2*self.rows**2

    @property
    def label(self) -> str:
        return f"{self.what}, {self.method}, {self.rows} rows"

    def measure(self, report: Report) -> Iterator[Row]:
        flock = Flock.of(self.variant, self.rows)
        count = WORK/(WARM*flock.start.shape[1])
        laps = flock.laps(int(np.clip(count, *LAPS)), process_time)
        yield row(flock, median(laps), "cpu")


def row(flock: Flock, seconds: Measured, clock: str) -> Row:
    """A row of the table `growth`."""
    return {"points": flock.start.shape[1], "threads": flock.threads, "clock": clock,
            **with_errors(step_s=seconds)}


class TwoThreads(StepTime, table="growth"):
    """Wall time of steps of one thread and of two, in turns, so that other load slows both alike."""
    turns: int = TURNS
    what: ClassVar[str] = "threads"

    @property
    def cost(self) -> float:
        return self.turns*super().cost

    def measure(self, report: Report) -> Iterator[Row]:
        one, two = (Flock.of(self.variant, self.rows, threads) for threads in (1, 2))
        alone, together = list[float](), list[float]()
        for turn in range(self.turns + 1):
            first, second = (flock.laps(A_TURN, perf_counter) for flock in (one, two))
            if turn:        # the first turn loads compiled code
                alone.extend(first)
                together.extend(second)
            report(turn/self.turns)
        yield row(one, median(alone), "wall")
        yield row(two, median(together), "wall")


class Resident(StepTime, table="memory"):
    """Memory of a fresh process that makes one step and nothing else."""
    what: ClassVar[str] = "memory"

    def measure(self, report: Report) -> Iterator[Row]:
        scene = RayleighBenard(ra=1e4, L=float(self.rows))
        with ProcessPoolExecutor(1, get_context("spawn")) as fresh:
            yield fresh.submit(resident, self.variant, scene).result()
