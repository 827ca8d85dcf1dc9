"""Dissipative particles around a body that is held; bad fluids, bodies and steps."""
import numpy as np
import pytest

from particles.dissipative.dpd import Dpd
from particles.dissipative.integrators import (
    GrootWarren65,
    Shardlow,
    VelocityVerlet,
)
from particles.dissipative.pairs3d import Uniform
from particles.dissipative.stream import DpdStream, force_on_body, speed
from particles.integrators import TwoStep
from particles.run import Plan, run

CELL = (4.0, 4.0, 3.0)


@pytest.mark.parametrize("integrator", [VelocityVerlet, GrootWarren65])
def test_what_the_fluid_loses_the_body_gets(integrator):
    """dP/dt = push - force to round-off, but for the first and last half-step, in one of the sums only."""
    state = Dpd(box=CELL).random_start(3.0)
    held = np.flatnonzero((state[:2]**2).sum(axis=0) < 1)
    method = DpdStream(box=CELL, held=held, push=0.5, integrator=integrator)
    start = method.at_rest(state, 0.3)
    plan = Plan(dt=0.01, steps=400, every=400, series={"force": force_on_body, "speed": speed})
    done = run(method, start, plan)
    n, d = start.shape[1], method.d
    gained = n*done.series["speed"][0] - start[d].sum()
    pushed = method.push*(n - len(held))*4.0
    # half a step of the forces of two moments, about 0.005 (m <F^2>)^(1/2); <F^2> = 1000 with the noise of
    # this step
    assert abs(gained - pushed + 4.0*done.series["force"][0]) < 4*0.005*np.sqrt(2*len(held)*1000.0)
    end = done.by_id()
    assert np.array_equal(end[:d, held], start[:d, held]) and not end[d:, held].any()


@pytest.mark.parametrize("wrong, message", [
    ({"held": np.array([], int)}, "0 particles are to be held"),
    ({"held": np.array([1, 1])}, "2 particles are to be held, 1 of"),
    ({"push": np.nan}, "the push must be finite, got nan"),
    ({"integrator": Shardlow}, "Shardlow does not step with forces alone"),
    ({"integrator": TwoStep}, "TwoStep does not step with forces alone")])
def test_bad_bodies(wrong, message):
    with pytest.raises(ValueError, match=message):
        DpdStream(**{"box": CELL, "held": np.arange(3), **wrong})


@pytest.mark.parametrize("wrong, message", [
    ({"kT": -1.0}, "kT must be zero or positive, got -1.0"),
    ({"gamma": -4.5}, "gamma must be zero or positive, got -4.5"),
    ({"a": np.nan}, "a must be zero or positive, got nan"), ({"rc": 0.0}, "rc must be positive, got 0.0"),
    ({"skin": -0.1}, "skin must be positive"), ({"rate": np.inf}, "the shear rate must be finite"),
    ({"box": (10.0, 2.9, 10.0)}, "sides of at least 3 rc = 3"), ({"box": (10.0,)}, "two or three sides"),
    ({"noise": Uniform(-1)}, "the seed must be a whole number")])
def test_bad_fluids(wrong, message):
    with pytest.raises(ValueError, match=message):
        Dpd(**{"box": (4.0, 4.0, 4.0), **wrong})
    with pytest.raises(ValueError, match="rho must be positive and make two particles at least"):
        Dpd(box=(4.0, 4.0, 4.0)).random_start(1e-3)


def test_a_step_beyond_the_stability_limit():
    method = Dpd(box=(4.0, 4.0, 4.0))
    with pytest.raises(ValueError,
                       match=r"dt = 0\.15 is above the stability limit 0\.138 of these particles"):
        run(method, method.random_start(3.0), Plan(dt=0.15, steps=1))


def test_collapsed_particles_are_an_error():
    method = Dpd(box=(30.0, 30.0, 30.0))
    state = method.random_start(0.1)
    state[:3] *= 1e-3
    with pytest.raises(FloatingPointError,
                       match=r"neighbours within 1\.3 of each particle: they have collapsed"):
        run(method, state, Plan(dt=0.02, steps=1))
