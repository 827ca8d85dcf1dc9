"""Time steps, shared by all methods."""
from collections.abc import Callable

import numpy as np

from continuum.jit import jit
from particles.team import Team


@jit
def _stage(first, last, y, k, total, stage, weight, forward):
    for i in range(first, last):
        total[i] += weight*k[i]
        stage[i] = y[i] + forward*k[i]


class RK4:
    """Classical fourth-order Runge-Kutta    [KHP95, Sec. II]"""
    evaluations = 4

    def __init__(self, shape: tuple[int, ...], team: Team):
        self._k, self._total, self._next = (np.empty(shape) for _ in range(3))
        self._team = team

    def step(self, rates: Callable[[np.ndarray, np.ndarray], None], y: np.ndarray, dt: float) -> None:
        """Advance y in place by dt; rates(y, out) writes dy/dt."""
        k, total, stage = self._k, self._total, self._next
        total[:] = 0
        stage[:] = y
        for weight, forward in ((1/6, dt/2), (1/3, dt/2), (1/3, dt), (1/6, 0.0)):
            rates(stage, k)
            self._team(_stage, y.size, y.ravel(), k.ravel(), total.ravel(), stage.ravel(), weight, forward)
        total *= dt
        y += total
