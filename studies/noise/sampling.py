"""Linear systems with noise in time, and averages with honest intervals.

Each average is made of 20 batches, each ten decay times of the slowest mode or longer, started where the one
before ended: their scatter, with its t factor, is the error.
"""
from dataclasses import dataclass, replace
from math import inf
from typing import Any

import numpy as np
from scipy import sparse

from particles.integral.fixed import Summing, check_number
from particles.limits import limit_of
from particles.noise import fill_normals
from particles.run import Plan, Run, run
from particles.threads import Team
from studies.kit.case import Report

BATCHES = 20
DECAYS = 10         # of the slowest mode, at least, in a batch


class CrankNicolson:
    """(1 - dt J/2) y' = (1 + dt J/2) y + kick, with sums.J (N, N) and sums.kick(y, dt): exact at any step."""
    evaluations = 1

    def __init__(self, shape: tuple[int, ...], team: Team):
        self._made: tuple[float, np.ndarray, np.ndarray] = (0.0, np.empty(0), np.empty(0))

    def step(self, sums: Any, y: np.ndarray, dt: float) -> None:
        """Advance y in place by dt."""
        if self._made[0] != dt:
            one = np.eye(len(sums.J))
            inverse = np.linalg.inv(one - dt/2*sums.J)
            self._made = (dt, inverse@(one + dt/2*sums.J), inverse)
        _, A, inverse = self._made
        new = A@y.ravel() + inverse@sums.kick(y, dt)
        y[:] = new.reshape(y.shape)


@dataclass(frozen=True, kw_only=True, eq=False)
class Linear:
    """dx = J x dt + B dW of a state (names, n), J (N, N), B (N, normals). modes (m, N): what is measured."""
    J: np.ndarray
    B: sparse.csr_array
    seed: int
    modes: np.ndarray
    names: tuple[str, ...]
    integrator = CrankNicolson

    def __repr__(self) -> str:
        sizes = float(np.abs(self.J).sum()), float(abs(self.B).sum())
        return f"Linear({sizes[0]!r}, {sizes[1]!r}, {self.seed}, {len(self.modes)})"

    def start(self, n: int, team: Team) -> "Sampled":
        check_number(n, len(self.J)//len(self.names))
        return Sampled(self)


class Sampled(Summing):
    """Kicks of a linear system, and its modes."""

    def __init__(self, method: Linear):
        self.method, self.J = method, method.J
        self.normals = np.empty((-(-method.B.shape[1]//4), 4))

    def rates(self, state: np.ndarray, out: np.ndarray) -> None:
        out[:] = (self.J@state.ravel()).reshape(state.shape)

    def make_ready(self, now: Any, dt: float) -> None:
        """Random numbers of the coming step."""
        fill_normals(0, len(self.normals), self.method.seed, now.step, self.normals)

    def kick(self, y: np.ndarray, dt: float) -> np.ndarray:
        """B dW."""
        normals = self.normals.ravel()[:self.method.B.shape[1]]
        return np.sqrt(dt)*(self.method.B@normals)

    def look_at(self, state: np.ndarray) -> None:
        self.found = self.method.modes@state.ravel()

    def fault(self, state: np.ndarray, ids: np.ndarray) -> str:
        return ""


@limit_of.register
def _(method: Linear, start: np.ndarray) -> float:
    """Crank-Nicolson has none."""
    return inf


def squares(sums: Sampled, state: np.ndarray) -> np.ndarray:
    """Of all modes."""
    return sums.found**2


def batches(method: Any, state: np.ndarray, plan: Plan, report: Report, count: int = BATCHES) -> list[Run]:
    """Runs that go on where the one before ended, each with noise of its own seed."""
    legs = list[Run]()
    for number in range(count):
        legs.append(run(replace(method, seed=1000*method.seed + number), state, plan))
        state = legs[-1].state
        report((number + 1)/count)
    return legs


def check_length(J: np.ndarray, time: float) -> None:
    """Refuse batches shorter than DECAYS decay times of the slowest mode that is not conserved.

    Raises
    ------
    ValueError
        They are.
    """
    rates = -np.linalg.eigvals(J).real
    slow = float(rates[rates > 1e-9*rates.max()].min())
    if time*slow < DECAYS:
        raise ValueError(f"a batch of {time:.4g} is {time*slow:.3g} decay times of the slowest mode, less "
                         f"than {DECAYS}: batches would be correlated; take {DECAYS/slow:.4g} or longer")
