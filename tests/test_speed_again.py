"""The study speed: threads in turns, sizes, seconds anew, flows that fluctuate, half the Rayleigh number."""
from dataclasses import replace

import numpy as np
import pandas as pd
import pytest

import studies.cost.cases as speed
from studies.cost import again as speed_again
from studies.cost import convection as layer
from studies.cost import layer_runs as convection
from studies.cost import names
from studies.cost import plates as slab
from studies.cost import tables as speed_tables
from studies.cost.claims import CLAIMS
from studies.cost.derive import growth_laws
from studies.cost.growth import Growth, Threads
from studies.cost.problem import Race
from studies.kit.claim import judge
from studies.kit.sweep import RESULTS
from studies.kit.table import Tables, read

SHORT = 1e-4


def test_growth_has_a_row_for_each_size_clock_and_number_of_threads():
    """224 rows are timed by both clocks: no two rows of the table have the same key."""
    keys = [(case.name, case.points, threads, "wall" if isinstance(case, Threads) else "cpu")
            for case in speed.cases("paper") if isinstance(case, Growth)
            for threads in ((1, 2) if isinstance(case, Threads) else (1,))]
    assert len(set(keys)) == len(keys) == 2*13 + 2*2*2      # sizes; and at two of them one and two threads
    decades = {name: [points for one, points, *_ in keys if one == name] for name in (names.LUCY, names.LATTICE)}
    assert all(min(found) < 1000 < 0.95e6 < max(found) for found in decades.values())


@pytest.mark.parametrize("fixed", [False, True])
def test_one_and_two_threads_take_turns_and_give_what_the_speed_up_reads(fixed, tmp_path, monkeypatch):
    case, order = Threads(rows=12, fixed=fixed, turns=3, short=SHORT), []
    kind, name = ("web", "_edges") if fixed else ("flock", "_particles")
    made = getattr(Threads, name)

    def watched(self):
        turn, size = made(self)
        return lambda threads: order.append(threads) or turn(threads), size
    monkeypatch.setattr(Threads, name, watched)
    rows = case.run(lambda done: None, tmp_path).rows["growth"]
    assert order == [1, 2]*4, kind          # the first turns do not count
    assert [(row["threads"], row["clock"]) for row in rows] == [(1, "wall"), (2, "wall")]
    assert set(rows[0]) == set(speed_tables.GROWTH.columns) and all(row["step_s"] > 0 and row["bytes"] > 0 for row in rows)
    law, = growth_laws(pd.DataFrame(rows).assign(step_s_err=0.0))
    assert law["what"] == "two threads" and law["value"] == pytest.approx(rows[0]["step_s"]/rows[1]["step_s"])


# --- flows that fluctuate ------------------------------------------------------------------------------------------------


def swinging(rate: float) -> convection.Followed:
    """K = 1 + a transient like the grid's, 2.4 % at 40 free-fall times, sampled until 90."""
    t = np.arange(1, 361)/convection.OFTEN
    return convection.Followed(t, 1 + 0.024*np.exp(-rate*(t - 40))*np.cos(0.6*(t - 40)), None)


def test_averages_begin_where_what_is_left_of_the_start_is_below_a_fifth_of_a_percent():
    """So that 1 % can be told: from 40 on the swings alone make an interval three times as wide."""
    done = swinging(0.11)
    early, late = (convection.end_of(done, at) for at in (convection.LATE, convection.SETTLED))
    assert abs(late[0] - 1) < 2e-4 and 3*late[1] < early[1]
    assert convection.end_of(done, None) == (done.ke[-1], 0.0)


def test_moving_points_are_averaged_once_they_have_settled_and_count_what_they_need():
    """A flow that is steady at once needs the time until it is averaged only as far as its error asks for."""
    t, rng = np.arange(1, 361)/convection.OFTEN, np.random.default_rng(1)
    done = convection.Followed(t, 1 + 0.01*rng.normal(size=len(t)), None)
    coarse, fine = (convection.shares_of(done, {"K": error}, convection.SETTLED)["K"] for error in (0.1, 2e-3))
    assert coarse < 0.05 < fine <= 1


def test_moving_points_reach_one_percent():
    """Of size paper: a rung on either side of 1 % in K, whose error falls as rows^-2.1 from 3.2 % at 24."""
    rows = [case.resolution for case in speed.cases("paper") if isinstance(case, Race)
            and (case.scene, case.method.name) == ("convection", names.MOVING)]
    assert 0.032*(24/rows[-2])**2.1 > 0.01 > 0.032*(24/rows[-1])**2.1
    assert layer.MOVING._replace(sizes=(8, 10, 12)).problem(8, 1).chaotic


