"""Euler steps over edges that keep rho, e > 0, whatever is listed in place of convection and pressure.

A short enough step with Rusanov's flux keeps both positive [Perthame & Shu 1996], also on moving edges. Where
a step with listed terms does not, edges leave out a part of their exchange beyond Rusanov's flux, so that no
edge takes more than its share from either point. Points are records of `lanes`.
"""
from typing import Any

import numpy as np

from continuum.fluid import IdealGas
from continuum.jit import formula, generic, jit
from particles.integral.entropy_fluxes import against, fastest
from particles.integral.exchange import Listing
from particles.integral.fixed import first_invalid, inner
from particles.integral.lanes import LOW
from particles.integral.once import Sending
from particles.lists import Ghosts
from particles.pairs import Faces, pair_term, rate, sweep
from particles.threads import Threads

COURANT, KEPT = 0.9, 0.1        # part of the step proven positive; of low-order density and energy that stays
LEAST = 1e-6                    # part of a step below which it is not halved again
#: Runge-Kutta: a stage is an Euler step of PART of the step, averaged with the start, whose share is OLD;
#: third order, strong-stability preserving: it keeps what each Euler step keeps    [Kraaijevanger 1991]
PART, OLD = 0.5, (0.0, 0.0, 2/3, 0.0)


@pair_term(8)
def Slopes(term, a, b, ab):
    """V times the gradients of v, rho and P by differences, d_x u, d_y u, d_x v, d_y v, d_x rho, ..."""
    x, y, rho, u, v, P = ab.sx, ab.sy, b.rho - a.rho, b.vx - a.vx, b.vy - a.vy, b.P + b.hydro - a.P
    return x*u, y*u, x*v, y*v, x*rho, y*rho, x*P, y*P


@pair_term(1)
def Sound(term, a, b, ab):
    """Speed of the fastest wave times area, |S|/2 (|(v - {w}).n| + c)."""
    return (fastest(a, b, ab),)


@pair_term(4, "terms")
def Excess(term, a, b, ab):
    """Exchange by listed terms minus Rusanov's flux."""
    most, P, (to_a, to_b) = fastest(a, b, ab), b.P - a.P + b.hydro, against(a, b, ab)
    one, other = to_a + most, to_b - most
    work = (a.P + b.hydro)*(ab.sx*a.vx + ab.sy*a.vy) + b.P*(ab.sx*b.vx + ab.sy*b.vy)
    m, px, py, e = rate(term.terms, a, b, ab)
    return (m + one*a.rho + other*b.rho, px + one*a.rho*a.vx + other*b.rho*b.vx + ab.sx*P,
            py + one*a.rho*a.vy + other*b.rho*b.vy + ab.sy*P, e + one*a.eps + other*b.eps + work)


@formula
def share(a, rho, px, py, eps):
    """Largest part <= 1 of a change that leaves KEPT of a point's low-order density and internal energy."""
    part = min(1.0, (1 - KEPT)*a.low_rho/max(-rho, 1e-300))
    heat = a.low_eps - (a.low_px*a.low_px + a.low_py*a.low_py)/(2*a.low_rho)
    # rho (eps - KEPT heat) - p^2/2 is a quadratic in the part, positive at 0
    two, zero = rho*eps - 0.5*(px*px + py*py), (1 - KEPT)*a.low_rho*heat
    one = a.low_rho*eps + rho*(a.low_eps - KEPT*heat) - a.low_px*px - a.low_py*py
    inside = one*one - 4*two*zero
    turn = np.sqrt(max(inside, 0.0)) - one
    return min(part, 2*zero/turn) if inside >= 0 and turn > 0 else part


@generic
def share_of(eos, a, rho, px, py, eps):
    """`share` for the type of the equation of state."""


@pair_term(4, "excess", "eos")
def Limited(term, a, b, ab):
    """Minus the part of `excess` that an edge leaves out    [Zalesak 1979; Guermond & Popov 2017]"""
    m, px, py, e = rate(term.excess, a, b, ab)
    less = min(share_of(term.eos, a, a.room*m, a.room*px, a.room*py, a.room*e),
               share_of(term.eos, b, -b.room*m, -b.room*px, -b.room*py, -b.room*e)) - 1
    return less*m, less*px, less*py, less*e


