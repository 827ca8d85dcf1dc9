"""Entropy production of transport over edges: sums, signs, the continuum's    [RR98 Eqs 37, 38, 51]"""
from dataclasses import replace

import numpy as np
import pytest
from crowd import random_fields
from scenes import rows_of

from continuum.fluid import ConstEta, IdealGas
from particles.integral.dih import Dih
from particles.integral.edge_makers import MAKERS, delaunay, exact, renormalised
from particles.integral.entropy_stable import StableSums
from particles.integral.points import jittered, lattice
from particles.threads import Threads
from particles.weights import WendlandC2
from studies.build.setting import DISORDERS
from studies.operators.equations import ETA, KAPPA, transported
from studies.operators.points import FLOWS, WAYS, Entropy, of_flow, produced, producer

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


def test_each_edge_produces_its_friction_and_its_heat():
    dih, (rho, v, T) = made("along edges", delaunay), random_fields(POINTS.n, 2)
    i, j, k = dih.edges.i, dih.edges.j, dih.edges.k
    friction = ETA*k*((v[j] - v[i])**2).sum(axis=1)     # A = 0, B = eta in 2D with zeta = 0
    heat = KAPPA*k*(T[j] - T[i])**2/(T[i]*T[j])
    whole = friction*(1/T[i] + 1/T[j])/2 + heat
    assert produced(dih, (rho, v, T))[0] == pytest.approx(whole, rel=1e-9, abs=1e-15)


@pytest.mark.parametrize("way", WAYS)
def test_a_stream_produces_nothing_more_but_where_derivatives_do_not_commute(way):
    """A stream changes the divergence of v.grad v - v div v, the mended heating, a little off a lattice."""
    for points, off in ((POINTS, 1e-2*("mended" in way)), (lattice((9, 8)), 0)):
        dih, (rho, v, T) = made(way, points=points), random_fields(points.n, 2)
        still, stream = (produced(dih, (rho, v + wind, T))[0].sum() for wind in (0.0, [3.0, -1.0]))
        assert stream == pytest.approx(still, rel=off + 1e-11)


def row(way, make, points, cells, state):
    case = Entropy(transport=way, maker=make, points=DISORDERS[points], counts=(cells, cells), h=2.5,
                   state=state, seed=7)
    return rows_of(case, "entropy")[0]


def test_what_edges_produce_tends_to_the_continuum_if_the_heating_is_that_of_the_stress():
    errors = {way: [abs(row(way, renormalised, "lattice", n, "smooth")["total"] - 1) for n in (24, 48)]
              for way in WAYS}
    # second order, and what the heating as printed leaves
    assert all(errors[way][1] < errors[way][0]/3 for way in ("nested", "along edges, mended"))
    assert errors["along edges"][1] > 0.01


def test_a_descent_finds_states_that_lose_entropy_by_nested_sums_only():
    least = {way: row(way, delaunay, "jittered-0.3", 6, "sought")["least"] for way in WAYS}
    assert least["nested"] < -0.1 < 0.5 < least["along edges, mended"] <= least["along edges"] + 1e-12


@pytest.mark.parametrize("flow", FLOWS)
def test_what_a_flow_produces_is_what_its_points_gain(flow):
    made, (rho, v, T) = producer(flow, POINTS, delaunay(POINTS)), random_fields(POINTS.n, 2)
    sums, _ = made.args
    q, size = of_flow(sums, FLOWS[flow], (rho, v, T))
    state, rates = sums.method.state(rho, v, T), np.empty((4, POINTS.n))
    still = StableSums(replace(sums.method, transport=(), flow=FLOWS[flow]), Threads(1))
    still.rates(state, rates)
    w = np.array([np.log(T/rho) - 2 + (v**2).sum(axis=1)/(2*T), *(-v.T/T), 1/T])     # c_v = 1
    assert q.sum() == pytest.approx((sums.method.edges.V*w*rates).sum(), abs=1e-12*size.sum())
    assert (q.min() < -1e-13*size.max()) == (flow == "brackets")       # no other flow destroys entropy
