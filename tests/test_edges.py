"""Edges of every maker and those to images beyond plates: adjoints, closure, exactness, refusals."""
import warnings

import numpy as np
import pytest
from scipy import sparse

from particles.integral.edge_makers import MAKERS, renormalised
from particles.integral.edges import MIRROR, between_plates
from particles.integral.interpolants import Exponential, Gaussian, OrderingWarning, W, f, moment, reach
from particles.integral.points import jittered, lattice, of_positions, pairs, random, relaxed
from particles.integral.triangulation import between, delaunay
from particles.weights import WEIGHTS, Lucy, WendlandC2

COUNTS = {1: (20,), 2: (10, 12), 3: (6, 6, 7)}
CLOSE = ("closed", "exact", "delaunay")
LINEAR = ("exact", "delaunay")


POINTS = {"lattice": lattice, "jittered": lambda counts: jittered(counts, 0.2, 1),
          "random": lambda counts: random(counts, 0.5, 2)}


def make(name: str, kind: str, d: int):
    """Edges of a maker on points in d dimensions."""
    return MAKERS[name](POINTS[kind](COUNTS[d]), WendlandC2.of(h=2.7 if d < 3 else 2.2, d=d))


CASES = [(name, kind, d) for name in MAKERS for kind in POINTS for d in (1, 2, 3)
         if not (name == "delaunay" and (d == 1 or (d == 3 and kind == "lattice")))]


@pytest.mark.parametrize(("name", "kind", "d"), CASES)
def test_exchange_conserves_and_edges_are_as_good_as_claimed(name, kind, d):
    """Gradients are minus the adjoint of the divergence, zero of a constant, exact where that is claimed."""
    edges = make(name, kind, d)
    F = np.random.default_rng(0).normal(size=(edges.n, d))
    size = np.abs(edges.S).sum()
    assert abs(sum((D@f).sum() for D, f in zip(edges.D, F.T, strict=True))) < 1e-13*size
    assert max(np.abs(G@np.ones(edges.n)/edges.V).max() for G in edges.G)*edges.V.min() < 1e-12*size/edges.n
    assert abs((edges.laplacian@F[:, 0]).sum()) < 1e-13*edges.k.sum()
    for D, G in zip(edges.D, edges.G, strict=True):
        assert np.abs(D + G.T).max() < 1e-15*size
    if name in CLOSE:       # solves with a condition number of some 1e3
        assert np.abs(edges.closure).max() < 1e-11*np.abs(edges.S).max()
    if name in LINEAR:
        assert np.abs(edges.linear - np.eye(d)).max() < 1e-10


@pytest.mark.parametrize("d", [1, 2, 3])
@pytest.mark.parametrize("kind", [*WEIGHTS.values(), Exponential, Gaussian])
def test_first_moment_is_the_dimension(kind, d):
    weight = kind.of(h=1.7, d=d) if hasattr(kind, "of") else kind(0.6, d)
    assert moment(weight, 1, d) == pytest.approx(d, rel=1e-9)
    r = np.linspace(0.05, min(1.6, reach(weight)), 7)
    # W = -f' by central differences: h^2 f''' is 1e-8 of f'
    slope = (f(weight, r + 1e-5) - f(weight, r - 1e-5))/2e-5
    np.testing.assert_allclose(W(weight, r), -slope, rtol=1e-5, atol=1e-8)


@pytest.mark.parametrize(("maker", "size", "off"),
                         [("plain", 0, "48.8"), ("printed", 0, "222"), ("renormalised", 0.3, "57")])
def test_a_weight_narrower_than_the_spacing_is_told_with_its_error(maker, size, off):
    """Lucy of range 1.2 a has the rms width 0.507 a, and 2 W(a) = 0.512; Eq. 29 has 2 pi times as much."""
    at = jittered((12, 12), size, 1) if size else lattice((12, 12))
    with pytest.warns(OrderingWarning,
                      match=rf"r0 = 0\.507 .* below the spacing 1, the left side of Eq\. 45: .* by {off}"):
        MAKERS[maker](at, Lucy.of(h=1.2))


@pytest.mark.parametrize(("maker", "at", "h"), [
    ("renormalised", lattice((12, 12)), 1.2), ("plain", jittered((12, 12), 0.3, 1), 3.0),
    ("exact", jittered((12, 12), 0.2, 1), 2.3)])
def test_no_warning_where_linear_fields_are_exact_or_the_order_holds(maker, at, h):
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        MAKERS[maker](at, Lucy.of(h=h))


@pytest.mark.parametrize("neighbours, apart", [
    (delaunay, 0.0), (delaunay, 1e-8), (lambda points: pairs(points, 2.0), 0.0)])
@pytest.mark.parametrize("at", [lattice((10, 10)), jittered((10, 10), 0.3, 1)], ids=["lattice", "jittered"])
def test_overlapping_points_name_both(at, neighbours, apart):
    twice = at.x.copy()
    twice[7] = twice[8] + apart
    with pytest.raises(ValueError, match=r"points 7 and 8 overlap at .* move one"):
        neighbours(of_positions(twice, at.box))


@pytest.mark.parametrize("y", [9.0, np.nan])
def test_points_outside_are_refused(y):
    far = lattice((6, 6)).x
    far[3, 1] = y
    with pytest.raises(ValueError, match=r"point 3 at .* is outside of the box"):
        of_positions(far, (6, 6))


CLUSTER = lattice((3, 3)).x
TWO_PARTS = of_positions(np.concatenate([CLUSTER - 6, CLUSTER + 6]), (24.0, 24.0))


