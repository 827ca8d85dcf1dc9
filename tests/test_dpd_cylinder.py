"""Dissipative particles past a body: third law, what is held; bad input."""
import numpy as np
import pytest

from particles.dissipative.integrators import GrootWarren65, Shardlow, VelocityVerlet
from particles.dissipative.stream import DpdStream, force_on_body, speed
from particles.integrators import TwoStep
from particles.run import Plan, run

BOX = (4.0, 4.0, 3.0)


def across(x):
    """Coordinates (2, n) across a cylinder of radius 1 in the middle of the box."""
    return x[:2] - 4*np.round(x[:2]/4)


def body(**more):
    """A method with those held that a random start has in the cylinder, and this start."""
    state = DpdStream(box=BOX, held=np.arange(1), **more).random_start(3.0)
    held = np.flatnonzero((across(state)**2).sum(axis=0) < 1)
    method = DpdStream(box=BOX, held=held, **more)
    return method, method.at_rest(state, 0.3)


@pytest.mark.parametrize("integrator", [VelocityVerlet, GrootWarren65])
def test_what_the_fluid_loses_the_body_gets(integrator):
    """dP/dt = push - force to round-off but for the first and the last half-step, whose forces are in one sum only."""
    method, start = body(push=0.5, integrator=integrator)
    plan = Plan(dt=0.01, steps=400, every=400, series={"force": force_on_body, "speed": speed})
    done = run(method, start, plan)
    n, d = start.shape[1], method.d
    gained = n*done.series["speed"][0] - start[d].sum()
    pushed = method.push*(n - len(method.held))*4.0
    # half a step of the forces of two moments, about 0.005 (m <F^2>)^(1/2); <F^2> = 1000 with the noise of this step
    assert abs(gained - pushed + 4.0*done.series["force"][0]) < 4*0.005*np.sqrt(2*len(method.held)*1000.0)
    end = done.by_id()
    assert np.array_equal(end[:d, method.held], start[:d, method.held]) and not end[d:, method.held].any()


@pytest.mark.parametrize("wrong, message", [
    ({"held": np.array([], int)}, "0 particles are to be held"), ({"held": np.array([1, 1])}, "2 particles are to be held, 1 of"),
    ({"push": np.nan}, "the push must be finite, got nan"),
    ({"integrator": Shardlow}, "Shardlow does not step with forces alone"),
    ({"integrator": TwoStep}, "TwoStep does not step with forces alone")])
def test_bad_bodies(wrong, message):
    with pytest.raises(ValueError, match=message):
        DpdStream(**{"box": BOX, "held": np.arange(3), **wrong})
