"""Polynomials and power laws by least squares, limits of fine grids; errors are 95 % half widths."""
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
import pandas as pd
from numpy.polynomial.polynomial import polyvander as vander
from scipy.optimize import brentq
from scipy.special import stdtrit

from studies.kit.stats import CannotTell, Measured, Numbers

ORDERS = 0.1, 12.0      # range in which an observed order is sought
NEAR = 0.25             # an observed order nearer to 2 means that the grids are fine enough to assume 2


@dataclass(frozen=True)
class Fit:
    """y = c_0 + c_1 x + c_2 x^2 ... by least squares.

    coefficients : (p,), constant first. residuals : (n,).
    spread : (p, p), covariance, scaled so that sqrt(v@spread@v) is the 95 % half width of v@coefficients.
    """

    coefficients: np.ndarray
    spread: np.ndarray
    residuals: np.ndarray

    def along(self, v: Numbers) -> Measured:
        """Linear combination v@coefficients with its error."""
        v = np.asarray(v, float)
        return Measured(float(v@self.coefficients), float(np.sqrt(v@self.spread@v)))

    def at(self, x: float) -> Measured:
        """Value of the curve at x with its error."""
        return self.along(x**np.arange(len(self.coefficients)))

    @property
    def slope(self) -> Measured:
        """Coefficient c_1 with its error."""
        return self.along(np.arange(len(self.coefficients)) == 1)

    @property
    def intercept(self) -> Measured:
        """Coefficient c_0 with its error."""
        return self.at(0.0)


def linear(X: np.ndarray, y: Numbers, *, weight: Numbers | None = None, err: Numbers | None = None) -> Fit:
    """Least squares of ``weight`` (y - X c), X (n, p), with errors from the scatter about the curve.

    With w = diag(weight), A = (wX)^+ w:

        c = A y,   covariance = t^2 s^2 (X^T w^2 X)^-1 + A diag(err^2) A^T,   s^2 = |w (y - X c)|^2/(n - p)

    t is Student's factor for n - p degrees of freedom; ``err`` (n,) are further errors of the values.

    Raises CannotTell: there are not more values than coefficients.
    """
    y, p = np.asarray(y, float), X.shape[1]
    w = np.ones(len(y)) if weight is None else np.asarray(weight, float)
    freedom = len(y) - p
    if freedom < 1:
        raise CannotTell(f"not run yet: {p} coefficients and their error take {p + 1} values or more, there "
                         f"are {len(y)}")
    wX = w[:, None]*X
    size = np.linalg.norm(wX, axis=0)
    inverse = np.linalg.pinv(wX/size)/size[:, None]
    A = inverse*w
    residuals = y - X@(A@y)
    scatter = stdtrit(freedom, 0.975)**2*np.sum((w*residuals)**2)/freedom
    spread = scatter*inverse@inverse.T
    if err is not None:
        spread = spread + (A*np.asarray(err, float)**2)@A.T
    return Fit(A@y, spread, residuals)


def polynomial(x: Numbers, y: Numbers, degree: int, *, weight: Numbers | None = None,
               err: Numbers | None = None) -> Fit:
    """Least-squares polynomial y = c_0 + c_1 x + c_2 x^2 ...; weight, err : as for `linear`."""
    return linear(vander(np.asarray(x, float), degree), y, weight=weight, err=err)


def weighted(x: Numbers, y: Numbers, err: Numbers) -> Fit:
    """Straight line by least squares of (y - c_0 - c_1 x)/err; its error is that propagated from ``err``."""
    y, err = np.asarray(y, float), np.asarray(err, float)
    X = vander(np.asarray(x, float), 1)
    wX = X/err[:, None]
    spread = np.linalg.inv(wX.T@wX)
    c = spread@wX.T@(y/err)
    return Fit(c, spread, y - X@c)


def line(x: Numbers, y: Numbers, *, err: Numbers | None = None) -> Fit:
    """Straight line by least squares; err : as for `linear`."""
    return polynomial(x, y, 1, err=err)


