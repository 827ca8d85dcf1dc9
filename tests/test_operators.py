"""What the measurements of the study operators rest on: sums against transforms, double loops, time steps."""
import re
from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from continuum.fluid import ConstEta, IdealGas
from continuum.scene import RayleighBenard
from particles.fields import kinetic
from particles.integral.dih import Dih, Flow, NestedFluxes, carried, take
from particles.integral.edge_makers import MAKERS, plain, printed, renormalised
from particles.integral.interpolants import Exponential, Gaussian, W
from particles.integral.points import jittered, lattice
from particles.limits import limit_of
from particles.run import Plan, run
from particles.threads import Team
from particles.weights import Lucy, WendlandC2
from studies.build.fixed import SCHEMES, fluid
from studies.kit.table import Tables
from studies.operators.cases import SHARES
from studies.operators.claims import CLAIMS
from studies.operators.claims.scheme import STILL, smallest_share
from studies.operators.derive import extrapolated
from studies.operators.equations import PRINTED, arriving, derivative
from studies.operators.exchange import kept, one_kernel, viscosities
from studies.operators.lattice import (
    around,
    epstein,
    gradient_symbol,
    line_weight,
    shells,
    slopes,
    spread_symbol,
    twice_symbol,
)
from studies.operators.printed import brackets, force, heat, inner, kernel, mass_rate, stream
from studies.operators.stability import LayerGrowth, euler_limit, jacobian, linear_rate, sound, zigzag
from studies.operators.weights import interpolated, smoothed

#: of RR98; 20, 22-25 and 42-44 are of noise, 39, 41 and 46-50 of motion, 45 of ordering
EQUATIONS = {*range(1, 20), 21, *range(26, 39), 40, 51}


# --- weights ------------------------------------------------------------------------------------------------------------


def test_transforms_of_gaussian_and_exponential_weights_are_the_known_ones():
    """exp(-(k r0)^2/2) in any dimension; 1/(1 + k^2 r0^2) on a line, arctan(k r0)/(k r0) in space."""
    k, r0 = 1.3, 0.7
    for d in (1, 2, 3):
        assert smoothed(Gaussian(r0, d), d, k).value == pytest.approx(np.exp(-(k*r0)**2/2), rel=1e-10)
        assert interpolated(Gaussian(r0, d), d, k).value == pytest.approx(k*np.exp(-(k*r0)**2/2), rel=1e-10)
    assert smoothed(Exponential(r0, 1), 1, k).value == pytest.approx(1/(1 + (k*r0)**2), rel=1e-10)
    assert smoothed(Exponential(r0, 3), 3, k).value == pytest.approx(np.arctan(k*r0)/(k*r0), rel=1e-10)


def test_shells_count_lattice_points():
    x = np.stack(np.meshgrid(*[np.arange(-5, 6)]*3), axis=-1).reshape(-1, 3)
    assert np.array_equal(shells(3, 25), np.bincount((x**2).sum(axis=1))[:26])
    at = around(4.5, 3)
    there = ((x**2).sum(axis=1) > 0) & ((x**2).sum(axis=1) <= 4.5**2)
    assert at.number.sum() == there.sum()
    assert at.number@at.x**2 == (x[there, 0]**2).sum()


def test_epsteins_zeta_function_is_the_known_one():
    """Z(s) = 4 zeta(s/2) beta(s/2) in the plane, from alternating series; in space what is left of a sum less its integral."""
    n = np.arange(1, 200001)
    series = [np.cumsum((-1.0)**(n + 1)/np.sqrt(base))[-2:].mean() for base in (n, 2*n - 1)]     # half way between two sums
    assert epstein(1, 2) == pytest.approx(4*series[0]/(1 - np.sqrt(2))*series[1], rel=1e-5)
    count, m = shells(3, 3600)[1:], np.arange(1, 3601)
    # a soft end, exp(-r^2/b^2), whose integral is 4 pi b sqrt(pi)/2; what is left of it is of order 1/b^2
    found = [count@(np.exp(-m/b**2)/m) - 2*np.pi**1.5*b for b in (7.0, 14.0)]
    assert epstein(2, 3) == pytest.approx((4*found[1] - found[0])/3, rel=1e-3)


