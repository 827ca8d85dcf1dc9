"""A side of a box of its own kind: mirror images that move and are as warm as its two rules say.

How an image moves: `Stuck` holds the fluid, by the rule of the mirror in the frame of the side, `Free` lets
it slip. How warm it is: `Given` by the rule of the mirror, `Passing` for a given flux. Where nothing holds
the fluid, or a flux is given, the copied stress or heat flux is mirrored, too: pairs through the side then
carry along it, or through it, what the rule says, to round-off.
"""
from typing import Any, NamedTuple

from continuum.jit import generic
from particles.walls import (
    confine,
    fixed_points,
    image_flux,
    image_motion,
    image_point,
    image_pressure,
    parents,
)
from particles.walls.mirror import Mirror, velocity_and_temperature


class Stuck(NamedTuple):
    """Images move by the rule of the mirror, seen from a plate of velocity v along itself."""
    v: float


class Free(NamedTuple):
    """Images keep the velocity along the side; that across it is reversed."""


class Given(NamedTuple):
    """Images have the temperature that the rule of the mirror makes of that of the side."""


class Passing(NamedTuple):
    """Heat q passes: images are as warm as their particles, and by 2 depth q/k warmer."""
    q: float
    k: float


class OneSide(NamedTuple):
    """A mirror with rules of motion and of heat."""
    mirror: Mirror
    motion: Any
    heat: Any


parents.of(OneSide)(lambda wall, x, y, reach: parents(wall.mirror, x, y, reach))
image_point.of(OneSide)(lambda wall, x, y: image_point(wall.mirror, x, y))
image_pressure.of(OneSide)(lambda wall, own, copied: image_pressure(wall.mirror, own, copied))
confine.of(OneSide)(lambda wall, state: confine(wall.mirror, state))
fixed_points.of(OneSide)(lambda wall, width, height: fixed_points(wall.mirror, width, height))


@generic
def moved(motion, mirror, along, across, T):
    """(velocity along the side, across it, temperature by the rule of the mirror) of an image."""


@generic
def warmed(heat, T, by_rule, depth):
    """Temperature of an image from that of its particle, from the mirror's rule, and how deep it lies."""


@generic
def turned_stress(motion, shear):
    """Stress along the side of an image, over rho^2, from the copied one."""


@generic
def turned_heat(heat, inwards, density):
    """Heat flux of an image inwards through the side, over rho^2, from the copied one."""


warmed.of(Given)(lambda heat, T, by_rule, depth: by_rule)
warmed.of(Passing)(lambda heat, T, by_rule, depth: T + 2*depth*heat.q/heat.k)
turned_stress.of(Stuck)(lambda motion, shear: shear)
turned_stress.of(Free)(lambda motion, shear: -shear)
turned_heat.of(Given)(lambda heat, inwards, density: inwards)
turned_heat.of(Passing)(lambda heat, inwards, density: 2*heat.q/density**2 - inwards)


@moved.of(Stuck)
def _(motion, mirror, along, across, T):
    u, w, by_rule = velocity_and_temperature(mirror.rule, mirror.T, along - motion.v, across, T)
    return u + motion.v, w, by_rule


@moved.of(Free)
def _(motion, mirror, along, across, T):
    _, _, by_rule = velocity_and_temperature(mirror.rule, mirror.T, along, across, T)
    return along, -across, by_rule


@image_motion.of(OneSide)
def _(wall, x, y, vx, vy, T):
    flat = wall.mirror.axis == 1
    depth = abs((y if flat else x) - wall.mirror.at)
    u, w, by_rule = moved(wall.motion, wall.mirror, vx if flat else vy, vy if flat else vx, T)
    T = warmed(wall.heat, T, by_rule, depth)
    return (u, w, T) if flat else (w, u, T)


@image_flux.of(OneSide)
def _(wall, a, rho):
    inner = wall.mirror.inner
    a.xy, a.yx = turned_stress(wall.motion, a.xy), turned_stress(wall.motion, a.yx)
    if wall.mirror.axis == 1:
        a.qy = inner*turned_heat(wall.heat, inner*a.qy, rho)
    else:
        a.qx = inner*turned_heat(wall.heat, inner*a.qx, rho)
