"""Dissipative particles past a body: third law, what is held, what turns, effective radius; bad input."""
import numpy as np
import pytest

from continuum.exact.cylinder import drag_of, series
from particles.dissipative.integrators import GrootWarren65, Shardlow, VelocityVerlet
from particles.dissipative.stream import DpdStream, force_on_body, speed
from particles.integrators import TwoStep
from particles.run import Plan, run
from studies.noise.dpd.cylinder import Inside
from studies.noise.dpd.derive_more import offset

BOX = (4.0, 4.0, 3.0)


def body(**more):
    """A method with those held that a random start has in a cylinder of radius 1, and this start."""
    method = DpdStream(box=BOX, held=np.arange(1), **more)
    state, inside = method.random_start(3.0), Inside(1.0, BOX[0])
    method = DpdStream(box=BOX, held=np.flatnonzero(inside(state[:3])), **more)
    return method, method.at_rest(state, 0.3), inside


@pytest.mark.parametrize("integrator", [VelocityVerlet, GrootWarren65])
@pytest.mark.parametrize("turns", [False, True])
def test_what_the_fluid_loses_the_body_gets(integrator, turns):
    """dP/dt = push - force to round-off but for the first and the last half-step, whose forces are in one sum only."""
    method, start, _ = body(push=0.5, integrator=integrator, turned=Inside(1.0, BOX[0]).turned if turns else None)
    plan = Plan(dt=0.01, steps=400, every=400, series={"force": force_on_body, "speed": speed})
    done = run(method, start, plan)
    n, d = start.shape[1], method.d
    gained = n*done.series["speed"][0] - start[d].sum()
    pushed = method.push*(n - len(method.held))*4.0
    # half a step of the forces of two moments: about 0.005 (m <F^2>)^(1/2), <F^2> = 200 a particle with its noise at this step
    assert abs(gained - pushed + 4.0*done.series["force"][0]) < 4*0.005*np.sqrt(2*len(method.held)*1000.0)
    assert (done.reflections > 0) == turns
    end = done.by_id()
    assert np.array_equal(end[:d, method.held], start[:d, method.held]) and not end[d:, method.held].any()


def test_what_turns_stays_outside():
    """None is deeper inside than it goes in a step at the most, 0.01 times five times the velocity of one kT."""
    method, start, inside = body(turned=Inside(1.0, BOX[0]).turned)
    done = run(method, start, Plan(dt=0.01, steps=600)).by_id()
    free = np.ones(start.shape[1], bool)
    free[method.held] = False
    assert np.sqrt((inside.place(done[:3, free])**2).sum(axis=0)).min() > 1 - 0.1


def test_offset_of_published_drags():
    """The drag at one fraction, taken for that of another cell of the same side, gives the radius back."""
    ratio = drag_of(0.3)[0]/drag_of(0.2)[0]
    assert offset(1.0, 0.2, 2.0) == pytest.approx(0, abs=1e-9)
    assert offset(ratio, 0.2, 2.0) == pytest.approx(2*(np.sqrt(1.5) - 1), rel=1e-6)
    # between the published fractions: the series for dilute arrays, good to 0.1 % up to 0.1
    assert offset(series(0.08)/drag_of(0.1)[0], 0.1, 1.0) == pytest.approx(np.sqrt(0.8) - 1, rel=0.02)
    assert np.isnan(offset(3.0, 0.2, 2.0))


@pytest.mark.parametrize("wrong, message", [
    ({"held": np.array([], int)}, "0 particles are to be held"), ({"held": np.array([1, 1])}, "2 particles are to be held, 1 of"),
    ({"push": np.nan}, "the push must be finite, got nan"),
    ({"integrator": Shardlow}, "Shardlow does not step with forces alone"),
    ({"integrator": TwoStep}, "TwoStep does not step with forces alone")])
def test_bad_bodies(wrong, message):
    with pytest.raises(ValueError, match=message):
        DpdStream(**{"box": BOX, "held": np.arange(3), **wrong})
