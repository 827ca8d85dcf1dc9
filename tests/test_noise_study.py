"""The study noise: printed noise, dissipative particles, heat with current amplitudes."""
from dataclasses import replace

import numpy as np
import pandas as pd
import pytest

from particles.dissipative.dpd import Dpd
from particles.integral import fluctuating
from particles.integral.edge_makers import delaunay
from particles.integral.points import jittered
from studies.kit.sweep import RESULTS
from studies.noise import cases
from studies.noise.dissipative import blocks, neighbours
from studies.noise.partners import KT, viscosity
from studies.noise.sampling import dirichlet, heat_kicks


@pytest.fixture(scope="module")
def printed():
    """The table of this name."""
    return pd.DataFrame([row for case in cases.printed() for row in case.run(print, RESULTS).rows["printed"]])


def test_printed_noise_has_the_variance_of_lattice_sums(printed):
    """To nine digits: solves with condition 1e3."""
    assert printed["ratio"].to_numpy() == pytest.approx(printed["predicted"].to_numpy(), rel=1e-8)


@pytest.mark.parametrize("equation, due", [(42, 1.0), (43, 1/KT)])
def test_waves_on_a_line_of_nearest_neighbours_get_one_over_cosine_squared(printed, equation, due):
    """Doubled; T/cos^2(ka/2), energies 1/(T cos^2(ka/2)); the corner of the zone costs digits."""
    rows = printed.query("equation == @equation and reading == 'doubled' and h == 1.5")
    assert len(rows) == 15
    assert (rows["ratio"]*np.cos(rows["wavenumber"]/2)**2).to_numpy() == pytest.approx(due, rel=1e-10)


def test_blocks_are_friction_between_pairs():
    """Symmetric, positive, blind to uniform motion; two particles by hand."""
    w, e = neighbours(Dpd(box=(3.0, 3.0)).random_start(3.0)[:2], (3.0, 3.0))
    G = blocks(w**2, e)
    assert np.abs(G - G.T).max() < 1e-14
    assert np.abs(G@np.kron(np.eye(2), np.ones(w.shape[0])).T).max() < 1e-13
    assert np.linalg.eigvalsh(G).min() > -1e-13
    e = np.zeros((2, 2, 2))
    e[0, 0, 1], e[0, 1, 0] = 1, -1
    assert np.array_equal(blocks(np.array([[0, 3.0], [3.0, 0]]), e)[:2, :2], [[3, -3], [-3, 3]])


def test_viscosity_of_the_noise_goes_with_the_density():
    """945/(8 pi c^2) by hand, with c of the first moment: int c (1 - r) r dV = 3."""
    r = (np.arange(20000) + 0.5)/20000
    c = 3/np.mean((1 - r)*r*4*np.pi*r**2)
    assert viscosity(rho=1.0) == pytest.approx(945/(8*np.pi*c**2), rel=1e-7)
    assert viscosity(rho=6.0)/viscosity(rho=3.0) == pytest.approx(2)


def test_current_amplitudes_have_dirichlet_moments():
    """d<T T>/dt = 0: J C + C J^T + <B B^T>, second moments of Dirichlet(C/k)."""
    n, C = 16, 12.0
    edges = replace(delaunay(jittered((4, 4), 0.2, 1), None), V=np.ones(n))
    second = n*C/(n*C + 1)*(np.ones((n, n)) + np.eye(n)/C)        # <T_i T_j>, mean 1
    assert second[0, 0] - 1 == pytest.approx(dirichlet(n, C), rel=1e-12)
    across = fluctuating.incidence(edges).toarray()
    J, rate = edges.laplacian.toarray(), np.diag(2*edges.k/C*second[edges.i, edges.j])
    left = J@second + second@J.T + across@rate@across.T
    assert np.abs(left).max() < 1e-13*np.abs(J).max()


def test_heat_kicks_have_the_amplitude_of_the_current_temperatures():
    edges = delaunay(jittered((4, 4), 0.2, 1), None)
    T, C, dt = np.linspace(0.5, 1.5, 16), 12.0, 0.05
    kicks = heat_kicks(edges, C, dt, 7)
    samples = np.array([kicks(T, step)*edges.V for step in range(20000)])
    across = fluctuating.incidence(edges).toarray()
    expected = across@np.diag(2*edges.k*T[edges.i]*T[edges.j]/C*dt)@across.T
    # five of sqrt(2/20000)
    assert samples.T@samples/len(samples) == pytest.approx(expected, abs=0.05*expected.max())
