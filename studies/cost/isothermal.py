"""A fluid on fixed points without heat: density, momentum, pressure c^2 rho, constant friction along edges.

There is neither energy nor temperature nor conductivity in the state nor in the records. The brackets are
those of Eqs 34, 35 and 51    [RR98]
"""
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from continuum.jit import jit
from particles.fields import Fields
from particles.integral.edges import Edges
from particles.integral.exchange import At, Exchange
from particles.integral.fixed import NO_IMAGES, OnPoints, stored
from particles.limits import limit_of
from particles.method import Sums
from particles.pairs import pair_term
from particles.threads import Threads

Point = np.dtype([(name, "f8") for name in ("rho", "vx", "vy")])


class Cold(NamedTuple):
    """Mass and momentum that move with the fluid, pressure, friction    [Eqs 34, 35, 51 with B = eta]"""
    c2: float
    eta: float


@pair_term(Cold, 3)
def _(term, a, b, ab):
    from_a, from_b = a.rho*(ab.sx*b.vx + ab.sy*b.vy), b.rho*(ab.sx*a.vx + ab.sy*a.vy)
    P, f = term.c2*(a.rho + b.rho), term.eta*ab.k
    return (-from_a - from_b, f*(b.vx - a.vx) - from_a*a.vx - from_b*b.vx - ab.sx*P,
            f*(b.vy - a.vy) - from_a*a.vy - from_b*b.vy - ab.sy*P)


class Summed(Sums):
    """The compiled sums."""

    def __init__(self, method: "Isothermal", threads: Threads):
        self.method, self.threads, self.n = method, threads, len(method.x)
        self.at = At(np.zeros(self.n, Point), stored(method.edges), NO_IMAGES, method.edges.V)
        self.exchange = Exchange(Cold(method.c2, method.eta), (), self.n, threads)

    def rates(self, state: np.ndarray, out: np.ndarray) -> None:
        self.threads(_read, self.n, state, self.at.points)
        self.threads(_per_volume, self.n, self.exchange.sum(self.at), self.at.V, out)


@dataclass(frozen=True, kw_only=True)
class Isothermal(OnPoints):
    """Fixed points, periodic, of a squared speed of sound c2 and a viscosity eta."""
    x: np.ndarray
    edges: Edges
    c2: float
    eta: float = 0.0

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
    """RK4: the fastest sound and the fastest diffusion of the edges."""
    sound, spread = method.fastest
    fast = np.sqrt(method.c2) + np.sqrt(((start[1]**2 + start[2]**2)/start[0]**2).max())
    return float(1/(fast*sound/2.82 + method.eta/start[0].min()*spread/2.78))


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
