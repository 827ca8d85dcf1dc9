"""Points around discs: which of a lattice lie in one, or with points on the circle, the true surface."""
import numpy as np

from particles.integral.points import Points, lattice, of_positions

#: spacings between a surface and points off it: nearer ones would cut its edges or take short steps
CLEAR = 0.6


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
