"""A method set up in a flow, and the longest time step that is accurate enough.

The step is halved from a first fraction of the stability limit until halving it once more changes the result
by less than the error that is left: the error of time is then below that of space. From there the step grows
by factors of 2^(1/4), also beyond a limit whose formula is on the safe side, while this changes less than an
eighth of the error: in two dimensions seconds go as error^(-3/2), so that a larger change would cost what the
longer step saves. Steps longer than the first one have to last a thousand steps, since a short run does not
show that they are unstable. In chaotic flows errors at any two steps differ by more than an eighth: there the
change may be as large as the error.
"""
from collections.abc import Callable, Iterator, Mapping
from functools import partial
from math import ceil
from time import process_time
from typing import Any, NamedTuple

import numpy as np

from particles.integrators import RK4
from particles.limits import limit_of
from particles.run import Divergence, Plan, Run, run
from particles.threads import Threads
from studies.build.setting import Unguarded

HALVINGS = 7        # of the step at most: to 1/128 of the first one
LONGEST = 60.0      # CPU seconds that halving may take: no step is halved that would exceed this
STRETCH, STRETCHES = 2**0.25, 8         # factor of longer steps, number of factors: 4 times at most
WORTH = STRETCH**(2/3) - 1              # part of the error that a longer step may change
STANDS = 1000       # steps within which round-off breaks a fluid if it grows by 4 % a step
ROUNDING = 1e-12
DIVERGES = (Divergence, ArithmeticError)
#: quantity -> differences from the exact answer over its rms, (m,)
Residuals = dict[str, np.ndarray]
#: (state, dt, steps) -> what a run gives
Go = Callable[[Any, float, int], Any]
NONE: Mapping[str, float] = {}


class Result(NamedTuple):
    """Errors of a run by quantity. uncertain : error of averages. share : part of the steps that it needs."""
    residuals: Residuals
    uncertain: Mapping[str, float] = NONE
    share: Mapping[str, float] = NONE
    state: Any = None


Judge = Callable[[Any], Result]


class Problem(NamedTuple):
    """A method at the start of a flow.

    points : number of particles, points or cells. limit : largest stable step. time : duration. set_up() :
    makes what a run needs, to be timed. known : uncertainty of the exact answer. chaotic : two steps give two
    flows, of which only the sizes of errors can be compared. firm : no step beyond the limit is stable.
    timed : `go` without records.
    """
    points: int
    start: Any
    limit: float
    time: float
    go: Go
    judge: Judge
    set_up: Callable[[], Any]
    known: float = 0.0
    chaotic: bool = False
    firm: bool = False
    timed: Go | None = None

    @property
    def advance(self) -> Go:
        return self.timed or self.go

    def steps(self, fraction: float) -> int:
        """Number of equal steps to the end of the flow, each at most this fraction of the limit."""
        exact = self.time/(fraction*self.limit)
        return ceil(exact*(1 - ROUNDING))

    def dt(self, fraction: float) -> float:
        """Length of these steps."""
        return self.time/self.steps(fraction)

    def result(self, fraction: float) -> Result | None:
        """Result of a run with this step; None where it diverges."""
        try:
            end = self.go(self.start, self.dt(fraction), self.steps(fraction))
            result = self.judge(end)
        except DIVERGES:
            return None
        return result._replace(state=getattr(end, "state", end))

    def stands(self, fraction: float) -> bool:
        """Whether STANDS steps can be made; they are tried only if the run has fewer."""
        if self.steps(fraction) >= STANDS:
            return True
        try:
            end = self.advance(self.start, self.dt(fraction), STANDS)
        except DIVERGES:
            return False
        return bool(np.isfinite(end).all())


# --- methods of the particles' time loop --------------------------------------------------------------------


def of_method(method: Any, start: np.ndarray, time: float, judge: Judge, **more: Any) -> Problem:
    """Problem of such a method. It is set up by making the sums, their lists and the integrator."""
    def go(state: np.ndarray, dt: float, steps: int) -> np.ndarray:
        return run(Unguarded(method), state, Plan(dt=dt, steps=steps, every=steps)).by_id()

    def set_up() -> None:
        threads, n = Threads(1), start.shape[1]
        method.start(n, threads).try_out(Run(state=start.copy(), ids=np.arange(n)))
        getattr(method, "integrator", RK4)(start.shape, threads)
    return Problem(start.shape[1], start, limit_of(method, start), time, go, judge, set_up, **more)


