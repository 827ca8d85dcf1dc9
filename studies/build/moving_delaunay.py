"""Points that move with their Delaunay triangulation, in any scene."""
from functools import partial
from typing import Any, NamedTuple

import numpy as np

from continuum.fluid import energy, pressure, viscosity
from continuum.scene import Torus, Walls
from particles.fields import kinetic
from particles.integral.bodies import Held, Rows, held, together
from particles.integral.moving_delaunay import SHIFT, MovingDelaunay, RingSums
from particles.integral.rings import rings, spokes
from studies.build.fixed import between_sides, bodies_of, four_sides, on_plate
from studies.build.names import START_JITTER
from studies.build.setting import Ready, check_points, shifted, stepped, sticking


class Carriage(NamedTuple):
    """The scheme. size : of the disorder of points at the start, in spacings."""
    name: str
    shift: float = SHIFT
    size: float = START_JITTER
    of_limit: float = 0.8

    def refuses(self, scene: Any) -> str:
        """Which part of a scene this cannot take; empty for none."""
        return sticking(scene)

    def ready(self, scene: Any, seed: int = 1, fields: tuple | None = None) -> Ready:
        """The method in a scene; from fields (rho, v, T) at its points, if given."""
        check_points(self, scene)
        size, along = (scene.width, scene.L), scene.sides.axes
        closed = not along[0], not along[1]
        x, rows = between_sides(size, closed, shifted, self.size, seed)
        method = MovingDelaunay(x=x, rings=rings(x, size, closed), held=held_of(scene, x, rows),
                                eos=scene.eos, law=scene.law, g=scene.g, rides=closed != (True, True),
                                shift=self.shift)
        return stepped(method, method.state(*(fields or scene.fields(x))), self.of_limit)

    @property
    def series(self) -> dict[str, Any]:
        """Quantities of a run: K, heat through both plates, heat that the flow carries."""
        return {"ke": kinetic, "lower": partial(heat_in, plate=0), "upper": partial(heat_in, plate=1),
                "carried": heat_carried}


CARRIAGES = {one.name: one for one in (
    Carriage("moving-delaunay"),
    Carriage("moving-delaunay-half-step", of_limit=0.4),
    Carriage("moving-delaunay-quarter-step", of_limit=0.2),
)}


NONE_HELD = Held(np.empty(0, int), np.empty((0, 2)), np.empty(0), np.empty(0, int), np.empty(0))


def held_of(scene: Any, x: np.ndarray, rows: Rows) -> Held:
    """Points on sides: lower row, upper row, then others."""
    if isinstance(scene.sides, Torus):
        return NONE_HELD
    if not isinstance(scene.sides, Walls):
        return together(*bodies_of(four_sides(scene), rows))
    beside = np.concatenate([rows.left, rows.right, rows.corners])
    return together(held(rows.bottom, T=scene.T_hot), held(rows.top, T=scene.T_cold),
                    held(beside)._replace(T=scene.T(x[beside, 1])))


def heat_in(sums: RingSums, state: np.ndarray, plate: int) -> float:
    """Heat that enters the fluid through a plate (0: lower, 1: upper), per time."""
    return -float(sums.received[on_plate(sums.held, plate), 2].sum())


def heat_carried(sums: RingSums, state: np.ndarray) -> float:
    """What the flow brings upwards, (E/V + P) v_y - (tau v)_y over the height; conduction is the rest."""
    at, (near, _, sx, sy) = sums.method.fields(state), spokes(sums.rings)
    step = at.v[near] - at.v[:, None]
    (xx, xy), (yx, yy) = ((S[:, :, None]*step).sum(axis=1).T for S in (sx, sy))        # V d_x v, V d_y v
    eta, (vx, vy) = viscosity(sums.method.law, at.rho, at.T), at.v.T
    P = pressure(sums.method.eos, at.rho, energy(sums.method.eos, at.rho, at.T))
    flux = (state[8] + P*at.V)*vy - eta*(vx*(xy + yx) + vy*(yy - xx))
    return float(flux.sum()/sums.rings.size[1])
