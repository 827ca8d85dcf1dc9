"""Dissipative particles: double sums, momentum, threads, restarts, temperatures."""
import itertools

import numpy as np
import pytest
from crowd import goes_on_bitwise

from particles.dissipative.dpd import Dpd, configurational_temperature, forces_squared, laplacian
from particles.dissipative.integrators import KickDriftFrictionDriftKick, Shardlow
from particles.integrators import TwoStep
from particles.run import Plan, Run, run
from particles.threads import Threads
from studies.noise.cases import GOOD
from studies.noise.dissipative import AtRest, neighbours, special

INTEGRATORS = (TwoStep, *GOOD)
BOXES = ((5.0, 4.0), (3.5, 3.0, 4.0))


def sums_of(method, state):
    """The pair sums as a run has them at its first step, particles in the order in which they are given."""
    sums = method.start(state.shape[1], Threads(1))
    sums.resume(Run(state=state, ids=np.arange(state.shape[1])))
    sums.dt = 0.02
    return sums


def forces(method, state):
    d, out = method.d, np.empty_like(state[:method.d])
    sums_of(method, state).forces(state[:d], state[d:2*d], out)
    return out


@pytest.mark.parametrize("d", [2, 3])
def test_forces_equal_those_of_double_sums(d):
    """To round-off of a sum of some ten forces."""
    assert special(d) < 1e-14


def momentum(sums, state):
    """Size of the mean velocity."""
    d = sums.places
    return float(np.abs(state[d:2*d].mean(axis=1)).max())


@pytest.mark.parametrize("integrator, box", [*itertools.product(INTEGRATORS, BOXES)])
def test_momentum_is_conserved(integrator, box):
    """Drift per particle over 200 steps: round-off."""
    method = Dpd(box=box, integrator=integrator)
    done = run(method, method.random_start(3.0),
               Plan(dt=0.02, steps=200, every=20, series={"momentum": momentum}))
    assert max(done.series["momentum"]) < 1e-14


@pytest.mark.parametrize("integrator", INTEGRATORS)
def test_threads_and_restarts_do_not_matter(integrator, tmp_path):
    """Bitwise; the run is stopped between two lists, two of the orders of cells lie behind it."""
    method = Dpd(box=(4.0, 4.0, 4.0), integrator=integrator)
    goes_on_bitwise(method, method.random_start(3.0), 0.02, tmp_path)


@pytest.mark.parametrize("box", BOXES)
def test_numbers_of_particles_decide_the_noise_and_their_order_does_not(box):
    method = Dpd(box=box)
    state = method.random_start(3.0)
    turn = np.random.default_rng(1).permutation(state.shape[1])
    sums = sums_of(method, state[:, turn].copy())
    sums.now.ids = turn
    out, d = np.empty_like(state[:method.d]), method.d
    sums.forces(state[:d, turn].copy(), state[d:2*d, turn].copy(), out)
    assert np.abs(out - forces(method, state)[:, turn]).max() < 1e-11       # the order of the sum is another


@pytest.mark.parametrize("integrator", [Shardlow, KickDriftFrictionDriftKick])
def test_temperatures_agree_at_rest_and_pressure_is_that_of_print(integrator):
    """At 648 particles and 300 records: 5 sigma of the scatter; the study has the numbers."""
    row, = AtRest(integrator=integrator, side=6.0, time=30.0).measure(print)
    assert (row["kinetic"], row["configurational"]) == pytest.approx((1, 1), abs=0.03)
    assert row["P"] == pytest.approx(23.64, abs=0.15)


def test_configurational_temperature_is_the_laplacian():
    """Against second differences of the double sum."""
    method = Dpd(box=BOXES[1], gamma=0.0, kT=0.0)
    state = method.random_start(1.0)
    sums, x, step = sums_of(method, state), state[:3], 1e-6

    def force(x):
        w, e = neighbours(x, method.box)
        return method.a*(w*e).sum(axis=2)

    trace = 0.0
    for axis, i in itertools.product(range(3), range(x.shape[1])):
        moved = np.zeros_like(x)
        moved[axis, i] = step
        trace -= (force(x + moved)[axis, i] - force(x - moved)[axis, i])/(2*step)
    squared = (force(x)**2).sum()
    # of differences: the ranges that end within a step; else (1e-6)^2 and 1e-16/1e-6
    assert configurational_temperature(sums, state) == pytest.approx(squared/trace, rel=1e-5)
    assert laplacian(sums, state)*sums.n == pytest.approx(trace, rel=1e-5)
    assert forces_squared(sums, state)*sums.n == pytest.approx(squared, rel=1e-12)


def test_without_friction_kicks_and_drifts_can_be_taken_back():
    method = Dpd(box=(6.0, 6.0, 6.0), integrator=KickDriftFrictionDriftKick, gamma=0.0, kT=0.0)
    start = Dpd(box=(6.0, 6.0, 6.0)).random_start(3.0)
    there = run(method, start, Plan(dt=0.01, steps=40)).by_id()
    there[3:6] *= -1
    back = run(method, there, Plan(dt=0.01, steps=40)).by_id()
    apart = back[:3] - start[:3]
    # round-off, which neighbours amplify some thousandfold
    assert np.abs(apart - 6*np.round(apart/6)).max() < 1e-10
    assert np.abs(back[3:6] + start[3:6]).max() < 1e-10
    assert np.abs(there[:3] - start[:3]).max() > 0.1


@pytest.mark.parametrize("wrong, message", [
    ({"kT": -1.0}, "kT must be zero or positive, got -1.0"),
    ({"gamma": -4.5}, "gamma must be zero or positive, got -4.5"),
    ({"a": np.nan}, "a must be zero or positive, got nan"),
    ({"skin": -0.1}, "skin must be zero or positive"),
    ({"box": (10.0, 2.9, 10.0)}, "sides of at least 3"), ({"box": (10.0,)}, "two or three sides"),
    ({"seed": -1}, "the seed must be a whole number")])
def test_bad_fluids(wrong, message):
    with pytest.raises(ValueError, match=message):
        Dpd(**{"box": (4.0, 4.0, 4.0), **wrong})
    with pytest.raises(ValueError, match=r"rho = 0\.001 makes no two particles"):
        Dpd(box=(4.0, 4.0, 4.0)).random_start(1e-3)


def test_a_step_beyond_the_stability_limit():
    method = Dpd(box=(4.0, 4.0, 4.0))
    with pytest.raises(ValueError,
                       match=r"dt = 0\.15 is above the stability limit 0\.138"):
        run(method, method.random_start(3.0), Plan(dt=0.15, steps=1))


def test_collapsed_particles_are_an_error():
    method = Dpd(box=(30.0, 30.0, 30.0))
    state = method.random_start(0.1)
    state[:3] *= 1e-3
    with pytest.raises(FloatingPointError,
                       match=r"neighbours within 1\.3 of each particle: they have collapsed"):
        run(method, state, Plan(dt=0.02, steps=1))
