"""What the study of cost runs: steps that space allows, seconds and bytes, exact answers, small runs."""
from dataclasses import replace

import numpy as np
import pandas as pd
import pytest

from continuum.boussinesq import Case as Mac
from continuum.exact.plates import DEGREE, FLOWS, MU, fields, solved
from continuum.exact.vortex import SOUND
from particles.fields import Fields
from particles.plan import Plan
from particles.run import Divergence, run
from particles.walls.sliding_plate import Sliding
from studies.build.scenes import Sound
from studies.cost import contestants, flows, layer, names, tables
from studies.cost.cases import CONTESTS, layer_sizes, lower
from studies.cost.derive import growth_laws
from studies.cost.growth import Threads
from studies.cost.problem import HALVINGS, STRETCH, STRETCHES, WORTH, Problem, Race, best, climb, result, rms
from studies.cost.timing import FORGET, array_bytes, of_calls, per_step, timed, with_peak


def toy(order: int, space: float = 1e-3, limit: float = 1.0, chaotic: bool = False) -> Problem:
    """A run of time 1 whose error is space + dt^order, and diverges above half of its limit."""
    def go(state, dt, steps):
        if dt > 0.5:
            raise Divergence(3, "gone")
        return space + dt**order
    return Problem(1, 0.0, limit, 1.0, go, lambda state: {"q": np.array([state])}, lambda: (), chaotic=chaotic)


# --- the step -----------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(("order", "fraction"), [(4, 1/8), (2, 1/32)])
def test_the_largest_step_is_taken_whose_error_is_below_that_of_space(order, fraction):
    """By hand, dt^p - (dt/2)^p <= 0.001 + (dt/2)^p: 0.0037 > 0.0012 at 1/4, 0.00023 < 0.001 at 1/8 for p = 4; for p = 2
    0.0029 > 0.0020 at 1/16, 0.00073 < 0.0012 at 1/32. An eighth of the error is passed already: no longer step is tried."""
    rungs = climb(toy(order), 1.0)
    assert [rung.fraction for rung in rungs if rung.accepted] == [fraction] == [rungs[-1].fraction]
    assert best(rungs) is rungs[-1]
    assert rms(rungs[-1].found.residuals["q"]) == pytest.approx(1e-3 + fraction**order, rel=1e-12)


def test_a_step_that_costs_no_accuracy_is_made_longer():
    """By hand, from 1/32 on: dt^4 = 9.54e-7 2^n after n times, at n = 7 0.1220 of 0.001, which is below the 2^(1/6) - 1 = 0.1225
    that a longer step is worth; at n = 8 it is not."""
    rungs = climb(toy(4)._replace(time=1e5), 1/32)
    assert [rung.fraction*32 for rung in rungs] == pytest.approx([STRETCH**n for n in range(9)])
    assert [rung.accepted for rung in rungs] == [True]*8 + [False] and best(rungs) is rungs[7]
    assert pytest.approx(0.1225, abs=1e-4) == WORTH


def test_a_step_is_made_longer_until_it_diverges():
    """Without any error of time: above 1/2 the toy diverges; below that a step is made four times longer, no more."""
    exact = toy(4)._replace(time=1e5, go=lambda state, dt, steps: toy(4).go(state, dt, steps)*0 + 1e-3)
    assert best(climb(exact, 0.3)).fraction == pytest.approx(0.3*STRETCH**2)      # 0.42; the next is 0.505
    most = climb(exact, 0.01)
    assert len(most) == 1 + STRETCHES and best(most).fraction == pytest.approx(0.04)


def test_a_limit_that_is_firm_is_not_passed():
    exact = toy(4, limit=0.1)._replace(time=1e5, firm=True, go=lambda state, dt, steps: toy(4).go(state, dt, steps)*0 + 1e-3)
    assert best(climb(exact, 0.7)).fraction == pytest.approx(0.7*STRETCH**2)      # 0.99
    assert best(climb(exact._replace(firm=False), 0.7)).fraction == pytest.approx(0.7*STRETCH**8)


@pytest.mark.parametrize("grown", [Divergence(3, "gone"), FloatingPointError("gone"), np.array([np.nan])])
def test_a_longer_step_has_to_stand_more_steps_than_the_run_has(grown):
    """In runs of at most ten steps none of which shows that steps above 0.15 grow."""
    def go(state, dt, steps):
        if dt > 0.15 and steps > 100:
            if isinstance(grown, Exception):
                raise grown
            return grown
        return 1e-3
    rungs = climb(toy(4)._replace(go=go), 0.1)
    assert [rung.accepted for rung in rungs] == [True]*3 + [False] and best(rungs).fraction == pytest.approx(0.1*STRETCH**2)


