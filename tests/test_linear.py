"""Linear theory of the layer against exact results, printed figures and its own limits."""
import numpy as np
import pytest

from continuum.linear import PlateKind, critical, critical_ra, growth_rate

ROUND_OFF = 1e-11       # eigenvalues of forms whose condition is about 1e4


def test_onset_of_the_infinite_layer_to_all_printed_figures():
    assert round(critical(PlateKind.RIGID).ra, 3) == 1707.762
    assert round(critical(PlateKind.RIGID).k, 3) == 3.116 and round(critical(PlateKind.FREE).k, 3) == 2.221
    assert round(critical(PlateKind.FREE).ra, 3) == 657.511
    assert round(critical(PlateKind.RIGID_FREE).ra, 2) == 1100.65


def test_free_plates_are_exact():
    assert critical(PlateKind.FREE).ra == pytest.approx(27*np.pi**4/4, rel=ROUND_OFF)
    # the wavenumber of a minimum is known to the root of round-off only
    assert critical(PlateKind.FREE).k == pytest.approx(np.pi/np.sqrt(2), rel=1e-7)
    for k in (0.5, 2.0, 6.0):
        assert critical_ra(k, PlateKind.FREE) == pytest.approx((np.pi**2 + k**2)**3/k**2, rel=ROUND_OFF)


@pytest.mark.parametrize("plates", PlateKind)
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
    assert growth_rate(ra=ra, pr=pr, k=k, plates=PlateKind.FREE) == pytest.approx(exact, abs=ROUND_OFF)


@pytest.mark.parametrize("plates", PlateKind)
@pytest.mark.parametrize("pr", [0.01, 0.71, 1.0, 100.0])
def test_nothing_grows_or_decays_at_the_critical_ra_whatever_pr(plates, pr):
    k = 2.7
    ra = critical_ra(k, plates)
    assert abs(growth_rate(ra=ra, pr=pr, k=k, plates=plates)) < ROUND_OFF
    assert growth_rate(ra=ra*1.01, pr=pr, k=k, plates=plates) > 0 > growth_rate(ra=ra*0.99, pr=pr, k=k,
                                                                                plates=plates)


@pytest.mark.parametrize("bad", [{"ra": 0.0}, {"ra": -5.0}, {"pr": 0.0}, {"k": 0.0}, {"k": float("nan")}])
def test_refuses_what_has_no_meaning(bad):
    name, value = next(iter(bad.items()))
    with pytest.raises(ValueError, match=rf"(?i){name} must be positive and finite, got {value}"):
        growth_rate(**{"ra": 2000.0, "pr": 1.0, "k": 3.0, **bad})
