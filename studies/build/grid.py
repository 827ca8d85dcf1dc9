"""The compressible grid in time, in any scene."""
from dataclasses import dataclass, replace
from typing import Any, ClassVar, NamedTuple

import numpy as np

from continuum.fluid import Fields
from continuum.gas.fields import NodeFields, at_nodes, block, initial, placed, unblock
from continuum.gas.ghosts import FIELDS, VX, EdgeHeat, FluxForm, PaperForm
from continuum.gas.solve import March, first_fault, limits
from continuum.scene import RayleighBenard
from continuum.steady import SAFETY
from particles.limits import limit_of
from particles.method import Sums
from particles.threads import Threads
from studies.build.names import START_ENERGY
from studies.build.setting import Ready, stepped


class InBlocks:
    """Steps of RK4 as the grid's own loop takes them; a state (4, n) is a block, flat."""

    def __init__(self, shape: tuple[int, ...], threads: Threads):
        self.march: March | None = None

    def step(self, sums: "GridSums", state: np.ndarray, dt: float) -> None:
        """Advance a state in place."""
        if self.march is None:
            self.march = sums.method.march(sums.method.block(state), dt)
        self.march.S[:] = sums.method.block(state)
        self.march.advance(1)
        state[:] = self.march.S.reshape(4, -1)


class GridSums(Sums):
    """What the time loop asks of the grid besides its steps."""
    method: "Gridded"

    def __init__(self, method: "Gridded"):
        self.method = method

    def try_out(self, now: Any) -> None:
        """No step: loads the code, fills the ghosts of a copy."""
        self.method.march(self.method.block(now.state))

    def fault(self, state: np.ndarray, ids: np.ndarray) -> str:
        """The first node outside of the equation of state; empty if there is none."""
        return first_fault(self.method.scene, self.method.block(state))


@dataclass(frozen=True, kw_only=True)
class Gridded:
    """The gas in square cells, `rows` over the height; states are blocks (4, rows + 2, columns + 2).

    In the time loop of particles a state is such a block in the shape (4, n).
    """
    scene: Any
    rows: int
    continuity: Any = FluxForm()  # noqa: RUF009 (immutable)

    names: ClassVar[tuple[str, ...]] = FIELDS
    integrator: ClassVar[type] = InBlocks

    @property
    def eos(self) -> Any:
        return self.scene.eos

    def start(self, n: int, threads: Threads) -> GridSums:
        """What `particles.run` steps; it computes on one core, whatever the threads."""
        return GridSums(self)

    def block(self, state: np.ndarray) -> np.ndarray:
        """A state in the shape of a block."""
        return state.reshape(4, self.rows + 2, -1)

    def march(self, S: np.ndarray, dt: float = 1.0) -> March:
        """A copy of a state that can be moved on."""
        return March(self.scene, S.copy(), self.continuity, dt)

    def go(self, S: np.ndarray, dt: float, steps: int) -> np.ndarray:
        """The state so many steps later."""
        march = self.march(S, dt)
        march.go(steps)
        return march.S

    def fields(self, S: np.ndarray) -> Fields:
        """At the nodes, each place once."""
        return at_nodes(unblock(self.scene, self.block(S)))


@limit_of.register
def _(method: Gridded, start: np.ndarray) -> float:
    return float(limits(method.scene, method.block(start)).both)


class GridForm(NamedTuple):
    """One way to solve the gas on a grid. rolls : of the start; None: as the scene has it.

    aside : rolls of a hundredth of their energy besides: the flow can leave the symmetry of its start.
    """
    name: str
    continuity: Any = FluxForm()
    rolls: int | None = None
    aside: int = 0
    step: float = SAFETY

    def refuses(self, scene: Any) -> str:
        """Nothing: the grid knows all sides."""
        return ""

    def ready(self, scene: Any, seed: int = 1, rows: int = 0, first: np.ndarray | None = None) -> Ready:
        """The grid in a scene, cells of one spacing unless `rows` are given; from a block, if given."""
        method = Gridded(scene=scene, rows=rows or round(scene.L), continuity=self.continuity)
        first = begun(scene, method.rows, self) if first is None else first
        return stepped(method, method.march(first).S, self.step)


#: "fig10" is a scene of its own temperatures, told apart from others by this name only
FORMS = {form.name: form for form in (
    GridForm("flux-form"),
    GridForm("paper-form", PaperForm()),
    GridForm("edge-heat", EdgeHeat()),
    GridForm("two-rolls", rolls=2, aside=1),
    GridForm("fig10", rolls=2, aside=1))}


def begun(scene: Any, rows: int, form: GridForm) -> np.ndarray:
    """The block of the start; a plate slides where its nodes, which never change, have a velocity."""
    S = block(beginning(scene, rows, form))
    if scene.slide:
        S[VX, -1] = scene.slide
    return S


def beginning(scene: Any, rows: int, form: GridForm) -> NodeFields:
    """As the scene has it; of convection rolls of Sec. VI, and those aside    [KHP95]"""
    if not isinstance(scene, RayleighBenard):
        return placed(scene, rows, lambda x, y: started(scene, x, y))
    fields = initial(scene, rows, START_ENERGY, form.rolls)
    if not form.aside:
        return fields
    more = initial(scene, rows, START_ENERGY/100, form.aside).at
    return replace(fields, at=fields.at._replace(vx=fields.at.vx + more.vx, vy=fields.at.vy + more.vy))


def started(scene: Any, x: np.ndarray, y: np.ndarray) -> tuple[np.ndarray, ...]:
    """(rho, u, v, T) of a scene at places x, y of any shape."""
    rho, v, T = scene.fields(np.stack([x.ravel(), y.ravel()], axis=1))
    return tuple(q.reshape(x.shape) for q in (rho, *v.T, T))
