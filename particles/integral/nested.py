"""Nested transport, in 2D: stress and heat current of points from gradients, their divergence over edges."""
from typing import Any, NamedTuple

import numpy as np

from continuum.fluid import conductivity, stress, viscosity
from continuum.jit import jit
from particles.integral.dih import check_share
from particles.integral.exchange import At, Conduction, Friction, Stage, stages_of
from particles.integral.transposed_stress import Mending
from particles.pairs import pair_term, register_term, sweep
from particles.threads import Threads

#: stress, minus the heat current Q, and the velocity that friction sees
Current = np.dtype([(name, "f8") for name in ("xx", "xy", "yx", "yy", "qx", "qy", "ux", "uy")])


class NestedTransport(NamedTuple):
    """A share of viscosity and conductivity, nested. Its sums, by `Nesting`, read records of their own."""
    share: float


register_term(NestedTransport, 4, lambda term, a, b, ab: (0.0, 0.0, 0.0, 0.0))      # its stage does all


@pair_term(6)
def Slopes(term, a, b, ab):
    """V times gradients of v and T, by differences: d_x u, d_y u, d_x v, d_y v, d_x T, d_y T."""
    du, dv, dT = b.ux - a.ux, b.uy - a.uy, b.Td - a.Td
    return ab.sx*du, ab.sy*du, ab.sx*dv, ab.sy*dv, ab.sx*dT, ab.sy*dT


@pair_term(3)
def Currents(term, a, b, ab):
    """Exchange of momentum and energy by stress and heat current of the points    [Eqs 37, 38]"""
    ax, ay = ab.sx*a.xx + ab.sy*a.yx, ab.sx*a.xy + ab.sy*a.yy
    bx, by = ab.sx*b.xx + ab.sy*b.yx, ab.sx*b.xy + ab.sy*b.yy
    return ax + bx, ay + by, bx*a.ux + by*a.uy + ax*b.ux + ay*b.uy + ab.sx*(a.qx + b.qx) + ab.sy*(a.qy + b.qy)


def mixed(share: float, mended: bool = True) -> tuple:
    """Terms for a share of transport along edges [Eq. 51], with `Mending` if mended, the rest nested."""
    check_share(share)
    along = (Conduction(share), *(Mending(share),)*mended, Friction(share))*(share > 0)
    return (*along, *(NestedTransport(1 - share),)*(share < 1))


class Nesting(Stage):
    """Computes stress and heat current of points and images, and adds their divergence."""

    def __init__(self, share: float, law: Any, n: int, threads: Threads):
        self.share, self.law, self.n, self.threads = share, law, n, threads
        self.slopes, self.gain, self.currents = np.empty((n, 6)), np.empty((n, 3)), np.zeros(0, Current)

    def prepare(self, at: At) -> None:
        """Images have the adjoint of gradients that see -v, 2 T_w - T: currents along the plate (xx, xy, qx)
        are odd, those across it (yx, yy, qy) even. So xy and yx of an image differ."""
        if len(self.currents) != len(at.points):
            self.currents = np.zeros(len(at.points), Current)
        self.threads(sweep, self.n, Slopes(), at.points, at.edges, self.slopes)
        self.threads(_currents, self.n, self.slopes, at.V, self.law, self.share, at.points, self.currents)
        at.images.fill(self.currents, ("yx", "yy", "qy"), ("xx", "xy", "qx"))
        for name in ("ux", "uy"):
            self.currents[name][self.n:] = at.points[name][self.n:]

    def use(self, slopes: np.ndarray, at: At) -> None:
        raise TypeError("nested transport needs gradients of T: over closed faces take friction and "
                        "conduction along them")

    def heat(self, i: np.ndarray, image: np.ndarray, S: np.ndarray) -> float:
        q = np.stack([self.currents[name][i] + self.currents[name][image] for name in ("qx", "qy")], axis=1)
        return float((S*q).sum()/2)

    def add(self, at: At, total: np.ndarray) -> None:
        self.threads(sweep, self.n, Currents(), self.currents, at.edges, self.gain)
        total[:, 1:4] += self.gain


@stages_of.register
def _(term: NestedTransport, law: Any, n: int, threads: Threads) -> tuple[Stage, ...]:
    return (Nesting(term.share, law, n, threads),)


@jit
def _currents(first, last, slopes, V, law, share, points, currents):
    """Stress and -Q of points, for the nested share."""
    for i in range(first, last):
        a, b = points[i], currents[i]
        ux, uy, vx, vy, Tx, Ty = slopes[i]
        f = share/V[i]
        b.xx, b.xy, b.yy = stress(f*viscosity(law, a.rho, a.T), 0.0, ux, uy, vx, vy)
        k = f*conductivity(law, a.rho, a.T)
        b.yx, b.qx, b.qy, b.ux, b.uy = b.xy, k*Tx, k*Ty, a.ux, a.uy
