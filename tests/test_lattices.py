"""Lattices against the sums that run: moduli, motions that grow, pairs, freezing; molecules; sound."""
from dataclasses import replace

import numpy as np
import pandas as pd
import pytest
from scipy.integrate import solve_ivp

from continuum.fluid import IdealGas, VanDerWaals, pressure
from particles.limits import lattice_sums
from particles.smooth.spam import Spam
from particles.threads import Team
from particles.weights import Lucy, Monaghan, WendlandC2
from studies.build.periodic_box import at_rest, fluid
from studies.lattices import sound
from studies.lattices.claims import NO_PRESSURE, SPINODAL
from studies.lattices.crystals import Crystal, Growth, Moduli, growth
from studies.lattices.freezing import criteria, lindemann, median_ratio, neighbours, partners
from studies.lattices.molecules import METHODS, RHO_SQUARED, Newton, Reversal, Twins, crowd, molecules
from studies.lattices.sound import Ringing, Ripple, Speed, grown, ripples, rounding, symbols
from studies.lattices.tables import crossing, ringing_lost
from studies.lattices.waves import lattice, least_stable, sites_of_least_energy, sums, vectors
from studies.lattices.waves import neighbours as around

WEIGHTS = (Lucy, Monaghan, WendlandC2)


def rows(case, table):
    return case.run(lambda done: None, None).rows[table]


def test_sums_over_the_square_lattice_are_those_of_the_step_limit():
    k = vectors("square", (8, 8))
    total, S, D = sums(Lucy.of(h=3.0), "square", k)
    known = lattice_sums(Lucy.of(h=3.0), 1.0, 1.0, k)
    assert total == pytest.approx(known.rho, rel=1e-14)
    np.testing.assert_allclose(S, known.S, atol=1e-14)
    np.testing.assert_allclose(D, known.D, atol=1e-8)       # second derivatives by differences


@pytest.mark.parametrize(("kind", "nearest", "far"), [("square", 4, 1.0), ("diagonal", 4, 1.0), ("hexagonal", 6, 1.0745699)])
def test_lattices_have_density_one_and_their_neighbours(kind, nearest, far):
    at = lattice(kind, (6, 4), strain=0.1)
    assert len(at.x)/np.prod(at.box) == pytest.approx(1.0, rel=1e-14)
    assert (np.abs(at.x) <= np.array(at.box)/2).all()
    r = np.hypot(*around(kind, 1.2).T)
    assert len(r) == nearest and r == pytest.approx(far, rel=1e-7)


@pytest.mark.parametrize("eos", [IdealGas(), VanDerWaals()])
@pytest.mark.parametrize("weight", WEIGHTS)
def test_least_stable_motion_is_pushed_as_its_eigenvalue_says(weight, eos):
    """Sums that run, on a lattice shifted by 1e-5: accelerations are -omega^2 u, energies have followed."""
    at, shift, T = lattice("hexagonal", (8, 5)), 1e-5, 0.6
    e = T - (0.5 if isinstance(eos, VanDerWaals) else 0.0)
    k, a, square = least_stable(weight.of(h=2.9), eos, e, "hexagonal", (8, 5))
    u = shift*a*np.cos(at.x@k + 1.0)[:, None]
    method = fluid(weight.of(h=2.9), at.box, eos)
    kernel = method.start(len(at.x), Team(1))
    state = at_rest(at.x, e)
    kernel.around.relist(state, np.arange(len(at.x)), 0.0)
    order = np.argsort(kernel.around.x[:len(at.x)] + 1e3*kernel.around.y[:len(at.x)])
    given = np.argsort(at.x[:, 0] + 1e3*at.x[:, 1])
    shifts = np.empty_like(u)
    shifts[order] = u[given]
    kernel.densities(state)
    before, out = kernel.around.rho[:len(at.x)].copy(), np.empty_like(state)
    state[:2] += shifts.T
    kernel.densities(state)
    state[4] += pressure(eos, before, e)/before**2*(kernel.around.rho[:len(at.x)] - before)
    kernel.rates(state, out)
    np.testing.assert_allclose(out[2:4].T, -square*shifts, atol=2e-4*abs(square)*shift + 1e-9)     # squares of shifts


@pytest.mark.parametrize("weight", WEIGHTS)
def test_moduli_of_both_kinds_of_sums_agree(weight):
    for kind in ("square", "hexagonal"):
        row = rows(Moduli(lattice=kind, weight=weight, h=(3.0,)), "moduli")[0]
        assert row["measured"] == pytest.approx(row["exact"], abs=1e-9)


def test_lattices_of_least_energy_have_one_particle_a_site_or_two():
    assert sites_of_least_energy(Lucy.of(h=3.0)) == sites_of_least_energy(WendlandC2.of(h=3.0)) == 1
    assert sites_of_least_energy(Monaghan.of(h=3.0)) == 2


