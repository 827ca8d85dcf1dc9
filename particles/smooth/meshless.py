"""CRKSPH and MFM: particle methods whose pairs have one common area and one common pressure.

The force of a pair on particle i is -P* S_ij:

    CRKSPH   S_ij = V_i V_j (grad_i W^R_ij - grad_j W^R_ji), P* = (P_i + P_j)/2    [Frontiere et al. 2017]
    MFM      S_ij = W_ij (V_i B_i + V_j B_j) x_ij, B_i = (sum_j W_ij x_ij x_ij)^-1, x_ij = x_j - x_i; P*
             of a Riemann problem    [Lanson & Vila 2008; Hopkins 2015]

Densities are summed; friction and heat are those of `corrected`. CRKSPH's artificial viscosity is left out.
"""
from typing import Any, ClassVar, NamedTuple

import numpy as np

from continuum.jit import formula, generic, jit
from particles.pairs import pair_term, register_term, sweep
from particles.smooth.corrected import Corrected
from particles.smooth.sums import sound
from particles.threads import Threads
from particles.walls import image_pressure
from particles.weights import shape, value_and_slope


class Given(NamedTuple):
    weight: Any
    m: float


class Reproducing(Given):
    """CRKSPH: W^R_ij = A_i (1 + B_i.x_ij) W_ij, x_ij = x_i - x_j, is exact on linear fields    [Eqs 12-15]

    Records hold p = A, q = A B, g = grad p + q, q_ab = d_b q_a. A pair's work is shared as P_i : P_j.
    """


class Meshless(Given):
    """MFM: limited states at the middle of a pair, the acoustic solver    [Hopkins 2015; Toro 2009, 9.3]

    Left out of App. B: the limiter by extremes of neighbours, for shocks, and the rule that keeps signs.
    """


class Adiabatic(Meshless):
    """As `Meshless`, with the work P* S.(v_i - v_j)/2."""


@generic
def area(term, a, b, x, y, ab):
    """Area vector over twice the mass, S_ab/2m; (x, y) = x_b - x_a."""


@generic
def pressed(term, a, b, x, y, Sx, Sy):
    """P*, and the heating of a by P* over the area S/2m."""


@pair_term(12, "weight", "m")
def Moments(term, a, b, ab):
    """m0, m1, m2 of W without the particle itself, and the parts of their gradients in grad W [Eqs 12-15]"""
    x, y, wx, wy = a.x - b.x, a.y - b.y, b.irho*ab.wx, b.irho*ab.wy
    w = b.irho*density(term, x, y)
    return w, x*w, y*w, x*x*w, x*y*w, y*y*w, wx, wy, x*x*wx, x*x*wy, y*y*wx, y*y*wy


@pair_term(9, "weight", "m")
def Differences(term, a, b, ab):
    """sum W x x, and sum W (f_j - f_i) x of f = vx, vy, P    [Hopkins 2015, Sec. 2]"""
    x, y, u, v, P = b.x - a.x, b.y - a.y, b.vx - a.vx, b.vy - a.vy, b.P - a.P
    w = density(term, x, y)
    return x*x*w, x*y*w, y*y*w, u*x*w, u*y*w, v*x*w, v*y*w, P*x*w, P*y*w


@formula
def density(term, x, y):
    """m W."""
    return term.m*value_and_slope(term.weight, np.sqrt(x*x + y*y))[0]


@area.of(Reproducing)
def _(term, a, b, x, y, ab):
    f, w = 0.5*a.irho*b.irho, density(term, x, y)
    own, other = reproducing(a, -x, -y, w, ab.wx, ab.wy), reproducing(b, x, y, w, -ab.wx, -ab.wy)
    return f*(own[0] - other[0]), f*(own[1] - other[1])


@formula
def reproducing(a, x, y, w, wx, wy):
    """grad_a W^R, from W and its gradient."""
    f = a.p + a.qx*x + a.qy*y
    return f*wx + (a.gx + a.qxx*x + a.qyx*y)*w, f*wy + (a.gy + a.qxy*x + a.qyy*y)*w


@pressed.of(Reproducing)
def _(term, a, b, x, y, Sx, Sy):
    return 0.5*(a.P + b.P), a.P*(Sx*(a.vx - b.vx) + Sy*(a.vy - b.vy))


