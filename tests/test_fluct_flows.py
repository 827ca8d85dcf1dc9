"""Fluctuations about flows that move, in 3D, and what null modes do to velocities: against closed forms and direct solves."""
import numpy as np
import pytest
from scipy.linalg import expm
from test_moving import fluid, shaken

from continuum.fluid import ConstEta, IdealGas
from particles.integral import fluctuating
from particles.integral.covariance import jacobian, steady
from particles.integral.dih import Dih, Pairwise
from particles.integral.edge_makers import MAKERS
from particles.integral.points import jittered, lattice
from particles.integral.thermal import Thermal
from particles.limits import limit_of
from particles.run import Plan, run
from particles.threads import Team
from particles.weights import Lucy
from studies.noise.fluctuations.algebra import edges_between
from studies.noise.fluctuations.given import Shear, Sheared, Stream, Sustained, kicked
from studies.noise.fluctuations.given_sampled import apart, sampled, slowest_amplitude
from studies.noise.fluctuations.given_sampled import factor as factor_of
from studies.noise.fluctuations.matrices import carried_along, equilibrium, factor, noise, states_of_fields, transport
from studies.noise.fluctuations.modes import check_modes, directions, plane_waves
from studies.noise.fluctuations.steps import line_symbols
from studies.noise.fluctuations.tail import TailSampled, autocorrelation, blocks, resting

U = 0.5


def in_stream(share: float) -> tuple[Thermal, np.ndarray, np.ndarray]:
    """A gas in a stream past irregular points: method, velocities, state."""
    edges = MAKERS["delaunay"](jittered((5, 5), 0.3, 1), None)
    method = Thermal(edges=edges, eos=IdealGas(), law=ConstEta(0.3, 0.4), zeta=0.1, k=1.0, seed=1, share=share)
    v, one = np.tile([U, 0.0], (25, 1)), np.ones(25)
    return method, v, method.dih.state(one, v, one)


@pytest.mark.parametrize("share", [0.0, 0.4])
def test_noise_in_a_stream_is_that_of_rest_and_its_work(share):
    method, v, state = in_stream(share)
    found = kicked(method.start(25, Team(1)), state)
    expected = carried_along(factor(method.edges, *transport(method.edges, share, 0.3, 0.1, 0.4, 1.0)), v)
    assert abs(found@found.T - expected@expected.T).max() < 1e-13*abs(expected@expected.T).max()


def test_what_is_mended_off_a_lattice_is_not_galilean_invariant():
    """Fluctuations in a stream are those of equilibrium, but for the work of a stress that momentum does not feel."""
    found = {}
    for mended in (False, True):
        method, v, state = in_stream(1.0)
        dih = Dih(edges=method.edges, eos=IdealGas(), law=ConstEta(0.3, 0.4), zeta=0.1, transport=Pairwise(mended=mended))
        B = carried_along(factor(method.edges, *transport(method.edges, 1.0, 0.3, 0.1, 0.4, 1.0)), v)
        exactly = equilibrium(method.edges.V, 2, v)
        C = steady(jacobian(dih.rates, state), (B@B.T).toarray(), np.kron(np.eye(4), method.edges.V))
        found[mended] = np.abs(C - exactly).max()/exactly.max()
    assert found[False] < 1e-10 and found[True] > 1e-4


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


# --- a shear flow -----------------------------------------------------------------------------------------------------


def test_vortical_waves_have_their_closed_forms():
    """Weak: second order in U, off by (k a)^2. Waves much shorter than the flow: those of uniform shears, off by 3/2 (q/k)^2."""
    weak = Sheared(period=60, U=1e-6, k=())
    assert weak.vortical(0.15) == pytest.approx(weak.second(0.15), rel=0.15**2)
    wide = Sheared(period=400, U=0.01, k=())
    assert wide.uniform(0.1) > 0.05
    assert wide.vortical(0.1) == pytest.approx(wide.uniform(0.1), rel=1.5*(wide.q/0.1)**2 + 0.1**2)


