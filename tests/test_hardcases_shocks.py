"""Shocks: against jumps, by all methods, ripples and their impulse. High Ra: how a limit is sought."""
from dataclasses import replace
from functools import partial

import numpy as np
import pandas as pd
import pytest

from continuum.exact.blast import blast
from continuum.exact.riemann import GasState, density, middle, shock_speed, solution
from continuum.fluid import ConstEta
from particles.fields import Fields
from particles.integral.bodies import with_disc
from particles.integral.points import lattice
from studies.build import variant, with_rows
from studies.hardcases import high_ra, printed
from studies.hardcases.cases import IN_LAYERS, trial
from studies.hardcases.columns import COLUMNS
from studies.hardcases.derive import derive
from studies.hardcases.impacts import DENSE, EOS, GAMMA, HOT, THIN, Strip, pitot
from studies.hardcases.printed import divide, gases, impulse, ripple
from studies.hardcases.runs import copied, followed
from studies.kit.table import Tables


def test_riemann_solution_of_sod_is_the_published_one():
    """Toro 1997, table 4.2, test 1."""
    np.testing.assert_allclose(middle(DENSE, THIN, GAMMA), (0.92745, 0.30313, 0.42632, 0.26557), atol=6e-6)


@pytest.mark.parametrize("gamma", [1.4, 2.0])
def test_shocks_keep_mass_momentum_and_energy(gamma):
    gas, P = GasState(0.4, -0.7, 0.3), 1.1
    rho, W = density(gas, P, gamma), shock_speed(gas, P, gamma)
    v = W*(1 - gas.rho/rho)                         # of what is behind, in the frame of the gas before
    assert gas.P + gas.rho*W**2 == pytest.approx(P + rho*(W - v)**2)
    enthalpy = [gamma/(gamma - 1)*q.P/q.rho + u**2/2 for q, u in ((gas, W), (GasState(rho, 0, P), W - v))]
    assert enthalpy[0] == pytest.approx(enthalpy[1])


def test_solution_is_continuous_in_the_fan_and_isentropic():
    s = np.linspace(-1.3, 0.9, 2000)
    rho, v, P = solution(DENSE, THIN, GAMMA, s)
    assert np.abs(np.diff(P)).max() < 2e-3 and P/rho**GAMMA == pytest.approx(1.0)
    np.testing.assert_allclose(solution(THIN, DENSE, GAMMA, -s), [rho, -v, P])


def test_gases_that_part_too_fast_are_refused():
    with pytest.raises(ValueError, match="vacuum"):
        middle(GasState(1, -9, 1), GasState(1, 9, 1), GAMMA)


def test_ripple_is_read_off_particles():
    state, light = gases(1.0, 0.25, 1)
    height, a = ripple(state[0], state[1], light, 30.0)
    assert height == pytest.approx(10.0, abs=0.3) and a == pytest.approx(0.25*30/(2*np.pi), abs=0.3)
    assert state.shape[1] == pytest.approx(0.4*30*60 + 1.6*30*40, rel=0.02)
    assert divide(np.array([0.0, 1, 2, 3]), np.array([True, True, False, False])) == 1.5


def test_impulse_by_hand():
    """Mach 1.5, gamma = 2: the density rises by 3 M^2/(M^2 + 2), the pressure by (4 M^2 - 1)/3."""
    theory = impulse(1.0, 0.25)
    c = np.sqrt(2.0)
    assert theory.fall == pytest.approx(2*c/3*(1.5 - 1/1.5)) and theory.meets == pytest.approx(60/(1.5*c))
    assert 0 < theory.kick < theory.fall and theory.amplitude < 0.25*30/(2*np.pi)
    twice = impulse(2.0, 0.25)
    np.testing.assert_allclose([twice.meets, twice.back, twice.amplitude, twice.growth],
                               [2*theory.meets, 2*theory.back, 2*theory.amplitude, theory.growth])


