"""Neighbour lists hold exactly the points within reach, fields are sums over them; refusals."""
import numpy as np
import pytest
from crowd import prepare
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from scipy.spatial import cKDTree

from particles.neighbours import make_lists, sort_into_cells
from particles.observe import fields_at
from particles.threads import Threads
from particles.weights import value_and_slope
from tests.scenes import small


def listed(x, y, reach, threads=1, rows=None, side=None):
    """The set of neighbours of each of the first `rows` points."""
    rows = len(x) if rows is None else rows
    cells = sort_into_cells(x, y, reach/2 if side is None else side)
    start, length, near = make_lists(Threads(threads), cells, x[:rows], y[:rows], reach, 0)
    found = [near[int(s):int(s) + n] for s, n in zip(start, length)]
    assert all(len(set(row)) == len(row) for row in found)
    return [set(map(int, row)) for row in found]


def within(x, y, reach):
    """The same from a k-d tree; the last bit of the distance is decided as the lists do it."""
    points = np.stack([x, y], axis=1)
    near = cKDTree(points).query_ball_point(points, reach*(1 + 1e-9))
    return [{j for j in row if j != i and (x[j] - x[i])**2 + (y[j] - y[i])**2 < reach*reach}
            for i, row in enumerate(near)]


def scattered(seed, n):
    return np.random.default_rng(seed).uniform(-7, 7, (2, n))


def clustered(seed, n):
    rng = np.random.default_rng(seed)
    return rng.uniform(-7, 7, (2, 5))[:, rng.integers(0, 5, n)] + rng.normal(0, 0.3, (2, n))


def lattice(seed, n):
    # whole numbers: many distances equal the reach to the last bit, many points lie on the borders of cells
    side = int(np.sqrt(n))
    return np.stack([q.ravel() for q in np.meshgrid(np.arange(side), np.arange(side))]).astype(float)


@pytest.mark.parametrize("points", [scattered, clustered, lattice])
@pytest.mark.parametrize("reach", [1.0, 2.0, 3.6])
def test_lists_equal_those_of_a_tree(points, reach):
    x, y = points(1, 400)
    assert listed(x, y, reach) == within(x, y, reach)


@given(st.lists(st.tuples(st.floats(-20, 20), st.floats(-3, 3)), min_size=1, max_size=40), st.floats(0.5, 5))
@settings(max_examples=200, deadline=None, suppress_health_check=[HealthCheck.too_slow])
def test_lists_equal_those_of_a_tree_for_any_points(points, reach):
    x, y = np.array(points).T.copy()
    assert listed(x, y, reach) == within(x, y, reach)


def test_places_outside_of_all_points_have_their_neighbours():
    # fields are evaluated on grids that may reach beyond the particles, which may even have left a void
    x, y = scattered(4, 200)
    at = np.array([[-9.0, 9.0, 0.0, 0.0, -400.0, 7.5], [0.0, 0.0, -9.0, 60.0, 400.0, 7.5]])
    start, length, near = make_lists(Threads(), sort_into_cells(x, y, 1.5), at[0], at[1], 3.0, 1000)
    for i in range(at.shape[1]):
        d2 = (x - at[0, i])**2 + (y - at[1, i])**2
        assert sorted(near[int(start[i]):int(start[i]) + length[i]]) == np.flatnonzero(d2 < 9).tolist()
    assert length.min() == 0 < length.max()


def test_collapsed_particles_are_an_error():
    x, y = np.random.default_rng(7).uniform(-0.01, 0.01, (2, 2500))
    with pytest.raises(FloatingPointError, match="neighbours within 1 of each particle: they have collapsed"):
        listed(x, y, 1.0)


@pytest.mark.parametrize("far", [1e6, 1e300, np.inf, np.nan])
def test_far_flung_particles_are_an_error(far):
    x, y = scattered(8, 100)
    x[50] = far
    with pytest.raises(FloatingPointError, match="left the box; lower the step"):
        sort_into_cells(x, y, 1.0)


def test_fields_are_the_sums_of_the_paper():
    sums, state, _ = prepare(*small())
    sums.densities(state)
    x, y = np.array([0.3, -7.9, 4.0]), np.array([0.1, -3.9, 3.99])
    around, seen = sums.around, fields_at(sums, state, x, y)
    for k in range(3):
        r = np.hypot(around.x - x[k], around.y - y[k])
        w = np.array([value_and_slope(sums.method.weight, d)[0] for d in r])
        rho = w.sum()
        expected = (rho, w@around.vx/rho, w@around.vy/rho)
        # sums of some 30 terms in another order
        np.testing.assert_allclose([seen.rho[k], seen.vx[k], seen.vy[k]], expected, rtol=1e-13, atol=1e-15)