def test_linear_fluctuations_about_a_shear_flow_are_those_of_vortical_waves():
    row, = Sheared(period=8, U=0.01, k=(0.9,)).run(lambda done: None, None).rows["shear"]
    assert row["extra"] > 1e-3
    assert row["extra"] == pytest.approx(row["vortical"], abs=10*0.01**2)       # sound adds some U^2


@pytest.mark.parametrize("flow", [Stream(0.3), Shear(0.3)])
def test_sources_hold_a_flow_and_noise_conserves(flow):
    points = jittered((5, 5), 0.2, 1)
    given = in_stream(0.3)[0].dih.state(np.ones(25), flow.velocity(points), np.ones(25))
    method = Sustained(edges=MAKERS["delaunay"](points, None), eos=IdealGas(), law=ConstEta(0.3, 0.4), k=0.0, seed=1, share=0.3,
                       given=given)
    assert run(method, given, Plan(dt=0.05, steps=5)).state == pytest.approx(given, abs=1e-14)
    noisy = Sustained(edges=method.edges, eos=method.eos, law=method.law, k=1e-3, seed=1, share=0.3, given=given)
    end = run(noisy, given, Plan(dt=0.05, steps=20)).state
    assert np.abs(end - given).max() > 1e-3
    assert (end - given)@method.edges.V == pytest.approx(np.zeros(4), abs=1e-13*25)     # round-off of 60 sums of 25 points


def wave_of(n: int = 6) -> tuple[np.ndarray, np.ndarray]:
    """A complex J, all of whose modes decay, and a complex Q."""
    rng = np.random.default_rng(1)
    J, B = (rng.normal(size=(n, n)) + 1j*rng.normal(size=(n, n)) for _ in range(2))
    return 0.01*(J - 6*np.eye(n)), B@B.conj().T


def test_real_and_imaginary_parts_have_the_covariance_of_complex_waves():
    """Of real parts it is Re C/2, of real with imaginary ones -Im C/2."""
    J, Q = wave_of()
    B = apart(factor_of(Q))/np.sqrt(2)
    assert factor_of(Q)@factor_of(Q).conj().T == pytest.approx(Q, abs=1e-12)
    assert steady(apart(J), B@B.T) == pytest.approx(apart(steady(J, Q))/2, abs=1e-8)
    with pytest.raises(ArithmeticError, match="no noise has a negative variance"):
        factor_of(Q - 1.01*np.linalg.eigvalsh(Q)[0]*np.eye(len(Q)))


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
    method, v, _ = in_stream(0.0)
    rng = np.random.default_rng(1)
    rho, T, dv, small = rng.normal(size=25), rng.normal(size=25), rng.normal(size=(25, 2)), 1e-6
    moved = [method.dih.state(1 + s*rho, v + s*dv, 1 + s*T) for s in (small, -small)]
    expected = states_of_fields(v)@np.concatenate([rho, *dv.T, T])
    assert ((moved[0] - moved[1])/(2*small)).ravel() == pytest.approx(expected, abs=1e-8)


# --- velocities of points ---------------------------------------------------------------------------------------------


def test_autocorrelation_by_waves_is_that_of_the_whole_matrix():
    edges, dih, rest = resting(5, 0.1, 0.3)
    J = expm(2.0*jacobian(dih.rates, rest))
    C = equilibrium(edges.V, 2)
    mean = np.trace((J@C)[25:75, 25:75])/50
    assert autocorrelation(expm(2.0*blocks(5, 0.1, 0.3))) == pytest.approx(mean, abs=1e-11)


@pytest.mark.parametrize(("share", "stays"), [(0.0, 3), (0.1, 0)])
def test_null_modes_leave_a_floor(share, stays):
    assert 64*autocorrelation(expm(2000.0*blocks(8, share, 1.0))) == pytest.approx(stays, abs=1e-6)


def test_null_modes_begin_at_their_rms():
    state = TailSampled(side=6, share=0.0, lags=(), steps=1).begin().reshape(4, 6, 6)
    corner = (-1.0)**np.add.outer(np.arange(6), np.arange(6))
    for p in state[1:3]:
        assert abs(p.sum()) < 1e-12 and abs((p*corner).sum()/6) == pytest.approx(1, abs=1e-12)