@area.of(Meshless)
def _(term, a, b, x, y, ab):
    f = 0.5*density(term, x, y)
    xx, xy, yy = (a.irho*a.bxx + b.irho*b.bxx, a.irho*a.bxy + b.irho*b.bxy, a.irho*a.byy + b.irho*b.byy)
    return f*(xx*x + xy*y), f*(xy*x + yy*y)


@pressed.of(Meshless)
def _(term, a, b, x, y, Sx, Sy):
    size = np.sqrt(Sx*Sx + Sy*Sy)
    nx, ny = Sx/max(size, 1e-300), Sy/max(size, 1e-300)
    one, other = middle(a, b, x, y), middle(b, a, -x, -y)
    u, w, Z, Y = nx*one[0] + ny*one[1], nx*other[0] + ny*other[1], a.c/a.irho, b.c/b.irho
    P = (Y*one[2] + Z*other[2] + Z*Y*(u - w))/(Z + Y)
    star = (Z*u + Y*w + one[2] - other[2])/(Z + Y)
    return P, 2*P*(Sx*a.vx + Sy*a.vy - size*star)


@pressed.of(Adiabatic)
def _(term, a, b, x, y, Sx, Sy):
    P, _ = pressed(Meshless(term.weight, term.m), a, b, x, y, Sx, Sy)
    return P, P*(Sx*(a.vx - b.vx) + Sy*(a.vy - b.vy))


@formula
def middle(a, b, x, y):
    """vx, vy, P at the middle of the pair, reconstructed from a and limited."""
    return (limited(a.vx, b.vx, a.vx + 0.5*(a.u_x*x + a.u_y*y)),
            limited(a.vy, b.vy, a.vy + 0.5*(a.v_x*x + a.v_y*y)),
            limited(a.P, b.P, a.P + 0.5*(a.P_x*x + a.P_y*y)))


@formula
def limited(own, other, value):
    """Limit a value to [own - d/2, mean + d/4], d = other - own    [App. B, psi_1, psi_2]"""
    # no branch on which end is the lower one: it would be mispredicted for every other pair
    d = other - own
    one, end = own - 0.5*d, 0.5*(own + other) + 0.25*d
    return max(min(one, end), min(max(one, end), value))


def push(term, a, b, ab):
    """Acceleration and heating of a; friction and the stress tau as in `corrected`."""
    x, y, u, v = b.x - a.x, b.y - a.y, b.vx - a.vx, b.vy - a.vy
    Sx, Sy = area(term, a, b, x, y, ab)
    P, work = pressed(term, a, b, x, y, Sx, Sy)
    # two particles in one place exert no force on each other
    F = -a.irho*b.irho*(x*ab.wx + y*ab.wy)/max(x*x + y*y, 1e-300)
    drag = -(a.eta + b.eta)*F
    fx = drag*u + Sx*(a.xx + b.xx) + Sy*(a.yx + b.yx)
    fy = drag*v + Sx*(a.xy + b.xy) + Sy*(a.yy + b.yy)
    return fx - 2*P*Sx, fy - 2*P*Sy, work + 0.5*(fx*u + fy*v) - (a.k + b.k)*F*(b.T - a.T)


register_term(Reproducing, 3, push)
register_term(Meshless, 3, push)


class OverFaces(Corrected):
    """Base class of CRKSPH and MFM: sums and numbers in addition to those of `Corrected`."""
    sums: ClassVar[Any]
    columns: ClassVar[int]
    kind: ClassVar[Any]
    finish: Any     # computes numbers of rows from their sums

    def __init__(self, method: Any, n: int, threads: Threads):
        super().__init__(method, n, threads)
        self.more = np.empty((self.around.rows, self.columns))

    def exchange(self, less: np.ndarray) -> tuple[Any, np.ndarray]:
        _, records = super().exchange(less)     # raises an error if neighbours lie in a line
        around, method = self.around, self.method
        given = method.weight, method.m
        self.threads(sweep, around.rows, self.sums(*given), records, around.pairs, self.more)
        self.finish(given)
        self.mirror()
        return self.kind(*given), records


class Crksph(OverFaces):
    sums, columns, kind = Moments, 12, Reproducing
    turns: ClassVar[dict[str, str]] = Corrected.turns | {
        "p": "", "qx": "x", "qy": "y", "gx": "x", "gy": "y", "qxx": "xx", "qxy": "xy", "qyx": "xy",
        "qyy": "yy"}

    def finish(self, given: tuple[Any, float]) -> None:
        self.threads(_reproduce, self.around.rows, *given, self.moments, self.more, self.records)


