"""SPAM in time: order of the steps, isomorphism with molecular dynamics."""
from itertools import pairwise
from typing import NamedTuple

import numpy as np
import plain
import pytest
from crowd import advance, crowd, everywhere, lattice, total_energy

from continuum.fluid import ConstEta, IdealGas, energy, pressure, temperature
from particles.smooth.spam import Spam
from particles.weights import Lucy, Monaghan, WendlandC2

BOX = (10.0, 10.0)
N = 100


def free(weight=Lucy, eos=IdealGas(), law=ConstEta(0.2, 0.2), **other) -> Spam:  # noqa: B008
    return Spam(weight=weight.of(h=3.0), eos=eos, law=law, walls=everywhere(BOX), box=BOX, **other)


def vortices() -> np.ndarray:
    """Four vortices on a shaken lattice; a wave of 10 % in the temperature."""
    k = 2*np.pi/BOX[0]
    x, y = r = lattice(BOX, 10, 10) + np.random.default_rng(0).uniform(-0.2, 0.2, (2, N))
    return np.array([*r, 0.5*np.sin(k*x)*np.cos(k*y), -0.5*np.cos(k*x)*np.sin(k*y), 1 + 0.1*np.cos(k*x)])


TIME, STEPS = 3.2, (64, 128, 256, 512)


@pytest.fixture(scope="module", params=[Lucy, Monaghan, WendlandC2])
def halved(request):
    """The method, the start and the states at one time, reached by ever shorter steps."""
    method, start = free(request.param), vortices()
    return method, start, [advance(method, start, TIME/steps, steps) for steps in STEPS]


def test_energy_drifts_with_the_fourth_power_of_the_step(halved):
    method, start, ends = halved
    drift = np.abs([total_energy(method, end) - total_energy(method, start) for end in ends])
    # RK4 damps each oscillation by (omega dt)^6/144 a step, a fifth power of dt in all, which the longest
    # steps still show beside the fourth. Smallest drift 4e-12, round-off of a sum of 100 energies 1e-13: 0.05
    # of the last order
    orders = np.log2(drift[:-1]/drift[1:])
    assert ((3.9 < orders) & (orders < 4.4)).all()
    assert abs(orders[-1] - 4) < 0.15


def test_paths_converge_as_the_weight_is_smooth(halved):
    method, _, ends = halved
    errors = [np.sqrt(np.mean((a[2:] - b[2:])**2)) for a, b in pairwise(ends)]
    order = np.log2(errors[0]/errors[-1])/(len(errors) - 1)
    # KHP95's weights have w''' that jumps at h (the B-spline's at h/2 too): each pair that crosses such a
    # distance costs dt^3 of a force with a kink in its slope, at a random place within the step. Hundreds of
    # crossings: 0.3. Wendland's w''' does not jump.
    expected, within = (4.0, 0.1) if isinstance(method.weight, WendlandC2) else (3.0, 0.3)
    assert abs(order - expected) < within


class Quadratic(NamedTuple):
    """P = rho^2, e = rho: 2 w(r) is then the potential of a pair. Its formulas must not change: compiled
    code is kept."""


pressure.of(Quadratic)(lambda eos, rho, e: rho*rho)
temperature.of(Quadratic)(lambda eos, rho, e: e)
energy.of(Quadratic)(lambda eos, rho, T: T)

NEWTON = free(eos=Quadratic(), law=ConstEta(0.0, 0.0))


def atoms():
    """A crowd with the energy that belongs to its density."""
    state = crowd(BOX, 10, 10, jitter=0.3)
    state[4] = potential(state)
    return state


def potential(state):
    """sum_j w(r_ij) of each particle, itself included."""
    return plain.rates(NEWTON, state).rho


def test_internal_energy_is_the_potential():
    end = advance(NEWTON, atoms(), 0.02, 200)
    # RK4's error of the path at this step, 2e-8, is eight times smaller at half of it; the sum of e and v^2/2
    # is the conserved energy of the atoms
    assert end[4] == pytest.approx(potential(end), abs=1e-7)
    assert total_energy(NEWTON, end) == pytest.approx(total_energy(NEWTON, atoms()), abs=1e-7)
