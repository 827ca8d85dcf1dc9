"""Laws of every weight in the registry: unit integral, slope, range, smoothness; printed formulas; errors."""
import numpy as np
import plain
import pytest
from scipy.special import j0

from particles.weights import WEIGHTS, Lucy, Weight, shape, slope, value_and_slope

weights = pytest.mark.parametrize("kind", WEIGHTS.values(), ids=WEIGHTS)
SPHERE = {1: 2.0, 2: 2*np.pi, 3: 4*np.pi}
# Gauss-Legendre, 8 points in each of 60 parts: exact for polynomials up to degree 15 between knots at halves,
# thirds, quarters, fifths and sixths of the range
NODES, GAUSS = np.polynomial.legendre.leggauss(8)
Q, DQ = ((np.arange(60)[:, None] + (NODES + 1)/2)/60).ravel(), np.tile(GAUSS/120, 60)


def w(weight, r):
    return np.array([value_and_slope(weight, s)[0] for s in np.atleast_1d(r)])


def dw(weight, r):
    return np.array([s*value_and_slope(weight, s)[1] for s in np.atleast_1d(r)])


@weights
@pytest.mark.parametrize("d", [1, 2, 3])
def test_integral_is_one(kind, d):
    weight = kind.of(h=1.7, d=d)
    r = weight.h*Q
    # the constructor's quadrature is asked for 1e-13
    assert np.sum(SPHERE[d]*r**(d - 1)*w(weight, r)*weight.h*DQ) == pytest.approx(1, abs=1e-12)


@weights
def test_zero_at_and_beyond_the_range(kind):
    # the pair loops have no branch for the cut-off: both formulas must vanish at q = 1 by themselves
    assert shape(kind.of(h=2.0), 1.0) == 0 and slope(kind.of(h=2.0), 1.0) == 0
    assert value_and_slope(kind.of(h=2.0), 2.5) == (0, 0)


@pytest.mark.parametrize("kind", plain.PRINTED)
def test_equals_the_printed_formula_in_2d(kind):
    h = 2.9
    value, derivative = plain.PRINTED[kind](h*Q, h)
    # round-off of (1 - q)^8 (32 q^3 + ...) near q = 1 is relative to the largest value
    assert w(kind.of(h=h), h*Q) == pytest.approx(value, abs=1e-13*value.max())
    assert dw(kind.of(h=h), h*Q) == pytest.approx(derivative, abs=1e-13*abs(derivative).max())


def second(kind, q):
    """phi'' on a line through the centre, by a central difference that does not straddle a knot."""
    step, weight = 1e-7, kind.of(h=1.0)
    return ((q + step)*slope(weight, q + step) - (q - step)*slope(weight, q - step))/(2*step)


@weights
def test_second_derivative_is_continuous(kind):
    # KHP95, Sec. II: "continuous first and second derivatives for all r". The difference across a knot falls
    # in proportion to the distance, with phi''' (at most 300 for C6) as factor, so it is no jump.
    for distance in (1e-2, 1e-3):
        assert abs(second(kind, 0.5 - distance) - second(kind, 0.5 + distance)) < 2*300*distance
        assert abs(second(kind, 1 - distance)) < 2*300*distance
    # along a line through the centre phi' is odd: phi' must vanish there, phi'/q have a finite limit
    assert slope(kind.of(h=1.0), 0.0) == pytest.approx(second(kind, 1e-4), rel=2e-3)


@pytest.mark.parametrize("kind", plain.PRINTED)
def test_only_wendland_weights_have_a_positive_transform(kind):
    # the 2D transform at k h up to 60; where it is negative, particles pair. Lucy reaches -6e-6, the
    # B-spline -6e-5; the smallest positive value, of C6 at k h = 60, is 4e-9: nothing is near 0 by round-off
    fine = (np.arange(4000) + 0.5)/4000
    values = np.array([shape(kind.of(h=1.0), q) for q in fine])
    transform = j0(np.outer(np.linspace(0.5, 60, 239), fine))@(values*fine)/4000
    assert (transform.min() > 0) == kind.__name__.startswith("Wendland")


@pytest.mark.parametrize("h, d, words", [
    (0.0, 2, "must be positive and finite, got 0.0"), (-1.0, 2, "take 3 sigma"),
    (np.nan, 2, "finite, got nan"), (np.inf, 2, "finite, got inf"), (3.0, 4, "d = 1, 2, 3 .*got d = 4")])
def test_errors(h, d, words):
    with pytest.raises(ValueError, match=words):
        Lucy.of(h=h, d=d)


def own(phi=None, over_q=None) -> type[Weight]:
    """A new class with such formulas."""
    class Own(Weight):
        pass
    for generic, formula in ((shape, phi), (slope, over_q)):
        if formula:
            generic.of(Own)(formula)
    return Own


def quartic(weight, q):
    return (1 - q**2)**4


def quartic_slope(weight, q):
    return -8*(1 - q**2)**3


@pytest.mark.parametrize("phi, over_q, words", [
    (None, None, r"Own has no shape: add shape\.of\(Own\)"),
    (quartic, None, r"Own has no slope: add slope\.of\(Own\)\(lambda weight, q: \.\.\.\) with phi'\(q\)/q"),
    (None, quartic_slope, "Own has no shape: add"),
    (lambda w, q: np.exp(-9*q*q), lambda w, q: -18*np.exp(-9*q*q),
     r"phi of Own is 0\.00012341 at q = 1, where it must be zero"),
    (lambda w, q: 1 - q**2, lambda w, q: -2.0, r"phi'/q of Own is -2 at q = 1"),
    (quartic, lambda w, q: -8*q*(1 - q**2)**3,
     r"slope of Own is -1\.03\S+ at q = 0\.137, but phi'\(q\)/q there is -7\.557"),
    (quartic, lambda w, q: -8.0001*(1 - q**2)**3, "slope of Own .* give the derivative"),
    (lambda w, q: (1 - q)**2, lambda w, q: -2*(1 - q)/q, r"phi'/q of Own is -inf at q = 0"),
    (lambda w, q: (1 - q)**2, lambda w, q: -2*(1 - q)/np.float64(q or 1e-320),
     r"phi'/q of Own is -?inf at q = 0")])
def test_formulas_that_lack_or_do_not_fit_are_refused(phi, over_q, words):
    with np.errstate(over="ignore"), pytest.raises((TypeError, ValueError), match=words):
        own(phi, over_q).of(h=3.0)
