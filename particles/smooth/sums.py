"""Compiled pair sums of smooth particles: density, gradients, stress and heat flux    [KHP95, Sec. II]"""
from abc import ABC, abstractmethod
from typing import Any, ClassVar

import numpy as np

from continuum.fluid import conductivity, energy, pressure, sound_speed, stress, temperature, viscosity
from continuum.jit import formula, jit
from particles.lists import Listed, PairLists, unphysical
from particles.pairs import sweep
from particles.terms import DirectFluxes, Fluxes, density_factor
from particles.threads import Threads
from particles.walls import image_flux, image_pressure, mirrored

MOVED = 0.25        # part of the skin that a particle may use before a step; d uses no more of it in the step
Moving = np.dtype([(name, "f8") for name in ("vx", "vy", "T", "s")])


class SmoothSums(Listed, ABC):
    """Base class of the sums of every transport: arrays, density sum, equation of state, for the time loop.

    places : number of leading rows of a state that are positions; `velocity` : their rates, for integrators
    that step positions separately. symbol : field of `particles.limits.Symbols` that replaces the squared
    wave number. of_state : names of the rows of a state. along_pairs : whether friction goes along pairs
    alone, which needs a constant viscosity. numbers : names in a record of the third sum; after them come
    those of `turns`, which images get from their parents, each with its sign in a mirror: an x changes it in
    a mirror across x, a y in one across y, - in both.
    """
    places, along_pairs = 2, False
    of_state: ClassVar[tuple[str, ...]] = ("x", "y", "vx", "vy", "e")
    symbol: ClassVar[str]
    numbers: ClassVar[str]
    turns: ClassVar[dict[str, str]] = {}

    def __init__(self, method: Any, n: int, threads: Threads):
        self.method, self.threads, self.n = method, threads, n
        self.around = PairLists(method.weight, method.walls, n, method.box, skin=method.skin, threads=threads)
        self.slopes, self.pull = np.zeros((self.around.rows, 8)), np.zeros((self.around.rows, 5))
        self.record = np.dtype([(name, "f8") for name in (*self.numbers.split(), *self.turns)])
        self.less, self.moving, self.records = np.empty(0), np.empty(0, Moving), np.empty(0, self.record)

    @classmethod
    def complete(cls, state: np.ndarray, rho: Any, m: float) -> np.ndarray:
        """All rows of a state from the first five, and from density and mass of the particles."""
        return state

    def shares(self, state: np.ndarray) -> Any:
        """Masses of the particles over the mass m of the method."""
        return 1.0

    def place(self, state: np.ndarray) -> None:
        """Set positions and densities."""
        self.around.place(state, self.method.m)

    def densities(self, state: np.ndarray) -> None:
        """First sum, equation of state, and then velocities, temperatures and pressures of images."""
        around, method = self.around, self.method
        self.place(state)
        if len(self.less) != (points := len(around.x)):     # it changes with the lists
            self.less, self.moving = np.empty(points), np.empty(points, Moving)
            self.records = np.zeros(points, self.record)
        self.threads(_thermal, around.rows, self.n, state, method.eos, method.static, method.g, around.y,
                     around.rho, around.vx, around.vy, around.T, around.P, self.less)
        around.move()
        for wall, parent, first, last in around.blocks:
            _image_pressures(first, last, wall, parent, method.eos, method.static, method.g, around.y,
                             around.rho, around.T, around.P, self.less)

    @abstractmethod
    def exchange(self, less: np.ndarray) -> tuple[Any, np.ndarray]:
        """Term and records of the third sum for the pressures `less`; call after `prepare`."""

    def prepare(self, state: np.ndarray) -> None:
        """Compute what the third sum needs at a state."""
        self.look_at(state)

    def rates(self, state: np.ndarray, out: np.ndarray) -> None:
        """d(x, y, vx, vy, e)/dt of a state (5, n), written to `out`."""
        self.prepare(state)
        self.threads(sweep, self.n, *self.exchange(self.less), self.around.pairs, self.pull)
        self.threads(_rates, self.n, state, self.pull, self.around.rho, self.slopes, self.method.g,
                     self.method.static, out)
        out[:2] = self.velocity(state)

    def velocity(self, state: np.ndarray) -> np.ndarray:
        return state[2:4]

    def look_at(self, state: np.ndarray) -> None:
        """Compute densities and gradients of a state, for measured quantities."""
        self.densities(state)
        self.gradients()

    def fault(self, state: np.ndarray, ids: np.ndarray) -> str:
        rho, method = self.around.rho[:self.n], self.method
        return unphysical(method.eos, method.m/rho, rho, state[4], ids) or self.outran(state)

    def mirror(self) -> None:
        """Set the numbers of images that are in `turns`."""
        values = self.records.view("f8").reshape(len(self.records), -1)[:, -len(self.turns):]
        for wall, parent, first, last in self.around.blocks:
            signs = [sign(how, mirrored(wall)) for how in self.turns.values()]
            values[first:last] = np.array(signs)*values[parent]

    def gradients(self) -> None:
        """Second sum: d/dx of vx, vy, T in columns 0, 1, 2 of self.slopes (rows, 8), d/dy in 4, 5, 6."""
        around, kind = self.around, self.method.gradients
        self.threads(_moving, len(around.x), kind, around.vx, around.vy, around.T, around.rho, self.moving)
        self.threads(sweep, around.rows, kind, self.moving, around.pairs, self.slopes)


