"""Edges of every maker: antisymmetry, closure, linear exactness, skewness where they are claimed."""
import warnings

import numpy as np
import pytest

from particles.integral.edge_makers import MAKERS, plain, printed, renormalised
from particles.integral.interpolants import Exponential, Gaussian, OrderingWarning, W, f, moment, reach
from particles.integral.points import jittered, lattice, of_positions, pairs, random, relaxed
from particles.integral.triangulation import between, delaunay
from particles.weights import WEIGHTS, Lucy, WendlandC2

COUNTS = {1: (20,), 2: (10, 12), 3: (6, 6, 7)}
CLOSE = ("closed", "exact", "delaunay")
LINEAR = ("exact", "delaunay")


def points(kind: str, d: int):
    counts = COUNTS[d]
    return {"lattice": lambda: lattice(counts), "jittered": lambda: jittered(counts, 0.2, 1),
            "random": lambda: random(counts, 0.5, 2)}[kind]()


def make(name: str, at):
    return MAKERS[name](at, WendlandC2.of(h=2.7 if at.d < 3 else 2.2, d=at.d))


CASES = [(name, kind, d) for name in MAKERS for kind in ("lattice", "jittered", "random") for d in (1, 2, 3)
         if not (name == "delaunay" and (d == 1 or (d == 3 and kind == "lattice")))]


@pytest.mark.parametrize(("name", "kind", "d"), CASES)
def test_exchange_conserves_and_sees_no_gradient_in_a_constant(name, kind, d):
    edges = make(name, points(kind, d))
    F = np.random.default_rng(0).normal(size=(edges.n, d))
    size = np.abs(edges.S).sum()
    assert abs((edges.V*edges.div(F)).sum()) < 1e-13*size
    assert np.abs(edges.grad(np.ones(edges.n))).max()*edges.V.min() < 1e-12*size/edges.n
    assert abs((edges.V*edges.lap(F[:, 0])).sum()) < 1e-13*edges.k.sum()
    for D, G in zip(edges.D, edges.G, strict=True):
        assert np.abs(D + G.T).max() < 1e-15*size


@pytest.mark.parametrize(("name", "kind", "d"), [c for c in CASES if c[0] in CLOSE])
def test_edges_close(name, kind, d):
    edges = make(name, points(kind, d))
    # solves with a condition number of some 1e3
    assert np.abs(edges.closure).max() < 1e-11*np.abs(edges.S).max()


@pytest.mark.parametrize(("name", "kind", "d"), [c for c in CASES if c[0] in LINEAR])
def test_edges_are_exact_on_linear_fields(name, kind, d):
    edges = make(name, points(kind, d))
    assert np.abs(edges.linear - np.eye(d)).max() < 1e-10


@pytest.mark.parametrize("d", [2, 3])
def test_equation_29_multiplies_gradients_by_its_predicted_factor(d):
    """Summed over a lattice it is int |S_d| r^(d-1) a^(1-d) W r dV/d = (|S_d|/d) M_d (r0/a)^(d-1): 4 pi/3
    M_3 (r0/a)^2 in 3D."""
    at = lattice((48, 48) if d == 2 else (14, 14, 14))
    weight = Lucy.of(h=6.0, d=d)
    factor = renormalised(at, weight).linear[0, 0, 0]/1.0
    measured = printed(at, weight).linear[0, 0, 0]/factor
    predicted = 2*np.pi**(d/2)/{2: 1.0, 3: np.pi**0.5/2}[d]*moment(weight, d, d)*6.0**(d - 1)/d
    assert measured == pytest.approx(predicted, rel=0.02)


@pytest.mark.parametrize("d", [1, 2, 3])
@pytest.mark.parametrize("kind", [*WEIGHTS.values(), Exponential, Gaussian])
def test_first_moment_is_the_dimension(kind, d):
    weight = kind.of(h=1.7, d=d) if hasattr(kind, "of") else kind(0.6, d)
    assert moment(weight, 1, d) == pytest.approx(d, rel=1e-9)
    r = np.linspace(0.05, min(1.6, reach(weight)), 7)
    # W = -f' by central differences: h^2 f''' is 1e-8 of f'
    slope = (f(weight, r + 1e-5) - f(weight, r - 1e-5))/2e-5
    np.testing.assert_allclose(W(weight, r), -slope, rtol=1e-5, atol=1e-8)


def test_a_weight_of_another_dimension_is_refused():
    with pytest.raises(ValueError, match=r"M_1 = .* which must be 2"):
        plain(lattice((10, 10)), Lucy.of(h=2.0, d=3))


@pytest.mark.parametrize(("maker", "size", "off"),
                         [("plain", 0, "48.8"), ("printed", 0, "222"), ("renormalised", 0.3, "57")])
