"""Exchange over edges, common to all compiled schemes: one sweep over the listed terms, and their stages.

A term takes two points and their edge, and returns the first point's gain of mass, momentum (2) and
energy    [RR98 Eqs 34-36, 51]. Terms that are not listed are not compiled. A term that needs more than the
fields of two points, such as gradients, has a stage.
"""
from functools import singledispatch
from typing import Any, NamedTuple

import numpy as np

from continuum.fluid import energy, pressure
from continuum.jit import INLINED, ORDERED, formula, overload
from particles.pairs import add, pair_term, rate, sweep, zero
from particles.threads import Threads


@pair_term(4)
def Convection(term, a, b, ab):
    """Convection, q_a v_b + q_b v_a for q = rho, rho v and eps."""
    to_b, to_a = ab.sx*b.vx + ab.sy*b.vy, ab.sx*a.vx + ab.sy*a.vy       # S.v/2
    from_a, from_b = a.rho*to_b, b.rho*to_a
    return -from_a - from_b, -from_a*a.vx - from_b*b.vx, -from_a*a.vy - from_b*b.vy, -a.eps*to_b - b.eps*to_a


@formula
def pressure_of(eos, rho, T):
    return pressure(eos, rho, energy(eos, rho, T))


@pair_term(4, "eos")
def Pressure(term, a, b, ab):
    """Crossed pressures P_ab = P(rho_a, T_b) and P_ba, with a hydrostatic part for images. The force is that
    of P_ab + P_ba - 2 P_a; field P is the point's own pressure, or zero if unset: see `fixed.OwnPressure`."""
    to_b, to_a = ab.sx*b.vx + ab.sy*b.vy, ab.sx*a.vx + ab.sy*a.vy
    P_ab, P_ba = pressure_of(term.eos, a.rho, b.T) + b.hydro, pressure_of(term.eos, b.rho, a.T)
    P = P_ab + P_ba - 2*a.P
    return 0.0, -ab.sx*P, -ab.sy*P, -P_ab*to_a - P_ba*to_b


@pair_term(4, share=1.0)
def Friction(term, a, b, ab):
    """Friction along the edge and its work, for a share of the viscosity    [Eq. 51, zeta = 0, d = 2]"""
    f, du, dv = 0.5*term.share*(a.eta + b.eta)*ab.k, b.ux - a.ux, b.uy - a.uy
    return 0.0, f*du, f*dv, 0.5*f*(du*(a.ux + b.ux) + dv*(a.uy + b.uy))


@pair_term(4, share=1.0)
def Conduction(term, a, b, ab):
    """Heat conduction along the edge, for a share of the conductivity: ours, beside Eq. 51."""
    return 0.0, 0.0, 0.0, 0.5*term.share*(a.k + b.k)*ab.k*(b.Td - a.Td)


#: friction of Eq. 51 and heat; heat first costs 15 % more with terms that divide, see `Listing`
PRINTED = (Friction(), Conduction())


class Listing(NamedTuple):
    """Sum of terms, added in this order, which decides what shares a vector instruction."""
    terms: tuple


#: fastest order of these five terms, of the orders tried in bench/points_speed
FAST = ("Convection", "Friction", "Mending", "Pressure", "Conduction")


def listed(terms: tuple) -> Listing:
    """Terms in the order FAST if they are these five, otherwise in the given order."""
    by_name = {type(term).__name__: term for term in terms}
    return Listing(tuple(map(by_name.get, FAST)) if by_name.keys() == {*FAST} else terms)


def onto(before: tuple, terms: tuple, a: Any, b: Any, ab: Any) -> Any:
    """Add the rates of all terms to a sum."""


@overload(onto, jit_options=ORDERED | INLINED)
def _(before, terms, a, b, ab):
    if len(terms) == 0:
        return lambda before, terms, a, b, ab: before
    return lambda before, terms, a, b, ab: onto(add(before, rate(terms[0], a, b, ab)), terms[1:], a, b, ab)


zero.of(Listing)(lambda term: zero(term.terms[0]))
rate.of(Listing)(lambda term, a, b, ab: onto(rate(term.terms[0], a, b, ab), term.terms[1:], a, b, ab))


class At(NamedTuple):
    """Data of an exchange: records of points, then of images; edges; parents of images; volumes."""
    points: np.ndarray
    edges: Any
    images: Any
    V: np.ndarray


class Stage:
    """Work that a term needs before or after the sweep; none by default."""

    def prepare(self, at: At) -> None:
        """Compute fields that the sweep reads, from the fields of points and images."""

    def use(self, slopes: np.ndarray, at: At) -> None:
        """As `prepare`, with slopes V (d_x u, d_y u, d_x v, d_y v) that the scheme has computed already."""

    def add(self, at: At, total: np.ndarray) -> None:
        """Add to `total` what the sweep leaves out."""

    def heat(self, i: np.ndarray, image: np.ndarray, S: np.ndarray) -> float:
        """Heat per time from images to points through areas S (m, 2), without conduction along edges."""
        return 0.0


@singledispatch
def stages_of(term: Any, law: Any, n: int, threads: Threads, *more: Any) -> tuple[Stage, ...]:
    """Stages of a term for a fluid with a transport law; most terms have none."""
    return ()


class Exchange:
    """Sum of all listed terms over edges. term : their `Listing`, or a term that contains one."""

    def __init__(self, term: Any, stages: tuple[Stage, ...], n: int, threads: Threads):
        self.term, self.stages, self.n, self.threads = term, stages, n, threads
        self.total = np.zeros((n, len(zero(term))))

    def sum(self, at: At) -> np.ndarray:
        """Gain of each point, (n, columns), in an array that the next sum overwrites."""
        self.over_edges(at)
        for stage in self.stages:
            stage.add(at, self.total)
        return self.total

    def over_edges(self, at: At) -> None:
        """Write the sum of the terms to `total`."""
        self.threads(sweep, self.n, self.term, at.points, at.edges, self.total)


def stages(terms: tuple, law: Any, n: int, threads: Threads, *more: Any) -> tuple[Stage, ...]:
    """Stages of all terms. more : how stages read pairs that are not stored edges."""
    return tuple(stage for term in terms for stage in stages_of(term, law, n, threads, *more))
