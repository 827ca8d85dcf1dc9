"""Seconds of a step: how they are measured; how seconds grow with the number of points."""
from collections.abc import Callable, Sequence
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass
from multiprocessing import get_context
from pathlib import Path
from resource import RUSAGE_SELF, getpagesize, getrusage
from time import perf_counter, process_time
from typing import Any, ClassVar, NamedTuple

import numpy as np

from continuum.fluid import ConstEta
from continuum.scene import RayleighBenard
from particles.integral.points import lattice
from particles.integrators import RK4
from particles.run import Plan, run
from particles.threads import Threads
from studies.build.scenes import Tile
from studies.cost.tables import with_err
from studies.kit.case import Case, Outcome, Report
from studies.kit.stats import Measured
from studies.kit.timing import REPEATS, SPREAD_TO_ERR

Clock = Callable[[], float]
SHORT = 0.01        # least CPU seconds of the steps of the shorter of two runs
MANY = 100_000      # most steps of that run

WARM = 16           # steps of particles before they are timed, and of a lap: enough to make lists anew
LAPS, WORK = (5, 25), 2e6               # least and most laps; particles times steps that are enough
ETA = 0.5
TURNS, A_TURN = 12, 2                   # turns of one and two threads; laps in each


# --- how they are measured ----------------------------------------------------------------------------------


def median(seconds: Sequence[float] | np.ndarray) -> Measured:
    """Median of repeats, with its error from their quartiles and number."""
    low, middle, high = np.percentile(seconds, [25, 50, 75])
    to_err = SPREAD_TO_ERR*np.sqrt(REPEATS/len(seconds))
    return Measured(float(middle), float(to_err*(high - low)/2))


def took(f: Callable[[], Any], clock: Clock = process_time) -> float:
    """Seconds of a call."""
    began = clock()
    f()
    return clock() - began


def of_calls(f: Callable[[], Any]) -> Measured:
    """Median seconds of a call that was made before, so that all is compiled."""
    return median([took(f) for _ in range(REPEATS)])


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


class Laps:
    """Clock readings of each call, as the progress report of a run. at : the readings."""

    def __init__(self, clock: Clock = process_time) -> None:
        self.clock, self.at = clock, list[float]()

    def __call__(self, fraction: float) -> None:
        self.at.append(self.clock())

    def total(self, count: int) -> Measured:
        """Seconds of `count` laps, each of median length."""
        return median(np.diff(self.at))*count


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

    def seconds(self, short: float) -> Measured:
        """CPU seconds of a step."""
        count = WORK/(WARM*self.start.shape[1])
        return median(self.laps(int(np.clip(count, *LAPS)), process_time))

    def laps(self, count: int, clock: Clock) -> np.ndarray:
        """Seconds of a step in each of `count` laps; one lap more before them does not count."""
        laps, steps = Laps(clock), WARM*(count + 1)
        plan = Plan(dt=self.dt, steps=steps, threads=self.threads, every=WARM)

        def progress(done: float) -> None:
            if round(done*steps) % WARM == 0:       # some methods report after fewer steps
                laps(done)
        run(self.method, self.start, plan, progress)
        return np.diff(laps.at)/WARM


class Web(NamedTuple):
    """RK4 over stored edges of a periodic lattice, twice as many columns as rows."""
    sums: Any
    start: np.ndarray

    @classmethod
    def of(cls, variant: Any, rows: int) -> "Web":
        x = lattice((2*rows, rows)).x
        method, start, _ = variant.ready(
            Tile(width=2*rows, L=rows, law=ConstEta(ETA, ETA)), fields=(1.0, 0.01*np.sin(x), np.ones(len(x))))
        return cls(method.start(len(x), Threads(1)), start)

    def seconds(self, short: float) -> Measured:
        """CPU seconds of a step that is certainly stable there."""
        return per_step(lambda steps: stepped(self.sums, self.start, 0.1, steps), short)


def stepped(sums: Any, state: np.ndarray, dt: float, steps: int) -> np.ndarray:
    """A state after so many steps of RK4, without checks or records."""
    integrator, now = RK4(state.shape, Threads(1)), state.copy()
    for _ in range(steps):
        integrator.step(sums, now, dt)
    return now


@dataclass(frozen=True, kw_only=True)
class StepTime(Case):
    """CPU seconds of a step of so many rows of points."""
    name: str
    variant: Any
    kind: type[Flock] | type[Web]
    rows: int
    a_point: float = 7.6e-5     # seconds that the case takes per point
    short: float = SHORT
    alone: ClassVar[bool] = True
    what: ClassVar[str] = "growth"

    @property
    def cost(self) -> float:
        return 0.5 + self.a_point*2*self.rows**2

    @property
    def label(self) -> str:
        return f"{self.what}, {self.name}, {self.rows} rows"

    def run(self, report: Report, folder: Path) -> Outcome:
        many = self.kind.of(self.variant, self.rows)
        return Outcome({"growth": [self.row(many, many.seconds(self.short), 1, "cpu")]})

    def row(self, many: Flock | Web, seconds: Measured, threads: int, clock: str) -> dict[str, Any]:
        """A row of the table `growth`."""
        return {"method": self.name, "points": many.start.shape[1], "threads": threads, "clock": clock,
                **with_err(step_s=seconds)}


@dataclass(frozen=True, kw_only=True)
class TwoThreads(StepTime):
    """Wall time of steps of one thread and of two, in turns, so that other load slows both alike."""
    kind: type[Flock] = Flock
    turns: int = TURNS
    what: ClassVar[str] = "threads"

    @property
    def cost(self) -> float:
        return self.turns*super().cost

    def run(self, report: Report, folder: Path) -> Outcome:
        one, two = (Flock.of(self.variant, self.rows, threads) for threads in (1, 2))
        alone, together = list[float](), list[float]()
        for turn in range(self.turns + 1):
            first, second = (flock.laps(A_TURN, perf_counter) for flock in (one, two))
            if turn:        # the first turn loads compiled code
                alone.extend(first)
                together.extend(second)
            report(turn/self.turns)
        rows = [self.row(one, median(laps), threads, "wall")
                for threads, laps in ((1, alone), (2, together))]
        return Outcome({"growth": rows})


def resident(variant: Any, rows: int) -> dict[str, int]:
    """Resident bytes of this process before points are made, in a step, and at most (Linux)."""
    def now(*_: Any) -> int:
        return getpagesize()*int(Path("/proc/self/statm").read_text().split()[1])
    before = now()
    flock = Flock.of(variant, rows)
    done = run(flock.method, flock.start, Plan(dt=flock.dt, steps=1, every=1, series={"resident": now}))
    return {"points": flock.start.shape[1], "before": before, "resident": round(done.series["resident"][-1]),
            "peak": 1024*getrusage(RUSAGE_SELF).ru_maxrss}


@dataclass(frozen=True, kw_only=True)
class Resident(StepTime):
    """Memory of a fresh process that makes one step and nothing else."""
    kind: type[Flock] = Flock
    what: ClassVar[str] = "memory"

    def run(self, report: Report, folder: Path) -> Outcome:
        with ProcessPoolExecutor(1, get_context("spawn")) as fresh:
            sizes = fresh.submit(resident, self.variant, self.rows).result()
        return Outcome({"memory": [{"method": self.name, **sizes}]})
