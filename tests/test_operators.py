"""What the measurements of the study operators rest on: sums against transforms, double loops, time steps."""
from math import ceil

import numpy as np
import pytest
from scenes import rows_of

from continuum.fluid import ConstEta, IdealGas
from continuum.scene import RayleighBenard
from particles.integral.dih import Dih, NestedFluxes
from particles.integral.edge_makers import MAKERS, delaunay, plain, printed, renormalised
from particles.integral.edges import Edges
from particles.integral.interpolants import Exponential, Gaussian, W
from particles.integral.points import jittered, lattice, pairs
from particles.limits import limit_of, rates_of
from particles.run import Plan, run
from particles.smooth.corrected import Symmetrised
from particles.threads import Threads
from particles.weights import Lucy, WendlandC2, value_and_slope
from studies.build.fixed import SCHEMES, fluid
from studies.build.setting import jacobian
from studies.operators import equations as eq
from studies.operators import makers
from studies.operators.points import LayerGrowth, sound
from studies.operators.transport import euler_limit
from studies.operators.weights import around, gradient_symbol, interpolated, line_weight, smoothed

# --- weights --------------------------------------------------------------------------------------


@pytest.mark.parametrize(("kind", "d", "known"), [
    *((Gaussian, d, lambda q: np.exp(-q**2/2)) for d in (1, 2, 3)),
    (Exponential, 1, lambda q: 1/(1 + q**2)), (Exponential, 3, lambda q: np.arctan(q)/q)])
def test_transforms_of_weights_are_the_known_ones(kind, d, known):
    k, r0 = 1.3, 0.7
    assert smoothed(kind(r0, d), d, k).value == pytest.approx(known(k*r0), rel=1e-10)
    assert interpolated(kind(r0, d), d, k).value == pytest.approx(k*known(k*r0), rel=1e-10)


@pytest.mark.parametrize("d", [1, 2, 3])
def test_lattice_sums_are_those_of_the_edges(d):
    """Symbols and moments from one point's neighbours against the matrices of the makers.

    Nested transport has the square of the gradient's symbol, so that it does not see zigzags.
    """
    h, at, k = 2.5, lattice((16, 6, 6)[:d]), 2*np.pi*3/16
    weight, near, wave = Lucy.of(h=h, d=d), around(h, d), np.exp(1j*k*at.x[:, 0])
    for make, w in ((plain, W(weight, near.r)), (printed, line_weight(weight, d, near.r))):
        edges, symbol = make(at, weight), gradient_symbol(w, near, k)
        assert ((edges.G[0]@wave)/wave)[0].imag/k == pytest.approx(symbol, rel=1e-12)
        assert edges.linear[0, 0, 0] == pytest.approx(float(near.number@(w*near.r))/d, rel=1e-12)
        twice = sum(D@(G@wave.real/edges.V) for D, G in zip(edges.D, edges.G, strict=True))/edges.V
        nested = -(twice@wave.real)/(wave.real@wave.real)/k**2
        assert nested == pytest.approx(symbol**2, rel=1e-12)
        zigzag = np.cos(np.pi*(at.x[:, 0] - at.x[0, 0]))
        assert max(np.abs(G@zigzag/edges.V).max() for G in edges.G) < 1e-12


def test_the_exponential_weight_is_that_of_print():
    """[Eqs 30, 31]: W = (2/r^3 + 1/r^2) e^-r/4 pi in units of r0; that W is a slope, `test_edges` asks."""
    r = np.linspace(0.3, 5, 20)
    np.testing.assert_allclose(W(Exponential(1.0, 3), r), (2/r**3 + 1/r**2)*np.exp(-r)/(4*np.pi), rtol=1e-12)


# --- sums written out -----------------------------------------------------------------------------


def gas(edges, transport=eq.PRINTED, zeta=0.0):
    return Dih(edges=edges, eos=IdealGas(), law=ConstEta(0.3, 0.4), zeta=zeta, transport=transport)


