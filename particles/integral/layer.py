"""Discretized integral hydrodynamics on fixed points of a layer, compiled: the terms of `dih` over stored edges, in 2D.

Between plates, which RR98 leaves open, convection and pressure see images without friction, so that the divergence stays the
adjoint of the gradient: rho, T, eps and the velocity along the plate of their parents, the velocity across it reversed, and a
pressure that goes on hydrostatically. Friction and heat see images with -v and 2 T_w - T. Any other mixture lets sound grow.
"""
from dataclasses import dataclass
from functools import cached_property
from typing import Any, NamedTuple

import numpy as np

from continuum.fluid import ConstEta, IdealGas, check_state, conductivity, sound_speed, stress, temperature, viscosity
from continuum.jit import jit
from particles.fields import Fields, from_densities
from particles.ghosts import Ghosts
from particles.integral.edges import Beyond, Edges, fastest
from particles.integral.fixed import (
    Differences,
    Point,
    Summing,
    check_number,
    driven,
    exchange,
    lacking,
    opened,
    read,
    states,
    stored,
)
from particles.integral.layer_ideal import IdealSums
from particles.integral.transposed_stress import varying
from particles.limits import limit_of
from particles.pairs import nothing, rate, sweep
from particles.threads import Team

#: what nested transport exchanges: stress, -Q, and the velocity that friction sees
Current = np.dtype([(name, "f8") for name in ("xx", "xy", "yx", "yy", "qx", "qy", "ux", "uy")])


class Slopes(NamedTuple):
    """V grad of v and T by differences: d_x u, d_y u, d_x v, d_y v, d_x T, d_y T."""


class Nested(NamedTuple):
    """Stress and heat current of the points, over edges: momentum and energy    [Eqs 37, 38, for coefficients of one point]"""


nothing.of(Slopes)(lambda term: (0.0, 0.0, 0.0, 0.0, 0.0, 0.0))
nothing.of(Nested)(lambda term: (0.0, 0.0, 0.0))


@rate.of(Slopes)
def _(term, a, b, ab):
    du, dv, dT = b.ux - a.ux, b.uy - a.uy, b.Td - a.Td
    return ab.sx*du, ab.sy*du, ab.sx*dv, ab.sy*dv, ab.sx*dT, ab.sy*dT


@rate.of(Nested)
def _(term, a, b, ab):
    ax, ay, bx, by = ab.sx*a.xx + ab.sy*a.yx, ab.sx*a.xy + ab.sy*a.yy, ab.sx*b.xx + ab.sy*b.yx, ab.sx*b.xy + ab.sy*b.yy
    return ax + bx, ay + by, bx*a.ux + by*a.uy + ax*b.ux + ay*b.uy + ab.sx*(a.qx + b.qx) + ab.sy*(a.qy + b.qy)


@dataclass(frozen=True, kw_only=True)
class Layer:
    """A fluid on fixed points x (n, 2), periodic in x, between plates at T_plates (lower, upper) under gravity g.

    edges, beyond : of `edges.between_plates`. mended : friction along edges as it should be, its heating and, where viscosity
    varies, its force (`varying`); False as Eq. 51 has it, which heats even a rigid rotation. share : of viscosity and conduction
    that is along edges [Eq. 51]; the rest is nested, gradients first and their divergence after [Eqs 37, 38], and does not see
    waves two spacings long. fast : in the form of `layer_ideal` where the fluid allows it.
    """
    x: np.ndarray
    edges: Edges
    beyond: Beyond
    eos: Any
    law: Any
    T_plates: tuple[float, float]
    g: float
    mended: bool = True
    share: float = 1.0
    fast: bool = True

    names = ("rho", "px", "py", "eps")

    def __post_init__(self):
        if not 0 <= self.share <= 1:
            raise ValueError(f"the share of transport along edges must be between 0 (nested) and 1 (all), got {self.share}")

    def __repr__(self) -> str:
        """What tells a checkpoint's method from another: edges by their sums."""
        sums = ", ".join(f"{float(np.abs(q).sum())!r}" for q in (self.x, self.edges.S, self.edges.k, self.beyond.S))
        return (f"Layer({len(self.x)}, {sums}, {self.eos}, {self.law}, {self.T_plates}, {self.g}, {self.mended}, {self.share}, "
                f"{self.fast})")

    @cached_property
    def fastest(self) -> tuple[float, float]:
        """Largest frequency of sound over its speed, and largest rate of diffusion over the diffusivity."""
        return fastest(self.edges, self.beyond)

    def state(self, rho: Any, v: np.ndarray, T: np.ndarray) -> np.ndarray:
        """(4, n) of densities, velocities (n, 2), temperatures (n,)."""
        return states(self.eos, rho*np.ones(len(self.x)), v, T)

    def fields(self, state: np.ndarray) -> Fields:
        """Of the points, (n,) each."""
        return from_densities(self.eos, self.x, self.edges.V, state[0], state[1:3], state[3])

    def start(self, n: int, team: Team) -> "Exchanging":
        """The sums over stored edges.

        Raises
        ------
        ValueError
            The state has not as many points as there are.
        """
        check_number(n, len(self.x))
        return Exchanging(self, team)


