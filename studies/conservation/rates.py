"""Sums of moving points over long runs, as cases: literal, convective, on volumes that go along, of constant mass    [RR98, III]

With the two steps of Eqs 40 and 41; edges are made again at every evaluation.
"""
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from continuum.fluid import ConstEta
from particles.integral.dih import Nested, Pairwise
from particles.integral.points import jittered
from particles.integrators import TwoStep
from particles.threads import Team
from studies.conservation.dih import in_place
from studies.conservation.drift import EVERYTHING, worst
from studies.conservation.motions.scene import moving
from studies.conservation.motions.sums import stirred
from studies.conservation.sums import Watch, kinetic
from studies.kit.case import Case, Outcome, Report

SIDE, H = 6, 2.7        # spacings
ETA, DT = 0.2, 0.05     # what forward Euler takes: the damping of sound allows steps of 0.15
TRANSPORTS = {"pairwise": Pairwise(), "unmended": Pairwise(mended=False), "nested": Nested()}
KEEP = ("literal", "constant-mass")


@dataclass(frozen=True, kw_only=True)
class MotionDrift(Case):
    """A long run of vortices and sound on a stream, SIDE^2 points that move.

    motion, kind : of `particles.integral.rr98_moving_plain.MOTIONS`. transport : of TRANSPORTS. jitter : of the first places, in spacings.
    """
    motion: str
    kind: type
    transport: str
    weight: Any
    jitter: float = 0.1
    steps: int = 10_000

    @property
    def cost(self) -> float:
        return 4e-4*self.steps

    @property
    def label(self) -> str:
        return f"motions {self.motion} {self.transport} {self.weight.__name__}, jitter {self.jitter:g}"

    def run(self, report: Report, folder: Path) -> Outcome:
        at = jittered((SIDE, SIDE), self.jitter, 1)
        method = moving(self.kind, at, self.weight.of(h=H), ConstEta(ETA, ETA), transport=TRANSPORTS[self.transport])
        state = method.state(at.x, *stirred(at))
        sums, begin = method.conserved(state), motion(method, state)
        momentum = sums[0]*np.sqrt((method.velocity(state)**2).sum(axis=0)).mean()
        watch = Watch(method.conserved, np.array([sums[0], momentum, momentum, sums[-1]]))
        reached = in_place(TwoStep(state.shape, Team(1)), method, state, DT, self.steps, watch, report)
        return Outcome({"drift": [{
            "scheme": "motions", "mode": f"{self.motion}, {self.transport}", "d": 2, "maker": "renormalised",
            "weight": self.weight.__name__, "h": H, "points": f"jittered-{self.jitter:g}" if self.jitter else "lattice",
            "wall": "periodic", "zeta": 0.0, "seed": 1, "n": at.n, "steps": self.steps, "reached": reached,
            "claimed": EVERYTHING if self.motion in KEEP else "nothing", **worst(watch),
            "motion": motion(method, state)/begin}]})


def motion(method: Any, state: np.ndarray) -> float:
    """Kinetic energy per mass, of points alike."""
    v = method.velocity(state)
    return kinetic(np.ones(v.shape[1]), v)
