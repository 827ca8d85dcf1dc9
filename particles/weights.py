"""The weight family: w(r) = scale phi(r/h) in d dimensions, zero from the range h on, with unit integral.

A weight is a NamedTuple, as made by ``Lucy.of(h=3.0)``, and two formulas of q = r/h. Both are zero at q = 1,
so that the pair loop needs no branch: `shape` phi(q) and `slope` phi'(q)/q, which is finite at q = 0.
"""
from collections.abc import Callable
from functools import cache
from math import gamma, inf, isfinite, nan, pi
from numbers import Real
from typing import NamedTuple

import numpy as np
from scipy.integrate import quad

from continuum.jit import formula, generic


@generic
def shape(weight, q):
    """phi(q), phi(1) = 0, not normalised."""


@generic
def slope(weight, q):
    """phi'(q)/q, not normalised."""


LONGEST = 1e100     # largest range; its cube is a finite float
Formula = Callable[[None, float], float]
#: q, off the knots of splines, where the slope is compared with a difference quotient, and its step
PLACES, STEP = (0.1370, 0.3891, 0.6129, 0.8713), 1e-5
#: relative to the largest value: what expanded polynomials with coefficients of thousands leave at q = 1
ROUND_OFF = 1e-12
#: relative to the steepest slope: difference quotients err by 2e-8 if phi''' = 1000 phi', round-off is 1e-10
DIFFERENCE = 1e-6


@cache
def unit_integral(phi: Formula, d: int) -> float:
    """Integral of phi(|x|) over the unit ball in d dimensions."""
    sphere = 2*pi**(d/2)/gamma(d/2)
    return sphere*quad(lambda q: phi(None, q)*q**(d - 1), 0, 1, points=[0.5], epsabs=1e-13, epsrel=1e-13)[0]


def formulas(kind: type) -> tuple[Formula, Formula]:
    """(phi(q), phi'(q)/q) of a kind of weight. Raises TypeError: one of them is missing."""
    for name, known, text in (("shape", shape.kinds, "phi(q), q = r/h"), ("slope", slope.kinds, "phi'(q)/q")):
        if kind not in known:
            raise TypeError(f"{kind.__name__} has no {name}: add {name}.of({kind.__name__})(lambda weight, "
                            f"q: ...) with {text}, as in particles/weights.py")
    return shape.kinds[kind], slope.kinds[kind]


@cache
def check_formulas(name: str, phi: Formula, over_q: Formula) -> None:
    """Check formulas, as pair loops have no branch for the range. Raises ValueError: phi or phi'/q is not
    zero at q = 1, phi'/q is not finite at q = 0, or phi'/q is not the derivative of phi over q."""
    largest, steepest = (max(abs(f(None, q)) for q in PLACES) for f in (phi, over_q))
    for what, edge, size in (("phi", phi(None, 1.0), largest), ("phi'/q", over_q(None, 1.0), steepest)):
        if not abs(edge) <= ROUND_OFF*size:
            raise ValueError(f"{what} of {name} is {edge:.6g} at q = 1, where it must be zero: pairs beyond "
                             "the range would feel it; let phi end in (1 - q)^2 or a higher power")
    with np.errstate(all="ignore"):
        centre = over_q(None, np.float64(0))
    if not isfinite(centre):
        raise ValueError(f"phi'/q of {name} is {centre} at q = 0, where a particle meets itself: let phi "
                         "begin as 1 - c q^2, and write its slope without a division by q")
    found = [(q, q*over_q(None, q), (phi(None, q + STEP) - phi(None, q - STEP))/(2*STEP)) for q in PLACES]
    for q, given, difference in found:
        if not abs(given - difference) <= DIFFERENCE*max(abs(d) for _, _, d in found):
            raise ValueError(f"slope of {name} is {given/q:.6g} at q = {q}, but phi'(q)/q there is "
                             f"{difference/q:.6g}: give the derivative of phi, divided by q")


class Weight(NamedTuple):
    """What all weights share."""
    h: float        # range, w(r >= h) = 0
    scale: float    # w(r) = scale phi(r/h)

    @classmethod
    def of(cls, h: float, d: int = 2):
        """Make the weight of range h in d dimensions.

        Raises TypeError: h is no number, or a formula is missing. ValueError: h, d or a formula is not valid.
        """
        if not isinstance(h, Real):
            raise TypeError(f"the range h of a weight must be a number, got {h!r}: KHP95 use h = 3 sigma")
        if not 0 < h < inf:
            raise ValueError(f"the range h of a weight must be positive and finite, got {h}: take 3 sigma")
        if not 1/LONGEST < h < LONGEST:
            raise ValueError(f"no float holds h^d of a weight of range h = {h}: take 3 sigma")
        if d not in (1, 2, 3):
            raise ValueError(f"weights exist in d = 1, 2, 3 dimensions, got d = {d}")
        phi, over_q = formulas(cls)
        check_formulas(cls.__name__, phi, over_q)
        return cls(h, 1/(unit_integral(phi, d)*h**d))


def check_unit(weight: Weight) -> None:
    """Check that the integral of a weight in 2D, a factor of every density, is 1. Raises ValueError."""
    kind, h = type(weight), weight.h
    whole = weight.scale*unit_integral(formulas(kind)[0], 2)*h**2 if 0 < h < inf else nan
    if not abs(whole - 1) <= 1e-9:
        raise ValueError(f"{kind.__name__} of range h = {h:g} has the integral {whole:.6g} in 2 dimensions, "
                         f"which must be 1: make it with {kind.__name__}.of(h=..., d=2)")


class Lucy(Weight):
    """(5/pi h^2) (1 + 3q)(1 - q)^3 in 2D    [KHP95, Sec. II, Fig. 1]"""


class Monaghan(Weight):
    """Cubic B-spline, (40/7 pi h^2)(1 - 6q^2 + 6q^3), 2(1 - q)^3 from q = 1/2 on [KHP95, Sec. II, Fig. 1]"""


class WendlandC2(Weight):
    """(1 - q)^4 (1 + 4q): positive Fourier transform, no pairing."""


class WendlandC4(Weight):
    """(1 - q)^6 (1 + 6q + 35 q^2/3)."""


class WendlandC6(Weight):
    """(1 - q)^8 (1 + 8q + 25 q^2 + 32 q^3)."""


shape.of(Lucy)(lambda weight, q: (1 + 3*q)*(1 - q)**3)
slope.of(Lucy)(lambda weight, q: -12*(1 - q)**2)
shape.of(Monaghan)(lambda weight, q: 2*(1 - q)**3 - 8*max(0.5 - q, 0.0)**3)
# -6 (1-q)^2 + 24 (1/2-q)^2 = -12 q + 18 q^2 below q = 1/2: written without a division by q = 0
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
