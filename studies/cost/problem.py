"""One method on one scene at one resolution: the longest step that is good enough, its errors, its seconds, as a case.

The step is a fraction of the method's stability limit, halved from the first one that the method names until halving it once more
changes what is measured by less than the error that is left: the error of time is then below that of space. From there it is made
longer, beyond a limit whose formula is on the safe side, too, by 2^(1/4) at a time, while what that changes is below an eighth of
the error: in two dimensions seconds go as error^(-3/2), so an eighth more error would cost what the longer step saves. A run may
be too short to see that a step is unstable: what is longer than the first has to stand a thousand steps. Of chaotic flows, whose
errors differ by more than an eighth at any two steps, all of the error may change.
"""
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from math import ceil
from pathlib import Path
from time import process_time
from typing import Any, ClassVar, NamedTuple

import numpy as np

from particles.integrators import RK4
from particles.limits import limit_of
from particles.run import Divergence, Plan, Run, run
from particles.smooth.spam import Spam
from particles.threads import Team
from studies.build.unguarded import Unguarded
from studies.cost.timing import SHORT, Timed, array_bytes, of_calls, per_step
from studies.kit.case import Case, Outcome, Report
from studies.kit.timing import compile_and_run_seconds

HALVINGS = 7        # at most: steps of 1/128 of the first one
LONGEST = 60.0      # CPU seconds of halving steps: none is halved again that would take it beyond
STRETCH, STRETCHES = 2**0.25, 8         # of a step that is good enough, and how often at most: 4 times the first one
WORTH = STRETCH**(2/3) - 1              # of the error: what a longer step may change
STANDS = 1000       # steps in which round-off grows to order one, and breaks a fluid, if it grows by 4 % a step
TRIES = 1.4         # of what a method says that a case takes: what trying longer steps does to it
LONGER = 10         # are the runs that time particles: they have to hold some lists
Residuals = dict[str, np.ndarray]


class Problem(NamedTuple):
    """A method set up for a scene.

    points : particles, points or cells. first : state to start from. limit : largest stable step, `time` to go. go(state, dt,
    steps) : the state so many steps later. residuals(state) : by quantity, (m,), what is off relative to the exact answer's rms.
    held() : all that exists in memory while the method runs. known : uncertainty of the exact answer. chaotic : small changes
    grow, so that two steps give two flows and only the sizes of their errors compare. firm : no step beyond the limit is stable.
    step : `go` without records, for timing.
    uncertain(state) : by quantity, of an average over time. share(state) : by quantity, of the steps that it needs.
    """
    points: int
    first: Any
    limit: float
    time: float
    go: Callable[[Any, float, int], Any]
    residuals: Callable[[Any], Residuals]
    held: Callable[[], tuple]
    known: float = 0.0
    chaotic: bool = False
    firm: bool = False
    step: Callable[[Any, float, int], Any] | None = None
    uncertain: Callable[[Any], dict[str, float]] = lambda state: {}
    share: Callable[[Any], dict[str, float]] = lambda state: {}


class Result(NamedTuple):
    """What came out of a run: residuals, uncertainties of averages, shares of the steps needed, by quantity."""
    residuals: Residuals
    uncertain: dict[str, float]
    share: dict[str, float]
    state: Any = None


def marching(method: Any) -> Callable[[np.ndarray, float, int], np.ndarray]:
    """`go` of all that the time loop of the particles takes; the state comes back in the order of its points."""
    return lambda state, dt, steps: run(Unguarded(method), state, Plan(dt=dt, steps=steps)).by_id()


def plain(method: Any) -> Callable[[np.ndarray, float, int], Any]:
    """`step` of the same: without records."""
    return lambda state, dt, steps: run(Unguarded(method), state, Plan(dt=dt, steps=steps))


def holding(method: Any, first: np.ndarray) -> Callable[[], tuple]:
    """`held` of the same: state, sums with their lists, and what the integrator keeps."""
    def held() -> tuple:
        team, n = Team(1), first.shape[1]
        sums, now = method.start(n, team), Run(state=first.copy(), ids=np.arange(n))
        sums.try_out(now)
        return now.state, sums, getattr(method, "integrator", RK4)(first.shape, team)
    return held


