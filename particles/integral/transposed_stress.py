"""The stress that forces along edges lack where viscosity varies, for compiled methods, in 2D without bulk viscosity.

Forces along edges push by d_b(eta d_b v_a); a fluid's stress by d_b(eta d_a v_b) - d_a(eta div v) besides, which vanishes where
eta is constant: the divergence of

    tau = eta ((-d_y v, d_y u), (d_x v, -d_x u))      first the direction, then the component    [`dih.transposed`]

whose work F = tau.v mends the heating. What feels F feels tau then; where a law makes eta constant none of this exists.
"""
from typing import Any, NamedTuple

import numpy as np

from continuum.fluid import constant_viscosity
from continuum.jit import jit
from particles.ghosts import Ghosts
from particles.pairs import nothing, rate, sweep
from particles.threads import Team

Tau = np.dtype([(name, "f8") for name in ("xx", "xy", "yx", "yy")])


class Transposed(NamedTuple):
    """S.(tau_a + tau_b)/2: momentum."""


nothing.of(Transposed)(lambda term: (0.0, 0.0))


@rate.of(Transposed)
def _(term, a, b, ab):
    return ab.sx*(a.xx + b.xx) + ab.sy*(a.yx + b.yx), ab.sx*(a.xy + b.xy) + ab.sy*(a.yy + b.yy)


class Varying:
    """What tau pushes n points by. term : `Transposed`, or over pairs; places : what this wants to know of points besides."""

    def __init__(self, n: int, team: Team, term: Any = Transposed(), places: tuple[str, ...] = ()):  # noqa: B008 (immutable)
        self.n, self.team, self.term, self.places = n, team, term, places
        self.kind, self.force = np.dtype([*Tau.descr, *((name, "f8") for name in places)]), np.empty((n, 2))

    def push(self, points: np.ndarray, slopes: np.ndarray, V: np.ndarray, images: Ghosts, edges: Any) -> np.ndarray:
        """Forces (n, 2) from slopes, V times d_x u, d_y u, d_x v, d_y v, and the records of points and, last, of images.

        Slopes see -v beyond a plate; what is their adjoint sees tau odd along it and even across. So heating is tau times the
        slopes that made it, images included, and F along a plate is even, across it odd.
        """
        tau = np.empty(len(points), self.kind)
        self.team(_tau, self.n, slopes, V, points, tau)
        images.fill(tau, ("yx", "yy"), ("xx", "xy"))
        for name in self.places:
            tau[name] = points[name]
        self.team(sweep, self.n, self.term, tau, edges, self.force)
        return self.force


def varying(law: Any, mended: bool, n: int, team: Team, *more: Any) -> Varying | None:
    """What a method needs besides for a law; nothing where its viscosity is constant, or where Eq. 51 is taken as printed."""
    return Varying(n, team, *more) if mended and not constant_viscosity(law) else None


@jit
def _tau(first, last, slopes, V, points, tau):
    for i in range(first, last):
        a, f = tau[i], points[i].eta/V[i]
        a.xx, a.xy, a.yx, a.yy = -f*slopes[i, 3], f*slopes[i, 1], f*slopes[i, 2], -f*slopes[i, 0]
