"""Onset: disturbances and steady states of the grids, zeros of growth rates and lines."""
from dataclasses import replace

import numpy as np
import pandas as pd
import pytest
from boxes import CONDUCTING_SQUARE, growth_rates

from continuum import boussinesq, linear
from continuum.fluid import ConstNu, VanDerWaals
from continuum.gas import newton as compressible_newton
from continuum.gas import solve as compressible
from continuum.gas.fields import block, initial
from continuum.gas.newton import Discrete
from continuum.linear import critical_ra_square
from continuum.scene import RayleighBenard, Walls
from continuum.steady import Steady
from studies.kit.fits import richardson
from studies.kit.table import Tables
from studies.onset import STUDY
from studies.onset import tables as onset_tables
from studies.onset.rates import compressible as of_gas
from studies.onset.runs import GrowthRun, growth

SIZES = (16, 24, 32)
LAYER = RayleighBenard(ra=1750.0)
SQUARE = RayleighBenard(ra=8000.0, aspect=1.0, sides=Walls())
SCENES = [LAYER, replace(LAYER, transport=ConstNu), replace(LAYER, eos=VanDerWaals()), SQUARE]
SCENE_IDS = ["eta", "nu", "vdw", "square"]


def test_square_agrees_with_the_staggered_grid():
    """Newton's Jacobian on three grids, extrapolated, is within its uncertainty of the Chebyshev value."""
    values, ras = [], (4800.0, 4950.0, 5100.0)
    for rows in SIZES:
        cases = [boussinesq.BoussinesqCase(ra=ra, pr=1.0, box=CONDUCTING_SQUARE, rows=rows) for ra in ras]
        sigma = [growth_rates(boussinesq.rest(case), count=2)[0].real for case in cases]
        values.append(onset_tables.interpolated(np.array(sigma), np.array(ras)))
    found = richardson(values, SIZES)
    # 0.5: the parabola through three Ra is off by 1e-5 of Ra, sigma''' times their distances
    assert abs(found.limit - critical_ra_square()) < found.error + 0.5


def test_gas_of_small_differences_is_boussinesq_fluid_of_half_the_gradient():
    """As dT -> 0 sigma is that of Pr = 2, over sqrt 2 for half the gradient, to order dT^2 = 0.0025."""
    scene = RayleighBenard(ra=2500.0, T_hot=1.025, T_cold=0.975)
    found = richardson([of_gas(scene, rows)[0] for rows in SIZES], SIZES)
    expected = linear.growth_rate(ra=2500.0, pr=2.0, k=np.pi)/np.sqrt(2)
    assert abs(found.limit - expected) < found.error + 0.0025*expected


@pytest.mark.parametrize("scene", SCENES[:3], ids=SCENE_IDS[:3])
def test_both_matrices_of_the_gas_agree(scene):
    """A few numbers a row against the sparse matrix; 1e-9: round-off of differences with steps of 1e-5."""
    whole = compressible_newton.growth_rate(scene, 16)*scene.L/scene.free_fall
    assert whole == pytest.approx(of_gas(scene, 16)[0], abs=1e-9)


def test_runs_grow_as_the_matrix_says():
    """1e-8: RK4 errs by sigma^5 dt^4; what is left of other disturbances is e^-0.54*40 of these rolls."""
    case = GrowthRun(scene=replace(LAYER, ra=1800.0), rows=12, ke=1e-10, until=80.0)
    sigma, _ = growth(*case.history(lambda fraction: None), 40.0)
    assert sigma == pytest.approx(of_gas(case.scene, 12)[0], abs=1e-8)


def test_too_few_samples_are_refused():
    with pytest.raises(ValueError, match="4 samples after t = 0"):
        growth(np.arange(10.0), np.array([1, 1, 1, 1, 9, 9, 9, 9, 9, 9.0]), 0.0)


@pytest.mark.parametrize("scene", SCENES, ids=SCENE_IDS)
def test_slopes_are_those_of_the_rates(scene):
    """Along a random direction, about a state in motion; 1e-8: steps of 1e-5 squared, round-off over 1e-5."""
    equations, rng = Discrete(scene, 10), np.random.default_rng(1)
    q = equations.unknowns(block(initial(scene, 10, 1e-3)))
    along = rng.normal(size=len(q))
    slope = (equations.rates(q + 1e-5*along) - equations.rates(q - 1e-5*along))/2e-5
    assert np.abs(equations.jacobian(q)@along - slope).max() < 1e-8*np.abs(slope).max()


@pytest.mark.parametrize("scene", SCENES, ids=SCENE_IDS)
def test_two_sums_of_densities_are_kept(scene):
    """Mass, and between four walls the sum with the signs of a chessboard, in any state; to round-off."""
    equations, rng = Discrete(scene, 10), np.random.default_rng(2)
    q = 0.01*rng.normal(size=equations.places.shape[1])
    rates = equations.rates(q)
    assert len(equations.kept) == (2 if scene is SQUARE else 1)
    for kept in equations.kept:
        assert abs(kept@rates) < 1e-12*np.abs(kept*rates).sum()


@pytest.mark.parametrize("scene", [replace(LAYER, ra=5000.0), replace(SQUARE, ra=12000.0)])
def test_newton_ends_where_the_run_in_time_does(scene):
    rolls = compressible_newton.warm_rolls(scene, 8, 5e-4)
    run = compressible.run(scene, 8, until=Steady(rtol=1e-6), start=rolls)
    state = compressible_newton.steady(scene, 8)
    assert (state.rolls, run.converged) == (run.rolls, True)
    assert abs(state.ke - run.ke) < 3*run.ke_err + 3e-6*run.ke     # what the run says is left


def rates(ra, sigma, err=0.0):
    return pd.DataFrame({"ra": np.array(ra, float), "sigma": np.array(sigma, float), "sigma_err": err})


def test_smooth_zero_covers_the_true_one():
    ra = np.array([1500, 1600, 1650, 1700, 1750, 1800, 1900.0])
    found = onset_tables.smooth_zero(rates(ra, [linear.growth_rate(ra=r, pr=2.0, k=np.pi) for r in ra]))
    # 1e-9: round-off in sigma
    assert abs(found.value - linear.critical_ra(np.pi)) <= found.err + 1e-9*found.value
    assert found.err < 1e-3


@pytest.mark.parametrize("noise", [0.0005, 0.004])
def test_zero_of_noisy_rates_covers_the_true_one(noise):
    """Neighbours differ by 0.008: from noise far below to one that makes several zeros.

    0.9: 95 % less three standard deviations of 200 samples.
    """
    rng, ra = np.random.default_rng(3), np.array([1400, 1700, 2000, 2300.0])
    truth = 0.1*(1 - np.sqrt(1850/ra))
    sigmas = (truth + noise*rng.normal(size=4) for _ in range(200))
    zeros = [onset_tables.nearby_zero(rates(ra, sigma, 2*noise)) for sigma in sigmas]
    assert np.mean([abs(zero.value - 1850) <= zero.err for zero in zeros]) > 0.9


def test_no_critical_number_follows_from_one_growth_rate():
    columns = next(table for table in STUDY.tables if table.name == "growth_rates").columns
    texts = {"method": "compressible", "variant": "", "eos": "ideal", "transport": "const-eta",
             "sides": "periodic", "way": "operator"}
    one = pd.DataFrame([{**dict.fromkeys(columns, 0.0), **texts}])
    assert not any(STUDY.derive(Tables({"growth_rates": one})).values())
    assert not any(STUDY.derive(Tables()).values())