@limit_of.register
def _(method: Layer, start: np.ndarray) -> float:
    """RK4: the fastest sound and the fastest diffusion of edges and images together, both at the hottest point."""
    rho = start[0]
    e = start[3]/rho - (start[1]**2 + start[2]**2)/(2*rho**2)
    check_state(method.eos, rho, e)
    T, (sound, spread) = temperature(method.eos, rho, e), method.fastest
    slope = (temperature(method.eos, rho, e + 1e-6) - T)/1e-6
    chi = np.maximum(viscosity(method.law, rho, T), conductivity(method.law, rho, T)*slope)/rho
    fast = sound_speed(method.eos, rho, e) + np.sqrt(start[1]**2 + start[2]**2)/rho
    return float(1/(np.max(fast)*sound/2.82 + np.max(chi)*spread/2.78))


class Exchanging(Summing):
    """The compiled sums of a layer, with what the time loop asks for."""

    def __init__(self, method: Layer, team: Team):
        self.method, self.team, self.n = method, team, len(method.x)
        beyond = method.beyond
        ghosts, self.ghost = np.unique(np.stack([beyond.parent, beyond.plate]), axis=1, return_inverse=True)
        self.parent, self.plate = ghosts
        image_y = method.x[beyond.i, 1] + beyond.apart[:, 1]
        self.rise = np.zeros(len(self.parent))      # how much higher a parent lies than its image
        self.rise[self.ghost.ravel()] = method.x[beyond.parent, 1] - image_y
        self.edges = stored(method.edges, beyond, self.n + self.ghost.ravel())
        self.open = opened(self.edges)
        self.points = np.zeros(self.n + len(self.parent), Point)
        self.slopes, self.total = np.empty((self.n, 4)), np.empty((self.n, 4))
        self.images = Ghosts(self.parent, -np.ones(len(self.parent)), np.array(method.T_plates)[self.plate])
        self.varying = varying(method.law, method.mended, self.n, team)
        if method.share < 1:
            self.currents, self.nested = np.zeros(len(self.points), Current), np.empty((self.n, 3))
            self.all_slopes = np.empty((self.n, 6))
        fits = isinstance(method.eos, IdealGas) and isinstance(method.law, ConstEta) and method.mended and method.share == 1
        self.linear = IdealSums(self) if fits and method.fast else None

    def rates(self, state: np.ndarray, out: np.ndarray) -> None:
        """d(state)/dt of a state (4, n), written to `out`    [Eqs 34-36, 51]"""
        if self.linear is not None:
            self.linear.rates(state, out)
            return
        method = self.method
        self.look_at(state)
        exchange(self.team, self.n, method.eos, self.points, self.edges, self.open, self.total)
        if method.share < 1:
            self.team(sweep, self.n, Nested(), self.currents, self.edges, self.nested)
            self.total[:, 1:] += self.nested
        if self.varying is not None:
            self.total[:, 1:3] += self.varying.push(self.points, self.slopes, method.edges.V, self.images, self.edges)
        self.team(driven, self.n, self.total, method.edges.V, self.points, np.array([0.0, -method.g]), out)

    def look_at(self, state: np.ndarray) -> None:
        """Fields of all points and images, and F."""
        method, points = self.method, self.points
        self.team(read, self.n, state, method.eos, method.law, method.share, points)
        _images(self.parent, self.plate, self.rise, np.array(method.T_plates), method.g, points, self.n)
        if method.mended:
            self.team(sweep, self.n, Differences(), points, self.edges, self.slopes)
            self.team(lacking, self.n, self.slopes, method.edges.V, points)
            _image_lacking(self.parent, points, self.n)
        if method.share < 1:
            self.team(sweep, self.n, Slopes(), points, self.edges, self.all_slopes)
            self.team(_currents, self.n, self.all_slopes, method.edges.V, method.law, 1 - method.share, points, self.currents)
            _image_currents(self.parent, points, self.currents, self.n)


@jit
def _currents(first, last, slopes, V, law, share, points, currents):
    """Stress and -Q of the nested share."""
    for i in range(first, last):
        a, b = points[i], currents[i]
        ux, uy, vx, vy, Tx, Ty = slopes[i]
        f = share/V[i]
        b.xx, b.xy, b.yy = stress(f*viscosity(law, a.rho, a.T), 0.0, ux, uy, vx, vy)
        k = f*conductivity(law, a.rho, a.T)
        b.yx, b.qx, b.qy, b.ux, b.uy = b.xy, k*Tx, k*Ty, a.ux, a.uy


@jit
def _image_currents(parent, points, currents, n):
    """The adjoint of gradients that see -v and 2 T_w - T: what goes along the plate is odd, what goes across it even.

    Of a shear stress that is another number for each of its two directions.
    """
    for m in range(len(parent)):
        a, b = currents[parent[m]], currents[n + m]
        b.ux, b.uy = points[n + m].ux, points[n + m].uy
        b.xx, b.xy, b.yx, b.yy, b.qx, b.qy = -a.xx, -a.xy, a.yx, a.yy, -a.qx, a.qy


@jit
def _images(parent, plate, rise, T_plates, g, points, n):
    for m in range(len(parent)):
        a, b = points[parent[m]], points[n + m]
        b.rho, b.vx, b.vy, b.T, b.eps = a.rho, a.vx, -a.vy, a.T, a.eps
        b.ux, b.uy, b.Td, b.eta, b.k = -a.ux, -a.uy, 2*T_plates[plate[m]] - a.Td, a.eta, a.k
        b.hydro = a.rho*g*rise[m]


@jit
def _image_lacking(parent, points, n):
    """No energy through the plate: F along it even, across it odd."""
    for m in range(len(parent)):
        a, b = points[parent[m]], points[n + m]
        b.Fx, b.Fy = a.Fx, -a.Fy