@pytest.mark.parametrize("method", (*IN_LAYERS, "spam"))
def test_friction_carries_every_method_through_a_shock(method):
    """All are as far from the frictionless gas: waves are 2.2 spacings wide. Without friction moving points
    end."""
    case = trial("Sod", method, variant(method), 12)
    scene = replace(case.scene, law=ConstEta(0.5, 0.5))
    (first, last), reached, _ = followed(case.entrant.ready(scene), scene.time, 1, partial(copied, scene))
    assert reached == 1 and scene.seen(first, last)["measured"] == pytest.approx(2.2, abs=0.2)
    assert last.rho@last.V == pytest.approx(first.rho@first.V, rel=1e-12)


def test_a_limit_is_found_where_runs_turn_bad_and_each_runs_once(monkeypatch):
    runs = []

    def attempt(variant, ra, seed, step):
        runs.append(ra)
        return high_ra.Attempt(0.01*(1 if ra < 2e5 else 1.5), 1.0 if ra < 3e6 else 0.5)
    monkeypatch.setattr(high_ra, "should_be", lambda ra: 0.01)
    case = high_ra.HighRa(method="made up", attempt=attempt, variant=None, seed=1)
    rows = {row["kind"]: row for row in case.run(lambda done: None, None).rows["high_ra"]}
    assert rows["wrong"]["ra"] == pytest.approx(2e5, rel=0.01)
    assert rows["ends"]["ra"] == pytest.approx(3e6, rel=0.01)
    assert all(0 < row["ra_err"] < 0.01*row["ra"] for row in rows.values())
    assert len(runs) == len({f"{ra:.9g}" for ra in runs})


@pytest.mark.parametrize("trials, ra, err, outcome", [
    (((1e4, 1.0), (1e5, 1.0)), np.nan, np.nan, "none"),
    (((4e4, 1.0), (1e4, 1.0), (9e4, 0.3), (2e5, 1.0), (1e6, 0.1)), 6e4, 2.5e4, "ends")])
def test_a_limit_is_the_first_bad_trial_though_later_ones_are_good(trials, ra, err, outcome):
    search = high_ra.Search(None, {ra: high_ra.Attempt(0.01, reached) for ra, reached in trials})
    limit = search.limit(search.ends, 1e8)
    assert limit == pytest.approx({"ra": ra, "ra_err": err, "tried": max(trials)[0], "outcome": outcome},
                                  nan_ok=True)


def test_a_point_explodes_as_published():
    """Energies, of a plane to one side, of shocks 0.5, 0.75 and 1 far at t = 1    [Kamm & Timmes 2007]"""
    assert 0.75**4*blast(1.4, 2).alpha == pytest.approx(0.311357, rel=1e-4)
    assert blast(1.4, 3).alpha == pytest.approx(0.851072, rel=1e-4)
    assert 0.5**3*blast(1.4, 1).alpha == pytest.approx(2*0.0673185, rel=1e-3)
    with pytest.raises(ValueError, match="up to 2, got 1"):
        blast(1.0)