def test_a_weight_narrower_than_the_spacing_is_told_with_its_error(maker, size, off):
    """Lucy of range 1.2 a has the rms width 0.507 a, and 2 W(a) = 0.512; Eq. 29 has 2 pi times as much."""
    at = jittered((12, 12), size, 1) if size else lattice((12, 12))
    with pytest.warns(OrderingWarning,
                      match=rf"r0 = 0\.507 .* below the spacing 1, the left side of Eq\. 45: .* by {off}"):
        MAKERS[maker](at, Lucy.of(h=1.2))


def test_no_warning_where_linear_fields_are_exact_or_the_order_holds():
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        for maker, at, h in (("renormalised", lattice((12, 12)), 1.2),
                             ("plain", jittered((12, 12), 0.3, 1), 3.0),
                             ("exact", jittered((12, 12), 0.2, 1), 2.3)):
            MAKERS[maker](at, Lucy.of(h=h))


def test_overlapping_points_and_points_outside_are_refused():
    at = lattice((6, 6))
    twice = at.x.copy()
    twice[7] = twice[8]
    with pytest.raises(ValueError, match="points 7 and 8 overlap"):
        pairs(of_positions(twice, at.box), 2.0)
    for value, words in ((9.0, "point 3 .* outside"),
                         (np.nan, "point 3 at .* is outside of the box")):
        far = at.x.copy()
        far[3, 1] = value
        with pytest.raises(ValueError, match=words):
            of_positions(far, at.box)


@pytest.mark.parametrize("apart", [0.0, 1e-8])
@pytest.mark.parametrize("kind", ["lattice", "jittered"])
def test_triangles_of_overlapping_points_name_both(kind, apart):
    at = lattice((10, 10)) if kind == "lattice" else jittered((10, 10), 0.3, 1)
    twice = at.x.copy()
    twice[7] = twice[8] + apart
    with pytest.raises(ValueError, match=r"points 7 and 8 overlap at .* move one"):
        delaunay(of_positions(twice, at.box))


TWO_PARTS = of_positions(np.concatenate([lattice((3, 3)).x - 6, lattice((3, 3)).x + 6]), (24.0, 24.0))


@pytest.mark.parametrize(("maker", "at", "weight", "words"), [
    ("plain", lattice((10, 10)), Exponential(-1.0, 2),
     r"of Exponential must be positive and finite, got \S+: Eq\. 45"),
    ("plain", lattice((10, 10)), Gaussian(np.nan, 2), "of Gaussian must be positive and finite, got nan"),
    ("exact", jittered((10, 10), 0.3, 1), Lucy.of(h=1.2),
     "the best miss by nan: take a wider weight"),
    ("delaunay", lattice((6, 6, 6)), None, "flat simplex"),
    ("closed", TWO_PARTS, WendlandC2.of(h=2.0), "2 parts"),
    ("renormalised", lattice((6, 6)), Lucy.of(h=0.9),
     r"no two of the 36 points, .* the weight's range 0\.9: .*Eq\. 45")])
def test_points_without_edges_say_why(maker, at, weight, words):
    with pytest.raises((ValueError, ArithmeticError), match=words):
        MAKERS[maker](at, weight)


def test_relaxed_points_are_regular_but_no_lattice():
    weight = WendlandC2.of(h=3.0)
    at = relaxed(random((10, 10), 0.5, 3), weight)
    # 2 c V^2 with a |c| < 2e-3, a component at most, times what renormalising adds
    assert np.abs(renormalised(at, weight).closure).max() < 5e-3
    nearest = np.sort(np.hypot(*(at.x[:, None] - at.x).T), axis=0)[1]
    assert np.ptp(nearest) > 0.02       # of a lattice 0


def between_plates_of(seed: int = 1, rows: int = 9, columns: int = 12):
    """Points on both plates and at random between them."""
    row = np.stack([np.arange(columns) + 0.5 - columns/2, np.full(columns, -rows/2)], axis=1)
    inner = random((columns, rows - 1), 0.5, seed).x
    inner[:, 1] *= 0.9
    return np.concatenate([row, row*[1, -1], inner]), columns, rows


def test_triangles_between_plates_are_exact_inside_and_lack_half_the_plate_beside_a_point():
    x, width, height = between_plates_of()
    edges = between(x, width, height)
    lower, upper, inner = np.arange(width), np.arange(width, 2*width), np.arange(2*width, len(x))
    assert edges.V.sum() == pytest.approx(width*height, rel=1e-12)
    assert np.abs(edges.closure[inner]).max() < 1e-12 and np.abs(edges.linear[inner]
                                                                 - np.eye(2)).max() < 1e-11
    # plate points are one spacing apart: sum_j S_ij is minus the outward normal
    assert edges.closure[lower] == pytest.approx(np.tile([0.0, 1.0], (width, 1)), abs=1e-12)
    assert edges.closure[upper] == pytest.approx(np.tile([0.0, -1.0], (width, 1)), abs=1e-12)


def test_triangles_between_plates_need_points_on_them():
    x, width, height = between_plates_of()
    with pytest.raises(ValueError, match="row of points on each plate"):
        between(x[2*width:], width, height)