def power_law(x: Numbers, y: Numbers, err: Numbers | None = None) -> Fit:
    """Line of ln |y| against ln x: its slope is the power, or the order of errors in spacing. err : of y."""
    x, y = np.asarray(x, float), np.abs(np.asarray(y, float))
    relative = None if err is None else np.asarray(err, float)/y
    return line(np.log(x), np.log(y), err=relative)


def crossing(pair: pd.DataFrame, column: str, level: float) -> tuple[float, float]:
    """Cost (``column``) at which the error is ``level``, between two rows, and the half width of ln cost.

    ln cost = (1 - s) ln cost_0 + s ln cost_1, s = ln(error_0/level)/ln(error_0/error_1); all are uncertain.
    """
    (first, last), (low, high) = np.log(pair.error), np.log(pair[column])
    s = (first - np.log(level))/(first - last)
    slope = (high - low)/(first - last)
    err = np.hypot(pair[f"{column}_err"]/pair[column], slope*pair.error_err/pair.error)
    half = np.linalg.norm([1 - s, s]*err)
    return float(np.exp(low + s*(high - low))), float(half)


def grid_limit(sizes: Numbers, values: Numbers) -> Measured:
    """Limit of infinitely fine grids by `richardson`; ``sizes`` in cells per length.

    Raises CannotTell: there are fewer than three grids.
    """
    if len(set(sizes)) < 3:
        raise CannotTell(f"not run yet: a limit takes three grids, got {len(set(sizes))}")
    _, limit, error = richardson(values, sizes)
    return Measured(limit, error)


def four_grids(sizes: Numbers, values: Numbers) -> Measured:
    """Limit as in `grid_limit`. Its error is twice the change by a term in h^6 through the four finest grids,
    as further terms change less; that of `grid_limit` for three grids or an order other than 2.
    """
    limit = grid_limit(sizes, values)
    f, h = finest(values, sizes, 4)
    if len(f) < 4 or not abs(observed_order(f[1:], h[1:]) - 2) < NEAR:
        return limit
    return Measured(limit.value, 2*abs(eliminate(f, h, 2.0, 4.0, 6.0) - limit.value))


class Extrapolated(NamedTuple):
    """Order on the three finest grids (nan: values do not converge), limit, and error of the limit."""
    order: float
    limit: float
    error: float


def richardson(values: Numbers, sizes: Numbers) -> Extrapolated:
    """Limit of values for h = 1/size -> 0, sizes being cells per length in any order and ratio.

    The limit is f of f + a h^2 + b h^4 through the three finest grids. Its error is the larger distance to
    the limits of the two finest grids with order 2 and with the observed order. If the observed order is
    more than NEAR from 2, the limit is the one with the observed order, and its error the distance to the
    finest value. Without an observed order it is the finest value, with twice the range of all three.
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


def finest(values: Numbers, sizes: Numbers, count: int = 3) -> tuple[np.ndarray, np.ndarray]:
    """Values and spacings of the ``count`` finest grids, coarse to fine. Raises ValueError: wrong input."""
    f, n = np.asarray(values, float), np.asarray(sizes, float)
    if not (len(set(n)) == len(f) >= 3 and np.isfinite(f).all()):
        raise ValueError(f"values {f.tolist()} on sizes {n.tolist()}: give a finite value for each of three "
                         "or more different sizes")
    last = np.argsort(n)[-count:]
    return f[last], 1/n[last]


def eliminate(f: np.ndarray, h: np.ndarray, *powers: float) -> float:
    """The constant of f = constant + sum of a_p h^p through one grid more than powers."""
    terms = [(h/h[-1])**p for p in powers]      # relative to the finest grid: well scaled
    return float(np.linalg.solve(np.array([np.ones(len(h)), *terms]).T, f)[0])


def observed_order(f: np.ndarray, h: np.ndarray) -> float:
    """Order p of f + a h^p through three grids, nan if there is none in ORDERS."""
    coarse, fine = f[0] - f[1], f[1] - f[2]

    def misfit(p):
        r = h/h[2]
        return coarse*(r[1]**p - 1) - fine*(r[0]**p - r[1]**p)
    low, high = misfit(ORDERS[0]), misfit(ORDERS[1])
    return float(brentq(misfit, *ORDERS)) if low*high < 0 else float("nan")
