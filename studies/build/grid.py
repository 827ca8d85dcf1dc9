"""The compressible grid as a method of the particles' time loop, in any scene."""
from dataclasses import dataclass, replace
from typing import Any, ClassVar, NamedTuple

import numpy as np

from continuum.fluid import Fields
from continuum.gas.fields import NodeFields, at_nodes, block, initial, placed, unblock
from continuum.gas.ghosts import FIELDS, VX, EdgeHeat, FluxForm, PaperForm
from continuum.gas.solve import March, first_fault, step_limit
from continuum.scene import RayleighBenard
from continuum.steady import SAFETY
from particles.limits import limit_of
from particles.method import Sums
from particles.threads import Threads
from studies.build.names import START_ENERGY
from studies.build.setting import Ready, stepped


class InBlocks:
    """RK4 steps by the grid's own loop; a state (4, n) is a flattened block."""

    def __init__(self, shape: tuple[int, ...], threads: Threads):
        self.march: March | None = None

    def step(self, sums: "GridSums", state: np.ndarray, dt: float) -> None:
        """Advance a state in place."""
        if self.march is None:
            self.march = sums.method.march(state, dt)
        self.march.S[:] = sums.method.block(state)
        self.march.advance(1)
        state[:] = self.march.S.reshape(4, -1)


class GridSums(Sums):
    """Interface of the grid to the time loop, besides its steps."""
    method: "Gridded"

    def __init__(self, method: "Gridded"):
        self.method = method

    def try_out(self, now: Any) -> None:
        """Load the compiled code without a step; it fills the ghosts of a copy."""
        self.method.march(now.state)

    def fault(self, state: np.ndarray, ids: np.ndarray) -> str:
        """Message on the first node whose state is not valid; empty if there is none."""
        return first_fault(self.method.scene, self.method.block(state))


@dataclass(frozen=True, kw_only=True)
class Gridded:
    """The gas on square cells, `rows` over the height; a state is a flat block (4, rows + 2, columns + 2)."""
    scene: Any
    rows: int
    continuity: Any = FluxForm()  # noqa: RUF009 (immutable)

    names: ClassVar[tuple[str, ...]] = FIELDS
    integrator: ClassVar[type] = InBlocks

    @property
    def eos(self) -> Any:
        return self.scene.eos

    def start(self, n: int, threads: Threads) -> GridSums:
        """The sums that `particles.run` steps; they use one core, whatever `threads` is."""
        return GridSums(self)

    def block(self, state: np.ndarray) -> np.ndarray:
        """A state (4, n) in the shape of a block."""
        return state.reshape(4, self.rows + 2, -1)

    def march(self, state: np.ndarray, dt: float = 1.0) -> March:
        """A time march with steps dt that starts from a copy of a state or block."""
        return March(self.scene, self.block(state).copy(), self.continuity, dt)

    def go(self, state: np.ndarray, dt: float, steps: int) -> np.ndarray:
        """The state after a number of steps, in the grid's own loop."""
        march = self.march(state, dt)
        march.go(steps)
        return march.S.reshape(4, -1)

    def fields(self, state: np.ndarray) -> Fields:
        """Fields at the nodes, each node once."""
        return at_nodes(unblock(self.scene, self.block(state)))


@limit_of.register
def _(method: Gridded, start: np.ndarray) -> float:
    return step_limit(method.scene, method.block(start))


class GridForm(NamedTuple):
    """One way to solve the gas on a grid.

    rolls : their number at the start, None for the scene's own. aside : number of further rolls with a
    hundredth of the energy, so that the flow can leave its symmetry. step : time step over its limit.
    """
    name: str
    continuity: Any = FluxForm()
    rolls: int | None = None
    aside: int = 0
    step: float = SAFETY

    def refuses(self, scene: Any) -> str:
        """Always empty: the grid can have sides of all kinds."""
        return ""

    def ready(self, scene: Any, seed: int = 1, first: np.ndarray | None = None) -> Ready:
        """The grid in a scene, in cells of unit size; first : block of the start."""
        method = Gridded(scene=scene, rows=round(scene.L), continuity=self.continuity)
        if first is None:
            first = block(beginning(scene, method.rows, self))
            if scene.slide:     # which steps do not change
                first[VX, -1] = scene.slide
        return stepped(method, method.march(first).S.reshape(4, -1), self.step)


#: "fig10" is for the temperatures of Fig. 10, which tables have in no column: only this name tells them
FORMS = {form.name: form for form in (
    GridForm("flux-form"),
    GridForm("paper-form", PaperForm()),
    GridForm("edge-heat", EdgeHeat()),
    GridForm("two-rolls", rolls=2, aside=1),
    GridForm("fig10", rolls=2, aside=1))}


def beginning(scene: Any, rows: int, form: GridForm) -> NodeFields:
    """Fields at the start: the scene's own; in convection the rolls of Sec. VI and those aside    [KHP95]"""
    if not isinstance(scene, RayleighBenard):
        return placed(scene, rows, lambda x, y: started(scene, x, y))
    fields = initial(scene, rows, START_ENERGY, form.rolls)
    if not form.aside:
        return fields
    more = initial(scene, rows, START_ENERGY/100, form.aside).at
    return replace(fields, at=fields.at._replace(vx=fields.at.vx + more.vx, vy=fields.at.vy + more.vy))


def started(scene: Any, x: np.ndarray, y: np.ndarray) -> tuple[np.ndarray, ...]:
    """(rho, u, v, T) at the start of a scene at places x, y of any shape."""
    rho, v, T = scene.fields(np.stack([x.ravel(), y.ravel()], axis=1))
    return tuple(q.reshape(x.shape) for q in (rho, *v.T, T))
