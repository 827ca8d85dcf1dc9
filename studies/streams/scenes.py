"""Flows with exact answers, each in a stream that carries all of it along.

Flows are described in a box of height 1. The gas is ideal, C_V = 1, density and temperature are about 1.
Errors are relative and in the frame of the stream.
"""
from dataclasses import dataclass
from math import pi, sqrt
from operator import attrgetter
from typing import Any, ClassVar

import numpy as np

from continuum.exact import gresho, periodic
from continuum.exact.shear import layer_with_wave, viscous_growth
from continuum.exact.vortex import Vortex
from continuum.fluid import ConstEta, Fields
from continuum.scene import RayleighBenard
from continuum.sides import HeatPath, Periodic, Sides, Sliding
from particles.fields import kinetic_energy
from studies.build import FALLS
from studies.build.measure import RA, limit
from studies.build.scenes import SOUND, Scene, Start
from studies.build.setting import shaken
from studies.front.observed import nusselt

ALONG = np.array([2.0, 1.0])/sqrt(5)        # direction of the stream: at an angle to rows of points
CELLS = 256         # along each axis, in which densities are summed


@dataclass(frozen=True, kw_only=True)
class Carried(Scene):
    """A flow in a periodic box of L spacings. stream : its speed over `speed`, that of the flow or of sound.

    In a box of height 1: viscosity eta, conductivity k, duration `lasts`, start(place) -> (rho, v, T) at
    places (n, 2). The exact end is from Fourier sums with so many `points` along each axis.
    """
    L: int
    stream: float = 0.0
    speed: ClassVar[float] = SOUND
    eta: ClassVar[float]
    k: ClassVar[float]
    lasts: ClassVar[float]
    start: ClassVar[Any]
    quantities: ClassVar[tuple[str, ...]] = ("velocity",)
    points: ClassVar[int] = 33
    width: ClassVar[Any] = property(lambda self: self.L)    # type: ignore[misc]

    @classmethod
    def end(cls, place: np.ndarray) -> Start:
        """Exact (rho, v, T) at the end, without stream."""
        return periodic.fields(periodic.solved(cls.start, cls.eta, cls.k, cls.lasts, cls.points), place)

    #: velocity of the stream (2,)
    wind: ClassVar[Any] = property(lambda self: self.stream*self.speed*ALONG)
    law: ClassVar[Any] = property(lambda self: ConstEta(self.eta*self.L, self.k*self.L))
    time: ClassVar[Any] = property(lambda self: self.lasts*self.L)

    def fields(self, x: np.ndarray) -> Start:
        rho, v, T = self.start(x/self.L)
        return rho, v + self.wind, T

    def of_one_mass(self, seed: int) -> tuple[np.ndarray, Start]:
        x = as_dense(self, shaken(self, seed))
        return x, self.fields(x)

    def own(self, at: Fields) -> np.ndarray:
        """Places at the end in the frame of the stream, in heights of the box."""
        return (at.x - self.wind*self.time)/self.L

    def errors(self, first: Fields, at: Fields) -> dict[str, float]:
        """Errors of `quantities`, from fields at the start and at the end."""
        rho, v, T = self.end(self.own(at))
        pairs = {"velocity": (at.v - self.wind - v, v), "temperature": (at.T - T, T - at.V@T/at.V.sum()),
                 "density": (at.rho - rho, rho - at.V@rho/at.V.sum())}
        return {name: apart(at.V, *pairs[name]) for name in self.quantities}


def apart(V: np.ndarray, wrong: np.ndarray, right: np.ndarray) -> float:
    """Rms of one field over that of another, (n,) or (n, 2), at points of volumes V."""
    return sqrt(np.sum(V*wrong.T**2)/np.sum(V*right.T**2))


def as_dense(scene: Carried, x: np.ndarray) -> np.ndarray:
    """Move places (n, 2) from uniform density to that of the start: along x by means over y, then along y."""
    box, ends = np.array([scene.width, scene.L]), np.linspace(-0.5, 0.5, CELLS + 1)
    axis = ends[:-1] + 0.5/CELLS
    rho, *_ = scene.fields(box*np.stack(np.meshgrid(axis, axis, indexing="ij"), axis=-1).reshape(-1, 2))
    below = np.pad(np.cumsum(rho.reshape(CELLS, CELLS), axis=1), ((0, 0), (1, 0)))
    left = np.append(0, np.cumsum(below[:, -1]))
    shares = x/box + 0.5
    a = np.interp(shares[:, 0]*left[-1], left, ends)
    columns = np.clip(((a + 0.5)*CELLS).astype(int), 0, CELLS - 1)
    b = [np.interp(share*below[i, -1], below[i], ends) for i, share in zip(columns, shares[:, 1])]
    return box*np.stack([a, b], axis=1)


class DecayingVortex(Carried):
    """Taylor-Green vortex, Mach number 0.05, Re 100, until velocities are smaller by a factor e."""
    flow = Vortex(0.05, 1)
    speed, lasts = flow.speed, flow.time
    eta = k = flow.eta

    @staticmethod
    def start(place: np.ndarray) -> Start:
        rho = DecayingVortex.flow.density(place)
        return rho, DecayingVortex.flow.velocity(place), rho


class Spot(Carried):
    """Spot of hot gas, T about 1.5, at uniform pressure: conduction adds 28 % to its squared width."""
    quantities = ("temperature",)
    eta = k = 0.004
    lasts = 1/SOUND

    @staticmethod
    def start(place: np.ndarray) -> Start:
        T = 1 + 0.5*np.exp((np.cos(2*pi*place) - 1).sum(axis=1)/(0.2*pi)**2)
        return 1.0305/T, np.zeros(place.shape), T


