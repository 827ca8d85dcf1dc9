"""The weight family: w(r) = scale phi(r/h) in d dimensions, zero from the range h on, with unit integral.

A weight is a NamedTuple made by ``Lucy.of(h=3.0)`` and two formulas of q = r/h, both zero at q = 1 so that the pair
loop needs no branch: `shape` phi(q) and `slope` phi'(q)/q, which is finite at q = 0. A new weight is one class here.
"""
from collections.abc import Callable
from functools import cache
from math import gamma, pi
from typing import NamedTuple

from scipy.integrate import quad

from continuum.jit import formula, generic


@generic
def shape(weight, q):
    """phi(q), phi(1) = 0, not normalised."""


@generic
def slope(weight, q):
    """phi'(q)/q, not normalised."""


@cache
def unit_integral(phi: Callable[[float], float], d: int) -> float:
    """Integral of phi(|x|) over the unit ball in d dimensions."""
    sphere = 2*pi**(d/2)/gamma(d/2)
    return sphere*quad(lambda q: phi(q)*q**(d - 1), 0, 1, points=[0.5], epsabs=1e-13, epsrel=1e-13)[0]


class _Fields(NamedTuple):
    h: float        # range, w(r >= h) = 0
    scale: float    # w(r) = scale phi(r/h)


class Weight(_Fields):
    """What all weights share."""

    @classmethod
    def of(cls, h: float, d: int = 2):
        """The weight of range h in d dimensions.

        Raises
        ------
        ValueError
            h is not positive or d is not 1, 2 or 3.
        """
        if not h > 0:
            raise ValueError(f"the range h of a weight must be positive, got {h}: KHP95 use h = 3 sigma")
        if d not in (1, 2, 3):
            raise ValueError(f"weights exist in d = 1, 2, 3 dimensions, got d = {d}")
        phi = shape.kinds[cls]
        return cls(h, 1/(unit_integral(lambda q: phi(None, q), d)*h**d))


class Lucy(Weight):
    """(5/pi h^2) (1 + 3q)(1 - q)^3 in 2D    [KHP95, Sec. II, Fig. 1]"""


class Monaghan(Weight):
    """Cubic B-spline, (40/7 pi h^2)(1 - 6q^2 + 6q^3), 2(1 - q)^3 from q = 1/2 on, in 2D    [KHP95, Sec. II, Fig. 1]"""


class WendlandC2(Weight):
    """(1 - q)^4 (1 + 4q): positive Fourier transform, no pairing."""


class WendlandC4(Weight):
    """(1 - q)^6 (1 + 6q + 35 q^2/3)."""


class WendlandC6(Weight):
    """(1 - q)^8 (1 + 8q + 25 q^2 + 32 q^3)."""


shape.of(Lucy)(lambda weight, q: (1 + 3*q)*(1 - q)**3)
slope.of(Lucy)(lambda weight, q: -12*(1 - q)**2)
shape.of(Monaghan)(lambda weight, q: 2*(1 - q)**3 - 8*max(0.5 - q, 0.0)**3)
# -6 (1-q)^2 + 24 (1/2-q)^2 = -12 q + 18 q^2 inside: written without a division by q = 0
slope.of(Monaghan)(lambda weight, q: -12 + 18*q if q < 0.5 else -6*(1 - q)**2/q)
shape.of(WendlandC2)(lambda weight, q: (1 - q)**4*(1 + 4*q))
slope.of(WendlandC2)(lambda weight, q: -20*(1 - q)**3)
shape.of(WendlandC4)(lambda weight, q: (1 - q)**6*(1 + 6*q + 35*q**2/3))
slope.of(WendlandC4)(lambda weight, q: -56/3*(1 - q)**5*(1 + 5*q))
shape.of(WendlandC6)(lambda weight, q: (1 - q)**8*(1 + 8*q + 25*q**2 + 32*q**3))
slope.of(WendlandC6)(lambda weight, q: -22*(1 - q)**7*(1 + 7*q + 16*q**2))

WEIGHTS = {"lucy": Lucy, "monaghan": Monaghan, "wendland-c2": WendlandC2, "wendland-c4": WendlandC4,
           "wendland-c6": WendlandC6}


@formula
def value_and_slope(weight, r):
    """w(r) and w'(r)/r at one distance, zero beyond the range."""
    q = min(r/weight.h, 1.0)
    return weight.scale*shape(weight, q), weight.scale/weight.h**2*slope(weight, q)
