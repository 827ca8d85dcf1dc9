"""The sums of `spam`: densities, gradients, stress and heat flux over pairs, compiled    [KHP95, Sec. II]"""
from abc import ABC, abstractmethod
from typing import Any, ClassVar

import numpy as np

from continuum.fluid import (
    conductivity,
    constant_viscosity,
    energy,
    pressure,
    sound_speed,
    stress,
    temperature,
    viscosity,
)
from continuum.jit import formula, jit
from particles.lists import Listed, PairLists, unphysical
from particles.pairs import Pairs, sweep
from particles.terms import DirectFluxes, Fluxes, finish, summand
from particles.threads import Threads
from particles.walls import image_flux, image_pressure

Moving = np.dtype([(name, "f8") for name in ("vx", "vy", "T", "s")])
#: of P/rho^2, h = Q/rho^2 + v.P/2rho^2, v: one cache line
Flux = np.dtype([(name, "f8") for name in ("xx", "xy", "hx", "vx", "one", "yy", "hy", "vy")])
DirectState = np.dtype([(name, "f8") for name in ("x", "y", "vx", "vy", "T", "P_rho2", "irho", "eta", "k")])


def aligned(points: int, kind: np.dtype) -> np.ndarray:
    """Records that begin with a cache line."""
    room = np.zeros(points*kind.itemsize + 64, np.uint8)
    first = -room.ctypes.data % 64
    return room[first:first + points*kind.itemsize].view(kind)


class SmoothSums(Listed, ABC):
    """What both kinds of transport share: arrays, density sum, equations of state, for the time loop.

    places : rows of a state that are positions; `velocity` : their rates, for integrators that step them
    apart. symbol : of what stands for the wave number squared in `particles.limits.Symbols`.
    of_state : names of its rows. columns : of the third sum, before its records finish it.
    """
    places = 2
    of_state: ClassVar[tuple[str, ...]] = ("x", "y", "vx", "vy", "e")
    symbol: ClassVar[str]
    columns: ClassVar[int] = 3

    def __init__(self, method: Any, n: int, threads: Threads):
        self.method, self.threads, self.n = method, threads, n
        self.around = PairLists(method.weight, method.walls, n, method.box, skin=method.skin, threads=threads)
        self.slopes, self.pull = np.zeros((self.around.rows, 8)), np.zeros((n, self.columns))
        self.less, self.moving = np.empty(0), np.empty(0, Moving)

    @classmethod
    def complete(cls, state: np.ndarray, rho: Any, m: float) -> np.ndarray:
        """All rows of a state from the first five; density and mass of particles."""
        return state

    def shares(self, state: np.ndarray) -> Any:
        """Masses of the particles over that of the method."""
        return 1.0

    def place(self, state: np.ndarray) -> None:
        """Positions and densities."""
        self.around.place(state, self.method.m)

    def densities(self, state: np.ndarray) -> None:
        """First sum, equations of state, motion and pressure of the images."""
        around, method = self.around, self.method
        self.place(state)
        if len(self.less) != len(around.x):
            self.allocate(len(around.x))
        self.threads(_thermal, around.rows, self.n, state, method.eos, method.static, method.g, around.y,
                     around.rho, around.vx, around.vy, around.T, around.P, self.less)
        around.move()
        for wall, parent, first, last in around.blocks:
            _image_pressures(first, last, wall, parent, method.eos, method.static, method.g, around.y,
                             around.rho, around.T, around.P, self.less)

    @abstractmethod
    def exchange(self, less: np.ndarray) -> tuple[Any, np.ndarray]:
        """Term and records of the third sum, from what `prepare` made, with the pressures `less`."""

    def push(self, state: np.ndarray, less: np.ndarray, pairs: Pairs, out: np.ndarray) -> None:
        """d(x, y, vx, vy, e)/dt by some pairs alone, written to `out`: the third sum."""
        self.threads(sweep, self.n, *self.exchange(less), pairs, self.pull)
        self.threads(_pushed, self.n, state, self.pull, out)

    def prepare(self, state: np.ndarray) -> None:
        """What the third sum needs."""
        self.look_at(state)

    def rates(self, state: np.ndarray, out: np.ndarray) -> None:
        """d(x, y, vx, vy, e)/dt of a state (5, n), written to `out`."""
        self.prepare(state)
        self.push(state, self.less, self.around.pairs, out)
        self.threads(_weighed, self.n, state, self.around.rho, self.slopes, self.method.g,
                     self.method.static, out)

    def velocity(self, state: np.ndarray) -> np.ndarray:
        return state[2:4]

    def look_at(self, state: np.ndarray) -> None:
        """Densities and gradients of a state, for whatever is measured on it."""
        self.densities(state)
        self.gradients()

    def fault(self, state: np.ndarray, ids: np.ndarray) -> str:
        rho, method = self.around.rho[:self.n], self.method
        return unphysical(method.eos, method.m/rho, rho, state[4], ids) or self.outran(state)

    def allocate(self, points: int) -> None:
        """Arrays over all points, whose number changes with the lists."""
        self.less, self.moving = np.empty(points), aligned(points, Moving)

    def gradients(self) -> None:
        """Second sum: self.slopes (rows, 8)."""
        around, kind = self.around, self.method.gradients
        self.threads(_moving, len(around.x), kind, around.vx, around.vy, around.T, around.rho, self.moving)
        self.threads(sweep, around.rows, kind, self.moving, around.pairs, self.slopes)
        self.threads(_finish, around.rows, kind, self.moving, self.slopes)

    @property
    def gradient(self) -> np.ndarray:
        """(rows, 6): dvx/dx, dvy/dx, dT/dx, dvx/dy, dvy/dy, dT/dy."""
        return self.slopes.reshape(-1, 2, 4)[:, :, :3].reshape(-1, 6)


