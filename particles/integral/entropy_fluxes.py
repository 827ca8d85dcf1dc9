"""Entropy-conserving fluxes over edges that close, and dissipation that never destroys entropy, in 2D.

A scene lists `Logarithmic` and one of three pressures in place of convection and pressure; together they
conserve sum V rho s to round-off [Tadmor 1987]. `exchange.Pressure`, the crossed pressure of RR98, does so in
an ideal gas, and is as accurate as RR98's brackets; `MeanPressure` preserves contacts; `BlendedPressure` is
the crossed pressure in smooth flow and the mean at contacts. `Dissipation` can be added to any of them.
{} is the mean of both points of an edge, D their difference.
"""
import numpy as np

from continuum.fluid import IdealGas
from continuum.jit import formula, generic
from particles.integral.exchange import pressure_of
from particles.neighbours import u64
from particles.pairs import pair_term

STEEP, STEEPEST = 6, 20.0       # exponent of the sensor; factor of the pressure's bend over 2 {P}
SLOW = 0.1                      # least speed of shear and entropy waves on an edge, over |w - v|
CALM, ROUNDING = 1e-3, 1e-12    # thresholds of dissipation: part of a full jump, part of a field
STILL = CALM**(1/STEEP)
FAINT = CALM**1.5               # s at which the share of pressure in `shock` is CALM
LN2, MANTISSA, HALF = np.log(2), u64(52), u64((2*1023 + 1) << 51)     # mantissa's bits; exponent bias + 1/2


@formula
def log_mean(a, b):
    """(b - a)/ln(b/a), by a series that converges where a is near b    [Ismail & Roe 2009]

    Without a branch: a is first multiplied by the power of two, from the bits of both, that brings it near b.
    """
    two = (np.float64(b).view(np.uint64) + HALF - np.float64(a).view(np.uint64)) >> MANTISSA
    k, near = np.float64(np.int64(two) - 1023), a*np.uint64(two << MANTISSA).view(np.float64)
    y = (b - near)/(b + near)
    f = y*y
    s = 1 + f*(1/3 + f*(1/5 + f*(1/7 + f*(1/9 + f*(1/11 + f*(1/13 + f*(1/15 + f*(1/17 + f*(1/19 + f*(
        1/21 + f/23))))))))))
    # ln(b/a) = k ln 2 + 2 y s; where k = 0, y (b + a) = b - a
    return 0.5*(a + b if k == 0 else b - a)/(s if k == 0 else 0.5*LN2*k + y*s)


@generic
def log_means(eos, a, b):
    """Means rho*, e* of two points that satisfy D(P/T) = rho* (D(g/T) - e* D(1/T)), g = e + P/rho - T s; only
    for fluids that have an entropy s."""


log_means.of(IdealGas)(lambda eos, a, b: (log_mean(a.rho, b.rho), eos.cv*a.T*b.T/log_mean(a.T, b.T)))


@pair_term(4, "eos")
def Logarithmic(term, a, b, ab):
    """Mass S.{w - v} rho* brings velocity {v} and energy e* + v_a.v_b/2; `log_means`    [Chandrashekar 2013]

    With q = d(-rho s)/d(rho, rho v, eps), U* = rho* (1, {v}, ..) satisfies Dq.U* = D(P/T). A volume growing
    by S.{w} contributes -rho s - q.U = -P/T times its growth: for an edge that moves at {w} they cancel.
    """
    rho, e = log_means(term.eos, a, b)
    m = rho*(ab.sx*(a.rx + b.rx) + ab.sy*(a.ry + b.ry))
    return m, 0.5*m*(a.vx + b.vx), 0.5*m*(a.vy + b.vy), m*(e + 0.5*(a.vx*b.vx + a.vy*b.vy))


@pair_term(4, "eos")
def MeanPressure(term, a, b, ab):
    """Mean pressure {P} on an edge, with the work S.(P_a v_b + P_b v_a)/2    [Ranocha 2018]"""
    P_a, P_b = pressure_of(term.eos, a.rho, a.T), pressure_of(term.eos, b.rho, b.T) + b.hydro
    P = P_a + P_b - 2*a.P
    return 0.0, -ab.sx*P, -ab.sy*P, -P_a*(ab.sx*b.vx + ab.sy*b.vy) - P_b*(ab.sx*a.vx + ab.sy*a.vy)


