"""Smooth particles with a transport velocity by a background pressure    [Adami, Hu & Adams 2013]

Density is summed, V = m/rho. Particles move with v~ = v + d, and P is taken relative to P0:

    d_i = -(tau/m) P0 sum_j (V_i^2 + V_j^2) grad W                                        [Eq. 13]
    m v_i' = sum_j (V_i^2 + V_j^2) (-P~ grad W + (A_i + A_j)/2 . grad W), A = rho v d     [Eq. 8]
    P~ = (rho_j P_i + rho_i P_j)/(rho_i + rho_j)                                          [Eq. 7]

The paper's P0 = rho0 c0^2/gamma is the pressure of our gas at its mean state. `LessStatic` with fraction 1
subtracts all of P0, as the paper's P = c0^2 (rho - rho0) does. Ps, which it subtracts, works by div v~, as
volumes change: by div v it would heat by d^2/tau per mass, as the rest of P does. Energy then grows by the
sum of V (rho - rho0) g d_y: under gravity rho0 has to be the density at rest.

tau is half of the paper's time step, as in its kick from v to v~ [Eq. 15]; this step is its acoustic limit,
0.25 a/c of each particle, whatever dt is. Friction and heat are those of `Direct`, in place of Adami's
harmonic mean. Each particle of a pair gets half of the work of its forces. The paper's walls extrapolate P by
gravity; here images copy it.

As in the paper, forces by A lack v div(rho d): rates are Galilean invariant only where A is zero. Energy has
no such term: v~ carries heat. A flux e d without mass would heat by e div d, and e, unlike v, is not small.
"""
from typing import Any

import numpy as np

from continuum.jit import jit
from particles.observe import heat_flow
from particles.pairs import pair_term, sweep
from particles.smooth.sums import Direct, Led, _moving, sound
from particles.threads import Threads

COURANT = 0.25/2    # tau over a/c


@pair_term(2)
def Background(term, a, b, ab):
    """sum (1/rho_a^2 + 1/rho_b^2) grad m w."""
    f = a.irho**2 + b.irho**2
    return f*ab.wx, f*ab.wy


@pair_term(3)
def Transported(term, a, b, ab):
    """As `DirectFluxes`, with P~ and A."""
    x, y, u, v, f = a.x - b.x, a.y - b.y, a.vx - b.vx, a.vy - b.vy, a.irho**2 + b.irho**2
    # two particles in one place exert no force on each other
    F = (x*ab.wx + y*ab.wy)/max(x*x + y*y, 1e-300)*a.irho*b.irho
    # P~ of Eq. 7, written in P/rho^2
    p, drag = f*(a.P_rho2/a.irho + b.P_rho2/b.irho)/(a.irho + b.irho), (a.eta + b.eta)*F
    own, other = 0.5*f*(a.dx*ab.wx + a.dy*ab.wy)/a.irho, 0.5*f*(b.dx*ab.wx + b.dy*ab.wy)/b.irho
    fx = drag*u - p*ab.wx + own*a.vx + other*b.vx
    fy = drag*v - p*ab.wy + own*a.vy + other*b.vy
    return fx, fy, -0.5*(u*fx + v*fy) + (a.k + b.k)*F*(a.T - b.T)


class TransportVelocity(Led):
    """Sums with the terms `Background` and `Transported`."""
    numbers, turns = f"{Direct.numbers} c", {"dx": "x", "dy": "y"}

    def __init__(self, method: Any, n: int, threads: Threads):
        super().__init__(method, n, threads)
        if not method.static.P0 > 0:
            raise ValueError("a transport velocity is of a background pressure, got static.P0 = "
                             f"{method.static.P0:g}: give static = LessStatic(fraction, P0, rho0), P0 > 0")
        self.even = np.empty((self.around.rows, 2))

    def prepare(self, state: np.ndarray) -> None:
        self.densities(state)       # gradients follow d

    def gradients(self) -> None:
        """Gradients of v~ and T, for the work of the subtracted pressure, too."""
        self.exchange(self.less)

    def exchange(self, less: np.ndarray) -> tuple[Any, np.ndarray]:
        around, method, (_, records) = self.around, self.method, super().exchange(less)
        self.threads(sound, len(around.x), method.eos, around.rho, around.T, records)
        self.threads(sweep, self.n, Background(), records, around.pairs, self.even)
        self.threads(_carry, self.n, method.static.P0, np.sqrt(method.m), self.even, records)
        self.mirror()
        vx, vy, kind = around.vx + records["dx"], around.vy + records["dy"], method.gradients
        self.threads(_moving, len(around.x), kind, vx, vy, around.T, around.rho, self.moving)
        self.threads(sweep, around.rows, kind, self.moving, around.pairs, self.slopes)
        return Transported(), records


@jit
def _carry(first, last, P0, root_m, even, records):
    """Transport velocity d of Eq. 13, with the spacing a = sqrt(m/rho)."""
    for i in range(first, last):
        a = records[i]
        f = -COURANT*root_m*np.sqrt(a.irho)/a.c*P0
        a.dx, a.dy = f*even[i, 0], f*even[i, 1]


def transported_heat(sums: Any, state: np.ndarray) -> float:
    """`heat_flow` with what d adds: rho d_y (e + v^2/2 + g y), and the work of the subtracted pressure.

    Left as they are: -rho v^2 d_y, which the forces by A carry, and that the stress is that of v + d.
    """
    method, (_, y, vx, vy, e), d = sums.method, state, sums.records["dy"][:sums.n]
    static = method.static.fraction*(method.static.P0 - method.static.rho0*method.g*y)
    added = d*(e + (vx**2 + vy**2)/2 + method.g*y + static/sums.around.rho[:sums.n])
    return heat_flow(sums, state) + float(method.m*added.sum()/(method.box[0]*method.box[1]))
