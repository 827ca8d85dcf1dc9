"""Edges to images beyond plates in 1D, 2D and 3D: they close, are exact, have an adjoint; bad input."""
import numpy as np
import pytest
from scipy import sparse

from particles.integral.edge_makers import MAKERS, renormalised
from particles.integral.edges import between_plates, mirror
from particles.integral.points import jittered, lattice
from particles.integral.triangulation import delaunay
from particles.weights import Lucy

COUNTS = {1: (12,), 3: (4, 5, 6)}
RANGE = {1: 2.6, 3: 1.95}                 # below half of the narrowest side
CLOSE = [("renormalised", 0.0), ("closed", 0.2), ("exact", 0.2)]
SETS = [(d, maker, size) for d in COUNTS for maker, size in CLOSE]
ALL = pytest.mark.parametrize(("d", "maker", "size"), SETS)


def made(d, maker, size, counts=None):
    """Points (n, d), edges among them and to their images."""
    counts = counts or COUNTS[d]
    at = jittered(counts, size, 1) if size else lattice(counts)
    x = at.x.copy()
    x[:, -1] = np.clip(x[:, -1], -counts[-1]/2 + 0.25, counts[-1]/2 - 0.25)
    return x, *between_plates(MAKERS[maker], x, counts[:-1], float(counts[-1]), Lucy.of(h=RANGE[d], d=d))


def with_images(matrices, beyond, own, image):
    """By direction the matrix among points, S/2 times `own` at the point, `image` (d,) at the parent."""
    n = matrices[0].shape[0]
    return [M + sparse.csr_array((S/2*own, (beyond.i, beyond.i)), shape=(n, n))
            + sparse.csr_array((S/2*s, (beyond.i, beyond.parent)), shape=(n, n))
            for M, S, s in zip(matrices, beyond.S.T, image, strict=True)]


@ALL
def test_edges_close_with_those_to_images(d, maker, size):
    _, edges, beyond = made(d, maker, size)
    total = edges.closure.copy()
    np.add.at(total, beyond.i, beyond.S)
    assert np.abs(total).max() < 1e-12*np.abs(edges.S).max()       # measured 3e-15
    assert np.abs(edges.closure).max() > 0.1                        # it is the images that close them


@pytest.mark.parametrize(("d", "maker", "size"),
                         [(d, *kind) for d in COUNTS for kind in (CLOSE[0], CLOSE[2])])
def test_edges_are_exact_on_linear_fields_that_go_on_beyond_plates(d, maker, size):
    """A field across a plate is odd about its value there: images continue the straight line."""
    x, edges, beyond = made(d, maker, size)
    total = edges.linear*edges.V[:, None, None]
    np.add.at(total, beyond.i, beyond.S[:, :, None]*beyond.apart[:, None, :]/2)
    assert np.abs(total/edges.V[:, None, None] - np.eye(d)).max() < 1e-10
    place = np.where(beyond.plate, 1, -1)*COUNTS[d][-1] - x[beyond.parent, -1]
    assert x[beyond.i, -1] + beyond.apart[:, -1] == pytest.approx(place, abs=1e-12)


@pytest.mark.parametrize("size", [0.0, 0.2])
@pytest.mark.parametrize("maker", [name for name in MAKERS if name != "delaunay"])
@pytest.mark.parametrize("d", COUNTS)
@pytest.mark.filterwarnings("ignore::particles.integral.interpolants.OrderingWarning")
def test_divergence_with_images_is_minus_the_adjoint_of_the_gradient(d, maker, size):
    """Of what is even: with m for the signs; of what is odd, as friction sees it: with -m, and not m."""
    _, edges, beyond = made(d, maker, size)
    unit = np.abs(edges.S).max()
    for sign in (1, -1):
        G = with_images(edges.G, beyond, -1, [sign]*d)
        right, wrong = (with_images(edges.D, beyond, 1, s*mirror(d)) for s in (sign, -sign))
        assert max(np.abs(D + g.T).max() for D, g in zip(right, G, strict=True)) < 1e-14*unit
        assert min(np.abs(D + g.T).max() for D, g in zip(wrong, G, strict=True)) > 0.1*unit


@pytest.mark.parametrize(("d", "width", "wanted"), [(1, 5.0, r"\(\)"), (2, (5.0, 5.0), "a positive number"),
                                                    (2, (), "a positive number"),
                                                    (2, -5.0, "a positive number"),
                                                    (3, 5.0, "two positive numbers"),
                                                    (3, (5.0, 0.0), "two positive numbers"),
                                                    (3, (5.0, np.nan), "two positive numbers")])
def test_a_box_of_other_dimensions_is_refused(d, width, wanted):
    with pytest.raises(ValueError,
                       match=rf"wide, which must be {wanted} in {d}D: one for each axis along the plates"):
        between_plates(renormalised, lattice((5,)*d).x, width, 5.0, Lucy.of(h=2.0, d=d))


def test_points_without_an_axis_are_refused():
    with pytest.raises(ValueError, match=r"shape \(5,\), which must be \(n, d\).*x\[:, None\]"):
        between_plates(renormalised, np.arange(5.0), (), 5.0, Lucy.of(h=2.0, d=1))


@pytest.mark.parametrize(("d", "axis"), [(1, "x"), (3, "z")])
@pytest.mark.parametrize("at", [3.0, 2.5, -9.0, np.nan])
def test_points_that_are_not_between_plates_are_refused(d, axis, at):
    x = lattice((5,)*d).x.copy()
    x[3, -1] = at
    with pytest.raises(ValueError,
                       match=rf"point 3 at {axis} = {at:g} is not between the plates .*2\.5 \(1 of {5**d}"):
        between_plates(renormalised, x, (5.0,)*(d - 1), 5.0, Lucy.of(h=2.0, d=d))


@pytest.mark.parametrize(("d", "why"), [(1, "no triangles in one dimension"), (3, "span a flat simplex")])
def test_triangles_between_plates_are_of_2d_only_and_say_why(d, why):
    x = jittered((5,)*d, 0.1, 1).x
    with pytest.raises(ValueError, match=why) as found:
        between_plates(delaunay, x, (5.0,)*(d - 1), 5.0, None)
    assert ("only a weight makes edges in 3D" in found.value.__notes__[0]) == (d == 3)
    assert f"point m + {5**d} that of point m" in found.value.__notes__[0]
