"""Fits, each once: polynomials and power laws by least squares, limits of fine grids; errors are of 95 %."""
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import pandas as pd
from numpy.polynomial.polynomial import polyvander as vander
from scipy.special import stdtrit

from continuum.richardson import richardson
from studies.kit.stats import CannotTell, Measured

Numbers = Sequence[float] | np.ndarray | pd.Series


@dataclass(frozen=True)
class Fit:
    """y = c_0 + c_1 x + c_2 x^2 ... by least squares.

    coefficients : (p,), from the constant on. residuals : (n,).
    spread : (p, p), their covariance, such that sqrt(v@spread@v) is the 95 % half width of v@coefficients.
    """

    coefficients: np.ndarray
    spread: np.ndarray
    residuals: np.ndarray

    def along(self, v: Numbers) -> Measured:
        """The combination v@coefficients and its error."""
        v = np.asarray(v, float)
        return Measured(float(v@self.coefficients), float(np.sqrt(v@self.spread@v)))

    def at(self, x: float) -> Measured:
        """The curve read at x."""
        return self.along(x**np.arange(len(self.coefficients)))

    @property
    def slope(self) -> Measured:
        """c_1."""
        return self.along(np.arange(len(self.coefficients)) == 1)

    @property
    def intercept(self) -> Measured:
        """c_0."""
        return self.at(0.0)


def polynomial(x: Numbers, y: Numbers, degree: int = 1, *, weight: Numbers | None = None,
               err: Numbers | None = None) -> Fit:
    """Least squares of ``weight`` (y - c_0 - c_1 x ...), with the error that scatter about the curve tells.

    With X_nj = x_n^j, w = diag(weight), A = (wX)^+ w:

        c = A y,   covariance = t^2 s^2 (X^T w^2 X)^-1 + A diag(err^2) A^T,   s^2 = |w (y - X c)|^2/(n - p)

    t is Student's, of n - p degrees of freedom; ``err`` (n,) are errors of the values besides the scatter.

    Raises CannotTell: there are no more values than coefficients.
    """
    X, y = vander(np.asarray(x, float), degree), np.asarray(y, float)
    w = np.ones(len(y)) if weight is None else np.asarray(weight, float)
    freedom = len(y) - degree - 1
    if freedom < 1:
        raise CannotTell(f"not run yet: {degree + 1} coefficients and their error take {degree + 2} values "
                         f"or more, there are {len(y)}")
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


def weighted(x: Numbers, y: Numbers, err: Numbers, degree: int = 1) -> Fit:
    """Least squares of (y - c_0 - c_1 x ...)/err; the error is what those of the values leave."""
    y, err = np.asarray(y, float), np.asarray(err, float)
    X = vander(np.asarray(x, float), degree)
    wX = X/err[:, None]
    spread = np.linalg.inv(wX.T@wX)
    c = spread@wX.T@(y/err)
    return Fit(c, spread, y - X@c)


def line(x: Numbers, y: Numbers, *, weight: Numbers | None = None, err: Numbers | None = None) -> Fit:
    """A straight line; see `polynomial`."""
    return polynomial(x, y, 1, weight=weight, err=err)


def power_law(x: Numbers, y: Numbers, err: Numbers | None = None) -> Fit:
    """ln |y| against ln x: its slope is the power, of errors over spacings the order. err : of y."""
    x, y = np.asarray(x, float), np.abs(np.asarray(y, float))
    relative = None if err is None else np.asarray(err, float)/y
    return line(np.log(x), np.log(y), err=relative)


def grid_limit(sizes: Numbers, values: Numbers) -> Measured:
    """Limit of infinitely fine grids, ``sizes`` in cells per length, from the three finest [Richardson].

    Raises CannotTell: there are fewer than three grids.
    """
    grids = len(set(sizes))
    if grids < 3:
        raise CannotTell(f"not run yet: a limit takes three grids, got {grids}")
    fine = richardson(list(values), list(sizes))
    return Measured(float(fine.limit), float(fine.error))
