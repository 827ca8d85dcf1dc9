"""A long run from a random start whose sums are watched, as a case: what fixed points, walls and motions share."""
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any, ClassVar, NamedTuple

import numpy as np

from particles.integral.edges import Edges
from particles.integral.points import Points
from particles.limits import limit_of
from particles.run import Divergence, Plan, run
from particles.starts import Overlap
from studies.build.disorder import Disorder
from studies.conservation.sums import ROUND_OFF, Watch, exact_sums, kinetic, parts, random_fields
from studies.kit.case import Case, Outcome, Report

OF_LIMIT = 0.5          # of the step to its limit
EVERYTHING = "mass momentum energy"


class Mode(NamedTuple):
    """Transport of a run: eta = kappa, share along edges, whether its heating is mended, the filter of the density, and the rms
    of the random start.

    Without friction a start of size s feeds short waves at rates of the order of s, which 10 000 steps are to leave small.
    """
    name: str
    eta: float = 0.1
    share: float = 1.0
    mended: bool = True
    size: float = 0.1
    chi: float = 0.0


MODES = {mode.name: mode for mode in (Mode("pairwise"), Mode("unmended", mended=False), Mode("nested", share=0.0),
                                      Mode("mixed", share=0.1), Mode("ideal", eta=0.0, size=1e-4))}
FILTERED = Mode("filtered", chi=0.1)


class Wall(NamedTuple):
    """What is above and below: the box again, or plates at T = 1 under gravity."""
    name: str
    plates: bool = False
    g: float = 0.0


WALLS = {wall.name: wall for wall in (Wall("periodic"), Wall("plates", True), Wall("plates, gravity", True, 0.01))}


@dataclass(frozen=True, kw_only=True)
class Drift(Case):
    """A run of one scheme on fixed points of unit spacing.

    make : of `particles.integral.edge_makers.MAKERS`. weight : class, its range h in spacings. claimed : the sums that should stay.
    """
    mode: Mode
    maker: str
    make: Callable[[Points, Any], Edges]
    weight: Any
    h: float
    disorder: Disorder
    wall: Any = WALLS["periodic"]
    steps: int = 10_000
    seed: int = 1
    scheme: ClassVar[str]

    @property
    def label(self) -> str:
        return (f"{self.scheme} {self.mode.name} {self.maker} {self.weight.__name__} h {self.h:g}, {self.disorder.name}, "
                f"{self.wall.name}, seed {self.seed}")

    @property
    def claimed(self) -> str:
        return EVERYTHING

    def points(self) -> Points:
        """Where the points are."""
        raise NotImplementedError

    def method(self, points: Points) -> Any:
        """The scheme on them; ArithmeticError where no such edges exist."""
        raise NotImplementedError

    def start(self, method: Any, points: Points) -> np.ndarray:
        """A random state."""
        return method.state(*random_fields(points, self.mode.size, self.seed))

    def totals(self, method: Any, state: np.ndarray) -> np.ndarray:
        """Mass, momentum along both axes, energy."""
        return exact_sums(method.edges.V, state[:4])

    def run(self, report: Report, folder: Path) -> Outcome:
        points = self.points()
        try:
            method = self.method(points)
        except ArithmeticError:     # no such edges exist on these points
            return Outcome({})
        state, V = self.start(method, points), method.edges.V
        watch = Watch(lambda now: self.totals(method, now), sizes(V, state[:4]))
        begin = kinetic(V*state[0], V*state[1:3])
        state, reached = in_parts(method, state, self.steps, watch, report)
        motion = kinetic(V*state[0], V*state[1:3])/begin
        return Outcome({"drift": [{
            "scheme": self.scheme, "mode": self.mode.name, "d": 2, "maker": self.maker, "weight": self.weight.__name__,
            "h": self.h, "points": self.disorder.name, "wall": self.wall.name, "zeta": 0.0, "seed": self.seed,
            "n": len(V), "steps": self.steps, "reached": reached, "claimed": self.claimed, **worst(watch), "motion": motion}]})


def sizes(V: np.ndarray, state: np.ndarray) -> np.ndarray:
    """Over which changes are told: mass, sum of |momentum| for each direction, energy."""
    momentum = V@np.sqrt((state[1:-1]**2).sum(axis=0))
    return np.array([V@state[0], *[momentum]*(len(state) - 2), V@state[-1]])


def worst(watch: Watch) -> dict[str, float]:
    """Largest changes of mass, momentum in any direction, energy."""
    found = watch.worst
    return {"mass": found[0], "momentum": found[1:-1].max(), "energy": found[-1], "volume": np.nan, "err": ROUND_OFF}


def in_parts(method: Any, state: np.ndarray, steps: int, watch: Watch, report: Report) -> tuple[np.ndarray, int]:
    """(state, steps done) of a run that is looked at now and then; it ends early if it diverges, heats too far or pairs."""
    dt = OF_LIMIT*limit_of(method, state)
    watch(state)
    for before, number in parts(steps):
        if dt > limit_of(method, state):        # it has heated: sound outruns the step
            return state, before
        try:
            state = run(method, state, Plan(dt=dt, steps=number)).state
        except Divergence as end:
            return state, before + end.step
        except Overlap:     # points have paired until they lie in one place
            if not before:
                raise
            return state, before
        watch(state)
        report((before + number)/steps)
    return state, steps