@pytest.mark.parametrize(("maker", "at", "weight", "words"), [
    ("plain", lattice((10, 10)), Exponential(-1.0, 2),
     r"of Exponential must be positive and finite, got \S+: Eq\. 45"),
    ("plain", lattice((10, 10)), Gaussian(np.nan, 2), "of Gaussian must be positive and finite, got nan"),
    ("plain", lattice((10, 10)), Lucy.of(h=2.0, d=3), r"M_1 = .* which must be 2"),
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


def test_triangles_between_plates_are_exact_inside_and_lack_half_the_plate_beside_a_point():
    columns, rows = 12, 9
    lower = np.stack([np.arange(columns) + 0.5 - columns/2, np.full(columns, -rows/2)], axis=1)
    inner = random((columns, rows - 1), 0.5, 1).x*[1, 0.9]
    edges = between(np.concatenate([lower, lower*[1, -1], inner]), columns, rows)
    assert edges.V.sum() == pytest.approx(columns*rows, rel=1e-12)
    assert np.abs(edges.closure[2*columns:]).max() < 1e-12
    assert np.abs(edges.linear[2*columns:] - np.eye(2)).max() < 1e-11
    # plate points are one spacing apart: sum_j S_ij is minus the outward normal
    normal = np.repeat([[0.0, 1.0], [0.0, -1.0]], columns, axis=0)
    assert edges.closure[:2*columns] == pytest.approx(normal, abs=1e-12)
    with pytest.raises(ValueError, match="row of points on each plate"):
        between(inner, columns, rows)


# --- beyond plates ----------------------------------------------------------------------------------

FEW = (7, 5)
CLOSED = [("renormalised", 0.0), ("closed", 0.2), ("exact", 0.2), ("delaunay", 0.2)]


def made(maker, size):
    """Points (n, 2), edges among them and to their images."""
    x = (jittered(FEW, size, 1) if size else lattice(FEW)).x.copy()
    x[:, 1] = np.clip(x[:, 1], -2.25, 2.25)
    return x, *between_plates(MAKERS[maker], x, *FEW, Lucy.of(h=2.4))


def with_images(matrices, beyond, own, image):
    """Matrices along x and y with S/2 times `own` at a point and S/2 times `image` (2,) at a parent."""
    n = matrices[0].shape[0]
    return [M + sparse.csr_array((S/2*own, (beyond.i, beyond.i)), shape=(n, n))
            + sparse.csr_array((S/2*s, (beyond.i, beyond.parent)), shape=(n, n))
            for M, S, s in zip(matrices, beyond.S.T, image, strict=True)]


@pytest.mark.parametrize(("maker", "size"), CLOSED)
def test_edges_close_with_those_to_images(maker, size):
    _, edges, beyond = made(maker, size)
    total = edges.closure.copy()
    np.add.at(total, beyond.i, beyond.S)
    assert np.abs(total).max() < 1e-12*np.abs(edges.S).max()       # measured 3e-15
    assert np.abs(edges.closure).max() > 0.1                        # it is the images that close them


@pytest.mark.parametrize(("maker", "size"), [CLOSED[0], *CLOSED[2:]])
def test_edges_are_exact_on_linear_fields_that_go_on_beyond_plates(maker, size):
    """Images continue a straight line across a plate: a field is odd about its value there."""
    x, edges, beyond = made(maker, size)
    total = edges.linear*edges.V[:, None, None]
    np.add.at(total, beyond.i, beyond.S[:, :, None]*beyond.apart[:, None, :]/2)
    assert np.abs(total/edges.V[:, None, None] - np.eye(2)).max() < 1e-10
    place = np.where(beyond.plate, 1, -1)*FEW[1] - x[beyond.parent, 1]
    assert x[beyond.i, 1] + beyond.apart[:, 1] == pytest.approx(place, abs=1e-12)


@pytest.mark.parametrize("size", [0.0, 0.2])
@pytest.mark.parametrize("maker", MAKERS)
@pytest.mark.filterwarnings("ignore::particles.integral.interpolants.OrderingWarning")
def test_divergence_with_images_is_minus_the_adjoint_of_the_gradient(maker, size):
    """Images have the signs m of `MIRROR` where a field is even, -m where it is odd, as friction sees it."""
    _, edges, beyond = made(maker, size)
    unit = np.abs(edges.S).max()
    for sign in (1, -1):
        G = with_images(edges.G, beyond, -1, [sign]*2)
        right, wrong = (with_images(edges.D, beyond, 1, s*MIRROR) for s in (sign, -sign))
        assert max(np.abs(D + g.T).max() for D, g in zip(right, G, strict=True)) < 1e-14*unit
        assert min(np.abs(D + g.T).max() for D, g in zip(wrong, G, strict=True)) > 0.1*unit


@pytest.mark.parametrize("at", [3.0, 2.5, -9.0, np.nan])
def test_points_that_are_not_between_plates_are_refused(at):
    x = lattice((5, 5)).x.copy()
    x[3, 1] = at
    with pytest.raises(ValueError, match=rf"point 3 at y = {at:g} is not between .*2\.5 \(1 of 25"):
        between_plates(renormalised, x, 5.0, 5.0, Lucy.of(h=2.0))


def test_what_a_maker_refuses_says_what_was_asked_for():
    x = lattice((5, 5)).x
    with pytest.raises(ValueError, match="reach") as found:
        between_plates(renormalised, x, 5.0, 5.0, Lucy.of(h=3.0))
    assert "point m + 25 that of point m" in found.value.__notes__[0]
