"""The time loop: interrupted runs go on bitwise, divergence has a place; checkpoints, refusals."""
import errno
import re
import signal
from dataclasses import replace
from functools import partial
from typing import ClassVar

import h5py
import numba
import numpy as np
import pytest

from continuum import jit
from continuum.scene import Walls
from particles import checkpoint
from particles.integrators import RK4
from particles.observe import Grid, field_kinetic, heat_flow, particle_kinetic, wall_layers
from particles.run import RANDOM, STUDIES, Divergence, Plan, Run, _check, run
from particles.threads import Threads
from particles.weights import Lucy
from studies.build.spam import OF_LIMIT
from tests.scenes import small

PLAN = Plan(dt=0.6, steps=60, every=5,
            series={"kp": particle_kinetic, "a/b": field_kinetic, ".": heat_flow},     # names are any text
            means={"grid": Grid(*np.meshgrid([-2.0, 0.0, 2.0], [-1.0, 1.0])), "": wall_layers},
            mean_from=10.0)
PLAIN = "give real ones, without a mask"


@pytest.fixture(scope="module")
def uninterrupted():
    method, start = small()
    return run(method, start, PLAN)


def stop_half_way(fraction: float) -> None:
    if fraction > 0.5:
        raise KeyboardInterrupt


def half_done(tmp_path, **other):
    """A run that was interrupted half-way: its method, its start, and the plan to go on with."""
    method, start = small()
    plan = replace(PLAN, checkpoint=f"{tmp_path}/run.h5", checkpoint_seconds=1e9)
    with pytest.raises(KeyboardInterrupt):
        run(method, start, plan, stop_half_way)
    return method, start, replace(plan, **other)


@pytest.mark.parametrize("seconds", [1e9, 0.0])
def test_interrupted_run_goes_on_bitwise(tmp_path, uninterrupted, seconds):
    done = run(*half_done(tmp_path, checkpoint_seconds=seconds))
    assert np.array_equal(done.state, uninterrupted.state) and np.array_equal(done.ids, uninterrupted.ids)
    assert done.series == uninterrupted.series
    assert all(np.array_equal(done.means[name], uninterrupted.means[name]) for name in done.means)


def test_what_is_compiled_in_a_run_is_not_in_its_seconds(uninterrupted):
    class Compiles(RK4):
        def step(self, *arguments):
            super().step(*arguments)
            numba.njit(lambda x: x + 1)(1)
    method, start = small()
    done = run(replace(method, integrator=Compiles), start, Plan(dt=0.6, steps=5))
    assert done.cpu_s < done.compile_s


class Pressed(RK4):
    """Ctrl-C in the middle of a step: its state has gone on, its number has not."""
    times: ClassVar[list[int]] = []

    def step(self, sums, state, dt):
        super().step(sums, state, dt)
        for _ in range(Pressed.times.pop() if Pressed.times else 0):
            signal.raise_signal(signal.SIGINT)


@pytest.mark.parametrize("times", [1, 2])
def test_ctrl_c_keeps_whole_steps(times, tmp_path, monkeypatch, uninterrupted):
    """The first Ctrl-C waits for the end of the step, a second acts at once: no part of a step is kept."""
    method, start = small()
    method, plan = replace(method, integrator=Pressed), replace(PLAN, checkpoint=tmp_path/"run.h5")
    monkeypatch.setattr(Pressed, "times", [times])
    with pytest.raises(KeyboardInterrupt):
        run(method, start, plan)
    assert plan.checkpoint.exists() == (times == 1)
    assert signal.getsignal(signal.SIGINT) is signal.default_int_handler
    assert np.array_equal(run(method, start, plan).state, uninterrupted.state)


def test_checkpoint_of_other_parameters_or_beyond_the_run_is_refused(tmp_path):
    method, start, plan = half_done(tmp_path)
    with pytest.raises(ValueError, match=r"other parameters.*delete it to start anew"):
        run(replace(method, g=2*method.g), start, plan)
    with pytest.raises(ValueError, match="other parameters"):
        run(method, start, replace(plan, dt=0.5))
    with pytest.raises(ValueError, match="other start"):
        run(method, start[:, ::-1].copy(), plan)
    with pytest.raises(ValueError, match="is at step 32, beyond steps = 20: take more steps"):
        run(method, start, replace(plan, steps=20))


