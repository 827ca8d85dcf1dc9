"""Entropy production of transport over edges: sums, signs, the continuum's    [RR98 Eqs 37, 38, 51]"""
from dataclasses import replace

import numpy as np
import pytest
from crowd import random_fields

from continuum.fluid import ConstEta, IdealGas
from particles.integral.dih import Dih
from particles.integral.edge_makers import MAKERS, delaunay, exact
from particles.integral.entropy_stable import StableSums
from particles.integral.points import jittered, lattice
from particles.threads import Threads
from particles.weights import WendlandC2
from studies.operators.entropy import FLOWS, WAYS, of_flow, produced, producer
from studies.operators.equations import ETA, KAPPA, transported

POINTS = jittered((9, 8), 0.3, 2)


def made(way, make=exact, points=POINTS):
    return Dih(edges=make(points, WendlandC2.of(h=2.5)), eos=IdealGas(), law=ConstEta(ETA, KAPPA),
               transport=WAYS[way])


@pytest.mark.parametrize("way", WAYS)
@pytest.mark.parametrize("maker", MAKERS)
def test_production_of_edges_is_what_their_points_gain(way, maker):
    dih, state = made(way, MAKERS[maker]), random_fields(POINTS.n, 2)
    flow, (q, _) = dih.flow(dih.state(*state)), produced(dih, state)
    _, *force, power = transported(dih, flow)*dih.edges.V
    gain = (power - (flow.v*np.stack(force, axis=1)).sum(axis=1))/flow.T
    assert q.sum() == pytest.approx(gain.sum(), abs=1e-12*np.abs(q).sum())


@pytest.mark.parametrize("way", WAYS)
def test_a_stream_produces_nothing_more_but_where_derivatives_do_not_commute(way):
    """In a stream mended heating, the divergence of v.grad v - v div v, changes a little off a lattice."""
    for points, off in ((POINTS, 1e-2*("mended" in way)), (lattice((9, 8)), 0)):
        dih, (rho, v, T) = made(way, points=points), random_fields(points.n, 2)
        still, stream = (produced(dih, (rho, v + wind, T))[0].sum() for wind in (0.0, [3.0, -1.0]))
        assert stream == pytest.approx(still, rel=off + 1e-11)


@pytest.mark.parametrize("flow", FLOWS)
def test_what_a_flow_produces_is_what_its_points_gain_and_of_its_kind(flow):
    """Two-point fluxes with logarithmic means keep entropy edge by edge, dissipation never destroys it."""
    made, (rho, v, T) = producer(flow, POINTS, delaunay(POINTS)), random_fields(POINTS.n, 2)
    sums, _ = made.args
    q, size = of_flow(sums, FLOWS[flow], (rho, v, T))
    state, rates = sums.method.state(rho, v, T), np.empty((4, POINTS.n))
    still = StableSums(replace(sums.method, transport=(), flow=FLOWS[flow]), Threads(1))
    still.rates(state, rates)
    w = np.array([np.log(T/rho) - 2 + (v**2).sum(axis=1)/(2*T), *(-v.T/T), 1/T])     # c_v = 1
    assert q.sum() == pytest.approx((sums.method.edges.V*w*rates).sum(), abs=1e-12*size.sum())
    if flow in ("crossed pressure", "mean pressure"):
        assert np.abs(q).max() < 1e-13*size.max()
    else:
        assert (q.min() < -1e-3*size.max()) == (flow == "brackets")
