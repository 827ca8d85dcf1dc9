"""The grid's field seen through a weight, against sums over particles and a wave with a known answer."""
import numpy as np
import pytest
from crowd import prepare

from continuum.gas.fields import initial
from continuum.scene import RayleighBenard
from particles.observe import field_kinetic
from particles.weights import Lucy
from studies.build import spam
from studies.build.measure import Smoothing, smoothed_energy


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