def test_a_step_that_was_halved_stays_below_what_was_too_long():
    """It diverges above 0.75 and is right below: 0.8 is halved; 0.48, 0.57, 0.67 are good, 0.8 is not tried again."""
    exact = toy(4)._replace(time=1e5, go=lambda state, dt, steps: toy(4).go(state, dt/1.5, steps)*0 + 1e-3)
    rungs = climb(exact, 0.8)
    assert [rung.fraction for rung in rungs] == pytest.approx([0.8, *(0.4*STRETCH**n for n in range(4))])
    assert [rung.accepted for rung in rungs] == [False] + [True]*4 and best(rungs) is rungs[-1]


def test_a_step_that_diverges_is_halved():
    rungs = climb(toy(4), 1.0)
    assert rungs[0].time == {} and not rungs[0].accepted      # dt = 1 is above what the toy stands
    assert result(toy(4), 1.0) is None


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


def test_seconds_of_a_step_leave_out_what_every_run_pays_once():
    """A clock that counts: 5 for a call, 0.25 for a step."""
    now = [0.0]

    def advance(steps):
        now[0] += 5 + 0.25*steps
    found = per_step(advance, clock=lambda: now[0])
    assert found == pytest.approx((0.25, 0), abs=1e-12)


def test_steps_take_as_long_as_what_a_run_pays_once():
    """A clock that counts 100 +- 1 for a call, 0.01 for a step: of 10 000 steps and more the scatter is some per cent."""
    now, rng, most = [0.0], np.random.default_rng(1), []

    def advance(steps):
        most.append(steps)
        now[0] += 100 + rng.uniform(-1, 1) + 0.01*steps
    found = per_step(advance, clock=lambda: now[0])
    assert found.value == pytest.approx(0.01, rel=0.02) and 10_000 <= max(most)/3 < 20_000
    assert abs(found.value - 0.01) < 2*found.err


def test_repeats_are_few_where_a_call_is_long():
    now, calls = [0.0], []

    def call(seconds):
        calls.append(seconds)
        now[0] += seconds
    assert of_calls(lambda: call(0.1), lambda: now[0]).value == pytest.approx(0.1) and len(calls) == 7
    assert of_calls(lambda: call(1.0), lambda: now[0]).value == pytest.approx(1) and len(calls) == 10


def test_a_time_is_the_median_of_its_repeats_and_its_error_half_of_their_quartiles():
    assert timed([1, 2, 9, 4, 5, 8, 6], 1.0) == (5, pytest.approx((7 - 3)/2))       # by hand: 1 2 4 5 6 8 9


@pytest.mark.skipif(not FORGET.exists(), reason="the most memory of a process is counted anew on Linux only")
def test_the_most_memory_is_that_of_what_was_made_and_thrown_away():
    # above 32 MiB, below which memory that the process has had before may be taken again
    made, peak = with_peak(lambda: np.ones(8_000_000).sum())
    assert made == 8e6 and abs(peak - 64e6) < 2e6        # kernels count pages in batches
    assert with_peak(lambda: 0)[1] < 1e6


def test_bytes_count_every_buffer_once_and_nothing_that_only_sets_up():
    class Sums:
        pass
    one = np.zeros(100)
    sums = Sums()
    sums.whole, sums.part, sums.again, sums.method, sums.more = one, one[10:20], [one], np.zeros(7), {"a": (np.zeros(3),)}
    assert array_bytes(sums) == 8*103
    assert array_bytes(one[:1], one[50:]) == 800


# --- exact answers ----------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("name", ["conduction", "couette"])
def test_flows_between_plates_keep_their_plates_and_mass_and_do_not_depend_on_the_points(name):
    flow = FLOWS[name]
    _, v, u, T = fields(flow, np.array([0.0, 1.0]))
    np.testing.assert_allclose([v, u, T], [[0, 0], [0, flow.U], [1, 1]], atol=1e-9)
    coefficients = solved(flow)[:, 0]
    n = np.arange(0, DEGREE + 1, 2)
    assert np.sum(coefficients[::2]/(1 - n**2)) == pytest.approx(1, abs=1e-8)     # integral of T_n over [-1, 1], halved
    assert flows.uncertainty(name) < 1e-8


def test_slow_shear_decays_as_its_series_says():
    """U = 1e-3: compression and heating are of the order of its square."""
    flow = FLOWS["couette"]._replace(U=1e-3)
    s = np.linspace(0, 1, 41)
    np.testing.assert_allclose(fields(flow, s)[2]/1e-3, s + np.sin(3*np.pi*s)/2*np.exp(-9*np.pi**2*MU*flow.time), atol=1e-6)