class Nested(SmoothSums):
    """Stress and heat flux from gradients of the second sum, divergence in the third    [KHP95, Sec. II]"""
    symbol = "nested"
    columns = 16

    def allocate(self, points: int) -> None:
        super().allocate(points)
        self.flux = aligned(points, Flux)
        self.flux["one"] = 1

    def push(self, state: np.ndarray, less: np.ndarray, pairs: Pairs, out: np.ndarray) -> None:
        self.threads(sweep, self.n, *self.exchange(less), pairs, self.pull)
        self.threads(_closed, self.n, state, self.flux, self.pull, out)

    def exchange(self, less: np.ndarray) -> tuple[Any, np.ndarray]:
        around = self.around
        self.threads(_fluxes, around.rows, self.method.law, around.rho, around.vx, around.vy, around.T, less,
                     self.slopes, self.flux)
        for wall, parent, first, last in around.blocks:
            _image_fluxes(first, last, wall, parent, around.rho, around.vx, around.vy, less, self.flux)
        return Fluxes(), self.flux


class Direct(SmoothSums):
    """Viscosity and conduction along each pair: no gradients, unless the static part needs div v."""
    symbol = "direct"

    def allocate(self, points: int) -> None:
        super().allocate(points)
        self.records = np.empty(points, DirectState)

    def prepare(self, state: np.ndarray) -> None:
        self.densities(state)
        if self.method.static.fraction:
            self.gradients()

    def exchange(self, less: np.ndarray) -> tuple[Any, np.ndarray]:
        around = self.around
        self.threads(_direct, len(around.x), self.method.law, around.x, around.y, around.rho, around.vx,
                     around.vy, around.T, less, self.records)
        return DirectFluxes(), self.records


def check_along_pairs(law: Any) -> None:
    """Refuse a viscosity that varies where `Direct` has all of the friction: ValueError."""
    if not constant_viscosity(law):
        raise ValueError("friction along pairs lacks a part of the stress where viscosity varies, as by "
                         f"{law}: take ConstEta, or a transport with corrected gradients, as CRKSPH")


@jit
def _thermal(first, last, n, state, eos, static, g, y, rho, vx, vy, T, P, less):
    for i in range(first, last):
        if i < n:
            vx[i], vy[i] = state[2, i], state[3, i]
            T[i], P[i] = temperature(eos, rho[i], state[4, i]), pressure(eos, rho[i], state[4, i])
        else:
            P[i] = pressure(eos, rho[i], energy(eos, rho[i], T[i]))
        less[i] = P[i] - _static(static, g, y[i])


@formula
def _static(static, g, y):
    """The part of the static pressure that is left out."""
    return static.fraction*(static.P0 - static.rho0*g*y)


@jit
def _image_pressures(first, last, wall, parent, eos, static, g, y, rho, T, P, less):
    for i in range(first, last):
        p = parent[i - first]
        own = pressure(eos, rho[i], energy(eos, rho[i], T[i]))
        P[i] = image_pressure(wall, own, P[p])
        less[i] = image_pressure(wall, own - _static(static, g, y[i]), less[p])