def of_method(method: Any, first: np.ndarray, time: float, residuals: Callable[[np.ndarray], Residuals], *,
              limit: float | None = None, known: float = 0.0, chaotic: bool = False) -> Problem:
    """The problem of a method of the particles' time loop; limits that are given, and of lattice sums, are firm."""
    firm = limit is not None or isinstance(method, Spam)
    return Problem(first.shape[1], first, limit_of(method, first) if limit is None else limit, time, marching(method), residuals,
                   holding(method, first), known, chaotic, firm, plain(method))


class Price(NamedTuple):
    """CPU seconds that a case takes, about: fixed + factor resolution^power."""
    fixed: float
    factor: float = 0.0
    power: int = 2

    def seconds(self, resolution: int) -> float:
        """At a resolution."""
        return self.fixed + self.factor*resolution**self.power


def relative(V: np.ndarray, off: np.ndarray, scale: np.ndarray) -> np.ndarray:
    """What is off, (n,), at points of volumes V, over the rms of a scale."""
    w = np.sqrt(len(V)*V/V.sum())
    weighted: np.ndarray = w*off/np.sqrt(np.mean(w**2*scale**2))
    return weighted


def rms(residual: np.ndarray) -> float:
    """Root mean square; not a number where one of them is none."""
    return float(np.sqrt(np.mean(np.asarray(residual)**2)))


class Rung(NamedTuple):
    """A step tried: its fraction of the limit, by quantity errors of time and space, whether it was good enough, its result."""
    fraction: float
    time: dict[str, float]
    space: dict[str, float]
    accepted: bool
    found: Result | None


def steps_of(problem: Problem, fraction: float) -> int:
    """Equal steps that end at the time of the scene."""
    return ceil(problem.time/(fraction*problem.limit)*(1 - 1e-12))


def result(problem: Problem, fraction: float) -> Result | None:
    """What comes out with a fraction of the limit; none where the run diverges."""
    steps = steps_of(problem, fraction)
    try:
        state = problem.go(problem.first, problem.time/steps, steps)
        return Result(problem.residuals(state), problem.uncertain(state), problem.share(state), getattr(state, "state", state))
    except (Divergence, ArithmeticError):
        return None


def climb(problem: Problem, first: float) -> list[Rung]:
    """All steps that were tried: halved until one is good enough, then made longer."""
    rungs, fine, most = halved(problem, first)
    if rungs[-1].accepted and fine is not None:
        rungs += stretched(problem, rungs[-1], fine, most)
    return rungs


def best(rungs: list[Rung]) -> Rung:
    """The longest step that is good enough; where none is, the shortest."""
    return max((rung for rung in rungs if rung.accepted), key=lambda rung: rung.fraction, default=rungs[-1])


def halved(problem: Problem, first: float) -> tuple[list[Rung], Result | None, float]:
    """Steps from the first one down to the first that is good enough, what comes out with half of it, what steps stay below."""
    rungs: list[Rung] = []
    most = max(first, 1.0) if problem.firm else first*STRETCH**(STRETCHES + 0.5)
    began, coarse, fine = process_time(), result(problem, first), None
    for number in range(HALVINGS):
        fraction, before = first/2**number, process_time()
        fine = result(problem, fraction/2)
        rungs.append(rung_of(problem, fraction, coarse, fine, 1.0))
        now = process_time()
        if rungs[-1].accepted or number == HALVINGS - 1 or now - began + 2*(now - before) > LONGEST:
            break
        most, coarse = fraction, fine
    return rungs, fine, most


def stretched(problem: Problem, good: Rung, fine: Result, most: float) -> Iterator[Rung]:
    """Steps that are longer than a good one, up to the first that changes too much, or diverges; all below `most`."""
    fraction, share = good.fraction*STRETCH, 1.0 if problem.chaotic else WORTH
    while good.accepted and fraction < most*(1 - 1e-12) and all(off <= share*good.space[name] for name, off in good.time.items()):
        good = rung_of(problem, fraction, result(problem, fraction) if stands(problem, fraction) else None, fine, share)
        yield good
        fraction *= STRETCH


def stands(problem: Problem, fraction: float) -> bool:
    """Whether a run goes on for so many steps, if it has not as many itself; of methods that tell when nothing fluid is left."""
    steps = steps_of(problem, fraction)
    try:
        end = (problem.step or problem.go)(problem.first, problem.time/steps, STANDS) if steps < STANDS else 0.0
        return not isinstance(end, np.ndarray) or bool(np.isfinite(end).all())
    except (Divergence, ArithmeticError):
        return False


