"""Integral hydrodynamics on fixed points: conservation, invariance, operators, heating."""
import numpy as np
import pytest
from crowd import random_fields, rates

from continuum.fluid import ConstEta, ConstNu, IdealGas, PowerLaw, stress_tensor
from particles.integral.dih import Dih, NestedFluxes, Pairwise
from particles.integral.edge_makers import MAKERS
from particles.integral.points import jittered, lattice
from particles.weights import WendlandC2
from studies.operators.equations import Spectral

COUNTS = {1: (16,), 2: (10, 9), 3: (6, 6, 7)}
TRANSPORT = {"nested": NestedFluxes(), "printed": NestedFluxes(differences=False), "pairwise": Pairwise(),
             "unmended": Pairwise(mended=False)}


def fluid(maker="renormalised", d=2, size=0.2, transport="pairwise", counts=None, **more):
    counts = counts or COUNTS[d]
    at = jittered(counts, size, 3) if size else lattice(counts)
    edges = MAKERS[maker](at, WendlandC2.of(h=2.7 if d < 3 else 2.2, d=d))
    settings = {"eos": IdealGas(), "law": ConstEta(0.3, 0.4), **more}
    return Dih(edges=edges, transport=TRANSPORT[transport], **settings), at


@pytest.mark.parametrize("transport", TRANSPORT)
@pytest.mark.parametrize("d", [1, 2, 3])
@pytest.mark.parametrize("maker", ["printed", "plain", "renormalised", "closed", "exact"])
def test_mass_momentum_and_energy_are_conserved(maker, d, transport):
    dih, at = fluid(maker, d, transport=transport, zeta=0.1)
    found = rates(dih, dih.state(*random_fields(at.n, at.d)))
    assert np.all(np.abs(found@dih.edges.V) < 1e-13*np.abs(found)@dih.edges.V)


@pytest.mark.parametrize("transport", TRANSPORT)
@pytest.mark.parametrize("maker", ["closed", "exact", "delaunay"])
def test_a_uniform_wind_changes_nothing_but_what_it_carries(maker, transport):
    """Galilean invariance: in a wind U rates are those at rest, transformed, and -U.grad of the state."""
    dih, at = fluid(maker, transport=transport, law=ConstNu(0.2, 0.3))
    still, wind = dih.state(*random_fields(at.n, at.d)), np.array([0.3, -0.2])
    rho, p, eps = still[0], still[1:3], still[3]
    moved = np.stack([rho, *(p + rho*wind[:, None]), eps + wind@p + rho*(wind@wind)/2])
    a, b = rates(dih, still), rates(dih, moved)
    expected = np.stack([a[0], *(a[1:3] + a[0]*wind[:, None]), a[3] + wind@a[1:3] + a[0]*(wind@wind)/2])
    carried = np.stack([-sum(u*(D@q)/dih.edges.V for u, D in zip(wind, dih.edges.D, strict=True))
                        for q in moved])
    np.testing.assert_allclose(b, expected + carried, atol=1e-12*np.abs(b).max())


@pytest.mark.parametrize(("transport", "zeta"), [("nested", 0.0), ("nested", 0.1), ("pairwise", 0.0)])
def test_a_viscosity_that_varies_drags_as_the_equations_say(transport, zeta):
    """To second order, eta proportional to T^1/2, over waves of T and v.

    Forces along edges alone miss (d_a eta) d_b v_a: a few per cent, however fine the points. Their bulk
    viscosity depends on the direction on a lattice, so that zeta is 0 here.
    """
    errors = []
    for n in (24, 48):
        dih, at = fluid(size=0, transport=transport, counts=(n, n), law=PowerLaw(0.3, 0.0), zeta=zeta)
        x, y = 2*np.pi/n*at.x.T
        T = 1 + 0.2*np.cos(y)
        v = 1e-3*np.stack([np.sin(y)*np.cos(x), np.sin(x + y)], axis=1)
        quiet = Dih(edges=dih.edges, eos=dih.eos, law=ConstEta(0.0, 0.0))
        state = dih.state(np.ones(at.n), v, T)
        drag = (rates(dih, state) - rates(quiet, state))[1:3].T
        exact = Spectral((n, n))        # in the unit box
        due = exact.div(stress_tensor(0.3*np.sqrt(T), zeta, exact.grad(v)))/n**2
        errors.append(np.abs(drag - due).max()/np.abs(drag).max())
    assert errors[0]/errors[1] == pytest.approx(4, rel=0.1) and errors[1] < 0.05


def heating(flow, transport):
    """Heat per volume in the middle of a patch on a lattice whose velocities are (n, 2) x@flow."""
    dih, at = fluid(size=0, transport=transport, counts=(24, 24))
    v = at.x@np.array(flow)
    mass, *force, power = rates(dih, dih.state(np.ones(at.n), v, np.ones(at.n)))
    internal = power - (v.T*force).sum(axis=0) + mass*(v**2).sum(axis=1)/2
    return internal[np.hypot(*at.x.T) < 4]


def test_rigid_rotation_heats_only_where_the_heating_is_not_mended():
    """Forces along edges heat by eta |grad v|^2 = 2 eta omega^2; with mended heating by nothing."""
    for transport, due in (("unmended", 2), ("pairwise", 0)):
        found = heating([[0.0, 0.05], [-0.05, 0.0]], transport)
        np.testing.assert_allclose(found/(0.3*0.05**2), due, atol=1e-6)


@pytest.mark.parametrize("transport", ["nested", "pairwise"])
def test_shear_heats_by_eta_times_its_square(transport):
    np.testing.assert_allclose(heating([[0.0, 0.0], [0.05, 0.0]], transport), 0.3*0.05**2, rtol=1e-9)


def test_bulk_viscosity_outside_of_the_pairwise_range_is_refused():
    for d, zeta in ((2, 0.61), (2, -0.01), (3, 0.51)):
        dih, at = fluid(d=d, zeta=zeta)
        with pytest.raises(ValueError, match="take nested transport"):
            rates(dih, dih.state(*random_fields(at.n, at.d)))
