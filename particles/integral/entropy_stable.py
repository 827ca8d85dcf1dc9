"""Layers whose flux survives shocks and vacua: listed `entropy_fluxes`, and steps that leave rho, e > 0.

An Euler step by Rusanov's flux leaves them so if it is short enough [Perthame & Shu 1996]. Where a step by
listed terms does not, edges leave out what takes more than a share of either point's, beyond Rusanov's.
"""
from dataclasses import dataclass, replace
from math import ceil, inf
from typing import Any, ClassVar, NamedTuple

import numpy as np

from continuum.fluid import sound_speed
from continuum.jit import check_formulas, formula, jit
from particles.integral.entropy_fluxes import Dissipation, Logarithmic, fastest, log_means
from particles.integral.exchange import Listing, Pressure, pressure_of
from particles.integral.fixed import Point, first_invalid, inner, stored
from particles.integral.layer import Layer, LayerSums
from particles.limits import limit_of
from particles.pairs import Faces, pair_term, rate, sweep
from particles.threads import Threads

COURANT, KEPT = 0.9, 0.1        # part of the proven step; of a low-order density or energy that is kept
LEAST = 1e-6                    # part of a step that halving goes down to
OLD = (0.0, 3/4, 1/3)           # shares of the start in stages

SLOPES = ("rho_x", "rho_y", "P_x", "P_y", "u_x", "u_y", "v_x", "v_y")
#: density, momentum and energy by Rusanov's flux; a step per volume and edge
LOW = ("low_rho", "low_px", "low_py", "low_eps", "room")
#: what `fixed.Point` has; sound's speed; gravity, of images
StablePoint = np.dtype([*Point.descr, *((name, "f8") for name in (*SLOPES, "c", "g", *LOW))])


class Slopes(NamedTuple):
    """V grad of rho, P and v by differences; |S|/2 (|v.n| + c)."""


class Excess(NamedTuple):
    """What listed terms exchange beyond Rusanov's flux."""
    terms: Listing


class Limited(NamedTuple):
    """What an edge leaves out of it    [Zalesak 1979; Guermond & Popov 2017]"""
    excess: Excess


@pair_term(Slopes, 9)
def _(term, a, b, ab):
    x, y, rho, P, u, v = ab.sx, ab.sy, b.rho - a.rho, b.P + b.hydro - a.P, b.vx - a.vx, b.vy - a.vy
    return x*rho, y*rho, x*P, y*P, x*u, y*u, x*v, y*v, fastest(a, b, ab)


@pair_term(Excess, 4)
def _(term, a, b, ab):
    sx, sy, most = ab.sx, ab.sy, fastest(a, b, ab)
    to_a, to_b, P = sx*a.vx + sy*a.vy, sx*b.vx + sy*b.vy, b.P - a.P + b.hydro
    one, other = a.rho*(to_a + most), b.rho*(to_b - most)
    work = to_a*(a.P + b.hydro) + to_b*b.P
    m, px, py, e = rate(term.terms, a, b, ab)
    return (m + one + other, px + one*a.vx + other*b.vx + sx*P, py + one*a.vy + other*b.vy + sy*P,
            e + (to_a + most)*a.eps + (to_b - most)*b.eps + work)


@formula
def share(a, rho, px, py, eps):
    """The largest part <= 1 of a change that leaves KEPT of a point's low-order density and energy."""
    part = min(1.0, (1 - KEPT)*a.low_rho/max(-rho, 1e-300))
    heat = a.low_eps - (a.low_px*a.low_px + a.low_py*a.low_py)/(2*a.low_rho)
    # rho (eps - KEPT heat) - p^2/2 is a quadratic of the part, positive at 0
    two, zero = rho*eps - 0.5*(px*px + py*py), (1 - KEPT)*a.low_rho*heat
    one = a.low_rho*eps + rho*(a.low_eps - KEPT*heat) - a.low_px*px - a.low_py*py
    inside = one*one - 4*two*zero
    turn = np.sqrt(max(inside, 0.0)) - one
    return min(part, 2*zero/turn) if inside >= 0 and turn > 0 else part


@pair_term(Limited, 4)
def _(term, a, b, ab):
    m, px, py, e = rate(term.excess, a, b, ab)
    less = min(share(a, a.room*m, a.room*px, a.room*py, a.room*e),
               share(b, -b.room*m, -b.room*px, -b.room*py, -b.room*e)) - 1
    return less*m, less*px, less*py, less*e


@jit
def _sound(first, last, eos, points):
    for i in range(first, last):
        a = points[i]
        a.P = pressure_of(eos, a.rho, a.T)
        a.c = sound_speed(eos, a.rho, eos.cv*a.T)


@jit
def _slopes(first, last, slopes, V, points):
    for i in range(first, last):
        a, q, f = points[i], slopes[i], 1/V[i]
        a.rho_x, a.rho_y, a.P_x, a.P_y = f*q[0], f*q[1], f*q[2], f*q[3]
        a.u_x, a.u_y, a.v_x, a.v_y = f*q[4], f*q[5], f*q[6], f*q[7]


