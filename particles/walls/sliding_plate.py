"""A plate that slides along itself, for smooth particles."""
from typing import NamedTuple

from particles.walls import confine, fixed_points, image_motion, image_point, image_pressure, parents
from particles.walls.mirror import Mirror


class SlidingPlate(NamedTuple):
    """A mirror plate that slides along x with velocity U: its rule holds in its own frame."""
    mirror: Mirror
    U: float


parents.of(SlidingPlate)(lambda wall, x, y, reach: parents(wall.mirror, x, y, reach))
image_point.of(SlidingPlate)(lambda wall, x, y: image_point(wall.mirror, x, y))
image_pressure.of(SlidingPlate)(lambda wall, own, copied: image_pressure(wall.mirror, own, copied))
confine.of(SlidingPlate)(lambda wall, state: confine(wall.mirror, state))
fixed_points.of(SlidingPlate)(lambda wall, width, height: fixed_points(wall.mirror, width, height))


@image_motion.of(SlidingPlate)
def _(wall, x, y, vx, vy, T):
    u, v, T = image_motion(wall.mirror, x, y, vx - wall.U, vy, T)
    return u + wall.U, v, T
