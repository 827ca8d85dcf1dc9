"""Limits of the time step: the search finds what is known, eigenvalues and trials agree, formulas are safe."""
from typing import Any

import numpy as np
import pandas as pd
import pytest

from continuum import boussinesq
from continuum.boussinesq.projection import CFL_LIMIT, Projection
from continuum.fluid import ConstEta, IdealGas
from particles.integral.closed_faces import Moving
from particles.integral.points import jittered, lattice
from particles.threads import Team
from particles.walls.periodic import periodic
from particles.weights import WendlandC2
from studies.build.unguarded import bisected
from studies.hardcases.limits import figures as limits_figures
from studies.hardcases.limits.boussinesq import noise_grows
from studies.hardcases.limits.cases import Limit
from studies.hardcases.limits.claims import CLAIMS
from studies.hardcases.limits.dpd import BOXES, INTEGRATORS, Unguarded, map_grows, settled, trial_grows
from studies.hardcases.limits.euler import PLATES, euler_step, strip_step
from studies.hardcases.limits.linear import eigenvalues, largest_step
from studies.hardcases.limits.still import DISORDER, FACES, METHODS, fixed
from studies.kit.claim import judged
from studies.kit.table import Tables


@pytest.mark.parametrize("integrator, rate, limit", [
    ("RK4", 1j, 8**0.5), ("RK4", -1.0, 2.7853), ("ThreeStage", 1j, 3**0.5), ("ThreeStage", -1.0, 2.5127), ("Euler", -1.0, 2.0)])
def test_the_regions_of_stability_end_where_they_are_known_to(integrator, rate, limit):
    assert largest_step(np.array([2*rate, -0.1]), integrator) == pytest.approx(limit/2, rel=2e-4)


def test_forward_euler_makes_undamped_sound_grow_at_any_step_and_damped_sound_beyond_2_d_over_w2():
    assert largest_step(np.array([1j, -1j]), "Euler") == pytest.approx(0, abs=2e-3)
    assert largest_step(np.array([-0.1 + 1j]), "Euler") == pytest.approx(0.2/1.01, rel=1e-3)


def test_what_grows_by_itself_sets_no_limit():
    assert largest_step(np.array([0.01, 1j]), "RK4") == pytest.approx(8**0.5, rel=1e-3)


@pytest.mark.parametrize("first", [0.3, 1.0, 7.0])
def test_bisection_finds_a_limit_from_either_side(first):
    found = bisected(lambda dt: dt > 1.2345, first)
    assert abs(found.value - 1.2345) <= found.half < 0.006*found.value


def test_bisection_says_so_when_there_is_no_limit():
    assert np.isnan(bisected(lambda dt: False, 1.0).value) and np.isnan(bisected(lambda dt: True, 1.0).value)


@pytest.mark.parametrize("method, scene, eta, k", [("spam Lucy", "balanced", 0.3, 0.3), ("fixed lattice", "sound", 0.0, 0.0)])
def test_trial_eigenvalues_and_formula_agree(method, scene, eta, k):
    [row] = Limit(method=method, scene=scene, eta=eta, k=k).run(lambda done: None, None).rows["limits"]
    assert abs(row["measured"] - row["exact"]) < row["measured_err"] + 0.01*row["exact"]
    assert 0.95 < row["measured"]/row["predicted"] < 1.1      # ten points lack the very wave that limits most: 1 % here


def test_the_grid_takes_the_step_of_its_formula_without_viscosity():
    grows = METHODS["grid"](ConstEta(0.0, 0.0)).grows(200)
    predicted = METHODS["grid"](ConstEta(0.0, 0.0)).predicted
    assert not grows(0.98*predicted) and grows(1.2*predicted)


def test_the_printed_limit_of_forward_euler():
    assert euler_step(ConstEta(1.0, 0.5)) == pytest.approx(0.625)


@pytest.mark.parametrize("eta, k", [(1.0, 1.0), (0.1, 1.0)])
def test_theory_of_a_strip_has_the_limit_of_the_sums(eta, k):
    """Rates of whole points between plates, by differences of the compiled sums: good to 1e-7."""
    law = ConstEta(eta, k)
    trial = fixed(law, share=0.0)
    rates = eigenvalues(trial.method, trial.start)
    assert strip_step(law, 10, 10) == pytest.approx(np.min(-2*rates.real/np.abs(rates)**2), rel=1e-4)


def test_weak_conduction_loses_two_rows_between_plates_and_none_between_insulating_ones():
    law = ConstEta(0.0, 0.05)
    assert strip_step(law, 10, 10)/euler_step(law) == pytest.approx(1 - 4/10, rel=5e-3)
    assert strip_step(law, 10, 10, PLATES["insulating"])/euler_step(law) == pytest.approx(1, rel=5e-3)


