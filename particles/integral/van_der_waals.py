"""Van der Waals' fluid in `entropy_fluxes` and `positive`: formulas of means, waves, limits.

s = c_v ln T - ln(rho/u), u = 1 - b rho, is concave where pressure grows with density at constant T, which it
does at all densities above the critical T = 8 a/27 b. Elsewhere two states may have no mean [Tadmor 1987]:
the mean density is then clipped to the range of both, and entropy is not conserved.
"""
import numpy as np

from continuum.fluid import VanDerWaals
from particles.integral.entropy_fluxes import acoustics, log_mean, log_means
from particles.integral.positive import KEPT, above_cold, crowded, share, share_of

SOFT = 1e-3         # attraction leaves at least this part of the dP/drho of hard discs


@log_means.of(VanDerWaals)
def _(eos, a, b):
    """rho*, e* by D(fh) = {f} Dh + {h} Df of P/T = rho/u - a rho^2/T and g/T = b rho/u + ln(rho/u) - c_v ln T
    - 2 a rho/T + const.: terms in D(rho) = u_a u_b D(rho/u) give rho*, then terms in D(1/T) give e*."""
    u_a, u_b, beta, rho = 1 - eos.b*a.rho, 1 - eos.b*b.rho, 0.5/a.T + 0.5/b.T, 0.5*(a.rho + b.rho)
    room, pull = 1/(u_a*u_b), 2*eos.a*beta
    log = 1/log_mean(a.rho, b.rho) + eos.b/log_mean(u_a, u_b)       # D ln(rho/u)/D(rho)
    mean = (room - pull*rho)/(eos.b*room + log - pull)
    mean = min(max(mean, min(a.rho, b.rho)), max(a.rho, b.rho))
    return mean, (eos.cv*a.T*b.T/log_mean(a.T, b.T) - 2*eos.a*rho
                  + 0.5*eos.a*(a.rho*a.rho + b.rho*b.rho)/mean)


@acoustics.of(VanDerWaals)
def _(eos, a, b, rho, e):
    """With h = e* + {P}/rho* the jump of sound is {1/T} D(P)/rho*, zero at a contact. c_T^2 = dP/drho at
    constant T is at least SOFT of that without attraction    [Landau & Lifshitz]"""
    beta, mean, both = 0.5/a.T + 0.5/b.T, 0.5*(a.rho + b.rho), 0.5*(a.P + b.P)
    room = 1 - eos.b*rho
    hard = 1/beta/(room*room)
    soft = max(hard - 2*eos.a*rho, SOFT*hard)
    c2 = soft + hard/eos.cv
    squares = a.rho*a.rho + a.rho*b.rho + b.rho*b.rho
    at_P = eos.cv*(2*eos.a*mean - eos.b*both - eos.a*eos.b*squares) - 2*eos.a*mean
    jump = (b.P/b.T - a.P/a.T)/rho + e*(1/b.T - 1/a.T)
    return c2, e + both/rho, at_P, jump, rho/(beta*c2), rho/beta*(1/soft - 1/c2)


@share_of.of(VanDerWaals)
def _(eos, a, rho, px, py, eps):
    """Leaves a point KEPT of its low-order free volume 1 - b rho, too. The energy of attraction, -a rho^2, is
    below its tangent at the low-order density, so internal energy is not below a quadratic."""
    part = share(a, rho, px, py, eps + 2*eos.a*a.low_rho*rho)
    return min(part, (1 - KEPT)*(1 - eos.b*a.low_rho)/max(eos.b*rho, 1e-300))


above_cold.of(VanDerWaals)(lambda eos, state: np.stack([*state[:3], state[3] + eos.a*state[0]**2]))
crowded.of(VanDerWaals)(lambda eos, before, after: np.any(1 - eos.b*after[0] <= KEPT*(1 - eos.b*before[0])))
