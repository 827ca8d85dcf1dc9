"""Dissipative particles as a special case of RR98: form, partners, the viscosity of their noise; the trace of Eq. 23."""
import numpy as np
import pytest

from particles.dissipative.dpd import Dpd
from studies.noise.formulas import SCALE, blocks, inner_k, neighbours, partner, special, unmodified, viscosities


@pytest.mark.parametrize("d", [2, 3])
def test_the_form_is_that_of_print(d):
    assert special(d) < 1e-12


def test_friction_needs_the_square_of_the_weight_of_the_noise():
    assert partner() < 1e-12
    assert unmodified() > 0.1


def test_blocks_are_friction_between_pairs():
    """Symmetric, positive, blind to uniform motion; two particles by hand."""
    _, w, e = neighbours(Dpd(box=(3.0, 3.0)))
    G = blocks(w**2, e)
    assert np.abs(G - G.T).max() < 1e-14
    assert np.abs(G@np.kron(np.eye(2), np.ones(w.shape[0])).T).max() < 1e-13
    assert np.linalg.eigvalsh(G).min() > -1e-13
    e = np.zeros((2, 2, 2))
    e[0, 0, 1], e[0, 1, 0] = 1, -1
    assert np.array_equal(blocks(np.array([[0, 3.0], [3.0, 0]]), e)[:2, :2], [[3, -3], [-3, 3]])


def test_the_scale_of_the_weight_is_its_first_moment():
    r = (np.arange(20000) + 0.5)/20000
    assert SCALE*np.mean((1 - r)*r*4*np.pi*r**2) == pytest.approx(3, rel=1e-7)


def test_viscosity_of_the_noise_goes_with_the_density():
    assert viscosities(rho=6.0)/viscosities(rho=3.0) == pytest.approx(2)
    assert viscosities(doubled=False)/viscosities() == pytest.approx(4)
    # 945/(8 pi c^2) by hand
    assert viscosities(rho=1.0) == pytest.approx(945/(8*np.pi*SCALE**2))


@pytest.mark.parametrize("k", [0.5, 1.0])
def test_the_trace_of_eq_23_vanishes_where_k_is_1(k):
    assert inner_k(k) == pytest.approx(6*(1 - k), abs=1e-14)