@pytest.mark.parametrize("d", [1, 2, 3])
def test_lattice_sums_are_those_of_the_edges(d):
    """Symbols and moments from one point's neighbours against the matrices of the makers."""
    h, n = 2.5, (16, 6, 6)[:d]
    at, weight, k = lattice(n), Lucy.of(h=h, d=d), 2*np.pi*3/16
    near, wave, middle = around(h, d), np.exp(1j*k*lattice(n).x[:, 0]), 0
    for make, w in ((plain, W(weight, near.r)), (printed, line_weight(weight, d, near.r))):
        edges = make(at, weight)
        symbol = (edges.G[0]@wave)[middle]/wave[middle]/1j/k
        assert symbol.real == pytest.approx(gradient_symbol(w, near, k), rel=1e-12)
        assert edges.linear[middle, 0, 0] == pytest.approx(float(near.number@(w*near.r))/d, rel=1e-12)
        spread = -(edges.laplacian@wave)[middle]/wave[middle]/k**2
        assert spread.real == pytest.approx(spread_symbol(w, near, k), rel=1e-12)
        nested = (edges.div(edges.grad(wave.real))@wave.real)/(wave.real@wave.real)/k**2
        assert -nested == pytest.approx(twice_symbol(slopes(w, near, 16), k), rel=1e-12)


def test_the_printed_exponential_weight_is_the_slope_of_its_interpolant():
    """[Eqs 3, 4, 30, 31]: W = (2/r^3 + 1/r^2) e^-r/4 pi in units of r0, of f = e^-r/(4 pi r^2), by central differences."""
    r, step, weight = np.linspace(0.3, 5, 20), 1e-5, Exponential(1.0, 3)
    as_printed = (2/r**3 + 1/r**2)*np.exp(-r)/(4*np.pi)
    f = [np.exp(-x)/(4*np.pi*x*x) for x in (r - step, r + step)]
    np.testing.assert_allclose((f[0] - f[1])/(2*step), as_printed, rtol=1e-6)
    np.testing.assert_allclose(W(weight, r), as_printed, rtol=1e-12)


# --- sums written out -----------------------------------------------------------------------------------------------------


def test_literal_sums_are_those_of_the_code():
    """Eqs 34-38 as matrices of W e against the exchange over edges, on points where nothing cancels."""
    at = jittered((8, 9), 0.2, 1)
    edges = renormalised(at, WendlandC2.of(h=2.7))
    rng = np.random.default_rng(2)
    v, T = rng.normal(size=(at.n, 2)), rng.uniform(0.9, 1.1, at.n)
    dih = Dih(edges=edges, eos=IdealGas(), law=ConstEta(0.3, 0.4), zeta=0.1, transport=PRINTED)
    w, flow = brackets(edges), dih.flow(dih.state(rng.uniform(0.9, 1.1, at.n), v, T))
    found = np.empty((4, at.n))
    dih.rates(dih.state(flow.rho, v, T), found)
    np.testing.assert_allclose(mass_rate(w, flow.rho, v), found[0], rtol=0, atol=1e-12)
    friction = arriving(edges, PRINTED.fluxes(dih, flow).momentum)
    np.testing.assert_allclose(force(w, kernel(inner(w, v), 0.3, 0.1, 1.0)), friction, rtol=0, atol=1e-12)
    conduction = arriving(edges, PRINTED.fluxes(dih, flow._replace(v=0*v)).energy)
    np.testing.assert_allclose(heat(w, 0.4*inner(w, T[:, None])[:, :, 0]), conduction, rtol=0, atol=1e-12)


def test_brackets_are_weights_times_directions():
    """W(r_ij) e_ij with e_ij from j to i [Eq. 33], by a double loop."""
    at, weight = jittered((6, 6), 0.2, 4), Lucy.of(h=2.4)
    w = brackets(plain(at, weight))
    expected = np.zeros((2, at.n, at.n))
    for i in range(at.n):
        for j in range(at.n):
            apart = -at.separation(i, j)
            r = np.sqrt(apart@apart)
            if 0 < r < 2.4:
                expected[:, i, j] = W(weight, np.array([r]))[0]*at.V[j]*apart/r
    for M, there in zip(w, expected, strict=True):
        np.testing.assert_allclose(M.toarray(), there, rtol=0, atol=1e-15)


def test_spectral_derivatives_are_exact():
    x = lattice((12, 12), 1/12).x
    f = np.sin(2*np.pi*(x[:, 0] + 2*x[:, 1]) + 0.3)
    slope = 2*np.pi*np.cos(2*np.pi*(x[:, 0] + 2*x[:, 1]) + 0.3)
    np.testing.assert_allclose(derivative(f, 1, 12), 2*slope, rtol=0, atol=1e-12)
    np.testing.assert_allclose(derivative(f, 0, 12), slope, rtol=0, atol=1e-12)


