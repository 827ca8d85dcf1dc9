"""Rows of fixed particles behind a plate [KHP95, Fig. 2], with an elastic wall in the plate.

They have the density of the fluid; the paper's are denser, by how much is not printed.
"""
from typing import NamedTuple

import numpy as np

from particles.walls import confine, fixed_points
from particles.walls.mirror import _reflect

ROWS = 6        # two ranges of KHP95's weight


class FixedRows(NamedTuple):
    """Rows of particles at rest behind a plate across y, one apart, the first at half of that. Their
    temperature is extrapolated linearly from the plate: T + slope (y - at)."""
    at: float
    inner: float
    T: float
    slope: float


def fixed_plates(height: float, T_hot: float, T_cold: float) -> tuple:
    """Hot plate below, cold plate above; their rows continue the conduction profile. Raises ValueError: it
    reaches T = 0 in the rows above the cold plate."""
    slope = (T_cold - T_hot)/height
    last = T_cold + slope*(ROWS - 0.5)
    if not last > 0:
        raise ValueError(f"the last of {ROWS} fixed rows would have T = {last:.4g}, extrapolated from "
                         f"{T_cold:g} by {slope:.4g} y: it must be positive; take a higher box or closer "
                         "temperatures")
    return FixedRows(-height/2, 1.0, T_hot, slope), FixedRows(height/2, -1.0, T_cold, slope)


@fixed_points.of(FixedRows)
def _(wall, width, height):
    columns = round(width)
    x = (np.arange(columns) + 0.5)*width/columns - width/2  # stretched to fit a periodic box of any width
    y = wall.at - wall.inner*(np.arange(ROWS) + 0.5)
    x, y = (q.ravel() for q in np.meshgrid(x, y))
    return x, y, wall.T + wall.slope*(y - wall.at)


confine.of(FixedRows)(lambda wall, state: _reflect(state[1], state[3], wall.at, wall.inner))