@pytest.mark.parametrize("name", ["Eqs 40, 41", "1/2"])
def test_settled_particles_are_stable_below_the_limit_of_their_map_and_not_beyond(name):
    method = Unguarded(box=BOXES[3], kT=0.0, integrator=INTEGRATORS[name])
    start = settled(3)
    for dt, grows in ((0.115, False), (0.135, True)):       # the limit is between 0.12 and 0.13
        assert map_grows(method, start, dt) == grows == trial_grows(method, start, dt)


def with_faces(points, side: float) -> tuple[Any, np.ndarray, np.ndarray]:
    """Sums and state of periodic points at rest, and (n, n) rates of friction of unit viscosity over their faces."""
    n, walls = points.n, (*periodic(side), *periodic(side, axis=1))
    method = Moving(weight=WendlandC2.of(h=3.0), eos=IdealGas(), law=ConstEta(1.0, 0.0), box=(side, side), walls=walls)
    sums, state = method.start(n, Team(1)), method.state(points.x, np.zeros((n, 2)), 1.0, np.ones(n))
    sums.around.relist(state, np.arange(n), 0.0)
    sums.make_faces(state)
    faces, own = sums.faces, np.concatenate([np.arange(n), sums.maker.ghosts.origin]).astype(int)
    row = np.repeat(np.arange(n), faces.taken)
    entry = np.concatenate([first + np.arange(taken) for first, taken in zip(faces.first, faces.taken, strict=True)]).astype(int)
    L = np.zeros((n, n))
    for column, sign in ((own[faces.near[entry]], 1), (row, -1)):
        np.add.at(L, (row, column), sign*faces.k[entry]/state[7][row])
    return sums, state, L


@pytest.mark.parametrize("side", [8, 10])
def test_diffusion_over_faces_of_a_lattice_is_as_fast_as_limits_have_it_and_volumes_follow_as_fast(side):
    sums, state, L = with_faces(lattice((side, side)), side)
    rates, waves = np.linalg.eigh((L + L.T)/2)
    assert np.abs(L - L.T).max() < 1e-12 and abs(-rates[0] - FACES) < 0.05      # two digits are told
    state[6:9] *= 1 + 1e-6*waves[:, 0]
    sums.make_faces(state)
    sums.rates(state, out := np.zeros_like(state))
    density = sums.maker.count.mean()       # by which volumes are told: 1.005 on this lattice
    assert density == pytest.approx(1, rel=0.01) and waves[:, 0] @ out[7]/1e-6 == pytest.approx(rates[0]*density, rel=1e-4)


@pytest.mark.parametrize("seed", [1, 2, 3])
def test_diffusion_over_faces_of_jittered_points_is_faster_by_no_more_than_the_limit_leaves_for_disorder(seed):
    _, _, L = with_faces(jittered((20, 20), 0.3, seed), 20)
    assert FACES < -np.linalg.eigvals(L).real.min() < DISORDER*FACES


def test_claims_fail_where_limits_are_off():
    row = {"scene": "zero viscosity", "predicted": 1.0, "margin": 1.0, "exact": 1.0, "measured_err": 0.01}
    good, bad = (Tables(limits=pd.DataFrame([{**row, "method": method, "measured": value}
                                             for method in ("grid", "spam Lucy")])) for value in (1.02, 0.8))
    claims = {claim.id: claim for claim in CLAIMS}
    for name in ("limit-step-grid-sound", "limit-step-spam", "limit-step-safe"):
        assert judged(claims[name], good)["verdict"] == "holds" and judged(claims[name], bad)["verdict"] == "fails"


def test_bars_of_limits_end_within_their_axes():
    row = {"method": "fixed Euler", "eta": 1.0, "k": 1.0, "integrator": "Euler", "predicted": 1.0, "margin": 1.0, "exact": 1.0}
    for measured, err in ((1.02, 0.01), (1.09, 0.107), (1.2, 0.2)):
        row |= {"measured": measured, "measured_err": err}
        rows = pd.DataFrame([{**row, "scene": "Euler heat"}, {**row, "method": "moving", "scene": "balanced", "exact": np.nan}])
        page = limits_figures.figures(Tables(limits=rows))["limits"]
        assert page.axes[2].get_xlim()[1] > measured + err and "noise" in page.get_suptitle()


def test_a_roll_of_the_boussinesq_grid_is_stable_at_its_cfl_limit_and_not_far_beyond():
    state = boussinesq.steady(boussinesq.Case(ra=5e3, pr=1.0, rows=8))
    limit = CFL_LIMIT/Projection(state.case, state.q).courant()
    with np.errstate(all="ignore"):
        assert not noise_grows(state, limit) and noise_grows(state, 6*limit)