def test_small_heat_at_a_plate_of_no_conduction_stays():
    """After no time at all: the start itself, of mean density 1 and uniform pressure."""
    s = np.linspace(0, 1, 2001)
    rho, v, u, T = FLOWS["conduction"].start(s)
    assert np.ptp(rho*T) < 1e-12 and np.trapezoid(rho, s) == pytest.approx(1, abs=1e-6)
    assert not v.any() and not u.any()


def test_a_sound_wave_without_friction_comes_back():
    one, x = Sound(width=16, damping=0.0), np.arange(16.0)
    period = 16/SOUND
    np.testing.assert_allclose(one.exactly(period, x), one.exactly(0.0, x), atol=1e-9*one.amplitude)
    np.testing.assert_allclose(one.exactly(period/4, x)[[0, 2]], 0, atol=1e-9*one.amplitude)
    # by hand: u = c A sin kx sin wt after a quarter of a period, P_rho = c^2 rho/2 in A
    assert np.abs(one.exactly(period/4, x)[1]).max() == pytest.approx(SOUND*one.amplitude, rel=1e-9)


def test_the_mac_vortex_is_free_of_divergence_and_steady_but_for_friction():
    case = Mac(ra=2500.0, pr=1.0, box=contestants.CELL, rows=16)
    q = contestants.stirred(case)
    assert np.abs(case.mac.div@q[:case.mac.ends[1]]).max() < 1e-12
    assert case.mac.lap[:case.mac.ends[1], :case.mac.ends[1]]@q[:case.mac.ends[1]] == pytest.approx(
        -2*(2*16*np.sin(np.pi/32))**2*q[:case.mac.ends[1]], abs=1e-9)


def test_a_sliding_plate_drags_particles_as_a_resting_one_drags_a_stream():
    """The whole flow seen from a frame that moves with the upper plate: to round-off of some ten steps."""
    problem = CONTESTS["couette"][names.LUCY].problem(8, 1)
    method = problem.held()[1].method
    lower_plate, upper, *sides = method.walls

    def moved(drift):
        walls = (Sliding(lower_plate, drift), Sliding(upper.mirror, 0.05 + drift), *sides)
        state = problem.first.copy()
        state[2] = 0.1*state[1]/8 + drift
        return run(replace(method, walls=walls), state, Plan(dt=0.2, steps=10)).by_id()
    still, seen = moved(0.0), moved(0.3)
    np.testing.assert_allclose(seen[2] - 0.3, still[2], atol=1e-12)
    np.testing.assert_allclose(seen[[1, 3, 4]], still[[1, 3, 4]], atol=1e-12)


# --- small runs ---------------------------------------------------------------------------------------------------------


def errors(scene, method, resolution, **more):
    """By quantity, of one case that is timed as shortly as possible."""
    rows = Race(scene=scene, method=method, resolution=resolution, short=1e-5, **more).run(lambda done: None, None).rows
    return {row["quantity"]: row["error"] for row in rows["errors"]}, rows


def error_of_space(method, resolution, quantity):
    """With the first step that is tried, whose own error is small beside it."""
    return rms(result(method.problem(resolution, 1), method.first).residuals[quantity])


@pytest.mark.parametrize("name", [names.GRID, names.LATTICE, names.JITTERED])
@pytest.mark.parametrize("scene", ["conduction", "couette"])
def test_grids_and_points_are_of_second_order_between_plates(scene, name):
    coarse, fine = (next(iter(errors(scene, CONTESTS[scene][name], rows)[0].values())) for rows in (12, 24))
    assert 3 < coarse/fine < 6.5        # 4; on jittered points 12 rows are not yet in its range


@pytest.mark.parametrize("scene", ["sound", "taylor-green"])
def test_the_grid_without_plates_is_of_second_order(scene):
    coarse, fine = (error_of_space(CONTESTS[scene][names.GRID], size, "velocity") for size in (24, 48))
    assert coarse/fine == pytest.approx(4, rel=0.06)


@pytest.mark.parametrize("scene", ["taylor-green", "couette"])
def test_py_pde_is_of_second_order_where_nothing_convects(scene):
    """Errors at 16 over those at 32: 4.00 was measured."""
    coarse, fine = (CONTESTS[scene][names.PYPDE_GAS].solve(size) for size in (16, 32))
    assert rms(coarse.residuals["velocity"])/rms(fine.residuals["velocity"]) == pytest.approx(4, rel=0.03)
    assert fine.seconds.value > 0 and fine.compile_s > 0


