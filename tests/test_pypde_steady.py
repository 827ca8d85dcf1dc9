"""Steady states of the gas in py-pde: the other grid's, heat at every height, mass, starts, errors."""
from itertools import pairwise

import numpy as np
import pytest
from plain_pypde import volume_nusselt

from continuum.gas import solve as compressible
from continuum.pypde.gas import Gas
from continuum.pypde.solve import onto, solve
from continuum.scene import RayleighBenard, Walls
from continuum.steady import Steady, Time
from studies.kit.fits import richardson

GAS = RayleighBenard(ra=5000, L=1.0)
SIZES = (12, 16, 20)


@pytest.fixture(scope="module")
def gases() -> list:
    """Solutions on SIZES, each started from the one before."""
    solutions: list = []
    for rows in SIZES:
        start = {"start": solutions[-1]} if solutions else {}
        solutions.append(solve(Gas(GAS, rows), until=Steady(rtol=1e-5), **start))
    return solutions


def test_the_gas_is_that_of_the_other_grid(gases):
    """The limits agree within the sum of their uncertainties; order 2 is seen."""
    both = gases, compressible.steady_on(GAS, SIZES)
    for name in ("ke", "nu"):
        ours, theirs = (richardson([getattr(s, name) for s in solutions], SIZES) for solutions in both)
        assert abs(ours.limit - theirs.limit) < ours.error + theirs.error
        assert ours.error < 0.01*ours.limit
        assert ours.order == pytest.approx(2, abs=0.15)     # 1.89 to 2.07 on grids as coarse as these


def test_steady_states_carry_the_same_heat_at_every_height(gases):
    for s in gases:
        assert s.converged and s.rolls == 2 and s.compile_s > 0 and s.cpu_s > 0
        assert s.nusselt[0] == pytest.approx(s.nusselt[1], rel=1e-4)    # 2e-5: e is no conserved sum
    spread = [abs(volume_nusselt(s.equation, s.state) - s.nu) for s in gases]
    # 3e-4 at 12 rows; of order 1.9 to 2.3
    assert all(coarse/fine == pytest.approx((b/a)**2, rel=0.15)
               for (coarse, fine), (a, b) in zip(pairwise(spread), pairwise(SIZES))) and spread[0] < 1e-3


def test_mass_is_conserved_to_round_off(gases):
    for s in gases:
        # round-off of every step, in no preferred direction
        assert abs(s.mass_drift) < 1e-15*np.sqrt(s.steps)


def test_a_solution_on_another_grid_keeps_its_energy(gases):
    fine, wide = gases[-1], Gas(GAS, 40)
    # splines go through their points
    np.testing.assert_allclose(onto(fine.equation, fine), fine.state, atol=1e-12)
    # the sum of v^2 over a grid is good to h^2: 2e-4
    assert wide.measure(onto(wide, fine))[0] == pytest.approx(fine.series.ke[-1], rel=1e-3)


@pytest.mark.parametrize(("make", "message"), [
    (lambda: Gas(GAS, 9), "rows must be even and at least 8, got 9"),
    (lambda: Gas(RayleighBenard(ra=5000, sides=Walls()), 8), "continuum.gas.solve for walls"),
    (lambda: Gas(GAS, 8).rolls(-1.0), "cannot be negative, got -1"),
    (lambda: solve(Gas(GAS, 8), dt=1.0), "not above the stability limit 0.0"),
    (lambda: solve(Gas(GAS, 8), dt=-1.0), "dt = -1 must be positive"),
], ids=["odd", "walls", "negative energy", "step", "negative step"])
def test_bad_input_is_told(make, message):
    with pytest.raises(ValueError, match=message):
        make()


def test_a_start_from_another_box_is_told(gases):
    with pytest.raises(ValueError, match="start from rolls or from the same box"):
        solve(Gas(RayleighBenard(ra=5000), 8), start=gases[0])


@pytest.mark.filterwarnings("ignore::RuntimeWarning")    # overflow is what the test makes
def test_divergence_is_told_with_time_and_place():
    gas = Gas(GAS, 8)
    with pytest.raises(compressible.DivergedError, match=r"before t = .* in cell \(.*IdealGas.*smaller dt"):
        solve(gas, start=gas.rolls(1e3))


def test_an_interrupt_is_not_taken_for_an_end():
    def stop(fraction):
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        solve(Gas(GAS, 8), until=Time(0.1, samples=1), progress=stop)
