"""What is measured on particles, against sums written out and states with known answers."""

import numpy as np
import pytest

from particles.observe import (
    PlateHeat,
    fields_at,
)
from particles.threads import Threads
from particles.weights import value_and_slope
from studies.build.spam import VARIANTS
from tests.scenes import small


@pytest.fixture(scope="module")
def measured():
    """(sums, state) with densities and gradients of the start."""
    method, state = small()
    sums = method.start(state.shape[1], Threads(1))
    sums.around.relist(state, np.arange(state.shape[1]), 0.0)
    sums.densities(state)
    sums.gradients()
    return sums, state


def test_fields_are_the_sums_of_the_paper(measured):
    sums, state = measured
    x, y = np.array([0.3, -7.9, 4.0]), np.array([0.1, -3.9, 3.99])
    around, found = sums.around, fields_at(sums, state, x, y)
    for k in range(3):
        r = np.hypot(around.x - x[k], around.y - y[k])
        w = np.array([value_and_slope(sums.method.weight, d)[0] for d in r])
        rho = w.sum()
        expected = (rho, w@around.vx/rho, w@around.vy/rho)
        # sums of some 30 terms in another order
        np.testing.assert_allclose([found.rho[k], found.vx[k], found.vy[k]], expected, rtol=1e-13, atol=1e-15)




@pytest.mark.parametrize("name", ["printed", "printed-fixed-rows", "walls-odd-own-pressure", "direct"])
def test_plates_give_all_the_energy_that_the_fluid_gains(name):
    """Between particles energy is conserved: kinetic, internal, m g y change by what the plates exchange."""
    method, state = small(VARIANTS[name], rows=12)
    sums, rates = method.start(state.shape[1], Threads(1)), np.empty_like(state)
    sums.around.relist(state, np.arange(state.shape[1]), 0.0)
    sums.rates(state, rates)
    gained = state[2]*rates[2] + state[3]*rates[3] + rates[4] + method.g*rates[1]
    sums.densities(state)
    sums.gradients()
    lower, upper = (PlateHeat(side, pressure=True)(sums, state)*method.box[0] for side in (-1, 1))
    assert min(abs(lower), abs(upper)) > 1e-3*np.abs(gained).sum()
    # 288 energies and some 300 pairs a plate, summed in another order
    assert lower + upper == pytest.approx(gained.sum(), abs=1e-13*np.abs(gained).sum())
