"""SPAM in time: order of the steps."""
from itertools import pairwise

import numpy as np
import pytest
from crowd import advance, everywhere, lattice, total_energy

from continuum.fluid import ConstEta, IdealGas
from particles.smooth.spam import Spam
from particles.weights import Lucy, Monaghan, WendlandC2

BOX = (10.0, 10.0)
N = 100


def vortices() -> np.ndarray:
    """Four vortices on a shaken lattice; a wave of 10 % in the temperature."""
    k = 2*np.pi/BOX[0]
    x, y = r = lattice(BOX, 10, 10) + np.random.default_rng(0).uniform(-0.2, 0.2, (2, N))
    return np.array([*r, 0.5*np.sin(k*x)*np.cos(k*y), -0.5*np.cos(k*x)*np.sin(k*y), 1 + 0.1*np.cos(k*x)])


TIME, STEPS = 3.2, (64, 128, 256, 512)


@pytest.fixture(scope="module", params=[Lucy, Monaghan, WendlandC2])
def halved(request):
    """The method, the start and the states at one time, reached by ever shorter steps."""
    method, start = Spam(weight=request.param.of(h=3.0), eos=IdealGas(), law=ConstEta(0.2, 0.2),
                         walls=everywhere(BOX), box=BOX), vortices()
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
