"""RR98's moving points, compiled, in 2D: `rr98_moving_plain` over neighbour lists    [Sec. III]

The bracket is plain quadrature W dV times `scale_of`; friction goes along pairs [Eq. 51] without bulk
viscosity. Every motion is one sum over pairs, see `drifts`. Images are those of `layer`.
"""
from dataclasses import dataclass
from typing import Any

import numpy as np

from continuum.fluid import check_state, conductivity, pressure, sound_speed, temperature, viscosity
from continuum.jit import jit
from particles.fields import Fields, from_densities
from particles.integral.dih import densities
from particles.integral.drifts import ConstantMassDrift, Drifting, OverPairs
from particles.integral.edge_makers import plain, renormalised
from particles.integral.exchange import At, Exchange, listed, stages
from particles.integral.fixed import Point
from particles.integral.interpolants import check_ordering
from particles.integral.points import Points
from particles.integral.transposed_stress import MENDED
from particles.limits import lattice_sums, limit_of, zone
from particles.lists import Listed, PairLists, fastest, ghosts_of, unphysical
from particles.smooth.spam import LessStatic
from particles.starts import check_apart, check_volumes, moments
from particles.threads import Threads
from particles.weights import check_unit

#: the fields of fixed points, with places and volumes
Place = np.dtype([*Point.descr, ("x", "f8"), ("y", "f8"), ("V", "f8")])


