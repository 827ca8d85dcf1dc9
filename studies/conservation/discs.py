"""Points around discs: which of a lattice lie in one, or with points on the circle, the true surface."""
import numpy as np

from particles.integral.bodies import Held, held
from particles.integral.points import Points, lattice, of_positions

#: spacings between a surface and points off it: nearer ones would cut its edges or take short steps
CLEAR = 0.6


def turning(points: Points, which: np.ndarray, rate: float, T: float = np.nan) -> Held:
    """Points that turn rigidly about the middle of the box, counterclockwise."""
    x, y = points.x[which].T
    return held(which, T=T)._replace(v=rate*np.stack([-y, x], axis=1))


def in_disc(points: Points, radius: float) -> np.ndarray:
    """Numbers of the points within a disc about the middle of the box, those on its edge among them."""
    check_disc(points, radius)
    return np.flatnonzero(np.hypot(*points.x.T) <= radius*(1 + 1e-12))


def check_disc(points: Points, radius: float) -> None:
    """Refuse a disc without a point, and one that touches its own image."""
    if not points.a <= radius <= points.box.min()/2 - points.a:
        raise ValueError(f"a disc of radius {radius:g} in a box {points.box} must be at least a spacing, "
                         f"{points.a:.3g}, and as far from its image beyond the side; take more points")


def with_surface(counts: tuple[int, int], radius: float) -> tuple[Points, np.ndarray]:
    """A lattice of spacing 1 with a disc about its middle, and the disc's points, surface included.

    The lattice keeps off the circle by CLEAR, so that chords between neighbours on it are Delaunay edges. The
    polygon lacks a fraction (2 pi/n)^2/6 of the area of the disc.
    """
    at = lattice(counts)
    check_disc(at, radius)
    r = np.hypot(*at.x.T)
    circle = on_circle(radius)
    inside, outside = at.x[r < radius - CLEAR], at.x[r > radius + CLEAR]
    points = of_positions(np.concatenate([circle, inside, outside]), at.box)
    return points, np.arange(len(circle) + len(inside))


def on_circle(radius: float) -> np.ndarray:
    """Points (n, 2) about one apart on a circle."""
    n = round(2*np.pi*radius)
    angle = 2*np.pi*(np.arange(n) + 0.5)/n
    return radius*np.stack([np.cos(angle), np.sin(angle)], axis=1)


def between_circles(counts: tuple[int, int], inner: float,
                    outer: float) -> tuple[Points, np.ndarray, np.ndarray]:
    """A lattice of spacing 1 with points on two circles; points up to the inner, and from the outer. Raises
    ValueError: there is no room between the circles, or between one of them and its image."""
    at = lattice(counts)
    check_disc(at, inner)
    check_disc(at, outer)
    if outer - inner < 2:
        raise ValueError(f"circles of radius {inner:g} and {outer:g} are too near: take more points")
    r = np.hypot(*at.x.T)
    off = (np.abs(r - inner) > CLEAR) & (np.abs(r - outer) > CLEAR)
    points = of_positions(np.concatenate([on_circle(inner), on_circle(outer), at.x[off]]), at.box)
    r = np.hypot(*points.x.T)
    return points, np.flatnonzero(r < inner + 1e-9), np.flatnonzero(r > outer - 1e-9)
