"""Which methods ride in which stream, with how many rows, and what a ride gives: errors, steps, seconds.

Each method takes its own usual step. Errors and seconds are cases of their own: what is timed never shares
the machine. The paper size takes about NN minutes of CPU.
"""
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from itertools import product
from math import ceil
from pathlib import Path
from time import process_time
from typing import Any, ClassVar, NamedTuple

import numpy as np

from continuum.fluid import Fields
from particles.run import Divergence, Plan, run
from studies.build import variant
from studies.build.grid import Gridded
from studies.build.setting import Ready
from studies.front.observed import seen
from studies.front.solving import prepared
from studies.kit.case import Case, Outcome, Report
from studies.kit.timing import SPREAD_TO_ERR, median_seconds
from studies.streams.scenes import Carried, DecayingVortex

STREAMS = (0.0, 0.1, 0.3, 1.0, 3.0, 10.0)
SCENES: dict[str, type[Carried]] = {"vortex": DecayingVortex}
WORK = 100_000      # points times steps that are timed


class Rider(NamedTuple):
    """A method: its rows, of a quick look, of the study, and more of these in fast streams; its seeds; the
    streams it rides in; CPU seconds of a point and step, for the estimate."""
    quick: tuple[int, ...]
    rows: tuple[int, ...]
    fast: tuple[int, ...]
    seeds: int = 1
    streams: tuple[float, ...] = STREAMS
    price: float = 4e-7


RIDERS = {
    "grid": Rider((12, 16, 24), (16, 32, 64), (32, 64, 128), price=2e-7),
    "fixed-lattice-h1.2": Rider((12, 16, 24), (16, 32, 64), (32, 64, 128)),
    "fixed-jittered-delaunay": Rider((12, 16, 24), (16, 32, 64), (32, 64, 128), seeds=3),
    "moving-delaunay": Rider((12, 16, 24), (16, 24, 32), (16, 24, 32), seeds=3),
    "moving": Rider((12,), (16, 24, 32), (16, 24, 32), streams=(0.0, 1.0, 10.0), price=6e-6),
    "spam": Rider((12,), (16, 24, 32), (16, 24, 32), streams=(0.0, 1.0, 10.0), price=3e-6),
    "spam-less-static-50": Rider((12,), (16, 24, 32), (16, 24, 32), streams=(0.0, 1.0, 10.0), price=3e-6),
}


@dataclass(frozen=True, kw_only=True)
class Ride(Case):
    """A method in a scene."""
    name: str
    scene: Any
    method: str
    variant: Any
    seed: int = 1
    price: float

    @property
    def cost(self) -> float:
        return 1 + self.price*self.scene.L**3*self.scene.time/self.scene.L

    @property
    def label(self) -> str:
        return (f"{type(self).__name__} {self.name}, {self.method}, {self.scene.L} rows, stream "
                f"{self.scene.stream:g}, seed {self.seed}")

    @property
    def key_columns(self) -> dict[str, Any]:
        """That every row has."""
        return {"scene": self.name, "method": self.method, "rows": self.scene.L, "stream": self.scene.stream}

    def ready(self) -> Ready:
        return prepared(self.scene, self.variant, self.seed)

    def steps(self, ready: Ready) -> int:
        """To the end of the scene."""
        return ceil(self.scene.time/ready.dt)


class Error(Ride):
    """How far from the exact answer it ends."""

    def run(self, report: Report, folder: Path) -> Outcome:
        ready = self.ready()
        steps, begun = self.steps(ready), ready.method.fields(ready.start)
        try:
            ended = advanced(ready, self.scene.time/steps, steps, report)
            errors = self.scene.errors(begun, ended)
        except (Divergence, ArithmeticError):
            errors = dict.fromkeys(self.scene.errors(begun, begun), np.nan)
        common = self.key_columns | {"seed": self.seed, "points": ready.start.shape[1], "steps": steps}
        return Outcome({"runs": [common | {"quantity": name, "error": error} for name, error in errors.items()]})


class Seconds(Ride):
    """CPU seconds of setting up, and of a step."""
    alone: ClassVar[bool] = True

    def run(self, report: Report, folder: Path) -> Outcome:
        ready = self.ready()
        steps = min(self.steps(ready), max(8, self.work//ready.start.shape[1]))
        try:
            setup, some = (median_seconds(f, clock=process_time)
                           for f in (self.ready, lambda: advanced(ready, ready.dt, steps)))
        except (Divergence, ArithmeticError):
            return Outcome({"seconds": []})
        return Outcome({"seconds": [self.key_columns | {
            "step_s": some.median/steps, "step_s_err": SPREAD_TO_ERR*some.spread/steps,
            "setup_s": setup.median, "setup_s_err": SPREAD_TO_ERR*setup.spread}]})


def advanced(ready: Ready, dt: float, steps: int, report: Report | None = None) -> Fields:
    """Fields so many steps later; the grid takes them in its own loop. Raises Divergence."""
    method, start = ready.method, ready.start
    if not isinstance(method, Gridded):
        return seen(method, run(method, start, Plan(dt=dt, steps=steps), report).by_id())
    return method.fields(method.go(method.block(start), dt, steps))


def cases(size: str) -> list[Case]:
    """Errors of all, then seconds."""
    return [*rides(Error, size), *rides(Seconds, size)]


def rides(kind: type[Ride], size: str) -> Iterator[Ride]:
    """All scenes, methods, streams, rows; errors with all seeds."""
    for (name, scene), (method, rider) in product(SCENES.items(), RIDERS.items()):
        for stream in rider.streams:
            rows = rider.quick if size == "quick" else rider.rows if stream < 1 else rider.fast
            seeds = rider.seeds if kind is Error and size != "quick" else 1
            for L, seed in product(rows, range(1, seeds + 1)):
                yield kind(name=name, scene=scene(L=L, stream=stream), method=method, variant=variant(method),
                           seed=seed, price=rider.price)
