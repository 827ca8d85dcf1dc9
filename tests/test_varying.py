"""Viscosity that varies, in compiled sums: the force that edges alone lack, its order, what it keeps, what must not heat."""
import numpy as np
import pytest
from test_dih import exact_drag
from test_layer import MADE, layer, shaken

from continuum.fluid import ConstEta, ConstNu, IdealGas, PowerLaw, constant_viscosity
from particles.integral.dih import Dih
from particles.integral.edge_makers import renormalised
from particles.integral.edges import NONE_BEYOND
from particles.integral.layer import Layer, edge_by_edge
from particles.integral.points import jittered, lattice
from particles.integral.triangulation import delaunay
from particles.smooth.spam import Spam
from particles.smooth.sums import Direct
from particles.threads import Team
from particles.walls.periodic import periodic
from particles.weights import Lucy, WendlandC2

SETS = {"lattice": lambda n: (at := lattice((n, n)), renormalised(at, WendlandC2.of(h=2.7))),
        "jittered": lambda n: (at := jittered((n, n), 0.25, 2), delaunay(at))}
LAWS = pytest.mark.parametrize("law", [ConstNu(0.3, 0.4), PowerLaw(0.3, 0.4, 0.0, 1.0)], ids=["const-nu", "power-law"])


def periodic_layer(at, edges, law):
    return Layer(x=at.x, edges=edges, beyond=NONE_BEYOND, eos=IdealGas(), law=law, T_plates=(1.0, 1.0), g=0.0)


def rates(fluid, state):
    out = np.empty_like(state)
    fluid.start(state.shape[1], Team(1)).rates(state, out)
    return out


def friction(at, edges, law, state):
    """What viscosity and conduction alone do, (4, n)."""
    return rates(periodic_layer(at, edges, law), state) - rates(periodic_layer(at, edges, ConstEta(0.0, 0.0)), state)


@LAWS
@pytest.mark.parametrize("kind", SETS)
def test_compiled_sums_are_those_of_the_mended_form(kind, law):
    at, edges = SETS[kind](12)
    fluid, slow = periodic_layer(at, edges, law), np.empty((4, at.n))
    state = shaken(fluid, at.x)
    Dih(edges=edges, eos=IdealGas(), law=law).rates(state, slow)
    fast = rates(fluid, state)
    for one, other in zip(fast, slow, strict=True):
        assert np.abs(one - other).max() < 1e-12*np.abs(other).max()


def test_viscosity_that_depends_on_temperature_drags_as_the_equations_say():
    """div of the stress with eta proportional to T^1/2 over waves of T and v: second order; edges alone: per cents."""
    errors = []
    for n in (24, 48):
        at, edges = SETS["lattice"](n)
        k = 2*np.pi/n
        x, y = k*at.x.T
        v = 1e-3*np.stack([np.sin(y)*np.cos(x), np.sin(x + y)], axis=1)
        law = PowerLaw(0.3, 0.0)
        found = friction(at, edges, law, periodic_layer(at, edges, law).state(np.ones(at.n), v, 1 + 0.2*np.cos(y)))[1:3]
        errors.append(np.abs(found - exact_drag(x, y, k, 0.0)).max()/np.abs(found).max())
    assert errors[0]/errors[1] == pytest.approx(4, rel=0.1) and errors[1] < 0.05


@LAWS
@pytest.mark.parametrize("kind", SETS)
def test_mass_momentum_and_energy_stay(kind, law):
    at, edges = SETS[kind](12)
    fluid = periodic_layer(at, edges, law)
    found = rates(fluid, shaken(fluid, at.x))
    assert np.all(np.abs(found@edges.V) < 1e-13*(np.abs(found)@edges.V))


def test_rigid_rotation_is_neither_pushed_nor_heated():
    """In the middle of a patch with eta proportional to a temperature that is linear there: exact on a lattice."""
    at, edges = SETS["lattice"](24)
    omega, (x, y), law = 0.05, at.x.T, PowerLaw(0.3, 0.0, 0.0, 1.0)
    v = omega*np.stack([-y, x], axis=1)
    _, px, py, eps = friction(at, edges, law, periodic_layer(at, edges, law).state(np.ones(at.n), v, 1 + 0.01*(x + 2*y)))
    middle = np.hypot(x, y) < 4
    for found, unit in ((px, 0.3*0.01*omega), (py, 0.3*0.01*omega), (eps - v[:, 0]*px - v[:, 1]*py, 0.3*omega**2)):
        assert np.abs(found[middle]).max() < 1e-11*unit         # of differences of rates a thousand times as large


@pytest.mark.parametrize(("make", "size", "h"), MADE)
def test_friction_between_plates_is_symmetric_and_only_damps(make, size, h):
    """Forces at rest are -K v with eta(T) of random temperatures: K is symmetric and has no negative eigenvalue."""
    fluid, x, where = layer(make, size, h=h, rows=8, transport=PowerLaw)
    n, small, T = len(x), 1e-6, np.random.default_rng(0).uniform(0.7, 1.3, len(x))
    K = np.empty((2*n, 2*n))
    quiet = Layer(**{**vars(fluid), "law": ConstEta(0.0, 0.0), "form": edge_by_edge})
    for column in range(2*n):
        v = np.zeros((n, 2))
        v[column % n, column // n] = small
        state = fluid.state(1.0, v, T)
        K[:, column] = ((rates(fluid, state) - rates(quiet, state))*fluid.edges.V)[1:3].ravel()/small
    size = np.abs(K).max()
    assert np.abs(K - K.T).max() < 1e-8*size           # round-off over 1e-6
    assert np.linalg.eigvalsh(K + K.T).max() < 1e-8*size
    assert not constant_viscosity(where.law)


def test_friction_along_pairs_of_smooth_particles_refuses_a_viscosity_that_varies():
    with pytest.raises(ValueError, match=r"lacks a part of the stress where viscosity varies, as by ConstNu\(.*take Nested"):
        Spam(weight=Lucy.of(h=3.0), eos=IdealGas(), law=ConstNu(0.3, 0.2), walls=periodic(9), box=(9, 9), transport=Direct)
