"""What RR98 says of its operators, judged    [RR98 Eqs 2, 5, 6, 29, 31, 32, 45]"""
from math import pi

import numpy as np

from particles.integral.edge_makers import plain, printed, renormalised
from particles.integral.interpolants import Exponential, f, moment, sphere
from particles.integral.points import lattice
from particles.weights import WEIGHTS, Lucy
from studies.build.read import Value, exact, ratio, select
from studies.kit.claim import CannotTell, Claim
from studies.kit.stats import Measured
from studies.kit.table import Tables
from studies.ordering.derive import line
from studies.ordering.waves import wave_errors


def first_moments() -> float:
    """Largest |M_1/d - 1| of all weights in 1, 2 and 3 dimensions."""
    compact = [(kind.of(h=1.3, d=d), d) for kind in WEIGHTS.values() for d in (1, 2, 3)]
    return max(abs(moment(weight, 1, d)/d - 1) for weight, d in (*compact, *((Exponential(0.3, d), d) for d in (1, 2, 3))))


def third_factor() -> float:
    """Factor before the third derivatives in 3D: 1 - f^(k), the symbol's error at small k, over 3 k^2 r0^2 M_3/15."""
    weight, k = Lucy.of(h=1.0, d=3), 0.05
    r = (np.arange(20000) + 0.5)/20000
    transform = float(np.sum(4*pi*r**2*f(weight, r)*np.sin(k*r)/(k*r))/20000)
    return (1 - transform)/(3*k**2*moment(weight, 3, 3)/15)


def printed_factor(d: int) -> float:
    """Gradient of a linear field with Eq. 29, h = 6 a, over the prediction (|S_d|/d) M_d (h/a)^(d-1)."""
    at = lattice((48, 48) if d == 2 else (14, 14, 14))
    weight = Lucy.of(h=6.0, d=d)
    return float(printed(at, weight).linear[0, 0, 0])/(sphere(d)*moment(weight, d, d)*6.0**(d - 1)/d)


def printed_gradient(d: int) -> float:
    """Gradient of a linear field with Eq. 29, which should be 1."""
    at = lattice((48, 48) if d == 2 else (14, 14, 14))
    return float(printed(at, Lucy.of(h=3.0, d=d)).linear[0, 0, 0])


def plain_gradient() -> float:
    """|gradient - 1| of a linear field with plain quadrature W dV, 3D, h = 3 a."""
    return abs(float(plain(lattice((14, 14, 14)), Lucy.of(h=3.0, d=3)).linear[0, 0, 0]) - 1)


def slope(points: str, fixed: str, at: float) -> Value:
    """A slope of the gradient's error, Lucy's weight renormalised."""
    def value(tables: Tables) -> Measured:
        row = select(tables, "slopes", **LUCY, points=points, fixed=fixed, at=at, operator="gradient").iloc[0]
        return Measured(float(row["slope"]), float(row["slope_err"]))
    return value


def farthest_slope(tables: Tables) -> Measured:
    """The slope at h = 3 a on a lattice that is farthest from 2, of all compact weights."""
    rows = select(tables, "slopes", maker="renormalised", points="lattice", fixed="h/a", at=3.0, operator="gradient")
    if missing := {kind.__name__ for kind in WEIGHTS.values()} - set(rows["weight"]):
        raise CannotTell(f"not run yet: no slope of {', '.join(sorted(missing))}")
    worst = rows.iloc[int(np.argmax(abs(rows["slope"] - 2) + rows["slope_err"]))]
    return Measured(float(worst["slope"]), float(worst["slope_err"]))


def wider(points: str, maker: str) -> Value:
    """Error of the gradient with h = 3 a over that with h = 1.2 a, wavelength 32 a.

    Taking r0 as the rms width of Lucy's weight, 0.42 h in 2D, these have r0 = 1.27 a and 0.51 a: on either side of Eq. 45.
    """
    def value(tables: Tables) -> Measured:
        return ratio(*(error(tables, points, maker, h) for h in (3.0, 1.2)))
    return value


def wide_slope(tables: Tables) -> Measured:
    """d ln error/d ln h of the gradient at h = 4 to 8 a, on a lattice, wavelength 96 a, computed here."""
    at, k, ranges = lattice((96, 18)), 2*pi/96, (4.0, 5.0, 6.0, 7.0, 8.0)
    errors = [wave_errors(renormalised(at, Lucy.of(h=h)), at.x[:, 0], k)[0] for h in ranges]
    return Measured(*line(np.log(ranges), np.log(errors)))


def error(tables: Tables, points: str, maker: str, h: float) -> Measured:
    """Error of the gradient at the wavelength 32 a."""
    row = select(tables, "means", maker=maker, weight="Lucy", points=points, h=h, wavelength=32).iloc[0]
    return Measured(float(row["gradient"]), float(row["gradient_err"]))