@dataclass(frozen=True, kw_only=True)
class Drift:
    """A fluid on points that move, in a box (width, height) centred on the origin.

    motion : one of DRIFTS. weight : of `particles.weights`; scale : of its plain quadrature. walls : tuple of
    mirror plates and periodic sides. g : gravity, downwards. transport : listed terms of friction and heat.
    static : a share of the static pressure that pairs leave out, at constant mass.
    """
    motion: Any
    weight: Any
    eos: Any
    law: Any
    walls: tuple
    box: tuple[float, float]
    g: float = 0.0
    scale: float = 1.0
    transport: tuple = MENDED
    static: LessStatic = LessStatic(0.0, 0.0)  # noqa: RUF009 (immutable)

    def __post_init__(self):
        check_unit(self.weight)
        if self.static.fraction and not self.keeps_mass:
            raise ValueError(f"{type(self.motion).__name__} needs the whole pressure, as its volumes do not "
                             f"follow the flow, got {self.static}: take ConstantMassDrift")

    @property
    def keeps_mass(self) -> bool:
        return isinstance(self.motion, ConstantMassDrift)

    @property
    def names(self) -> tuple[str, ...]:
        """Rows of a state: places; momentum, mass, energy per volume or of a point; volumes."""
        return ("x", "y", "px", "py", *(("m", "E") if self.keeps_mass else ("rho", "eps")), "V")

    def owned(self, V: np.ndarray) -> np.ndarray:
        """Volumes (n,) over which m, p, E of a state are taken: 1 if they are densities."""
        return V if self.keeps_mass else np.ones_like(V)

    def state(self, x: np.ndarray, rho: Any, v: np.ndarray, T: np.ndarray) -> np.ndarray:
        """(7, n) of places (n, 2), densities, velocities (n, 2), temperatures (n,); all volumes are equal."""
        V = np.full(len(x), self.box[0]*self.box[1]/len(x))
        fields = densities(self.eos, rho*np.ones(len(x)), v, T)[[1, 2, 0, 3]]
        return np.concatenate([x.T, self.owned(V)*fields, V[None]])

    def fields(self, state: np.ndarray) -> Fields:
        px, py, rho, eps = state[2:6]/self.owned(state[6])
        return from_densities(self.eos, state[:2].T.copy(), state[6].copy(), rho, np.stack([px, py]), eps)

    def thermal(self, state: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Density and internal energy per mass."""
        px, py, rho, eps = state[2:6]/self.owned(state[6])
        return rho, eps/rho - (px**2 + py**2)/(2*rho**2)

    def start(self, n: int, threads: Threads) -> "Drifts":
        return Drifts(self, n, threads)


@limit_of.register
def _(method: Drift, start: np.ndarray) -> float:
    """RK4: waves on a lattice of the mean spacing; points lie off it, where they may be 1.4 times as fast.

    Volumes that stay add 2 P grad(n dV) to the force: omega^2 = S^2 c^2 + 2 D P/rho, S and D as in `limits`.
    """
    check_volumes(start[6])
    rho, e = method.thermal(start)
    check_state(method.eos, rho, e)
    T, a = temperature(method.eos, rho, e), float(np.sqrt(start[6].mean()))
    sums, f = lattice_sums(method.weight, a*a, 1.0, zone(a)), method.scale*a*a
    slow, stiff = f*f*(sums.S**2).sum(axis=1), f*np.linalg.eigvalsh(sums.D)[:, -1]
    c2, P = np.max(sound_speed(method.eos, rho, e)**2), np.max(np.abs(pressure(method.eos, rho, e))/rho)
    cv = 1e-6/(temperature(method.eos, rho, e + 1e-6) - T)
    chi = np.max(np.maximum(viscosity(method.law, rho, T), conductivity(method.law, rho, T)/cv)/rho)
    fast, spread = np.sqrt(np.max(c2*slow + 2*P*stiff)), chi*method.scale*np.max(sums.direct)
    return float(1/1.4/(fast/2.82 + spread/2.78))


def scale_of(points: Points, weight: Any) -> float:
    """The factor of plain quadrature W dV on these points that makes its mean first moment d."""
    return float(renormalised(points, weight).k.sum()/plain(points, weight).k.sum())


class Drifts(Listed):
    """The compiled sums of moving points, with what the time loop asks for."""

    def __init__(self, method: Drift, n: int, threads: Threads):
        self.method, self.threads, self.n = method, threads, n
        self.around = PairLists(method.weight, method.walls, n, method.box, skin=0.5, threads=threads)
        self._lists, terms = -1, method.motion.terms(method.eos, method.transport)
        needed = stages(terms, method.law, n, threads, OverPairs, ("x", "y", "V"))
        self.exchange = Exchange(OverPairs(Drifting(method.motion, listed(terms))), needed, n, threads)

    def look_over(self, state: np.ndarray, ids: np.ndarray) -> None:
        """Check the start: ValueError if points coincide, warning if the weight is narrow    [Eq. 45]"""
        a = float(np.sqrt(state[6].mean()))
        self.around.place(state, self.method.scale)
        check_apart(self.around, ids, a)
        off = moments(self.around, state[6]) - np.eye(2)
        check_ordering(self.method.weight, 2, a, float(np.sqrt((off**2).sum(axis=(1, 2)).mean()/2)))

    def make_ready(self, now: Any, dt: float) -> None:
        """Make new lists if needed. Rows 2, 3 are momenta: dt is scaled by speed/momentum."""
        momentum = fastest(now.state)
        speed = np.sqrt(((now.state[2]**2 + now.state[3]**2)/now.state[4]**2).max())
        super().make_ready(now, dt*float(speed)/momentum if momentum else dt)

    def look_at(self, state: np.ndarray) -> At:
        """Prepare the exchange: pairs where points are now, fields of points and images, stages."""
        method, around, n = self.method, self.around, self.n
        around.place(state, method.scale)
        if self._lists != around.lists_made:
            self._lists, self.ghosts = around.lists_made, ghosts_of(around)
            self.points = np.zeros(len(around.x), Place)
        points = self.points
        self.threads(_read, n, state, method.owned(state[6]), method.eos, method.law, method.static, method.g,
                     points)
        _image_fields(n, *self.ghosts, around.x, around.y, method.static, method.g, points)
        at = At(points, around.pairs, self.ghosts, state[6])
        for stage in self.exchange.stages:
            stage.prepare(at)
        return at

    def rates(self, state: np.ndarray, out: np.ndarray) -> None:
        """d(state)/dt of a state (7, n), written to `out`    [Eqs 34-36, 39, 46-51]"""
        method, total = self.method, self.exchange.sum(self.look_at(state))
        self.threads(_rates, self.n, total, method.owned(state[6]), self.points, method.static, method.g, out)

    def fault(self, state: np.ndarray, ids: np.ndarray) -> str:
        rho, e = self.method.thermal(state)
        return unphysical(self.method.eos, state[6], rho, e, ids) or self.outran(state)


@jit
def _read(first, last, state, owned, eos, law, static, g, points):
    for i in range(first, last):
        a, rho = points[i], state[4, i]/owned[i]
        a.x, a.y, a.V, a.rho, a.eps = state[0, i], state[1, i], state[6, i], rho, state[5, i]/owned[i]
        a.vx, a.vy = state[2, i]/state[4, i], state[3, i]/state[4, i]
        a.T = temperature(eos, rho, a.eps/rho - 0.5*(a.vx**2 + a.vy**2))
        a.ux, a.uy, a.Td = a.vx, a.vy, a.T
        a.eta, a.k = viscosity(law, rho, a.T), conductivity(law, rho, a.T)
        a.hydro = -static.fraction*(static.P0 - static.rho0*g*a.y)


@jit
def _image_fields(n, origin, turn, plate_T, x, y, static, g, points):
    """Shifted images are their origins; mirrored ones slip for convection and hydrostatic pressure."""
    for m in range(len(origin)):
        a, b, s = points[origin[m]], points[n + m], turn[m]
        b.x, b.y, b.V, b.rho, b.T, b.eps, b.eta, b.k = x[n + m], y[n + m], a.V, a.rho, a.T, a.eps, a.eta, a.k
        b.vx, b.vy, b.ux, b.uy = a.vx, s*a.vy, s*a.ux, s*a.uy
        b.Td = a.Td if s > 0 else 2*plate_T[m] - a.Td
        b.hydro = a.hydro + 0.5*(1 - s)*(a.rho - static.fraction*static.rho0)*g*(a.y - b.y)


@jit
def _rates(first, last, total, owned, points, static, g, out):
    """Rates from sums over pairs, gravity, and the static pressure that pairs leave out."""
    for i in range(first, last):
        a = points[i]
        mass, px, py, through, volume = total[i]
        f, weight = owned[i]/a.V, g*owned[i]*(a.rho - static.fraction*static.rho0)
        out[0, i], out[1, i], out[2, i], out[3, i] = a.vx, a.vy, f*px, f*py - weight
        out[4, i], out[5, i], out[6, i] = f*mass, f*through + a.hydro*volume - weight*a.vy, volume
