"""Extrapolation gives back what a known error law was made of."""
import numpy as np
import pytest

from continuum.richardson import richardson


@pytest.mark.parametrize("order", [1.0, 2.0, 4.0])
@pytest.mark.parametrize("sizes", [(16, 24, 32), (10, 13, 40), (48, 32, 24, 16)])
def test_finds_order_and_limit_of_a_pure_power(order, sizes):
    found = richardson([3.0 + 5.0*n**-order for n in sizes], sizes)
    assert found.order == pytest.approx(order, abs=1e-7)     # brentq's tolerance times the differences' cancellation
    assert found.limit == pytest.approx(3.0, abs=1e-9)


def test_error_covers_the_next_order():
    # a second-order law with a fourth-order tail, as centred differences have
    sizes = np.array([16, 24, 32, 48])
    found = richardson(1 + 3/sizes**2 - 200/sizes**4, sizes)
    assert abs(found.limit - 1) <= found.error


def test_no_order_where_values_swing():
    found = richardson([1.0, 2.0, 1.5], [8, 16, 32])
    assert np.isnan(found.order)
    assert found.error == 0.5


def test_refuses_two_grids():
    with pytest.raises(ValueError, match="three grids"):
        richardson([1.0, 2.0], [8, 16])
