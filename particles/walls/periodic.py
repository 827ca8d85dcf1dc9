"""Periodic sides: images shifted by the period."""
from typing import NamedTuple

import numpy as np

from particles.walls import confine, fixed_points, image_motion, image_point, image_pressure, parents


class Shift(NamedTuple):
    """One side of a box that is periodic in x: points near `near` have an image shifted by `by`."""
    near: float
    by: float


def periodic(width: float) -> tuple[Shift, Shift]:
    """Both sides of the box -width/2 < x < width/2."""
    return Shift(-width/2, width), Shift(width/2, -width)


@parents.of(Shift)
def _(wall, x, y, reach):
    # a ghost made by the other side is outside of the box [-width/2, width/2) and needs no image
    inside = (x >= -abs(wall.near)) & (x < abs(wall.near))
    return np.flatnonzero((np.abs(x - wall.near) <= reach) & inside)


image_point.of(Shift)(lambda wall, x, y: (x + wall.by, y))
image_motion.of(Shift)(lambda wall, x, y, vx, vy, T: (vx, vy, T))
image_pressure.of(Shift)(lambda wall, own, copied: copied)
confine.of(Shift)(lambda wall, state: 0)
fixed_points.of(Shift)(lambda wall, width, height: (np.empty(0), np.empty(0), np.empty(0)))


def wrap(walls: tuple, x: np.ndarray) -> None:
    """Bring particles that have left through a periodic side back in, in place."""
    for wall in walls:
        if isinstance(wall, Shift) and wall.by > 0:
            x[:] = (x - wall.near) % wall.by + wall.near