# --- half the Rayleigh number --------------------------------------------------------------------------------------------


@pytest.mark.parametrize("method", [layer.GRID_LOWER, layer.NEAREST_LOWER])
def test_half_the_rayleigh_number_has_a_limit_of_its_own(method):
    """K of 12 rows is within 6 % of the limit at Ra 5000, which is a quarter below that at 10 000."""
    small = method._replace(sizes=(8, 10, 12))
    rows = Race(scene="convection-5000", method=small, resolution=12, short=SHORT).run(lambda done: None, RESULTS).rows
    error, = (row["error"] for row in rows["errors"] if row["quantity"] == "K")
    assert error < 0.06
    limit = [convection.reference((8, 10, 12), ra).ke for ra in (convection.LOWER_RA, convection.RA)]
    assert 0.6 < limit[0]/limit[1] < 0.8


def test_the_verdict_at_half_the_rayleigh_number_is_that_of_its_own_rows():
    found = [{"scene": "convection-5000", "quantity": "K", "method": name, "level": 0.01, "reached": "yes", "cpu_s": cpu,
              "low": 0.9*cpu, "high": 1.1*cpu, "points": 1e3, "error": 0.01}
             for name, cpu in ((names.GRID, 1.0), (names.NEAREST, 1.5))]
    said = {row["id"]: row["verdict"] for row in judge(CLAIMS, Tables({"needed": pd.DataFrame(found)}), "speed")}
    assert said["own-speed-fixed-points-5000"] == "holds" and said["own-speed-fixed-points"] == "undecidable"


# --- seconds anew --------------------------------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def committed(tmp_path_factory):
    """Tables of two cases whose seconds were not measured but said; a third whose step is not known, and one without a step."""
    out = tmp_path_factory.mktemp("results")
    method = slab.CONTESTANTS["conduction"][names.LATTICE]
    cases = [Race(scene="conduction", method=method, resolution=n, short=SHORT) for n in (8, 12)]
    for case in cases:
        rows = case.run(lambda done: None, out).rows
        rows["runs"][0] |= {"run_s": 1e3, "setup_s": 1e3}
        speed_again.put(rows, out, "paper", "test")
    return out, [*cases, replace(cases[0], resolution=16), Growth(rows=12, fixed=True, short=SHORT)]


def test_seconds_are_measured_anew_and_errors_stay(committed):
    out, cases = committed
    before = {name: (out/"speed"/f"{name}.csv").read_text() for name in ("errors", "steps")}
    old = read(out/"speed"/"runs.csv")
    speed_again.renew(speed.STUDY, [*cases[:2], cases[3]], out, "paper", "test")
    assert before == {name: (out/"speed"/f"{name}.csv").read_text() for name in before}
    new = read(out/"speed"/"runs.csv")
    assert (new["run_s"] < 1).all() and (new["setup_s"] < 1).all()
    for same in ("resolution", "points", "of_limit", "dt", "steps", "bytes"):
        np.testing.assert_array_equal(new[same], old[same])
    points = read(out/"speed"/"points.csv")
    assert (points["cpu_s"] < 1).all() and len(read(out/"speed"/"growth.csv")) == 1
    speed_again.renew(speed.STUDY, [cases[2]], out, "paper", "test")
    for name in ("errors", "steps", "runs"):
        assert set(read(out/"speed"/f"{name}.csv")["resolution"]) == {8, 12, 16}, "it was run whole"


def test_the_step_that_is_timed_again_is_the_longest_that_is_good_enough_else_the_shortest():
    case = Race(scene="conduction", method=slab.CONTESTANTS["conduction"][names.GRID], resolution=8)
    tried = ((1, 1.8, 0), (1, 0.9, 0), (1, 0.45, 1), (1, 0.5, 1), (1, 0.6, 0), (1, 0.2, 0), (2, 0.1, 1), (2, 3.0, 1))
    steps = pd.DataFrame([{**case.key_columns, "seed": seed, "of_limit": one, "accepted": good} for seed, one, good in tried])
    assert speed_again.fraction_of(case, steps) == 0.5
    assert speed_again.fraction_of(case, steps[steps["accepted"] == 0]) == 0.2
    assert speed_again.fraction_of(replace(case, resolution=12), steps) is None
