"""The study hardcases: lattices against the sums that run, molecules, shocks against jumps, what is measured on made-up runs."""
from dataclasses import replace

import numpy as np
import pandas as pd
import pytest

import studies.hardcases as hardcases
from continuum.fluid import ConstEta, IdealGas, VanDerWaals, pressure
from particles.limits import lattice_sums
from particles.methods.spam import Spam
from particles.team import Team
from particles.weights import Lucy, Monaghan, WendlandC2
from studies.convection.claims.lattices import LUCY, shear_moduli
from studies.convection.spam import start
from studies.hard import hard_derive, hard_tables, khp95
from studies.hard.fates import median_ratio, partners
from studies.hard.freezing import Freezing, lindemann, neighbours
from studies.hard.hard_claims import pressureless, spinodal
from studies.hard.hard_figures import figures
from studies.hard.interface import Interface, divide, gases, impulse, ripple
from studies.hard.lattice_growth import Crystal, Growth, growth
from studies.hard.lattice_waves import lattice, least_stable, sites_of_least_energy, sums, vectors
from studies.hard.lattice_waves import neighbours as around
from studies.hard.moduli import Moduli
from studies.hard.newtonian import METHODS, RHO_SQUARED, Newton, Reversal, Twins, crowd, molecules
from studies.hard.riemann import Gas, density, middle, shock_speed, solution
from studies.hard.shock_tube import ShockTube, overlap, tube
from studies.hard.still import at_rest, fluid
from studies.hard.tube_grid import march, primitive, rates
from studies.kit.claim import judge
from studies.kit.sweep import RESULTS, load
from studies.kit.table import Tables, read

WEIGHTS = (Lucy, Monaghan, WendlandC2)


def rows(case, table):
    return case.run(lambda done: None, None).rows[table]


# --- lattices ---------------------------------------------------------------------------------------------------------


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


def test_moduli_are_those_of_the_printed_weight():
    found = [rows(Moduli(lattice=kind, weight=Lucy, h=(3.0,)), "moduli")[0]["exact"] for kind in ("square", "diagonal")]
    np.testing.assert_allclose(found, shear_moduli(LUCY, "square"), atol=1e-9)


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
    assert pressureless(1.0) == spinodal(1.0) == 0.25
    rho, T, d = 1.2, spinodal(1.2), 1e-5
    P = [pressure(VanDerWaals(), r, T - r/2) for r in (rho - d, rho + d)]
    assert P[0] == pytest.approx(P[1], abs=1e-9)
    assert pressure(VanDerWaals(), rho, pressureless(rho) - rho/2) == pytest.approx(0, abs=1e-15)


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


def test_layers_tell_what_stays_from_what_goes():
    """The upper half goes on by a spacing along x, over the periodic side; the lower one stays."""
    case, at = Freezing(eos=IdealGas(), weight=Lucy), start(Freezing(eos=IdealGas(), weight=Lucy).scene, 1)
    way = np.where(at[1] > 0, 1.0, 0.0)
    places = np.stack([at[:2].T + step*np.stack([way, 0*way], axis=1) for step in (0.0, 0.5, 1.0)])
    found = case._layers(places, np.array([*at[:2], way, 0*way, at[4]]), K=0.5)
    assert [row["stuck"] for row in found] == [1, 1, 0, 0] and [row["kp"] for row in found] == [0, 0, 1, 1]
    assert found[0]["T"] > 1 > found[-1]["T"]
    assert found[0]["lindemann"] < 1e-12 and found[1]["lindemann"] > 0.05       # at mid-height neighbours part


def test_criteria_are_the_printed_inequalities():
    """By hand for Lucy: w(0) = 5/(9 pi), w(0.9) - w(1) = 0.010452."""
    found = Freezing(eos=IdealGas(), weight=Lucy)._criteria(0.002)
    assert found["barrier"]*2*5/(9*np.pi) == pytest.approx(2*0.002, rel=1e-12)
    assert found["melting"]*2*0.010452 == pytest.approx(2*0.002, rel=1e-3)


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


def test_time_of_return_is_read_off_the_distances():
    t = np.arange(10.0, 101, 10)
    twins = pd.DataFrame({"weight": "Lucy", "seed": 1, "time": t, "apart": 1e-16*np.exp(0.4*t)})
    back = pd.DataFrame({"integrator": "leapfrog", "weight": "Lucy", "seed": 1, "time": t, "apart": 2.0**-52*np.exp(0.4*t)})
    row = next(hard_derive.returns(twins, back))
    assert row["rate"] == pytest.approx(0.4) and row["measured"] == pytest.approx(row["predicted"])


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


# --- the study ----------------------------------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def small(tmp_path_factory):
    """The study with a few short cases."""
    out = tmp_path_factory.mktemp("results")
    cases = [*list(khp95.moduli(0.2))[::4], *khp95.newton((2.0,), 1, (1,)),
             *(ShockTube(L=L, eta=0.5, keep=L == 9) for L in (9.0, 12.0, 15.0)), Interface(scale=0.4)]
    study = replace(hardcases.STUDY, cases=lambda size: [replace(c, side=8) if isinstance(c, Reversal) else c for c in cases])
    return study, study.run("quick", workers=1, out=out), out


def test_small_study_writes_tables_figures_and_verdicts(small):
    study, found, out = small
    assert len(found["moduli"]) and len(found["modulus_orders"]) and len(found["tube_orders"]) == 3
    assert {path.stem for path in study.draw(out)} == {"moduli", "reversal", "shocks"}
    verdicts = {row["id"]: row["verdict"] for row in study.judge(out)}
    assert verdicts["khp95-hard-modulus-summed"] == verdicts["khp95-hard-reversal"] == "holds"
    assert verdicts["khp95-hard-freezing-melting-lucy"] == "undecidable"


def test_without_tables_nothing_is_decided():
    for row in judge(khp95.PART.claims, Tables(), "hardcases"):
        assert row["verdict"] == "undecidable" and len(row["reason"]) > 20, row["id"]


@pytest.mark.skipif(not (RESULTS/"hardcases"/"moduli.csv").exists(), reason="no tables are committed yet")
def test_committed_verdicts_and_figures_follow_from_committed_tables():
    tables = load(hard_tables.ALL, "hardcases")
    found = {row["id"]: row["verdict"] for row in judge(khp95.PART.claims, tables, "hardcases")}
    kept = read(RESULTS/"claims.csv")
    kept = kept[kept["study"] == "hardcases"].set_index("id")["verdict"]
    assert {name: kept[name] for name in found} == found
    assert set(figures(tables)) <= {path.stem for path in (RESULTS/"hardcases").glob("*.png")}
