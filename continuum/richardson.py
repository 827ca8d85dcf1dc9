"""Observed order, limit and its uncertainty from values on three or more grids."""
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from scipy.optimize import brentq

ORDERS = 0.1, 12.0      # between which an observed order is looked for
NEAR = 0.25             # of the assumed order: the grids are fine enough for it


class Extrapolated(NamedTuple):
    """Order on the three finest grids (nan: values do not converge), limit, and its uncertainty."""
    order: float
    limit: float
    error: float


def richardson(values: Sequence[float], sizes: Sequence[float]) -> Extrapolated:
    """Limit of values for h = 1/size -> 0, sizes being cells per length in any order and ratio.

    The three finest grids give f + a h^2 + b h^4. The error is the larger of the distances to two limits of
    the two finest grids: with a alone, and with the order that is seen. Where that is more than NEAR off, its
    own limit is given, with the whole distance to the finest grid for its error; where there is none, the
    finest value with twice the spread of all three.
    """
    f, h = finest(values, sizes)
    seen = observed_order(f, h)
    if np.isnan(seen):
        return Extrapolated(order=seen, limit=float(f[-1]), error=2*float(np.ptp(f)))
    own = eliminate(f[1:], h[1:], seen)
    if abs(seen - 2) > NEAR:
        return Extrapolated(order=seen, limit=own, error=abs(own - float(f[-1])))
    limit = eliminate(f, h, 2.0, 4.0)
    others = own, eliminate(f[1:], h[1:], 2.0)
    return Extrapolated(order=seen, limit=limit, error=max(abs(limit - other) for other in others))


def finest(values: Sequence[float], sizes: Sequence[float]) -> tuple[np.ndarray, np.ndarray]:
    """The values and spacings of the three finest grids, coarse to fine."""
    f, n = np.asarray(values, float), np.asarray(sizes, float)
    if f.shape != n.shape or f.ndim != 1 or len(set(n)) < 3 or len(set(n)) < len(n):
        raise ValueError(f"{f.size} values on sizes {n.tolist()}: give one value for each of three or more "
                         "different sizes")
    if not (np.isfinite(f).all() and (n > 0).all()):
        raise ValueError(f"values {f.tolist()} on sizes {n.tolist()}: values must be finite, sizes positive")
    last = np.argsort(n)[-3:]
    return f[last], 1/n[last]


def eliminate(f: np.ndarray, h: np.ndarray, *powers: float) -> float:
    """The constant of f = constant + sum of a_p h^p, one grid more than powers."""
    terms = [(h/h[-1])**p for p in powers]      # relative to the finest: keeps the system well scaled
    return float(np.linalg.solve(np.array([np.ones(len(h)), *terms]).T, f)[0])


def observed_order(f: np.ndarray, h: np.ndarray) -> float:
    """p of f + a h^p through three grids, nan if there is none in ORDERS."""
    coarse, fine = f[0] - f[1], f[1] - f[2]

    def misfit(p):
        r = h/h[2]
        return coarse*(r[1]**p - 1) - fine*(r[0]**p - r[1]**p)
    low, high = misfit(ORDERS[0]), misfit(ORDERS[1])
    return float(brentq(misfit, *ORDERS)) if low*high < 0 else float("nan")
