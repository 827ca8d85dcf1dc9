"""A plate that slides along itself, for smooth particles."""
from typing import NamedTuple

from particles.walls import confine, fixed_points, image_motion, image_point, image_pressure, parents
from particles.walls.mirror import Mirror


class Sliding(NamedTuple):
    """A mirror plate that slides along x with velocity U: its rule holds in its own frame."""
    mirror: Mirror
    U: float


parents.of(Sliding)(lambda wall, x, y, reach: parents(wall.mirror, x, y, reach))
image_point.of(Sliding)(lambda wall, x, y: image_point(wall.mirror, x, y))
image_pressure.of(Sliding)(lambda wall, own, copied: image_pressure(wall.mirror, own, copied))
confine.of(Sliding)(lambda wall, state: confine(wall.mirror, state))
fixed_points.of(Sliding)(lambda wall, width, height: fixed_points(wall.mirror, width, height))


@image_motion.of(Sliding)
def _(wall, x, y, vx, vy, T):
    u, v, T = image_motion(wall.mirror, x, y, vx - wall.U, vy, T)
    return u + wall.U, v, T
