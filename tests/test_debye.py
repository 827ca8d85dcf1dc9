"""Waves on a frozen lattice: frequencies are those of a Hessian, slow ones as many as Debye has them."""
from dataclasses import replace

import numpy as np
import pytest
from scenes import rows_of

from particles.weights import Lucy, WendlandC2
from studies.lattices.cases import HEXAGONAL, SQUARE
from studies.lattices.crystals import derivatives
from studies.lattices.debye import Debye, squares

STABLE = replace(HEXAGONAL, h=2.5, cells=(5, 4))


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
    found = squares(STABLE, lattice.vectors(STABLE.cells))
    # P = rho e: 2 P/rho^2 = 2/rho at e = 1
    whole = np.linalg.eigvalsh(hessian(STABLE))*2/rho
    assert whole[:2] == pytest.approx(0, abs=1e-8)      # all particles alike
    # wave vectors of two rectangular zones: each motion is there twice
    assert np.sort(found.ravel()) == pytest.approx(np.repeat(whole[2:], 2), abs=1e-7)


@pytest.mark.parametrize("crystal", [HEXAGONAL, SQUARE])
@pytest.mark.parametrize("weight", [Lucy, WendlandC2])
def test_wide_ranges_have_the_sound_of_the_fluid(crystal, weight):
    wide = rows_of(Debye(crystal=replace(crystal, weight=weight, h=7.0)), "debye")[0]
    assert wide["sound"] == pytest.approx(1, abs=0.02)
