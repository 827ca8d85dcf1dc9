"""Particles whose places are shifted: slow twins, rest, steps, refusals; other laws are in test_spam."""
from dataclasses import replace

import numpy as np
import plain
import pytest
from crowd import crowd, everywhere, lattice, prepare, rates
from plain_meshless import everywhere as at_all_points
from test_spam import BOX, COLD, COLUMNS, HOT, MASS, PERIODIC, ROWS, close, closed, state_of

from continuum.fluid import (
    ConstEta,
    ConstNu,
    IdealGas,
    VanDerWaals,
    conductivity,
    energy,
    sound_speed,
    viscosity,
)
from particles.limits import by_trial, largest_step, step_limit
from particles.observe import fields_at, heat_flow, particle_kinetic
from particles.smooth.riemann import LowDissipationSums
from particles.smooth.shifting import DeltaPlus
from particles.smooth.spam import LessStatic, Spam
from particles.smooth.transport import TransportVelocity, transported_heat
from particles.walls.fixed import fixed_plates
from particles.walls.mirror import Odd, plates
from particles.weights import Lucy, WendlandC2

WALLS = {"closed": closed(Odd()), "periodic": everywhere(BOX),
         "layer": PERIODIC + plates(BOX[1], HOT, COLD, Odd())}
EOS = {"closed": VanDerWaals(), "periodic": IdealGas(), "layer": IdealGas()}
P0 = LessStatic(0.7, 1.2, 1.0)
KINDS = pytest.mark.parametrize("kind", [DeltaPlus, TransportVelocity])


def spam(kind, name="periodic", static=P0, **more):
    weight = Lucy if name == "periodic" else WendlandC2
    known = {"weight": weight.of(h=3.0), "eos": EOS[name], "law": ConstEta(0.4, 0.3), "box": BOX, "m": MASS,
             "walls": WALLS[name], "static": static if kind is TransportVelocity else LessStatic(0.0, 0.0),
             "g": 0.05*(name == "layer")}
    return Spam(**known | {"transport": kind} | more)


def twin(method, state):
    """Rates from what particles gain of mass, momentum and total energy, pair by pair."""
    p, n = plain.points(method, state), state.shape[1]
    w, g = plain.pairs(method, p.x, n)
    d, dv, r2 = p.x[:n, None] - p.x, p.v[:n, None] - p.v, ((p.x[:n, None] - p.x)**2).sum(axis=2)
    F = np.einsum("ija,ija->ij", d, g)/np.where(r2 > 0, r2, 1)
    e = np.array([energy(method.eos, *q) for q in zip(p.rho, p.T)])
    eta, k = (f(method.law, 1.0, 1.0) for f in (viscosity, conductivity))
    c = np.array([sound_speed(method.eos, *q) for q in zip(p.rho, e)])
    slow = transported if method.transport is TransportVelocity else shifted
    m, VV, shift, push, work, rho, carry = slow(method, p, state, w, g, d, F, dv, c)
    push = push + (2*eta*VV*F)[..., None]*dv
    heat = work - eta*VV*F*(dv**2).sum(axis=2) + 2*k*VV*F*(p.T[:n, None] - p.T)
    gain = carry(np.ones(len(p.x))).sum(axis=1)
    a = (push + np.stack([carry(q) for q in p.v.T], axis=2)).sum(axis=1) - p.v[:n]*gain[:, None]
    E = e + (p.v**2).sum(axis=1)/2
    all_energy = ((push*p.v[:n, None]).sum(axis=2) + heat + carry(E)).sum(axis=1)
    a /= m[:, None]
    de = (all_energy - E[:n]*gain)/m - (p.v[:n]*a).sum(axis=1)
    a[:, 1] -= method.g*(1 - method.static.fraction*method.static.rho0/p.rho[:n])
    return np.array([*(state[2:4] + shift.T), *a.T, de, *((rho, gain) if len(state) > 5 else ())])


