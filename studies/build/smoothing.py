"""The grid's field seen through a weight, as smooth particles see theirs: what of a difference in K is smoothing alone."""
from collections.abc import Iterator
from typing import Any, NamedTuple

import numpy as np
from scipy.signal import oaconvolve

from continuum.gas.fields import NodeFields, interpolate
from particles.weights import value_and_slope

FINE = 240     # places over the height: the range of 100 rows covers 7


class Smoothing(NamedTuple):
    """A weight of `particles.weights` with range h spacings, `rows` spacings over the height."""
    weight: Any
    h: float
    rows: int


def smoothed_energy(fields: NodeFields, smoothing: Smoothing) -> tuple[float, float]:
    """(K, K of <v> = sum m v w/sum m w) of a field, particles lying as densely as the fluid does.

    Behind walls the density is mirrored and the velocity zero, as for the printed images    [KHP95, Secs II, VI, Fig. 3]
    """
    width, L = fields.scene.width, fields.scene.L
    columns = round(FINE*width/L)
    x, y = ((np.arange(n) + 0.5)/n*size - size/2 for n, size in ((columns, width), (FINE, L)))
    at, w = interpolate(fields, *np.meshgrid(x, y)), kernel(smoothing)
    mirror, rest = ("wrap", "wrap") if fields.periodic else ("symmetric", "constant")
    rho = oaconvolve(padded(at.rho, len(w)//2, mirror, "symmetric"), w, mode="valid")
    px, py = (oaconvolve(padded(at.rho*v, len(w)//2, rest, "constant"), w, mode="valid") for v in (at.vx, at.vy))
    squares = (at.vx**2 + at.vy**2, (px**2 + py**2)/rho**2)
    plain, smooth = (float(0.5*np.sum(at.rho*v2)/np.sum(at.rho)) for v2 in squares)
    return plain, smooth


def kernel(smoothing: Smoothing) -> np.ndarray:
    """The weight on the fine places, (2n + 1, 2n + 1)."""
    weight, finer = smoothing.weight.of(smoothing.h), smoothing.rows/FINE
    n = np.arange(-int(smoothing.h/finer), int(smoothing.h/finer) + 1)*finer
    return np.array([[value_and_slope(weight, float(np.hypot(a, b)))[0] for a in n] for b in n])


def padded(q: np.ndarray, margin: int, along: str, across: str) -> np.ndarray:
    """A field with `margin` more places beyond the sides and beyond the plates."""
    wide = np.pad(q, ((0, 0), (margin, margin)), along)  # type: ignore[call-overload]
    return np.pad(wide, ((margin, margin), (0, 0)), across)  # type: ignore[call-overload]


def smoothed_rows(point: dict, fields: NodeFields, smoothings: tuple[Smoothing, ...]) -> Iterator[dict]:
    """Rows of the table `smoothed`; `point` has the key columns of the grid's row."""
    for smoothing in smoothings:
        plain, smooth = smoothed_energy(fields, smoothing)
        yield {**point, "weight": smoothing.weight.__name__, "h": smoothing.h, "rows": smoothing.rows, "ke": plain,
               "ke_smoothed": smooth}
