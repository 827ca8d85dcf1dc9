"""A side of a box of its own kind: mirror images that move and are as warm as its numbers say."""
from typing import NamedTuple

from particles.walls import confine, image_flux, image_motion, image_point, image_pressure, parents
from particles.walls.mirror import Mirror, velocity_and_temperature


class OneSide(NamedTuple):
    """A mirror whose rule holds seen from a plate that slides along itself with velocity v.

    slip : images keep the velocity along the side, that across it is reversed. q, k : where the mirror's T is
    nan heat q passes into a fluid of conductivity k; images are as warm as their particles, and by 2 depth
    q/k warmer. Where nothing holds the fluid, or a flux is given, the copied stress or heat flux is mirrored,
    too: pairs through the side then carry along it, or through it, what is wanted, to round-off.
    """
    mirror: Mirror
    v: float
    slip: bool = False
    q: float = 0.0
    k: float = 1.0


parents.of(OneSide)(lambda wall, x, y, reach: parents(wall.mirror, x, y, reach))
image_point.of(OneSide)(lambda wall, x, y: image_point(wall.mirror, x, y))
image_pressure.of(OneSide)(lambda wall, own, copied: image_pressure(wall.mirror, own, copied))
confine.of(OneSide)(lambda wall, state: confine(wall.mirror, state))


@image_motion.of(OneSide)
def _(wall, x, y, vx, vy, T):
    mirror, flat = wall.mirror, wall.mirror.axis == 1
    along, across, depth = (vx, vy, abs(y - mirror.at)) if flat else (vy, vx, abs(x - mirror.at))
    u, w, by_rule = velocity_and_temperature(mirror.rule, mirror.T, along - wall.v, across, T)
    u, w = (along, -across) if wall.slip else (u + wall.v, w)
    T = by_rule if mirror.T == mirror.T else T + 2*depth*wall.q/wall.k
    return (u, w, T) if flat else (w, u, T)


@image_flux.of(OneSide)
def _(wall, a, rho):
    mirror = wall.mirror
    if wall.slip:
        a.xy, a.yx = -a.xy, -a.yx
    if mirror.T != mirror.T:
        inwards = 2*mirror.inner*wall.q/rho**2
        if mirror.axis == 1:
            a.qy = inwards - a.qy
        else:
            a.qx = inwards - a.qx