LUCY = {"maker": "renormalised", "weight": "Lucy"}
CLAIMS = (
    Claim(id="rr98-eq2-first-moment", source="RR98 Eq. 2", printed="3", at_most=1e-9, value=exact(first_moments),
          statement="W = -f' of a normalised f has M_1 = d: all weights, 1 to 3 dimensions, largest relative difference",
          because="quadrature to 1e-12"),
    Claim(id="rr98-eq5-factor", source="RR98 Eq. 5", printed="1/2", expect=1/2, within=1e-3, value=exact(third_factor),
          statement="the factor before the third derivatives in the gradient's expansion: from the transform of Lucy's weight in "
                    "3D at small k", because="the next term is 1e-4; Taylor's factor is 1/6, so that the error is M_3 r0^2/30"),
    Claim(id="rr98-eq6-order", source="RR98 Eq. 6", printed="r0^2", expect=2, within=0.05,
          value=slope("lattice", "h/a", 3.0),
          statement="the gradient's error is of second order in r0/lambda on a lattice: slope at h = 3 a, renormalised",
          because="the next order, (h/lambda)^4, takes 0.01 to 0.02 of the slope at h/lambda <= 0.2"),
    Claim(id="rr98-eq6-order-compact", source="RR98 Eq. 6", expect=2, within=0.05, value=farthest_slope,
          statement="it is so with every compact weight, Lucy's, the B-spline, Wendland's C2, C4 and C6: the slope farthest from "
                    "2 at h = 3 a, lattice, renormalised",
          because="the next order, (h/lambda)^4, takes 0.01 to 0.02 of the slope at h/lambda <= 0.2"),
    Claim(id="rr98-eq29-moments-2d", source="RR98 Eq. 29", expect=1, within=0.02,
          value=exact(lambda: printed_gradient(2)), because="2 %: lattice sums with h = 3 a are good to that",
          statement="the printed discretisation of W gives the right first moment: gradient of a linear field, 2D lattice"),
    Claim(id="rr98-eq29-moments-3d", source="RR98 Eq. 29", printed="correct moments", expect=1, within=0.02,
          value=exact(lambda: printed_gradient(3)), because="2 %: lattice sums with h = 3 a are good to that",
          statement="the printed discretisation of W gives the right first moment: gradient of a linear field, 3D lattice"),
    Claim(id="rr98-eq29-factor-2d", source="RR98 Eq. 29", expect=1, within=0.02, value=exact(lambda: printed_factor(2)),
          statement="it multiplies gradients by (|S_d|/d) M_d (r0/a)^(d-1): over that factor in 2D, h = 6 a",
          because="sums over a lattice stand for integrals to 2 % at h = 6 a"),
    Claim(id="rr98-eq29-factor-3d", source="RR98 Eq. 29", expect=1, within=0.02, value=exact(lambda: printed_factor(3)),
          statement="it multiplies gradients by (4 pi/3) M_3 (r0/a)^2 in 3D, over that factor, h = 6 a",
          because="sums over a lattice stand for integrals to 2 % at h = 6 a"),
    Claim(id="own-plain-quadrature-lucy", source="RR98 Sec. III", at_most=0.02,
          value=exact(plain_gradient), because="2 %: lattice sums with h = 3 a are good to that",
          statement="one can put W(r_ij) dV for W dr where the weight has a range: error of the gradient of a linear field, "
                    "Lucy, 3D lattice, h = 3 a"),
    Claim(id="rr98-eq31-third-moment", source="RR98 Eq. 31", expect=10, within=1e-6, because="quadrature",
          value=exact(lambda: moment(Exponential(1.0, 3), 3, 3)),
          statement="M_3 of the exponential weight, from which the error M_3 r0^2/30 follows: 10 in 3D"),
    *(Claim(id=f"{name}-eq45-{short}", source="RR98 Eq. 45", printed="(dV)^(1/3) < r0"*(name == "rr98"), at_most=1,
            value=wider(points, maker),
            statement="the spacing must be smaller than r0: error of the gradient with h = 3 a over that with h = 1.2 a, "
                      f"{words}, wavelength 32 a",
            because="r0, the rms width, is 1.27 a and 0.51 a: if the ordering governs, the wider weight is better")
      for name, short, points, maker, words in (
          ("rr98", "lattice", "lattice", "plain", "lattice, plain quadrature"),
          ("own", "lattice-renormalised", "lattice", "renormalised", "lattice, weight normalised by its sums there"),
          ("rr98", "jittered", "jittered-0.3", "plain", "points jittered by 0.3 a, plain quadrature of differences f_j - f_i"),
          ("own", "jittered-renormalised", "jittered-0.3", "renormalised",
           "points jittered by 0.3 a, weight normalised, differences f_j - f_i"))),
    Claim(id="rr98-eq45-lambda", source="RR98 Eq. 45", printed="r0 < lambda", expect=2, within=0.1,
          value=slope("lattice", "a", 64.0),
          statement="r0 must be smaller than lambda: slope of the gradient's error in r0/lambda at fixed spacing, lattice, "
                    "ranges from 2 to 6 spacings",
          because="0.1: weights of 2 to 6 spacings, whose sums differ by some per cent from integrals"),
    Claim(id="own-eq45-lambda-wide", source="RR98 Eq. 45", expect=2, within=0.1, value=wide_slope,
          statement="r0 must be smaller than lambda: the same slope with ranges of 4 to 8 spacings at a wavelength of 96 a, "
                    "asked after five ranges of 2 to 6 spacings had left it open",
          because="0.1, as with weights of 2 to 6 spacings; the next order, (k h)^4, takes 0.02"),
    Claim(id="rr98-continuum-limit-jittered", source="RR98 Sec. III", printed="continuum limit", at_least=0.5,
          value=slope("jittered-0.3", "h/a", 3.0),
          statement="r0 -> 0 with a < r0 gives the continuum limit also off a lattice: slope of the gradient's error at h = 3 a, "
                    "points jittered by 0.3 a, renormalised, differences f_j - f_i",
          because="an error that falls at least as the square root of h/lambda"),
)