def test_literal_sums_are_those_of_the_code():
    """Eqs 34-38 as matrices of W e against the exchange over edges, on points where nothing cancels."""
    edges = renormalised(jittered((8, 9), 0.2, 1), WendlandC2.of(h=2.7))
    rng, n = np.random.default_rng(2), edges.n
    rho, v, T = rng.uniform(0.9, 1.1, n), rng.normal(size=(n, 2)), rng.uniform(0.9, 1.1, n)
    dih, w = gas(edges, zeta=0.1), eq.brackets(edges)
    state, still = dih.state(rho, v, T), dih.state(rho, 0*v, T)
    np.testing.assert_allclose(eq.mass_rate(w, rho, v), rates_of(dih, state)[0], rtol=0, atol=1e-12)
    friction = eq.transported(dih, dih.flow(state))[1:-1].T
    along = eq.gathered(w, eq.kernel(eq.inner(w, v), 0.3, 0.1, 1.0))
    np.testing.assert_allclose(-along, friction, rtol=0, atol=1e-12)
    conduction = rates_of(dih, still)[-1]
    np.testing.assert_allclose(eq.gathered(w, 0.4*eq.inner(w, T)), conduction, rtol=0, atol=1e-12)


def test_spectral_derivatives_are_exact():
    phase = 2*np.pi*lattice((12, 12), 1/12).x@np.array([1, 2]) + 0.3
    slope = 2*np.pi*np.cos(phase)[:, None]*[1, 2]
    np.testing.assert_allclose(eq.Spectral((12, 12)).grad(np.sin(phase)), slope, rtol=0, atol=1e-12)


@pytest.mark.parametrize("d", [1, 2, 3])
def test_a_dilation_meets_the_bulk_viscosity_only_with_the_trace_factor_2_over_d(d):
    assert abs(eq.added_bulk(d, 2/d)) < 1e-14
    assert eq.added_bulk(d, 2/3) == pytest.approx(2/d - 2/3, abs=1e-14)


# --- what is kept and what grows ------------------------------------------------------------------


@pytest.mark.parametrize("maker", ["plain", "delaunay"])
def test_the_matrix_of_sound_is_that_of_the_rates_and_antisymmetric_where_edges_close(maker):
    """d/dt of energy and momentum at rest, inviscid gas: e' is P', P' enters without c."""
    at = jittered((7, 7), 0.2, 5)
    edges = MAKERS[maker](at, WendlandC2.of(h=2.7))
    dih = Dih(edges=edges, eos=IdealGas(), law=ConstEta(0.0, 0.0))
    rest, c, root = dih.state(np.ones(at.n), np.zeros((at.n, 2)), np.ones(at.n)), np.sqrt(2), np.sqrt(edges.V)
    P, u, v = np.random.default_rng(0).normal(size=(3, at.n))
    _, du, dv, dP = (jacobian(dih.rates, rest)@np.concatenate([0*P, u, v, P])).reshape(4, -1)
    A = sound(edges)
    assert (np.abs(A + A.T).max() < 1e-14) == (maker == "delaunay")
    expected = c*A@np.concatenate([root*P/c, root*u, root*v])
    np.testing.assert_allclose(np.concatenate([root*dP/c, root*du, root*dv]), expected, rtol=0, atol=1e-7)


def test_euler_limit_is_where_a_wave_begins_to_grow():
    """A damped wave -g +- i w: |1 + lambda dt| = 1 at 2 g/(g^2 + w^2)."""
    waves = np.array([-0.1 + 1j, -0.1 - 1j, -3.0, 0.0])
    dt = euler_limit(waves)
    assert dt == pytest.approx(0.2/1.01, rel=1e-12)
    assert abs(1 + waves[0]*dt*1.001) > 1 > abs(1 + waves[0]*dt*0.999)
    assert euler_limit(np.array([0.1 + 1j])) == 0


@pytest.mark.parametrize(("transport", "right"), [(NestedFluxes(), True), (eq.PRINTED, False)])
def test_differences_in_the_inner_sum_mend_nested_transport_on_any_points(transport, right):
    """[Eqs 37, 38]: no friction in a uniform stream, no heat at uniform temperature."""
    edges = renormalised(jittered((10, 10), 0.3, 1), WendlandC2.of(h=3.0))
    dih, one = gas(edges, transport), np.ones(edges.n)
    friction = eq.transported(dih, dih.flow(dih.state(one, one[:, None]*np.array([0.6, 0.8]), one)))[1:-1]
    heat = eq.transported(dih, dih.flow(dih.state(one, np.zeros((edges.n, 2)), one)))[-1]
    for rate in (friction, heat):
        size = np.sqrt((rate**2).mean())
        assert size < 1e-13 if right else size > 0.01


