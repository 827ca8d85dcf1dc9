"""The rungs of the ladder: what each asks, in which scene, what it measures, its verdict and its rule."""
from collections.abc import Callable
from typing import Any, NamedTuple

from studies.build.named import SCENES
from studies.build.scenes import TaylorGreen
from studies.judge import verdicts
from studies.judge.contract import contract
from studies.judge.measures import Numbers, convection, error, frames, kept, longest, repeated, rest
from studies.judge.scenes import Carried, Still
from studies.judge.verdicts import Verdict


class Rung(NamedTuple):
    """scene : of so many rows. every : at all numbers of rows, not the first alone."""
    name: str
    asks: str
    scene: Callable[[int], Any]
    measure: Callable[[Any, Any], Numbers]
    verdict: Callable[[list[tuple[int, Numbers]]], Verdict]
    rule: str
    every: bool = False


def vortex(rows: int) -> TaylorGreen:
    """Of Mach number 0.05, Re 100."""
    return TaylorGreen(L=rows)


def flow(name: str, asks: str) -> Rung:
    """A scene of `SCENES` with an exact answer."""
    return Rung(name, asks, SCENES[name], error, verdicts.convergence,
                f"the order is the slope of log error over log rows; below {verdicts.LEAST} there is none",
                every=True)


RUNGS = (
    Rung("contract", "Has it what a run asks for?", vortex, contract, verdicts.meets,
         "members and shapes of particles.method; fields(state(...)) gives back the fields"),
    Rung("rest", "Does a fluid at rest stay at rest?", lambda rows: Still(L=rows), rest, verdicts.stays,
         f"rms speed below {verdicts.ROUNDING:g} of sound is rest, above {verdicts.NOISE:g} motion; hotter "
         f"by {verdicts.WARM:g} is heating"),
    Rung("conservation", "Are mass, momentum, energy kept?", vortex, kept, verdicts.keeps,
         f"drift below {verdicts.ROUNDING:g} of mass, mass times speed, energy, in a periodic vortex"),
    Rung("frame", "Is a moving vortex as good as one at rest?", lambda rows: Carried(L=rows), frames,
         verdicts.same_frames, f"errors are within {verdicts.ALIKE:.0%} in a wind of twice its speed"),
    Rung("repeat", "Does a seed give the same run twice?", vortex, repeated, verdicts.repeats,
         "all bits of the state after 50 steps"),
    Rung("step", "Is the longest step what it claims?", vortex, longest, verdicts.holds,
         "a vortex gains no energy in 300 steps; the step is halved and doubled until it does"),
    flow("conduction", "Does heat spread right between plates?"),
    flow("couette", "Does shear settle right below a sliding plate?"),
    flow("taylor-green", "Does a vortex decay right?"),
    flow("sound", "Does sound travel right?"),
    Rung("rayleigh-benard", "Is K of convection right, at Ra 10 000?", SCENES["rayleigh-benard"], convection,
         verdicts.energy, "error of K against the grid's limit; right if below its own error or "
         f"{verdicts.RIGHT:.1%} with the two largest numbers of rows", every=True),
)