def shifted(method, p, state, w, g, d, F, dv, c):
    """Sun et al. 2017, 2019; Antuono et al. 2010."""
    n, h, weight = len(w), method.weight.h, plain.PRINTED[type(method.weight)]
    m, V, v = state[6], at_all_points(p, state[6]/state[5]), state[2:4]
    VV, U = V[:n, None]*V, np.hypot(*(v - v.mean(axis=1)[:, None])).max()
    s = -U*h*np.einsum("ij,j,ija->ia", 1 + 0.2*(w/weight(np.sqrt(V[:n]), h)[0][:, None])**4, V, g)
    size = np.hypot(*s.T)
    s = at_all_points(p, s*np.minimum(1, 0.5*U/np.where(size > 0, size, 1))[:, None], 1)
    B = np.linalg.inv(np.einsum("j,ija,ijb->iab", V, -d, g))
    slope = np.einsum("iab,j,ij,ijb->ia", B, V, p.rho - p.rho[:n, None], g)
    slope = at_all_points(p, slope, 1)
    psi = 2*(p.rho[:n, None] - p.rho - 0.5*((slope[:n, None] + slope)*d).sum(axis=2))

    def carry(q):
        flux = (p.rho*q)[:, None]*s
        return VV*((flux[:n, None] + flux)*g).sum(axis=2)
    rho = state[5]*(((dv + s[:n, None] - s)*g).sum(axis=2)@V) + carry(1.0 + 0*p.rho).sum(axis=1)/V[:n]
    rho += 0.1*h/2*((c[:n, None] + c)/2*psi*F)@V
    push = -(VV*(p.P[:n, None] + p.P))[..., None]*g
    return m, VV, s[:n], push, VV*p.P[:n, None]*(dv*g).sum(axis=2), rho, carry


def transported(method, p, state, w, g, d, F, dv, c):
    """Adami, Hu & Adams 2013: shifts lead by half of a step of 0.25 a/c [Eq. 15]. What is left out of P works
    as volumes change that move with v + s."""
    n, V, m, rho = len(w), method.m/p.rho, method.m, p.rho
    both = V[:n, None]**2 + V**2
    s = -method.static.P0/m*np.einsum("ij,ija->ia", both, g)*(0.25/2*np.sqrt(V)/c)[:n, None]
    s = at_all_points(p, s, 1)
    A = np.einsum("i,ia,ib->iab", rho, p.v, s)
    P = (rho*p.P[:n, None] + rho[:n, None]*p.P)/(rho[:n, None] + rho)
    push = both[..., None]*(np.einsum("ijab,ijb->ija", (A[:n, None] + A)/2, g) - P[..., None]*g)
    left = plain.static_pressure(method, state[1])[:, None]*V[:n, None]*np.sqrt(V[:n, None]*V)
    work = left*((dv + s[:n, None] - s)*g).sum(axis=2) - 0.5*(push*dv).sum(axis=2)
    return (np.full(n, m), V[:n, None]*V, s[:n], push, work, None,
            lambda q: np.zeros((n, len(p.x))))


@KINDS
@pytest.mark.parametrize("walls", WALLS)
def test_equals_the_slow_twin(walls, kind):
    method = spam(kind, walls)
    sums, state, _ = prepare(method, state_of(method))
    out = np.empty_like(state)
    sums.rates(state, out)
    # sums cancel to a few per cent of 30 terms, energies from differences of larger ones
    for fast, exact in zip(out, twin(method, state), strict=True):
        assert close(fast, exact) < 1e-11
    assert abs(out[:2] - state[2:4]).max() > 1e-3


def test_a_transport_velocity_keeps_energy_but_for_the_work_of_what_its_forces_lack():
    method = spam(TransportVelocity)
    state = state_of(method)
    sums, state, _ = prepare(method, state)
    out = np.empty_like(state)
    sums.rates(state, out)
    mass, V = method.m, method.m/sums.around.rho[:sums.n]
    work = plain.static_pressure(method, state[1])*V*(sums.slopes[:sums.n, 0] + sums.slopes[:sums.n, 5])
    assert abs(work.sum()) > 1e-3
    assert mass*(out[4] + (state[2:4]*out[2:4]).sum(axis=0)).sum() == pytest.approx(-work.sum(), rel=1e-10)


