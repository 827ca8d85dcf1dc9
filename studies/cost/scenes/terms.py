"""A fluid on fixed points that has no more than its scene lists: density and momentum, and of the terms those that are named.

P = c^2 rho: without heat there is neither energy nor temperature nor conductivity in the state nor in the records.
The brackets are those of Eqs 34, 35 and 51    [RR98]
"""
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np

from continuum.jit import jit, overload
from particles.integral.edges import NONE_BEYOND, Edges
from particles.integral.fixed import Summing, check_number, stored
from particles.limits import limit_of
from particles.pairs import add, nothing, rate, sweep
from particles.threads import Team

Point = np.dtype([(name, "f8") for name in ("rho", "vx", "vy")])


class Carried(NamedTuple):
    """Mass and momentum that move with the fluid, and pressure    [Eqs 34, 35]"""
    c2: float


class Friction(NamedTuple):
    """Along edges, constant viscosity    [Eq. 51, B = eta]"""
    eta: float


class Listing(NamedTuple):
    """The sum of the listed terms; what is not listed is not compiled."""
    terms: tuple


@rate.of(Carried)
def _(term, a, b, ab):
    from_a, from_b = a.rho*(ab.sx*b.vx + ab.sy*b.vy), b.rho*(ab.sx*a.vx + ab.sy*a.vy)
    P = term.c2*(a.rho + b.rho)
    return -from_a - from_b, -from_a*a.vx - from_b*b.vx - ab.sx*P, -from_a*a.vy - from_b*b.vy - ab.sy*P


@rate.of(Friction)
def _(term, a, b, ab):
    f = term.eta*ab.k
    return 0.0, f*(b.vx - a.vx), f*(b.vy - a.vy)


def total(terms: tuple, a: Any, b: Any, ab: Any) -> Any:
    """Sum of the rates of all terms."""


@overload(total)
def _(terms, a, b, ab):
    if len(terms) == 1:
        return lambda terms, a, b, ab: rate(terms[0], a, b, ab)
    return lambda terms, a, b, ab: add(rate(terms[0], a, b, ab), total(terms[1:], a, b, ab))


nothing.of(Listing)(lambda term: (0.0, 0.0, 0.0))
rate.of(Listing)(lambda term, a, b, ab: total(term.terms, a, b, ab))


@dataclass(frozen=True, kw_only=True)
class Listed:
    """Fixed points, periodic, without heat. terms : of Carried and Friction."""
    x: np.ndarray
    edges: Edges
    terms: tuple

    names = ("rho", "px", "py")

    def start(self, n: int, team: Team) -> "Summed":
        """The sums over stored edges.

        Raises
        ------
        ValueError
            The state has not as many points as there are.
        """
        check_number(n, len(self.x))
        return Summed(self, team)


class Summed(Summing):
    """The compiled sums of the listed terms."""

    def __init__(self, method: Listed, team: Team):
        self.method, self.team, self.n, self.V = method, team, len(method.x), method.edges.V
        self.edges = stored(method.edges, NONE_BEYOND, NONE_BEYOND.parent)
        self.points, self.total, self.term = np.zeros(self.n, Point), np.empty((self.n, 3)), Listing(method.terms)

    def rates(self, state: np.ndarray, out: np.ndarray) -> None:
        """d(state)/dt of a state (3, n), written to `out`."""
        self.team(_read, self.n, state, self.points)
        self.team(sweep, self.n, self.term, self.points, self.edges, self.total)
        self.team(_per_volume, self.n, self.total, self.V, out)

    def look_at(self, state: np.ndarray) -> None:
        """Fields are not kept."""

    def fault(self, state: np.ndarray, ids: np.ndarray) -> str:
        """The first point without a positive density; empty if there is none."""
        bad = np.flatnonzero(~(state[0] > 0))
        return f"point {ids[bad[0]]} has rho = {state[0, bad[0]]:.6g}, which must be positive" if len(bad) else ""


@limit_of.register
def _(method: Listed, start: np.ndarray) -> float:
    """RK4: the fastest sound and the fastest diffusion that the listed terms make of the edges."""
    sound, spread = method.edges.fastest
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
