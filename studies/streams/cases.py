"""Methods, streams and rows of the study, and its runs, which give errors, numbers of steps and seconds.

Each method takes its own usual step. Errors and seconds are separate cases, since a timed run has the machine
to itself. The paper size takes an hour of CPU, twenty minutes of it alone on the machine.
"""
from collections.abc import Iterator
from dataclasses import dataclass
from functools import partial
from itertools import product
from math import ceil
from typing import Any, ClassVar, NamedTuple

import numpy as np

from continuum.fluid import Fields
from particles.run import Divergence, Plan, run
from studies.build import of_one_mass, variant
from studies.build.grid import Gridded
from studies.build.setting import Ready
from studies.build.spam import Variant
from studies.front.observed import seen
from studies.kit.case import Case, Report
from studies.kit.stats import with_errors
from studies.kit.table import Row
from studies.kit.timing import of_calls
from studies.streams import scenes
from studies.streams.scenes import Carried

STREAMS = (0.0, 0.1, 0.3, 1.0, 3.0, 10.0)
FEW = (0.0, 1.0, 10.0)      # streams of methods that cost much, or stay far from 1 %
QUICK = (0.0, 10.0)
SCENES: dict[str, type[Carried]] = {
    "vortex": scenes.DecayingVortex, "spot": scenes.Spot, "contact": scenes.Contact, "shear": scenes.Shear,
    "gresho": scenes.Gresho, "mixing": scenes.Mixing, "convection": scenes.Convection,
    "expansion": scenes.Expansion}
BRIEF = {"quick": 0.005, "paper": 0.05, "fine": 0.05}       # CPU seconds of steps timed together, about
ROWS, FAST = (16, 32, 64), (32, 64, 128, 192)
LAYER, FINER = (12, 16, 24, 32), (16, 24, 32, 48)           # of convection, for ninety free-fall times


class Rider(NamedTuple):
    """How a method takes part. rows : in streams below 1; fast : rows in others. price : CPU seconds of a
    point and step, about. quick : how many of its rows the quick size has."""
    rows: tuple[int, ...] = ROWS
    fast: tuple[int, ...] = FAST
    streams: tuple[float, ...] = STREAMS
    seeds: int = 1
    price: float = 1.5e-7
    quick: int = 0


MOVES = Rider(fast=ROWS, seeds=3, price=4e-7, quick=2)
DEAR = Rider((16, 24, 32), (16, 24, 32), FEW, price=6e-6)
RIDERS = {
    "grid": Rider(price=1e-7, quick=2), "fixed-lattice-h1.2": Rider(),
    "fixed-jittered-delaunay": Rider(fast=FAST[:3], seeds=3), "moving-delaunay": MOVES,
    "moving": DEAR, "spam": DEAR, "spam-less-static-50": DEAR}
#: methods in convection: lattices and closed faces refuse a lower plate that slides
LAYER_RIDERS = {
    "grid": Rider(LAYER, FINER, price=1.5e-7, quick=2),
    "fixed-jittered-plates": Rider(LAYER, LAYER, seeds=2, price=1.2e-6),
    "moving-delaunay": MOVES._replace(rows=LAYER, fast=LAYER, seeds=2, price=8e-7),
    "spam": DEAR._replace(rows=LAYER[:3], fast=LAYER[:3])}
LAYER_RIDERS["spam-less-static-50"] = LAYER_RIDERS["spam"]


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
        """Seconds, with 1 + |stream|/2 steps in a unit of time."""
        scene = self.scene
        steps = scene.time*(1 + float(np.abs(scene.wind).sum())/2)
        return 0.1 + self.price*scene.width*scene.L*steps

    @property
    def label(self) -> str:
        return (f"{type(self).__name__} {self.name}, {self.method}, {self.scene.L} rows, stream "
                f"{self.scene.stream:g}, seed {self.seed}")

    @property
    def columns(self) -> Row:
        return {"scene": self.name, "method": self.method, "rows": self.scene.L, "stream": self.scene.stream}

    def ready(self) -> Ready:
        """Smooth particles have one mass, and are placed by the scene's density."""
        alike = isinstance(self.variant, Variant)
        begun = dict(zip(("x", "fields"), of_one_mass(self.scene, self.seed))) if alike else {}
        return self.variant.ready(self.scene, self.seed, **begun)

    def steps(self, ready: Ready) -> int:
        """Number of steps to the end of the scene."""
        return ceil(self.scene.time/ready.dt)


class Error(Ride, table="runs"):
    """Errors at the end against the exact answer; nan where the run diverges."""

    def measure(self, report: Report) -> list[Row]:
        ready = self.ready()
        steps, begun = self.steps(ready), ready.method.fields(ready.start)
        try:
            ended = advanced(ready, self.scene.time/steps, steps, report)
            errors = self.scene.errors(begun, ended)
        except (Divergence, ArithmeticError):
            errors = dict.fromkeys(self.scene.errors(begun, begun), np.nan)
        common = {"seed": self.seed, "steps": steps}
        return [common | {"quantity": name, "error": error} for name, error in errors.items()]


class Seconds(Ride, table="seconds"):
    """CPU seconds of setting up and of a step. brief : seconds of all steps timed together, about."""
    alone: ClassVar[bool] = True
    brief: float

    @property
    def cost(self) -> float:
        return 0.1 + 10*self.brief

    def measure(self, report: Report) -> list[Row]:
        ready = self.ready()
        steps = min(self.steps(ready), max(8, int(self.brief/self.price/ready.start.shape[1])))
        run_some = partial(advanced, ready, ready.dt, steps)
        try:
            run_some()      # it may compile
            setup, some = of_calls(self.ready), of_calls(run_some)
        except (Divergence, ArithmeticError):
            return []
        return [with_errors(step_s=some*(1/steps), setup_s=setup)]


def advanced(ready: Ready, dt: float, steps: int, report: Report | None = None) -> Fields:
    """Fields so many steps later; the grid takes them in its own loop. Raises Divergence."""
    method, start = ready.method, ready.start
    if not isinstance(method, Gridded):
        return seen(method, run(method, start, Plan(dt=dt, steps=steps), report).by_id())
    return method.fields(method.go(start, dt, steps))


def cases(size: str) -> list[Case]:
    """Errors, with all seeds, and seconds; `quick` has two streams, and few rows of few methods."""
    return [case for name in SCENES for case in of_scene(size, name)]


def of_scene(size: str, name: str) -> Iterator[Ride]:
    """Runs of all methods, streams and rows in a scene."""
    riders, quick = LAYER_RIDERS if name == "convection" else RIDERS, size == "quick"
    for (method, rider), stream in product(riders.items(), QUICK if quick else STREAMS):
        rows = (rider.fast if stream >= 1 else rider.rows)[:rider.quick if quick else None]
        for L in rows if stream in rider.streams else ():
            common = {"name": name, "scene": SCENES[name](L=L, stream=stream), "method": method,
                      "variant": variant(method), "price": rider.price}
            for seed in range(1, 2 if quick else 1 + rider.seeds):
                yield Error(**common, seed=seed)
            yield Seconds(**common, brief=BRIEF[size])
