"""What is measured on particles, against sums written out, states with known answers, a smoothed grid."""
import numpy as np
import pytest
from crowd import prepare

from continuum.gas.fields import initial
from continuum.scene import RayleighBenard
from particles.observe import PlateHeat, field_kinetic, fields_at
from particles.weights import Lucy, value_and_slope
from studies.build import spam
from studies.build.measure import Smoothing, smoothed_energy
from studies.build.spam import VARIANTS
from tests.scenes import small


@pytest.fixture(scope="module")
def measured():
    """(sums, state) with densities and gradients of the start."""
    sums, state, _ = prepare(*small())
    sums.densities(state)
    sums.gradients()
    return sums, state


def test_fields_are_the_sums_of_the_paper(measured):
    sums, state = measured
    x, y = np.array([0.3, -7.9, 4.0]), np.array([0.1, -3.9, 3.99])
    around, found = sums.around, fields_at(sums, state, x, y)
    for k in range(3):
        r = np.hypot(around.x - x[k], around.y - y[k])
        w = np.array([value_and_slope(sums.method.weight, d)[0] for d in r])
        rho = w.sum()
        expected = (rho, w@around.vx/rho, w@around.vy/rho)
        # sums of some 30 terms in another order
        np.testing.assert_allclose([found.rho[k], found.vx[k], found.vy[k]], expected, rtol=1e-13, atol=1e-15)


@pytest.mark.parametrize("name", ["printed", "printed-fixed-rows", "walls-odd-own-pressure", "direct"])
def test_plates_give_all_the_energy_that_the_fluid_gains(name):
    """Between particles energy is conserved: kinetic, internal, m g y change by what the plates exchange."""
    method, state = small(VARIANTS[name], rows=12)
    sums, state, _ = prepare(method, state)
    rates = np.empty_like(state)
    sums.rates(state, rates)
    gained = state[2]*rates[2] + state[3]*rates[3] + rates[4] + method.g*rates[1]
    sums.densities(state)
    sums.gradients()
    lower, upper = (PlateHeat(side, pressure=True)(sums, state)*method.box[0] for side in (-1, 1))
    assert min(abs(lower), abs(upper)) > 1e-3*np.abs(gained).sum()
    # 288 energies and some 300 pairs a plate, summed in another order
    assert lower + upper == pytest.approx(gained.sum(), abs=1e-13*np.abs(gained).sum())


def test_particles_on_a_lattice_see_the_same():
    """Rolls given to particles and to a grid: what smoothing leaves of K agrees to the lattice's sum rule."""
    scene, energy = RayleighBenard(ra=1e4, L=24.0), 0.0018
    state = spam.start(scene, 1)
    x, y = np.meshgrid(np.arange(48) + 0.5 - 24, np.arange(24) + 0.5 - 12)
    state[:2] = x.ravel(), y.ravel()
    state[2:4] = scene.flow(*state[:2], energy)
    sums, state, _ = prepare(spam.method(scene, spam.PRINTED), state)
    sums.densities(state)
    plain, smooth = smoothed_energy(initial(scene, 48, energy), Smoothing(Lucy, 3.0, 24))
    assert plain == pytest.approx(energy, rel=1e-3)     # splines over 48 rows
    seen = field_kinetic(sums, state)
    # sums over a lattice of spacing h/3 stand for integrals to 1 % of what smoothing takes
    assert 1 - seen/energy == pytest.approx(1 - smooth/plain, rel=0.01)
