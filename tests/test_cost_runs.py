"""What the study of cost runs: steps that space allows, seconds and bytes, exact answers, small runs."""
from dataclasses import replace

import numpy as np
import pandas as pd
import pytest

from particles.fields import Fields
from particles.run import Divergence
from studies.build import variant
from studies.cost import tables
from studies.cost.cases import CONTESTS
from studies.cost.problem import HALVINGS, STRETCH, STRETCHES, WORTH, Problem, Result, best, climb, rms
from studies.cost.rolls import END, OFTEN, SETTLED, Followed, HeatedLayer, compared, extended, reference
from studies.cost.seconds import Flock, TwoThreads, per_step
from studies.cost.tables import GRID, MAC, NEAREST, PYPDE, growth_laws

COLUMNS = {table.name: table.columns for table in tables.TABLES}


def toy(order: int, space: float = 1e-3, limit: float = 1.0, chaotic: bool = False) -> Problem:
    """A run of time 1 whose error is space + dt^order, and diverges above half of its limit."""
    def go(state, dt, steps):
        if dt > 0.5:
            raise Divergence(3, "gone")
        return space + dt**order

    def judge(state):
        return Result({"q": np.array([state])})
    return Problem(1, 0.0, limit, 1.0, go, judge, tuple, chaotic=chaotic)


def exact(stretch: float = 1.0, **more) -> Problem:
    """Without any error of time, so long that no run is too short; diverges where stretch dt is above 1/2."""
    def go(state, dt, steps):
        return toy(4).go(state, stretch*dt, steps)*0 + 1e-3
    return toy(4)._replace(time=1e5, go=go, **more)


def steps(rungs):
    return [rung.fraction for rung in rungs], [rung.accepted for rung in rungs]


@pytest.mark.parametrize(("order", "fraction"), [(4, 1/8), (2, 1/32)])
def test_the_largest_step_is_taken_whose_error_is_below_that_of_space(order, fraction):
    """By hand, dt^p - (dt/2)^p <= 0.001 + (dt/2)^p: 0.0037 > 0.0012 at 1/4, 0.00023 < 0.001 at 1/8 for p = 4;
    0.0029 > 0.0020 at 1/16, 0.00073 < 0.0012 at 1/32 for p = 2. An eighth of the error is passed already."""
    rungs = climb(toy(order), 1.0)
    assert [rung.fraction for rung in rungs if rung.accepted] == [fraction] == [rungs[-1].fraction]
    assert rungs[0].result is None      # dt = 1 is above what the toy stands
    assert best(rungs) is rungs[-1]
    assert rms(rungs[-1].result.residuals["q"]) == pytest.approx(1e-3 + fraction**order, rel=1e-12)


def test_a_step_that_costs_no_accuracy_is_made_longer():
    """By hand, from 1/32 on: dt^4 = 9.54e-7 2^n after n times, at n = 7 0.1220 of 0.001, which is below the
    2^(1/6) - 1 = 0.1225 that a longer step is worth; at n = 8 it is not."""
    rungs = climb(toy(4)._replace(time=1e5), 1/32)
    fractions, accepted = steps(rungs)
    assert fractions == pytest.approx([STRETCH**n/32 for n in range(9)])
    assert accepted == [True]*8 + [False] and best(rungs) is rungs[7]
    assert pytest.approx(0.1225, abs=1e-4) == WORTH


@pytest.mark.parametrize("problem, first, last", [
    (exact(), 0.3, 0.3*STRETCH**2),                         # 0.42; the next is 0.505, where it diverges
    (exact(), 0.01, 0.04),                                  # four times longer, no more
    (exact(limit=0.1, firm=True), 0.7, 0.7*STRETCH**2),     # 0.99 of a limit that is firm
    (exact(limit=0.1), 0.7, 0.7*STRETCH**8),
    (exact(1/1.5), 0.8, 0.4*STRETCH**3),                    # 0.8 was halved, and is not tried again
])
def test_a_step_is_made_longer_until_it_diverges_or_meets_a_bound(problem, first, last):
    assert best(climb(problem, first)).fraction == pytest.approx(last)


@pytest.mark.parametrize("grown", [Divergence(3, "gone"), FloatingPointError("gone"), np.array([np.nan])])
def test_a_longer_step_has_to_stand_more_steps_than_the_run_has(grown):
    """In runs of at most ten steps none of which shows that steps above 0.15 grow."""
    def go(state, dt, steps):
        if dt > 0.15 and steps > 100:
            if isinstance(grown, Exception):
                raise grown
            return grown
        return 1e-3
    fractions, accepted = steps(climb(toy(4)._replace(go=go), 0.1))
    assert accepted == [True]*3 + [False] and fractions[2] == pytest.approx(0.1*STRETCH**2)


def test_the_shortest_step_is_taken_where_time_errs_more_than_space_at_any():
    """Second order: halving a step takes away three quarters of its error, three times what is left."""
    rungs = climb(toy(2, space=0.0), 1.0)
    assert len(rungs) == HALVINGS and not any(rung.accepted for rung in rungs)
    assert best(rungs).fraction == rungs[-1].fraction == 2.0**-(HALVINGS - 1)


