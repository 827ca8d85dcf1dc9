"""Pair terms of smooth particles: contributions of a pair to the sum of its first particle.

Symbols are those of the papers: a, b are the two particles, (ab.wx, ab.wy) = grad_a m w(r_ab).
"""
import numpy as np

from continuum.jit import formula, generic
from particles.pairs import pair_term


@generic
def density_factor(term, rho):
    """Factor s of a record, from which the loop computes 1/rho_ab at little cost."""


@pair_term(8)
def Gradients(term, a, b, ab):
    """Gradients of v and T: sum_b {v_b - v_a, T_b - T_a} grad_a m w/rho_ab

    with the geometric mean density rho_ab = sqrt(rho_a rho_b)    [KHP95, Sec. II].
    """
    return _differences(a, b, a.s*b.s*ab.wx, a.s*b.s*ab.wy)


@pair_term(8)
def ArithmeticGradients(term, a, b, ab):
    """As `Gradients`, with the arithmetic mean rho_ab = (rho_a + rho_b)/2, the other choice of KHP95."""
    f = 2/(a.s + b.s)
    return _differences(a, b, f*ab.wx, f*ab.wy)


density_factor.of(Gradients)(lambda term, rho: 1/np.sqrt(rho))
density_factor.of(ArithmeticGradients)(lambda term, rho: rho)


@formula
def _differences(a, b, x, y):
    """Differences of vx, vy, T times x, then times y; with s they are four and fill a vector register."""
    u, v, T, s = b.vx - a.vx, b.vy - a.vy, b.T - a.T, b.s - a.s
    return u*x, v*x, T*x, s*x, u*y, v*y, T*y, s*y


@pair_term(5)
def Fluxes(term, a, b, ab):
    """Acceleration and heating by P/rho^2 and Q/rho^2    [KHP95, Sec. II]

    a_a = -sum_b [(P/rho^2)_a + (P/rho^2)_b].grad m w,
    de_a = -sum_b (1/2) [(P/rho^2)_a + (P/rho^2)_b] : (v_b - v_a) grad m w - sum_b [(Q/rho^2)_a +
    (Q/rho^2)_b].grad m w
    """
    # four sums of the same form fill a vector register; the fourth is not used
    fx = (a.xx + b.xx)*ab.wx + (a.yx + b.yx)*ab.wy
    fy = (a.xy + b.xy)*ab.wx + (a.yy + b.yy)*ab.wy
    q = (a.qx + b.qx)*ab.wx + (a.qy + b.qy)*ab.wy
    v = (a.vx + b.vx)*ab.wx + (a.vy + b.vy)*ab.wy
    return -fx, -fy, -q, -v, -0.5*((b.vx - a.vx)*fx + (b.vy - a.vy)*fy)


@pair_term(3)
def DirectFluxes(term, a, b, ab):
    """Pressure as in `Fluxes`; viscosity and conduction from differences along the pair:

    a_a = sum_b [(eta_a + eta_b)/(rho_a rho_b)] (v_a - v_b) F m, de_a = half of the work of this force
    + sum_b [(k_a + k_b)/(rho_a rho_b)] (T_a - T_b) F m, F = w'/r [Morris, Brookshaw].
    """
    x, y, u, v = a.x - b.x, a.y - b.y, a.vx - b.vx, a.vy - b.vy
    # two particles in one place exert no force on each other
    F = (x*ab.wx + y*ab.wy)/max(x*x + y*y, 1e-300)*a.irho*b.irho
    p, drag = a.P_rho2 + b.P_rho2, (a.eta + b.eta)*F
    fx, fy = p*ab.wx - drag*u, p*ab.wy - drag*v
    return -fx, -fy, 0.5*(u*fx + v*fy) + (a.k + b.k)*F*(a.T - b.T)