class Mfm(OverFaces):
    sums, columns, kind = Differences, 9, Meshless
    #: images copy c and do not take that of their T, so that v* is 0 at a wall at rest
    turns: ClassVar[dict[str, str]] = Corrected.turns | {
        "c": "", "bxx": "xx", "bxy": "xy", "byy": "yy", "u_x": "-x", "u_y": "-y", "v_x": "-x", "v_y": "-y",
        "P_x": "x", "P_y": "y"}

    def __init__(self, method: Any, n: int, threads: Threads):
        super().__init__(method, n, threads)
        images = [wall for wall in method.walls if type(wall) in image_pressure.kinds]
        if not all(image_pressure(wall, 0.0, 1.0) for wall in images):
            raise ValueError("slopes of P are mirrored as images copy it: take own_pressure = False")

    def finish(self, given: tuple[Any, float]) -> None:
        around = self.around
        self.threads(sound, around.rows, self.method.eos, around.rho, around.T, self.records)
        self.threads(_reconstruct, self.around.rows, self.more, self.records)


class AdiabaticMfm(Mfm):
    """MFM whose pressures exchange no heat between particles, as in its public code for slow flows.

    Printed MFM heats particle i of a pair by P* S.(v_i - v*) [Hopkins 2015, Sec. 2]. v* points down any jump
    of P between reconstructed states and carries P* along as heat. Where images copy P, gravity kinks its
    slope, and jumps stay: a conducting layer at rest, Ra 10 000, 25 rows, gains -0.78 of k dT/L per row at
    its hot plate. GIZMO, hydro_core_meshless.h, therefore uses another work if |v*| is small beside c.
    """
    kind = Adiabatic


@jit
def _reproduce(first, last, weight, m, M, sums, records):
    """p, q from H (p, q) = (1, 0, 0), H = ((m0, m1), (m1, m2)), and their gradients from those of H."""
    for i in range(first, last):
        a, (m0, x, y, xx, xy, yy, wx, wy, xxx, xxy, yyx, yyy) = records[i], sums[i]
        m0 += a.irho*m*weight.scale*shape(weight, 0.0)
        det = xx*yy - xy*xy
        m2 = yy/det, -xy/det, xx/det
        Bx, By = -(m2[0]*x + m2[1]*y), -(m2[1]*x + m2[2]*y)
        B = Bx, By, 1/(m0 + Bx*x + By*y)
        p, qx, qy = solved(m2, B, 1.0, 0.0, 0.0)
        mxx, mxy, myy = m0 - M[i, 0], -M[i, 1], m0 - M[i, 2]        # d_x m1_x, ...
        px, qxx, qyx = solved(m2, B, wx*p + mxx*qx + mxy*qy, mxx*p + (xxx + 2*x)*qx + (xxy + y)*qy,
                              mxy*p + (xxy + y)*qx + yyx*qy)
        py, qxy, qyy = solved(m2, B, wy*p + mxy*qx + myy*qy, mxy*p + xxy*qx + (yyx + x)*qy,
                              myy*p + (yyx + x)*qx + (yyy + 2*y)*qy)
        a.p, a.qx, a.qy, a.gx, a.gy = p, qx, qy, qx - px, qy - py
        a.qxx, a.qyx, a.qxy, a.qyy = -qxx, -qyx, -qxy, -qyy


@formula
def solved(m2, B, r, x, y):
    """H^-1 (r, x, y), from the inverse of m2 and (B, A) of Eqs 12, 13."""
    s = B[2]*(r + B[0]*x + B[1]*y)
    return s, m2[0]*x + m2[1]*y + B[0]*s, m2[1]*x + m2[2]*y + B[1]*s


@jit
def _reconstruct(first, last, sums, records):
    """B, and gradients of vx, vy, P for the reconstruction."""
    for i in range(first, last):
        a, (xx, xy, yy, ux, uy, vx, vy, Px, Py) = records[i], sums[i]
        det = xx*yy - xy*xy
        a.bxx, a.bxy, a.byy = yy/det, -xy/det, xx/det
        a.u_x, a.u_y = a.bxx*ux + a.bxy*uy, a.bxy*ux + a.byy*uy
        a.v_x, a.v_y = a.bxx*vx + a.bxy*vy, a.bxy*vx + a.byy*vy
        a.P_x, a.P_y = a.bxx*Px + a.bxy*Py, a.bxy*Px + a.byy*Py