def of_grid(ready: Any, time: float, judge: Judge, **more: Any) -> Problem:
    """Problem of the compressible grid, which has its own time loop and cells of unit spacing."""
    method, start = ready.method, ready.start
    cells = round(method.scene.L*method.scene.width)
    return Problem(cells, start, ready.limit, time, method.go, judge, partial(method.march, start), **more)


def relative(V: np.ndarray, difference: np.ndarray, scale: np.ndarray) -> np.ndarray:
    """Differences, (n,) or (n, 2), weighted by volumes V, over the rms of a scale."""
    w = np.sqrt(V/V.mean())
    size = rms(w*scale.T)
    return np.ravel(w*difference.T/size)


def rms(values: np.ndarray) -> float:
    """Root mean square; nan if one value is nan."""
    return float(np.sqrt(np.mean(np.asarray(values)**2)))


# --- the step -----------------------------------------------------------------------------------------------


class Rung(NamedTuple):
    """A step that was tried: its fraction of the limit, errors of time and space by quantity, its result."""
    fraction: float
    time: dict[str, float]
    space: dict[str, float]
    accepted: bool
    result: Result | None


def climb(problem: Problem, first: float) -> list[Rung]:
    """All steps that were tried: halved until one is accepted, then made longer."""
    rungs, fine, most = halved(problem, first)
    if rungs[-1].accepted:
        rungs += stretched(problem, rungs[-1], fine, most)
    return rungs


def best(rungs: list[Rung]) -> Rung:
    """The longest accepted step; if none is accepted, the shortest."""
    good = [rung for rung in rungs if rung.accepted]
    return max(good, key=lambda rung: rung.fraction, default=rungs[-1])


def halved(problem: Problem, first: float) -> tuple[list[Rung], Result | None, float]:
    """Steps down to the first accepted one, the result of half of it, and the bound of longer steps."""
    rungs: list[Rung] = []
    most = max(first, 1.0) if problem.firm else first*STRETCH**(STRETCHES + 0.5)
    began, fine, too_long = process_time(), problem.result(first), False
    while len(rungs) < HALVINGS and not too_long:
        before, fraction, coarse = process_time(), first/2**len(rungs), fine
        fine = problem.result(fraction/2)
        rungs.append(rung_of(problem, fraction, coarse, fine, 1.0))
        if rungs[-1].accepted:
            break
        most, now = fraction, process_time()
        too_long = now - began + 2*(now - before) > LONGEST
    return rungs, fine, most


def stretched(problem: Problem, good: Rung, fine: Result | None, most: float) -> Iterator[Rung]:
    """Steps longer than an accepted one, below `most`, up to the first that changes too much or diverges."""
    share = 1.0 if problem.chaotic else WORTH
    fraction = good.fraction*STRETCH
    while fraction < most*(1 - ROUNDING) and below(share, good):
        coarse = problem.result(fraction) if problem.stands(fraction) else None
        good = rung_of(problem, fraction, coarse, fine, share)
        yield good
        fraction *= STRETCH


def below(share: float, rung: Rung) -> bool:
    """Whether errors of time are below a share of those of space."""
    return rung.accepted and all(rung.time[name] <= share*rung.space[name] for name in rung.space)


def rung_of(problem: Problem, fraction: float, coarse: Result | None, fine: Result | None,
            share: float) -> Rung:
    """Errors of a step, from its result and that of a finer step."""
    if coarse is None or fine is None:
        return Rung(fraction, {}, {}, False, coarse)
    time, space = dict[str, float](), dict[str, float]()
    for name, residual in fine.residuals.items():
        other, space[name] = coarse.residuals[name], rms(residual)
        time[name] = abs(rms(other) - space[name]) if problem.chaotic else rms(other - residual)
    rung = Rung(fraction, time, space, True, coarse)
    return rung._replace(accepted=below(share, rung))
