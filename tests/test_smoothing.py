"""The grid's field seen through a weight, against sums over particles and a wave with a known answer."""
import numpy as np
import pytest
from crowd import prepare
from scipy.special import j0

from continuum.gas.fields import NodeFields, Values, initial
from continuum.scene import RayleighBenard
from particles.observe import field_kinetic
from particles.weights import Lucy, value_and_slope
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


def test_a_shear_wave_shrinks_by_the_transform_of_the_weight():
    """vx = sin(k x') in the middle of a high box would shrink by w^(k); the plates' part is left to a thick
    margin."""
    scene = RayleighBenard(ra=1e4, L=1.0, aspect=2.0)
    base = initial(scene, 64, 0.0)
    k, rows = 2*np.pi, 12
    v = np.tile(np.sin(k*base.x), (len(base.y), 1))
    fields = NodeFields(scene, base.x, base.y, Values(0*v, v, base.at.e, base.at.T, np.ones_like(v)),
                        base.cells)
    plain, smooth = smoothed_energy(fields, Smoothing(Lucy, 3.0, rows))
    r, weight = (np.arange(4000) + 0.5)/4000*3, Lucy.of(h=3.0)
    transform = sum(value_and_slope(weight, s)[0]*j0(k*s/rows)*2*np.pi*s for s in r)*3/4000
    # <v> = w^ v in the middle; within a range of the plates images at rest take more
    share = 2*3/rows
    assert transform**2*(1 - share) < smooth/plain < transform**2
