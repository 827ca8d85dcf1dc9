"""Sums of the compiled scheme on fixed points over long runs, in periodic boxes or between plates    [RR98 Eqs 34-38]"""
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from continuum.fluid import ConstEta, IdealGas
from particles.edges import NONE_BEYOND, Edges, between_plates
from particles.limits import limit_of
from particles.methods.layer import Layer
from particles.points import Points, of_positions
from particles.run import Divergence, Plan, run
from studies.integral.conservation_sums import ROUND_OFF, Watch, exact_sums, kinetic, parts, random_fields
from studies.integral.operators import Disorder
from studies.kit.case import Case, Outcome, Report

SIDE = 12               # spacings
OF_LIMIT = 0.5          # of the step to its limit
FROM_PLATE = 0.25       # of a spacing: irregular points come no nearer to a plate
EVERYTHING = "mass momentum energy"


class Mode(NamedTuple):
    """Transport of a run: eta = kappa, share along edges, whether its heating is mended, and the rms of the random start.

    Without friction a start of size s feeds short waves at rates of the order of s, which 10 000 steps are to leave small.
    """
    name: str
    eta: float = 0.1
    share: float = 1.0
    mended: bool = True
    size: float = 0.1


MODES = {mode.name: mode for mode in (Mode("pairwise"), Mode("unmended", mended=False), Mode("nested", share=0.0),
                                      Mode("ideal", eta=0.0, size=1e-4))}


class Wall(NamedTuple):
    """What is above and below: the box again, or plates at T = 1 under gravity."""
    name: str
    plates: bool = False
    g: float = 0.0


WALLS = {wall.name: wall for wall in (Wall("periodic"), Wall("plates", True), Wall("plates, gravity", True, 0.01))}


def around(disorder: Disorder, seed: int, plates: bool) -> Points:
    """SIDE^2 points in the box, away from plates."""
    at = disorder.make((SIDE, SIDE), disorder.size, seed)
    if not plates:
        return at
    edge = SIDE/2 - FROM_PLATE
    return of_positions(np.stack([at.x[:, 0], np.clip(at.x[:, 1], -edge, edge)], axis=1), at.box)


def in_parts(method: Any, state: np.ndarray, steps: int, watch: Watch, report: Report) -> tuple[np.ndarray, int]:
    """(state, steps done) of a run that is looked at now and then; it ends early if it diverges or heats too far."""
    dt = OF_LIMIT*limit_of(method, state)
    watch(state)
    for before, number in parts(steps):
        if dt > limit_of(method, state):        # it has heated: sound outruns the step
            return state, before
        try:
            state = run(method, state, Plan(dt=dt, steps=number)).state
        except Divergence as end:
            return state, before + end.step
        watch(state)
        report((before + number)/steps)
    return state, steps


@dataclass(frozen=True, kw_only=True)
class LayerDrift(Case):
    """A long run from a random start, on SIDE^2 points.

    make : of `particles.makers.MAKERS`. weight : class, its range h in spacings.
    """
    mode: Mode
    maker: str
    make: Callable[[Points, Any], Edges]
    weight: Any
    h: float
    disorder: Disorder
    wall: Wall = WALLS["periodic"]
    steps: int = 10_000
    seed: int = 1

    @property
    def cost(self) -> float:
        return self.steps*(2.4e-4 if self.mode.share < 1 else 1.3e-4)

    @property
    def label(self) -> str:
        return (f"layer {self.mode.name} {self.maker} {self.weight.__name__} h {self.h:g}, {self.disorder.name}, "
                f"{self.wall.name}, seed {self.seed}")

    def run(self, report: Report, folder: Path) -> Outcome:
        points = around(self.disorder, self.seed, self.wall.plates)
        try:
            method = self.method(points)
        except ArithmeticError:     # no such edges exist on these points
            return Outcome({})
        rho, v, T = random_fields(points, self.mode.size, self.seed, self.wall.plates)
        state = method.state(rho, v, T)
        watch, begin = self.watch(method, state), self.motion(method, state)
        state, reached = in_parts(method, state, self.steps, watch, report)
        return Outcome({"drift": [self._row(watch.worst, reached, self.motion(method, state)/begin)]})

    def method(self, points: Points) -> Layer:
        """The scheme; without plates there are no images."""
        weight, eta = self.weight.of(h=self.h), self.mode.eta
        edges, beyond = (between_plates(self.make, points.x, SIDE, SIDE, weight) if self.wall.plates
                         else (self.make(points, weight), NONE_BEYOND))
        return Layer(x=points.x, edges=edges, beyond=beyond, eos=IdealGas(), law=ConstEta(eta, eta), T_plates=(1.0, 1.0),
                     g=self.wall.g, mended=self.mode.mended, share=self.mode.share)

    def watch(self, method: Layer, state: np.ndarray) -> Watch:
        """Mass, momentum along both axes (between plates along them only), energy with that of height."""
        V, height = method.edges.V, self.wall.g*method.x[:, 1]
        kept = [0, 1, 3] if self.wall.plates else [0, 1, 2, 3]

        def totals(now: np.ndarray) -> np.ndarray:
            whole = now.copy()
            whole[3] += height*now[0]
            return exact_sums(V, whole[kept])
        mass, energy, momentum = V@state[0], V@state[3], V@np.hypot(*state[1:3])
        return Watch(totals, np.array([mass, momentum, momentum, energy])[kept])

    def motion(self, method: Layer, state: np.ndarray) -> float:
        """Kinetic energy."""
        return kinetic(method.edges.V*state[0], method.edges.V*state[1:3])

    @property
    def claimed(self) -> str:
        """Plates take momentum and heat; without friction none along themselves. Gravity works on no discrete mass flux."""
        return "mass" if self.wall.g or (self.wall.plates and self.mode.eta) else EVERYTHING

    def _row(self, worst: np.ndarray, reached: int, motion: float) -> dict[str, Any]:
        return {"scheme": "layer", "mode": self.mode.name, "d": 2, "maker": self.maker, "weight": self.weight.__name__,
                "h": self.h, "points": self.disorder.name, "wall": self.wall.name, "zeta": 0.0, "seed": self.seed,
                "n": SIDE**2, "steps": self.steps, "reached": reached, "claimed": self.claimed, "mass": worst[0],
                "momentum": worst[1:-1].max(), "energy": worst[-1], "volume": np.nan, "err": ROUND_OFF, "motion": motion}
