"""The staggered Boussinesq solver: order, published cavities, agreement of its two drivers."""
import numpy as np
import pytest
from boxes import CAVITY, SQUARE, every_box, growth_rates, marched

from continuum import linear
from continuum.boussinesq import (
    BoussinesqCase,
    rest,
    roll,
    steady,
    transient,
)
from continuum.spectral import cavity
from studies.kit.fits import richardson


def k_and_nu(case: BoussinesqCase, sizes, rolls: int = 1) -> list:
    """Extrapolated K and Nu (at the bottom, or at the left side of a cavity)."""
    rows, start = [], None
    for size in sizes:
        start = steady(BoussinesqCase(ra=case.ra, pr=case.pr, box=case.box, rows=size), start)
        seen = start.observe()
        rows.append((seen.K, seen.nu_left if case.box is CAVITY else seen.nu_bottom))
    return [richardson(values, sizes) for values in zip(*rows)]


@pytest.mark.parametrize("ra, pr", [(2000, 7), (50_000, 1)])
def test_second_order_and_extrapolated_to_1e_4(ra, pr):
    """Against a finer triple; its own uncertainty is 100 times smaller than what is asked."""
    case = BoussinesqCase(ra=ra, pr=pr)
    for coarse, fine in zip(k_and_nu(case, (32, 48, 64)), k_and_nu(case, (48, 64, 96))):
        assert abs(coarse.order - 2) < 0.1 and abs(fine.order - 2) < 0.1
        assert fine.error < 1e-5*fine.limit
        assert abs(coarse.limit - fine.limit) < 1e-4*fine.limit
        assert abs(coarse.limit - fine.limit) < coarse.error + fine.error


@pytest.mark.parametrize("ra, sizes", [(1e3, (24, 32, 48)), (1e4, (32, 48, 64))])
def test_side_heated_cavity_is_that_of_the_spectral_method(ra, sizes):
    nu = k_and_nu(BoussinesqCase(ra=ra, pr=0.71, box=CAVITY), sizes)[1]
    exact = cavity.observed(cavity.steady(cavity.CavityLaws(ra, 0.71), 16))["nu"]      # to eight digits
    assert abs(nu.limit - exact) < nu.error < 1e-4*exact


@pytest.mark.parametrize("ra, pr", [(3000.0, 7.0), (1500.0, 0.5)])
def test_growth_at_rest_converges_to_linear_theory(ra, pr):
    """nu and kappa are not exchangeable between rigid plates: this sees either solver have them swapped."""
    exact = linear.growth_rate(ra=ra, pr=pr, k=np.pi)
    assert abs(exact - linear.growth_rate(ra=ra, pr=1/pr, k=np.pi)) > 5e-3
    grown = [growth_rates(rest(BoussinesqCase(ra=ra, pr=pr, rows=rows)))[0].real for rows in (16, 24, 32)]
    seen = richardson(grown, (16, 24, 32))
    assert abs(seen.order - 2) < 0.1
    # h^6 terms of 16 rows; distance at 32 rows is 1e-3
    assert seen.limit == pytest.approx(exact, abs=2e-5)
    assert seen.limit == pytest.approx(exact, abs=seen.error)


@every_box
def test_transient_ends_in_the_steady_state_of_newton(box):
    case = BoussinesqCase(ra=8000, pr=0.71, box=box, rows=16)
    series, state = transient(case, roll(case), until=300.0), steady(case)      # 4 H^2/kappa
    assert series.K[-1] == pytest.approx(state.K, rel=2e-6)
    assert series.state.q == pytest.approx(state.q, abs=1e-6)
    assert series.state.rolls == state.rolls == 1


def test_newton_forgets_a_start_that_is_not_free_of_divergence():
    case = BoussinesqCase(ra=5000, pr=2, rows=16)
    coarse = steady(BoussinesqCase(ra=2500, pr=1, rows=12))
    start = coarse.on(case)
    assert np.max(np.abs(case.mac.div@start.q[:case.mac.ends[1]])) > 1e-6
    assert steady(case, coarse).q == pytest.approx(steady(case).q, abs=1e-9)        # Newton's tolerance


def test_time_step_is_of_second_order():
    case = BoussinesqCase(ra=2e4, pr=0.5, box=SQUARE, rows=16)
    start = marched(case, roll(case).q, 1.0, 100)
    ends = [marched(case, start, 2.0, steps) for steps in (50, 100, 200)]
    ratio = np.linalg.norm(ends[0] - ends[1])/np.linalg.norm(ends[1] - ends[2])
    assert np.log2(ratio) == pytest.approx(2, abs=0.15)     # first step is Euler's: third order, still seen
