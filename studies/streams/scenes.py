"""Flows with exact answers, each in a stream that carries all of it along.

Lengths in spacings; the gas is ideal with C_V = 1, density and temperature about 1. Errors are relative, in
the frame of the stream.
"""
from dataclasses import dataclass
from math import sqrt
from typing import Any, ClassVar

import numpy as np

from continuum.exact.vortex import Vortex, solved, velocities
from continuum.fluid import ConstEta, Fields
from studies.build.scenes import Scene, Start
from studies.build.setting import shifted
from studies.build.names import START_JITTER

ALONG = np.array([2.0, 1.0])/sqrt(5)        # of the stream: at an angle to rows of points


@dataclass(frozen=True, kw_only=True)
class Carried(Scene):
    """A flow in a periodic box of L spacings; `stream` : over the speed of the flow, or of sound.

    A flow has `speed`, `law`, `time`, `begun(x)` and `ended(x)`: (rho, v, T) at rest at places (n, 2).
    """
    L: int
    stream: float = 0.0
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
        x = shifted(self.width, self.L, START_JITTER, seed)
        return x, self.fields(x)

    def errors(self, first: Fields, at: Fields) -> dict[str, float]:
        """By quantity, from fields at the start and at the end."""
        _, v, _ = self.ended(at.x - self.wind*self.time)
        return {"velocity": apart(at.V, at.v - self.wind - v, v)}


def apart(V: np.ndarray, wrong: np.ndarray, right: np.ndarray) -> float:
    """Rms of one field over that of another, (n,) or (n, 2), at points of volumes V."""
    return sqrt(np.sum(V*wrong.T**2)/np.sum(V*right.T**2))


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
        return one, self.speed*velocities(solved(self.mach), x/self.L), one
