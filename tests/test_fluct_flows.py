"""Fluctuations about given flows and in 3D: against closed forms and direct solves."""
import numpy as np
import pytest
from test_moving import fluid, shaken

from continuum.fluid import ConstEta, IdealGas
from particles.integral import fluctuating
from particles.integral.covariance import jacobian, steady
from particles.integral.dih import Dih
from particles.integral.edge_makers import MAKERS
from particles.integral.points import jittered, lattice
from particles.limits import limit_of
from particles.run import Plan, run
from particles.weights import Lucy
from studies.noise.flows import apart, root, sampled, slowest_amplitude
from studies.noise.modes import check_modes, directions, plane_waves
from studies.noise.partners import edges_between, noise, states_of_fields, transport
from studies.noise.printed import line_symbols

U = 0.5


def test_a_stream_shifts_all_rates_by_the_symbol_of_the_gradient():
    edges, one = MAKERS["renormalised"](lattice((11,)), Lucy.of(h=2.0, d=1)), np.ones(11)
    dih = Dih(edges=edges, eos=IdealGas(), law=ConstEta(0.0, 0.4), zeta=0.3)
    wave, k = np.exp(2j*np.pi*2*np.arange(11)/11), 4*np.pi/11
    rates = []
    for u in (0.0, U):
        J = jacobian(dih.rates, dih.state(one, np.full((11, 1), u), one))
        block = np.einsum("x,axby,y->ab", wave.conj(), J.reshape(3, 11, 3, 11), wave)/11
        found = np.linalg.eigvals(block) + 1j*u*line_symbols(k)[0]
        rates.append(found[np.argsort(found.imag)])
    assert rates[1] == pytest.approx(rates[0], abs=1e-10)       # differences good to 1e-12 over gaps of some 0.1


def test_faces_between_moving_points_have_partners_wherever_the_points_are():
    method = fluid("periodic")
    state = shaken(method)
    for steps in (0, 5):
        edges = edges_between(method, run(method, state, Plan(dt=0.1*limit_of(method, state), steps=steps)).by_id())
        assert np.abs(edges.closure).max() < 1e-9 and np.abs(edges.linear - np.eye(2)).max() < 1e-8
        eta = np.random.default_rng(1).uniform(0.2, 1, edges.n)
        for pair in (fluctuating.stress(edges, eta, eta, 0.7), fluctuating.friction(edges, eta, eta, 0.7)):
            assert fluctuating.mismatch(pair, 1.4) < 1e-12
            assert np.abs(np.kron(np.eye(2), np.ones(edges.n))@pair.B).max() < 1e-12*abs(pair.B).max()


# --- complex waves ----------------------------------------------------------------------------


def wave_of(n: int = 6) -> tuple[np.ndarray, np.ndarray]:
    """A complex J, all of whose modes decay, and a complex Q."""
    rng = np.random.default_rng(1)
    J, B = (rng.normal(size=(n, n)) + 1j*rng.normal(size=(n, n)) for _ in range(2))
    return 0.01*(J - 6*np.eye(n)), B@B.conj().T


def test_real_and_imaginary_parts_have_the_covariance_of_complex_waves():
    """Of real parts it is Re C/2, of real with imaginary ones -Im C/2."""
    J, Q = wave_of()
    B = apart(root(Q))/np.sqrt(2)
    assert root(Q)@root(Q).conj().T == pytest.approx(Q, abs=1e-12)
    assert steady(apart(J), B@B.T) == pytest.approx(apart(steady(J, Q))/2, abs=1e-8)
    with pytest.raises(ArithmeticError, match="no noise has a negative variance"):
        root(Q - 1.01*np.linalg.eigvalsh(Q)[0]*np.eye(len(Q)))


def test_samples_of_complex_waves_have_the_variances_of_the_lyapunov_solve():
    """Within five standard errors; a Q that is half as large is seen."""
    J, Q = wave_of(8)
    modes = np.random.default_rng(2).normal(size=(2, 8)) + 0.5j
    rows = sampled(J, Q, modes, 1, lambda done: None, 60.0)
    C = steady(J, Q)
    for row, mode in zip(rows, modes, strict=True):
        assert row["exact"] == pytest.approx((mode@C@mode.conj()).real)
        assert abs(row["ratio"] - 1) < 2.5*row["ratio_err"] < 0.3


def test_the_slowest_amplitude_is_a_left_eigenvector():
    J, _ = wave_of()
    row, rate = slowest_amplitude(J), np.linalg.eigvals(J)
    assert row@J == pytest.approx(rate[np.argmax(rate.real)]*row, abs=1e-12)


# --- 3D ---------------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("k", [(1.0, 0.0, 0.0), (0.0, -2.0, 0.0), (1.0, -1.0, 0.5), (0.0, 0.0, 0.0)])
def test_velocities_along_and_across_a_wave_in_space(k):
    frame = np.stack(list(directions(np.array(k)).values()))
    assert frame@frame.T == pytest.approx(np.eye(3), abs=1e-14)
    assert np.abs(frame[1:]@np.array(k)).max() < 1e-14


def test_null_modes_in_3d_are_refused():
    points = lattice((6, 6, 6))
    edges = MAKERS["renormalised"](points, Lucy.of(h=1.2, d=3))
    Q = noise(edges.V, *(part.Q for part in transport(edges, 0.0, 0.3, 0.1, 0.4, 1.0)))
    names, F = plane_waves(points, edges.V, ((3, 0, 3), (3, 3, 3)))
    C = np.diag(np.tile(1/edges.V, 5))
    with pytest.raises(ValueError, match=r"all 20 modes in the list are null modes"):
        check_modes(F, C, Q, names)
    names, F = plane_waves(points, edges.V, ((3, 0, 3), (1, 0, 3)))
    check_modes(F, C, Q, names)


def test_fields_and_states_about_a_flow():
    """States of small changes of rho, v, T, by differences."""
    v = np.tile([U, 0.0], (25, 1))
    dih = Dih(edges=MAKERS["delaunay"](jittered((5, 5), 0.3, 1), None), eos=IdealGas(), law=ConstEta(0.3, 0.4))
    rng = np.random.default_rng(1)
    rho, T, dv, small = rng.normal(size=25), rng.normal(size=25), rng.normal(size=(25, 2)), 1e-6
    moved = [dih.state(1 + s*rho, v + s*dv, 1 + s*T) for s in (small, -small)]
    expected = states_of_fields(v)@np.concatenate([rho, *dv.T, T])
    assert ((moved[0] - moved[1])/(2*small)).ravel() == pytest.approx(expected, abs=1e-8)
