"""A fluid on fixed points that has no more than its scene lists: density, momentum, named terms.

P = c^2 rho: without heat there is neither energy nor temperature nor conductivity in the state nor in the
records. The brackets are those of Eqs 34, 35 and 51    [RR98]
"""
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from continuum.jit import jit
from particles.fields import Fields
from particles.integral.edges import Edges
from particles.integral.exchange import At, Exchange, Listing
from particles.integral.fixed import NO_IMAGES, OnPoints, stored
from particles.limits import limit_of
from particles.method import Sums
from particles.pairs import pair_term
from particles.threads import Threads

Point = np.dtype([(name, "f8") for name in ("rho", "vx", "vy")])


class Carried(NamedTuple):
    """Mass and momentum that move with the fluid, and pressure    [Eqs 34, 35]"""
    c2: float


class ConstantFriction(NamedTuple):
    """Along edges, constant viscosity    [Eq. 51, B = eta]"""
    eta: float


@pair_term(Carried, 3)
def _(term, a, b, ab):
    from_a, from_b = a.rho*(ab.sx*b.vx + ab.sy*b.vy), b.rho*(ab.sx*a.vx + ab.sy*a.vy)
    P = term.c2*(a.rho + b.rho)
    return -from_a - from_b, -from_a*a.vx - from_b*b.vx - ab.sx*P, -from_a*a.vy - from_b*b.vy - ab.sy*P


@pair_term(ConstantFriction, 3)
def _(term, a, b, ab):
    f = term.eta*ab.k
    return 0.0, f*(b.vx - a.vx), f*(b.vy - a.vy)


class Summed(Sums):
    """The compiled sums of the listed terms."""

    def __init__(self, method: "Isothermal", threads: Threads):
        self.method, self.threads, self.n = method, threads, len(method.x)
        self.at = At(np.zeros(self.n, Point), stored(method.edges), NO_IMAGES, method.edges.V)
        self.exchange = Exchange(Listing(method.terms), (), self.n, threads)

    def rates(self, state: np.ndarray, out: np.ndarray) -> None:
        self.threads(_read, self.n, state, self.at.points)
        self.threads(_per_volume, self.n, self.exchange.sum(self.at), self.at.V, out)


@dataclass(frozen=True, kw_only=True)
class Isothermal(OnPoints):
    """Fixed points, periodic, without heat. terms : of Carried and ConstantFriction."""
    x: np.ndarray
    edges: Edges
    terms: tuple

    names = ("rho", "px", "py")
    sums = Summed

    def state(self, rho: np.ndarray, v: np.ndarray) -> np.ndarray:  # type: ignore[override]
        """(3, n) of densities (n,), velocities (n, 2)."""
        return np.stack([rho, *(rho[:, None]*v).T])

    def fields(self, state: np.ndarray) -> Fields:
        return Fields(self.x, (state[1:]/state[0]).T, state[0].copy(), np.full(len(self.x), np.nan),
                      self.edges.V)


@limit_of.register
def _(method: Isothermal, start: np.ndarray) -> float:
    """RK4: the fastest sound and the fastest diffusion that the listed terms make of the edges."""
    sound, spread = method.fastest
    c2, eta = (sum(getattr(term, name, 0.0) for term in method.terms) for name in ("c2", "eta"))
    fast = np.sqrt(c2) + np.sqrt(((start[1]**2 + start[2]**2)/start[0]**2).max())
    return float(1/(fast*sound/2.82 + eta/start[0].min()*spread/2.78))


@jit
def _read(first, last, state, points):
    for i in range(first, last):
        a = points[i]
        a.rho, a.vx, a.vy = state[0, i], state[1, i]/state[0, i], state[2, i]/state[0, i]


@jit
def _per_volume(first, last, total, V, out):
    for i in range(first, last):
        for field in range(3):
            out[field, i] = total[i, field]/V[i]