def test_a_motion_that_grows_does_so_at_its_rate():
    crystal = Crystal(lattice="hexagonal", cells=(8, 5), weight=Monaghan, h=2.8, eos=IdealGas())
    row = rows(Growth(crystal=crystal), "growth")[0]
    assert row["predicted"] > 0.3 and row["measured"] == pytest.approx(row["predicted"], rel=1e-3)
    assert replace(crystal, h=2.2).motion.rate < 0


def test_rates_are_read_where_motions_are_small():
    t = np.linspace(0, 100, 400)
    found = growth(t, np.minimum(1e-17 + 1e-18*np.exp(2*0.3*t), 1e-3))
    assert found.value == pytest.approx(0.3, rel=1e-5)


def test_van_der_waals_limits_by_hand():
    rho, d = 1.2, 1e-5
    T = pd.eval(SPINODAL, local_dict={"rho": rho})
    P = [pressure(VanDerWaals(), r, T - r/2) for r in (rho - d, rho + d)]
    assert P[0] == pytest.approx(P[1], abs=1e-9)
    T = pd.eval(NO_PRESSURE, local_dict={"rho": rho})
    assert pressure(VanDerWaals(), rho, T - rho/2) == pytest.approx(0, abs=1e-15)


def test_pairs_are_told_from_single_particles():
    at = lattice("hexagonal", (6, 4))
    assert median_ratio(at.x, at.box) == pytest.approx(1.0) and not partners(at.x, at.box).any()
    twice = np.concatenate([at.x, at.x + 0.01])
    assert median_ratio(twice, at.box) > 50 and (partners(twice, at.box) == 1).all()


# --- freezing -----------------------------------------------------------------------------------------------------------


def test_neighbours_are_the_six_of_a_lattice_partners_left_out():
    at = lattice("hexagonal", (8, 5))
    i, j = neighbours(at.x, at.box[0])
    inner = np.abs(at.x[i, 1]) < at.box[1]/2 - 2
    apart = at.x[i] - at.x[j]
    apart[:, 0] -= at.box[0]*np.round(apart[:, 0]/at.box[0])
    assert (np.bincount(i) == 6).all() and np.hypot(*apart[inner].T) == pytest.approx(1.0745699, rel=1e-6)
    i, j = neighbours(np.concatenate([at.x, at.x + 0.01]), at.box[0])
    assert (np.abs(i - j) != len(at.x)).all()


def test_lindemann_ratio_of_particles_that_shake():
    """Independent shakes s of both partners along one line make distances fluctuate by sqrt 2 s times the cosine."""
    at, rng = lattice("hexagonal", (14, 8)), np.random.default_rng(1)
    places = at.x + 0.02*rng.standard_normal((200, *at.x.shape))
    assert lindemann(places, at.box[0]) == pytest.approx(np.sqrt(2)*0.02/1.0746, rel=0.1)      # ends have farther neighbours
    assert lindemann(np.repeat(at.x[None], 3, axis=0), at.box[0]) < 1e-15


def test_criteria_are_the_printed_inequalities():
    """By hand for Lucy: w(0) = 5/(9 pi), w(0.9) - w(1) = 0.010452."""
    printed = criteria(Lucy, 0.002)
    assert printed["barrier"]*2*5/(9*np.pi) == pytest.approx(2*0.002, rel=1e-12)
    assert printed["melting"]*2*0.010452 == pytest.approx(2*0.002, rel=1e-3)


# --- molecules ----------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("weight", [Lucy, Monaghan])
def test_pressure_of_the_square_of_the_density_makes_molecules(weight):
    state = crowd(8, 3)
    method = molecules(Spam, weight.of(h=3.0), 8.0)
    kernel, ids = method.start(64, Team(1)), np.arange(64)
    ordered, out, expected = state.copy(), np.empty_like(state), np.empty_like(state)
    kernel.around.relist(ordered, ids, 0.0)
    kernel.rates(ordered, out)
    Newton(weight.of(h=3.0), 8.0).rates(state, expected)
    np.testing.assert_allclose(out[:4, np.argsort(ids)], expected[:4], atol=1e-13)
    assert pressure(RHO_SQUARED, 1.7, 900.0) == 1.7**2


def test_paths_come_back_as_their_steps_let_them():
    found = {name: rows(Reversal(integrator=name, weight=Lucy, times=(3.0,), side=8), "reversal")[0] for name in METHODS}
    assert found["whole numbers"]["equal"] == 1 and found["whole numbers"]["apart"] == 0
    assert 0 < found["leapfrog"]["apart"] < 1e-13 and found["leapfrog"]["equal"] < 1
    assert 1e-6 < found["rk4"]["apart"] < 0.1


