"""Lattices against the sums that run: moduli, motions that grow, sites of least energy."""
from dataclasses import replace

import numpy as np
import pytest

from continuum.fluid import IdealGas, VanDerWaals, pressure
from particles.limits import lattice_sums
from particles.threads import Team
from particles.weights import Lucy, Monaghan, WendlandC2
from studies.build.periodic_box import at_rest, fluid
from studies.lattices.claims import pressureless, spinodal
from studies.lattices.growth import Crystal, Growth, growth
from studies.lattices.moduli import Moduli
from studies.lattices.occupancy import median_ratio, partners
from studies.lattices.waves import lattice, least_stable, sites_of_least_energy, sums, vectors
from studies.lattices.waves import neighbours as around
from studies.rb.runs.lattices import LUCY, shear_moduli

WEIGHTS = (Lucy, Monaghan, WendlandC2)


def rows(case, table):
    return case.run(lambda done: None, None).rows[table]


def test_sums_over_the_square_lattice_are_those_of_the_step_limit():
    k = vectors("square", (8, 8))
    total, S, D = sums(Lucy.of(h=3.0), "square", k)
    known = lattice_sums(Lucy.of(h=3.0), 1.0, 1.0, k)
    assert total == pytest.approx(known.rho, rel=1e-14)
    np.testing.assert_allclose(S, known.S, atol=1e-14)
    np.testing.assert_allclose(D, known.D, atol=1e-8)       # second derivatives by differences


@pytest.mark.parametrize(("kind", "nearest", "far"), [("square", 4, 1.0), ("diagonal", 4, 1.0), ("hexagonal", 6, 1.0745699)])
def test_lattices_have_density_one_and_their_neighbours(kind, nearest, far):
    at = lattice(kind, (6, 4), strain=0.1)
    assert len(at.x)/np.prod(at.box) == pytest.approx(1.0, rel=1e-14)
    assert (np.abs(at.x) <= np.array(at.box)/2).all()
    r = np.hypot(*around(kind, 1.2).T)
    assert len(r) == nearest and r == pytest.approx(far, rel=1e-7)


@pytest.mark.parametrize("eos", [IdealGas(), VanDerWaals()])
@pytest.mark.parametrize("weight", WEIGHTS)
def test_least_stable_motion_is_pushed_as_its_eigenvalue_says(weight, eos):
    """Sums that run, on a lattice shifted by 1e-5: accelerations are -omega^2 u, energies have followed."""
    at, shift, T = lattice("hexagonal", (8, 5)), 1e-5, 0.6
    e = T - (0.5 if isinstance(eos, VanDerWaals) else 0.0)
    k, a, square = least_stable(weight.of(h=2.9), eos, e, "hexagonal", (8, 5))
    u = shift*a*np.cos(at.x@k + 1.0)[:, None]
    method = fluid(weight.of(h=2.9), at.box, eos)
    kernel = method.start(len(at.x), Team(1))
    state = at_rest(at.x, e)
    kernel.around.relist(state, np.arange(len(at.x)), 0.0)
    order = np.argsort(kernel.around.x[:len(at.x)] + 1e3*kernel.around.y[:len(at.x)])
    given = np.argsort(at.x[:, 0] + 1e3*at.x[:, 1])
    shifts = np.empty_like(u)
    shifts[order] = u[given]
    kernel.densities(state)
    before, out = kernel.around.rho[:len(at.x)].copy(), np.empty_like(state)
    state[:2] += shifts.T
    kernel.densities(state)
    state[4] += pressure(eos, before, e)/before**2*(kernel.around.rho[:len(at.x)] - before)
    kernel.rates(state, out)
    np.testing.assert_allclose(out[2:4].T, -square*shifts, atol=2e-4*abs(square)*shift + 1e-9)     # squares of shifts


@pytest.mark.parametrize("weight", WEIGHTS)
def test_moduli_of_both_kinds_of_sums_agree(weight):
    for kind in ("square", "hexagonal"):
        row = rows(Moduli(lattice=kind, weight=weight, h=(3.0,)), "moduli")[0]
        assert row["measured"] == pytest.approx(row["exact"], abs=1e-9)


def test_moduli_are_those_of_the_printed_weight():
    found = [rows(Moduli(lattice=kind, weight=Lucy, h=(3.0,)), "moduli")[0]["exact"] for kind in ("square", "diagonal")]
    np.testing.assert_allclose(found, shear_moduli(LUCY, "square"), atol=1e-9)


def test_lattices_of_least_energy_have_one_particle_a_site_or_two():
    assert sites_of_least_energy(Lucy.of(h=3.0)) == sites_of_least_energy(WendlandC2.of(h=3.0)) == 1
    assert sites_of_least_energy(Monaghan.of(h=3.0)) == 2


def test_a_motion_that_grows_does_so_at_its_rate():
    crystal = Crystal(lattice="hexagonal", cells=(8, 5), weight=Monaghan, h=2.8, eos=IdealGas())
    row = rows(Growth(crystal=crystal), "growth")[0]
    assert row["predicted"] > 0.3 and row["measured"] == pytest.approx(row["predicted"], rel=1e-3)
    assert replace(crystal, h=2.2).motion.rate < 0


def test_rates_are_read_where_motions_are_small():
    t = np.linspace(0, 100, 400)
    found = growth(t, np.minimum(1e-17 + 1e-18*np.exp(2*0.3*t), 1e-3))
    assert found.value == pytest.approx(0.3, rel=1e-5)


def test_van_der_waals_limits_by_hand():
    assert pressureless(1.0) == spinodal(1.0) == 0.25
    rho, T, d = 1.2, spinodal(1.2), 1e-5
    P = [pressure(VanDerWaals(), r, T - r/2) for r in (rho - d, rho + d)]
    assert P[0] == pytest.approx(P[1], abs=1e-9)
    assert pressure(VanDerWaals(), rho, pressureless(rho) - rho/2) == pytest.approx(0, abs=1e-15)


def test_pairs_are_told_from_single_particles():
    at = lattice("hexagonal", (6, 4))
    assert median_ratio(at.x, at.box) == pytest.approx(1.0) and not partners(at.x, at.box).any()
    twice = np.concatenate([at.x, at.x + 0.01])
    assert median_ratio(twice, at.box) > 50 and (partners(twice, at.box) == 1).all()
