"""Compiled terms and loops of `closed_faces`: exchange through faces between moving points, in 2D."""
import numpy as np

from continuum.fluid import conductivity, pressure, sound_speed, temperature, viscosity
from continuum.jit import jit
from particles.pairs import pair_term, rate

#: convection, pressure read vx .. theta, g = grad P'; friction, heat ux, uy, Td; `Mending` F
Point = np.dtype([(name, "f8") for name in ("vx", "vy", "P", "rho", "e", "per_c", "shift_x", "shift_y",
                                            "theta", "gx", "gy", "ux", "uy", "Td", "eta", "k", "Fx", "Fy")])


@pair_term(6)
def FaceDifferences(term, a, b, ab):
    """V grad of v and P by differences: d_x u, d_y u, d_x v, d_y v, d_x P, d_y P."""
    du, dv, dP = b.ux - a.ux, b.uy - a.uy, b.P - a.P
    return ab.sx*du, ab.sy*du, ab.sx*dv, ab.sy*dv, ab.sx*dP, ab.sy*dP


@pair_term(6, "follow", "spread", "smooth", "transport")
def FaceExchange(term, a, b, ab):
    """Gains through a face: mass, momentum, energy, volume that flows, volume that points pass on."""
    sx, sy, k = ab.sx, ab.sy, ab.k
    to_a, to_b = sx*a.vx + sy*a.vy, sx*b.vx + sy*b.vy
    left = sx*(a.shift_x + b.shift_x) + sy*(a.shift_y + b.shift_y) + term.follow*k*(b.theta - a.theta)
    linear = 0.5*term.smooth*((a.gx + b.gx)*ab.dx + (a.gy + b.gy)*ab.dy)
    mass = left*0.5*(a.rho + b.rho) + 0.25*term.spread*(a.per_c + b.per_c)*k*(b.P - a.P - linear)
    P = a.P + b.P
    _, fx, fy, heat = rate(term.transport, a, b, ab)
    through = heat + 0.5*mass*(a.e + b.e + a.vx*b.vx + a.vy*b.vy) - a.P*to_b - b.P*to_a
    return (mass, fx - sx*P + 0.5*mass*(a.vx + b.vx), fy - sy*P + 0.5*mass*(a.vy + b.vy), through,
            to_a + to_b, left)


@jit
def read(first, last, state, eos, law, g0, shift, count, points):
    for i in range(first, last):
        a, m, V = points[i], state[6, i], state[7, i]
        a.vx, a.vy, a.rho = state[4, i]/m, state[5, i]/m, m/V
        a.e = state[8, i]/m - 0.5*(a.vx**2 + a.vy**2)
        a.P = pressure(eos, a.rho, a.e) + g0*state[1, i]
        a.Td, a.per_c = temperature(eos, a.rho, a.e), 1/sound_speed(eos, a.rho, a.e)
        a.ux, a.uy, a.shift_x, a.shift_y, a.theta = a.vx, a.vy, shift[i, 0], shift[i, 1], V*count[i] - 1
        a.eta, a.k = viscosity(law, a.rho, a.Td), conductivity(law, a.rho, a.Td)


@jit
def read_images(n, origin, turn, plate_T, points):
    """Copy fields of origins to images; odd fields change sign in mirrored ones."""
    for g in range(len(origin)):
        a, b = points[origin[g]], points[n + g]
        b.vx, b.P, b.rho, b.e, b.per_c = a.vx, a.P, a.rho, a.e, a.per_c
        b.shift_x, b.theta, b.eta, b.k = a.shift_x, a.theta, a.eta, a.k
        b.vy, b.shift_y, b.ux, b.uy = turn[g]*a.vy, turn[g]*a.shift_y, turn[g]*a.ux, turn[g]*a.uy
        b.Td = a.Td if turn[g] > 0 else 2*plate_T[g] - a.Td


@jit
def pressure_slopes(first, last, slopes, V, points):
    """Set grad P' from its slopes."""
    for i in range(first, last):
        a = points[i]
        a.gx, a.gy = slopes[i, 4]/V[i], slopes[i, 5]/V[i]


@jit
def per_time(first, last, total, state, points, g, rho0, P0, out):
    """Static pressure carries the weight of rho0; the pressure left out works on volume that flows."""
    for i in range(first, last):
        mass, px, py, through, flow, left = total[i]
        out[4, i], out[5, i] = px, py - g*(state[6, i] - rho0*state[7, i])
        out[6, i], out[7, i] = mass, flow + left
        held = P0 - rho0*g*state[1, i]
        out[8, i] = through - held*flow - g*(state[6, i] - rho0*state[7, i])*points[i].vy
