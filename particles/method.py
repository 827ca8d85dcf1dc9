"""The contract of a method, and the parts of it that a method of one's own inherits.

A method is made for a scene and does not change; `start` gives its sums, which a run steps. The smallest one
inherits `LatticeRates` and has `rates`. One with other states or places inherits `OwnRates`, takes a scene,
and has `names`, `state`, `fields`, `rates`; a code with steps of its own inherits `Stepping` and has
`advance` and `limit` in place of `rates`. Units are the scene's: lengths in spacings, mean density 1.
"""
from functools import cached_property
from typing import Any, ClassVar, Protocol, runtime_checkable

import numpy as np

from continuum.fluid import Fields
from particles.fields import from_densities
from particles.integral.dih import densities
from particles.integral.points import lattice
from particles.threads import Threads


@runtime_checkable
class Method(Protocol):
    """What a run asks of a method.

    eos : equation of state. names : of the rows of a state. Optional: integrator(shape, threads) with
    `step(sums, state, dt)`, RK4 by default; box and walls of points that move; limit(start), the longest
    stable step, which is found by trial where neither it nor a formula is there (`particles.limits`);
    state(rho, v, T), (rows, n) of density (n,), velocity (n, 2), temperature (n,) at the method's own places
    `x` (n, 2), or state(x, rho, v, T) of a method without `x`, for `studies.build.ready`.
    """
    eos: Any
    names: Any

    def fields(self, state: np.ndarray) -> Fields:
        """Places (m, 2), velocities (m, 2), density, temperature, volume (m,) of a state (rows, n)."""

    def start(self, n: int, threads: Threads) -> Any:
        """Sums for a state of n points. Raises ValueError: it cannot take so many."""


@runtime_checkable
class Sums(Protocol):
    """What a run and its integrator ask of the sums of a method; points that stay write `rates` alone."""
    method: Any

    def rates(self, state: np.ndarray, out: np.ndarray) -> None:
        """d(state)/dt of a state (rows, n), all of it written to `out`."""
        raise TypeError(f"{type(self).__name__} has no rates(state, out): write one that puts d(state)/dt "
                        "into out, or inherit Stepping")

    def look_at(self, state: np.ndarray) -> Any:
        """Called before series of a run read a state."""
        return None

    def resume(self, now: Any) -> None:
        """Be as an interrupted run `now` (`particles.plan.Run`) was; called once, before all else."""
        return None

    def try_out(self, now: Any) -> None:
        """Load or compile all code, and leave no trace in the run. ValueError: it starts wrongly."""
        self.rates(now.state, np.empty_like(now.state))

    def make_ready(self, now: Any, dt: float) -> None:
        """Called before a step; may sort `now.state` and `now.ids`. FloatingPointError: it cannot go on."""
        return None

    def mark(self, now: Any) -> None:
        """Put into a run what a restart needs besides its state, before it is saved."""
        return None

    def confine(self, state: np.ndarray) -> int:
        """Bring back what has left through walls, after a step; the number of reflections."""
        return 0

    def fault(self, state: np.ndarray, ids: np.ndarray) -> str:
        """What is wrong with a finite state after a step; here a density or temperature that is not positive,
        nan being none at all. Empty if nothing is."""
        at = self.method.fields(state)
        bad = np.flatnonzero((at.rho <= 0) | (at.T <= 0))
        if not len(bad):
            return ""
        i = bad[0]
        return f"point {ids[i]} has rho = {at.rho[i]:.6g}, T = {at.T[i]:.6g}, which must be positive"


class OwnRates(Sums):
    """A method of one's own that is its own sums: inherit it, write `names`, `state`, `fields`, `rates`."""
    names: Any

    def __init__(self, scene: Any):
        self.scene, self.eos, self.method = scene, scene.eos, self

    def start(self, n: int, threads: Threads) -> Any:
        return self


class LatticeRates(OwnRates):
    """Mass, momentum and energy per volume on a lattice of unit spacing: inherit it, write `rates`."""
    names = ("rho", "px", "py", "eps")

    @cached_property
    def x(self) -> np.ndarray:
        """Places (n, 2), row by row along y, x by x."""
        return lattice((round(self.scene.width), round(self.scene.L))).x

    def state(self, rho: np.ndarray, v: np.ndarray, T: np.ndarray) -> np.ndarray:
        """(4, n) of fields at `x`."""
        return densities(self.eos, rho, v, T)

    def fields(self, state: np.ndarray) -> Fields:
        """The fields of a state; all volumes are 1."""
        return from_densities(self.eos, self.x, np.ones(len(self.x)), state[0], state[1:3], state[3])


class Leaps:
    """The steps of a code that has its own, as many at once as there are between two records, or `most`."""
    most = 10**9

    def __init__(self, shape: tuple[int, ...], threads: Threads):
        self.shape = shape

    def step(self, sums: Any, state: np.ndarray, dt: float, steps: int = 1) -> None:
        """Advance a state in place. ValueError: what comes back is none."""
        later = np.asarray(sums.method.advance(state, dt, steps), float)
        if later.shape != self.shape:
            raise ValueError(f"advance of {type(sums.method).__name__} gave an array {later.shape} for a "
                             f"state {self.shape}: return the state so many steps later")
        state[:] = later


class Stepping(OwnRates):
    """A method with steps of its own: inherit it, write `names`, `state`, `fields`, `advance`, `limit`."""
    integrator: ClassVar[type] = Leaps

    def advance(self, state: np.ndarray, dt: float, steps: int) -> np.ndarray:
        """The state (rows, n) so many steps of dt later; it may be changed in place."""
        raise TypeError(f"{type(self).__name__} has no advance(state, dt, steps)")

    def limit(self, start: np.ndarray) -> float:
        raise TypeError(f"{type(self).__name__} has no limit(start)")

    def try_out(self, now: Any) -> None:
        """Nothing."""