def sign(how: str, axis: int) -> float:
    """Sign of a number in a mirror across an axis; 1 without a mirror (axis = -1). how : as in `turns`."""
    return (-1.0)**(how.count("xy"[axis]) + how.count("-")) if axis >= 0 else 1.0


class Nested(SmoothSums):
    """Stress and heat flux from the second sum's gradients, divergence by the third    [KHP95, Sec. II]"""
    symbol, numbers = "nested", "xx xy qx vx yx yy qy vy"       # one cache line

    def exchange(self, less: np.ndarray) -> tuple[Any, np.ndarray]:
        around = self.around
        self.threads(_fluxes, around.rows, self.method.law, around.rho, around.vx, around.vy, around.T, less,
                     self.slopes, self.records)
        for wall, parent, first, last in around.blocks:
            _image_fluxes(first, last, wall, parent, around.rho, around.vx, around.vy, less, self.records)
        return Fluxes(), self.records


class Direct(SmoothSums):
    """Viscosity and conduction along each pair: no gradients, unless `LessStatic` needs div v."""
    symbol, along_pairs, numbers = "direct", True, "x y vx vy T P_rho2 irho eta k"

    def prepare(self, state: np.ndarray) -> None:
        self.densities(state)
        if self.method.static.fraction:
            self.gradients()

    def exchange(self, less: np.ndarray) -> tuple[Any, np.ndarray]:
        around = self.around
        self.threads(_direct, len(around.x), self.method.law, around.x, around.y, around.rho, around.vx,
                     around.vy, around.T, less, self.records)
        return DirectFluxes(), self.records


class Led(Direct):
    """Base class of particles that move with v + d; their records have d = (dx, dy)."""

    def make_ready(self, now: Any, dt: float) -> None:
        if self.around.anchor is not None and self.around.moved(now.state) > MOVED*self.around.skin:
            self.around.anchor = None
        super().make_ready(now, dt)

    def velocity(self, state: np.ndarray) -> np.ndarray:
        return state[2:4] + np.stack([self.records[name][:self.n] for name in ("dx", "dy")])


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
    """The part of the static pressure that is subtracted."""
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
        a.vx, a.vy, a.T, a.s = vx[i], vy[i], T[i], density_factor(kind, rho[i])


@jit
def _fluxes(first, last, law, rho, vx, vy, T, less, slopes, flux):
    """P/rho^2 and Q/rho^2 with P = (P - static) I - stress, Q = -k grad T."""
    for i in range(first, last):
        xx, yx, Tx, _, xy, yy, Ty, _ = slopes[i]  # xy: dvx/dy
        sxx, sxy, syy = stress(viscosity(law, rho[i], T[i]), 0.0, xx, yx, xy, yy)
        k, f, a = conductivity(law, rho[i], T[i]), 1/rho[i]**2, flux[i]
        a.vx, a.vy = vx[i], vy[i]
        a.xx, a.xy, a.yx, a.yy = (less[i] - sxx)*f, -sxy*f, -sxy*f, (less[i] - syy)*f
        a.qx, a.qy = -k*Tx*f, -k*Ty*f


@jit
def _image_fluxes(first, last, wall, parent, rho, vx, vy, less, flux):
    """Stress and heat flux copied from the parents, pressure by the wall's rule    [KHP95, Sec. IV]"""
    for i in range(first, last):
        p = parent[i - first]
        a, b, f = flux[i], flux[p], (less[i] - less[p])/rho[i]**2
        a.vx, a.vy = vx[i], vy[i]
        a.xx, a.xy, a.yx, a.yy, a.qx, a.qy = b.xx + f, b.xy, b.yx, b.yy + f, b.qx, b.qy
        image_flux(wall, a, rho[i])


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
def _rates(first, last, state, pull, rho, slopes, g, static, out):
    """Rates of velocity and energy, with force and work of the pressure that pair sums subtract."""
    for i in range(first, last):
        out[2, i], out[3, i], out[4, i] = pull[i, 0], pull[i, 1] - g, pull[i, 2] + pull[i, 4]
    if static.fraction != 0:
        for i in range(first, last):
            out[3, i] += g*static.fraction*static.rho0/rho[i]
            out[4, i] -= _static(static, g, state[1, i])/rho[i]*(slopes[i, 0] + slopes[i, 5])
