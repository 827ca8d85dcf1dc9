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
from studies.streams import scenes
from studies.streams.scenes import Carried

STREAMS = (0.0, 0.1, 0.3, 1.0, 3.0, 10.0)
FEW = (0.0, 1.0, 10.0)      # of methods that cost much, or stay far from 1 %
SCENES: dict[str, type[scenes.Carried]] = {
    "vortex": scenes.DecayingVortex, "spot": scenes.Spot, "contact": scenes.Contact, "shear": scenes.Shear,
    "gresho": scenes.Gresho, "mixing": scenes.Mixing, "convection": scenes.Convection,
    "expansion": scenes.Expansion}
BRIEF = {"quick": 0.005, "paper": 0.05}     # CPU seconds of the steps that are timed, about
STILL, RISING, FAST = (16, 32, 64), (32, 64, 128), (32, 64, 128, 192)


class Rider(NamedTuple):
    """A method: its rows by stream, seeds, streams; CPU seconds of a point and step, about; is it quick?"""
    rows: tuple[int, ...] = STILL
    streams: tuple[float, ...] = STREAMS
    seeds: int = 1
    price: float = 4e-7
    quick: bool = False
    fast: tuple[tuple[int, ...], ...] = (RISING, FAST, FAST)

    def rows_in(self, stream: float) -> tuple[int, ...]:
        """More of them, the farther a stream carries a flow over points that stay."""
        return self.rows if stream < 1 or not self.fast else self.fast[STREAMS.index(stream) - 3]


MOVES = Rider(seeds=3, fast=(), quick=True)
DEAR = Rider((16, 24, 32), FEW, fast=(), price=6e-6)
RIDERS = {
    "grid": Rider(price=2e-7, quick=True), "fixed-lattice-h1.2": Rider(),
    "fixed-jittered-delaunay": Rider(seeds=3, fast=(RISING,)*3), "moving-delaunay": MOVES, "moving": DEAR,
    "spam": DEAR, "spam-less-static-50": DEAR}
#: lattices and closed faces refuse a lower plate that slides; a run lasts ninety free-fall times
LAYER, FINER = (12, 16, 24, 32), (16, 24, 32, 48)
LAYER_RIDERS = {
    "grid": Rider(LAYER, price=2e-7, quick=True, fast=(FINER,)*3),
    "fixed-jittered-plates": Rider(LAYER, fast=(), price=1e-6, seeds=2),
    "moving-delaunay": MOVES._replace(rows=LAYER, seeds=2),
    "spam": DEAR._replace(rows=(12, 16, 24)), "spam-less-static-50": DEAR._replace(rows=(12, 16, 24))}


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
        """Sound and stream pass a spacing in some three steps."""
        scene = self.scene
        steps = 2*scene.time*(2 + float(np.abs(scene.wind).sum()))
        return 0.1 + self.price*scene.width*scene.L*steps

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


@dataclass(frozen=True, kw_only=True)
class Seconds(Ride):
    """CPU seconds of setting up, and of a step; `brief` : of all steps that are timed at once, about."""
    alone: ClassVar[bool] = True
    brief: float

    @property
    def cost(self) -> float:
        return 0.1 + 10*self.brief

    def run(self, report: Report, folder: Path) -> Outcome:
        ready = self.ready()
        steps = min(self.steps(ready), max(8, int(self.brief/self.price/ready.start.shape[1])))
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
    """Errors, with all seeds, and seconds; `quick` has two streams, two numbers of rows, two methods."""
    return [case for ride in rides(size) for case in both(size, *ride)]


def rides(size: str) -> Iterator[tuple[str, Carried, str, Rider]]:
    """All scenes, methods, streams, rows, but what a method refuses."""
    for name, kind in SCENES.items():
        riders = LAYER_RIDERS if name == "convection" else RIDERS
        for (method, rider), stream in product(riders.items(), STREAMS):
            quick = size == "quick"
            if stream in rider.streams and (not quick or (rider.quick and stream in (0.0, 10.0))):
                rows = rider.rows_in(stream)
                yield from ((name, kind(L=L, stream=stream), method, rider) for L in rows[:2 if quick else None])


def both(size: str, name: str, scene: Carried, method: str, rider: Rider) -> Iterator[Ride]:
    """Errors and seconds of a method in a scene."""
    common = {"name": name, "scene": scene, "method": method, "variant": variant(method), "price": rider.price}
    for seed in range(1, 1 + (rider.seeds if size != "quick" else 1)):
        yield Error(**common, seed=seed)
    yield Seconds(**common, brief=BRIEF.get(size, BRIEF["paper"]))
