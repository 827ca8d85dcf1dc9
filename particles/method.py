"""The interface of a method, and base classes for a method of one's own.

A method is made for a scene and does not change; its `start` makes the sums that a run steps. The smallest
inherits `LatticeRates` and writes `rates`. One with another state or other places inherits `OwnRates`, takes
a scene, and writes `names`, `state`, `fields`, `rates`. A code with own time steps inherits `Stepping` and
writes `advance`, `limit` in place of `rates`. Units are the scene's: lengths in spacings, mean density 1.
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
    """Interface of a method, as a run uses it.

    eos : equation of state. names : of the rows of a state. Optional: integrator(shape, threads) with
    `step(sums, state, dt)`, RK4 by default; box and walls of points that move; limit(start), the longest
    stable step, which `particles.limits` takes from a formula or finds by trial if there is no such method;
    state(rho, v, T), the state (rows, n) from density (n,), velocity (n, 2), temperature (n,) at the method's
    places `x` (n, 2), or state(x, rho, v, T) of a method without `x`; `studies.build.ready` needs it.
    """
    eos: Any
    names: Any

    def fields(self, state: np.ndarray) -> Fields:
        """Places (m, 2), velocities (m, 2), density, temperature, volume (m,) of a state (rows, n)."""

    def start(self, n: int, threads: Threads) -> Any:
        """Make the sums for a state of n points. Raises ValueError: the method cannot have n points."""


@runtime_checkable
class Sums(Protocol):
    """Interface of a method's sums, as a run and its integrator use it; staying points need only `rates`."""
    method: Any

    def rates(self, state: np.ndarray, out: np.ndarray) -> None:
        """d(state)/dt of a state (rows, n), all of it written to `out`."""
        raise TypeError(f"{type(self).__name__} has no rates(state, out): write one that puts d(state)/dt "
                        "into out, or inherit Stepping")

    def look_at(self, state: np.ndarray) -> Any:
        """Prepare the sums for a state, before series and means of a run read it."""
        return None

    def resume(self, now: Any) -> None:
        """Restore what an interrupted run `now` (`particles.plan.Run`) had; called once, before all else."""
        return None

    def try_out(self, now: Any) -> None:
        """Load or compile all code without changing the run. Raises ValueError: the start is not valid."""
        self.rates(now.state, np.empty_like(now.state))

    def make_ready(self, now: Any, dt: float) -> None:
        """Prepare a step; may sort `now.state`, `now.ids`. Raises FloatingPointError: no step is possible."""
        return None

    def mark(self, now: Any) -> None:
        """Store in a run what a restart needs besides its state, before a checkpoint is written."""
        return None

    def confine(self, state: np.ndarray) -> int:
        """Reflect points that have crossed walls in a step. Returns the number of reflections."""
        return 0

    def fault(self, state: np.ndarray, ids: np.ndarray) -> str:
        """Message on what is wrong with a state after a step; empty if nothing is. Here density and
        temperature must be positive; nan, of a method without such a field, passes."""
        at = self.method.fields(state)
        bad = np.flatnonzero((at.rho <= 0) | (at.T <= 0))
        if not len(bad):
            return ""
        i = bad[0]
        return f"point {ids[i]} has rho = {at.rho[i]:.6g}, T = {at.T[i]:.6g}, which must be positive"


class OwnRates(Sums):
    """Base class of a method that is its own sums. Subclasses write `names`, `state`, `fields`, `rates`."""
    names: Any

    def __init__(self, scene: Any):
        self.scene, self.eos, self.method = scene, scene.eos, self

    def start(self, n: int, threads: Threads) -> Any:
        return self


class LatticeRates(OwnRates):
    """Method with mass, momentum, energy per volume on a unit lattice. Subclasses write `rates`."""
    names = ("rho", "px", "py", "eps")

    @cached_property
    def x(self) -> np.ndarray:
        """Places (n, 2), ordered by x, then by y: y varies fastest."""
        return lattice((round(self.scene.width), round(self.scene.L))).x

    def state(self, rho: np.ndarray, v: np.ndarray, T: np.ndarray) -> np.ndarray:
        """State (4, n) from fields at `x`."""
        return densities(self.eos, rho, v, T)

    def fields(self, state: np.ndarray) -> Fields:
        """The fields of a state; all volumes are 1."""
        return from_densities(self.eos, self.x, np.ones(len(self.x)), state[0], state[1:3], state[3])


class Leaps:
    """Integrator of a code with its own time steps: all steps to the next record at once, or `most`."""
    most = 10**9

    def __init__(self, shape: tuple[int, ...], threads: Threads):
        self.shape = shape

    def step(self, sums: Any, state: np.ndarray, dt: float, steps: int = 1) -> None:
        """Advance a state in place. Raises ValueError: `advance` returns another shape."""
        later = np.asarray(sums.method.advance(state, dt, steps), float)
        if later.shape != self.shape:
            raise ValueError(f"advance of {type(sums.method).__name__} gave an array {later.shape} for a "
                             f"state {self.shape}: return the state so many steps later")
        state[:] = later


class Stepping(OwnRates):
    """Method with its own time steps. Subclasses write `names`, `state`, `fields`, `advance`, `limit`."""
    integrator: ClassVar[type] = Leaps

    def advance(self, state: np.ndarray, dt: float, steps: int) -> np.ndarray:
        """The state (rows, n) after `steps` steps of dt; may change `state` in place."""
        raise TypeError(f"{type(self).__name__} has no advance(state, dt, steps)")

    def limit(self, start: np.ndarray) -> float:
        raise TypeError(f"{type(self).__name__} has no limit(start)")

    def try_out(self, now: Any) -> None:
        """Do nothing."""
