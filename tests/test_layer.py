"""Integral hydrodynamics between plates: its twin, what plates let through, damping, limits of steps."""
from dataclasses import replace

import numpy as np
import pytest
from crowd import alike, jacobian, prepare, random_fields, rates

from continuum.fluid import ConstEta, ConstNu, IdealGas, PowerLaw, VanDerWaals
from continuum.scene import RayleighBenard
from particles.integral.dih import Dih, Mixed, NestedFluxes, Pairwise
from particles.integral.edge_makers import exact, renormalised
from particles.integral.edges import between_plates
from particles.integral.exchange import PRINTED
from particles.integral.layer import Layer, LayerSums, LinearSums
from particles.integral.nested import mixed
from particles.integral.points import jittered, lattice
from particles.integral.transposed_stress import MENDED
from particles.integral.triangulation import delaunay
from particles.threads import Threads
from particles.weights import Lucy

ROWS = 10


def layer(make=renormalised, size=0.0, h=2.0, rows=ROWS, **scene):
    """A layer, its points and its scene."""
    where = RayleighBenard(L=float(rows), **{"ra": 1e4, **scene})
    x = lattice((2*rows, rows)).x
    if size:
        x = np.clip(jittered((2*rows, rows), size, 1).x, -where.L + 0.25, where.L - 0.25)
        x[:, 1] = np.clip(x[:, 1], -where.L/2 + 0.25, where.L/2 - 0.25)
    return at(x, where, make, h), x, where


def at(x, where, make=renormalised, h=2.0):
    """Points x between the plates of a scene."""
    inner, beyond = between_plates(make, x, where.width, where.L, Lucy.of(h=h))
    return Layer(x=x, edges=inner, beyond=beyond, eos=where.eos, law=where.law,
                 T_plates=(where.T_hot, where.T_cold), g=where.g, transport=MENDED)


MADE = [(renormalised, 0.0, 2.0), (exact, 0.2, 2.8), (delaunay, 0.2, 2.0)]
TRANSPORT = {"pairwise": (MENDED, Pairwise()), "unmended": (PRINTED, Pairwise(mended=False)),
             "nested": (mixed(0.0), NestedFluxes()), "mixed": (mixed(0.3), Mixed(share=0.3))}

fluids = pytest.mark.parametrize(("transport", "law", "eos"), [
    ("pairwise", ConstEta, IdealGas()), ("pairwise", ConstEta, VanDerWaals()),
    ("pairwise", ConstNu, IdealGas()), ("pairwise", PowerLaw, VanDerWaals()),
    ("unmended", ConstEta, VanDerWaals()), ("unmended", ConstNu, IdealGas()),
    ("nested", ConstEta, IdealGas()), ("nested", ConstEta, VanDerWaals()), ("mixed", ConstEta, IdealGas())])
made = pytest.mark.parametrize(("make", "size", "h"), MADE)


@fluids
@made
def test_compiled_sums_are_those_of_the_slow_twin_where_no_plate_is_seen(make, size, h, transport, law, eos):
    """Points at least two edges from images, under gravity; `test_drift` has a twin of those near plates."""
    terms, slow = TRANSPORT[transport]
    fluid, x, _ = layer(make, size, h=h, rows=16, eos=eos, transport=law)
    fluid = replace(fluid, transport=terms)
    state = fluid.state(*random_fields(len(x)))
    expected = rates(Dih(edges=fluid.edges, eos=eos, law=fluid.law, transport=slow), state)
    expected[2:] -= fluid.g*state[[0, 2]]
    seen = np.isin(np.arange(len(x)), fluid.beyond.i)
    for _ in range(2):
        seen |= fluid.edges.laplacian@(1.0*seen) != 0
    fast = rates(fluid, state)
    assert (~seen).sum() > 30
    alike(fast[:, ~seen], expected[:, ~seen])
    assert np.array_equal(fast, rates(fluid, state, threads=2))


@fluids
@made
def test_without_gravity_a_layer_gains_what_comes_through_its_plates(make, size, h, transport, law, eos):
    """No mass; energy as heat alone, for plates at rest do no work."""
    fluid, x, _ = layer(make, size, h=h, eos=eos, transport=law)
    fluid = replace(fluid, transport=TRANSPORT[transport][0], g=0.0)
    state = fluid.state(*random_fields(len(x)))
    (mass, _, _, power), (sums, *_) = rates(fluid, state)*fluid.edges.V, prepare(fluid, state)
    sums.look_at(state)
    heat = [sums.heat_through(plate) for plate in (0, 1)]
    assert heat[0] > 0 > heat[1] and abs(power.sum() - sum(heat)) < 1e-13*np.abs(power).sum()
    assert abs(mass.sum()) < 1e-14*np.abs(mass).sum()


