"""Solver of the compressible gas with py-pde.

    solve(Gas(RayleighBenard(ra=1e4), rows=32), until=Time(100))

It is of second order in space; unknowns and their places differ from those of the other grids here.
"""
from collections.abc import Callable
from dataclasses import dataclass, field
from math import inf
from typing import Any

import numpy as np
from pde.solvers.base import SolverBase
from pde.trackers import CallbackTracker, ConstantInterrupts, FinishedSimulation
from scipy.interpolate import RectBivariateSpline

from continuum.gas.solve import DivergedError
from continuum.jit import jit
from continuum.pypde.gas_loop import VY, rate
from continuum.steady import STILL, GridRun, Steady, of_samples, steps_between


def watch(state: Any, t: float, equation: Any, until: Any, dt: float, samples: list,
          progress: Callable | None) -> None:
    """Check a state, append its t, K, Nu, mass to the samples, report progress, end the run by its rule."""
    if trouble := equation.trouble(state.data):
        raise DivergedError(f"diverged before t = {t:.6g} (step {round(t/dt)}, dt = {dt:.4g}): {trouble}; "
                            "take more rows (thinner cells) or a smaller dt")
    samples.append((t, *equation.measure(state.data)))
    ke = [sample[1] for sample in samples]
    if progress:
        progress(until.fraction(ke))
    if until.done(ke):
        raise FinishedSimulation("rule to stop is met")


class StageLoop(SolverBase):
    """Classical Runge-Kutta in a compiled loop cached on disk; py-pde's own compiles at every call."""

    name = "runge-kutta stage loop"
    pde: Any

    def _make_inner_stepper(self, state: Any) -> Callable:
        loop, dt = self.pde.loop, self.info["dt"]
        steps(loop, state.data, dt, 0)      # compiles the loop: py-pde times this separately

        def stepper(data, t_start, t_end):
            count = max(1, round((t_end - t_start)/dt))
            steps(loop, data, dt, count)
            self.info["steps"] += count
            return t_start + count*dt

        return stepper


@jit
def steps(loop, data, dt, count):
    """Make `count` steps of classical Runge-Kutta, in place."""
    for _ in range(count):
        total, stage = data.copy(), data.copy()
        for to_stage, weight in ((0.5, 1/6), (0.5, 1/3), (1.0, 1/3), (0.0, 1/6)):
            advance(data, rate(loop, stage), dt*to_stage, dt*weight, stage, total)
        data[:] = total


@jit
def advance(data, rate, to_stage, weight, stage, total):
    """stage = data + to_stage rate; total += weight rate"""
    for f in range(data.shape[0]):
        for i in range(data.shape[1]):
            for j in range(data.shape[2]):
                total[f, i, j] += weight*rate[f, i, j]
                stage[f, i, j] = data[f, i, j] + to_stage*rate[f, i, j]


@dataclass(frozen=True, kw_only=True)
class PdeSolution(GridRun):
    """Result of a run, in units of the scene; nusselt : of the lower and of the upper plate."""
    equation: Any
    state: np.ndarray = field(repr=False)
    nusselt: tuple[float, float]

    @property
    def nu(self) -> float:
        """Mean of the Nusselt numbers of both plates."""
        return sum(self.nusselt)/2


def solve(equation: Any, *, until: Any = Steady(), start: PdeSolution | np.ndarray | None = None,  # noqa: B008
          dt: float | None = None, progress: Callable[[float], None] | None = None) -> PdeSolution:
    """Solve an equation, an object of `Gas`.

    until : Steady(rtol=...) or Time(t_end) of `continuum.steady`.
    start : a solution in the same box on any grid, or a state (fields, columns, rows); by default rolls.
    dt : largest step (by default 0.8 of the stability limit); the one taken divides the time between samples.
    progress : called with the fraction done.
    Raises ValueError: dt above the stability limit; a start from another box. DivergedError: when and where.
    """
    data = onto(equation, start) if isinstance(start, PdeSolution) else (
        equation.rolls() if start is None else start.copy())
    interval = until.interval(equation.scene)
    step = interval/steps_between(interval, equation.step_limit(), dt)
    samples: list[tuple[float, float, float, float]] = []
    tracker = CallbackTracker(lambda state, t: watch(state, t, equation, until, step, samples, progress),
                              ConstantInterrupts(interval))
    try:
        state, info = equation.solve(equation.state(data), t_range=inf, dt=step, tracker=[tracker],
                                     solver=StageLoop, backend="numpy", ret_info=True)
    finally:
        # py-pde treats Ctrl-C as a regular end
        if equation.diagnostics.get("controller", {}).get("stop_reason") == "User interrupted simulation":
            raise KeyboardInterrupt
    seconds, solver = info["controller"]["profiler"], info["solver"]
    along = state.data[VY, :, equation.rows//2 - 1]
    return PdeSolution(
        equation=equation, state=state.data.copy(), nusselt=equation.nusselt(state.data),
        rolls=0 if samples[-1][1] < STILL else count_rolls(along), dt=solver["dt"], steps=solver["steps"],
        cpu_s=seconds["solver"] + seconds["tracker"], compile_s=seconds["compilation"],
        **of_samples(until, samples))


def count_rolls(v: np.ndarray) -> int:
    """Number of rolls: changes of sign of v_y along mid-height, where it is above 5 % of its largest."""
    up = v[np.abs(v) > 0.05*np.abs(v).max()] > 0
    return int(np.sum(up != np.roll(up, 1)))


def onto(equation: Any, start: PdeSolution) -> np.ndarray:
    """State of a solution on another grid, by cubic splines through its values and ghosts."""
    old = start.equation
    here, box = old.grid.axes_bounds, equation.grid.axes_bounds
    if not np.allclose(here, box):
        raise ValueError(f"start is in a box {here}, the equation in {box}: start from rolls or from the "
                         "same box")
    parts = []
    for n, f in enumerate(old.padded(start.state)[:len(start.state)]):
        (a, b), (x, y) = old.points(n), equation.points(n)
        parts.append(RectBivariateSpline(a, b, f)(x[1:-1], y[1:-1]))
    return equation.repaired(np.array(parts))
