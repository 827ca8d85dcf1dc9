"""Rows of fixed particles behind a plate [KHP95, Fig. 2], with an elastic wall in the plate."""
from typing import NamedTuple

import numpy as np

from particles.walls import confine, fixed_points
from particles.walls.mirror import _reflect


class FixedRows(NamedTuple):
    """`rows` rows of particles at rest behind a plate across y, `spacing` apart, from half a spacing on.
    Their temperature is extrapolated linearly from the plate: T + slope (y - at)."""
    at: float
    inner: float
    T: float
    slope: float
    rows: int
    spacing: float


def fixed_plates(height: float, T_hot: float, T_cold: float, rows: int = 6, spacing: float = 1.0) -> tuple:
    """Hot plate below, cold plate above; their rows continue the conduction profile. Six rows are two ranges.
    Raises ValueError: bad rows or spacing, or the profile reaches T = 0 in the rows above the cold plate."""
    if not (rows == int(rows) and rows >= 1 and spacing > 0):
        raise ValueError(f"behind a plate are whole rows, at least one, and a spacing above 0, got rows = "
                         f"{rows}, spacing = {spacing}: KHP95 have 6 rows, 1 apart")
    slope = (T_cold - T_hot)/height
    last = T_cold + slope*(rows - 0.5)*spacing
    if not last > 0:
        raise ValueError(f"the last of {rows} fixed rows would have T = {last:.4g}, extrapolated from "
                         f"{T_cold:g} by {slope:.4g} y: it must be positive; take a higher box, fewer rows "
                         "or closer temperatures")
    return (FixedRows(-height/2, 1.0, T_hot, slope, rows, spacing),
            FixedRows(height/2, -1.0, T_cold, slope, rows, spacing))


@fixed_points.of(FixedRows)
def _(wall, width, height):
    columns = round(width/wall.spacing)
    x = (np.arange(columns) + 0.5)*width/columns - width/2  # stretched to fit a periodic box of any width
    y = wall.at - wall.inner*(np.arange(wall.rows) + 0.5)*wall.spacing
    x, y = (q.ravel() for q in np.meshgrid(x, y))
    return x, y, wall.T + wall.slope*(y - wall.at)


confine.of(FixedRows)(lambda wall, state: _reflect(state[1], state[3], wall.at, wall.inner))
