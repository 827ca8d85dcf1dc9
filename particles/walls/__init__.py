"""Walls: they put ghosts or fixed particles behind the fluid, so that pair loops know nothing of walls.

A wall is a NamedTuple. It makes ghosts, each the image of a parent (a fluid particle, a fixed one or a ghost
of an earlier wall), and keeps the particles inside.
"""
from math import inf, isclose, isnan, nan

from continuum.jit import generic, jit


@generic
def parents(wall, x, y, reach):
    """Indices of points within `reach` of the wall, which need an image. Walls without images: no formula."""


@generic
def image_point(wall, x, y):
    """(x, y) of the image of a point at (x, y)."""


@generic
def image_motion(wall, x, y, vx, vy, T):
    """(vx, vy, T) of the image at (x, y) from velocity and temperature of the parent."""


@generic
def image_pressure(wall, own, copied):
    """The image's pressure: from its `own` density and temperature, or `copied` from the parent."""


@generic
def image_flux(wall, a, rho):
    """Mirror the stress and heat flux over rho^2 copied to image `a`, where the wall does not keep them."""


@generic
def mirrored(wall):
    """The axis (0: x, 1: y) across which images are mirrored; -1 for images that are shifted."""


@generic
def confine(wall, state):
    """Elastically reflect particles beyond the wall; state rows (x, y, vx, vy, e). Returns their number."""


@generic
def fixed_points(wall, width, height):
    """(x, y, T), each (F,), of the fixed particles of the wall. Walls with images: no formula."""


def check_ends(walls: tuple, box: tuple[float, float]) -> None:
    """Check that walls are at ends of the box, one at most at each, and that periodic ends come in pairs.

    An end without a wall is open. Raises ValueError, also for a T that is not positive and finite, unless a
    heat flux q is given.
    """
    ends: dict[tuple[int, bool], bool] = {}
    for wall in walls:
        at, axis = getattr(wall, "at", getattr(wall, "near", None)), getattr(wall, "axis", 1)
        if at is None:
            continue        # a user's own kind of wall
        if isnan(getattr(wall, "q", nan)) and not 0 < getattr(wall, "T", 1.0) < inf:
            raise ValueError(f"the temperature of {wall} must be positive and finite")
        if not isclose(abs(at), box[axis]/2, rel_tol=1e-9) or (axis, at > 0) in ends:
            raise ValueError(f"{wall} is not at an end of the box {box[0]:g} x {box[1]:g}, or another wall "
                             "is there already: make the walls for this box, one for each end")
        ends[axis, at > 0] = hasattr(wall, "by")
    for (axis, upper), periodic in ends.items():
        if periodic and not ends.get((axis, not upper)):
            raise ValueError(f"the box is periodic at one end along axis {axis} only: take both walls of "
                             "periodic(...)")


@jit
def place_images(first, last, wall, parent, x, y):
    """Set positions of ghosts first..last of one wall."""
    for g in range(first, last):
        p = parent[g - first]
        x[g], y[g] = image_point(wall, x[p], y[p])


@jit
def move_images(first, last, wall, parent, x, y, vx, vy, T):
    """Set velocities and temperatures of ghosts first..last of one wall."""
    for g in range(first, last):
        p = parent[g - first]
        vx[g], vy[g], T[g] = image_motion(wall, x[g], y[g], vx[p], vy[p], T[p])
