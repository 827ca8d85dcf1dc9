"""Flows with exact answers, each in a stream that carries all of it along.

Lengths in spacings; the gas is ideal with C_V = 1, density and temperature about 1. Errors are relative, in
the frame of the stream.
"""
from dataclasses import dataclass
from functools import cache
from math import pi, sqrt
from typing import Any, ClassVar

import numpy as np
from scipy.ndimage import map_coordinates

from continuum.exact import periodic, vortex
from continuum.exact.shear import layer_with_wave, viscous_growth
from continuum.exact.vortex import Vortex, velocities
from continuum.fluid import ConstEta, Fields
from continuum.scene import RayleighBenard
from continuum.sides import HeatPath, Periodic, Sides, Sliding
from particles.fields import kinetic_energy
from studies.build.answers import FALLS
from studies.build.scenes import SOUND, Scene, Start
from studies.build.setting import shaken
from studies.front.observed import nusselt
from studies.kit.csvfile import read
from studies.kit.store import RESULTS

ALONG = np.array([2.0, 1.0])/sqrt(5)        # of the stream: at an angle to rows of points
MIDDLES = 256       # cells along each axis in which densities are summed


@dataclass(frozen=True, kw_only=True)
class Carried(Scene):
    """A flow in a periodic box of L spacings; `stream` : over the speed of the flow, or of sound.

    A flow has `speed`, `law`, `time`, `begun(x)` and `ended(x)`: (rho, v, T) at rest at places (n, 2).
    """
    L: int
    stream: float = 0.0
    quantities: ClassVar[tuple[str, ...]] = ("velocity",)
    speed: ClassVar[float]
    law: ClassVar[Any]
    time: ClassVar[float]

    @property
    def width(self) -> int:  # type: ignore[override]
        return self.L

    @property
    def wind(self) -> np.ndarray:
        """Velocity of the stream (2,)."""
        return self.stream*self.speed*ALONG

    def begun(self, x: np.ndarray) -> Start:
        raise NotImplementedError

    def ended(self, x: np.ndarray) -> Start:
        raise NotImplementedError

    def fields(self, x: np.ndarray) -> Start:
        rho, v, T = self.begun(x)
        return rho, v + self.wind, T

    def of_one_mass(self, seed: int) -> tuple[np.ndarray, Start]:
        x = as_dense(self, shaken(self, seed))
        return x, self.fields(x)

    def errors(self, first: Fields, at: Fields) -> dict[str, float]:
        """By quantity, from fields at the start and at the end: those of `quantities`."""
        rho, v, T = self.ended(at.x - self.wind*self.time)
        pairs = {"velocity": (at.v - self.wind - v, v), "temperature": (at.T - T, T - at.V@T/at.V.sum()),
                 "density": (at.rho - rho, rho - at.V@rho/at.V.sum())}
        return {name: apart(at.V, *pairs[name]) for name in self.quantities}


def apart(V: np.ndarray, wrong: np.ndarray, right: np.ndarray) -> float:
    """Rms of one field over that of another, (n,) or (n, 2), at points of volumes V."""
    return sqrt(np.sum(V*wrong.T**2)/np.sum(V*right.T**2))


def as_dense(scene: Carried, x: np.ndarray) -> np.ndarray:
    """Places (n, 2) of even density moved to that of the start: along x by its means, then each along y."""
    box, n = np.array([scene.width, scene.L]), MIDDLES
    axis = (np.arange(n) + 0.5)/n - 0.5
    rho = scene.begun(box*np.stack(np.meshgrid(axis, axis, indexing="ij"), axis=-1).reshape(-1, 2))[0]
    below = np.pad(np.cumsum(rho.reshape(n, n), axis=1), ((0, 0), (1, 0)))
    left = np.append(0, np.cumsum(below[:, -1]))
    ends, (a, b) = np.linspace(-0.5, 0.5, n + 1), (x/box + 0.5).T
    a = np.interp(a*left[-1], left, ends)
    columns = np.clip(((a + 0.5)*n).astype(int), 0, n - 1)
    b = [np.interp(part*below[i, -1], below[i], ends) for i, part in zip(columns, b)]
    return box*np.stack([a, b], axis=1)


@dataclass(frozen=True, kw_only=True)
class DecayingVortex(Carried):
    """Taylor and Green's, until velocities are a factor e smaller; Re 100."""
    mach: float = 0.05

    @property
    def vortex(self) -> Vortex:
        return Vortex(self.mach, self.L)

    @property
    def speed(self) -> float:  # type: ignore[override]
        return self.vortex.speed

    @property
    def law(self) -> ConstEta:  # type: ignore[override]
        return ConstEta(self.vortex.eta, self.vortex.eta)

    @property
    def time(self) -> float:  # type: ignore[override]
        return self.vortex.time

    def begun(self, x: np.ndarray) -> Start:
        rho = self.vortex.density(x)
        return rho, self.vortex.velocity(x), rho

    def ended(self, x: np.ndarray) -> Start:
        one = np.ones(len(x))
        return one, self.speed*velocities(vortex.solved(self.mach), x/self.L), one


