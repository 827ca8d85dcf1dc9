"""What all methods on fixed points share, compiled: the brackets of `dih` over stored edges, fields, what the time loop asks for.

In 2D; friction goes along edges [RR98 Eq. 51] without bulk viscosity.
"""
from math import fsum
from typing import Any, NamedTuple

import numpy as np

from continuum.fluid import conductivity, energy, pressure, temperature, valid, viscosity
from continuum.jit import formula, jit
from particles.integral.edges import Beyond, Edges
from particles.neighbours import u32, u64
from particles.pairs import Stored, nothing, rate, sweep
from particles.threads import Team

#: seen by convection and pressure: vx .. eps, hydro; by friction and heat: ux, uy, Td; F mends the heating; P is the point's own
FIELDS = "rho vx vy T eps ux uy Td eta k Fx Fy hydro P"
Point = np.dtype([(name, "f8") for name in FIELDS.split()])


class Exchange(NamedTuple):
    """Brackets of Eqs 34-36 with P_ab = P(rho_a, T_b), friction and heat along the edge [Eq. 51, zeta = 0], and F.

    The momentum is that of the pressures P_ab + P_ba less 2 P_a, a number of the row: `exchange` adds what this takes off. Where
    the point's own P is left at zero, as between sliding sides, the sums are whole.
    """
    eos: Any


class Differences(NamedTuple):
    """V grad v by differences: d_x u, d_y u, d_x v, d_y v."""


nothing.of(Exchange)(lambda term: (0.0, 0.0, 0.0, 0.0))
nothing.of(Differences)(lambda term: (0.0, 0.0, 0.0, 0.0))


@formula
def _pressure(eos, rho, T):
    return pressure(eos, rho, energy(eos, rho, T))


@rate.of(Exchange)
def _(term, a, b, ab):
    to_b, to_a = ab.sx*b.vx + ab.sy*b.vy, ab.sx*a.vx + ab.sy*a.vy       # S.v/2
    P_ab, P_ba = _pressure(term.eos, a.rho, b.T) + b.hydro, _pressure(term.eos, b.rho, a.T)
    from_a, from_b, P = a.rho*to_b, b.rho*to_a, P_ab + P_ba - 2*a.P
    f, du, dv = 0.5*(a.eta + b.eta)*ab.k, b.ux - a.ux, b.uy - a.uy
    through = a.eps*to_b + b.eps*to_a + P_ab*to_a + P_ba*to_b
    friction = f*0.5*(du*(a.ux + b.ux) + dv*(a.uy + b.uy)) + 0.5*(a.k + b.k)*ab.k*(b.Td - a.Td)
    mend = ab.sx*(a.Fx + b.Fx) + ab.sy*(a.Fy + b.Fy)
    return (-from_a - from_b, f*du - from_a*a.vx - from_b*b.vx - ab.sx*P, f*dv - from_a*a.vy - from_b*b.vy - ab.sy*P,
            friction + mend - through)


@rate.of(Differences)
def _(term, a, b, ab):
    du, dv = b.ux - a.ux, b.uy - a.uy
    return ab.sx*du, ab.sy*du, ab.sx*dv, ab.sy*dv


def exchange(team: Team, n: int, eos: Any, points: np.ndarray, edges: Stored, open: np.ndarray, total: np.ndarray) -> None:
    """Sums of `Exchange` (n, 4) over edges whose area vectors add up to open (n, 2), of `opened`.

    Whole pressures, many times what they differ by, would leave a rounding in every row, one way at every step.
    """
    team(_own_pressure, n, eos, points)
    team(sweep, n, Exchange(eos), points, edges, total)
    team(_open, n, open, points, total)


def opened(edges: Stored) -> np.ndarray:
    """sum_j S_ij of each row, images included, exact: (n, 2), zero where edges close."""
    return np.array([[2*fsum(part) for part in np.split(q, edges.first[1:])] for q in (edges.sx, edges.sy)]).T.copy()


@jit
def _own_pressure(first, last, eos, points):
    for i in range(first, last):
        a = points[i]
        a.P = _pressure(eos, a.rho, a.T)


@jit
def _open(first, last, open, points, total):
    for i in range(first, last):
        total[i, 1] -= open[i, 0]*points[i].P
        total[i, 2] -= open[i, 1]*points[i].P