def test_heat_that_a_transport_velocity_carries_is_counted():
    method = spam(TransportVelocity, "layer")
    state = state_of(method)
    sums, state, _ = prepare(method, state)
    sums.look_at(state)
    d = sums.velocity(state)[1] - state[3]
    more = state[4] + (state[2]**2 + state[3]**2)/2 + method.g*state[1]
    V = method.m/sums.around.rho[:sums.n]
    carried = (d*(method.m*more + V*plain.static_pressure(method, state[1]))).sum()/(BOX[0]*BOX[1])
    assert abs(carried) > 1e-4
    assert transported_heat(sums, state) - heat_flow(sums, state) == pytest.approx(carried, rel=1e-8)


@pytest.mark.parametrize("static", [LessStatic(0.0, 1.2, 0.0), LessStatic(1.0, 1.2, 0.0)])
@KINDS
def test_a_lattice_at_rest_stays_at_rest(kind, static):
    method = spam(kind, static=static)
    state = np.array([*lattice(BOX, COLUMNS, ROWS), *np.zeros((2, COLUMNS*ROWS)), np.ones(COLUMNS*ROWS)])
    assert abs(rates(method, kind.complete(state, 1.0, MASS))).max() < 1e-13


def test_densities_are_not_mixed_where_they_are_linear_and_their_mass_in_volumes_is_kept():
    wide = spam(DeltaPlus, "closed", box=(24.0, 24.0), walls=(), m=1.0)
    state = crowd((24.0, 24.0), 24, 24)
    state[2:4], inner = 0, np.abs(state[:2]).max(axis=0) < 5.5
    linear = DeltaPlus.complete(state, 1 + 0.01*state[0], 1.0)
    bent = DeltaPlus.complete(state, 1 + 0.01*state[0]**2, 1.0)
    assert abs(rates(wide, linear)[5, inner]).max() < 1e-13 < 1e-5 < abs(rates(wide, bent)[5, inner]).max()
    assert (rates(wide, linear)[:2] == 0).all()


@KINDS
def test_steps_of_waves_are_stable_for_what_is_shifted(kind):
    method = spam(kind)
    state = kind.complete(crowd(BOX, COLUMNS, ROWS, method.eos, 0.05), 1.0, MASS)
    assert 0.3*step_limit(method, state[4]) < largest_step(by_trial(method, state))


def test_what_is_measured_counts_the_masses_that_particles_have():
    method = spam(DeltaPlus)
    state = state_of(method)
    fields, (sums, ordered, _) = method.fields(state), method.look(state)
    np.testing.assert_allclose([fields.rho*fields.V, fields.rho], state[[6, 5]], rtol=1e-13)
    kinetic = state[6]@(state[2]**2 + state[3]**2)/2
    assert particle_kinetic(sums, ordered) == pytest.approx(kinetic/MASS/state.shape[1], rel=1e-12)
    sums.look_at(ordered)
    p, V = plain.points(method, ordered), ordered[6]/ordered[5]
    slow = at_all_points(p, V)*(p.T - p.T[:sums.n, None])*plain.pairs(method, p.x, sums.n)[1][..., 0]
    assert close(sums.slopes[:, 2], slow.sum(axis=1)) < 1e-12
    whole = fields_at(sums, ordered, *np.meshgrid(np.arange(9) - 4.0, np.arange(8) - 3.5)).rho.mean()
    assert whole == pytest.approx(state[6].sum()/(BOX[0]*BOX[1]), rel=0.02)


def test_what_they_cannot_take_is_refused():
    held = spam(DeltaPlus, "layer", walls=PERIODIC + fixed_plates(BOX[1], HOT, COLD))
    with pytest.raises(ValueError, match=r"FixedRows holds particles whose density .* take images"):
        prepare(held, state_of(held))
    none = replace(spam(TransportVelocity), static=LessStatic(0.0, 0.0))
    with pytest.raises(ValueError, match=r"got static\.P0 = 0: give static = LessStatic"):
        prepare(none, state_of(none))
    for kind in (DeltaPlus, TransportVelocity, LowDissipationSums):
        with pytest.raises(ValueError, match=r"lacks a part .* ConstNu\(nu=0\.4, .*: take ConstEta, or"):
            spam(kind, law=ConstNu(0.4, 0.3))
    method = spam(DeltaPlus)
    sums, state, ids = prepare(method, state_of(method))
    sums.densities(state)
    assert sums.fault(state, ids) == ""
    state[6, 4] = -0.1
    assert f"particle {ids[4]} has the mass -0.1" in sums.fault(state, ids)
