"""An entropy-stable flux for ideal and van der Waals' fluids: pairs of points, contacts, held points."""
from types import SimpleNamespace

import numpy as np
import pytest
from test_entropy_stable import GAS, VDW, any_states, closed, evaluated, violent

from continuum.fluid import ConstEta, energy, pressure, sound_speed
from particles.integral.bodies import held, with_disc
from particles.integral.entropy_fluxes import (
    BlendedPressure,
    Dissipation,
    Logarithmic,
    MeanPressure,
    log_means,
)
from particles.integral.entropy_stable import StableStream
from particles.integral.exchange import Listing, Pressure
from particles.integral.lanes import SLOPES, Point
from particles.integral.points import of_positions, random
from particles.integral.triangulation import around
from particles.pairs import Faces, sweep
from particles.run import Plan, run
from particles.threads import Threads
from studies.build import SCENES, ready
from studies.build.stable import BODIES

ONE, PAIRS = Threads(1), 500
PRESSURES = MeanPressure, BlendedPressure, Pressure
FLUIDS = pytest.mark.parametrize("eos", [GAS, VDW], ids=["ideal", "vdw"])


def massieu(eos, rho, T):
    """(g/T, P/T) of s = c_v ln T - ln(rho/u), term by term, u = 1 - b rho."""
    b, a = getattr(eos, "b", 0.0), getattr(eos, "a", 0.0)
    u = 1 - b*rho
    s = eos.cv*np.log(T) - np.log(rho/u)
    P_T = rho/u - a*rho**2/T
    return eos.cv - a*rho/T + P_T/rho - s, P_T


@FLUIDS
@pytest.mark.parametrize("near", [1.0, 1e-3, 1e-9])
def test_means_close_the_jump_of_P_over_T(eos, near):
    for rho, T in zip(*(q.reshape(-1, 2) for q in any_states(eos, 2000))):
        rho[1], T[1] = rho[0] + near*(rho[1] - rho[0]), T[0] + near*(T[1] - T[0])
        one, other = (SimpleNamespace(rho=rho[k], T=T[k]) for k in (0, 1))
        mean, e = log_means(eos, one, other)
        (g, g_other), (P_T, P_T_other) = massieu(eos, rho, T)
        parts = mean*g_other, -mean*g, -mean*e/T[1], mean*e/T[0], -P_T_other, P_T
        assert abs(sum(parts)) < 1e-14*np.abs(parts).sum()
        assert rho.min() <= mean <= rho.max()
        if near == 1e-9:
            known = rho.mean(), energy(eos, rho.mean(), T.mean())
            assert (mean, e) == pytest.approx(known, rel=1e-5, abs=1e-5)


def gains_of_pairs(eos, *terms):
    """Gains (4, 2, PAIRS) of pairs in any states and motion, their rho, T, v, S, and w of their edges."""
    draw, n, points = np.random.default_rng(1), np.arange(2*PAIRS), np.zeros(2*PAIRS, Point)
    points["rho"], points["T"] = any_states(eos, len(n))
    for name in ("vx", "vy", "rx", "ry", *SLOPES):
        points[name] = 3*draw.normal(size=len(n))
    e = energy(eos, points["rho"], points["T"])
    # other terms leave out a row's own, as closed edges may
    points["P"] = pressure(eos, points["rho"], e)*isinstance(terms[0], Dissipation)
    points["c"] = sound_speed(eos, points["rho"], e)
    sx, sy, dx, dy = np.repeat(draw.normal(size=(4, PAIRS)), 2, axis=1)*np.tile([1.0, -1.0], PAIRS)
    edges = Faces(n.astype(np.uint64), np.ones(len(n), np.uint32), (n ^ 1).astype(np.uint32), sx, sy, 0*sx,
                  dx, dy)
    gain = np.zeros((len(points), 4))
    sweep(0, len(points), Listing(terms), points, edges, gain)
    assert np.allclose(gain[::2], -gain[1::2], rtol=1e-11)
    rho, T, vx, vy, rx, ry = (points[name].reshape(-1, 2).T for name in ("rho", "T", "vx", "vy", "rx", "ry"))
    v, S = np.array([vx, vy]), 2*np.array([sx, sy])[:, ::2]
    return gain.T.reshape(4, -1, 2).transpose(0, 2, 1), rho, T, v, S, (v + [rx, ry]).mean(axis=1)


def produced(eos, *terms):
    """Entropy that pairs destroy, less what cancels over closed edges, over the size of its parts."""
    gain, rho, T, v, S, w = gains_of_pairs(eos, *terms)
    g_T, P_T = massieu(eos, rho, T)
    parts = np.array([g_T - (v**2).sum(axis=0)/(2*T), *(v/T), -1/T])*gain
    (one, other), (P_one, P_other) = np.moveaxis(v, 1, 0), P_T
    closing = (S*(P_other*other - P_one*one)).sum(axis=0) - (S*w).sum(axis=0)*(P_other - P_one)
    closing = closing*(not isinstance(terms[0], Dissipation))
    return (parts.sum(axis=(0, 1)) - closing)/np.abs(parts).sum(axis=(0, 1))


@pytest.mark.parametrize("eos, kind", [*((GAS, kind) for kind in PRESSURES), (VDW, BlendedPressure),
                                       (VDW, MeanPressure)])