@pair_term(4, "eos")
def BlendedPressure(term, a, b, ab):
    """Share w of {P}, 1 - w of the crossed P_a T_b/T_a and P_b T_a/T_b, which is `Pressure` of an ideal gas.

    Where P_a = P_b the crossed pressure is too large by the share x = (DT)^2/(2 T_a T_b). With y = DP/{P} and
    w = x^2/(x^2 + y^2), at most 5/4 |DP| is added to {P}, and nothing at a contact; w is of second order in
    smooth flow. Both pressures conserve entropy, and so does any blend with the same w from both ends.
    """
    P_a, P_b, ratio = pressure_of(term.eos, a.rho, a.T), pressure_of(term.eos, b.rho, b.T), b.T/a.T
    x, y = (b.T - a.T)**2/(2*a.T*b.T), 2*(P_b - P_a)/(P_a + P_b)
    cross = y*y/(x*x + y*y + 1e-300)
    with_a = cross*P_a*ratio + (1 - cross)*P_b + b.hydro
    with_b = cross*P_b/ratio + (1 - cross)*P_a
    P = with_a + with_b - 2*a.P
    return (0.0, -ab.sx*P, -ab.sy*P,
            -with_a*(ab.sx*a.vx + ab.sy*a.vy) - with_b*(ab.sx*b.vx + ab.sy*b.vy))


@formula
def bend(d, one, other, jump):
    """psi of a difference d along an edge, and the share of d that the limited mean 2 a c/(a + c) of the
    differences a, c before and behind the edge leaves    [Jameson 1995]. one, other : twice what gradients at
    the two ends predict for d. jump : the dissipated difference, where it is not d."""
    a, c = one - d, other - d
    s = abs(a - 2*d + c)/(abs(a) + 2*max(abs(d), abs(jump)) + abs(c) + 1e-300)
    both = (a + c)*d
    line = 2*max(a*c, 0.0)*both/(both*both + 1e-300)
    return s**STEEP, min(1.0, max(0.0, 1 - line))


@formula
def calm(d, one, other, scale):
    """Whether psi is below CALM, or the bend of the field is round-off."""
    return abs(one + other - 4*d) <= STILL*(abs(one - d) + 2*abs(d) + abs(other - d)) + ROUNDING*scale


@formula
def turning(a):
    """(rot v)^2 plus the excess of the strain (u_x - v_y)^2 + (u_y + v_x)^2 over (div v)^2, which is positive
    between vortices and zero in plane sound waves."""
    strain = (a.u_x - a.v_y)**2 + (a.u_y + a.v_x)**2
    return (a.v_x - a.u_y)**2 + max(0.0, strain - (a.u_x + a.v_y)**2)


@formula
def unturned(a, b, ab):
    """(div v)^2/((div v)^2 + `turning`) of two points; 1 where both are far below (CALM c/length)^2. Tells
    shocks from the pressure field that holds a vortex together    [Ducros et al. 1999]"""
    along = ab.dx*ab.dx + ab.dy*ab.dy
    shrinks = CALM*CALM*a.c*b.c + along*((a.u_x + a.v_y)**2 + (b.u_x + b.v_y)**2)
    return shrinks/(shrinks + along*(turning(a) + turning(b)))


@formula
def shock(a, b, ab, bend):
    """Shares of what the limited mean leaves that dissipate: that of pressure, w s^2/(s^2 + CALM^2), where
    s = STEEPEST bend, w = `unturned`, and that of velocity and entropy. bend : of pressure, over 2 {P}."""
    wave, steep = unturned(a, b, ab), STEEPEST*bend
    s2 = steep*steep
    return wave*s2/(s2 + CALM*CALM), min(1.0, wave*steep)


@formula
def jumps(a, b, ab):
    """(d, one, other) of `bend` along an edge, for P, rho, v_x and v_y."""
    x, y, mean = 2*ab.dx, 2*ab.dy, 0.5*(a.rho + b.rho)
    # to an image: without hydrostatic pressure, so that the same comes back over the edge of its parent
    weight = mean*b.g
    P = (b.P - a.P + mean*b.hydro/b.rho + weight*ab.dy, x*a.P_x + y*(a.P_y + weight),
         x*b.P_x + y*(b.P_y - weight))
    return (P, (b.rho - a.rho, x*a.rho_x + y*a.rho_y, x*b.rho_x + y*b.rho_y),
            (b.vx - a.vx, x*a.u_x + y*a.u_y, x*b.u_x + y*b.u_y),
            (b.vy - a.vy, x*a.v_x + y*a.v_y, x*b.v_x + y*b.v_y))


@formula
def astir(a, b, ab, P, r, by_x, by_y):
    """Whether an edge dissipates. Evaluates all conditions: a branch would prevent vector instructions."""
    sx, sy, (dP, P0, P1), (drho, r0, r1), (du, u0, u1), (dv, v0, v1) = ab.sx, ab.sy, P, r, by_x, by_y
    c2, both, speed = a.c*b.c, a.P + b.P, (abs(sx) + abs(sy))*(a.c + b.c)
    return not ((STEEPEST*abs(P0 + P1 - 4*dP) <= FAINT*both) & calm(dP, P0, P1, both)
                & calm(c2*drho - dP, c2*r0 - P0, c2*r1 - P1, both)
                & calm(sx*du + sy*dv, sx*u0 + sy*v0, sx*u1 + sy*v1, speed)
                & calm(sx*dv - sy*du, sx*v0 - sy*u0, sx*v1 - sy*u1, speed))


