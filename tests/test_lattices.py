"""Lattices against the sums that run: motions that grow, freezing, sound, waves as many as Debye has them."""
from dataclasses import replace

import numpy as np
import pandas as pd
import pytest

from continuum.fluid import IdealGas, VanDerWaals, pressure
from continuum.gas.fields import NodeFields, Values, nodes
from particles.limits import lattice_sums
from particles.threads import Threads
from particles.weights import Lucy, Monaghan, WendlandC2
from studies.build.spam import at_rest, fluid
from studies.lattices.cases import HEXAGONAL as GAS
from studies.lattices.claims import NO_PRESSURE, SPINODAL
from studies.lattices.crystals import LATTICES, Crystal, derivatives, sums
from studies.lattices.frozen_flow import SCENE, criteria, fastest, neighbours

HEXAGONAL, SQUARE = LATTICES["hexagonal"], LATTICES["square"]
WEIGHTS = (Lucy, Monaghan, WendlandC2)


@pytest.mark.parametrize("weight", [Lucy, WendlandC2])
def test_sums_over_the_square_lattice_are_those_of_the_step_limit(weight):
    k = SQUARE.vectors((8, 8))
    found, known = sums(weight.of(h=3.0), SQUARE, k), lattice_sums(weight.of(h=3.0), 1.0, 1.0, k)
    rho, S, D = found
    assert rho == pytest.approx(known.rho, rel=1e-14)
    np.testing.assert_allclose(S, known.S, atol=1e-14)
    np.testing.assert_allclose(D, known.D, atol=1e-8)       # second derivatives by differences


@pytest.mark.parametrize("eos", [IdealGas(), VanDerWaals()])
@pytest.mark.parametrize("weight", WEIGHTS)
def test_least_stable_motion_is_pushed_as_its_eigenvalue_says(weight, eos):
    """Sums that run, on a lattice shifted by 1e-5: accelerations are -omega^2 u, energies have followed."""
    crystal = Crystal(lattice=HEXAGONAL, cells=(8, 5), weight=weight, h=2.9, eos=eos, T=0.6)
    (k, a, square, _), shift, x = crystal.motion, 1e-5, HEXAGONAL.places((8, 5))
    u = shift*a*np.cos(x@k + 1.0)[:, None]
    kernel = fluid(weight.of(h=2.9), HEXAGONAL.box((8, 5)), eos).start(len(x), Threads(1))
    state, ids = at_rest(x + u, crystal.e), np.arange(len(x))
    rho, *_ = sums(weight.of(h=2.9), HEXAGONAL, k[None])
    kernel.around.relist(state, ids, 0.0)
    kernel.densities(state)
    state[4] += pressure(eos, rho, crystal.e)/rho**2*(kernel.around.rho[:len(x)] - rho)
    out = np.empty_like(state)
    kernel.rates(state, out)
    # squares of shifts
    np.testing.assert_allclose(out[2:4, np.argsort(ids)].T, -square*u, atol=2e-4*abs(square)*shift + 1e-9)


def test_van_der_waals_limits_by_hand():
    rho, d = 1.2, 1e-5
    T = pd.eval(SPINODAL, local_dict={"rho": rho})
    P = [pressure(VanDerWaals(), r, T - r/2) for r in (rho - d, rho + d)]
    assert P[0] == pytest.approx(P[1], abs=1e-9)
    T = pd.eval(NO_PRESSURE, local_dict={"rho": rho})
    assert pressure(VanDerWaals(), rho, T - rho/2) == pytest.approx(0, abs=1e-15)


# --- freezing ---------------------------------------------------------------------------------------


def test_neighbours_are_the_six_of_a_lattice_partners_left_out():
    x, (width, height) = HEXAGONAL.places((8, 5)), HEXAGONAL.box((8, 5))
    i, j = neighbours(x, width)
    apart = x[i] - x[j]
    apart[:, 0] -= width*np.round(apart[:, 0]/width)
    inner = np.abs(x[i, 1]) < height/2 - 2
    assert (np.bincount(i) == 6).all() and np.hypot(*apart[inner].T) == pytest.approx(1.0745699, rel=1e-6)
    i, j = neighbours(np.concatenate([x, x + 0.01]), width)
    assert (np.abs(i - j) != len(x)).all()


def test_criteria_are_the_printed_inequalities():
    """By hand for Lucy: w(0) = 5/(9 pi), w(0.9) - w(1) = 0.010452."""
    printed = criteria(Lucy, 0.002)
    assert printed["barrier"]*2*5/(9*np.pi) == pytest.approx(2*0.002, rel=1e-12)
    assert printed["melting"]*2*0.010452 == pytest.approx(2*0.002, rel=1e-3)


def test_fastest_point_of_waves_has_four_times_the_mean():
    x, y = np.meshgrid(*nodes(SCENE, 16))
    still, vx = np.zeros_like(x), np.sin(2*np.pi*x/SCENE.width)*np.sin(np.pi*(y/SCENE.L + 0.5))
    at = Values(vx, still, still, still + 1, still + 1)
    assert fastest(NodeFields(SCENE, x[0], y[:, 0], at, still)) == pytest.approx(4, rel=2e-3)


# --- Debye's spectrum --------------------------------------------------------------------------------

STABLE = replace(GAS, h=2.5, cells=(5, 4))


def hessian(crystal):
    """Of the sum of 2 P/rho^2 w over pairs, which the sums of P = rho^2 are [KHP95, Sec. III]; (2 n, 2 n)."""
    x, box = crystal.lattice.places(crystal.cells), np.array(crystal.lattice.box(crystal.cells))
    weight, n = crystal.weight.of(h=crystal.h), len(x)
    H = np.zeros((n, n, 2, 2))
    for i, j in zip(*np.triu_indices(n, 1), strict=True):
        r = x[j] - x[i] - box*np.round((x[j] - x[i])/box)
        if np.hypot(*r) < crystal.h:
            _, slope, curvature = derivatives(weight, np.hypot(*r))
            along = np.outer(r, r)/(r@r)
            pair = slope*(np.eye(2) - along) + curvature*along
            H[i, i] += pair
            H[j, j] += pair
            H[i, j] = H[j, i] = -pair
    return H.transpose(0, 2, 1, 3).reshape(2*n, 2*n)


def test_frequencies_are_those_of_the_hessian_of_all_particles():
    lattice, weight = STABLE.lattice, STABLE.weight.of(h=STABLE.h)
    rho = sum(derivatives(weight, r)[0] for r in np.hypot(*lattice.neighbours(STABLE.h).T)) + 5/(np.pi*2.5**2)
    found = STABLE.squares(lattice.vectors(STABLE.cells))
    # P = rho e: 2 P/rho^2 = 2/rho at e = 1
    whole = np.linalg.eigvalsh(hessian(STABLE))*2/rho
    assert whole[:2] == pytest.approx(0, abs=1e-8)      # all particles alike
    # wave vectors of two rectangular zones: each motion is there twice
    assert np.sort(found.ravel()) == pytest.approx(np.repeat(whole[2:], 2), abs=1e-7)