def test_two_points_that_move_keep_entropy_whatever_their_states(eos, kind):
    assert np.abs(produced(eos, Logarithmic(eos), kind(eos))).max() < 1e-13


@FLUIDS
def test_no_edge_that_moves_destroys_entropy_by_its_dissipation(eos):
    made = produced(eos, Dissipation(eos))
    assert (made <= 1e-13).all() and np.median(made) < -1e-3


def at_contact(eos, P=1.0, seed=1):
    """Densities and temperatures (n,) of one pressure."""
    n = len(closed().x)
    rho = np.exp(np.random.default_rng(seed).normal(0, 1, n))
    b, a = getattr(eos, "b", 0.0), getattr(eos, "a", 0.0)
    rho = rho/(1 + b*rho)
    return rho, (P + a*rho**2)*(1 - b*rho)/rho


@FLUIDS
def test_a_contact_at_rest_stays(eos):
    rho, T = at_contact(eos)
    for flow in ((Dissipation(eos),), (Logarithmic(eos), BlendedPressure(eos), Dissipation(eos))):
        made = closed(*flow, eos=eos)
        _, rates = evaluated(made, made.state(rho, np.zeros((len(rho), 2)), T))
        assert np.abs(rates).max() < 1e-12


def carried(*flow):
    """A contact at Mach 2, after it has gone two spacings: how far velocities are off, and pressures."""
    made, (rho, T) = closed(*flow, Dissipation(GAS)), at_contact(GAS)
    v = np.tile([2.0, 1.0], (len(rho), 1))
    at = made.fields(run(made, made.state(rho, v, T), Plan(dt=0.02, steps=50)).state)
    return np.abs(at.v - v).max(), np.abs(at.rho*at.T - 1).max()


def test_the_blend_carries_a_contact_as_the_mean_pressure_does_and_the_crossed_one_does_not():
    flows = [(Logarithmic(GAS), one(GAS)) for one in PRESSURES]
    mean, blended, crossed = (carried(*flow) for flow in flows)
    assert max(*mean, *blended) < 1e-11 and min(crossed) > 1e-2


def test_what_the_blend_adds_is_bounded_by_the_jump_of_the_pressure():
    gain, rho, T, _, S, _ = gains_of_pairs(GAS, BlendedPressure(GAS))
    P, size = rho*T, (S**2).sum(axis=0)
    added = -(gain[1:3, 0]*S).sum(axis=0)/size - P.mean(axis=0)
    assert (np.abs(added) <= 1.25*np.abs(P[1] - P[0])).all() and added.max() > 0.1


# --- held points ----------------------------------------------------------------------------------


def past_body(T=np.nan, v=(0.0, 0.0), eos=GAS):
    """A gas without viscosity around a disc."""
    x, edge = with_disc(random((14, 12), 0.4, 1).x, 2.6)
    return StableStream(x=x, edges=around(of_positions(x, (14, 12)), edge), eos=eos, law=ConstEta(0, 0),
                        held=held(edge, v, T), solid=False)


@FLUIDS
@pytest.mark.parametrize("T, v", [(np.nan, (0.0, 0.0)), (2.0, (0.0, 0.0)), (np.nan, (0.3, -0.2))])
def test_the_body_takes_what_the_fluid_loses_through_limits_too(T, v, eos):
    """Euler steps twenty times too long: sums change by what `received` says, and held points stay held."""
    method = past_body(T, v, eos)
    n, V, which, state = len(method.x), method.edges.V, method.held.which, violent(method)
    sums, rates = method.start(n, ONE), np.empty_like(state)
    for _ in range(5):
        sums.rates(state, rates)
        begun, dt, before = state@V, 20*sums.longest(), state.copy()
        while not sums.euler(state, dt, rates):
            state[:], dt = before, dt/2
            sums.rates(state, rates)
        size = (np.abs(state) + np.abs(before))@V
        change = state@V - begun + dt*np.array([0, *sums.received.sum(axis=0)])
        assert np.abs(change[:3]).max() < 1e-13*size.max()
        # of a given temperature: a difference of energies
        assert abs(change[3]) < (1e-13 if np.isnan(T) else 1e-9)*size.max()
        slip = state[1:3, which] - np.array(v)[:, None]*state[0, which]
        assert np.abs(slip).max() < 1e-13*size.max()
    assert sums.limited and not sums.fault(state, np.arange(n))


def test_a_gas_at_rest_stays_and_its_body_is_a_polygon_left_out():
    method = past_body()
    n = len(method.held.which)
    assert method.edges.V.sum() == pytest.approx(14*12 - n/2*2.6**2*np.sin(2*np.pi/n), rel=1e-12)
    sums, rates = evaluated(method, method.state(1.0, np.zeros_like(method.x), 1.0))
    assert np.abs(rates).max() < 1e-13
    assert np.abs(sums.received.sum(axis=0)).max() < 1e-12 < 0.5 < np.hypot(*sums.received[:, :2].T).min()


def test_a_scene_without_a_body_is_refused():
    with pytest.raises(ValueError, match="cannot take no disc"):
        ready(SCENES["taylor-green"](8), BODIES["fixed-jittered-plates-entropy-stable"])
