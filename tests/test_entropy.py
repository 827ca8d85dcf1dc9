"""Entropy production of transport over edges: sums, signs, the continuum's    [RR98 Eqs 37, 38, 51]"""
import numpy as np
import pytest
from crowd import random_fields
from scenes import rows_of

from particles.integral.edge_makers import MAKERS, closed, delaunay, exact, renormalised
from particles.integral.points import jittered, lattice
from particles.weights import WendlandC2
from studies.operators.entropy import WAYS, Smooth, Sought, density, fluid, produced, seen
from studies.operators.equations import ETA, KAPPA, transported

POINTS = jittered((9, 8), 0.3, 2)


def made(way, make=exact):
    return fluid(make(POINTS, WendlandC2.of(h=2.5)), WAYS[way])


@pytest.mark.parametrize("way", WAYS)
@pytest.mark.parametrize("maker", MAKERS)
def test_production_of_edges_is_what_their_points_gain(way, maker):
    dih = made(way, MAKERS[maker])
    flow, q = seen(dih, random_fields(POINTS.n, 2))
    _, *force, power = transported(dih, flow)*dih.edges.V
    gain = (power - (flow.v*np.stack(force, axis=1)).sum(axis=1))/flow.T
    assert q.sum() == pytest.approx(gain.sum(), abs=1e-12*np.abs(q).sum())


def test_each_edge_produces_its_friction_and_its_heat():
    dih = made("along edges", delaunay)
    flow, q = seen(dih, random_fields(POINTS.n, 2))
    edges, i, j = dih.edges, dih.edges.i, dih.edges.j
    friction = ETA*edges.k*((flow.v[j] - flow.v[i])**2).sum(axis=1)     # A = 0, B = eta in 2D with zeta = 0
    heat = KAPPA*edges.k*(flow.T[j] - flow.T[i])**2/(flow.T[i]*flow.T[j])
    assert q == pytest.approx(friction*(1/flow.T[i] + 1/flow.T[j])/2 + heat, rel=1e-9, abs=1e-15)


@pytest.mark.parametrize("make", [closed, exact, delaunay])
def test_nested_friction_produces_what_the_gradients_of_points_do_where_edges_close(make):
    """At one temperature; what a point heats by is sigma : grad v of its own."""
    dih = made("nested", make)
    rho, v, T = random_fields(POINTS.n, 2)
    flow, q = seen(dih, (rho, v, 1 + 0*T))
    slope = dih.transport.gradient(dih.edges, v)
    assert q.sum() == pytest.approx(dih.edges.V@density(flow.T, slope, 0*v), rel=1e-12)


@pytest.mark.parametrize("way", WAYS)
def test_a_stream_produces_nothing_more_but_where_derivatives_do_not_commute(way):
    """A stream changes the divergence of v.grad v - v div v, the mended heating, a little off a lattice."""
    for points, off in ((POINTS, 1e-2*("mended" in way)), (lattice((9, 8)), 0)):
        dih = fluid(exact(points, WendlandC2.of(h=2.5)), WAYS[way])
        rho, v, T = random_fields(points.n, 2)
        still, stream = (seen(dih, (rho, v + wind, T))[1].sum() for wind in (0.0, [3.0, -1.0]))
        assert stream == pytest.approx(still, rel=off + 1e-11)


def test_what_edges_produce_tends_to_the_continuum_if_the_heating_is_that_of_the_stress():
    errors = {way: [abs(rows_of(Smooth(way=way, make=renormalised, points="lattice", cells=n), "entropy")
                        [0]["total"] - 1) for n in (24, 48)] for way in WAYS}
    # second order, and what the heating as printed leaves
    assert errors["nested"][1] < errors["nested"][0]/3
    assert errors["along edges, mended"][1] < errors["along edges, mended"][0]/3
    assert errors["along edges"][1] > 0.01


def test_a_zigzag_between_two_temperatures_flows_the_wrong_way_by_nested_sums_only():
    """On jittered points; a descent finds where grad T and grad 1/T of a point are not opposite."""
    least = {way: rows_of(Sought(way=way, make=delaunay, points="jittered-0.3", cells=6, seed=7), "entropy")
             [0]["least"] for way in WAYS}
    assert least["nested"] < -0.1 < 0.5 < least["along edges, mended"] <= least["along edges"] + 1e-12
    dih = made("along edges", delaunay)
    flow, q = seen(dih, random_fields(POINTS.n, 2))
    assert (produced(dih, flow) == q).all() and (q >= 0).all()