def test_eigenvalues_and_time_steps_give_one_growth_of_a_layer_between_plates():
    """h = 2 a, nested only: the fastest mode grows e-fold in a growth time, but for its square."""
    scene = RayleighBenard(ra=1500.0, L=8.0, aspect=1.0)
    method = fluid(scene, SCHEMES["fixed-lattice"]._replace(share=0.0))
    state = method.state(1.0, np.zeros_like(method.x), scene.T(method.x[:, 1]))
    values, vectors = np.linalg.eig(jacobian(method.start(state.shape[1], Threads(1)).rates, state))
    worst = np.argmax(values.real)
    rate, mode = values[worst].real, 1e-4*vectors[:, worst].real.reshape(state.shape)
    [row] = rows_of(LayerGrowth(h=2.0, rows=8, ra=1500.0, share=0.0), "nested_growth")
    assert rate == pytest.approx(row["growth"]*np.sqrt(2*scene.T_mean), rel=1e-9)
    steps = ceil(1/rate/(0.5*limit_of(method, state)))
    last = run(method, state + mode, Plan(dt=1/rate/steps, steps=steps)).state
    np.testing.assert_allclose(last - state, np.e*mode, rtol=0, atol=1e-3*np.abs(mode).max())


# --- the map of makers ----------------------------------------------------------------------------


def test_particles_are_asked_as_edges_are():
    """Areas (B_i + B_j)/2 grad w by double sums, as edges, against particles that run with them."""
    points, weight = jittered((9, 9), 0.2, 1), WendlandC2.of(h=3.0)
    i, j, apart, r = pairs(points, weight.h)
    w, slope = np.array([value_and_slope(weight, q) for q in r]).T
    W, (grad, x) = np.zeros((81, 81)), np.zeros((2, 81, 81, 2))
    W[i, j] = W[j, i] = w
    grad[i, j], grad[j, i] = -slope[:, None]*apart, slope[:, None]*apart
    V = 1/(W.sum(axis=1) + value_and_slope(weight, 0.0)[0])
    x[i, j], x[j, i] = apart, -apart
    B = np.linalg.inv(np.einsum("j,ija,ijb->iab", V, x, grad))
    S = np.einsum("i,j,ijab,ijb->ija", V, V, B[:, None] + B, grad)
    edges = Edges(i=i, j=j, S=S[i, j], k=-2*V[i]*V[j]*slope, apart=apart, V=V)
    ours = makers.of_particles(points, weight, Symmetrised)
    theirs = makers.of_edges(points, weight, lambda *_: edges)
    order, same = np.lexsort(ours.x.round(9)), np.lexsort(theirs.x.round(9))

    def wave(x):
        return np.sin(2*np.pi*x[0]/9)*np.cos(2*np.pi*x[1]/9)
    for asked in ("momentum", "gradient", "laplacian"):
        fast, slow = (getattr(at, asked)(wave) for at in (ours, theirs))
        np.testing.assert_allclose(fast[..., order], slow[..., same], atol=1e-11)
    np.testing.assert_allclose(ours.linear[..., order], theirs.linear[..., same], atol=1e-12)


def test_a_triangular_lattice_has_six_neighbours_at_one_distance():
    points = makers.hexagonal((9, 9), 0.0, 1)
    r = pairs(points, 1.5)[3]
    assert len(r) == 3*points.n and np.ptp(r) < 1e-12 and points.a == pytest.approx(1.0)


def test_heat_through_a_plate_is_a_sum_over_pairs_with_images_whatever_pushes():
    points = jittered((9, 8), 0.2, 1)
    scene, T = makers.layer(points)
    x, y = points.x.T
    dx = (x[:, None] - x + 4.5) % 9.0 - 4.5
    rho, nu = np.zeros(len(x)), []
    for side in (0.0, -8.0, 8.0):           # itself, and images behind the lower and the upper plate
        dy = y[:, None] - (side - y if side else y)
        w, slope = np.vectorize(lambda r: value_and_slope(WendlandC2.of(h=3.0), r))(np.hypot(dx, dy))
        rho += w.sum(axis=1)
        nu.append(-2*slope*(T[:, None] + T - 2*(scene.T_hot if side < 0 else scene.T_cold)))
    lower, upper = ((f/rho[:, None]/rho).sum()*scene.L/scene.dT/scene.width for f in nu[1:])
    heat = makers.through_pairs(points, "sph")
    np.testing.assert_allclose(heat, [-lower, upper], rtol=1e-11)
    for maker in ("sumB", "CRKSPH", "riemann"):
        np.testing.assert_allclose(makers.through_pairs(points, maker), heat, rtol=1e-12)


def test_heat_through_images_behind_triangles_on_a_lattice_is_of_second_order():
    heat = (makers.through_faces(lattice((n, n)), delaunay) for n in (12, 24))
    coarse, fine = (abs(one/makers.NU - 1).max() for one in heat)
    assert coarse/fine == pytest.approx(4, rel=0.1)
