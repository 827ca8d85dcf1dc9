"""SPH with corrected gradients: pressure over corrected areas of pairs, friction and heat along pairs.

    M_i = sum_j V_j (x_j - x_i) grad_i w,    B_i = M_i^-1,    V = m/rho

Gradients by B_i grad_i w are exact on linear fields. By grad_i w alone pressure acts as a stress P M, which
has a deviator where particles were sheared; a fluid has none. The force of a pair is V_i V_j (P_i A + P_j C):

    sumB       A = B_i grad_i w, C = B_j grad_i w              stress P M B = P 1
    RKGC       A = B_j grad_i w, C = B_i grad_i w              [Zhang, Adams & Hu 2024, relaxed first]
    symmetric  A = C = (B_i + B_j)/2 grad_i w                  [Bonet & Lok 1999]

Friction and heat act along pairs, tr M_i/2 times as strongly as they should; `All` corrects this as well
[Schwaiger 2008, its first factor, made symmetric]. The part of a fluid's stress that friction along pairs
lacks, tau = eta ((-d_y v, d_y u), (d_x v, -d_x u)), acts over A + C: without it rigid rotation heats. Each
pair conserves momentum and energy: P_i A does its work on i, P_j C on j, friction half of it on each.
"""
from typing import Any, ClassVar, NamedTuple

import numpy as np

from continuum.fluid import conductivity, viscosity
from continuum.jit import formula, generic, jit
from particles.pairs import pair_term, register_term, sweep
from particles.smooth.sums import Direct
from particles.threads import Threads

#: det M/(tr M)^2 that neighbours in a line have by round-off
FLAT = 1e-12
FAR = 2**62


class SumB(NamedTuple):
    """P_i B_i + P_j B_j."""


class Reverse(SumB):
    """P_i B_j + P_j B_i."""


class Symmetric(SumB):
    """(P_i + P_j) (B_i + B_j)/2."""


class All(SumB):
    """As `SumB`; friction and heat over the mean of tr M_i/2 and tr M_j/2, to first order in M - 1."""


@generic
def gain(term, a, b):
    """Ratio of friction and heat along a pair to those of `Direct`."""


@generic
def areas(term, own, other):
    """(A, C) from own = B_a grad w and other = B_b grad w, each (x, y)."""


gain.of(SumB)(lambda term, a, b: 1.0)
gain.of(All)(lambda term, a, b: 0.25*(a.Bxx + a.Byy + b.Bxx + b.Byy))
areas.of(SumB)(lambda term, own, other: (own, other))
areas.of(Reverse)(lambda term, own, other: (other, own))


@areas.of(Symmetric)
def _(term, own, other):
    mean = 0.5*(own[0] + other[0]), 0.5*(own[1] + other[1])
    return mean, mean


@pair_term(9)
def Moments(term, a, b, ab):
    """M_i (xx, xy, yy), and uncorrected gradients sum_j V_j (f_j - f_i) grad_i w of f = vx, vy, T."""
    x, y, u, v, T = b.x - a.x, b.y - a.y, b.vx - a.vx, b.vy - a.vy, b.T - a.T
    wx, wy = b.irho*ab.wx, b.irho*ab.wy
    return x*wx, x*wy, y*wy, u*wx, u*wy, v*wx, v*wy, T*wx, T*wy


def push(term, a, b, ab):
    """Acceleration and heating of a."""
    x, y, u, v = a.x - b.x, a.y - b.y, a.vx - b.vx, a.vy - b.vy
    f = a.irho*b.irho
    A, C = areas(term, turned(a, f*ab.wx, f*ab.wy), turned(b, f*ab.wx, f*ab.wy))
    # two particles in one place exert no force on each other
    F = gain(term, a, b)*f*(x*ab.wx + y*ab.wy)/max(x*x + y*y, 1e-300)
    drag, Sx, Sy = (a.eta + b.eta)*F, 0.5*(A[0] + C[0]), 0.5*(A[1] + C[1])
    fx = drag*u + Sx*(a.xx + b.xx) + Sy*(a.yx + b.yx)
    fy = drag*v + Sx*(a.xy + b.xy) + Sy*(a.yy + b.yy)
    heat = a.P*(A[0]*u + A[1]*v) - 0.5*(fx*u + fy*v) + (a.k + b.k)*F*(a.T - b.T)
    return fx - a.P*A[0] - b.P*C[0], fy - a.P*A[1] - b.P*C[1], heat