def rung_of(problem: Problem, fraction: float, coarse: Result | None, fine: Result | None, share: float) -> Rung:
    """What comes out with a step against what does with a finer one; good enough below a share of the error of space."""
    if coarse is None or fine is None:
        return Rung(fraction, {}, {}, False, coarse)
    space = {name: rms(off) for name, off in fine.residuals.items()}
    time = {name: abs(rms(coarse.residuals[name]) - space[name]) if problem.chaotic
            else rms(coarse.residuals[name] - off) for name, off in fine.residuals.items()}
    return Rung(fraction, time, space, all(time[name] <= share*space[name] for name in space), coarse)


@dataclass(frozen=True, kw_only=True)
class Race(Case):
    """One method on one scene at one resolution."""
    scene: str
    method: Any             # name, price, first (fraction of the limit that is tried first), problem(resolution, seed)
    resolution: int
    seed: int = 1
    short: float = SHORT
    alone: ClassVar[bool] = True

    @property
    def cost(self) -> float:
        return TRIES*self.method.price.seconds(self.resolution)

    @property
    def label(self) -> str:
        return f"{self.scene}, {self.method.name}, resolution {self.resolution}, seed {self.seed}"

    @property
    def key_columns(self) -> dict[str, Any]:
        """Columns that every row has."""
        return {"scene": self.scene, "method": self.method.name, "resolution": self.resolution, "seed": self.seed}

    def run(self, report: Report, folder: Path) -> Outcome:
        problem, compile_s = self._compiled()
        report(0.2)
        rungs = climb(problem, self.method.first)
        fraction, found = best(rungs).fraction, best(rungs).found
        report(0.7)
        rows = {"steps": list(self._rungs(rungs)), "errors": list(self._errors(problem, found))}
        if found is None:
            return Outcome(rows)
        return Outcome({**rows, **self._run(problem, fraction, found, compile_s)})

    def _make(self) -> Problem:
        made: Problem = self.method.problem(self.resolution, self.seed)
        return made

    def _compiled(self) -> tuple[Problem, float]:
        """The problem, and seconds of compiling it and its step."""
        problem, made_s, _ = compile_and_run_seconds(self._make)
        _, loop_s, _ = compile_and_run_seconds(lambda: (problem.step or problem.go)(
            problem.first, self.method.first*problem.limit, 1))
        return problem, made_s + loop_s

    def _rungs(self, rungs: list[Rung]) -> Iterator[dict[str, Any]]:
        for rung in rungs:
            for name in rung.time or ("diverged",):
                yield {**self.key_columns, "quantity": name, "of_limit": rung.fraction, "time_error": rung.time.get(name, np.nan),
                       "space_error": rung.space.get(name, np.nan), "accepted": int(rung.accepted)}

    def _errors(self, problem: Problem, found: Result | None) -> Iterator[dict[str, Any]]:
        if found is None:
            yield {**self.key_columns, "quantity": "diverged", "error": np.nan, "error_err": np.nan, "share": np.nan}
            return
        for name, residual in found.residuals.items():
            err = float(np.hypot(problem.known, found.uncertain.get(name, 0.0)))
            yield {**self.key_columns, "quantity": name, "error": rms(residual), "error_err": err,
                   "share": found.share.get(name, 1.0)}

    def _run(self, problem: Problem, fraction: float, found: Result | None,
             compile_s: float) -> dict[str, list[dict[str, Any]]]:
        steps, advance = steps_of(problem, fraction), problem.step or problem.go
        dt = problem.time/steps
        # particles are timed in the disorder of the end: their lists are made more often than at the start
        first, short = (found.state, LONGER*self.short) if found and problem.chaotic else (problem.first, self.short)
        safe = min(dt, self.method.first*problem.limit)     # of more steps than the run has, which it may not stand
        try:
            one = per_step(lambda n: advance(first, dt if problem.chaotic and not problem.firm else safe, n), short)
        except Divergence:
            one = per_step(lambda n: advance(first, safe, n), short)
        seconds = one.times(steps)
        set_up = of_calls(lambda: self._make().held())
        return self.timings(seconds, {
            "points": problem.points, "of_limit": fraction, "dt": dt, "steps": steps, "setup_s": set_up.value,
            "setup_s_err": set_up.err, "compile_s": compile_s, "bytes": array_bytes(problem.held()), "threads": 1})

    def timings(self, run: Timed, more: dict[str, Any]) -> dict[str, list[dict[str, Any]]]:
        """The row of the table `runs`."""
        return {"runs": [{**self.key_columns, "run_s": run.value, "run_s_err": run.err, **more}]}