# --- stability --------------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("maker", ["plain", "delaunay"])
def test_the_matrix_of_sound_is_that_of_the_rates(maker):
    """d/dt of energy and momentum at rest, by differences of the scheme, inviscid gas: e' is P', P' enters without c."""
    at = jittered((7, 7), 0.2, 5)
    edges = MAKERS[maker](at, WendlandC2.of(h=2.7))
    dih = Dih(edges=edges, eos=IdealGas(), law=ConstEta(0.0, 0.0))
    rest = dih.state(np.ones(at.n), np.zeros((at.n, 2)), np.ones(at.n))
    root, c, shape = np.sqrt(edges.V), np.sqrt(2), np.random.default_rng(0).normal(size=(3, at.n))
    found = sum(linear_rate(dih, rest, row, f) for row, f in ((3, shape[0]), (1, shape[1]), (2, shape[2])))
    scaled = np.concatenate([root*q for q in (shape[0]/c, shape[1], shape[2])])
    expected = c*sound(edges)@scaled
    np.testing.assert_allclose(np.concatenate([root*found[3]/c, root*found[1], root*found[2]]), expected, rtol=0, atol=1e-7)


def test_euler_limit_is_where_a_wave_begins_to_grow():
    """A damped wave -g +- i w: |1 + lambda dt| = 1 at 2 g/(g^2 + w^2)."""
    waves = np.array([-0.1 + 1j, -0.1 - 1j, -3.0, 0.0])
    dt = euler_limit(waves)
    assert dt == pytest.approx(0.2/1.01, rel=1e-12)
    assert abs(1 + waves[0]*dt*1.001) > 1 > abs(1 + waves[0]*dt*0.999)
    assert euler_limit(np.array([0.1 + 1j])) == 0


# --- exchange --------------------------------------------------------------------------------------------------------------


def test_uniform_streams_stay_on_edges_that_close_alone():
    at, weight = jittered((8, 9), 0.3, 1), WendlandC2.of(h=2.7)
    assert kept(MAKERS["delaunay"](at, weight), NestedFluxes())["uniform"] < 1e-13
    assert kept(MAKERS["plain"](at, weight), NestedFluxes())["uniform"] > 0.1
    assert one_kernel(MAKERS["plain"](at, weight), 1) > 1e-4


@pytest.mark.parametrize("make", [plain, renormalised])
def test_a_uniform_stream_does_no_work_of_pressure_on_any_points(make):
    """[Eq. 36]: P_ij v_i, not P_i v_i; edges that do not close push the fluid, and the work is that of the push."""
    edges = make(jittered((10, 12), 0.3, 2), WendlandC2.of(h=2.7))
    rho, T = np.random.default_rng(2).uniform(0.5, 1.5, (2, edges.n))
    U = np.array([0.6, 0.8])
    flow = Flow(rho, np.ones((edges.n, 1))*U, T, np.zeros(edges.n), rho*T)      # no energy to carry
    still = flow._replace(v=0*flow.v)
    stream, rest = (carried(IdealGas(), edges.S, take(one, edges.i), take(one, edges.j)) for one in (flow, still))
    push = arriving(edges, rest.momentum)@U
    assert np.abs(arriving(edges, stream.energy) - push).max() < 1e-14 < 0.01 < np.abs(push).max()


def test_differences_in_the_inner_sum_mend_nested_transport_on_any_points():
    """[Eqs 37, 38]: no friction in a uniform stream, no heat at uniform temperature, the same both ways, nothing grows."""
    edges = renormalised(jittered((10, 10), 0.3, 1), WendlandC2.of(h=3.0))
    mended, as_printed = (stream(edges, NestedFluxes(differences=differences)) for differences in (True, False))
    assert max(mended[name] for name in ("force", "heat", "asymmetry")) < 1e-13
    assert mended["growth"] < 1e-13
    assert min(as_printed[name] for name in ("force", "heat", "asymmetry")) > 0.01


