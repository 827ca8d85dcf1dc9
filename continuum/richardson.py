"""Extrapolation to infinitely fine grids: observed order, limit and its uncertainty."""
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from scipy.optimize import brentq

LOWEST, HIGHEST = 0.3, 8.0  # orders outside of this range are no orders


class Extrapolated(NamedTuple):
    """Observed order of convergence (NaN if there is none), limit, and half width of its 95 % interval."""
    order: float
    limit: float
    error: float


def richardson(values: Sequence[float] | np.ndarray, sizes: Sequence[float] | np.ndarray, *,
               expected: float = 2.0) -> Extrapolated:
    """Fit f = limit + C h^order to the three finest of three or more grids with h = 1/size, any ratios.

    The error is the larger of two: how far the limit moves when the expected order replaces the observed one, and
    how far it moves when the finest grid is left out (four grids or more). Without an observed order the limit is that
    of the expected order and the error the last difference.

    Raises
    ------
    ValueError
        Fewer than three grids, two of one size, or values that are not finite.
    """
    order = np.argsort(sizes)
    f, n = np.asarray(values, dtype=float)[order], np.asarray(sizes, dtype=float)[order]
    if len(f) < 3 or (np.diff(n) <= 0).any() or not np.isfinite(f).all():
        raise ValueError(f"extrapolation needs finite values on three grids of different size or more, got {f.tolist()} "
                         f"on {n.tolist()}: run another resolution")
    seen, plain = _order(f[-3:], 1/n[-3:]), _limit(f[-2:], 1/n[-2:], expected)
    if np.isnan(seen):
        return Extrapolated(seen, plain, abs(f[-1] - f[-2]))
    limit = _limit(f[-2:], 1/n[-2:], seen)
    coarser = _limit(f[-3:-1], 1/n[-3:-1], expected) if len(f) > 3 else limit
    return Extrapolated(seen, limit, max(abs(limit - plain), abs(limit - coarser)))


def _limit(f: np.ndarray, h: np.ndarray, order: float) -> float:
    return float(f[1] + (f[1] - f[0])*h[1]**order/(h[0]**order - h[1]**order))


def _order(f: np.ndarray, h: np.ndarray) -> float:
    """Order p with (f1 - f2)/(f2 - f3) = (h1^p - h2^p)/(h2^p - h3^p), NaN if there is none."""
    before, last = f[0] - f[1], f[1] - f[2]
    if abs(last) <= 1e-13*np.abs(f).max():
        return np.nan

    def mismatch(p: float) -> float:
        return before/last - (h[0]**p - h[1]**p)/(h[1]**p - h[2]**p)

    low, high = mismatch(LOWEST), mismatch(HIGHEST)
    return float(brentq(mismatch, LOWEST, HIGHEST)) if low*high < 0 else np.nan
