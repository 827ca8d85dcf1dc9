"""The ladder of tests: question, scene, measure, verdict and rule of each rung; and how a method climbs it.

An error that a method raises becomes a verdict, too. A climb takes some minutes.
"""
import inspect
import sys
import traceback
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from math import sqrt
from pathlib import Path
from time import monotonic
from typing import Any, NamedTuple

import numpy as np

from continuum.fluid import ConstEta
from particles.run import Divergence
from studies.build import SCENES, duration
from studies.build.scenes import SOUND, Answer, Start, TaylorGreen, Tile
from studies.judge import measures
from studies.judge.contract import contract
from studies.judge.measures import Numbers, Verdict

LEFT_OUT = "left out:"
CROSSINGS = 20.0        # length of a run, in sound's crossings of the box: initial waves have time to grow
FRICTION = 0.001        # eta/L = k/L: about that of the vortex
WIND = 2.0              # speed of the wind over the largest speed of the vortex


@dataclass(frozen=True, kw_only=True)
class Still(Tile):
    """A gas at rest in a periodic box."""

    @property
    def time(self) -> float:
        return CROSSINGS*self.L/SOUND


def still(rows: int) -> Still:
    return Still(width=rows, L=rows, law=ConstEta(FRICTION*rows, FRICTION*rows))


@dataclass(frozen=True, kw_only=True)
class Carried(TaylorGreen):
    """The vortex in a uniform wind along both axes, at an angle to rows of points."""

    @property
    def wind(self) -> np.ndarray:
        """Velocity, (2,)."""
        return WIND*self.speed*np.array([2.0, 1.0])/sqrt(5)

    def fields(self, x: np.ndarray) -> Start:
        rho, v, T = super().fields(x)
        return rho, v + self.wind, T

    def answer(self, x: np.ndarray) -> Answer:
        vortex = super().answer(x - self.wind*self.time)
        return {name: vortex[name] + blow for name, blow in zip(("vx", "vy"), self.wind)}


class Rung(NamedTuple):
    """A test. scene : makes it for a number of rows. every : tried with all numbers of rows, of which the
    verdict is, else of the first alone."""
    name: str
    asks: str
    scene: Callable[[int], Any]
    measure: Callable[[Any, Any], Numbers]
    verdict: Callable[[Any], Verdict]
    rule: str
    every: bool = False


def flow(name: str, asks: str) -> Rung:
    """A rung from a scene of `SCENES` with an exact answer."""
    return Rung(name, asks, SCENES[name], measures.error, measures.convergence,
                f"the order is the slope of log error over log rows; below {measures.LEAST} there is none",
                every=True)


vortex = SCENES["taylor-green"]         # Mach number 0.05, Re 100
RUNGS = (
    Rung("contract", "Has it what a run asks for?", vortex, contract, measures.meets,
         "members and shapes of particles.method; fields(state(...)) gives back the fields"),
    Rung("rest", "Does a fluid at rest stay at rest?", still, measures.rest,
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

# --- climbing -------------------------------------------------------------------------------------


class Take(NamedTuple):
    """Result of a rung at a number of rows: numbers, or the fault that left none."""
    rung: str
    rows: int
    numbers: Numbers
    seconds: float
    fault: str = ""


def climb(method: Any, rows: Sequence[int], minutes: float) -> list[Take]:
    """Try a method on all rungs, from few rows to many; runs that would exceed ``minutes`` are left out."""
    end, takes = monotonic() + 60*minutes, list[Take]()
    places = [(rung, count) for rung in RUNGS for count in (rows if rung.every else rows[:1])]
    works = [work(*place) for place in places]
    for number, place in enumerate(places, 1):
        take = taken(method, *place, end - monotonic(), takes)
        takes.append(take)
        # the first runs compile: the fastest one shows the time of a run alone
        paces = [one.seconds/size for one, size in zip(takes, works) if one.numbers]
        left = f"; about {min(paces)*sum(works[number:]):.0f} s left" if len(paces) > 1 else ""
        print(f"[{number}/{len(places)}] {take.rung}, {take.rows} rows: "
              f"{take.fault or f'{take.seconds:.1f} s'}{left}", file=sys.stderr)
    return takes


def taken(method: Any, rung: Rung, rows: int, left: float, before: list[Take]) -> Take:
    """Try a rung; left out if it needs more than the ``left`` seconds."""
    # estimated from the same rung with fewer rows; 0 for the first, of which nothing is known
    same = [take for take in before if take.rung == rung.name and take.numbers]
    needed = same[-1].seconds*work(rung, rows)/work(rung, same[-1].rows) if same else 0.0
    if needed > left:
        return Take(rung.name, rows, {}, 0.0,
                    f"{LEFT_OUT} it takes some {needed/60:.0f} minutes; --minutes gives more")
    began = monotonic()
    try:
        with np.errstate(all="ignore"):
            numbers, fault = rung.measure(rung.scene(rows), method), ""
    except Exception as error:      # any error of a user's method becomes its verdict
        numbers, fault = {}, told(error, method)
    return Take(rung.name, rows, numbers, monotonic() - began, fault)


def told(error: Exception, method: Any) -> str:
    """One line: the error, and where in the method's own file it was raised."""
    words = str(error).strip().split("\n")[0]
    if isinstance(error, Divergence):
        return words
    own = inspect.getfile(method) if isinstance(method, type) else ""
    lines = [frame.lineno for frame in traceback.extract_tb(error.__traceback__) if frame.filename == own]
    place = f" (line {lines[-1]} of {Path(own).name})" if lines else ""
    return f"{type(error).__name__}: {words}{place}"


def work(rung: Rung, rows: int) -> float:
    """Points times the length of the run, to which run time is proportional."""
    scene = rung.scene(rows)
    usual, unit = duration(scene)
    return float(scene.width*scene.L*usual*unit)


def judged(rung: Rung, takes: Sequence[Take]) -> Verdict:
    """Verdict of a rung: its first fault, and the verdict on runs without faults."""
    mine = [take for take in takes if take.rung == rung.name]
    faults = [f"{take.fault} ({take.rows} rows)" if rung.every else take.fault for take in mine if take.fault]
    taken = [(take.rows, take.numbers) for take in mine if not take.fault]
    verdict = rung.verdict(taken if rung.every else taken[0][1]) if taken else Verdict("", None)
    if not faults:
        return verdict
    wrong = not all(fault.startswith(LEFT_OUT) for fault in faults)
    words = (faults[0], verdict.words) if wrong else (verdict.words, faults[0])
    return Verdict("; ".join(filter(None, words)), False if wrong else verdict.good)


def verdicts(takes: Sequence[Take]) -> list[tuple[Rung, Verdict]]:
    """Verdicts of all rungs, first one of instability at any step; equal ones refer to the first of them."""
    pairs = [(rung, judged(rung, takes)) for rung in RUNGS]
    pairs.sort(key=lambda pair: "unstable at any step" not in pair[1].words)
    first: dict[str, str] = {}
    return [(rung, Verdict(verdict.words if first.setdefault(verdict.words, rung.name) == rung.name
                           else f"the same as {first[verdict.words]}", verdict.good))
            for rung, verdict in pairs]