@pytest.mark.parametrize("case", COLUMNS)
def test_what_a_case_asks_of_its_exact_answer_is_what_it_should_be(case):
    """Fields of the answer itself on a fine lattice; where only numbers are known, of the start."""
    column = COLUMNS[case]
    scene = with_rows(column.scene, 2*column.sizes[0])
    first = on_lattice(scene, *scene.fields(lattice((round(scene.width), round(scene.L))).x))
    at = first
    if isinstance(scene, Strip):
        left, right, _ = scene.problem
        rho, v, P = solution(left, right, GAMMA, first.x[:, 0]/scene.time)
        at = on_lattice(scene, rho/left.rho, np.stack([v, 0*v], axis=1), P/rho)
    if case == "Noh":
        r = np.hypot(*first.x.T)
        inside = r < scene.time/3
        at = on_lattice(scene, np.where(inside, 16.0, 1 + scene.time/r), -first.x/r[:, None], inside/3)
    if case == "Mach 3 body":
        x, edge = with_disc(first.x, scene.disc)
        one = np.ones(len(x))
        at = Fields(x, 0*x, one, np.where(np.isin(np.arange(len(x)), edge), pitot(3.0, GAMMA), one), one)
        assert pitot(3.0, GAMMA) == pytest.approx(12.061, abs=1e-3)     # of tables
    if case == "shocked ripple":
        size = scene.theory.amplitude + scene.theory.growth*(scene.time - scene.theory.meets)
        height = 80.0 + size*np.cos(2*np.pi/scene.width*first.x[:, 0])
        assert 1 + 1/scene.eos.cv == printed.GAMMA      # of theory
        T = HOT + 0.2*np.clip(height - np.abs(first.x[:, 1]), -1, 1)
        at = on_lattice(scene, 1 + 0*T, 0*first.x, T)
    if case != "Sedov":
        value = scene.seen(first, at)
        assert column.right(value["measured"])
        assert abs(value.get("plateau", 0)) < 0.1 and abs(value.get("wiggles", 0)) < 0.1
        assert not column.right(value["measured"] + 10*column.within)
    assert 0 < scene.time < np.inf and scene.fastest > 0


def on_lattice(scene, rho, v, T) -> Fields:
    x = lattice((round(scene.width), round(scene.L))).x
    return Fields(x, v, rho, T, np.ones(len(x)))


def test_the_front_of_a_blast_is_read_off_its_energy():
    """A hollow disc whose energy has the mean radius of the exact one is where it should be."""
    scene = COLUMNS["Sedov"].scene
    x = lattice((scene.L, scene.L)).x
    first = on_lattice(scene, *scene.fields(x))
    radius = ((EOS.cv*first.T).sum()*scene.time**2/blast(GAMMA).alpha)**0.25
    ring = np.exp(-(np.hypot(*x.T) - radius*blast(GAMMA).radius)**2)
    assert radius == pytest.approx(scene.radius, rel=0.03)      # points in a disc of two spacings
    assert scene.seen(first, on_lattice(scene, 1 + 0*ring, 0*x, ring))["measured"] < 0.1


@pytest.mark.parametrize("method", ["grid", "fixed-lattice-entropy-stable", "moving-delaunay", "spam"])
def test_steps_of_trials_are_those_of_the_fastest_flow_to_come(method):
    """Noh's start is cold: its own limit would be hundreds of times longer."""
    case = trial("Noh", method, variant(method), 16)
    assert 0.02 < case.entrant.ready(case.scene, 1).dt < 1.0


def test_one_ended_run_decides_its_size():
    run = {"case": "Sod", "method": "fixed-lattice", "rows": 50, "seed": 1, "reached": 1.0, "refused": "",
           "measured": 1.0}
    runs = [run | {"step": 1.0}, run | {"step": 0.5, "measured": 2.0},
            run | {"rows": 100, "step": 1.0, "reached": 0.5}, run | {"case": "Noh", "rows": 48, "step": 1.0},
            run | {"case": "Gresho", "rows": 24, "step": 1.0, "measured": 0.01},
            *(run | {"rows": rows, "step": 1.0, "method": f"{run['method']}-entropy-stable"}
              for rows in (50, 100))]
    rows = derive(Tables(trials=pd.DataFrame(runs)))
    found = {(row["case"], row["method"], row["variant"]): row for row in rows["map"]}
    sod = found["Sod", "fixed-lattice", "50 rows"]
    assert (sod["measured"], sod["measured_err"], sod["outcome"]) == (2.0, 0.5, "right")
    assert found["Sod", "fixed-lattice", "100 rows"]["outcome"] == "diverges"
    assert found["Gresho", "fixed-lattice", "24 rows"]["outcome"] == "freezes"
    assert {row["variant"]: row["needed"] for row in rows["needs"]} == {"50 rows": "no", "100 rows": "yes"}