class Smooth(Carried):
    """A flow that Fourier sums solve: its start over places in boxes; viscosity, conductivity, time of a box.

    points : of the sums along each axis, odd.
    """
    points: ClassVar[int] = 33
    eta: ClassVar[float]
    k: ClassVar[float]
    lasts: ClassVar[float]
    speed = SOUND

    @staticmethod
    def start(place: np.ndarray) -> Start:
        raise NotImplementedError

    @property
    def law(self) -> ConstEta:  # type: ignore[override]
        return ConstEta(self.eta*self.L, self.k*self.L)

    @property
    def time(self) -> float:  # type: ignore[override]
        return self.lasts*self.L

    def begun(self, x: np.ndarray) -> Start:
        return type(self).start(x/self.L)

    def ended(self, x: np.ndarray) -> Start:
        known = periodic.solved(type(self).start, self.eta, self.k, self.lasts, self.points)
        return periodic.fields(known, x/self.L)


def at_rest(rho: np.ndarray, T: Any) -> Start:
    """A gas at rest."""
    return rho, np.zeros((len(rho), 2)), T*np.ones(len(rho))


def periodic_bell(place: np.ndarray, width: float) -> np.ndarray:
    """exp(-r^2/(2 width^2)) near the middle of places (n, d), periodic."""
    return np.exp((np.cos(2*pi*place) - 1).sum(axis=1)/(2*pi*width)**2)


class Spot(Smooth):
    """Gas of even pressure, half as hot again in the middle: a third of the square of its width is added."""
    quantities = ("temperature",)
    eta = k = 0.005
    lasts = 1/SOUND

    @staticmethod
    def start(place: np.ndarray) -> Start:
        T = 1 + 0.5*periodic_bell(place, 0.1)
        return at_rest(1.0305/T, T)


class Contact(Smooth):
    """Gas of even pressure, in one half twice as dense as in the other; it conducts little."""
    quantities = ("density",)
    points = 49
    eta = k = 0.0005
    lasts = 1/SOUND

    @staticmethod
    def start(place: np.ndarray) -> Start:
        rho = 1 + np.tanh(np.sin(2*pi*place[:, 0])/0.5)/np.tanh(2)/3
        return at_rest(rho, 1/rho)


class Expansion(Smooth):
    """A slab of gas twice as dense as the mean, which expands to half of its density."""
    quantities = ("density", "velocity")
    eta = k = 0.01
    lasts = 0.25/SOUND

    @staticmethod
    def start(place: np.ndarray) -> Start:
        rho = np.exp(0.9*np.cos(2*pi*place[:, 0]))
        return at_rest(rho/1.2130, 1.0)


@dataclass(frozen=True, kw_only=True)
class Gresho(Carried):
    """A vortex whose pressure balances it at even density, after a turn of where it is fastest; Re 2000.

    Velocities 5 r, then 2 - 5 r from r = 0.2 to 0.4 boxes; incompressible but for the square of the Mach
    number, and for the friction's heat    [Gresho & Chan 1990]
    """
    mach: ClassVar[float] = 0.1
    speed = mach*SOUND
    lasts: ClassVar[float] = 0.4*pi/speed
    eta: ClassVar[float] = speed/2000

    @property
    def law(self) -> ConstEta:  # type: ignore[override]
        return ConstEta(self.eta*self.L, self.eta*self.L)

    @property
    def time(self) -> float:  # type: ignore[override]
        return self.lasts*self.L

    def begun(self, x: np.ndarray) -> Start:
        r = np.hypot(*x.T)/self.L
        outer = np.clip(r, 0.2, 0.4)
        P = 12.5*np.minimum(r, 0.2)**2 + 12.5*(outer**2 - 0.04) + 4*(1 - 5*outer + np.log(5*outer))
        P = 1 + self.speed**2*(P - 4*np.log(2) + 2)
        return np.ones(len(x)), self.speed*gresho(x/self.L), P

    def ended(self, x: np.ndarray) -> Start:
        v = [map_coordinates(part, (x/self.L + 0.5).T*FINE, mode="grid-wrap")
             for part in diffused(self.eta*self.lasts)]
        return np.ones(len(x)), self.speed*np.transpose(v), np.ones(len(x))

    def errors(self, first: Fields, at: Fields) -> dict[str, float]:
        own = at.x - self.wind*self.time
        x, m = own - self.L*np.rint(own/self.L), at.rho*at.V
        has, should = (m@(x[:, 0]*v[:, 1] - x[:, 1]*v[:, 0]) for v in (at.v - self.wind, self.ended(x)[1]))
        return {**super().errors(first, at), "spin": has/should - 1}


FINE = 512      # places along a box, of which 18 are as long as friction reaches


def gresho(place: np.ndarray) -> np.ndarray:
    """Velocities (n, 2) over the largest at places (n, 2)."""
    r = np.hypot(*place.T)
    swirl = np.maximum(np.minimum(5*r, 2 - 5*r), 0)/np.maximum(r, 1e-12)
    return np.stack([-swirl*place[:, 1], swirl*place[:, 0]], axis=1)


