"""The sums of `layer` for an ideal gas with constant viscosity and conductivity, along edges with the heating mended.

There P_ij = rho_i T_j, and every bracket of Eqs 34-36 and 51 is made of products of a point's own fields with sums over its
neighbours, such as sum_j S.(rho_i v_j + rho_j v_i) = rho_i sum_j S.v_j + v_i.sum_j S rho_j. Edges then carry linear sums only,
which vector instructions do several at a time; fields meet once a point. Sums are of differences to the point,
sum_j S (f_j - f_i): of whole fields they would lose digits, and with them the conservation that edges give. Equal to `layer` to
round-off.
"""
from math import fsum
from typing import Any, NamedTuple

import numpy as np

from continuum.fluid import conductivity, temperature, viscosity
from continuum.jit import jit
from particles.pairs import nothing, rate, sweep

#: what a neighbour gives: fields for S (rho .. uy), for k (ux .. q, q = u^2/2); vx without friction; u, Td, q with it
Given = np.dtype([(name, "f8") for name in ("rho", "mx", "my", "T", "eps", "hydro", "ux", "uy", "Td", "q", "vx", "vy")])
Lack = np.dtype([("Fx", "f8"), ("Fy", "f8")])


class LinearSums(NamedTuple):
    """sum S_x, S_y and k times what the fields of the neighbours differ."""


class LackSums(NamedTuple):
    """sum S.F."""


nothing.of(LinearSums)(lambda term: (0.0,)*21)
nothing.of(LackSums)(lambda term: (0.0,))


@rate.of(LinearSums)
def _(term, a, b, ab):
    x, y, k = ab.sx, ab.sy, ab.k
    rho, mx, my, T, eps, hydro = b.rho - a.rho, b.mx - a.mx, b.my - a.my, b.T - a.T, b.eps - a.eps, b.hydro
    u, v = b.ux - a.ux, b.uy - a.uy
    return (x*rho, x*mx, x*my, x*T, x*eps, x*hydro, x*u, x*v, y*rho, y*mx, y*my, y*T, y*eps, y*hydro, y*u, y*v,
            k*u, k*v, k*(b.Td - a.Td), k*(b.q - a.q), x*(b.vx - a.vx))


@rate.of(LackSums)
def _(term, a, b, ab):
    return (ab.sx*(b.Fx - a.Fx) + ab.sy*(b.Fy - a.Fy),)


class IdealSums:
    """Rates of an `Exchanging` whose fluid this form fits."""

    def __init__(self, layer: Any):
        self.layer, edges, n = layer, layer.edges, layer.n
        points = len(layer.points)
        self.given, self.lack = np.zeros(points, Given), np.zeros(points, Lack)
        self.sums, self.lost = np.empty((n, 21)), np.empty((n, 1))
        #: sum_j S_ij, images included, exact: what rounding left here, every step would push the same way
        self.open = np.array([[2*fsum(part) for part in np.split(q, edges.first[1:])] for q in (edges.sx, edges.sy)]).T.copy()

    def rates(self, state: np.ndarray, out: np.ndarray) -> None:
        """d(state)/dt, written to `out`    [Eqs 34-36, 51]"""
        layer, method = self.layer, self.layer.method
        team, n, V = layer.team, layer.n, method.edges.V
        eta, k = viscosity(method.law, 1.0, 1.0), conductivity(method.law, 1.0, 1.0)
        team(_given, n, state, method.eos, self.given)
        _given_images(layer.parent, layer.plate, layer.rise, np.array(method.T_plates), method.g, self.given, n)
        team(sweep, n, LinearSums(), self.given, layer.edges, self.sums)
        team(_lacks, n, self.given, self.sums, V, eta, self.lack)
        _lack_images(layer.parent, self.lack, n)
        team(sweep, n, LackSums(), self.lack, layer.edges, self.lost)
        team(_products, n, self.given, self.sums, self.open, self.lack, self.lost, V, eta, k, method.g, out)


@jit
def _given(first, last, state, eos, given):
    for i in range(first, last):
        a, rho, mx, my = given[i], state[0, i], state[1, i], state[2, i]
        u, v = mx/rho, my/rho
        a.rho, a.mx, a.my, a.eps, a.hydro = rho, mx, my, state[3, i], 0.0
        a.q = 0.5*(u*u + v*v)
        a.T = temperature(eos, rho, a.eps/rho - a.q)
        a.ux, a.uy, a.vx, a.vy, a.Td = u, v, u, v, a.T


@jit
def _given_images(parent, plate, rise, T_plates, g, given, n):
    """Images without friction: rho, T, eps, the velocity along; with it: -v, 2 T_w - T."""
    for m in range(len(parent)):
        a, b = given[parent[m]], given[n + m]
        b.rho, b.mx, b.my, b.T, b.eps, b.hydro = a.rho, a.mx, -a.my, a.T, a.eps, a.rho*g*rise[m]
        b.ux, b.uy, b.Td, b.q, b.vx = -a.ux, -a.uy, 2*T_plates[plate[m]] - a.Td, a.q, a.vx


@jit
def _lacks(first, last, given, sums, V, eta, lack):
    """F = eta (v u_y - u v_y, u v_x - v u_x) from slopes by differences."""
    for i in range(first, last):
        a, s, f = given[i], sums[i], eta/V[i]
        lack[i].Fx, lack[i].Fy = f*(a.uy*s[14] - a.ux*s[15]), f*(a.ux*s[7] - a.uy*s[6])


@jit
def _lack_images(parent, lack, n):
    for m in range(len(parent)):
        lack[n + m].Fx, lack[n + m].Fy = lack[parent[m]].Fx, -lack[parent[m]].Fy


@jit
def _products(first, last, given, sums, open, lack, lost, V, eta, kappa, g, out):
    """Sums of differences, and what the point's own fields bring where its edges do not close."""
    for i in range(first, last):
        a, s, sx, sy, f = given[i], sums[i], open[i, 0], open[i, 1], 1/V[i]
        u, v, rho, T = a.vx, a.vy, a.rho, a.T
        out_of, flow = sx*u + sy*v, s[20] + s[15]               # S.v: along y both images have the same velocity
        mass = rho*flow + u*s[0] + v*s[8] + rho*out_of
        px = rho*flow*u + u*s[1] + v*s[9] + rho*s[3] + T*s[0] + s[5] + rho*(u*out_of + T*sx)
        py = rho*flow*v + u*s[2] + v*s[10] + rho*s[11] + T*s[8] + s[13] + rho*(v*out_of + T*sy)
        work = u*(rho*s[3] + s[5]) + v*(rho*s[11] + s[13]) + T*(s[1] + s[10]) + rho*T*out_of
        through = a.eps*(flow + out_of) + u*s[4] + v*s[12] + work
        heat = eta*s[19] + kappa*s[18] + sx*lack[i].Fx + sy*lack[i].Fy + lost[i, 0]
        out[0, i] = -f*mass
        out[1, i], out[2, i] = f*(eta*s[16] - px), f*(eta*s[17] - py) - g*rho
        out[3, i] = f*(heat - through) - g*rho*v