@made
def test_sums_of_products_are_those_edge_by_edge(make, size, h):
    """Under gravity, between plates that are not equally warm; constant viscosity takes sums of products."""
    fluid, x, _ = layer(make, size, h=h)
    assert type(fluid.start(len(x), Threads(1))) is LinearSums
    state = fluid.state(*random_fields(len(x)))
    alike(rates(fluid, state), rates(replace(fluid, form=LayerSums), state))


@pytest.mark.parametrize("transport", TRANSPORT)
def test_the_motionless_state_stays_to_round_off(transport):
    """A linear T at density 1 is steady on a lattice, too, because images continue it."""
    fluid, x, scene = layer()
    fluid = replace(fluid, transport=TRANSPORT[transport][0])
    found = rates(fluid, fluid.state(np.ones(len(x)), 0*x, scene.T(x[:, 1])))
    assert np.abs(found).max() < 1e-14        # sums of 12 pressures of 1.5: measured 8e-16


@pytest.mark.parametrize(("law", "transport"), [
    (ConstEta, mixed(0.0, mended=False)), (ConstEta, mixed(1.0, mended=False)), (PowerLaw, MENDED)],
    ids=["nested", "along edges", "varying"])
@made
def test_friction_and_conduction_between_plates_are_symmetric_and_only_damp(make, size, h, law, transport):
    """Forces at rest are -K v, heating at constant k is -C T: K and C are symmetric and not negative.

    They are linear in the share of transport along edges: its ends are enough.
    """
    fluid, x, _ = layer(make, size, h=h, rows=8, transport=law)
    fluid = replace(fluid, T_plates=(1.0, 1.0), g=0.0, transport=transport)
    T, still = np.random.default_rng(0).uniform(0.7, 1.3, len(x)), np.zeros((2, len(x)))
    only_damps(lambda v: friction(fluid, v, T)[:2], still)
    if law is ConstEta:
        only_damps(lambda T: friction(fluid, still, T)[2], np.ones(len(x)))


def friction(fluid, v, T):
    """Momentum and energy gained, less what they are without friction."""
    state, quiet = fluid.state(1.0, v.T, T), replace(fluid, law=type(fluid.law)(0.0, 0.0), form=LayerSums)
    return ((rates(fluid, state) - rates(quiet, state))*fluid.edges.V)[1:]


def only_damps(f, x: np.ndarray) -> None:
    """The matrix of f, by differences over 1e-6, is symmetric and has no positive eigenvalue."""
    K = jacobian(f, x, 1e-6)
    size = np.abs(K).max()
    assert np.abs(K - K.T).max() < 1e-8*size
    assert np.linalg.eigvalsh(K + K.T).max() < 1e-8*size


def at_rest(fluid, x, eta, k):
    """The same between plates of one temperature, without gravity; density and temperature 1."""
    quiet = replace(fluid, law=type(fluid.law)(eta, k), T_plates=(1.0, 1.0), g=0.0)
    return quiet, quiet.state(np.ones(len(x)), 0*x, np.ones(len(x)))


def eigenvalues(quiet, rest):
    """Eigenvalues of the rates linearised about rest."""
    return np.linalg.eigvals(jacobian(lambda state: rates(quiet, state), rest, 1e-6))


def test_sound_between_adjoint_walls_does_not_grow():
    """No eigenvalue of the linearised rates has a positive real part, without friction and gravity."""
    fluid, x, _ = layer(rows=8)
    # differences over 1e-6: 1e-10; defective zeros of modes at rest spread as its square root
    assert eigenvalues(*at_rest(fluid, x, 0.0, 0.0)).real.max() < 1e-4


@pytest.mark.parametrize(("eta", "k"), [(0.0, 0.0), (2.0, 0.02), (0.02, 2.0)])
def test_a_point_near_its_own_image_limits_the_step(eta, k):
    """The fastest rate of the linearised layer, sound or diffusion, sets the limit of the step, to 0.1 %."""
    _, x, where = layer(rows=8)
    x[0, 1] = -where.L/2 + 0.15                 # 0.3 spacings from its image, 1 from the next point
    quiet, rest = at_rest(at(x, where, delaunay), x, eta, k)
    sound, spread = quiet.fastest
    assert spread > 1.3*quiet.edges.fastest[1]
    foretold = max(np.sqrt(2)*sound, max(eta, k)*spread)
    # damped sound is slower by 1e-3
    assert foretold == pytest.approx(np.abs(eigenvalues(quiet, rest)).max(), rel=1e-3)
