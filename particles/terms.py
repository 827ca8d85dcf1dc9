"""Pair terms: two particles and their geometry in, what the pair adds to the sum of the first one out.

The papers' symbols: a, b are the two particles, (ab.wx, ab.wy) = grad_a m w(r_ab).
"""
from typing import NamedTuple

import numpy as np

from continuum.jit import generic
from particles.pairs import pair_term


class Gradients(NamedTuple):
    """Gradients of v and T: sum_b {v_b - v_a, T_b - T_a} grad_a m w/rho_ab

    with the geometric mean density rho_ab = sqrt(rho_a rho_b)    [KHP95, Sec. II].
    """


class ArithmeticGradients(NamedTuple):
    """The same with the arithmetic mean rho_ab = (rho_a + rho_b)/2, the other choice that KHP95 name."""


@generic
def summand(term, rho, vx, vy, T):
    """Fields of a record (vx, vy, T, s), as the pair term wants them."""


@generic
def finish(term, a, sums):
    """Make gradients at a record of its sums over partners, in place."""


finish.of(ArithmeticGradients)(lambda term, a, sums: None)


class Fluxes(NamedTuple):
    """Acceleration and heating by P/rho^2 and Q/rho^2    [KHP95, Sec. II]

    a_a = -sum_b [(P/rho^2)_a + (P/rho^2)_b].grad w,
    de_a = -sum_b (1/2) [(P/rho^2)_a + (P/rho^2)_b] : (v_b - v_a) grad w - sum_b [(Q/rho^2)_a +
    (Q/rho^2)_b].grad w

    Both are linear in what b brings: P/rho^2, h = Q/rho^2 + v.P/2rho^2, v and 1. Pairs sum these times grad
    w, and `particles.smooth.fluxes.closed` has the rest.
    """


@pair_term(Gradients, 8)
def _(term, a, b, ab):
    x, y = ab.wx, ab.wy
    return b.vx*x, b.vy*x, b.T*x, b.s*x, b.vx*y, b.vy*y, b.T*y, b.s*y


@summand.of(Gradients)
def _(term, rho, vx, vy, T):
    s = 1/np.sqrt(rho)
    return s*vx, s*vy, s*T, s


@finish.of(Gradients)
def _(term, a, sums):
    """s_a sum_b s_b (f_b - f_a) grad w from sums of s_b f_b grad w."""
    x, y = sums[3], sums[7]
    sums[0], sums[1], sums[2] = a.s*sums[0] - a.vx*x, a.s*sums[1] - a.vy*x, a.s*sums[2] - a.T*x
    sums[4], sums[5], sums[6] = a.s*sums[4] - a.vx*y, a.s*sums[5] - a.vy*y, a.s*sums[6] - a.T*y


@pair_term(ArithmeticGradients, 8)
def _(term, a, b, ab):
    f = 2/(a.s + b.s)
    x, y, u, v, T = f*ab.wx, f*ab.wy, b.vx - a.vx, b.vy - a.vy, b.T - a.T
    return u*x, v*x, T*x, 0.0, u*y, v*y, T*y, 0.0


summand.of(ArithmeticGradients)(lambda term, rho, vx, vy, T: (vx, vy, T, rho))


@pair_term(Fluxes, 16)
def _(term, a, b, ab):
    # eight fields one behind the other, times x and times y: four vector instructions
    x, y = ab.wx, ab.wy
    return (b.xx*x, b.xy*x, b.hx*x, b.vx*x, b.one*x, b.yy*x, b.hy*x, b.vy*x,
            b.xx*y, b.xy*y, b.hx*y, b.vx*y, b.one*y, b.yy*y, b.hy*y, b.vy*y)


class DirectFluxes(NamedTuple):
    """Pressure as in `Fluxes`; viscosity and conduction from differences along the pair:

    a_a = sum_b [(eta_a + eta_b)/(rho_a rho_b)] (v_a - v_b) F m, de_a = the work of that force shared equally
    + sum_b [(k_a + k_b)/(rho_a rho_b)] (T_a - T_b) F m, F = w'/r [Morris, Brookshaw].
    """


@pair_term(DirectFluxes, 3)
def _(term, a, b, ab):
    x, y, u, v = a.x - b.x, a.y - b.y, a.vx - b.vx, a.vy - b.vy
    # two particles in one place exert no force on each other
    F = (x*ab.wx + y*ab.wy)/max(x*x + y*y, 1e-300)*a.irho*b.irho
    p, drag = a.P_rho2 + b.P_rho2, (a.eta + b.eta)*F
    fx, fy = p*ab.wx - drag*u, p*ab.wy - drag*v
    return -fx, -fy, 0.5*(u*fx + v*fy) + (a.k + b.k)*F*(a.T - b.T)
