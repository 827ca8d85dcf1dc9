"""Integral hydrodynamics on fixed points: conservation, invariance, operators, heating."""
import numpy as np
import pytest
from crowd import random_fields, rates

from continuum.fluid import ConstEta, ConstNu, IdealGas, PowerLaw, bulk_viscosity
from particles.integral.dih import Dih, NestedFluxes, Pairwise
from particles.integral.edge_makers import MAKERS
from particles.integral.points import jittered, lattice
from particles.weights import WendlandC2

COUNTS = {1: (16,), 2: (10, 9), 3: (6, 6, 7)}
TRANSPORT = {"nested": NestedFluxes(), "printed": NestedFluxes(differences=False), "pairwise": Pairwise(),
             "unmended": Pairwise(mended=False)}


def fluid(maker="renormalised", d=2, size=0.2, transport="pairwise", counts=None, h=2.7, **more):
    counts = counts or COUNTS[d]
    at = jittered(counts, size, 3) if size else lattice(counts)
    edges = MAKERS[maker](at, WendlandC2.of(h=h if d < 3 else 2.2, d=d))
    settings = {"eos": IdealGas(), "law": ConstEta(0.3, 0.4), **more}
    return Dih(edges=edges, transport=TRANSPORT[transport], **settings), at


@pytest.mark.parametrize("transport", TRANSPORT)
@pytest.mark.parametrize("d", [1, 2, 3])
@pytest.mark.parametrize("maker", ["printed", "plain", "renormalised", "closed", "exact"])
def test_mass_momentum_and_energy_are_conserved(maker, d, transport):
    zeta = {"zeta": 0.1}
    dih, at = fluid(maker, d, transport=transport, **zeta)
    found = rates(dih, dih.state(*random_fields(at.n, at.d)))
    lost, size = dih.conserved(found), np.abs(found)@dih.edges.V
    assert np.all(np.abs(lost) < 1e-13*size)


@pytest.mark.parametrize("transport", TRANSPORT)
@pytest.mark.parametrize("maker", ["closed", "exact", "delaunay"])
def test_a_uniform_wind_changes_nothing_but_what_it_carries(maker, transport):
    """Galilean invariance: rates at rest, transformed, with -U.grad of the state; all parts of a stress."""
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
    """div of the stress with eta proportional to T^1/2 over a wave of T and waves of v across and along it:
    second order.

    Forces along edges alone miss (d_a eta) d_b v_a: a few per cent, however fine the points. (Their bulk
    viscosity depends on the direction on a lattice, whatever eta.)
    """
    errors = []
    for n in (24, 48):
        dih, at = fluid(size=0, transport=transport, counts=(n, n), law=PowerLaw(0.3, 0.0), zeta=zeta, h=2.7)
        k = 2*np.pi/n
        x, y = k*at.x.T
        T = 1 + 0.2*np.cos(y)
        v = 1e-3*np.stack([np.sin(y)*np.cos(x), np.sin(x + y)], axis=1)
        quiet = Dih(edges=dih.edges, eos=dih.eos, law=ConstEta(0.0, 0.0))
        state = dih.state(np.ones(at.n), v, T)
        found = (rates(dih, state) - rates(quiet, state))[1:3]
        errors.append(np.abs(found - exact_drag(x, y, k, zeta)).max()/np.abs(found).max())
    assert errors[0]/errors[1] == pytest.approx(4, rel=0.1) and errors[1] < 0.05


def exact_drag(x, y, k, zeta):
    """The divergence by differences of the analytic stress, over 1e-4 of the wave number's unit."""
    def stress(x, y):
        eta = 0.3*np.sqrt(1 + 0.2*np.cos(y))
        ux, uy = -1e-3*k*np.sin(y)*np.sin(x), 1e-3*k*np.cos(y)*np.cos(x)
        vx = vy = 1e-3*k*np.cos(x + y)
        bulk = bulk_viscosity(zeta, 1.0, 1 + 0.2*np.cos(y)) - eta
        return 2*eta*ux + bulk*(ux + vy), eta*(uy + vx), 2*eta*vy + bulk*(ux + vy)
    h = 1e-4
    by_x = [(a - b)*k/(2*h) for a, b in zip(stress(x + h, y), stress(x - h, y), strict=True)]
    by_y = [(a - b)*k/(2*h) for a, b in zip(stress(x, y + h), stress(x, y - h), strict=True)]
    return np.stack([by_x[0] + by_y[1], by_x[1] + by_y[2]])


def test_rigid_rotation_heats_only_where_the_heating_is_not_mended():
    """In the middle of a patch that rotates: eta |grad v|^2 = 2 eta omega^2 without F, nothing with it."""
    heating = {}
    for transport in ("pairwise", "unmended"):
        dih, at = fluid(size=0, transport=transport, counts=(24, 24), eos=IdealGas())
        omega, (x, y) = 0.05, at.x.T
        v = omega*np.stack([-y, x], axis=1)
        rho, T = np.ones(at.n), np.ones(at.n)
        found = rates(dih, dih.state(rho, v, T))
        middle = np.hypot(x, y) < 4
        internal = found[3] - (v*found[1:3].T).sum(axis=1) + found[0]*(v**2).sum(axis=1)/2
        heating[transport] = internal[middle]/(0.3*omega**2)
    np.testing.assert_allclose(heating["unmended"], 2, atol=1e-6)
    np.testing.assert_allclose(heating["pairwise"], 0, atol=1e-6)


@pytest.mark.parametrize("transport", ["nested", "pairwise"])
def test_shear_heats_by_eta_times_its_square(transport):
    dih, at = fluid(size=0, transport=transport, counts=(24, 24))
    v = np.stack([0.05*at.x[:, 1], 0*at.x[:, 1]], axis=1)
    found = rates(dih, dih.state(np.ones(at.n), v, np.ones(at.n)))
    middle = np.hypot(*at.x.T) < 4
    internal = found[3] - (v*found[1:3].T).sum(axis=1) + found[0]*(v**2).sum(axis=1)/2
    np.testing.assert_allclose(internal[middle], 0.3*0.05**2, rtol=1e-9)


def test_bulk_viscosity_outside_of_the_pairwise_range_is_refused():
    for d, zeta in ((2, 0.61), (2, -0.01), (3, 0.51)):
        dih, at = fluid(d=d, zeta=zeta)
        with pytest.raises(ValueError, match="take nested transport"):
            rates(dih, dih.state(*random_fields(at.n, at.d)))
