"""Walls: what is beyond the fluid, as particles. The pair loops know nothing of them.

A wall is a NamedTuple. It makes ghosts, each the image of a parent (a fluid particle, a fixed one or a ghost
of an earlier wall), and keeps the particles inside. One kind of wall a file.
"""
from math import inf, isclose

from continuum.jit import generic, jit


@generic
def parents(wall, x, y, reach):
    """Indices of the points within `reach` of the wall, which need an image. Walls of none: no formula."""


@generic
def image_point(wall, x, y):
    """(x, y) of the image."""


@generic
def image_motion(wall, x, y, vx, vy, T):
    """(vx, vy, T) of the image at (x, y) from velocity and temperature of the parent."""


@generic
def image_pressure(wall, own, copied):
    """The image's pressure: from its `own` density and temperature, or `copied` from the parent."""


@generic
def image_flux(wall, a, rho):
    """Turn the stress and heat flux over rho^2 that the image `a` has copied. Where both stay: no formula."""


@generic
def mirrored(wall):
    """The axis (0: x, 1: y) across which images are mirrored; -1 for images that are shifted."""


@generic
def confine(wall, state):
    """Reflect elastically what has crossed the wall, rows (x, y, vx, vy, e); their number."""


@generic
def fixed_points(wall, width, height):
    """(x, y, T), each (F,), of the particles that the wall holds; walls of images give no formula."""


def check_ends(walls: tuple, box: tuple[float, float]) -> None:
    """Refuse walls that are not at ends of a box, two at one end, and a periodic end without its partner.

    An end without any wall is open. ValueError: names the wall.
    """
    ends: dict[tuple[int, bool], bool] = {}
    for wall in walls:
        plate = getattr(wall, "mirror", wall)
        at, axis = getattr(plate, "at", getattr(plate, "near", None)), getattr(plate, "axis", 1)
        if at is None:
            continue        # a kind of one's own
        T = getattr(plate, "T", 1.0)
        if not 0 < T < inf and (plate is wall or T == T):       # nan: heat is given in its place
            raise ValueError(f"the temperature of {wall} must be positive and finite")
        if not isclose(abs(at), box[axis]/2, rel_tol=1e-9) or (axis, at > 0) in ends:
            raise ValueError(f"{wall} is not at an end of the box {box[0]:g} x {box[1]:g}, or another wall "
                             "is there already: make the walls for this box, one for each end")
        ends[axis, at > 0] = hasattr(plate, "by")
    for (axis, upper), periodic in ends.items():
        if periodic and not ends.get((axis, not upper)):
            raise ValueError(f"the box is periodic at one end along axis {axis} only: take both walls of "
                             "periodic(...)")


@jit
def place_images(first, last, wall, parent, x, y):
    """Positions of ghosts first..last of one wall."""
    for g in range(first, last):
        p = parent[g - first]
        x[g], y[g] = image_point(wall, x[p], y[p])


@jit
def move_images(first, last, wall, parent, x, y, vx, vy, T):
    """Velocities and temperatures of ghosts first..last of one wall."""
    for g in range(first, last):
        p = parent[g - first]
        vx[g], vy[g], T[g] = image_motion(wall, x[g], y[g], vx[p], vy[p], T[p])