def test_twins_stay_together_for_a_while():
    row = rows(Twins(weight=Lucy, every=1.0, samples=1), "twins")[0]
    assert 0 < row["apart"] < 1e-14


# --- sound --------------------------------------------------------------------------------------------------------------

SHORT = Ringing(lattice="square", weight=Monaghan, length=40)


@pytest.mark.parametrize("weight", [Lucy, WendlandC2])
def test_sums_are_those_of_the_step_limit_frictions_too(weight):
    k = vectors("square", (8, 8))
    found, known = symbols(weight.of(h=3.0), "square", k), lattice_sums(weight.of(h=3.0), 1.0, 1.0, k)
    assert found.rho == pytest.approx(known.rho, rel=1e-14)
    np.testing.assert_allclose(found.nested, known.nested, atol=1e-13)
    np.testing.assert_allclose(found.direct, known.direct, atol=1e-13)


@pytest.mark.parametrize("friction", [0.0, 2.0])
def test_what_is_let_go_grows_as_the_sum_says(friction):
    """One motion, rounded off once: u'' + friction u' = w u."""
    w, time, dt = 0.12, 60.0, 1e9
    s = -friction/2 + np.hypot(friction/2, np.sqrt(w))
    known = solve_ivp(lambda t, y: (y[1], w*y[0] - friction*y[1]), (0, time), (1.0, 0.0), rtol=1e-10, atol=1e-12).y[1, -1]
    found = grown([Ripple(np.zeros(2), np.array([0.0, 1.0]), -w, s)], time, dt, np.array([7.0, 1.0]))
    assert found == pytest.approx(known, rel=1e-3)


def test_places_are_rounded_off_by_their_last_digit():
    assert rounding(np.array([[1.5, -3.0]])) == pytest.approx(np.array([2.0**-52, 2.0**-51])/np.sqrt(12))


def test_stable_lattices_have_nothing_that_grows():
    for h, grows in ((2.5, False), (3.0, True)):
        case = replace(SHORT, weight=Lucy, h=h)
        rates = [one.rate for one in ripples(case)]
        assert max(rates) > 0.1 if grows else max(rates) < 1e-10


def test_a_wave_is_lost_to_round_off_at_the_rate_of_the_lattice():
    row = SHORT.run(lambda done: None, None).rows["ringing"][0]
    assert row["measured"] == pytest.approx(row["predicted"], rel=0.01)
    assert 0.1 < row["foretold"]/row["across"] < 10 and 1e-3 < row["across"]/row["wave"] < 1


def test_starts_are_waves_in_their_box():
    for kind in ("square", "hexagonal"):
        case = replace(SHORT, lattice=kind)
        x, y, *v, T = case.start()
        assert np.abs(x).max() < case.at.box[0]/2 and np.abs(y).max() < case.at.box[1]/2
        assert not np.any(v) and np.mean(T) == pytest.approx(1.0, abs=1e-12)


def test_rates_are_read_between_round_off_and_large_motions():
    t = np.linspace(0, 100, 400)
    found = sound.growth(t, np.minimum(1e-17 + 1e-18*np.exp(0.4*t), 1e-3), 1e-14)
    assert found.value == pytest.approx(0.4, rel=1e-3)
    assert np.isnan(sound.growth(t, np.full(400, 1e-17), 1e-14).value)


def test_lengths_are_interpolated():
    rows = pd.DataFrame([{**replace(SHORT, length=length, seed=seed).columns, "wave": 1.0,
                          "foretold": np.exp(length - 45.0), "across": np.exp(length - 46.0)}
                         for length in (40, 44, 48) for seed in (1, 2)])
    row = next(ringing_lost(rows))
    assert (row["predicted"], row["measured"]) == pytest.approx((45.0, 46.0))
    assert np.isnan(crossing(rows[rows["length"] < 45], "across"))


@pytest.mark.parametrize("weight", [Lucy, Monaghan])
def test_long_sound_has_the_speed_that_its_frequency_says(weight):
    """Of the sums of the step limit, a wave of 400 spacings: dispersion is of the square of 2 pi 3/400."""
    k = 2*np.pi/400
    known = lattice_sums(weight.of(h=3.0), 1.0, 1.0, np.array([[k, 0.0]]))
    # an ideal gas at T = 1: c^2 = 2 P/rho, so that only D is left
    omega2 = 2/known.rho*known.D[0, 0, 0]
    speed = rows(Speed(lattice="square", weight=weight), "sound_speeds")[0]["speed"]
    assert speed == pytest.approx(np.sqrt(omega2)/k/np.sqrt(2), rel=2e-3)
