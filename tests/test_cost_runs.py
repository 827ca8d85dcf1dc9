"""What the study of cost runs: steps that space allows, seconds and bytes, exact answers, small runs."""
import numpy as np
import pandas as pd
import pytest

from continuum.boussinesq import Case as Mac
from continuum.exact.vortex import SOUND
from particles.fields import Fields
from particles.run import Divergence
from studies.build.scenes import Sound
from studies.cost import contestants, rolls, tables
from studies.cost.cases import CONTESTS, convection
from studies.cost.derive import growth_laws
from studies.cost.problem import HALVINGS, STRETCH, STRETCHES, WORTH, Problem, Result, best, climb, rms
from studies.cost.pypde import SolverRace
from studies.cost.race import Race
from studies.cost.rolls import END, LATE, LOWER_RA, OFTEN, SETTLED, Followed, HeatedLayer
from studies.cost.seconds import TwoThreads, Web, array_bytes, median, per_step
from studies.cost.tables import GRID, MAC, NEAREST, PYPDE
from studies.kit.timing import SPREAD_TO_ERR


def toy(order: int, space: float = 1e-3, limit: float = 1.0, chaotic: bool = False) -> Problem:
    """A run of time 1 whose error is space + dt^order, and diverges above half of its limit."""
    def go(state, dt, steps):
        if dt > 0.5:
            raise Divergence(3, "gone")
        return space + dt**order
    return Problem(1, 0.0, limit, 1.0, go, lambda state: Result({"q": np.array([state])}), lambda: (), chaotic=chaotic)


def exact(stretch: float = 1.0, **more) -> Problem:
    """Without any error of time, for so long that no run is too short; diverges where stretch dt is above 1/2."""
    return toy(4)._replace(time=1e5, go=lambda state, dt, steps: toy(4).go(state, stretch*dt, steps)*0 + 1e-3, **more)


def steps(rungs):
    return [rung.fraction for rung in rungs], [rung.accepted for rung in rungs]


# --- the step -----------------------------------------------------------------------------------------------


@pytest.mark.parametrize(("order", "fraction"), [(4, 1/8), (2, 1/32)])
def test_the_largest_step_is_taken_whose_error_is_below_that_of_space(order, fraction):
    """By hand, dt^p - (dt/2)^p <= 0.001 + (dt/2)^p: 0.0037 > 0.0012 at 1/4, 0.00023 < 0.001 at 1/8 for p = 4; for p = 2
    0.0029 > 0.0020 at 1/16, 0.00073 < 0.0012 at 1/32. An eighth of the error is passed already: no longer step is tried."""
    rungs = climb(toy(order), 1.0)
    assert [rung.fraction for rung in rungs if rung.accepted] == [fraction] == [rungs[-1].fraction]
    assert best(rungs) is rungs[-1]
    assert rms(rungs[-1].result.residuals["q"]) == pytest.approx(1e-3 + fraction**order, rel=1e-12)


def test_a_step_that_costs_no_accuracy_is_made_longer():
    """By hand, from 1/32 on: dt^4 = 9.54e-7 2^n after n times, at n = 7 0.1220 of 0.001, which is below the 2^(1/6) - 1 =
    0.1225 that a longer step is worth; at n = 8 it is not."""
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


def test_a_step_that_diverges_is_halved():
    rungs = climb(toy(4), 1.0)
    assert rungs[0].time == {} and not rungs[0].accepted      # dt = 1 is above what the toy stands
    assert toy(4).result(1.0) is None


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
    assert calm < chaos == pytest.approx(0.1*STRETCH**STRETCHES)     # half of the error changes from step to step


# --- seconds and bytes --------------------------------------------------------------------------------------


def test_seconds_of_a_step_leave_out_what_every_run_pays_once():
    """A clock that counts 100 +- 1 for a call, 0.01 for a step: of 10 000 steps and more the scatter is some per cent."""
    now, rng, most = [0.0], np.random.default_rng(1), []

    def advance(steps):
        most.append(steps)
        now[0] += 100 + rng.uniform(-1, 1) + 0.01*steps
    step = per_step(advance, clock=lambda: now[0])
    assert step.value == pytest.approx(0.01, rel=0.02) and 10_000 <= max(most)/3 < 20_000
    assert abs(step.value - 0.01) < 2*step.err


def test_a_time_is_the_median_of_its_repeats_and_its_error_half_of_their_quartiles():
    assert median([1, 2, 9, 4, 5, 8, 6]) == (5, pytest.approx(SPREAD_TO_ERR*(7 - 3)/2))      # by hand: 1 2 4 5 6 8 9


def test_bytes_count_every_buffer_once_and_nothing_that_only_sets_up():
    class Sums:
        pass
    one = np.zeros(100)
    sums = Sums()
    sums.whole, sums.part, sums.again, sums.method, sums.more = one, one[10:20], [one], np.zeros(7), {"a": (np.zeros(3),)}
    assert array_bytes(sums) == 8*103
    assert array_bytes(one[:1], one[50:]) == 800


def test_one_and_two_threads_take_turns_and_give_what_the_speed_up_reads(tmp_path, monkeypatch):
    case, order, turn = TwoThreads(name="a", kind=Web, rows=12, turns=3, short=1e-4), [], Web.turn

    def watched(made, short):
        order.append(made)
        return turn(made, short)
    monkeypatch.setattr(Web, "turn", watched)
    rows = case.run(lambda done: None, tmp_path).rows["growth"]
    assert [made is order[0] for made in order] == [True, False]*4      # the first turns do not count
    assert [(row["threads"], row["clock"]) for row in rows] == [(1, "wall"), (2, "wall")]
    assert set(rows[0]) == set(tables.GROWTH.columns) and all(row["step_s"] > 0 and row["bytes"] > 0 for row in rows)
    law, = growth_laws(pd.DataFrame(rows).assign(step_s_err=0.0))
    assert law["what"] == "two threads" and law["value"] == pytest.approx(rows[0]["step_s"]/rows[1]["step_s"])


