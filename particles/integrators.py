"""Time integrators that all methods share."""
from typing import Any

import numpy as np

from continuum.jit import jit
from particles.neighbours import u64
from particles.threads import Threads


@jit
def _stage(first, last, y, k, total, stage, weight, forward):
    for i in range(u64(first), u64(last)):
        total[i] += weight*k[i]
        stage[i] = y[i] + forward*k[i]


class RK4:
    """Classical fourth-order Runge-Kutta    [KHP95, Sec. II]"""
    evaluations = 4

    def __init__(self, shape: tuple[int, ...], threads: Threads):
        self._k, self._total, self._next = (np.empty(shape) for _ in range(3))
        self._threads = threads

    def step(self, sums: Any, y: np.ndarray, dt: float) -> None:
        """Advance y in place by dt; sums.rates(y, out) writes dy/dt."""
        k, total, stage = self._k, self._total, self._next
        total[:] = 0
        stage[:] = y
        flat = [q.ravel() for q in (y, k, total, stage)]
        for weight, forward in ((1/6, dt/2), (1/3, dt/2), (1/3, dt), (1/6, 0.0)):
            sums.rates(stage, k)
            self._threads(_stage, y.size, *flat, weight, forward)
        total *= dt
        y += total


class Euler:
    """Forward Euler for all rows of a state    [RR98 Eq. 40]"""
    evaluations = 1

    def __init__(self, shape: tuple[int, ...], threads: Threads):
        self._k = np.empty(shape)

    def step(self, sums: Any, y: np.ndarray, dt: float) -> None:
        sums.rates(y, self._k)
        y += dt*self._k


class TwoStep(Euler):
    """Forward Euler for the fields, then for positions with the new velocities    [RR98 Eqs 40, 41]

    sums.places : number of leading rows of a state that are positions; sums.velocity(y) : their rates. Points
    that stay have neither; this integrator is then `Euler`.
    """

    def step(self, sums: Any, y: np.ndarray, dt: float) -> None:
        places = getattr(sums, "places", 0)
        sums.rates(y, self._k)
        y[places:] += dt*self._k[places:]
        if places:
            y[:places] += dt*sums.velocity(y)