def test_chaos_compares_the_sizes_of_errors_only():
    def flips(state, dt, steps):
        return 1e-3 if steps % 2 else -1e-3
    problem = toy(4)._replace(go=flips)
    assert not climb(problem, 0.9)[0].accepted and climb(problem._replace(chaotic=True), 0.9)[0].accepted
    noisy = problem._replace(time=1e4, go=lambda state, dt, steps: 1e-3*(1 + 0.5*(steps % 2)))
    calm, chaos = (best(climb(noisy._replace(chaotic=one), 0.1)).fraction for one in (False, True))
    assert calm < chaos == pytest.approx(0.1*STRETCH**STRETCHES)     # half of the error changes


def test_seconds_of_a_step_leave_out_what_every_run_pays_once():
    """A clock that counts 100 +- 1 for a call, 0.01 for a step: the scatter of 10 000 steps is small."""
    now, rng, most = [0.0], np.random.default_rng(1), []

    def advance(steps):
        most.append(steps)
        now[0] += 100 + rng.uniform(-1, 1) + 0.01*steps
    step = per_step(advance, clock=lambda: now[0])
    assert step.value == pytest.approx(0.01, rel=0.02) and 10_000 <= max(most)/3 < 20_000
    assert abs(step.value - 0.01) < 2*step.err


def test_one_and_two_threads_take_turns_and_give_what_the_speed_up_reads(monkeypatch):
    order = []

    def laps(flock, count, clock):
        order.append(flock.threads)
        return np.full(count, 3.0 - flock.threads + 10*(len(order) < 3))
    monkeypatch.setattr(Flock, "laps", laps)
    case = TwoThreads(method="a", variant=variant("spam"), rows=12, turns=3)
    rows = case.run(lambda done: None, None).rows["growth"]
    assert order == [1, 2]*4          # the first turns, which take longer, do not count
    assert set(rows[0]) == set(COLUMNS["growth"]) and {row["clock"] for row in rows} == {"wall"}
    law, = growth_laws(pd.DataFrame(rows))
    assert law["what"] == "two threads" and law["value"] == pytest.approx(2)


def race(scene, name, size):
    """A race that is timed as shortly as possible."""
    return next(CONTESTS[scene].cases(scene, [name], [size], short=1e-5))


def rows_of(case):
    """Rows of a case, and its errors by quantity."""
    rows = case.run(lambda done: None, None).rows
    return rows, {row["quantity"]: row["error"] for row in rows["errors"]}


@pytest.mark.parametrize("name, share", [(NEAREST, 1/12), (MAC, 1/12), (PYPDE, 1/12), (GRID, 1/3)])
def test_errors_in_a_slow_vortex_are_those_of_friction(name, share):
    """Between nearest neighbours (ka)^2/12, over cells of twice the size (ka)^2/3: a decay is off so much.

    2 %: the terms of next order, (ka)^2/15 and less."""
    rows, errors = rows_of(race("taylor-green", name, 16))
    assert errors["velocity"] == pytest.approx(share*(2*np.pi/16)**2, rel=0.02)
    row, = rows["runs"]
    assert set(row) == set(COLUMNS["runs"]) and row["run_s"] > 0 and row["setup_s"] > 0


def test_convection_of_pypde_is_of_second_order():
    """Between 8 and 16 rows; 0.3: terms of fourth order are a tenth of the error at 8."""
    flow, errors = HeatedLayer(rows=(16, 24, 32)), []
    for rows in (8, 16):
        made, error = rows_of(replace(race("convection", PYPDE, rows), flow=flow))
        errors.append(error["K"])
        assert 0 < made["errors"][0]["share"] < 1
    assert np.log2(errors[0]/errors[1]) == pytest.approx(2, abs=0.3)


T = np.arange(1, 361)/OFTEN


@pytest.mark.parametrize("fraction", [0.02, 0.005])
def test_a_state_is_steady_once_it_stays_as_near_as_its_error(fraction):
    """K = 1 - exp(-t): within f of 1 from t = ln(1/f) on, half of a free-fall time later for means."""
    needed = HeatedLayer().needed(Followed(T, 1 - np.exp(-T), None), fraction)
    assert needed == pytest.approx(np.log(1/fraction) + 0.5, abs=0.5)


def test_flows_that_fluctuate_count_the_time_that_their_average_needs():
    """A flow that is steady at once needs the time until it is averaged only as far as its error asks for."""
    done = Followed(T, 1 + 0.01*np.random.default_rng(1).normal(size=len(T)), None)
    coarse, fine = (HeatedLayer(late=SETTLED).needed(done, error) for error in (0.1, 2e-3))
    assert coarse < 0.05*END and fine > 0.05*END


def test_rolls_are_compared_where_velocities_differ_least():
    """At random places, moved by 0.3 heights, an error of 1 % in each velocity is one of 1 %: of 800 numbers,
    6 % in 95 of 100 samples. The phase of v_y near the middle alone made 15 % of it here."""
    answer, random = reference((8, 12, 16), 1e4).fields, np.random.default_rng(1)
    x, V = random.uniform((-1.0, -0.5), (1.0, 0.5), (400, 2)), random.uniform(0.5, 1.5, 400)
    exact = extended(answer, x + np.array([0.3, 0.0]))
    v = np.stack([exact.vx, exact.vy], axis=1)
    noise = 0.01*np.sqrt(np.mean(V*(v**2).sum(axis=1))/np.mean(V)/2)
    at = Fields(x, v + noise*random.standard_normal(v.shape), exact.rho, exact.T, V)
    errors = {name: rms(differences) for name, differences in compared(at, answer).items()}
    assert errors["velocity"] == pytest.approx(0.01, rel=0.06)
    assert errors["temperature"] < 1e-3     # of a place good to 0.01/400^(1/2)/pi heights
