"""Edges evaluated once: they bring points what rows do one by one, whoever shares the work."""
from types import SimpleNamespace

import numpy as np
import pytest
from test_entropy_stable import closed, violent
from test_moving_stable import NAME as MOVING
from test_moving_stable import at_random

from continuum.scene import RayleighBenard
from particles.integral.entropy_fluxes import over_mean
from particles.integral.entropy_stable import StableLayer
from particles.integral.exchange import Listing
from particles.integral.lanes import COLUMNS, FIELDS, End, Point, end_at, read_lanes
from particles.integral.once import Sending, empty_once, fill_once
from particles.integral.points import random
from particles.integral.positive import Slopes
from particles.integral.triangulation import delaunay
from particles.pairs import Faces, sweep
from particles.threads import Threads
from studies.build import SCENES, ready

LAYERS = ("fixed-lattice-entropy-stable", "fixed-jittered-delaunay-entropy-stable")


def looked_at(method, state, threads=1):
    sums = method.start(state.shape[1], Threads(threads))
    sums.look_at(state)
    return sums


def half_violent(method):
    """Noise on one side, so that both ways to dissipate are taken."""
    calm, wild = violent(method, size=1e-9), violent(method)
    return np.where(method.x[:, 0] < 0, calm, wild)


def both_ways(sums, terms):
    """(What points gain, the same row by row)."""
    slopes, rows = np.zeros((sums.n, 8)), np.zeros((sums.n, 4))
    sweep(0, sums.n, Slopes(), sums.points, sums.edges, slopes)
    sums.sending.follow(sums.edges)
    sweep(0, sums.n, Listing(terms), sums.points, sums.edges, rows)
    return sums.sending.sum(sums.points, slopes), rows


@pytest.mark.parametrize("name", LAYERS)
def test_points_between_plates_gain_what_rows_bring(name):
    method = ready(RayleighBenard(ra=1e4, L=8.0), name).method
    for state in (half_violent(method), violent(method, size=0.01)):
        sums = looked_at(method, state)
        once, rows = both_ways(sums, (*method.transport, *method.flow))
        assert np.allclose(once, rows, rtol=0, atol=1e-13*np.abs(rows).max())


def test_points_that_move_gain_what_rows_bring():
    method = ready(SCENES["taylor-green"](8), MOVING).method
    sums = looked_at(method, at_random(method))
    once, rows = both_ways(sums, (*method.transport, *method.flow))
    assert np.allclose(once, rows, rtol=0, atol=1e-13*np.abs(rows).max())


def test_a_narrow_box_has_more_than_one_edge_between_two_points():
    points = random((3, 2), 0.2, 1)
    method = StableLayer(**{**vars(closed()), "x": points.x, "edges": delaunay(points)})
    sums = looked_at(method, violent(method))
    pairs = np.stack([method.edges.i, method.edges.j])
    assert np.unique(pairs, axis=1).shape[1] < pairs.shape[1]
    once, rows = both_ways(sums, (*method.transport, *method.flow))
    assert np.allclose(once, rows, rtol=0, atol=1e-13*np.abs(rows).max())


def test_an_edge_without_a_way_back_is_one_of_its_own():
    edges = Faces(np.array([0, 1], np.uint64), np.array([1, 1], np.uint32), np.array([1, 0], np.uint32),
                  np.array([0.5, -0.4]), *np.zeros((4, 2)))
    once = empty_once(2)
    assert fill_once(2, edges, once) == 2
    assert once.sign.tolist() == [1, 1] and once.sx[:2].tolist() == [0.5, -0.4]
    edges.sx[1] = -0.5
    assert fill_once(2, edges, once) == 1 and once.sign.tolist() == [1, -1]


@pytest.mark.parametrize("name", LAYERS)
def test_threads_change_no_bit(name):
    method = ready(RayleighBenard(ra=1e4, L=48.0), name).method
    state, rates = half_violent(method), []
    for threads in (1, 3):
        sums = looked_at(method, state, threads)
        assert sums.sending.blocks >= 64*threads      # else one thread takes all
        rates.append(np.empty_like(state))
        sums.rates(state, rates[-1])
        few = sums.sending.stirred.reshape(-1, 64).sum(axis=1)
        assert few.min() == 0 and few.max() > 32
    assert np.array_equal(*rates)


def test_means_are_right_to_rounding_whatever_the_ratio():
    ratios = np.exp(np.concatenate([np.linspace(-30, 30, 301), np.logspace(-15, 0, 61)]))
    for a in (1.0, 0.7, 3e5):
        b = a*ratios
        r = b.astype(np.longdouble)/np.longdouble(a)
        right = np.where(abs(r - 1) < 0.5, np.log1p(r - 1), np.log(r))*(r + 1)/(2*np.where(r == 1, 1, r - 1))
        means = np.array([over_mean(np.float64(a), one) for one in b])
        assert np.abs(means/np.where(r == 1, 1, right) - 1).max() < 1e-15
    with np.errstate(over="ignore"):        # of bits
        assert all(np.isnan(over_mean(*np.float64(pair))) for pair in ((np.nan, 1.0), (1.0, np.nan)))


def test_lanes_are_fields_of_points():
    draw = np.random.default_rng(4)
    lines, which = draw.normal(size=(50, len(Point.names))), draw.integers(0, 50, 128).astype(np.uint32)
    points, lanes = lines.view(Point)[:, 0], np.empty((int(COLUMNS), 64))
    read_lanes(lines, which, np.uint64(64), lanes)
    assert np.array_equal(lanes, [points[name][which[64:]] for name in FIELDS])
    end = end_at(lanes, 5, SimpleNamespace(eps=points["eps"][which[69]], g=points["g"][which[69]]))
    assert all(getattr(end, name) == points[name][which[69]] for name in End._fields)


def test_nothing_is_sent_where_nothing_is_listed():
    sums = looked_at(closed(), violent(closed()))
    sending = Sending((), (), sums.n, Threads(1))
    sending.follow(sums.edges)
    assert not sending.sum(sums.points, sums.slopes).any()
