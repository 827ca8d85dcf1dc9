"""Noise and dissipation on points: partners, conservation, invariance, null modes; covariances."""
import numpy as np
import pytest

from continuum.fluid import ConstEta, IdealGas
from particles.integral import fluctuating
from particles.integral.dih import Dih, NestedFluxes, Pairwise
from particles.integral.edge_makers import MAKERS
from particles.integral.points import jittered, lattice, random
from particles.weights import WendlandC2
from studies.noise.cases import algebra
from studies.noise.covariance import forward_euler, sound, steady, steady_of_steps

COUNTS = {2: (8, 9), 3: (5, 5, 6)}
SETS = {"lattice": lambda d: lattice(COUNTS[d]), "jittered": lambda d: jittered(COUNTS[d], 0.2, 1),
        "random": lambda d: random(COUNTS[d], 0.5, 2)}
KT = 0.7


def edges_of(name: str, kind: str, d: int):
    return MAKERS[name](SETS[kind](d), WendlandC2.of(h=2.7 if d < 3 else 2.2, d=d))


@pytest.mark.parametrize("case", [
    *algebra(("lattice", "jittered-0.1", "jittered-0.3"), {1: (20,), 2: (8, 9)}),
    *algebra(("jittered-0.1",), {3: (5, 5, 6)})], ids=lambda case: case.label)
def test_noise_is_the_partner_of_dissipation(case):
    """So Gamma is symmetric, and uniform motion or temperature, of which no noise is made, is not slowed."""
    rows = list(case.measure(print))
    assert rows
    for row in rows:
        assert row["mismatch"] < 1e-12 and row["sums"] < 1e-12, row


@pytest.mark.parametrize(("name", "kind"),
                         [("renormalised", "lattice"), ("delaunay", "random"), ("exact", "jittered")])
@pytest.mark.parametrize("d", [2, 3])
def test_dissipation_is_the_force_that_runs(name, kind, d):
    """Viscous forces of `dih` on any velocities are -Gamma v, nested and along edges; heat likewise."""
    if name == "delaunay" and d == 3:
        name = "exact"
    edges = edges_of(name, kind, d)
    rng = np.random.default_rng(3)
    v, T = rng.normal(size=(edges.n, d)), rng.uniform(0.5, 1.5, edges.n)
    for transport, stress, heat in ((NestedFluxes(), fluctuating.stress, fluctuating.heat),
                                    (Pairwise(mended=False), fluctuating.friction, fluctuating.conduction)):
        dih = Dih(edges=edges, eos=IdealGas(), law=ConstEta(0.3, 0.4), zeta=0.1, transport=transport)
        moving, warm = (transport.fluxes(dih, dih.flow(dih.state(np.ones(edges.n), *given)))
                        for given in ((v, np.ones(edges.n)), (0*v, T)))
        force = np.stack([np.bincount(edges.j, f, edges.n) - np.bincount(edges.i, f, edges.n)
                          for f in moving.momentum.T])
        gain = np.bincount(edges.j, warm.energy, edges.n) - np.bincount(edges.i, warm.energy, edges.n)
        expected = -(stress(edges, 0.3, 0.1, KT).Gamma@v.T.ravel())
        assert force.ravel() == pytest.approx(expected, abs=1e-12*np.abs(expected).max())
        expected = -(heat(edges, 0.4, KT).Gamma@T)
        assert gain == pytest.approx(expected, abs=1e-12*np.abs(expected).max())


def test_printed_viscosity_that_varies_has_no_partner():
    """Eq. 37 takes the viscosity of one point, the slope of the other: no symmetric Gamma, closed or not."""
    edges = edges_of("renormalised", "lattice", 2)
    for eta, least, most in ((np.full(edges.n, 0.3), 0.0, 1e-13),
                             (np.linspace(0.2, 0.4, edges.n), 1e-2, 2.0)):
        Gamma = fluctuating.printed_viscosity(edges, eta, 0*eta)
        assert least <= abs(Gamma - Gamma.T).max()/abs(Gamma).max() <= most


def test_equilibrium_has_covariance_one():
    assert steady(*sound(0.4, 0.1)) == pytest.approx(np.eye(2), abs=1e-12)


def test_forward_euler_heats_by_its_closed_form():
    """Solved by hand: 1/(1 - l dt/2 - s^2 dt/l + 3 s^2 dt^2/4 - s^4 dt^3/(4 l)), 1/(1 - c^2 dt/nu) for long
    waves."""
    s, l = 0.4, 0.1
    for dt in (0.01, 0.1, 0.3):
        C = steady_of_steps(forward_euler(*sound(s, l), dt))
        assert C[1, 1].real == pytest.approx(1/(1 - l*dt/2 - s*s*dt/l + 0.75*(s*dt)**2 - s**4*dt**3/(4*l)),
                                             rel=1e-9)
    c, nu, k, dt = 1.0, 0.5, 1e-3, 0.1
    C = steady_of_steps(forward_euler(*sound(c*k, nu*k*k), dt))
    # nu k^2 dt = 5e-8, solved to 1e-10 over 1e-6
    assert C[1, 1].real == pytest.approx(1/(1 - c*c*dt/nu), rel=1e-5)


def test_modes_that_grow_or_stay_have_no_covariance():
    with pytest.raises(ArithmeticError, match="1 modes do not decay, the fastest grows at 0"):
        steady(np.diag([-1.0, 0.0]), np.eye(2))
    with pytest.raises(ArithmeticError, match="smaller step"):
        steady_of_steps(forward_euler(*sound(0.4, 0.1), 2.0))


BAD = np.where(np.arange(72) == 5, -0.1, 0.3)
NEGATIVE = r"of point \d+ is -0\.\d, which must not be negative"


@pytest.mark.parametrize(("d", "make", "given", "message"), [
    (2, fluctuating.stress, (BAD, 0.0, KT), NEGATIVE), (2, fluctuating.stress, (0.3, 0.0, -BAD), NEGATIVE),
    (2, fluctuating.heat, (BAD, KT), NEGATIVE), (2, fluctuating.friction, (0.3, BAD, KT), NEGATIVE),
    (2, fluctuating.friction, (0.3, 0.7, KT), r"bulk viscosity 0\.7 .*0 to 0\.6: take nested"),
    (3, fluctuating.conduction, (0.3, KT),
     r"conducts k = -.*: take stresses at points")])
def test_what_has_no_noise_is_refused(d, make, given, message):
    with pytest.raises(ValueError, match=message):
        make(edges_of("delaunay", "random", d), *given)