class Contact(Carried):
    """Gas at uniform pressure, twice as dense in one half as in the other, with little conduction."""
    quantities = ("density",)
    points = 49
    eta = k = 0.0005
    lasts = 1/SOUND

    @staticmethod
    def start(place: np.ndarray) -> Start:
        rho = 1 + np.tanh(2*np.sin(2*pi*place[:, 0]))/np.tanh(2)/3
        return rho, np.zeros(place.shape), 1/rho


class Expansion(Carried):
    """A slab of gas with twice the mean density, which expands to half of that density."""
    quantities = ("density", "velocity")
    eta = k = 0.01
    lasts = 0.25/SOUND

    @staticmethod
    def start(place: np.ndarray) -> Start:
        rho = np.exp(0.9*np.cos(2*pi*place[:, 0]))/1.2130
        return rho, np.zeros(place.shape), np.ones(len(rho))


class Mixing(Carried):
    """A stripe of hotter gas, at the pressure of vortices that wind it up."""
    points = 57
    flow = Vortex(0.1, 1)
    speed, lasts = flow.speed, 1/flow.speed
    eta, k = flow.speed/500, flow.speed/200

    @staticmethod
    def start(place: np.ndarray) -> Start:
        rho, stripe = Mixing.flow.density(place), 1 + 0.1*np.cos(2*pi*place[:, 0])
        return rho/stripe, Mixing.flow.velocity(place), rho*stripe

    def errors(self, first: Fields, at: Fields) -> dict[str, float]:
        """Errors of the entropy less its mean, and of the variance of entropy."""
        rho, _, T = self.end(self.own(at))
        m = at.rho*at.V/(at.rho@at.V)
        has, should = (s - m@s for s in (np.log(at.T/at.rho), np.log(T/rho)))
        return {"stripe": apart(at.V, has - should, should), "variance": m@has**2/(m@should**2) - 1}


class Gresho(Carried):
    """Vortex of uniform density balanced by its pressure, Re 2000, for one turn where it is fastest."""
    speed = 0.1*SOUND
    eta = k = speed/2000
    lasts = 0.4*pi/speed

    @staticmethod
    def start(place: np.ndarray) -> Start:
        U, one = Gresho.speed, np.ones(len(place))
        return one, U*gresho.velocity(place), 1 + U**2*gresho.pressure(place)

    @classmethod
    def end(cls, place: np.ndarray) -> Start:
        v = cls.speed*gresho.velocity_at(cls.eta*cls.lasts, place)
        return np.ones(len(v)), v, np.ones(len(v))

    def errors(self, first: Fields, at: Fields) -> dict[str, float]:
        """Errors of `quantities`, and of the angular momentum."""
        own, m = self.own(at), at.rho*at.V
        x, y = (own - np.rint(own)).T
        has, should = (m@(x*v[:, 1] - y*v[:, 0]) for v in (at.v - self.wind, self.end(own)[1]))
        return {**super().errors(first, at), "spin": has/should - 1}


class Shear(Carried):
    """Shear flow u = U sin ky, Mach number 0.05, Re 500, and its fastest growing wave, twice as long.
    Linear theory of the growth is exact but for squares of the Mach number and of the wave."""
    speed = 0.05*SOUND
    eta = k = speed/500
    lasts = 8/(2*pi*speed)
    width = property(lambda self: 2*self.L)     # type: ignore[misc]

    @staticmethod
    def start(place: np.ndarray) -> Start:
        v = layer_with_wave(place, Shear.speed, 2*pi, 0.002)
        return np.ones(len(v)), v, np.ones(len(v))

    def errors(self, first: Fields, at: Fields) -> dict[str, float]:
        """Errors of the growth rate, and of the complex amplitude of the wave."""
        exact = viscous_growth(self.speed, 2*pi, pi, self.eta, self.lasts)
        ratio = self.wave(at, self.time)/self.wave(first, 0.0)
        return {"growth": float(np.log(abs(ratio))/np.log(exact)) - 1, "wave": float(abs(ratio/exact - 1))}

    def wave(self, at: Fields, time: float) -> complex:
        """Complex amplitude of exp(i pi x/L) in v_y, in the frame of the stream."""
        x, v = (at.x - self.wind*time)[:, 0], at.v[:, 1] - self.wind[1]
        return complex(at.V@(v*np.exp(-1j*pi*x/self.L))/at.V.sum())


class Convection(Carried):
    """Rayleigh-Benard convection between plates that slide with the stream. `speed` is sqrt 2 times the rms
    velocity, as the largest velocity of a vortex is."""
    layer: ClassVar[Any] = property(lambda self: RayleighBenard(ra=RA, L=float(self.L)))
    speed: ClassVar[Any] = property(lambda self: 2*sqrt(limit("ke")))
    wind: ClassVar[Any] = property(lambda self: np.array([self.stream*self.speed, 0.0]))
    time = property(lambda self: FALLS*self.L/self.layer.free_fall)
    width, law, g, dT, T_hot, T_cold = (  # type: ignore
        property(attrgetter(f"layer.{name}")) for name in ("width", "law", "g", "dT", "T_hot", "T_cold"))

    @property
    def sides(self) -> Sides:  # type: ignore[override]
        u = float(self.wind[0])
        return Sides(Periodic(), Periodic(), Sliding(u, T=self.T_hot), Sliding(u, T=self.T_cold))

    def fields(self, x: np.ndarray) -> Start:
        rho, v, T = self.layer.fields(x)
        return rho, v + self.wind, T

    def errors(self, first: Fields, at: Fields) -> dict[str, float]:
        own, heat = at._replace(v=at.v - self.wind), HeatPath(1, self.dT, self.L)
        return {"K": kinetic_energy(own)/limit("ke") - 1,
                "Nu": nusselt(own, self.layer, heat)/limit("nu") - 1}