def test_a_checkpoint_of_other_code_or_a_broken_one_is_refused(tmp_path, monkeypatch):
    method, start, plan = half_done(tmp_path)
    with monkeypatch.context() as other:
        other.setattr(checkpoint, "source_hash", lambda: "another")
        with pytest.raises(ValueError, match="other code"):
            run(method, start, plan)
        whole = plan.checkpoint.read_bytes()
        # a step that has no factor with 8: all bits of a byte come in turn
        for bit in range(0, 8*len(whole), 211):
            flipped = bytearray(whole)
            flipped[bit//8] ^= 1 << bit % 8
            plan.checkpoint.write_bytes(flipped)
            with pytest.raises(ValueError, match=r"cannot be read.*delete it"):
                checkpoint.load(plan.checkpoint, method, plan, start)
    plan.checkpoint.write_bytes(whole)
    with h5py.File(plan.checkpoint, "r+") as file:
        file.attrs["step"] = 0
    with pytest.raises(ValueError, match="not as it was written"):
        run(method, start, plan)


def test_an_edit_of_sources_during_a_run_does_not_change_the_code_of_its_checkpoints(tmp_path, monkeypatch):
    before = jit.source_hash()
    monkeypatch.setattr(jit, "ROOT", tmp_path)
    assert jit.source_hash() == before


@pytest.mark.parametrize("change", [lambda now: replace(now, state=now.state[:4]),
                                    lambda now: replace(now, ids=now.ids + 10**6)])
def test_a_sealed_checkpoint_of_another_shape_is_refused_before_it_is_used(tmp_path, change):
    method, start, plan = half_done(tmp_path)
    checkpoint.save(plan.checkpoint, method, plan, start,
                    change(checkpoint.load(plan.checkpoint, method, plan, start)))
    with pytest.raises(ValueError, match=r"cannot be read \(its state"):
        run(method, start, plan)


def scaled(factor: float):
    return lambda sums, state: factor


@pytest.mark.parametrize(("one", "other"), [
    (np.zeros(2000), np.r_[np.zeros(1000), -1.0, np.zeros(999)]), (np.r_[1.0, 2.0], np.r_[2.0, 1.0]),
    (scaled(1.0), scaled(2.0)), (lambda: 1, lambda: 2), (Grid(1.0, 2.0), Grid(2.0, 2.0)),
    (partial(scaled, 1.0), partial(scaled, 2.0))])
def test_what_differs_is_told_apart(one, other):
    """Arrays differ in the middle or in their order, functions in what they enclose."""
    assert checkpoint.told(one) != checkpoint.told(other) and " at 0x" not in checkpoint.told(one)


def test_full_disk_keeps_the_last_checkpoint(tmp_path, monkeypatch):
    method, start, plan = half_done(tmp_path, checkpoint_seconds=0.0)
    before = plan.checkpoint.read_bytes()

    def full(*arguments, **more):
        raise OSError(errno.ENOSPC, "No space left on device")

    monkeypatch.setattr(h5py.Group, "__setitem__", full)
    with pytest.raises(OSError, match=r"disk is full; the former one is kept"):
        run(method, start, plan)
    assert plan.checkpoint.read_bytes() == before
    assert [path.name for path in tmp_path.iterdir()] == ["run.h5"]


@pytest.mark.parametrize("kept", [False, True])
def test_divergence_names_step_time_field_and_particle(kept, tmp_path, monkeypatch):
    method, start = small()
    monkeypatch.setattr("particles.run.limit_of", lambda *known: np.inf)
    plan = replace(PLAN, dt=4.0, checkpoint=tmp_path/"run.h5" if kept else None)     # twice the limit
    with pytest.raises(Divergence, match=r"step \d+, time .*point.*halve dt") as told:
        run(method, start, plan)
    assert ("the last checkpoint is kept" in str(told.value)) == kept


def test_not_finite_field_is_named():
    method, start = small()
    sums = method.start(start.shape[1], Threads(1))
    now = Run(state=start.copy(), ids=np.arange(start.shape[1])[::-1], step=3)
    now.state[2, 5] = np.nan
    with pytest.raises(Divergence, match=rf"step 3, time 1.8: vx = nan of particle {start.shape[1] - 6}"):
        _check(method, PLAN, sums, now)


@pytest.mark.parametrize(("change", "message"), [
    (lambda m, s: (m, s[:, :0], PLAN), r"particles are an array \(5, n\).*n >= 1"),
    (lambda m, s: (m, np.full_like(s, np.nan), PLAN), "not finite"),
    (lambda m, s: (m, s.T, PLAN), r"particles are an array \(5, n\) of x, y, vx, vy, e .* got \(128, 5\)"),
    (lambda m, s: (m, [[1.0, 2.0], [3.0]], PLAN), "inhomogeneous"),
    (lambda m, s: (m, s.astype(complex), PLAN), PLAIN), (lambda m, s: (m, s.astype(str), PLAN), PLAIN),
    (lambda m, s: (m, s.astype(bool), PLAN), PLAIN), (lambda m, s: (m, s.astype(object), PLAN), PLAIN),
    (lambda m, s: (m, np.ma.MaskedArray(s), PLAN), PLAIN),
    (lambda m, s: (replace(m, weight=Lucy.of(5.0)), s, PLAN), "wider than the box"),
    (lambda m, s: (replace(m, box=(16.0, 10.0)), s, PLAN), "not at an end of the box 16 x 10"),
    (lambda m, s: (replace(m, walls=(*m.walls, m.walls[0])), s, PLAN), "another wall is there already"),
    (lambda m, s: (replace(m, walls=m.walls[:3]), s, PLAN), "periodic at one end along axis 0 only"),
    (lambda m, s: (m, np.where(np.arange(640).reshape(5, 128) == 4*128 + 7, -50, s), PLAN),
     r"e = -50 \(item 7\) is outside the validity"),
    (lambda m, s: (m, s, replace(PLAN, threads=np.nan)), "threads must be at least 1, got nan"),
    (lambda m, s: (m, s, replace(PLAN, checkpoint_seconds=np.nan)), "checkpoint_seconds must be 0 or more"),
])
def test_what_cannot_work_is_refused(change, message):
    with pytest.raises((ValueError, TypeError), match=message):
        run(*change(*small()))


def test_a_step_above_the_limit_is_told_what_is_stable_and_what_the_studies_take():
    words = (r"dt = 5 is above the stability limit (\S+) .* (\S+) where they lie at random; "
             r"the studies take (\S+),")
    with pytest.raises(ValueError, match=words) as told:
        run(*small(), replace(PLAN, dt=5.0))
    limit, random, taken = (float(number) for number in re.search(words, str(told.value)).groups())
    assert [random, taken] == pytest.approx([RANDOM*limit, STUDIES*limit], rel=0.05)     # of two digits
    assert STUDIES == OF_LIMIT


@pytest.mark.parametrize("found", [np.nan, 0.0])
def test_a_start_without_a_stable_step_is_refused(found, monkeypatch):
    method, start = small()
    monkeypatch.setattr("particles.run.limit_of", lambda method, start: found)
    with pytest.raises(ValueError, match=rf"no stable step: the limit is {found}; look for densities"):
        run(method, start, PLAN)


@pytest.mark.parametrize(("walls", "axis", "shift"), [
    ({}, 1, 4.0), ({}, 1, -0.9), ({}, 1, 100.0), ({"sides": Walls(), "aspect": 2.0}, 0, 8.0)])
def test_particles_beyond_a_wall_at_the_start_are_named_with_place_and_box(walls, axis, shift):
    method, start = small(**walls)
    start[axis] += shift
    beyond = abs(start[axis]) > method.box[axis]/2
    i = int(np.argmax(beyond))
    x, y = start[:2, i]
    words = rf"particle {i} at \({x:g}, {y:g}\) is beyond a wall of the box \|x\| <= 8, \|y\| <= 4"
    with pytest.raises(ValueError, match=rf"{words} \({beyond.sum()} of 128 are\)"):
        run(method, start, PLAN)


def test_periodic_sides_have_no_beyond():
    method, start = small()
    moved = start + np.array([[method.box[0]], [0], [0], [0], [0]])
    plan = replace(PLAN, steps=10, means={})
    # one period further the remainder is rounded: 1e-16 of 24, grown by what ten steps do to it
    np.testing.assert_allclose(run(method, moved, plan).by_id(), run(method, start, plan).by_id(), atol=1e-12)


@pytest.mark.parametrize(("change", "message"), [
    ({"dt": 0.0}, "dt > 0"), ({"dt": np.inf}, "dt > 0 and finite"), ({"steps": -1}, "steps >= 0"),
    ({"every": 0}, "every >= 1"), ({"steps": np.nan}, "steps >= 0"), ({"steps": 0}, "without a record"),
    ({"steps": 10.5}, r"whole numbers, .*steps = 10\.5.*take steps = round"),
    ({"every": 2.5}, r"whole numbers, .*every = 2\.5"), ({"dt": "0.5"}, r"are numbers, got dt = '0\.5'"),
    ({"steps": 4},
     r"4 steps, recorded every 5, leave kp, a/b, \., grid,  without a record: take at least 5"),
    ({"mean_from": 36.0}, r"means from time 36 on have no sample: the last record is at 36; take more steps"),
])
def test_plan_refuses_what_cannot_be_done(change, message):
    with pytest.raises((ValueError, TypeError), match=message):
        replace(PLAN, **change)
