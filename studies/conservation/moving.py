"""Sums of the conservative scheme on moving points over long runs, as cases: RR98's moving volumes (Eqs 46-48) keep none"""
from collections.abc import Iterator
from dataclasses import dataclass
from itertools import product
from math import fsum
from pathlib import Path
from typing import Any

import numpy as np

from continuum.fluid import ConstEta, IdealGas
from particles.integral.closed_faces import EXCHANGED, Ingredients, Moving
from particles.walls.mirror import plates
from particles.walls.periodic import periodic
from particles.weights import WEIGHTS, WendlandC2
from studies.build.disorder import DISORDERS, Disorder
from studies.conservation.drift import MODES, WALLS, Wall, in_parts
from studies.conservation.layers import SIDE, around
from studies.conservation.sums import ROUND_OFF, Watch, kinetic, random_fields
from studies.kit.case import Case, Outcome, Report

H = 3.0


@dataclass(frozen=True, kw_only=True)
class MovingDrift(Case):
    """A long run from a random start, on SIDE^2 points that move."""
    name: str = "pairwise"
    ingredients: Ingredients = Ingredients()  # noqa: RUF009 (immutable)
    weight: Any = WendlandC2
    disorder: Disorder = DISORDERS["jittered-0.3"]
    wall: Wall = WALLS["periodic"]
    steps: int = 10_000
    seed: int = 1

    @property
    def cost(self) -> float:
        return 4e-4*self.steps

    @property
    def label(self) -> str:
        return f"moving {self.name} {self.weight.__name__}, {self.disorder.name}, {self.wall.name}, seed {self.seed}"

    def run(self, report: Report, folder: Path) -> Outcome:
        points, eta = around(self.disorder, self.seed, self.wall.plates), MODES["pairwise"].eta
        inside = plates(SIDE, 1.0, 1.0) if self.wall.plates else periodic(SIDE, 1)
        method = Moving(weight=self.weight.of(h=H), eos=IdealGas(), law=ConstEta(eta, eta), box=(SIDE, SIDE),
                        walls=(*inside, *periodic(SIDE)), ingredients=self.ingredients)
        rho, v, T = random_fields(points, MODES["pairwise"].size, self.seed, self.wall.plates)
        state = method.state(points.x, v, rho, T)
        watch, begin = self.watch(state), motion(state)
        state, reached = in_parts(method, state, self.steps, watch, report)
        return Outcome({"drift": [self._row(watch.worst, reached, motion(state)/begin)]})

    def watch(self, state: np.ndarray) -> Watch:
        """Mass, momentum along both axes (between plates along them only), energy, volume."""
        px, py, m, V, E = state[EXCHANGED]
        kept, momentum = [2, 0, 4, 3] if self.wall.plates else [2, 0, 1, 4, 3], np.hypot(px, py).sum()
        size = np.array([momentum, momentum, m.sum(), V.sum(), E.sum()])[kept]
        return Watch(lambda now: np.array([fsum(row) for row in now[EXCHANGED][kept]]), size)

    def _row(self, worst: np.ndarray, reached: int, moved: float) -> dict[str, Any]:
        claimed = "mass volume" if self.wall.plates else "mass momentum energy volume"
        return {"scheme": "moving", "mode": self.name, "d": 2, "maker": "faces", "weight": self.weight.__name__, "h": H,
                "points": self.disorder.name, "wall": self.wall.name, "zeta": 0.0, "seed": self.seed, "n": SIDE**2,
                "steps": self.steps, "reached": reached, "claimed": claimed, "mass": worst[0],
                "momentum": worst[1:-2].max(), "energy": worst[-2], "volume": worst[-1], "err": ROUND_OFF, "motion": moved}


def motion(state: np.ndarray) -> float:
    """Kinetic energy."""
    px, py, m, _, _ = state[EXCHANGED]
    return kinetic(m, np.stack([px, py]))


#: what is left out of the scheme
LESS = {"heating as printed": Ingredients(mended=False), "open faces": Ingredients(iterations=0),
        "whole pressure": Ingredients(static=False), "mass not spread": Ingredients(spread=0.0)}


def cases(kinds: tuple[str, ...]) -> Iterator[MovingDrift]:
    """Every start in a box and between plates, then every weight, then without an ingredient."""
    yield from (MovingDrift(disorder=DISORDERS[kind], wall=WALLS[wall]) for kind, wall in product(kinds, ("periodic", "plates")))
    yield from (MovingDrift(weight=weight) for weight in WEIGHTS.values())
    yield from (MovingDrift(name=name, ingredients=ingredients) for name, ingredients in LESS.items())
