"""What Verlet's rule does to kT: sums against differences of the plain force, one frequency exactly, committed verdicts."""
import numpy as np
import pytest

from particles.dissipative import shadow_hamiltonian as shadow
from particles.dissipative.dpd import Dpd
from particles.run import Run
from particles.threads import Team
from tests import plain_dpd


@pytest.fixture(scope="module")
def fluid():
    """The sums of a small fluid, its state, forces at rest without noise (3, n) as a function of places or of velocities."""
    method = Dpd(box=(3.0, 3.0, 3.0), kT=0.0)
    state = method.random_start(1.0)
    sums = method.start(state.shape[1], Team(1))
    sums.resume(Run(state=state, ids=np.arange(state.shape[1])))

    def force(x, v):
        return plain_dpd.forces(method, x, v, 1.0, 0)

    return sums, state, force


def matrix(of, at, step):
    """Second-order differences: minus the derivatives of a force (3 n, 3 n)."""
    columns = []
    for k in range(at.size):
        by = np.zeros(at.size)
        by[k] = step
        columns.append(-(of(at + by.reshape(at.shape)) - of(at - by.reshape(at.shape))).ravel()/(2*step))
    return np.array(columns).T


def test_sums_are_those_of_the_derivatives_of_the_plain_force(fluid):
    """K from differences over 1e-6, whose error is 1e-10 of forces of 100; no pair is that near to rc. G is linear: exact."""
    sums, state, force = fluid
    x, n = state[:3], state.shape[1]
    F = force(x, 0*x)
    K, G = matrix(lambda at: force(at, 0*x), x, 1e-6), matrix(lambda v: force(x, v), 0*x, 1.0)
    r = np.sqrt((plain_dpd.apart(x, np.array(sums.method.box))[0]**2).sum(axis=0))
    assert np.abs(r - 1).min() > 1e-5

    def of(quantity):
        sums.look_at(state)
        return n*quantity(sums, state)

    assert of(shadow.forces_squared) == pytest.approx((F**2).sum(), rel=1e-12)
    assert of(shadow.laplacian) == pytest.approx(np.trace(K), rel=1e-7)
    assert of(shadow.forces_curved) == pytest.approx(F.ravel()@K@F.ravel(), rel=1e-7)
    assert of(shadow.friction) == pytest.approx(np.trace(G), rel=1e-12)
    assert of(shadow.friction_curved) == pytest.approx(np.trace(K@G), rel=1e-7)


def test_one_frequency_has_the_second_order_of_verlets_rule():
    """omega^2 dt^2/4 for places, 0 for velocities: x^2 of velocity-Verlet is larger by 1/(1 - omega^2 dt^2/4).

    Three directions, n = 1, 2e5 records: relative errors of the covariance some (2/2e5)^(1/2) = 0.3 %.
    """
    omega2, kT = 40.0, 1.3
    x = np.random.default_rng(1).normal(0, np.sqrt(kT/omega2), (200_000, 3))
    F2, ones = omega2**2*(x**2).sum(axis=1), np.ones(len(x))
    found = shadow.second_order(1, kT, F2, 3*omega2*ones, omega2*F2, 3*omega2*ones, 3*ones)
    assert found.kinetic == pytest.approx(0, abs=1e-12)
    assert found.configurational == pytest.approx(omega2/4, rel=0.01)
