"""Extrapolation to h = 0: exact on what it assumes, honest on what it does not."""
import numpy as np
import pytest

from studies.kit.fits import four_grids, richardson

SIZES = [20, 30, 48]    # no common ratio


def test_exact_for_two_terms_of_the_three_finest_grids_in_any_sequence():
    values = [3 + 5/n**2 - 70/n**4 for n in SIZES]
    result = richardson([99.0, *values[::-1]], [8, *SIZES[::-1]])
    assert result.limit == pytest.approx(3, abs=1e-13)      # round-off of values near 3


@pytest.mark.parametrize("p", [0.5, 1.0, 2.0, 4.0])
def test_sees_the_order(p):
    result = richardson([1 + 2/n**p for n in SIZES], SIZES)
    assert result.order == pytest.approx(p, abs=1e-9)           # root finder's 1e-12, differences of 1e-5


@pytest.mark.parametrize("p", [1.0, 2.0, 3.0, 4.0])
@pytest.mark.parametrize("step", [0.5, 1.0, 2.0])
@pytest.mark.parametrize("b", [-4.0, 0.0, 4.0, 16.0])
def test_error_covers_the_true_limit_also_where_order_and_step_are_not_the_assumed_ones(p, step, b):
    """Below first order it need not: there values may turn round between the grids."""
    result = richardson([1 + 2/n**p + b/n**(p + step) for n in SIZES], SIZES)
    assert abs(result.limit - 1) <= result.error + 1e-14


@pytest.mark.parametrize("c", [-2e3, 10.0, 2e3])
def test_a_fourth_grid_tells_how_far_the_limit_of_three_is_off(c):
    sizes = [16, *SIZES]
    limit = four_grids(sizes, [3 + 5/n**2 + 70/n**4 + c/n**6 for n in sizes])
    assert limit.err == pytest.approx(2*abs(limit.value - 3), rel=1e-3)     # of 1e-9, values have 16 digits


def test_values_that_do_not_converge_have_their_spread_for_error():
    result = richardson([1.0, 2.0, 1.0], SIZES)
    assert np.isnan(result.order) and result.limit == 1.0 and result.error == 2.0
    assert richardson([2.0, 2.0, 2.0], SIZES).error == 0.0


@pytest.mark.parametrize(("values", "sizes"), [
    ([1.0, 2.0], [8, 16]), ([1.0, 2.0, 3.0], [8, 16, 16]), ([1.0, 2.0, float("nan")], SIZES)])
def test_refuses_too_few_and_broken_grids(values, sizes):
    with pytest.raises(ValueError, match="a finite value for each of three or more different sizes"):
        richardson(values, sizes)