class Summing:
    """What the time loop asks of sums over edges of points that stay."""
    method: Any

    def rates(self, state: np.ndarray, out: np.ndarray) -> None:
        """d(state)/dt, written to `out`."""
        raise NotImplementedError

    def resume(self, now: Any) -> None:
        """Fixed points have no lists to make again."""

    def try_out(self, now: Any) -> None:
        """One evaluation that leaves no trace."""
        self.rates(now.state, np.empty_like(now.state))

    def make_ready(self, now: Any, dt: float) -> None:
        """Nothing: edges are made once."""

    def confine(self, state: np.ndarray) -> int:
        """Nothing moves."""
        return 0

    def fault(self, state: np.ndarray, ids: np.ndarray) -> str:
        """The first point outside of the equation of state; empty if there is none."""
        i = first_invalid(state, self.method.eos)
        if i == state.shape[1]:
            return ""
        rho, e = inner(*state[:4, i])
        return f"point {i} has rho = {rho:.6g}, e = {e:.6g}, outside the validity of {type(self.method.eos).__name__}"


def states(eos: Any, rho: np.ndarray, v: np.ndarray, T: np.ndarray) -> np.ndarray:
    """(4, n) of densities, velocities (n, 2), temperatures."""
    return np.stack([rho, *(rho[:, None]*v).T, rho*(energy(eos, rho, T) + (v**2).sum(axis=1)/2)])


@formula
def inner(rho, px, py, eps):
    """Density and internal energy per mass."""
    return rho, (eps - (px*px + py*py)/(2*rho))/rho


@jit
def first_invalid(state, eos):
    """The first point that the equation of state does not take; their number if there is none."""
    for i in range(state.shape[1]):
        rho, e = inner(state[0, i], state[1, i], state[2, i], state[3, i])
        if not valid(eos, rho, e):
            return i
    return state.shape[1]


def check_number(n: int, points: int) -> None:
    """Refuse a state of other points."""
    if n != points:
        raise ValueError(f"a state of {n} points for {points} fixed ones: make it with `state`")


def stored(edges: Edges, beyond: Beyond, image: np.ndarray) -> Stored:
    """Edges by rows: those to other points, in both directions, and those to images, numbered `image`."""
    rows = np.concatenate([edges.i, edges.j, beyond.i])
    near = np.concatenate([edges.j, edges.i, image])
    order = np.lexsort((near, rows))
    S = np.concatenate([edges.S, -edges.S, beyond.S])[order]/2
    k = np.concatenate([edges.k, edges.k, beyond.k])[order]
    taken = np.bincount(rows, minlength=edges.n)
    first = np.cumsum(taken) - taken
    return Stored(first.astype(u64), taken.astype(u32), near[order].astype(u32), S[:, 0].copy(), S[:, 1].copy(), k)


@jit
def read(first, last, state, eos, law, share, points):
    """Fields of points first..last; friction and heat along edges have a share of the coefficients."""
    for i in range(first, last):
        a, rho = points[i], state[0, i]
        a.rho, a.vx, a.vy, a.eps = rho, state[1, i]/rho, state[2, i]/rho, state[3, i]
        a.T = temperature(eos, rho, a.eps/rho - 0.5*(a.vx**2 + a.vy**2))
        a.ux, a.uy, a.Td = a.vx, a.vy, a.T
        a.eta, a.k = share*viscosity(law, rho, a.T), share*conductivity(law, rho, a.T)


@jit
def lacking(first, last, slopes, V, points):
    """F = eta (v u_y - u v_y, u v_x - v u_x), in 2D without bulk viscosity: `dih.lacking`."""
    for i in range(first, last):
        a, f = points[i], points[i].eta/V[i]
        ux, uy, vx, vy = slopes[i]
        a.Fx, a.Fy = f*(a.vy*uy - a.vx*vy), f*(a.vx*vx - a.vy*ux)


@jit
def driven(first, last, total, V, points, push, out):
    """Rates of free points: what edges bring, and the force per mass."""
    for i in range(first, last):
        a = points[i]
        out[0, i], out[1, i] = total[i, 0]/V[i], total[i, 1]/V[i] + push[0]*a.rho
        out[2, i] = total[i, 2]/V[i] + push[1]*a.rho
        out[3, i] = total[i, 3]/V[i] + (push[0]*a.vx + push[1]*a.vy)*a.rho
