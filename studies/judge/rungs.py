"""The rungs of the ladder: what each asks, in which scene, what it measures, its verdict and its rule."""
from collections.abc import Callable
from dataclasses import dataclass
from math import sqrt
from typing import Any, NamedTuple

import numpy as np

from continuum.fluid import ConstEta
from studies.build import SCENES
from studies.build.scenes import SOUND, Answer, Scene, Start, TaylorGreen
from studies.judge import measures
from studies.judge.contract import contract
from studies.judge.measures import Numbers, Taken, Verdict

CROSSINGS = 20.0        # of the box by sound: waves of the start have had time to grow
FRICTION = 0.001        # eta = k, in box lengths over the unit of time: about that of the vortex
WIND = 2.0              # times the fastest flow of the vortex


@dataclass(frozen=True, kw_only=True)
class Still(Scene):
    """A gas at rest in a periodic box of L spacings."""
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

    def answer(self, x: np.ndarray) -> Answer:
        vortex = super().answer(x - self.wind*self.time)
        return {name: vortex[name] + blow for name, blow in zip(("vx", "vy"), self.wind)}


class Rung(NamedTuple):
    """scene : of so many rows."""
    name: str
    asks: str
    scene: Callable[[int], Any]
    measure: Callable[[Any, Any], Numbers]
    verdict: Callable[[Any], Verdict]
    rule: str
    every: bool = False

    def judged(self, taken: Taken) -> Verdict:
        """Of all numbers of rows where every one is tried, else of the first alone."""
        return self.verdict(taken if self.every else taken[0][1])


def flow(name: str, asks: str) -> Rung:
    """A scene of `SCENES` with an exact answer."""
    return Rung(name, asks, SCENES[name], measures.error, measures.convergence,
                f"the order is the slope of log error over log rows; below {measures.LEAST} there is none",
                every=True)


vortex = SCENES["taylor-green"]         # of Mach number 0.05, Re 100
RUNGS = (
    Rung("contract", "Has it what a run asks for?", vortex, contract, measures.meets,
         "members and shapes of particles.method; fields(state(...)) gives back the fields"),
    Rung("rest", "Does a fluid at rest stay at rest?", lambda rows: Still(L=rows), measures.rest,
         measures.stays, f"rms speed below {measures.ROUNDING:g} of sound is rest, above {measures.NOISE:g} "
         f"motion; hotter by {measures.WARM:g} is heating"),
    Rung("conservation", "Are mass, momentum, energy kept?", vortex, measures.kept, measures.keeps,
         f"drift below {measures.ROUNDING:g} of mass, mass times speed, energy, in a periodic vortex"),
    Rung("frame", "Is a moving vortex as good as one at rest?", lambda rows: Carried(L=rows),
         measures.frames, measures.same_frames,
         f"errors are within {measures.ALIKE:.0%} in a wind of twice its speed"),
    Rung("repeat", "Does a seed give the same run twice?", vortex, measures.repeated, measures.repeats,
         "all bits of the state after 50 steps"),
    Rung("step", "Is the longest step what it claims?", vortex, measures.longest, measures.holds,
         f"a vortex gains less than {measures.FED - 1:.0%} of energy in {measures.TRIED} steps; the step is "
         "halved and doubled until it gains more"),
    flow("conduction", "Does heat spread right between plates?"),
    flow("couette", "Does shear settle right below a sliding plate?"),
    flow("taylor-green", "Does a vortex decay right?"),
    flow("sound", "Does sound travel right?"),
    Rung("rayleigh-benard", "Is K of convection right, at Ra 10 000?", SCENES["rayleigh-benard"],
         measures.convection, measures.right, "error of K against the grid's limit; right if below its own "
         f"error or {measures.RIGHT:.1%} with the two largest numbers of rows; not told if its own is above "
         f"{measures.LOOSE:.0%}", every=True),
)
