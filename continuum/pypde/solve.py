"""Convection solved with py-pde: the Boussinesq layer and the compressible gas, one driver for both.

    solve(Gas(RayleighBenard(ra=1e4), rows=32))
    solve(Boussinesq(ra=5000, pr=7, rows=32), until=Time(100))

Second order in space, different from the other grids here in unknowns and placing.
"""
from dataclasses import dataclass, field
from math import inf
from typing import Any

import numpy as np
from scipy.interpolate import RectBivariateSpline

from continuum.pypde.boussinesq import Boussinesq
from continuum.pypde.gas import Gas
from continuum.pypde.march import Progress, StageLoop, Until, Watch
from continuum.steady import STILL, GridRun, Steady, of_samples, steps_between


@dataclass(frozen=True, kw_only=True)
class PdeSolution(GridRun):
    """What a run ended with, in free-fall units for the Boussinesq layer, in those of the scene for the gas.

    nusselt : of the lower and of the upper plate.
    """
    equation: Boussinesq | Gas
    state: np.ndarray = field(repr=False)
    nusselt: tuple[float, float]

    @property
    def nu(self) -> float:
        """Mean Nusselt number of the two plates."""
        return sum(self.nusselt)/2


def solve(equation: Any, *, until: Until = Steady(), start: PdeSolution | np.ndarray | None = None,  # noqa: B008
          dt: float | None = None, progress: Progress | None = None) -> PdeSolution:
    """Solve an equation: Boussinesq or Gas.

    until : Steady(rtol=...) or Time(t_end) of `continuum.steady`.
    start : a solution of the same box on any grid, or a state (fields, columns, rows); KHP95's rolls if none.
    dt : largest step (by default 0.8 of the stability limit); the one taken divides the time between samples.
    progress : called with the fraction done.
    Raises ValueError: dt above the stability limit; a start from another box. DivergedError: when and where.
    """
    data = onto(equation, start) if isinstance(start, PdeSolution) else (
        equation.rolls() if start is None else start.copy())
    interval = until.interval(equation)
    step = interval/steps_between(interval, equation.step_limit(), dt)
    watch = Watch(equation, until, interval, step, progress)
    try:
        state, info = equation.solve(equation.state(data), t_range=inf, dt=step, tracker=[watch],
                                     solver=StageLoop, backend="numpy", ret_info=True)
    finally:
        restore_interrupt(equation)
    return finish(equation, watch, state.data, info)


def restore_interrupt(equation: Any) -> None:
    """py-pde takes Ctrl-C for an early end and returns the state: make it an interrupt again."""
    if equation.diagnostics.get("controller", {}).get("stop_reason") == "User interrupted simulation":
        raise KeyboardInterrupt


def finish(equation: Any, watch: Watch, data: np.ndarray, info: dict) -> PdeSolution:
    """What the run measured and what it cost."""
    seconds, solver = info["controller"]["profiler"], info["solver"]
    return PdeSolution(
        equation=equation, state=data.copy(), nusselt=equation.nusselt(data),
        rolls=0 if watch.ke[-1] < STILL else count_rolls(equation.rising(data)), dt=solver["dt"],
        steps=solver["steps"], cpu_s=seconds["solver"] + seconds["tracker"], compile_s=seconds["compilation"],
        **of_samples(watch.until, watch.samples))


def count_rolls(v: np.ndarray) -> int:
    """Changes of sign of the vertical velocity along mid-height; below 5 % of its largest it is zero."""
    up = v[np.abs(v) > 0.05*np.abs(v).max()] > 0
    return int(np.sum(up != np.roll(up, 1)))


def onto(equation: Any, start: PdeSolution) -> np.ndarray:
    """The state of a solution on another grid: cubic splines through its points and ghosts."""
    old = start.equation
    if type(old) is not type(equation) or not np.allclose(old.grid_box, equation.grid_box):
        raise ValueError(f"start is a {type(old).__name__} in a box {old.grid_box}, the equation a "
                         f"{type(equation).__name__} in {equation.grid_box}: start from rolls or from the "
                         "same box")
    parts = []
    for n, f in enumerate(old.padded(start.state)[:len(start.state)]):
        x, y = equation.points(n)
        parts.append(RectBivariateSpline(*old.points(n), f)(x[1:-1], y[1:-1]))
    return equation.repaired(np.array(parts))