register_term(SumB, 3, push)


@formula
def turned(a, x, y):
    """B_a (x, y)."""
    return a.Bxx*x + a.Bxy*y, a.Bxy*x + a.Byy*y


class Corrected(Direct):
    """Sums with corrected gradients and one of the terms of pressure."""
    term: ClassVar[Any] = SumB()
    along_pairs, numbers = False, "x y vx vy T P irho eta k"
    #: B, and tau (direction, component) of the reversed velocity, whose slopes along a side change sign
    turns: ClassVar[dict[str, str]] = {"Bxx": "xx", "Bxy": "xy", "Byy": "yy",
                                       "xx": "x", "xy": "x", "yx": "y", "yy": "y"}

    def __init__(self, method: Any, n: int, threads: Threads):
        super().__init__(method, n, threads)
        self.moments = np.empty((self.around.rows, 9))

    def gradients(self) -> None:
        """Corrected gradients, for measured quantities."""
        self.exchange(self.less)
        self.threads(_slopes, self.around.rows, self.moments, self.records, self.slopes)

    def exchange(self, less: np.ndarray) -> tuple[Any, np.ndarray]:
        around, records = self.around, self.records
        self.threads(_read, len(around.x), self.method.law, around.x, around.y, around.rho, around.vx,
                     around.vy, around.T, less, records)
        self.threads(sweep, around.rows, Moments(), records, around.pairs, self.moments)
        flat = min(self.threads(_correct, around.rows, self.moments, records))
        if flat < around.rows:
            raise FloatingPointError(f"the neighbours of the particle at ({around.x[flat]:.6g}, "
                                     f"{around.y[flat]:.6g}) lie in a line with it, or there are none: no "
                                     "gradient is known there; take a wider weight, or fill the box")
        self.mirror()
        return self.term, records


class Reversed(Corrected):
    term = Reverse()


class Symmetrised(Corrected):
    term = Symmetric()


class AllCorrected(Corrected):
    term = All()


@jit
def _read(first, last, law, x, y, rho, vx, vy, T, less, records):
    for i in range(first, last):
        a = records[i]
        a.x, a.y, a.vx, a.vy, a.T, a.P, a.irho = x[i], y[i], vx[i], vy[i], T[i], less[i], 1/rho[i]
        a.eta, a.k = viscosity(law, rho[i], T[i]), conductivity(law, rho[i], T[i])


@jit
def _correct(first, last, moments, records):
    """B = M^-1, and tau from corrected gradients. Returns the first row whose M has no inverse, or FAR."""
    for i in range(first, last):
        a, (xx, xy, yy, ux, uy, vx, vy, _, _) = records[i], moments[i]
        det = xx*yy - xy*xy
        if not det > FLAT*(xx + yy)**2:
            return i
        a.Bxx, a.Bxy, a.Byy = yy/det, -xy/det, xx/det
        (u_x, u_y), (v_x, v_y) = turned(a, ux, uy), turned(a, vx, vy)
        a.xx, a.xy, a.yx, a.yy = -a.eta*v_y, a.eta*u_y, a.eta*v_x, -a.eta*u_x
    return FAR


@jit
def _slopes(first, last, moments, records, slopes):
    """Corrected d_x and d_y of vx, vy, T, in the columns of `SmoothSums.gradients`."""
    for i in range(first, last):
        for k in range(3):
            slopes[i, k], slopes[i, 4 + k] = turned(records[i], moments[i, 3 + 2*k], moments[i, 4 + 2*k])