class StableSums(LayerSums):
    """The compiled sums. refused : parts of steps that were halved, the last one by point `lost`; limited :
    Euler steps with limits."""
    method: "StableLayer"

    def __init__(self, method: "StableLayer", threads: Threads):
        super().__init__(method, threads)
        n, beyond, self.refused, self.limited = self.n, method.beyond, 0, 0
        self.points = np.zeros(len(self.points), StablePoint)
        self.points["g"][n:] = method.g
        near, far = replace(method.edges, S=2*method.edges.apart), replace(beyond, S=2*beyond.apart)
        along = stored(near, far, n + self.image)
        edges = Faces(**self.at.edges._asdict(), dx=along.sx, dy=along.sy)
        self.at = self.at._replace(points=self.points, edges=edges)
        self.exchange.term = Listing((*method.transport, *method.flow))
        self.excess, self.gain, self.slopes = Excess(Listing(method.flow)), np.zeros((n, 4)), np.zeros((n, 9))
        k = 2*np.bincount(beyond.i, beyond.k, n) - method.edges.laplacian.diagonal()
        self.spread, self.per_edge = k/self.at.V, edges.taken/self.at.V

    def surround(self, state: np.ndarray) -> None:
        """Images; gradients, of images as in a mirror."""
        super().surround(state)
        points, V = self.points, self.at.V
        self.threads(_sound, len(points), self.method.eos, points)
        self.threads(sweep, self.n, Slopes(), points, self.at.edges, self.slopes)
        self.threads(_slopes, self.n, self.slopes, V, points)
        self.at.images.fill(points, ("rho_x", "P_x", "u_x", "v_y"), ("rho_y", "P_y", "u_y", "v_x"))

    def longest(self) -> float:
        """The step that is known to keep a state positive that was looked at."""
        points, sound = self.points[:self.n], self.slopes[:, 8]
        chi = np.maximum(points["eta"], points["k"]/self.method.eos.cv)/points["rho"]
        return float(1/np.max(sound/self.at.V/COURANT + self.spread*chi))

    def euler(self, state: np.ndarray, dt: float, rates: np.ndarray) -> bool:
        """Go on by dt from a state with these rates; False: not even Rusanov's flux leaves rho, e > 0."""
        before = state.copy()
        state += dt*rates
        if not sum(self.threads(fallen, self.n, before, state)):
            return True
        self.limited += 1
        points, edges, per_V = self.points, self.at.edges, dt/self.at.V
        self.threads(sweep, self.n, self.excess, points, edges, self.gain)
        low = state - per_V*self.gain.T
        self.lost = first_invalid(low, self.method.eos)
        if self.lost < self.n:
            return False
        for name, values in zip(LOW, (*low, dt*self.per_edge)):
            points[name][:self.n] = values
        self.at.images.fill(points, tuple(set(LOW) - {"low_py"}), ("low_py",))
        self.threads(sweep, self.n, Limited(self.excess), points, edges, self.gain)
        state += per_V*self.gain.T
        return True


@jit
def fallen(first, last, before, after):
    """Number of points whose density or internal energy fell below a share of what it was."""
    count = 0
    for i in range(first, last):
        rho, e = inner(before[0, i], before[1, i], before[2, i], before[3, i])
        new, later = inner(after[0, i], after[1, i], after[2, i], after[3, i])
        count += not (new > KEPT*rho and new*later > KEPT*rho*e)
    return count


class Positive:
    """Three Euler steps, averaged, third order, which keep what each of them keeps    [Shu & Osher 1988]; in
    as many parts as it takes for `sums.longest`, halved where that does not do."""
    evaluations = 3

    def __init__(self, shape: tuple[int, ...], threads: Threads):
        self._start, self._k = np.empty(shape), np.empty(shape)

    def step(self, sums: Any, y: np.ndarray, dt: float) -> None:
        left, most = dt, inf
        while left > 0:
            self._start[:] = y
            sums.rates(y, self._k)
            h = left/ceil(left/min(sums.longest(), most))
            if all(self._stage(sums, y, h, old) for old in OLD):
                left, most = left - h, inf
                continue
            y[:], most, sums.refused = self._start, h/2, sums.refused + 1
            if most < LEAST*dt:
                raise FloatingPointError(f"no step of {h:.3g} or more leaves point {sums.lost} a density and "
                                         "an energy that are positive")

    def _stage(self, sums: Any, y: np.ndarray, h: float, old: float) -> bool:
        if old:
            sums.rates(y, self._k)
        done: bool = sums.euler(y, h, self._k)
        y[:] = old*self._start + (1 - old)*y
        return done


@dataclass(frozen=True, kw_only=True)
class StableLayer(Layer):
    """A layer of a fluid with an entropy. flow : listed terms in place of convection and pressure."""
    flow: tuple = ()

    integrator: ClassVar[type] = Positive
    sums = StableSums

    def __post_init__(self):
        check_formulas(self.eos, log_means)
        usual = Logarithmic(self.eos), Pressure(self.eos), Dissipation(self.eos)
        object.__setattr__(self, "flow", self.flow or usual)


@limit_of.register
def _(method: StableLayer, start: np.ndarray) -> float:
    sums = method.start(start.shape[1], Threads(1))
    sums.look_at(start)
    return sums.longest()