def test_a_lattice_carries_sound_with_second_order_error_and_its_row_is_whole():
    coarse, fine = (errors("sound", CONTESTS["sound"][names.NEAREST], length) for length in (32, 64))
    assert coarse[0]["velocity"]/fine[0]["velocity"] == pytest.approx(4, rel=0.15)
    run_row, = fine[1]["runs"]
    assert set(run_row) == set(tables.RUNS.columns)
    assert run_row["run_s"] > 0 and run_row["bytes"] > 8*4*64*8 and run_row["points"] == 64*8


# --- convection ---------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("fraction", [0.02, 0.005])
def test_a_state_is_steady_once_it_stays_as_near_as_its_error(fraction):
    """K = 1 - exp(-t): within f of 1 from t = ln(1/f) on, half of a free-fall time later for the mean over one."""
    t = np.arange(1, 361)/layer.OFTEN
    needed = layer.Rules(None).needed(layer.Followed(t, 1 - np.exp(-t), None), fraction)
    assert needed == pytest.approx(np.log(1/fraction) + 0.5, abs=0.5)


def test_averages_begin_where_what_is_left_of_the_start_is_below_a_fifth_of_a_percent():
    """K = 1 + a transient like the grid's, 2.4 % at 40: from there on the swings make an interval three times as wide."""
    t = np.arange(1, 361)/layer.OFTEN
    done = layer.Followed(t, 1 + 0.024*np.exp(-0.11*(t - 40))*np.cos(0.6*(t - 40)), None)
    early, late = (layer.Rules(None, at).end(done) for at in (layer.LATE, layer.SETTLED))
    assert abs(late[0] - 1) < 2e-4 and 3*late[1] < early[1]
    assert layer.Rules(None).end(done) == (done.ke[-1], 0.0)


def test_flows_that_fluctuate_count_the_time_that_their_average_needs():
    """A flow that is steady at once needs the time until it is averaged only as far as its error asks for."""
    t, rng = np.arange(1, 361)/layer.OFTEN, np.random.default_rng(1)
    done = layer.Followed(t, 1 + 0.01*rng.normal(size=len(t)), None)
    rules = layer.Rules(layer.Reference(1.0, 0.0, (), None, 0.0), layer.SETTLED)
    coarse, fine = (rules.share(done, {"K": np.array([error])})["K"] for error in (0.1, 2e-3))
    assert coarse < 0.05 < fine <= 1


def test_places_are_shifted_to_where_the_rolls_are():
    x = np.stack([np.linspace(-1, 1, 80, endpoint=False), np.zeros(80)], axis=1)
    v = np.stack([np.zeros(80), np.cos(np.pi*(x[:, 0] - 0.3))], axis=1)      # rises at 0.3
    shifted = layer.aligned(Fields(x, v, np.ones(80), np.ones(80), np.ones(80)))
    np.testing.assert_allclose(np.cos(np.pi*shifted[:, 0]), v[:, 1], atol=1e-12)


@pytest.mark.parametrize("name", [names.GRID, names.NEAREST])
def test_half_the_rayleigh_number_has_a_limit_of_its_own(name):
    """K of 12 rows is within 6 % of the limit at Ra 5000, which is a quarter below that at 10 000."""
    small = layer_sizes(8, 10, 12)
    assert errors("convection-5000", lower()[name]._replace(sizes=small), 12)[0]["K"] < 0.06
    limit = [layer.reference(small, ra).ke for ra in (layer.LOWER_RA, layer.RA)]
    assert 0.6 < limit[0]/limit[1] < 0.8


@pytest.mark.parametrize("fixed", [False, True])
def test_one_and_two_threads_take_turns_and_give_what_the_speed_up_reads(fixed, tmp_path, monkeypatch):
    case, order = Threads(rows=12, fixed=fixed, turns=3, short=1e-4), []
    name = "_edges" if fixed else "_particles"
    made = getattr(Threads, name)

    def watched(self):
        turn, size = made(self)
        return lambda threads: order.append(threads) or turn(threads), size
    monkeypatch.setattr(Threads, name, watched)
    rows = case.run(lambda done: None, tmp_path).rows["growth"]
    assert order == [1, 2]*4          # the first turns do not count
    assert [(row["threads"], row["clock"]) for row in rows] == [(1, "wall"), (2, "wall")]
    assert set(rows[0]) == set(tables.GROWTH.columns) and all(row["step_s"] > 0 and row["bytes"] > 0 for row in rows)
    law, = growth_laws(pd.DataFrame(rows).assign(step_s_err=0.0))
    assert law["what"] == "two threads" and law["value"] == pytest.approx(rows[0]["step_s"]/rows[1]["step_s"])
