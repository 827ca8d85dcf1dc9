"""What py-pde calls while it solves: rates; a tracker that records, checks and stops; Runge-Kutta steps."""
from collections.abc import Callable
from typing import Any, ClassVar

import numpy as np

from continuum.gas.solve import DivergedError
from continuum.jit import generic, jit

# continuum.jit comes before everything that loads numba
# isort: split
from pde import FieldCollection, PDEBase, ScalarField
from pde.solvers.base import SolverBase
from pde.trackers import ConstantInterrupts, FinishedSimulation
from pde.trackers.base import TrackerBase

Until = Any             # Steady or Time of continuum.steady
Progress = Callable[[float], None]


class Equation(PDEBase):
    """An equation of py-pde with compiled rates: `rates` of its `loop`. names : of the fields of a state."""

    explicit_time_dependence = False
    names: ClassVar[tuple[str, ...]]
    grid: Any
    loop: Any

    def evolution_rate(self, state: Any, t: float = 0) -> Any:
        """The rates for py-pde's own steppers."""
        return self.state(rate(self.loop, np.ascontiguousarray(state.data)))

    def state(self, data: np.ndarray) -> FieldCollection:
        """Fields of py-pde from an array (fields, columns, rows)."""
        return FieldCollection([ScalarField(self.grid, f) for f in data], labels=list(self.names))


class Watch(TrackerBase):
    """Records t, K, Nu, mass; checks the state; reports progress; ends the run when its rule says so."""

    def __init__(self, equation: Any, until: Until, interval: float, dt: float, progress: Progress | None):
        super().__init__(interrupts=ConstantInterrupts(interval))
        self.equation, self.until, self.dt, self.progress = equation, until, dt, progress
        self.samples: list[tuple[float, float, float, float]] = []

    @property
    def ke(self) -> list[float]:
        return [s[1] for s in self.samples]

    def handle(self, field: Any, t: float) -> None:
        """Called by py-pde at every sample."""
        if trouble := self.equation.trouble(field.data):
            raise DivergedError(f"diverged before t = {t:.6g} (step {round(t/self.dt)}, dt = {self.dt:.4g}): "
                                f"{trouble}; take more rows (thinner cells) or a smaller dt")
        self.samples.append((t, *self.equation.measure(field.data)))
        if self.progress:
            self.progress(self.until.fraction(self.ke))
        if self.until.done(self.ke):
            raise FinishedSimulation("rule to stop is met")


class StageLoop(SolverBase):
    """Classical Runge-Kutta in a loop kept on disk: what py-pde makes compiles at every call."""

    name = "runge-kutta stage loop"
    pde: Equation

    def _make_inner_stepper(self, state: Any) -> Callable:
        loop, dt = self.pde.loop, self.info["dt"]
        steps(loop, state.data, dt, 0)      # compiles it: py-pde counts that apart

        def stepper(data, t_start, t_end):
            count = max(1, round((t_end - t_start)/dt))
            steps(loop, data, dt, count)
            self.info["steps"] += count
            return t_start + count*dt

        return stepper


@generic
def rates(loop, data, out):
    """Write d/dt of the state `data`; `loop` holds the numbers of an equation, its type says which one."""


@jit
def rate(loop, data):
    """d/dt of the state, a new array."""
    out = np.empty_like(data)
    rates(loop, data, out)
    return out


@jit
def steps(loop, data, dt, count):
    """`count` steps of classical Runge-Kutta, in place."""
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
