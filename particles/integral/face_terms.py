"""What goes through the faces between moving points: terms of `closed_faces`, in 2D."""
from typing import NamedTuple

from particles.integral.exchange import Listing
from particles.pairs import nothing, rate


class FaceDifferences(NamedTuple):
    """V grad of v and P by differences: d_x u, d_y u, d_x v, d_y v, d_x P, d_y P."""


class FaceExchange(NamedTuple):
    """What a face lets through: mass, momentum, energy, volume twice (with the fluid, between points)."""
    follow: float
    spread: float
    smooth: float
    transport: Listing


nothing.of(FaceDifferences)(lambda term: (0.0, 0.0, 0.0, 0.0, 0.0, 0.0))
nothing.of(FaceExchange)(lambda term: (0.0, 0.0, 0.0, 0.0, 0.0, 0.0))


@rate.of(FaceDifferences)
def _(term, a, b, ab):
    du, dv, dP = b.ux - a.ux, b.uy - a.uy, b.P - a.P
    return ab.sx*du, ab.sy*du, ab.sx*dv, ab.sy*dv, ab.sx*dP, ab.sy*dP


@rate.of(FaceExchange)
def _(term, a, b, ab):
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
