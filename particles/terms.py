"""Pair terms: two particles and their geometry in, what the pair adds to the sum of the first one out.

The papers' symbols: a, b are the two particles, (ab.wx, ab.wy) = grad_a m w(r_ab). A new term is one NamedTuple here.
"""
from typing import NamedTuple

from continuum.jit import generic
from particles.pairs import nothing, rate


class Gradients(NamedTuple):
    """sum_b sqrt(1/rho_b) {v_b - v_a, T_b - T_a} grad_a m w: times sqrt(1/rho_a), the printed gradients of v and T

    with the geometric mean density rho_ab = sqrt(rho_a rho_b)    [KHP95, Sec. II].
    """


class ArithmeticGradients(NamedTuple):
    """The same with the arithmetic mean rho_ab = (rho_a + rho_b)/2, the other choice that KHP95 name."""


@generic
def partner_factor(term, rho):
    """What the record of a partner holds as s, so that its share of 1/rho_ab costs nothing in the loop."""


@generic
def row_factor(term, rho):
    """The row's share of 1/rho_ab, after the sum."""


partner_factor.of(Gradients)(lambda term, rho: rho**-0.5)
row_factor.of(Gradients)(lambda term, rho: rho**-0.5)
partner_factor.of(ArithmeticGradients)(lambda term, rho: rho)
row_factor.of(ArithmeticGradients)(lambda term, rho: 1.0)


class Fluxes(NamedTuple):
    """Acceleration and heating by P/rho^2 and Q/rho^2    [KHP95, Sec. II]

    a_a = -sum_b [(P/rho^2)_a + (P/rho^2)_b].grad w,
    de_a = -sum_b (1/2) [(P/rho^2)_a + (P/rho^2)_b] : (v_b - v_a) grad w - sum_b [(Q/rho^2)_a + (Q/rho^2)_b].grad w
    """


nothing.of(Gradients)(lambda term: (0.0, 0.0, 0.0, 0.0, 0.0, 0.0))
nothing.of(ArithmeticGradients)(lambda term: (0.0, 0.0, 0.0, 0.0, 0.0, 0.0))
nothing.of(Fluxes)(lambda term: (0.0, 0.0, 0.0))


@rate.of(Gradients)
def _(term, a, b, ab):
    x, y = b.s*ab.wx, b.s*ab.wy
    u, v, T = b.vx - a.vx, b.vy - a.vy, b.T - a.T
    return u*x, v*x, T*x, u*y, v*y, T*y


@rate.of(ArithmeticGradients)
def _(term, a, b, ab):
    f = 2/(a.s + b.s)
    x, y = f*ab.wx, f*ab.wy
    u, v, T = b.vx - a.vx, b.vy - a.vy, b.T - a.T
    return u*x, v*x, T*x, u*y, v*y, T*y


@rate.of(Fluxes)
def _(term, a, b, ab):
    fx = (a.xx + b.xx)*ab.wx + (a.xy + b.xy)*ab.wy
    fy = (a.xy + b.xy)*ab.wx + (a.yy + b.yy)*ab.wy
    q = (a.qx + b.qx)*ab.wx + (a.qy + b.qy)*ab.wy
    return -fx, -fy, -0.5*((b.vx - a.vx)*fx + (b.vy - a.vy)*fy) - q


class DirectFluxes(NamedTuple):
    """Pressure as in `Fluxes`; viscosity and conduction directly from differences along the pair, without gradients:

    a_a = sum_b [(eta_a + eta_b)/(rho_a rho_b)] (v_a - v_b) F m, de_a = the work of that force shared equally
    + sum_b [(k_a + k_b)/(rho_a rho_b)] (T_a - T_b) F m, F = w'/r (the forms known by Morris and by Brookshaw).
    """


nothing.of(DirectFluxes)(lambda term: (0.0, 0.0, 0.0))


@rate.of(DirectFluxes)
def _(term, a, b, ab):
    x, y, u, v = a.x - b.x, a.y - b.y, a.vx - b.vx, a.vy - b.vy
    # two particles in one place exert no force on each other
    F = (x*ab.wx + y*ab.wy)/max(x*x + y*y, 1e-300)*a.irho*b.irho
    p, drag = a.P_rho2 + b.P_rho2, (a.eta + b.eta)*F
    fx, fy = p*ab.wx - drag*u, p*ab.wy - drag*v
    return -fx, -fy, 0.5*(u*fx + v*fy) + (a.k + b.k)*F*(a.T - b.T)
