"""Two periodic scenes that only a judge asks for: a gas at rest, and a vortex that a wind carries along."""
from dataclasses import dataclass
from math import sqrt

import numpy as np

from continuum.fluid import ConstEta
from studies.build.answers import answer
from studies.build.scenes import SOUND, Scene, Start, TaylorGreen

CROSSINGS = 20.0        # of the box by sound: waves of the start have had time to grow
FRICTION = 0.001        # eta = k, in box lengths over the unit of time: about that of the vortex
WIND = 2.0              # times the fastest flow of the vortex


@dataclass(frozen=True, kw_only=True)
class Still(Scene):
    """A gas at rest in a box of L spacings."""
    L: int

    @property
    def width(self) -> int:  # type: ignore[override]
        return self.L

    @property
    def law(self) -> ConstEta:
        return ConstEta(FRICTION*self.L, FRICTION*self.L)

    @property
    def time(self) -> float:
        return CROSSINGS*self.L/SOUND


@dataclass(frozen=True, kw_only=True)
class Carried(TaylorGreen):
    """The vortex in a frame that moves along both axes, at an angle to rows of points."""

    @property
    def wind(self) -> np.ndarray:
        """(2,)"""
        return WIND*self.speed*np.array([2.0, 1.0])/sqrt(5)

    def fields(self, x: np.ndarray) -> Start:
        rho, v, T = super().fields(x)
        return rho, v + self.wind, T


@answer.register
def _(scene: Carried, x: np.ndarray) -> dict[str, np.ndarray]:
    vortex = answer.dispatch(TaylorGreen)(scene, x - scene.wind*scene.time)
    return {name: vortex[name] + blow for name, blow in zip(("vx", "vy"), scene.wind)}
