"""Mirror images behind rigid plates with elastic reflection [KHP95, Fig. 3]; sliding, slip, heated sides."""
from typing import Any, NamedTuple

import numpy as np

from continuum.jit import generic, jit
from particles.walls import confine, image_flux, image_motion, image_point, image_pressure, mirrored, parents


class AtWall(NamedTuple):
    """Images at rest at the wall's temperature: both are *specified*    [KHP95, Fig. 3]"""


class Odd(NamedTuple):
    """Images with v -> -v and T -> 2 T_w - T: the mean of particle and image is the wall's value."""


class Copied(NamedTuple):
    """The image has the pressure of its particle, as KHP95 say of their grid (Sec. IV)."""


class Own(NamedTuple):
    """The image's pressure follows from its own density and temperature."""


class Mirror(NamedTuple):
    """A plate across `axis` (0: x, 1: y) at coordinate `at`, the fluid on its `inner` side (+1 or -1). Its
    temperature is T + slope * (coordinate along the plate)."""
    axis: int
    at: float
    inner: float
    T: float
    slope: float
    rule: Any
    pressure: Any


def plates(height: float, T_hot: float, T_cold: float, rule=AtWall(), pressure=Copied()) -> tuple:  # noqa: B008
    """Hot plate below at -height/2, cold plate above at height/2."""
    return (Mirror(1, -height/2, 1.0, T_hot, 0.0, rule, pressure),
            Mirror(1, height/2, -1.0, T_cold, 0.0, rule, pressure))


def sides(width: float, T_mean: float, slope: float, rule=AtWall(), pressure=Copied()) -> tuple:  # noqa: B008
    """Left and right walls whose temperature is linear in y    [KHP95, Fig. 6]"""
    return (Mirror(0, -width/2, 1.0, T_mean, slope, rule, pressure),
            Mirror(0, width/2, -1.0, T_mean, slope, rule, pressure))


@generic
def velocity_and_temperature(rule, wall_T, along, across, T):
    """Velocity of the image along and across the plate, relative to the plate, and temperature, by a rule."""


@generic
def choose(pressure, own, copied):
    """The image's own pressure, or the copied one."""


velocity_and_temperature.of(AtWall)(lambda rule, wall_T, along, across, T: (0.0, 0.0, wall_T))
velocity_and_temperature.of(Odd)(lambda rule, wall_T, along, across, T: (-along, -across, 2*wall_T - T))
choose.of(Copied)(lambda pressure, own, copied: copied)
choose.of(Own)(lambda pressure, own, copied: own)


@parents.of(Mirror)
def _(wall, x, y, reach):
    depth = wall.inner*((x if wall.axis == 0 else y) - wall.at)
    return np.flatnonzero(np.abs(depth) <= reach)


@image_point.of(Mirror)
def _(wall, x, y):
    return (2*wall.at - x, y) if wall.axis == 0 else (x, 2*wall.at - y)


@image_motion.of(Mirror)
def _(wall, x, y, vx, vy, T):
    if wall.axis == 1:
        return velocity_and_temperature(wall.rule, wall.T + wall.slope*x, vx, vy, T)
    v, u, T = velocity_and_temperature(wall.rule, wall.T + wall.slope*y, vy, vx, T)
    return u, v, T


mirrored.of(Mirror)(lambda wall: wall.axis)
image_pressure.of(Mirror)(lambda wall, own, copied: choose(wall.pressure, own, copied))


@confine.of(Mirror)
def _(wall, state):
    return _reflect(state[wall.axis], state[2 + wall.axis], wall.at, wall.inner)


@jit
def _reflect(q, v, at, inner):
    count = 0
    for i in range(len(q)):
        if (q[i] - at)*inner < 0:
            q[i] = 2*at - q[i]
            v[i] = -v[i]
            count += 1
    return count


class OneSide(NamedTuple):
    """A mirror at a side that slides along itself with velocity v; its rule holds in the frame of the side.

    slip : images keep the velocity along the side and reverse that across it. q, k : where the mirror's T is
    nan, heat q passes into a fluid of conductivity k, and images are warmer than their particles by 2 depth
    q/k. With slip the copied shear stress is mirrored, with a given q the copied heat flux: pairs through the
    side then transfer no momentum along it, or the heat q, to round-off.
    """
    mirror: Mirror
    v: float
    slip: bool = False
    q: float = 0.0
    k: float = 1.0


parents.of(OneSide)(lambda wall, x, y, reach: parents(wall.mirror, x, y, reach))
image_point.of(OneSide)(lambda wall, x, y: image_point(wall.mirror, x, y))
mirrored.of(OneSide)(lambda wall: wall.mirror.axis)
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
