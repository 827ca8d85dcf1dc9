"""The study operators: what its measurements rest on, a quick rebuild of its tables, and the committed verdicts."""
import re

import numpy as np
import pytest

import studies.operators.cases as operators
from continuum.fluid import ConstEta, IdealGas
from particles.integral.dih import Dih, Nested
from particles.integral.edge_makers import MAKERS, plain, printed, renormalised
from particles.integral.interpolants import Exponential, Gaussian, W
from particles.integral.points import jittered, lattice
from particles.weights import Lucy, WendlandC2
from studies.kit.claim import judge
from studies.kit.sweep import RESULTS, load
from studies.kit.table import Tables, read
from studies.operators import tables
from studies.operators.derive import extrapolated
from studies.operators.equations import PRINTED, arriving, derivative
from studies.operators.exchange import kept, viscosities, works
from studies.operators.printed import brackets, force, heat, inner, kernel, mass_rate
from studies.operators.stability import euler_limit, linear_rate, sound
from studies.operators.symbols import gradient_symbol, slopes, spread_symbol, twice_symbol
from studies.operators.weights import around, epstein, interpolated, line_weight, shells, smoothed
from studies.ordering import claims as ordering_claims

#: of RR98, with those of the study ordering; 20-25 and 42-44 are of fluctuations, 39-50 of motion and time
EQUATIONS = {*range(1, 20), *range(26, 39), 40, 51}


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


def test_uniform_streams_tell_edges_that_close_from_others():
    at, weight = jittered((8, 9), 0.3, 1), WendlandC2.of(h=2.7)
    assert kept(MAKERS["delaunay"](at, weight), Nested())["uniform"] < 1e-13
    assert kept(MAKERS["plain"](at, weight), Nested())["uniform"] > 0.1
    found = works(MAKERS["plain"](at, weight), 1)
    assert found["work"] < 1e-14 < 0.01 < min(found["own"], found["mass"])
    assert found["one_kernel"] > 1e-4


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


# --- the study ---------------------------------------------------------------------------------------------------------------


def test_quick_rebuild_writes_every_table(tmp_path):
    found = operators.STUDY.run("quick", workers=1, out=tmp_path)
    for table in tables.ALL:
        assert set(table.columns) <= set(found[table.name].columns) and len(found[table.name]), table.name
    assert len(operators.STUDY.draw(tmp_path)) == 4
    (tmp_path/"operators"/"equations.csv").unlink()
    assert len(operators.STUDY.draw(tmp_path)) == 3
    verdicts = {row["id"]: row["verdict"] for row in operators.STUDY.judge(tmp_path)}
    assert verdicts["rr98-eq34-36-conserved"] == verdicts["rr98-eq51-rotation-mended"] == "holds"
    assert verdicts["rr98-eq21-sign"] == verdicts["rr98-eq37-null"] == verdicts["rr98-eq16-trace-2d"] == "fails"


def test_without_tables_nothing_is_decided_but_arithmetic():
    rows = judge(operators.STUDY.claims, Tables(), "operators")
    assert {row["id"] for row in rows if row["verdict"] != "undecidable"} == {"rr98-eq31-slope"}


def test_claims_are_their_own_and_cover_the_equations():
    claims, others = operators.STUDY.claims, {claim.id for claim in ordering_claims.CLAIMS}
    assert not others & {claim.id for claim in claims}
    assert len({claim.statement for claim in claims}) == len(claims)
    assert EQUATIONS <= {n for claim in claims for n in numbers(claim.source)}


def numbers(source: str) -> set[int]:
    """Equations of a citation: single ones and ranges."""
    found = {int(n) for n in re.findall(r"\b\d+\b", source.removeprefix("RR98"))}
    for low, high in re.findall(r"(\d+)-(\d+)", source):
        found |= set(range(int(low), int(high) + 1))
    return found


@pytest.mark.skipif(not (RESULTS/"operators"/"orders.csv").exists(), reason="no tables are committed yet")
def test_committed_verdicts_follow_from_committed_tables():
    rows = {row["id"]: row["verdict"] for row in judge(operators.STUDY.claims, load(tables.ALL, "operators"), "operators")}
    kept_rows = read(RESULTS/"claims.csv")
    kept_rows = kept_rows[kept_rows["study"] == "operators"]
    assert dict(zip(kept_rows["id"], kept_rows["verdict"], strict=True)) == rows
