"""Convection solved with py-pde: the Boussinesq layer and the compressible gas, one driver for both.

    solve_gas(RayleighBenard(ra=1e4), rows=32)
    solve_boussinesq(ra=5000, pr=7, rows=32, until=Time(100), start=Rolls(ke=1e-6))

Second order in space, different from the other grids here in unknowns and placing.
"""
import math
from dataclasses import dataclass, field
from typing import Any, NamedTuple

import numpy as np
from scipy.interpolate import RectBivariateSpline

from continuum.gas.solve import Series
from continuum.pypde.boussinesq import Boussinesq
from continuum.pypde.gas import Gas
from continuum.pypde.march import Progress, StageLoop, Until, Watch
from continuum.scene import RayleighBenard
from continuum.steady import Steady, choose_step

STILL = 1e-12           # K of a fluid at rest


class Rolls(NamedTuple):
    """A start: rolls of kinetic energy `ke` per mass, `number` of them along x (default: the width)."""
    ke: float = 0.0018
    number: int | None = None


class PdeNusselt(NamedTuple):
    """Heat per conduction: in at the bottom, out at the top, upwards on average over the volume."""
    bottom: float
    top: float
    volume: float


@dataclass(frozen=True, kw_only=True)
class PdeSolution:
    """What a run ended with.

    `ke`, `ke_err` as of `gas.solve.Solution`, in free-fall units for the Boussinesq layer and in those of the
    scene for the gas.
    """
    equation: Boussinesq | Gas
    state: np.ndarray = field(repr=False)
    t: float
    series: Series = field(repr=False)
    ke: float
    ke_err: float
    nusselt: PdeNusselt
    rolls: int
    mass_drift: float
    converged: bool
    dt: float
    steps: int
    cpu_s: float
    compile_s: float

    @property
    def ra(self) -> float:
        return self.equation.ra

    @property
    def pr(self) -> float:
        return self.equation.pr

    @property
    def rows(self) -> int:
        return self.equation.rows

    @property
    def nu(self) -> float:
        """Mean Nusselt number of the two plates."""
        return (self.nusselt.bottom + self.nusselt.top)/2

    @property
    def fields(self) -> dict[str, np.ndarray]:
        """x, y and the fields at common points, each (columns, rows of points)."""
        return self.equation.fields(self.state)


def solve_boussinesq(*, ra: float, pr: float, rows: int, aspect: float = 2.0, **options) -> PdeSolution:
    """Boussinesq convection between rigid plates on `rows` rows, periodic in x; options of `solve`."""
    return solve(Boussinesq(ra=ra, pr=pr, rows=rows, aspect=aspect), **options)


def solve_gas(scene: RayleighBenard, rows: int, **options) -> PdeSolution:
    """The compressible fluid of a scene, periodic in x, on `rows` rows; options of `solve`."""
    return solve(Gas(scene, rows), **options)


def solve(equation: Any, *, until: Until = Steady(), start: Rolls | PdeSolution | np.ndarray = Rolls(),  # noqa: B008
          dt: float | None = None, progress: Progress | None = None) -> PdeSolution:
    """Solve an equation: Boussinesq or Gas.

    until : Steady(rtol=...) or Time(t_end) of `continuum.steady`.
    start : Rolls(ke, number), a solution of the same box on any grid, or a state (fields, columns, rows).
    dt : largest step (by default 0.8 of the stability limit); the one taken divides the time between samples.
    progress : called with the fraction done.
    Raises ValueError: dt above the stability limit; a start from another box. DivergedError: when and where.
    """
    data = start_of(equation, start)
    interval = until.interval(equation)
    count = math.ceil(interval/choose_step(equation.step_limit(), dt)*(1 - 1e-12))
    watch = Watch(equation, until, interval, interval/count, progress)
    try:
        state, info = equation.solve(equation.state(data), t_range=math.inf, dt=interval/count,
                                     tracker=[watch], solver=StageLoop, backend="numpy", ret_info=True)
    finally:
        restore_interrupt(equation)
    return finish(equation, watch, state.data, info)


def start_of(equation: Any, start: Rolls | PdeSolution | np.ndarray) -> np.ndarray:
    """The state that a run begins with."""
    if isinstance(start, np.ndarray):
        return start.copy()
    data: np.ndarray = equation.rolls(*start) if isinstance(start, Rolls) else onto(equation, start)
    return data


def restore_interrupt(equation: Any) -> None:
    """py-pde takes Ctrl-C for an early end and returns the state: make it an interrupt again."""
    if equation.diagnostics.get("controller", {}).get("stop_reason") == "User interrupted simulation":
        raise KeyboardInterrupt


def finish(equation: Any, watch: Watch, data: np.ndarray, info: dict) -> PdeSolution:
    """What the run measured and what it cost."""
    ke, ke_err = watch.until.estimate(watch.ke)
    series = Series(*np.array(watch.samples).T)
    seconds = info["controller"]["profiler"]
    v = equation.rising(data)
    return PdeSolution(
        equation=equation, state=data.copy(), t=watch.samples[-1][0], series=series, ke=ke, ke_err=ke_err,
        nusselt=PdeNusselt(*equation.nusselt(data)), rolls=0 if watch.ke[-1] < STILL else count_rolls(v),
        mass_drift=series.mass[-1]/series.mass[0] - 1, converged=watch.until.settled(watch.ke),
        dt=info["solver"]["dt"], steps=info["solver"]["steps"], cpu_s=seconds["solver"] + seconds["tracker"],
        compile_s=seconds["compilation"])


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
