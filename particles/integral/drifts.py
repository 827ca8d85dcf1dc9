"""Pair terms of moving points, listed for each of RR98's motions, in 2D    [Sec. III]"""
from typing import Any, NamedTuple

import numpy as np

from continuum.jit import generic, jit
from particles.integral.exchange import At, Convection, Pressure, Stage, pressure_of, stages_of
from particles.pairs import Edge, pair_term, rate, register_term, zero
from particles.threads import Threads


class Crossed(NamedTuple):
    """P_ij = P(rho_i, T_j)    [RR98 Eq. 13]"""


class Powers(NamedTuple):
    """P_ij + P_ji = P_i/(m_i^a m_j^b) + P_j/(m_j^a m_i^b), m the density    [RR98 Eq. 50 and note 18]

    Consistent with Eq. 49 for a + b = 0 only: the force is -grad (P/rho^(a+b)). What the points' own pressure
    does is done with the velocity of the other: internal energy falls by P_i times the growth of volume.
    """
    a: float = 0.0
    b: float = 0.0


class OverPairs(NamedTuple):
    """A term over edges, evaluated on pairs as edges of S_ab/2 = V_a V_b W e_ba, k = 2 V_a V_b W/r."""
    term: Any


class Dilution(NamedTuple):
    """-q_a div v of q = rho, rho v, eps: convection seen by points that move with the fluid    [Eqs 46-48]

    follow : share of V div v by which volumes grow.
    """
    follow: float


class LiteralDrift(NamedTuple):
    """Eqs 34-36 and 39 as printed: points move, and convection is exchanged all the same."""

    def terms(self, eos: Any, transport: tuple) -> tuple:
        return Convection(), *transport, Pressure(eos)


class ConvectiveDrift(NamedTuple):
    """Eqs 34-36, 39, 46-48. follow : 0 for constant volumes, as printed; 1 for dV/dt = V div v."""
    follow: float = 0.0

    def terms(self, eos: Any, transport: tuple) -> tuple:
        return Dilution(self.follow), *transport, Pressure(eos)


class ConstantMassDrift(NamedTuple):
    """Eq. 49 at constant masses; volumes follow the flow. bracket : `Crossed` or `Powers` [Eq. 50]."""
    bracket: Any = Crossed()

    def terms(self, eos: Any, transport: tuple) -> tuple:
        return *transport, BracketPressure(self.bracket, eos)


#: motions by their names in `rr98_moving_plain.MOTIONS`
DRIFTS: dict[str, Any] = {"literal": LiteralDrift(), "convective": ConvectiveDrift(),
                          "carried": ConvectiveDrift(1.0), "constant-mass": ConstantMassDrift()}


@generic
def growth(motion, a, b, ab):
    """Rate at which a pair changes the volume of a, before stages."""


@generic
def both(bracket, eos, a, b):
    """Pressures (P_ab, P_ba); energy is exchanged by P_ab v_a + P_ba v_b."""


zero.of(OverPairs)(lambda term: zero(term.term))
register_term(Dilution, 4, lambda term, a, b, ab: (0.0, 0.0, 0.0, 0.0))     # its stage does all
growth.of(LiteralDrift)(lambda motion, a, b, ab: 0.0)
growth.of(ConvectiveDrift)(lambda motion, a, b, ab: ab.sx*b.vx + ab.sy*b.vy)
growth.of(ConstantMassDrift)(lambda motion, a, b, ab: ab.sx*b.vx + ab.sy*b.vy - (ab.sx*a.vx + ab.sy*a.vy))


@rate.of(OverPairs)
def _(term, a, b, ab):
    VV, x, y = a.V*b.V, b.x - a.x, b.y - a.y
    # points in one place exchange nothing
    k = 2*VV*(x*ab.wx + y*ab.wy)/(x*x + y*y + 1e-300)
    return rate(term.term, a, b, Edge(VV*ab.wx, VV*ab.wy, k))


@pair_term(5, "motion", "exchanged")
def Drifting(term, a, b, ab):
    """Gain of the first point of a pair: mass, momentum, energy of the listed terms, and volume."""
    return (*rate(term.exchanged, a, b, ab), growth(term.motion, a, b, ab))


@pair_term(4, "bracket", "eos")
def BracketPressure(term, a, b, ab):
    """Pressures P_ab, P_ba of Eq. 49 or 50, less the static part that a point leaves out, -hydro."""
    to_b, to_a = ab.sx*b.vx + ab.sy*b.vy, ab.sx*a.vx + ab.sy*a.vy
    P_ab, P_ba = both(term.bracket, term.eos, a, b)
    P_ab, P_ba = P_ab + b.hydro, P_ba + a.hydro
    P = P_ab + P_ba
    return 0.0, -ab.sx*P, -ab.sy*P, -P_ab*to_a - P_ba*to_b


@both.of(Crossed)
def _(bracket, eos, a, b):
    return pressure_of(eos, a.rho, b.T), pressure_of(eos, b.rho, a.T)


@both.of(Powers)
def _(bracket, eos, a, b):
    return (pressure_of(eos, b.rho, b.T)/(b.rho**bracket.a*a.rho**bracket.b),
            pressure_of(eos, a.rho, a.T)/(a.rho**bracket.a*b.rho**bracket.b))


class Diluting(Stage):
    """Subtracts q_a div v, with V div v from the sweep."""

    def __init__(self, follow: float, n: int, threads: Threads):
        self.follow, self.n, self.threads = follow, n, threads

    def add(self, at: At, total: np.ndarray) -> None:
        self.threads(_dilute, self.n, self.follow, at.points, total)


@stages_of.register
def _(term: Dilution, law: Any, n: int, threads: Threads, *more: Any) -> tuple[Stage, ...]:
    return (Diluting(term.follow, n, threads),)


@jit
def _dilute(first, last, follow, points, total):
    for i in range(first, last):
        a, grown = points[i], total[i, 4]
        total[i, 0] -= a.rho*grown
        total[i, 1] -= a.rho*a.vx*grown
        total[i, 2] -= a.rho*a.vy*grown
        total[i, 3] -= a.eps*grown
        total[i, 4] = follow*grown
