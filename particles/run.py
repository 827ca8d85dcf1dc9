"""The only time loop: list upkeep, step, walls, divergence check, records, checkpoint, progress."""
from collections.abc import Callable
from signal import SIGINT, default_int_handler, getsignal, signal
from threading import current_thread, main_thread
from time import monotonic, process_time
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from continuum.jit import compiling
from particles.checkpoint import load, save
from particles.fields import check_plain
from particles.integrators import RK4
from particles.limits import limit_of
from particles.lists import outside
from particles.method import Leaps
from particles.plan import Plan, Run
from particles.threads import Threads

#: fractions of the step limit: stable for moving particles at random places; used by the studies
RANDOM, STUDIES = 1/1.4, 0.22


class Divergence(FloatingPointError):
    """The state of a run was not finite or not valid any more at `step`."""
    step: int

    def __init__(self, step: int, message: str):
        super().__init__(message)
        self.step = step


class Interrupt:
    """Delay Ctrl-C to the end of a step, so that the checkpoint is complete; a second Ctrl-C acts at once."""
    times = 0

    def __enter__(self) -> "Interrupt":
        if current_thread() is main_thread() and getsignal(SIGINT) is default_int_handler:
            signal(SIGINT, self.note)
        return self

    def note(self, number: int, frame: Any) -> None:
        self.times += 1
        if self.times > 1:
            raise KeyboardInterrupt

    def __exit__(self, *error: object) -> None:
        if getsignal(SIGINT) == self.note:
            signal(SIGINT, default_int_handler)


def run(method: Any, start: ArrayLike, plan: Plan, progress: Callable[[float], None] | None = None) -> Run:
    """Advance `start`, array-like (fields, n), by the plan; `progress` is called with the fraction done.

    Raises ValueError: the step is above the stability limit, the start is invalid, or the checkpoint is of
    another run. Divergence: a field is not finite or not valid; names step, time, field and particle.
    """
    start = _particles(method, start)
    _check_start(method, start, plan)
    threads = Threads(plan.threads)
    now = load(plan.checkpoint, method, plan, start) or Run(state=start.copy(), ids=np.arange(start.shape[1]))
    sums, integrator = (method.start(start.shape[1], threads),
                        getattr(method, "integrator", RK4)(start.shape, threads))
    sums.resume(now)
    before = process_time()
    sums.try_out(now)       # loads or compiles most code
    began, saved = process_time(), monotonic()
    now.compile_s += began - before
    with Interrupt() as interrupt, compiling() as late:
        try:
            while now.step < plan.steps:
                _advance(method, plan, sums, integrator, now)
                if progress is not None and (now.step % 16 == 0 or isinstance(integrator, Leaps)):
                    progress(now.step/plan.steps)
                if interrupt.times:
                    raise KeyboardInterrupt
                if plan.checkpoint is not None and monotonic() - saved > plan.checkpoint_seconds:
                    now.cpu_s, began = now.cpu_s + process_time() - began, process_time()
                    _keep(method, plan, start, sums, now)
                    saved = monotonic()
        except KeyboardInterrupt:
            if interrupt.times < 2:
                _keep(method, plan, start, sums, now)
            raise
    now.cpu_s += process_time() - began - late.seconds
    now.compile_s += late.seconds
    return now


def _keep(method, plan: Plan, start: np.ndarray, sums, now: Run) -> None:
    if plan.checkpoint is not None:
        sums.mark(now)
        save(plan.checkpoint, method, plan, start, now)


def _advance(method, plan: Plan, sums, integrator, now: Run) -> None:
    to_record = min(plan.every - now.step % plan.every, plan.steps - now.step)
    more = (min(to_record, integrator.most),) if isinstance(integrator, Leaps) else ()
    try:
        sums.make_ready(now, plan.dt)
        integrator.step(sums, now.state, plan.dt, *more)
    except FloatingPointError as error:
        message = f"diverged at step {now.step}, time {now.step*plan.dt:g}: {error}; {_way_out(plan)}"
        raise Divergence(now.step, message) from error
    now.reflections += sums.confine(now.state)
    now.step += sum(more) or 1
    _check(method, plan, sums, now)
    if now.step % plan.every == 0:
        _record(plan, sums, now)


def _record(plan: Plan, sums, now: Run) -> None:
    sums.look_at(now.state)
    now.times.append(now.step*plan.dt)
    for name, quantity in plan.series.items():
        now.series.setdefault(name, []).append(float(quantity(sums, now.state)))
    if now.times[-1] > plan.mean_from:
        now.samples += 1
        for name, quantity in plan.means.items():
            now.sums[name] = now.sums.get(name, 0.0) + np.asarray(quantity(sums, now.state))


def _particles(method, start: ArrayLike) -> np.ndarray:
    """The start as an array (fields, n) of float64."""
    check_plain("particles", start)
    state = np.asarray(start, float)
    if state.ndim != 2 or state.shape[0] != len(method.names) or state.shape[1] < 1:
        raise ValueError(f"particles are an array ({len(method.names)}, n) of {', '.join(method.names)} with "
                         f"n >= 1, got {state.shape}")
    return state


def _check_start(method, start: np.ndarray, plan: Plan) -> None:
    if not np.isfinite(start).all():
        raise ValueError("the particles at the start are not finite: " + _where(method, start))
    walls = getattr(method, "walls", None)      # a method on fixed points has none
    if walls is not None and len(lost := outside(walls, start, method.box)):
        i, (width, height) = lost[0], method.box
        raise ValueError(f"particle {i} at ({start[0, i]:g}, {start[1, i]:g}) is beyond a wall of the box "
                         f"|x| <= {width/2:g}, |y| <= {height/2:g} ({len(lost)} of {start.shape[1]} are): "
                         "the box is centred on the origin; move them inside")
    limit = _limit(method, start)
    if plan.dt > limit:
        usual = ": take at most that, or leave dt out" if walls is None else (
            f" for these particles, {RANDOM*limit:.2g} where they lie at random; the studies take "
            f"{STUDIES*limit:.2g}, because errors at plates grow with dt")
        raise ValueError(f"dt = {plan.dt:g} is above the stability limit {limit:.3g}{usual}")


def _limit(method, start: np.ndarray) -> float:
    """The stability limit of the time step. Raises ValueError: the start has none."""
    try:
        limit = limit_of(method, start)
    except FloatingPointError as error:
        raise ValueError(f"the particles at the start are no fluid: {error}") from error
    if not limit > 0:
        raise ValueError(f"the particles at the start have no stable step: the limit is {limit}; look "
                         "for densities, temperatures or viscosities that are not positive and finite")
    return limit


def _where(method, state: np.ndarray, ids: np.ndarray | None = None) -> str:
    row, i = np.argwhere(~np.isfinite(state))[0]
    return f"{method.names[row]} = {state[row, i]} of particle {i if ids is None else ids[i]}"


def _way_out(plan: Plan) -> str:
    kept = "" if plan.checkpoint is None else "; the last checkpoint is kept"
    return f"halve dt = {plan.dt:g}, or start from a smoother state{kept}"


def _check(method, plan: Plan, sums, now: Run) -> None:
    """Raise Divergence if the state is not finite, or if the method finds a fault in it."""
    finite = np.isfinite(now.state).all()
    fault = sums.fault(now.state, now.ids) if finite else _where(method, now.state, now.ids)
    if fault:
        when = f"step {now.step}, time {now.step*plan.dt:g}"
        told = f"at {when} {fault}" if finite else f"diverged at {when}: {fault}"
        raise Divergence(now.step, f"{told}; {_way_out(plan)}")