@jit
def _moving(first, last, kind, vx, vy, T, rho, moving):
    for i in range(first, last):
        a = moving[i]
        a.vx, a.vy, a.T, a.s = summand(kind, rho[i], vx[i], vy[i], T[i])


@jit
def _finish(first, last, kind, moving, slopes):
    for i in range(first, last):
        finish(kind, moving[i], slopes[i])


@jit
def _fluxes(first, last, law, rho, vx, vy, T, less, slopes, flux):
    """P/rho^2 and Q/rho^2 with P = (P - static) I - stress, Q = -k grad T."""
    for i in range(first, last):
        xx, yx, Tx, _, xy, yy, Ty, _ = slopes[i]  # xy: dvx/dy
        sxx, sxy, syy = stress(viscosity(law, rho[i], T[i]), 0.0, xx, yx, xy, yy)
        k, f, a = conductivity(law, rho[i], T[i]), 1/rho[i]**2, flux[i]
        a.vx, a.vy = vx[i], vy[i]
        a.xx, a.xy, a.yy = (less[i] - sxx)*f, -sxy*f, (less[i] - syy)*f
        wx, wy = _work(a)
        a.hx, a.hy = wx - k*Tx*f, wy - k*Ty*f


@formula
def _work(a):
    """v.P/2rho^2."""
    return 0.5*(a.vx*a.xx + a.vy*a.xy), 0.5*(a.vx*a.xy + a.vy*a.yy)


@jit
def _image_fluxes(first, last, wall, parent, rho, vx, vy, less, flux):
    """Stress and heat flux copied from the parents, pressure by the wall's rule    [KHP95, Sec. IV]"""
    for i in range(first, last):
        p = parent[i - first]
        a, b, f, (bx, by) = flux[i], flux[p], (less[i] - less[p])/rho[i]**2, _work(flux[p])
        a.vx, a.vy = vx[i], vy[i]
        xy, qx, qy = image_flux(wall, b.xy, b.hx - bx, b.hy - by, rho[i])
        a.xx, a.xy, a.yy = b.xx + f, xy, b.yy + f
        wx, wy = _work(a)
        a.hx, a.hy = wx + qx, wy + qy


@jit
def _direct(first, last, law, x, y, rho, vx, vy, T, less, records):
    for i in range(first, last):
        a = records[i]
        a.x, a.y, a.vx, a.vy, a.T = x[i], y[i], vx[i], vy[i], T[i]
        a.P_rho2, a.irho = less[i]/rho[i]**2, 1/rho[i]
        a.eta, a.k = viscosity(law, rho[i], T[i]), conductivity(law, rho[i], T[i])


@jit
def sound(first, last, eos, rho, T, records):
    for i in range(first, last):
        records[i].c = sound_speed(eos, rho[i], energy(eos, rho[i], T[i]))


@jit
def _pushed(first, last, state, pull, out):
    for i in range(first, last):
        out[0, i], out[1, i] = state[2, i], state[3, i]
        out[2, i], out[3, i], out[4, i] = pull[i, 0], pull[i, 1], pull[i, 2]


@jit
def _closed(first, last, state, flux, pull, out):
    """The same of what partners bring, times x in columns 0:8, y in 8:16, and of what is a particle's own."""
    for i in range(first, last):
        a, p, x, y = flux[i], pull[i], pull[i, 4], pull[i, 12]
        own_x, own_y, sent_x, sent_y = a.xx*x + a.xy*y, a.xy*x + a.yy*y, p[0] + p[9], p[1] + p[13]
        heat = a.hx*x + a.hy*y + p[2] + p[14] + 0.5*(a.xx*p[3] + a.xy*(p[7] + p[11]) + a.yy*p[15])
        work = a.vx*(own_x + 0.5*sent_x) + a.vy*(own_y + 0.5*sent_y)
        out[0, i], out[1, i] = state[2, i], state[3, i]
        out[2, i], out[3, i], out[4, i] = -own_x - sent_x, -own_y - sent_y, work - heat


@jit
def _weighed(first, last, state, rho, slopes, g, static, out):
    """Add gravity, and support and work of what pressure the pair sums leave out."""
    for i in range(first, last):
        out[3, i] -= g
    if static.fraction != 0:
        for i in range(first, last):
            out[3, i] += g*static.fraction*static.rho0/rho[i]
            out[4, i] -= _static(static, g, state[1, i])/rho[i]*(slopes[i, 0] + slopes[i, 5])