class Limits:
    """Euler steps of n points over edges that keep rho, e > 0. limited : number of Euler steps with limits;
    refused : number of parts of steps that were halved, the last time because of point `lost`."""
    n: int
    method: Any
    threads: Threads
    points: np.ndarray
    edges: Faces
    images: Ghosts

    def set_limits(self, flow: tuple) -> None:
        """Prepare counters, sums and arrays for the listed terms."""
        self.refused, self.limited, self.lost = 0, 0, self.n
        self.excess, self.gain = Excess(Listing(flow)), np.zeros((self.n, 4))
        self.leaves_out = Limited(self.excess, self.method.eos)
        self.slopes, self.fastest = np.zeros((self.n, 8)), np.zeros((self.n, 1))
        self.sending = Sending(flow, self.method.transport, self.slopes, self.threads)

    @property
    def speeds(self) -> np.ndarray:
        """Sum of `Sound` over the edges of each point, (n,), of the state last looked at."""
        self.threads(sweep, self.n, Sound(), self.points, self.edges, self.fastest)
        return self.fastest[:, 0]

    @property
    def chi(self) -> np.ndarray:
        """Diffusivity of each point, (n,): the larger one of momentum and heat."""
        points = self.points[:self.n]
        return np.maximum(points["eta"], points["k"]/self.method.eos.cv)/points["rho"]

    def less(self, before: np.ndarray, after: np.ndarray, per_V: np.ndarray) -> Any:
        """Correction (4, n) by limits, to be added to densities `after` an Euler step; 0 if none is needed,
        None if not even Rusanov's flux keeps rho, e > 0. before, after (4, n); per_V (n,) : step/volume."""
        n, points, edges, eos = self.n, self.points, self.edges, self.method.eos
        if not (crowded(eos, before, after)
                or sum(self.threads(fallen, n, above_cold(eos, before), above_cold(eos, after)))):
            return 0.0
        self.limited += 1
        self.threads(sweep, n, self.excess, points, edges, self.gain)
        self.settle()
        low = after - per_V*self.gain.T
        self.lost = first_invalid(low, eos)
        if self.lost < n:
            return None
        for name, values in zip(LOW, (*above_cold(eos, low), per_V*edges.taken)):
            points[name][:n] = values
        self.images.fill(points, tuple(set(LOW) - {"low_py"}), ("low_py",))
        self.threads(sweep, n, self.leaves_out, points, edges, self.gain)
        self.settle()
        return per_V*self.gain.T

    def settle(self) -> None:
        """Correct the sums `gain` at held points; here there are none."""


@jit
def divided(first, last, slopes, V, points):
    """Gradients of points, from sums of `Slopes`."""
    for i in range(first, last):
        a, q, f = points[i], slopes[i], 1/V[i]
        a.u_x, a.u_y, a.v_x, a.v_y = f*q[0], f*q[1], f*q[2], f*q[3]
        a.rho_x, a.rho_y, a.P_x, a.P_y = f*q[4], f*q[5], f*q[6], f*q[7]


@jit
def fallen(first, last, before, after):
    """Number of points whose density or internal energy fell below KEPT of what it was."""
    count = 0
    for i in range(first, last):
        rho, e = inner(before[0, i], before[1, i], before[2, i], before[3, i])
        new, later = inner(after[0, i], after[1, i], after[2, i], after[3, i])
        count += not (new > KEPT*rho and new*later > KEPT*rho*e)
    return count


@generic
def above_cold(eos, state):
    """Densities (4, n) with the energy counted from T = 0, which must stay positive, too."""


@generic
def crowded(eos, before, after):
    """Has any point lost most of the free volume between its molecules?"""


above_cold.of(IdealGas)(lambda eos, state: state)
crowded.of(IdealGas)(lambda eos, before, after: False)
share_of.of(IdealGas)(lambda eos, a, rho, px, py, eps: share(a, rho, px, py, eps))
#: what a fluid needs for limits
FORMULAS = share_of, above_cold, crowded