@cache
def diffused(spread: float) -> np.ndarray:
    """The same (2, FINE, FINE), u first, after friction for nu t = spread: what is round stays and diffuses."""
    axis = np.arange(FINE)/FINE - 0.5
    v = gresho(np.stack(np.meshgrid(axis, axis, indexing="ij"), axis=-1).reshape(-1, 2))
    k = 2*pi*FINE*np.fft.fftfreq(FINE)
    decay = np.exp(-spread*np.add.outer(k**2, k**2))
    return np.fft.ifft2(decay*np.fft.fft2(v.T.reshape(2, FINE, FINE))).real


@dataclass(frozen=True, kw_only=True)
class Shear(Carried):
    """u = U sin ky, k = 2 pi/L, Re 500, and its fastest wave, twice as long: how far it grows.

    Linear theory, exact but for squares of the Mach number and of the wave.
    """
    quantities = ("growth",)
    mach: ClassVar[float] = 0.05
    size: ClassVar[float] = 0.002
    speed = mach*SOUND

    @property
    def width(self) -> int:  # type: ignore[override]
        return 2*self.L

    @property
    def k(self) -> float:
        return 2*pi/self.L

    @property
    def law(self) -> ConstEta:  # type: ignore[override]
        return ConstEta(self.speed*self.L/500, self.speed*self.L/500)

    @property
    def time(self) -> float:  # type: ignore[override]
        return 8/(self.speed*self.k)

    def begun(self, x: np.ndarray) -> Start:
        return np.ones(len(x)), layer_with_wave(x, self.speed, self.k, self.size), np.ones(len(x))

    def errors(self, first: Fields, at: Fields) -> dict[str, float]:
        exact = viscous_growth(self.speed, self.k, self.k/2, self.law.eta, self.time)
        return {"growth": float(np.log(self.wave(at)/self.wave(first))/np.log(exact)) - 1}

    def wave(self, at: Fields) -> float:
        """Size of the part of v_y that goes as exp(ikx/2)."""
        v = at.v[:, 1] - self.wind[1]
        return float(abs(np.sum(at.V*v*np.exp(-0.5j*self.k*at.x[:, 0])))/at.V.sum())


class Mixing(Smooth):
    """A stripe of hotter gas at even pressure that vortices wind up: what is left of it, how much of that."""
    points = 57
    speed = 0.1*SOUND
    eta = speed/500
    k = speed/200
    lasts = 1.0/speed

    @staticmethod
    def start(place: np.ndarray) -> Start:
        flow = Vortex(0.1, 1)
        rho, stripe = flow.density(place), 1 + 0.1*np.cos(2*pi*place[:, 0])
        return rho/stripe, flow.velocity(place), rho*stripe

    def errors(self, first: Fields, at: Fields) -> dict[str, float]:
        rho, _, T = self.ended(at.x - self.wind*self.time)
        m = at.rho*at.V/(at.rho@at.V)
        has, should = (np.log(T/rho) - m@np.log(T/rho) for T, rho in ((at.T, at.rho), (T, rho)))
        return {"stripe": apart(at.V, has - should, should), "variance": m@has**2/(m@should**2) - 1}


@dataclass(frozen=True, kw_only=True)
class Convection(Carried):
    """Rayleigh and Benard's, Ra 10 000, between plates that slide with the stream, along x."""
    quantities = ("K", "Nu")
    width = property(lambda self: 2*self.L)

    @property
    def layer(self) -> RayleighBenard:
        return RayleighBenard(ra=RA, L=float(self.L))

    @property
    def wind(self) -> np.ndarray:
        return np.array([self.stream*self.speed, 0.0])

    @property
    def speed(self) -> float:  # type: ignore[override]
        """As the fastest of a vortex is, sqrt 2 times the rms one."""
        return 2*sqrt(limit("ke"))

    @property
    def sides(self) -> Sides:  # type: ignore[override]
        u = float(self.wind[0])
        return Sides(Periodic(), Periodic(), Sliding(u, T=self.layer.T_hot), Sliding(u, T=self.layer.T_cold))

    law = property(lambda self: self.layer.law)
    g = property(lambda self: self.layer.g)
    T_hot = property(lambda self: self.layer.T_hot)
    T_cold = property(lambda self: self.layer.T_cold)
    dT = property(lambda self: self.layer.dT)
    time = property(lambda self: FALLS*self.L/self.layer.free_fall)

    def begun(self, x: np.ndarray) -> Start:
        return self.layer.fields(x)

    def errors(self, first: Fields, at: Fields) -> dict[str, float]:
        own = at._replace(v=at.v - self.wind)
        K, Nu = kinetic_energy(own), nusselt(own, self.layer, HeatPath(1, self.dT, self.L))
        return {"K": K/limit("ke") - 1, "Nu": Nu/limit("nu") - 1}


RA = 1e4


@cache
def limit(column: str) -> float:
    """Of the grid of the study rb, extrapolated."""
    rows = read(RESULTS/"rb"/"means.csv").query(
        "method == 'compressible' and variant == 'flux-form' and eos == 'ideal' and transport == 'const-eta' "
        "and sides == 'periodic' and ra == @RA and pr == 1 and resolution == inf")
    return float(rows[column].iloc[0])
