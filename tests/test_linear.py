"""What is known of flows beforehand: linear theory of the layer, and the vortex of a gas."""
import numpy as np
import pytest

from continuum.exact.vortex import DECAYS, SOUND, Vortex, derivative, solved, velocities
from continuum.linear import FREE, RIGID, critical, critical_ra, growth_rate

ROUND_OFF = 1e-11       # eigenvalues of forms whose condition is about 1e4


@pytest.mark.parametrize("plates, ra, k", [(RIGID, 1707.762, 3.116), (FREE, 657.511, 2.221)])
def test_onset_of_the_infinite_layer_is_that_of_print(plates, ra, k):
    known = critical(plates)
    assert known.ra == pytest.approx(ra, rel=1e-6) and known.k == pytest.approx(k, abs=5e-4)


def test_free_plates_are_exact():
    for k in (0.5, 2.0, 6.0):
        assert critical_ra(k, FREE) == pytest.approx((np.pi**2 + k**2)**3/k**2, rel=ROUND_OFF)


@pytest.mark.parametrize("plates", [RIGID, FREE])
@pytest.mark.parametrize("k", [1.0, 3.117, 7.0])
def test_critical_ra_converges_with_the_degree(plates, k):
    coarse, fine, finest = (critical_ra(k, plates, degree) for degree in (6, 20, 28))
    assert fine == pytest.approx(finest, rel=1e-11)
    # a Ritz value approaches from above; in six functions it still errs visibly
    assert finest*(1 + 1e-9) < coarse < finest*1.01


@pytest.mark.parametrize("pr", [0.1, 1.0, 7.0])
@pytest.mark.parametrize("ra", [100.0, 657.0, 1e4])
def test_free_plates_grow_as_the_exact_dispersion_relation_says(ra, pr):
    k, nu, kappa = 2.0, np.sqrt(pr/ra), 1/np.sqrt(pr*ra)
    a2 = np.pi**2 + k**2
    exact = max(np.roots([1, (nu + kappa)*a2, nu*kappa*a2**2 - k**2/a2]))
    assert growth_rate(ra=ra, pr=pr, k=k, plates=FREE) == pytest.approx(exact, abs=ROUND_OFF)


@pytest.mark.parametrize("plates", [RIGID, FREE])
@pytest.mark.parametrize("pr", [0.01, 0.71, 1.0, 100.0])
def test_nothing_grows_or_decays_at_the_critical_ra_whatever_pr(plates, pr):
    k, ra = 2.7, critical_ra(2.7, plates)
    below, at, above = (growth_rate(ra=part*ra, pr=pr, k=k, plates=plates) for part in (0.99, 1, 1.01))
    assert below < 0 < above and abs(at) < ROUND_OFF


@pytest.mark.parametrize("bad", [{"ra": 0.0}, {"ra": -5.0}, {"pr": 0.0}, {"k": 0.0}, {"k": float("nan")}])
def test_refuses_what_has_no_meaning(bad):
    name, value = next(iter(bad.items()))
    with pytest.raises(ValueError, match=rf"(?i){name} must be positive and finite, got {value}"):
        growth_rate(**{"ra": 2000.0, "pr": 1.0, "k": 3.0, **bad})


def test_fourier_sums_are_derivatives_of_every_wave_that_fits():
    x = 2*np.pi*np.arange(9)/9
    D = derivative(9)
    for m in range(5):
        assert D@np.sin(m*x + 0.3) == pytest.approx(2*np.pi/9*m*np.cos(m*x + 0.3), abs=1e-13)
    assert np.abs(D + D.T).max() < 1e-14


def test_the_gas_becomes_incompressible_as_the_square_of_the_mach_number():
    """The error has terms of Mach^2 and Mach^4; at Mach 0.3 the second is a tenth of the first."""
    place = np.random.default_rng(1).uniform(-0.5, 0.5, (50, 2))
    slow, fast = (solved(mach, 29) for mach in (0.15, 0.3))
    assert (fast.decay - 1)/(slow.decay - 1) == pytest.approx(4, rel=0.15)
    exact = Vortex(1/SOUND, 1).velocity(place)*np.exp(-DECAYS)       # of speed 1
    errors = [np.linalg.norm(velocities(gas, place) - exact)/np.linalg.norm(exact) for gas in (slow, fast)]
    assert errors[1]/errors[0] == pytest.approx(4, rel=0.15)
    assert errors[0] < 0.3*0.15**2