def test_viscosities_of_central_forces_are_cauchys():
    """B = 0: shear, compression and the rest in Cauchy's proportion, eta and zeta = 2 eta/d + ... = (2/d) eta + eta (1 - ...)."""
    for d in (2, 3):
        eta, bulk = viscosities(d, 1.0, 0.0)
        # waves along and across k decay as 3 to 1: 2 eta (1 - 1/d) + zeta = 3 eta
        assert 2*eta*(1 - 1/d) + bulk == pytest.approx(3*eta, rel=1e-14)
        eta, bulk = viscosities(d, 0.0, 1.0)
        assert 2*eta*(1 - 1/d) + bulk == pytest.approx(eta, rel=1e-14)      # B alone: a plain Laplacian


def test_limits_are_extrapolated_in_the_square_of_the_spacing():
    a = np.array([1/16, 1/32, 1/64])
    found = extrapolated(a, 2 + 3*a**2)
    assert found.value == pytest.approx(2, rel=1e-13) and found.err < 1e-13
    bent = extrapolated(a, 2 + 3*a**2 + 50*a**4)
    assert abs(bent.value - 2) < bent.err


# --- the layer between plates -----------------------------------------------------------------------------------------


def growth(**more):
    case = LayerGrowth(**{"h": 2.0, "rows": 8, "ra": 1500.0, "share": 1.0, **more})
    return case.run(lambda done: None, Path()).rows["nested_growth"][0]


def test_what_eigenvalues_say_time_steps_show():
    """h = 2 a, nested only: a disturbance grows at the rate of the fastest mode once it is alone."""
    scene = RayleighBenard(ra=1500.0, L=8.0, aspect=1.0)
    method = fluid(scene, SCHEMES["fixed-lattice"]._replace(share=0.0))
    noise = 1e-7*np.random.default_rng(0).normal(size=method.x.shape)
    state = method.state(1.0, noise, scene.T(method.x[:, 1]))
    expected = growth(share=0.0)["growth"]*np.sqrt(2)
    dt = 0.5*limit_of(method, state)
    steps = round(12/expected/dt)
    done = run(method, state, Plan(dt=dt, steps=steps, series={"ke": kinetic}, every=steps//40))
    rate = np.polyfit(np.array(done.times)[-10:], np.log(done.series["ke"])[-10:], 1)[0]/2
    assert rate == pytest.approx(expected, rel=0.05)       # other modes are left after 12 growth times


def test_transport_along_edges_keeps_a_lattice_at_rest():
    assert growth()["growth"] < STILL < 1e-3 < growth(share=0.0)["growth"]


def test_the_derivative_is_one():
    scene = RayleighBenard(ra=1500.0, L=8.0, aspect=1.0)
    method = fluid(scene, SCHEMES["fixed-lattice"])
    state = method.state(1.0, np.zeros_like(method.x), scene.T(method.x[:, 1]))
    sums = method.start(state.shape[1], Team(1))
    change = np.random.default_rng(1).normal(size=state.shape)*1e-4
    up, down = np.empty_like(state), np.empty_like(state)
    sums.rates(state + change, up)
    sums.rates(state - change, down)
    linear = (jacobian(sums, state)@change.ravel()).reshape(state.shape)
    assert np.abs((up - down)/2 - linear).max() < 1e-6*np.abs(linear).max()     # third order of 1e-4


def test_zigzags_differ_from_long_waves():
    fields = np.zeros((4, 8, 8))
    fields[0] = np.cos(2*np.pi*np.arange(8)/8)
    assert zigzag(fields.ravel(), 8) == pytest.approx(0, abs=1e-12)
    fields[0] = (-1.0)**np.arange(8)
    assert zigzag(fields.ravel(), 8) == pytest.approx(1)


def test_the_smallest_share_is_the_one_from_which_on_nothing_grows():
    rows = [{"h": 2.0, "share": share, "growth": 1e-3 if share < 0.1 else 1e-15} for share in SHARES]
    assert smallest_share(Tables({"nested_growth": pd.DataFrame(rows)})) == pytest.approx((0.1, 0.03))


# --- claims -----------------------------------------------------------------------------------------------------------


def test_claims_cover_the_equations_of_the_study():
    assert EQUATIONS <= {n for claim in CLAIMS for n in numbers(claim.source)}


def numbers(source: str) -> set[int]:
    """Equations of a citation: single ones and ranges."""
    singles = {int(n) for n in re.findall(r"\b\d+\b", source.removeprefix("RR98"))}
    ranges = (range(int(low), int(high) + 1) for low, high in re.findall(r"(\d+)-(\d+)", source))
    return singles.union(*ranges)
