"""RR98's interpolant of the gradient: W = -f' of a normalised weight f, and its moments    [RR98, Sec. II A]

    grad A(r) = -lim int A(r') e W(|r - r'|) dr', e = (r - r')/|r - r'|    [RR98 Eq. 1]

Any normalised weight f can be used: the compact ones of `particles.weights`, and the paper's exponential
(Eqs 30, 31) and the Gaussian, whose tails and singularities suit operators on few points, not fast loops.
"""
import warnings
from collections.abc import Callable
from math import gamma, pi
from typing import Any, NamedTuple

import numpy as np
from scipy.integrate import quad
from scipy.special import gammaincc

from continuum.jit import generic, jit
from particles.weights import Weight, value_and_slope

NEGLIGIBLE = 1e-16      # share of the first moment beyond the reach of a weight with a tail
SEEN = 1e-2             # error of linear gradients above which a violated Eq. 45 gives a warning


def sphere(d: int) -> float:
    """Area of the unit sphere in d dimensions: 2, 2 pi, 4 pi."""
    return 2*pi**(d/2)/gamma(d/2)


class Exponential(NamedTuple):
    """f = exp(-r/r0)/(r0 |S_d| r^(d-1)): in 3D RR98's choice    [Eqs 4, 30]"""
    r0: float
    d: int = 3


class Gaussian(NamedTuple):
    """f = exp(-r^2/2 r0^2)/(2 pi r0^2)^(d/2)"""
    r0: float
    d: int = 3


@generic
def f(weight, r):
    """The weight f(r), of integral 1 in d dimensions."""


@generic
def W(weight, r):
    """W(r) = -f'(r)    [RR98 Eq. 3]"""


@generic
def reach(weight):
    """Distance beyond which W is zero or carries less than 1e-16 of the first moment."""


@generic
def width(weight):
    """Length r0, the unit of moments; the range h of compact weights."""


f.of(Exponential)(lambda weight, r: np.exp(-r/weight.r0)/(weight.r0*sphere(weight.d)*r**(weight.d - 1)))
W.of(Exponential)(lambda weight, r: f(weight, r)*(1/weight.r0 + (weight.d - 1)/r))       # Eq. 31 in 3D
f.of(Gaussian)(lambda weight, r: np.exp(-(r/weight.r0)**2/2)/(2*pi*weight.r0**2)**(weight.d/2))
W.of(Gaussian)(lambda weight, r: f(weight, r)*r/weight.r0**2)
width.of(Exponential)(lambda weight: weight.r0)
width.of(Gaussian)(lambda weight: weight.r0)


def _tail(share: Callable[[float], float]) -> float:
    """The multiple of r0 beyond which the share is negligible."""
    r = 1.0
    while share(r) > NEGLIGIBLE:
        r += 0.25
    return r


# first moment beyond r: int W r dV by parts, int (d f + ...), gives gamma functions of r/r0
reach.of(Exponential)(lambda weight: weight.r0*_tail(lambda r: float(gammaincc(2, r))
                                                     + (weight.d - 1)*np.exp(-r)))
reach.of(Gaussian)(lambda weight: weight.r0*_tail(lambda r: float(gammaincc(weight.d/2 + 1, r*r/2))))


@jit
def _table(weight, r, out):
    """(f, W) at distances r, (2, n)."""
    for i in range(len(r)):
        value, slope = value_and_slope(weight, r[i])
        out[0, i], out[1, i] = value, -r[i]*slope


def _at(weight: Any, r: Any, row: int) -> Any:
    r = np.asarray(r, float)
    out = np.empty((2, r.size))
    _table(weight, r.ravel(), out)
    return out[row].reshape(r.shape)


f.of(Weight)(lambda weight, r: _at(weight, r, 0))
W.of(Weight)(lambda weight, r: _at(weight, r, 1))
reach.of(Weight)(lambda weight: weight.h)
width.of(Weight)(lambda weight: weight.h)


def moment(weight: Any, n: int, d: int) -> float:
    """M_n = r0^(1-n) int r^n W dV in d dimensions    [RR98 Eq. 2]; M_1 = d for every normalised f."""
    r0 = width(weight)
    integral, _ = quad(lambda q: (q*r0)**(n + d - 1)*float(W(weight, q*r0)), 0, reach(weight)/r0, limit=400,
                       epsabs=1e-13, epsrel=1e-12, points=[0.5, 1.0] if reach(weight) > r0 else [0.5])
    return sphere(d)*integral*r0**(2 - n)


class OrderingWarning(UserWarning):
    """Spacing < r0 < wavelength is violated    [RR98 Eq. 45]"""


def check_ordering(weight: Any, d: int, a: float, error: float,
                   wrong: str = "gradients of linear fields are") -> None:
    """Warn if r0 is below the spacing a = (dV)^(1/d) and the error of what is `wrong` exceeds SEEN."""
    r0 = width(weight)*float(np.sqrt(moment(weight, 3, d)/(d + 2)))        # sqrt(int r^2 f dV)
    if r0 < a and error > SEEN:
        warnings.warn(f"r0 = {r0:.3g} (rms width of {type(weight).__name__}) is below the spacing {a:.3g}, "
                      f"the left side of Eq. 45: {wrong} off by {100*error:.3g} % (rms) on these points; "
                      "take a wider weight, or exact edges", OrderingWarning, 4)


def check(weight: Any, d: int) -> None:
    """Raise ValueError unless a weight has M_1 = d and a positive, finite width."""
    name = "range h" if isinstance(weight, Weight) else "width r0"
    if not 0 < width(weight) < np.inf:
        raise ValueError(f"the {name} of {type(weight).__name__} must be positive and finite, got "
                         f"{width(weight)}: Eq. 45 asks for more than a spacing")
    first = moment(weight, 1, d)
    if not abs(first - d) <= 1e-6*d:
        raise ValueError(f"{type(weight).__name__} has M_1 = {first:.6g} in {d} dimensions, which must be "
                         f"{d} (RR98 Eq. 2): normalise it, or make it for d = {d}")
