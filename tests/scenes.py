"""Small scenes that tests share."""
import numpy as np

from particles.integral.bodies import Held, held
from particles.integral.points import Points, lattice, of_positions
from studies.conservation.slow_flows import CLEAR, on_circle


def rows_of(case, table: str) -> list[dict]:
    """Rows of a case that is run here."""
    return case.run(lambda done: None, None).rows[table]


def turning(points: Points, which: np.ndarray, rate: float, T: float = np.nan) -> Held:
    """Points that turn rigidly about the middle of the box, counterclockwise."""
    x, y = points.x[which].T
    return held(which, T=T)._replace(v=rate*np.stack([-y, x], axis=1))


def between_circles(counts: tuple[int, int], inner: float,
                    outer: float) -> tuple[Points, np.ndarray, np.ndarray]:
    """A lattice of spacing 1 with points on two circles; points up to the inner, and from the outer."""
    at = lattice(counts)
    r = np.hypot(*at.x.T)
    off = (np.abs(r - inner) > CLEAR) & (np.abs(r - outer) > CLEAR)
    points = of_positions(np.concatenate([on_circle(inner), on_circle(outer), at.x[off]]), at.box)
    r = np.hypot(*points.x.T)
    return points, np.flatnonzero(r < inner + 1e-9), np.flatnonzero(r > outer - 1e-9)
