"""Correction of forces along edges to a fluid's stress, and its work, in 2D without bulk viscosity.

Forces along edges give d_b(eta d_b v_a); a fluid's stress adds d_b(eta d_a v_b) - d_a(eta div v), the
divergence of

    tau = eta ((-d_y v, d_y u), (d_x v, -d_x u))      (direction, component)    [`dih.transposed`]

This divergence is zero where eta is constant; that of the work F = tau.v is not: without F even a rigid
rotation heats. `Mending` adds F, and tau as well where the law makes eta vary.
"""
from collections.abc import Callable
from typing import Any

import numpy as np

from continuum.fluid import constant_viscosity
from continuum.jit import jit
from particles.integral.exchange import At, Conduction, Friction, Stage, stages_of
from particles.pairs import pair_term, sweep
from particles.threads import Threads

Tau = np.dtype([(name, "f8") for name in ("xx", "xy", "yx", "yy")])


@pair_term(4, share=1.0)
def Mending(term, a, b, ab):
    """Energy S.(F_a + F_b)/2; where viscosity varies, momentum S.(tau_a + tau_b)/2 as well. Of a share."""
    return 0.0, 0.0, 0.0, ab.sx*(a.Fx + b.Fx) + ab.sy*(a.Fy + b.Fy)


@pair_term(4)
def Differences(term, a, b, ab):
    """V times grad v, by differences: d_x u, d_y u, d_x v, d_y v."""
    du, dv = b.ux - a.ux, b.uy - a.uy
    return ab.sx*du, ab.sy*du, ab.sx*dv, ab.sy*dv


@pair_term(2)
def Transposed(term, a, b, ab):
    """Momentum S.(tau_a + tau_b)/2."""
    return ab.sx*(a.xx + b.xx) + ab.sy*(a.yx + b.yx), ab.sx*(a.xy + b.xy) + ab.sy*(a.yy + b.yy)


#: conduction, and friction along edges with the correction to a fluid's heating and force
MENDED = (Conduction(), Mending(), Friction())


class Heating(Stage):
    """Computes F of points and images.

    Slopes see -v beyond a plate; tau is odd along it and even across, F even along and odd across: no energy
    goes through. over : wraps terms for the kind of edges; places : fields of points that `over` reads.
    """

    def __init__(self, share: float, n: int, threads: Threads, over: Callable[[Any], Any] = lambda term: term,
                 places: tuple[str, ...] = ()):
        self.share, self.n, self.threads, self.over, self.places = share, n, threads, over, places
        self.slopes = np.zeros((n, 4))

    def prepare(self, at: At) -> None:
        self.threads(sweep, self.n, self.over(Differences()), at.points, at.edges, self.slopes)
        self.use(self.slopes, at)

    def use(self, slopes: np.ndarray, at: At) -> None:
        self.slopes = slopes
        self.threads(_work, self.n, slopes, at.V, self.share, at.points)
        at.images.fill_work(at.points, slopes, at.V)


class HeatingAndForce(Heating):
    """Computes F, and adds the force of tau."""

    def add(self, at: At, total: np.ndarray) -> None:
        tau = np.empty(len(at.points), [*Tau.descr, *((name, "f8") for name in self.places)])
        force = np.empty((self.n, 2))
        self.threads(_tau, self.n, self.slopes, at.V, self.share, at.points, tau)
        at.images.fill(tau, ("yx", "yy"), ("xx", "xy"))
        for name in self.places:
            tau[name] = at.points[name]
        self.threads(sweep, self.n, self.over(Transposed()), tau, at.edges, force)
        total[:, 1:3] += force


@stages_of.register(Mending)
def _(term: Any, law: Any, n: int, threads: Threads, *more: Any) -> tuple[Stage, ...]:
    kind = Heating if constant_viscosity(law) else HeatingAndForce
    return (kind(term.share, n, threads, *more),)


@jit
def _work(first, last, slopes, V, share, points):
    """F = eta (v u_y - u v_y, u v_x - v u_x), in 2D without bulk viscosity: `dih.Pairwise`."""
    for i in range(first, last):
        a, f = points[i], share*points[i].eta/V[i]
        ux, uy, vx, vy = slopes[i, 0], slopes[i, 1], slopes[i, 2], slopes[i, 3]
        a.Fx, a.Fy = f*(a.vy*uy - a.vx*vy), f*(a.vx*vx - a.vy*ux)


@jit
def _tau(first, last, slopes, V, share, points, tau):
    for i in range(first, last):
        a, f = tau[i], share*points[i].eta/V[i]
        a.xx, a.xy, a.yx, a.yy = -f*slopes[i, 3], f*slopes[i, 1], f*slopes[i, 2], -f*slopes[i, 0]
