"""Steady states of py-pde's solvers: the other grids', heat at every height, mass, starts, errors."""
from itertools import pairwise

import numpy as np
import pytest
from plain_pypde import volume_nusselt

from continuum import boussinesq
from continuum.gas import solve as compressible
from continuum.pypde.boussinesq import Boussinesq
from continuum.pypde.gas import Gas
from continuum.pypde.solve import onto, solve
from continuum.richardson import richardson
from continuum.scene import RayleighBenard, Walls
from continuum.steady import Steady, Time

GAS = RayleighBenard(ra=5000, L=1.0)
SIZES = (12, 16, 20)


def layer(rows=8, ra=5000, pr=7) -> Boussinesq:
    return Boussinesq(ra=ra, pr=pr, rows=rows)


def series(make) -> list:
    """Solutions on SIZES, each started from the one before."""
    solutions: list = []
    for rows in SIZES:
        start = {"start": solutions[-1]} if solutions else {}
        solutions.append(make(rows, until=Steady(rtol=1e-5), **start))
    return solutions


@pytest.fixture(scope="module")
def gases() -> list:
    return series(lambda rows, **options: solve(Gas(GAS, rows), **options))


@pytest.fixture(scope="module")
def layers() -> list:
    return series(lambda rows, **options: solve(layer(rows), **options))


def agree(solutions, others, measure, other_measure):
    """The limits of two discretisations agree within the sum of their uncertainties; order 2 is seen."""
    ours, theirs = richardson([measure(s) for s in solutions],
                              SIZES), richardson([*map(other_measure, others)], SIZES)
    assert abs(ours.limit - theirs.limit) < ours.error + theirs.error
    assert ours.error < 0.01*ours.limit
    assert ours.order == pytest.approx(2, abs=0.15)     # 1.89 to 2.07 on grids as coarse as these


def test_the_gas_is_that_of_the_other_grid(gases):
    others = compressible.steady_on(GAS, SIZES)
    agree(gases, others, lambda s: s.ke, lambda s: s.ke)
    agree(gases, others, lambda s: s.nu, lambda s: s.nu)


def test_the_layer_is_that_of_the_other_grid(layers):
    box = boussinesq.HALF_LAYER
    others = [boussinesq.steady(boussinesq.BoussinesqCase(ra=5000, pr=7, box=box, rows=rows)).observe()
              for rows in SIZES]
    agree(layers, others, lambda s: s.ke, lambda s: s.K)
    agree(layers, others, lambda s: s.nu, lambda s: s.nu_bottom)


@pytest.mark.parametrize("kind", ["gases", "layers"])
def test_steady_states_carry_the_same_heat_at_every_height(kind, request):
    solutions = request.getfixturevalue(kind)
    for s in solutions:
        assert s.converged and s.rolls == 2 and s.compile_s > 0 and s.cpu_s > 0
        # 2e-5: the gas' e is no conserved sum
        assert s.nusselt[0] == pytest.approx(s.nusselt[1], rel=1e-4)
    spread = [abs(volume_nusselt(s.equation, s.state) - s.nu) for s in solutions]
    # 3e-4 of the gas, 0.036 of the layer at 12 rows; of order 1.9 to 2.3
    assert all(coarse/fine == pytest.approx((b/a)**2, rel=0.15)
               for (coarse, fine), (a, b) in zip(pairwise(spread), pairwise(SIZES))) and spread[0] < 0.05


def test_mass_is_conserved_to_round_off(gases):
    for s in gases:
        # round-off of every step, in no preferred direction
        assert abs(s.mass_drift) < 1e-15*np.sqrt(s.steps)


@pytest.mark.parametrize("kind", ["gases", "layers"])
def test_a_solution_on_another_grid_keeps_its_energy(kind, request):
    fine = request.getfixturevalue(kind)[-1]
    same = onto(fine.equation, fine)
    # splines go through their points
    np.testing.assert_allclose(same, fine.state, atol=1e-12)
    wide = Gas(GAS, 40) if kind == "gases" else layer(40)
    # the sum of v^2 over a grid is good to h^2: 2e-4 for the gas, 5e-3 for the layer
    assert wide.measure(onto(wide, fine))[0] == pytest.approx(fine.series.ke[-1], rel=0.01)


@pytest.mark.parametrize(("make", "message"), [
    (lambda: layer(ra=-1), "ra must be positive.*-1"),
    (lambda: layer(pr=0), "pr must be positive.*0"),
    (lambda: layer(6), "rows must be at least 8, got 6"),
    (lambda: Gas(GAS, 7), "rows must be at least 8, got 7"),
    (lambda: Gas(RayleighBenard(ra=5000, sides=Walls()), 8), "continuum.gas.solve for walls"),
    (lambda: layer().rolls(-1.0), "cannot be negative, got -1"),
    (lambda: solve(layer(), dt=1.0), "not above the stability limit 0.1"),
    (lambda: solve(Gas(GAS, 8), dt=-1.0), "dt = -1 must be positive"),
], ids=["Ra", "Pr", "coarse", "coarse gas", "walls", "negative energy", "step", "negative step"])
def test_bad_input_is_told(make, message):
    with pytest.raises(ValueError, match=message):
        make()


def test_a_start_from_another_box_is_told(gases):
    with pytest.raises(ValueError, match="start from rolls or from the same box"):
        solve(layer(), start=gases[0])


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