# --- flows with exact answers -------------------------------------------------------------------------------


def test_a_sound_wave_without_friction_comes_back():
    one, x = Sound(width=16, damping=0.0), np.arange(16.0)
    period = 16/SOUND
    np.testing.assert_allclose(one.exactly(period, x), one.exactly(0.0, x), atol=1e-9*one.amplitude)
    np.testing.assert_allclose(one.exactly(period/4, x)[[0, 2]], 0, atol=1e-9*one.amplitude)
    # by hand: u = c A sin kx sin wt after a quarter of a period, P_rho = c^2 rho/2 in A
    assert np.abs(one.exactly(period/4, x)[1]).max() == pytest.approx(SOUND*one.amplitude, rel=1e-9)


def test_the_mac_vortex_is_free_of_divergence_and_steady_but_for_friction():
    case = Mac(ra=2500.0, pr=1.0, box=contestants.CELL, rows=16)
    flow = slice(0, case.mac.ends[1])
    v = contestants.stirred(case)[flow]
    assert np.abs(case.mac.div@v).max() < 1e-12
    assert case.mac.lap[flow, flow]@v == pytest.approx(-2*(2*16*np.sin(np.pi/32))**2*v, abs=1e-9)


def rows_of(kind, scene, name, size):
    """Rows of one case that is timed as shortly as possible, and its error of the velocity."""
    case = kind(scene=scene, entry=CONTESTS[scene][name], resolution=size, short=1e-5)
    rows = case.run(lambda done: None, None).rows
    velocity, = (row["error"] for row in rows["errors"] if row["quantity"] == "velocity")
    return rows, velocity


@pytest.mark.parametrize("kind, name, share", [
    (Race, NEAREST, 1/12), (Race, MAC, 1/12), (SolverRace, PYPDE, 1/12), (Race, GRID, 1/3)])
def test_errors_in_a_slow_vortex_are_those_of_friction(kind, name, share):
    """Between nearest neighbours (ka)^2/12, over cells of twice the size (ka)^2/3: a decay by e is off by as much.

    2 %: the terms of next order, (ka)^2/15 and less."""
    rows, velocity = rows_of(kind, "taylor-green", name, 16)
    assert velocity == pytest.approx(share*(2*np.pi/16)**2, rel=0.02)
    row, = rows["runs"]
    assert set(row) == set(tables.RUNS.columns) and row["run_s"] > 0 and row["bytes"] > 3*row["points"]*8


def test_a_lattice_carries_sound_with_second_order_error():
    coarse, fine = (rows_of(Race, "sound", NEAREST, length)[1] for length in (32, 64))
    assert coarse/fine == pytest.approx(4, rel=0.15)


# --- convection ---------------------------------------------------------------------------------------------

T = np.arange(1, 361)/OFTEN


@pytest.mark.parametrize("fraction", [0.02, 0.005])
def test_a_state_is_steady_once_it_stays_as_near_as_its_error(fraction):
    """K = 1 - exp(-t): within f of 1 from t = ln(1/f) on, half of a free-fall time later for the mean over one."""
    needed = HeatedLayer().needed(Followed(T, 1 - np.exp(-T), None), fraction)
    assert needed == pytest.approx(np.log(1/fraction) + 0.5, abs=0.5)


def test_averages_begin_where_what_is_left_of_the_start_is_below_a_fifth_of_a_percent():
    """K = 1 + a transient like the grid's, 2.4 % at 40: from there on the swings make an interval three times as wide."""
    done = Followed(T, 1 + 0.024*np.exp(-0.11*(T - 40))*np.cos(0.6*(T - 40)), None)
    early, late = (HeatedLayer(late=at).last(done) for at in (LATE, SETTLED))
    assert abs(late.value - 1) < 2e-4 and 3*late.err < early.err
    assert HeatedLayer().last(done) == (done.ke[-1], 0.0)


def test_flows_that_fluctuate_count_the_time_that_their_average_needs():
    """A flow that is steady at once needs the time until it is averaged only as far as its error asks for."""
    done = Followed(T, 1 + 0.01*np.random.default_rng(1).normal(size=len(T)), None)
    coarse, fine = (HeatedLayer(late=SETTLED).needed(done, error) for error in (0.1, 2e-3))
    assert coarse < 0.05*END and fine > 0.05*END


def test_places_are_shifted_to_where_the_rolls_are():
    x = np.stack([np.linspace(-1, 1, 80, endpoint=False), np.zeros(80)], axis=1)
    v = np.stack([np.zeros(80), np.cos(np.pi*(x[:, 0] - 0.3))], axis=1)      # rises at 0.3
    shifted = rolls.aligned(Fields(x, v, np.ones(80), np.ones(80), np.ones(80)))
    np.testing.assert_allclose(np.cos(np.pi*shifted[:, 0]), v[:, 1], atol=1e-12)


@pytest.mark.parametrize("name", [GRID, NEAREST])
def test_half_the_rayleigh_number_has_a_limit_of_its_own(name):
    """K of 12 rows is within 6 % of the limit at Ra 5000, which is a quarter below that at 10 000."""
    flow = HeatedLayer(ra=LOWER_RA, rows=(8, 10, 12))
    entry = convection(flow)[name]
    residuals = entry.make(flow, entry.method, 12, 1).result(entry.first).residuals
    assert rms(residuals["K"]) < 0.06
    assert 0.6 < flow.answer.ke/flow._replace(ra=1e4).answer.ke < 0.8
