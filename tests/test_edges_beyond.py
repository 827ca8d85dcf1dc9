"""Edges to images beyond plates: they close, are exact, have an adjoint; bad input."""
import numpy as np
import pytest
from scipy import sparse

from particles.integral.edge_makers import MAKERS, renormalised
from particles.integral.edges import MIRROR, between_plates
from particles.integral.points import jittered, lattice
from particles.weights import Lucy

COUNTS = (7, 5)
CLOSE = [("renormalised", 0.0), ("closed", 0.2), ("exact", 0.2), ("delaunay", 0.2)]


def made(maker, size):
    """Points (n, 2), edges among them and to their images."""
    x = (jittered(COUNTS, size, 1) if size else lattice(COUNTS)).x.copy()
    x[:, 1] = np.clip(x[:, 1], -2.25, 2.25)
    return x, *between_plates(MAKERS[maker], x, *COUNTS, Lucy.of(h=2.4))


def with_images(matrices, beyond, own, image):
    """By direction the matrix among points, S/2 times `own` at the point, `image` (2,) at the parent."""
    n = matrices[0].shape[0]
    return [M + sparse.csr_array((S/2*own, (beyond.i, beyond.i)), shape=(n, n))
            + sparse.csr_array((S/2*s, (beyond.i, beyond.parent)), shape=(n, n))
            for M, S, s in zip(matrices, beyond.S.T, image, strict=True)]


@pytest.mark.parametrize(("maker", "size"), CLOSE)
def test_edges_close_with_those_to_images(maker, size):
    _, edges, beyond = made(maker, size)
    total = edges.closure.copy()
    np.add.at(total, beyond.i, beyond.S)
    assert np.abs(total).max() < 1e-12*np.abs(edges.S).max()       # measured 3e-15
    assert np.abs(edges.closure).max() > 0.1                        # it is the images that close them


@pytest.mark.parametrize(("maker", "size"), [CLOSE[0], *CLOSE[2:]])
def test_edges_are_exact_on_linear_fields_that_go_on_beyond_plates(maker, size):
    """A field across a plate is odd about its value there: images continue the straight line."""
    x, edges, beyond = made(maker, size)
    total = edges.linear*edges.V[:, None, None]
    np.add.at(total, beyond.i, beyond.S[:, :, None]*beyond.apart[:, None, :]/2)
    assert np.abs(total/edges.V[:, None, None] - np.eye(2)).max() < 1e-10
    place = np.where(beyond.plate, 1, -1)*COUNTS[1] - x[beyond.parent, 1]
    assert x[beyond.i, 1] + beyond.apart[:, 1] == pytest.approx(place, abs=1e-12)


@pytest.mark.parametrize("size", [0.0, 0.2])
@pytest.mark.parametrize("maker", MAKERS)
@pytest.mark.filterwarnings("ignore::particles.integral.interpolants.OrderingWarning")
def test_divergence_with_images_is_minus_the_adjoint_of_the_gradient(maker, size):
    """Of what is even: with m for the signs; of what is odd, as friction sees it: with -m, and not m."""
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
