"""Kick, drift, friction, drift, kick on moving particles: reversible without friction, kT, threads and restart, shear."""
import numpy as np
import pytest

from particles.dissipative.dpd import Dpd
from particles.dissipative.observe import configurational_temperature, kinetic_temperature
from particles.integral.splitting import KickDriftFrictionDriftKick
from particles.run import Plan, run
from studies.kit.stats import mean


def soft_spheres(**more) -> Dpd:
    return Dpd(**{"box": (6.0, 6.0, 6.0), "integrator": KickDriftFrictionDriftKick, **more})


def test_without_friction_steps_can_be_taken_back():
    method = soft_spheres(gamma=0.0, kT=0.0)
    start = soft_spheres().random_start(3.0)
    there = run(method, start, Plan(dt=0.01, steps=40)).by_id()
    there[3:6] *= -1
    back = run(method, there, Plan(dt=0.01, steps=40)).by_id()
    apart = back[:3] - start[:3]
    assert np.abs(apart - 6*np.round(apart/6)).max() < 1e-10        # round-off, which neighbours amplify some thousandfold
    assert np.abs(back[3:6] + start[3:6]).max() < 1e-10
    assert np.abs(there[:3] - start[:3]).max() > 0.1


def test_both_temperatures_are_right_to_a_per_cent_at_the_usual_step():
    method, series = soft_spheres(), {"kinetic": kinetic_temperature, "configurational": configurational_temperature}
    start = run(method, method.random_start(3.0), Plan(dt=0.02, steps=500)).state
    done = run(method, start, Plan(dt=0.02, steps=6000, every=10, series=series))
    for name in series:
        found = mean(done.series[name])
        assert found.err < 0.02
        assert abs(found.value - 1) < 0.01 + found.err, name
    assert np.abs(done.state[3:6].sum(axis=1)).max() < 1e-10


def test_threads_and_a_restart_make_no_difference(tmp_path):
    method, file = soft_spheres(), tmp_path/"run.h5"
    start = method.random_start(3.0)
    whole, two = (run(method, start, Plan(dt=0.02, steps=24, threads=threads)).by_id() for threads in (1, 2))

    def stop(sums, state):
        stopped.append(1)
        if len(stopped) == 2:
            raise KeyboardInterrupt
        return 0.0

    stopped: list[int] = []
    plan = Plan(dt=0.02, steps=24, series={"stop": stop}, every=8, checkpoint=file)
    with pytest.raises(KeyboardInterrupt):
        run(method, start, plan)
    assert np.array_equal(whole, two)
    assert np.array_equal(whole, run(method, start, plan).by_id())


def test_a_shear_is_refused():
    method = soft_spheres(rate=0.5)
    with pytest.raises(ValueError, match=r"sheared at the rate 0\.5 .* take Shardlow"):
        run(method, method.random_start(3.0), Plan(dt=0.02, steps=1))