@pair_term(4, "eos")
def Dissipation(term, a, b, ab):
    """|S|/2 R L psi T R^T Dw: of jumps in sound, entropy and shear the part psi = s^m that no linear field
    explains, and more in shocks; of pressure also what Jameson's limited mean leaves, except where the flow
    rotates or strains. Points need gradients, edges (dx, dy)    [Barth 1999; Jameson 1995]"""
    P, r, by_x, by_y = jumps(a, b, ab)
    if astir(a, b, ab, P, r, by_x, by_y):
        return waves(term.eos, a, b, ab, P, r, by_x, by_y)
    return 0.0, 0.0, 0.0, 0.0


@generic
def acoustics(eos, a, b, rho, e):
    """c^2; h, which sound carries; D(rho e)/D(rho) at constant P, which entropy waves carry; the jump of g/T;
    weights of both waves, rho T/c^2 and rho T (1/c_T^2 - 1/c^2). rho, e : of `log_means`."""


@acoustics.of(IdealGas)
def _(eos, a, b, rho, e):
    gamma, mean, dbeta = 1 + 1/eos.cv, 0.5*(a.rho + b.rho), 1/b.T - 1/a.T
    c2 = gamma*2*mean/(1/a.T + 1/b.T)/rho
    return c2, c2*eos.cv, 0.0, (b.rho - a.rho)/rho + dbeta*e, rho/gamma, rho*(gamma - 1)/gamma


@formula
def waves(eos, a, b, ab, P, r, by_x, by_y):
    """Gains of a by dissipation of pressure waves, normal velocity, entropy and shear, from `jumps`.

    R R^T = dU/dq weighs sound and entropy as in `acoustics`, velocities by rho T    [Barth 1999]
    """
    size = np.sqrt(ab.sx*ab.sx + ab.sy*ab.sy)
    nx, ny = ab.sx/max(size, 1e-300), ab.sy/max(size, 1e-300)
    (dP, P0, P1), (drho, r0, r1), (du, u0, u1), (dv, v0, v1) = P, r, by_x, by_y
    rho, e = log_means(eos, a, b)
    c2, h, at_P, jump, of_sound, of_heat = acoustics(eos, a, b, rho, e)
    u, v, mean, dbeta = 0.5*(a.vx + b.vx), 0.5*(a.vy + b.vy), 0.5*(a.rho + b.rho), 1/b.T - 1/a.T
    un, ut, dun, dut = u*nx + v*ny, v*nx - u*ny, du*nx + dv*ny, dv*nx - du*ny
    of_P, P_line = bend(dP, P0, P1, b.P - a.P)
    of_n, n_line = bend(dun, u0*nx + v0*ny, u1*nx + v1*ny, dun)
    of_t, _ = bend(dut, v0*nx - u0*ny, v1*nx - u1*ny, dut)
    of_s, s_line = bend(drho - dP/c2, r0 - P0/c2, r1 - P1/c2, drho - (b.P - a.P)/c2)
    steep, sigma = shock(a, b, ab, abs(P0 + P1 - 4*dP)/(a.P + b.P))
    rx, ry = 0.5*(a.rx + b.rx), 0.5*(a.ry + b.ry)
    flow, fast = np.sqrt(rx*rx + ry*ry), fastest(a, b, ab)
    slow = size*np.sqrt((rx*nx + ry*ny)**2 + (SLOW*flow)**2)
    sound = fast*max(of_P, steep*P_line)*of_sound*(jump - h*dbeta)
    across = fast*min(1.0, max(flow/np.sqrt(c2), sigma))*max(of_n, sigma*n_line)*mean*dun
    heat = slow*max(of_s, sigma*s_line)*of_heat*(jump - at_P*dbeta)
    m, along = sound + heat, slow*of_t*mean*dut
    return (m, m*u + across*nx - along*ny, m*v + across*ny + along*nx,
            0.5*m*(a.vx*b.vx + a.vy*b.vy) + sound*h + heat*at_P + across*un + along*ut)


@formula
def against(a, b, ab):
    """S/2.(v_a - {w}), S/2.(v_b - {w}): velocities of both ends relative to their edge, from r = w - v."""
    apart, both = ab.sx*(b.vx - a.vx) + ab.sy*(b.vy - a.vy), ab.sx*(a.rx + b.rx) + ab.sy*(a.ry + b.ry)
    return -0.5*(apart + both), 0.5*(apart - both)


@formula
def fastest(a, b, ab):
    """|S|/2 (|(v - {w}).n| + c), the larger of two points' values."""
    size, (one, other) = np.sqrt(ab.sx*ab.sx + ab.sy*ab.sy), against(a, b, ab)
    return max(abs(one) + size*a.c, abs(other) + size*b.c)
