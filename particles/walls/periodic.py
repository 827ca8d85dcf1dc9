"""Periodic sides: images shifted by the period."""
from typing import NamedTuple

import numpy as np

from particles.walls import confine, image_flux, image_motion, image_point, image_pressure, mirrored, parents


class Shift(NamedTuple):
    """One side of a box periodic along `axis` (0: x, 1: y): images of points near `near`, shifted by `by`."""
    axis: int
    near: float
    by: float


def periodic(width: float, axis: int = 0) -> tuple[Shift, Shift]:
    """Both sides of a periodic box -width/2 <= x < width/2; in y with axis = 1."""
    return Shift(axis, -width/2, width), Shift(axis, width/2, -width)


@parents.of(Shift)
def _(wall, x, y, reach):
    # a ghost made by the other side is outside the box [-width/2, width/2) and needs no image
    q, half = (x if wall.axis == 0 else y), abs(wall.near)
    return np.flatnonzero((np.abs(q - wall.near) <= reach) & (q >= -half) & (q < half))


@image_point.of(Shift)
def _(wall, x, y):
    return (x + wall.by, y) if wall.axis == 0 else (x, y + wall.by)


mirrored.of(Shift)(lambda wall: -1)
image_motion.of(Shift)(lambda wall, x, y, vx, vy, T: (vx, vy, T))
image_pressure.of(Shift)(lambda wall, own, copied: copied)
image_flux.of(Shift)(lambda wall, a, rho: None)
confine.of(Shift)(lambda wall, state: 0)


def wrap(walls: tuple, state: np.ndarray) -> None:
    """Wrap particles that have left through a periodic side into the box, in place; rows (x, y, ...)."""
    for wall in walls:
        if isinstance(wall, Shift) and wall.by > 0:
            q = state[wall.axis]
            q[:] = (q - wall.near) % wall.by + wall.near
            # the remainder of a tiny negative number is rounded up to the whole period
            q[q >= wall.near + wall.by] = wall.near
