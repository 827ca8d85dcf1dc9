"""Van der Waals' fluid in `entropy_fluxes` and `positive`: formulas of means, waves, limits.

s = c_v ln T - ln(rho/u), u = 1 - b rho, is concave where pressure grows with density at constant T, which it
does at all densities above the critical T = 8 a/27 b. Elsewhere two states may have no mean [Tadmor 1987]:
the mean density is then clipped to the range of both, and entropy is not conserved.
"""
from typing import NamedTuple

import numpy as np

from continuum.fluid import VanDerWaals
from continuum.jit import formula
from particles.integral.entropy_fluxes import (
    SLOW,
    bend,
    brought,
    fastest,
    log_means,
    over_mean,
    shock,
)
from particles.integral.positive import KEPT, Excess, above_cold, crowded, limited, share
from particles.pairs import pair_term, rate

SOFT = 1e-3         # attraction leaves at least this part of the dP/drho of hard discs


@log_means.of(VanDerWaals)
def _(eos, a, b):
    """rho*, e* by D(fh) = {f} Dh + {h} Df of P/T = rho/u - a rho^2/T and g/T = b rho/u + ln(rho/u) - c_v ln T
    - 2 a rho/T + const.: terms in D(rho) = u_a u_b D(rho/u) give rho*, then terms in D(1/T) give e*."""
    u_a, u_b, beta, rho = 1 - eos.b*a.rho, 1 - eos.b*b.rho, 0.5/a.T + 0.5/b.T, 0.5*(a.rho + b.rho)
    room, pull = 1/(u_a*u_b), 2*eos.a*beta
    log = over_mean(a.rho, b.rho)/rho + eos.b*2*over_mean(u_a, u_b)/(u_a + u_b)     # D ln(rho/u)/D(rho)
    mean = (room - pull*rho)/(eos.b*room + log - pull)
    mean = min(max(mean, min(a.rho, b.rho)), max(a.rho, b.rho))
    return mean, (eos.cv*over_mean(a.T, b.T)/beta - 2*eos.a*rho
                  + 0.5*eos.a*(a.rho*a.rho + b.rho*b.rho)/mean)


@formula
def stiffness(eos, rho, T):
    """(dP/drho at constant T, at least SOFT of that without attraction; c^2)"""
    room = 1 - eos.b*rho
    hard = T/(room*room)
    soft = max(hard - 2*eos.a*rho, SOFT*hard)
    return soft, soft + hard/eos.cv


@brought.of(VanDerWaals)
def _(eos, a, b, ab, P, r, by_x, by_y):
    """`waves` of any fluid: R R^T = dU/dq weighs sound by rho T/c^2, which carries h; entropy by rho T
    (1/c_T^2 - 1/c^2), which carries D(rho e)/D(rho) at constant P; velocities by rho T    [Barth 1999;
    Landau & Lifshitz]. With h = e* + {P}/rho* the jump of sound is {1/T} D(P)/rho*, zero at a contact.
    """
    (dP, P0, P1), (drho, r0, r1), (du, u0, u1), (dv, v0, v1) = P, r, by_x, by_y
    size = np.sqrt(ab.sx*ab.sx + ab.sy*ab.sy)
    nx, ny = ab.sx/max(size, 1e-300), ab.sy/max(size, 1e-300)
    rho, e = log_means(eos, a, b)
    u, v, mean, both = 0.5*(a.vx + b.vx), 0.5*(a.vy + b.vy), 0.5*(a.rho + b.rho), 0.5*(a.P + b.P)
    beta, dbeta, h = 0.5/a.T + 0.5/b.T, 1/b.T - 1/a.T, e + both/rho
    soft, c2 = stiffness(eos, rho, 1/beta)
    squares = a.rho*a.rho + a.rho*b.rho + b.rho*b.rho
    at_P = eos.cv*(2*eos.a*mean - eos.b*both - eos.a*eos.b*squares) - 2*eos.a*mean
    un, ut, dun, dut = u*nx + v*ny, v*nx - u*ny, du*nx + dv*ny, dv*nx - du*ny
    of_P, P_line = bend(dP, P0, P1, b.P - a.P)
    of_n, n_line = bend(dun, u0*nx + v0*ny, u1*nx + v1*ny, dun)
    of_t, _ = bend(dut, v0*nx - u0*ny, v1*nx - u1*ny, dut)
    of_s, s_line = bend(drho - dP/c2, r0 - P0/c2, r1 - P1/c2, drho - (b.P - a.P)/c2)
    steep, sigma = shock(a, b, ab, abs(P0 + P1 - 4*dP)/(2*both))
    rx, ry = 0.5*(a.rx + b.rx), 0.5*(a.ry + b.ry)
    flow, fast = np.sqrt(rx*rx + ry*ry), fastest(a, b, ab)
    slow = size*np.sqrt((rx*nx + ry*ny)**2 + (SLOW*flow)**2)
    jump = (b.P/b.T - a.P/a.T)/rho + e*dbeta        # of g/T
    sound = fast*max(of_P, steep*P_line)*rho/(beta*c2)*(jump - h*dbeta)
    across = fast*min(1.0, max(flow/np.sqrt(c2), sigma))*max(of_n, sigma*n_line)*mean*dun
    heat = slow*max(of_s, sigma*s_line)*rho/beta*(1/soft - 1/c2)*(jump - at_P*dbeta)
    m, along = sound + heat, slow*of_t*mean*dut
    return (m, m*u + across*nx - along*ny, m*v + across*ny + along*nx,
            0.5*m*(a.vx*b.vx + a.vy*b.vy) + sound*h + heat*at_P + across*un + along*ut)


class LimitedRoom(NamedTuple):
    """`positive.Limited` of molecules that fill a part b rho of the volume and attract each other: a rho^2 is
    not below its tangent at the low-order density, so that internal energy is not below a quadratic."""
    excess: Excess
    eos: VanDerWaals


@formula
def share_of_room(eos, a, m, px, py, e):
    """`share` that leaves a point KEPT of its low-order free volume 1 - b rho, too."""
    part = share(a, m, px, py, e + 2*eos.a*a.low_rho*m)
    return min(part, (1 - KEPT)*(1 - eos.b*a.low_rho)/max(eos.b*m, 1e-300))


@pair_term(LimitedRoom, 4)
def _(term, a, b, ab):
    m, px, py, e = rate(term.excess, a, b, ab)
    less = min(share_of_room(term.eos, a, a.room*m, a.room*px, a.room*py, a.room*e),
               share_of_room(term.eos, b, -b.room*m, -b.room*px, -b.room*py, -b.room*e)) - 1
    return less*m, less*px, less*py, less*e


above_cold.of(VanDerWaals)(lambda eos, state: np.stack([*state[:3], state[3] + eos.a*state[0]**2]))
crowded.of(VanDerWaals)(lambda eos, before, after: np.any(1 - eos.b*after[0] <= KEPT*(1 - eos.b*before[0])))
limited.of(VanDerWaals)(lambda eos, excess: LimitedRoom(excess, eos))
