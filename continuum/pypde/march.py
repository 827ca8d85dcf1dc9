"""What py-pde calls while it solves: compiled rates; a tracker that records, checks and stops; the step."""
from collections.abc import Callable
from typing import Any, ClassVar

import numpy as np

from continuum.gas.solve import DivergedError
from continuum.jit import jit

# continuum.jit comes before everything that loads numba
# isort: split
from pde import FieldCollection, PDEBase, ScalarField
from pde.solvers import RungeKuttaSolver
from pde.trackers import ConstantInterrupts, FinishedSimulation
from pde.trackers.base import TrackerBase

Until = Any             # Steady or Time of continuum.steady
Progress = Callable[[float], None]


class Equation(PDEBase):
    """An equation of py-pde whose rates are compiled here: rates(*laws, data, full, out).

    names : of the fields of `data` (fields, columns, rows). scratch : fields of `full`, with ghosts.
    """

    explicit_time_dependence = False
    names: ClassVar[tuple[str, ...]]
    scratch: ClassVar[int]
    grid: Any
    rates: Callable
    laws: tuple

    def room(self) -> np.ndarray:
        """For `full`."""
        return np.empty((self.scratch, *(n + 2 for n in self.grid.shape)))

    def make_evolution_rate(self, state: Any, backend: Any) -> Callable:
        """The rates for py-pde's compiled steppers."""
        rates, laws, shape = self.rates, self.laws, self.room().shape

        def rate(data, t):
            full, out = np.empty(shape), np.empty_like(data)
            rates(*laws, data, full, out)
            return out

        return rate

    def evolution_rate(self, state: Any, t: float = 0) -> Any:
        """The same for py-pde's fields."""
        return self.state(self.make_evolution_rate(state, None)(np.ascontiguousarray(state.data), t))

    def state(self, data: np.ndarray) -> FieldCollection:
        """Fields of py-pde from an array."""
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


class StageLoop(RungeKuttaSolver):
    """Classical Runge-Kutta with a loop over the stages: py-pde's own takes 15 s to compile instead of 4."""

    name = "runge-kutta stage loop"

    def _make_single_step_fixed_dt(self, state: Any, dt: float) -> Callable:
        rate = self.backend.make_pde_rhs(self.pde, state)

        def single_step(data, t):
            total, stage = data.copy(), data.copy()
            for to_stage, weight in ((0.5, 1/6), (0.5, 1/3), (1.0, 1/3), (0.0, 1/6)):
                advance(data, rate(stage, t), dt*to_stage, dt*weight, stage, total)
            data[:] = total
            return data

        return single_step


@jit
def advance(data, rate, to_stage, weight, stage, total):
    """stage = data + to_stage rate; total += weight rate"""
    for f in range(data.shape[0]):
        for i in range(data.shape[1]):
            for j in range(data.shape[2]):
                total[f, i, j] += weight*rate[f, i, j]
                stage[f, i, j] = data[f, i, j] + to_stage*rate[f, i, j]
