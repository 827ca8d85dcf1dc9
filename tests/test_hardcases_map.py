"""The map of hard cases: exact numbers, what counts as flow, and the rules that name an outcome."""
from functools import partial

import numpy as np
import pandas as pd
import pytest
from scenes import rows_of
from scipy.integrate import quad

from particles.fields import Fields, kinetic_energy
from studies.build.setting import bisected
from studies.hardcases import extremes
from studies.hardcases.cases import TILED, cases
from studies.hardcases.claims import SQUARES
from studies.hardcases.derive import derive
from studies.hardcases.extremes import ALTERNATING, BOXES, LAYERS, SITUATIONS, SOUND, VORTEX, flow, rarefied
from studies.hardcases.runs import SAMPLES, Hard, followed
from studies.kit.claim import judged
from studies.kit.table import Tables


def test_two_rarefactions_have_the_kinetic_energy_that_is_told():
    rho, u = lambda s: (2 - s/SOUND)**2/9, lambda s: 2*(SOUND + s)/3      # of s = x/t, the fan of gamma = 2
    per_time, _ = quad(lambda s: rho(s)*u(s)**2/2, -SOUND, 2*SOUND)
    mass, _ = quad(rho, -SOUND, 2*SOUND)
    assert rarefied(2.0) == pytest.approx(per_time*2.0/extremes.STRIP.L)
    assert mass == pytest.approx(SOUND)        # what the fan has came from where the strip was


def fields(x, v) -> Fields:
    """Of points of mass 1."""
    one = np.ones(len(x))
    return Fields(x, v, one, one, one)


def test_flow_is_what_is_alike_in_a_cell_and_noise_what_is_not():
    x = np.stack(np.meshgrid(np.arange(8) - 3.5, np.arange(8) - 3.5), axis=-1).reshape(-1, 2)
    even, odd = np.ones((64, 2)), (-1.0)**np.arange(64)[:, None]*np.ones((64, 2))
    assert flow(fields(x, even), (8.0, 8.0)) == pytest.approx(kinetic_energy(fields(x, even)))
    assert flow(fields(x, odd), (8.0, 8.0)) == pytest.approx(0, abs=1e-12)
    assert kinetic_energy(fields(x, odd)) == pytest.approx(1.0)


def test_the_vortex_has_no_divergence_and_no_flow_through_walls():
    d, (x, y) = 1e-5, np.random.default_rng(1).uniform(-8, 8, (2, 20))
    u = VORTEX.flow(x + d, y)[0] - VORTEX.flow(x - d, y)[0]
    v = VORTEX.flow(x, y + d)[1] - VORTEX.flow(x, y - d)[1]
    assert np.abs(u + v).max()/(2*d) < 1e-9
    assert np.abs(VORTEX.flow(x, np.full(20, 8.0))[1]).max() < 1e-15


def hard(table: str, case: str) -> list[Hard]:
    """Runs of a case, but for those of grids between plates."""
    return [one for one in cases("paper") if type(one) is Hard and one.into == table
            and one.which["case"] == case]


@pytest.mark.parametrize("case", SITUATIONS)
def test_methods_start_with_the_flow_and_mass_of_the_scene(case):
    first, *_ = hard("hard_runs", case)
    scene, ready = first.scene, first.entrant.ready(first.scene)
    at = ready.method.fields(ready.start)
    mass = 16*8 if case == "vacuum" else scene.width*scene.L
    assert (at.rho*at.V).sum() == pytest.approx(mass, rel=0.02) and ready.dt > 0
    if case in LAYERS:
        assert kinetic_energy(at) == pytest.approx(9/5000, rel=0.02)


def test_nobody_holds_points_at_plates_where_nothing_slows_the_flow_down():
    """`decisive` compares the vortex with its start: rows that stick would slow it down without viscosity."""
    methods = [one.entrant.ready(one.scene).method for one in hard("hard_runs", "zero viscosity")]
    held = [getattr(method, "held", None) for method in methods]
    assert [one for one in held if one is not None] and all(one is None or not len(one.which) for one in held)


RUN = {"case": "Ra 1e5", "method": "fixed-lattice", "rows": 16, "k": 0.01, "k_start": 0.01, "reached": 1.0,
       "flow": 0.0115, "flow_start": 0.0115, "refused": "", "mass_drift": 0.0}


@pytest.mark.parametrize("values, wanted", [
    ({"mass_drift": 0.02}, "leaks"), ({}, "right"), ({"flow": 0.013}, "wrong"),
    ({"coarse": 0.0125}, "unjudged"), ({"flow": 0.013, "rows": 32}, "right"),
    ({"k": 0.013, "rows": 32}, "wrong"),
    ({"case": "zero viscosity"}, "right"), ({"case": "zero viscosity", "k": 0.02}, "wrong")])
def test_outcomes_that_no_case_tells_apart(values, wanted):
    grids = [{**RUN, "method": "grid", **more}
             for more in ({"rows": 32, "flow": values.get("coarse", 0.0105)}, {"rows": 48, "flow": 0.01})]
    [row] = derive(Tables(hard_runs=pd.DataFrame([{**RUN, **values}, *grids])))["map"]
    assert row["outcome"] == wanted


def test_the_grid_goes_round_a_box_without_plates():
    """A piece of a turn keeps mass and energy; a vacuum, even of a thousandth, ends the run."""
    ready, (vacuum, time) = TILED.ready(VORTEX), BOXES["vacuum"]
    seen, reached, _ = followed(ready, 8.0, 2, partial(extremes.seen, VORTEX))
    k, _, mass = np.transpose(seen)
    assert reached == 1 and mass == pytest.approx(256, rel=1e-14)
    # the start has no pressure of its vortex: sound takes the square of the Mach number 0.07
    assert k[-1] == pytest.approx(k[0], rel=0.005)
    assert followed(TILED.ready(vacuum), time, SAMPLES, partial(extremes.seen, vacuum)).reached < 1


def test_no_gradient_on_a_lattice_sees_densities_that_alternate():
    probe, = (one for one in hard("probes", ALTERNATING) if one.which["method"] == "fixed-lattice")
    row, = rows_of(probe, "probes")
    assert row["measured"] == pytest.approx(1.0, abs=1e-6) and row["reached"] == 1


@pytest.mark.parametrize("flow, rolls, verdict", [
    (0.02, 1, "holds"), (0.02, 2, "fails"), (0.0003, 1, "undecidable")])
def test_rolls_of_a_flow_that_has_stopped_are_not_counted(flow, rolls, verdict):
    squares = pd.DataFrame([{"eos": "IdealGas", "weight": "Monaghan", "ra": 1e4, "begun": 0.03, "flow": flow,
                             "rolls": rolls, "shared": 0.92}])
    claim = {claim.id: claim for claim in SQUARES}["khp95-hard-fig10-one-roll"]
    row = judged(claim, Tables(squares=squares), "hardcases")
    assert row["verdict"] == verdict and ("stopped" in row["reason"]) == (verdict == "undecidable")


@pytest.mark.parametrize("first", [0.3, 1.0, 7.0])
def test_bisection_finds_a_limit_from_either_side_and_says_so_when_there_is_none(first):
    limit, half = bisected(lambda dt: dt > 1.2345, first)
    assert abs(limit - 1.2345) <= half < 0.006*limit
    assert all(np.isnan(bisected(lambda dt, bad=bad: bad, first)).all() for bad in (True, False))
