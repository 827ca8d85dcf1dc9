"""Shocks against jumps: the exact tube, the viscous tube, ripples and their impulse."""
import numpy as np
import pandas as pd
import pytest

from continuum.exact.riemann import Gas, density, middle, shock_speed, solution
from continuum.fluid import ConstEta, IdealGas
from studies.hardcases.interface.runs import divide, gases, impulse, ripple
from studies.hardcases.tube.grid import march, primitive, rates
from studies.hardcases.tube.spam import overlap, tube
from studies.lattices import derive as hard_derive

# --- shocks -------------------------------------------------------------------------------------------------------------

LEFT, RIGHT, GAMMA = Gas(1.0, 0.0, 1.0), Gas(0.125, 0.0, 0.1), 1.4


def test_riemann_solution_of_sod_is_the_published_one():
    """Toro 1997, table 4.2, test 1."""
    found = middle(LEFT, RIGHT, GAMMA)
    np.testing.assert_allclose(found, (0.92745, 0.30313, 0.42632, 0.26557), atol=6e-6)


@pytest.mark.parametrize("gamma", [1.4, 2.0])
def test_shocks_keep_mass_momentum_and_energy(gamma):
    gas, P = Gas(0.4, -0.7, 0.3), 1.1
    rho, W = density(gas, P, gamma), shock_speed(gas, P, gamma)
    v = W*(1 - gas.rho/rho)                         # of what is behind, in the frame of the gas before
    assert gas.P + gas.rho*W**2 == pytest.approx(P + rho*(W - v)**2)
    enthalpy = [gamma/(gamma - 1)*q.P/q.rho + u**2/2 for q, u in ((gas, W), (Gas(rho, 0, P), W - v))]
    assert enthalpy[0] == pytest.approx(enthalpy[1])


def test_solution_is_continuous_in_the_fan_and_isentropic():
    s = np.linspace(-1.3, 0.9, 2000)
    rho, v, P = solution(LEFT, RIGHT, GAMMA, s)
    assert np.abs(np.diff(P)).max() < 2e-3 and P/rho**GAMMA == pytest.approx(1.0)
    mirrored = solution(RIGHT, LEFT, GAMMA, -s)
    np.testing.assert_allclose(mirrored, [rho, -v, P])


def test_gases_that_part_too_fast_are_refused():
    with pytest.raises(ValueError, match="vacuum"):
        middle(Gas(1, -9, 1), Gas(1, 9, 1), GAMMA)


def test_viscous_tube_keeps_its_sums_and_follows_the_exact_solution():
    dx = 1.0
    x = (np.arange(300) + 0.5)*dx - 150
    rho = np.where(x < 0, 1.0, 0.125)
    start = np.array([rho, 0*x, 2.5*np.where(x < 0, 1.0, 0.1)/rho])
    rho, v, _ = end = march(IdealGas(cv=2.5), ConstEta(0.6, 0.6), dx, start, 60.0)
    for one, other in ((start, end),):
        for total in (lambda q: q[0].sum(), lambda q: (q[0]*(q[2] + q[1]**2/2)).sum()):
            assert total(other) == pytest.approx(total(one), rel=1e-5)
    exact = solution(LEFT, RIGHT, GAMMA, x/60)
    assert np.abs(v - exact[1]).mean() < 0.03 and np.abs(rho - exact[0]).mean() < 0.02
    uniform = np.array([np.ones(9), np.zeros(9), np.ones(9)])
    assert np.abs(rates(IdealGas(), ConstEta(0.1, 0.1), 1.0, uniform)).max() == 0
    np.testing.assert_allclose(primitive(np.array([[2.0], [1.0], [3.0]])), [[2.0], [0.5], [1.375]])


def test_tube_begins_with_both_gases_in_place():
    state, dense = tube(12.0, 1)
    assert state.shape[1] == 36*12 and dense.sum() == 8*(~dense).sum()
    assert np.abs(state[0][dense]).max() < 12 + 0.1 < np.abs(state[0][~dense]).min() + 0.3
    assert overlap(state[0], dense) < 0
    assert overlap(np.array([1.0]*5 + [5.0]*4 + [4.0]*4), np.array([True]*9 + [False]*4)) == 1.0


def test_ripple_is_read_off_particles():
    state, light = gases(1.0, 0.25, 1)
    height, a = ripple(state[0], state[1], light, 30.0)
    assert height == pytest.approx(10.0, abs=0.3) and a == pytest.approx(0.25*30/(2*np.pi), abs=0.3)
    assert state.shape[1] == pytest.approx(0.4*30*60 + 1.6*30*40, rel=0.02)
    assert divide(np.array([0.0, 1, 2, 3]), np.array([True, True, False, False])) == 1.5


def test_impulse_by_hand():
    """Mach 1.5, gamma = 2: the density rises by 3 M^2/(M^2 + 2), the pressure by (4 M^2 - 1)/3; what falls meets the mirror."""
    theory = impulse(1.0, 0.25)
    c = np.sqrt(2.0)
    assert theory.fall == pytest.approx(2*c/3*(1.5 - 1/1.5)) and theory.meets == pytest.approx(60/(1.5*c))
    assert 0 < theory.kick < theory.fall and theory.amplitude < 0.25*30/(2*np.pi)
    twice = impulse(2.0, 0.25)
    np.testing.assert_allclose([twice.meets, twice.back, twice.amplitude, twice.growth],
                               [2*theory.meets, 2*theory.back, 2*theory.amplitude, theory.growth])


def test_growth_of_a_ripple_is_a_slope_over_that_of_theory():
    theory = impulse(1.0, 0.25)
    t = np.linspace(0.5, theory.back, 60)
    late = np.maximum(t - theory.meets, 0)
    frame = pd.DataFrame({"time": t, "height": -theory.fall*t + 1.1*theory.kick*late,
                          "amplitude": theory.amplitude + 0.8*theory.growth*late, "scale": 1.0, "steep": 0.25, "seed": 1})
    row = next(hard_derive.ripple_growth(frame))
    assert row["kick"] == pytest.approx(1.1) and row["growth"] == pytest.approx(0.8) and row["amplitude"] == pytest.approx(1.0)
