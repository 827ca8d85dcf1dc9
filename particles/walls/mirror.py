"""Mirror images behind rigid plates with elastic reflection [KHP95, Fig. 3]; sliding, slip, heated sides."""
from math import nan
from typing import Any, NamedTuple

import numpy as np

from continuum.jit import generic, jit
from particles.walls import confine, image_flux, image_motion, image_point, image_pressure, mirrored, parents


class AtWall(NamedTuple):
    """Images at rest at the wall's temperature: both are *specified*    [KHP95, Fig. 3]"""


class Odd(NamedTuple):
    """Images with v -> -v and T -> 2 T_w - T: the mean of particle and image is the wall's value."""


class Mirror(NamedTuple):
    """A plate across `axis` (0: x, 1: y) at coordinate `at`, the fluid on its `inner` side (+1 or -1).

    T, slope : its temperature is T + slope * (coordinate along the plate). rule : of images, in the frame of
    the plate, which slides along itself with velocity v. own_pressure : the pressure of an image follows from
    its own density and temperature; it is not that of its particle, as KHP95 say of their grid (Sec. IV).
    slip : images keep the velocity along the plate and reverse that across it. q : heat that passes into a
    fluid of conductivity k, in place of a temperature; images are warmer than their particles by 2 depth q/k.
    With slip the copied shear stress is mirrored, with q the copied heat flux: pairs through the plate then
    transfer no momentum along it, or the heat q, to round-off.
    """
    axis: int
    at: float
    inner: float
    T: float
    slope: float = 0.0
    rule: Any = AtWall()
    own_pressure: bool = False
    v: float = 0.0
    slip: bool = False
    q: float = nan
    k: float = 1.0


def plates(height: float, T_hot: float, T_cold: float, rule=AtWall(), own_pressure=False) -> tuple:  # noqa: B008
    """Hot plate below at -height/2, cold plate above at height/2."""
    return (Mirror(1, -height/2, 1.0, T_hot, 0.0, rule, own_pressure),
            Mirror(1, height/2, -1.0, T_cold, 0.0, rule, own_pressure))


def sides(width: float, T_mean: float, slope: float, rule=AtWall(), own_pressure=False) -> tuple:  # noqa: B008
    """Left and right walls whose temperature is linear in y    [KHP95, Fig. 6]"""
    return (Mirror(0, -width/2, 1.0, T_mean, slope, rule, own_pressure),
            Mirror(0, width/2, -1.0, T_mean, slope, rule, own_pressure))


@generic
def velocity_and_temperature(rule, wall_T, along, across, T):
    """Velocity of the image along and across the plate, relative to the plate, and temperature, by a rule."""


velocity_and_temperature.of(AtWall)(lambda rule, wall_T, along, across, T: (0.0, 0.0, wall_T))
velocity_and_temperature.of(Odd)(lambda rule, wall_T, along, across, T: (-along, -across, 2*wall_T - T))


@parents.of(Mirror)
def _(wall, x, y, reach):
    depth = wall.inner*((x if wall.axis == 0 else y) - wall.at)
    return np.flatnonzero(np.abs(depth) <= reach)


@image_point.of(Mirror)
def _(wall, x, y):
    return (2*wall.at - x, y) if wall.axis == 0 else (x, 2*wall.at - y)


@image_motion.of(Mirror)
def _(wall, x, y, vx, vy, T):
    flat = wall.axis == 1
    along, across, place, depth = (vx, vy, x, abs(y - wall.at)) if flat else (vy, vx, y, abs(x - wall.at))
    u, w, by_rule = velocity_and_temperature(wall.rule, wall.T + wall.slope*place, along - wall.v, across, T)
    u, w = (along, -across) if wall.slip else (u + wall.v, w)
    T = T + 2*depth*wall.q/wall.k if wall.q == wall.q else by_rule
    return (u, w, T) if flat else (w, u, T)


@image_flux.of(Mirror)
def _(wall, a, rho):
    if wall.slip:
        a.xy, a.yx = -a.xy, -a.yx
    if wall.q == wall.q:
        inwards = 2*wall.inner*wall.q/rho**2
        if wall.axis == 1:
            a.qy = inwards - a.qy
        else:
            a.qx = inwards - a.qx


mirrored.of(Mirror)(lambda wall: wall.axis)
image_pressure.of(Mirror)(lambda wall, own, copied: own if wall.own_pressure else copied)


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
