"""A hard case: one method in one scene until the run reaches its end or diverges, or the method refuses.

A new case needs a scene, a time and a `Question`; each method in it is one `Hard`.
"""
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import partial
from math import ceil
from pathlib import Path
from types import MappingProxyType
from typing import Any, ClassVar, NamedTuple

import numpy as np

from continuum.gas.fields import NodeFields, block, placed
from continuum.gas.solve import DivergedError, Solution
from continuum.gas.solve import run as march
from continuum.scene import Torus
from continuum.steady import Time
from particles.fields import Fields
from particles.plan import Quantity
from particles.run import Divergence, Plan, run
from studies.build import of_one_mass as places_of_one_mass
from studies.build.grid import GridForm, started
from studies.build.names import START_JITTER
from studies.build.scenes import Start, Tile
from studies.build.setting import Ready, positions
from studies.build.spam import Variant
from studies.kit.case import Case, Outcome, Report, word
from studies.kit.table import Row

SAMPLES = 60
GRID = "grid"
THIN = 1e-3         # density in place of vacuum, for methods whose points fill the box
Watch = tuple[tuple[str, Quantity], ...]


class Course(NamedTuple):
    """Record of a run. seen : what `look` gave at the start and each sample. reached : part of the time.
    watched : quantities at each sample, if the run reached its end."""
    seen: list
    reached: float = 1.0
    watched: Mapping[str, list[float]] = MappingProxyType({})


class Question(NamedTuple):
    """What is recorded and what follows: look(scene, method, state) is called at the start and after each
    sample, answer(scene, course) gives the columns. watch : quantities, which take sums and state."""
    look: Callable
    answer: Callable[[Any, Course], Row]
    samples: int = SAMPLES
    watch: Watch = ()


@dataclass(frozen=True, kw_only=True)
class Hard(Case):
    """A run that gives one row of the table `into`. which : the key columns of the row.

    entrant : has ready(scene, seed). step : over that of the entrant. time : in the units of the scene.
    """
    into: str
    which: Row
    entrant: Any
    scene: Any
    time: float
    question: Question
    seed: int = 1
    step: float = 1.0

    @property
    def cost(self) -> float:
        """Seconds, with about two steps in a unit of time, half a microsecond each for a point."""
        return 1 + 1e-6*self.scene.width*self.scene.L*self.time/self.step

    @property
    def label(self) -> str:
        return f"{self.into} {', '.join(map(word, self.which.values()))}"

    def run(self, report: Report, folder: Path) -> Outcome:
        try:
            ready = self.entrant.ready(self.scene, self.seed)
        except (ValueError, ArithmeticError) as error:
            return self.outcome(reached=0.0, refused=f"{type(error).__name__}: {str(error)[:60]}")
        look, answer, samples, watch = self.question
        ready = ready._replace(dt=self.step*ready.dt)
        course = followed(ready, self.time, samples, partial(look, self.scene), report, watch)
        return self.outcome(**answer(self.scene, course))

    def outcome(self, **values: Any) -> Outcome:
        """The row with these values."""
        return Outcome({self.into: [{**self.which, **values}]})


def followed(ready: Ready, time: float, samples: int, look: Callable, report: Report | None = None,
             watch: Watch = ()) -> Course:
    """Run any method; look(method, state) is recorded at the start and after each sample."""
    method, start = ready.method, ready.start
    seen = [look(method, start)]

    def see(sums: Any, state: np.ndarray) -> float:
        seen.append(look(method, state))
        return 0.0
    every = ceil(time/ready.dt/samples)
    steps = every*samples
    plan = Plan(dt=time/steps, steps=steps, series={"seen": see, **dict(watch)}, every=every)
    try:
        done = run(method, start, plan, report)
    except Divergence as error:
        return Course(seen, error.step/steps)
    return Course(seen, watched=done.series)


def between_plates(start: NodeFields, time: float, report: Report,
                   dt: float | None = None) -> tuple[Solution | None, float]:
    """Run the compressible grid: its solution, None if it diverged, and the part of the time reached."""
    reached, rows = [0.0], len(start.y) - 1

    def progress(done: float) -> None:
        reached.append(done)
        report(done)
    try:
        done = march(start.scene, rows, until=Time(time, SAMPLES), start=start, dt=dt, progress=progress)
    except DivergedError:
        return None, reached[-1]
    return done, 1.0


# --- how methods are set up ---------------------------------------------------------------------------------

@dataclass(frozen=True)
class Of:
    """A scene with the attributes of another scene, except those that it defines itself."""
    scene: Any

    def __getattr__(self, name: str) -> Any:
        return getattr(self.scene, name)


class Open(Of):
    """A scene without its plates: periodic along both axes."""
    sides: ClassVar[Torus] = Torus()


class Swift(Of):
    """A scene at rest, so hot that its sound is as fast as the largest |v| + c in the scene's run."""

    @property
    def T_hot(self) -> float:
        return float(self.scene.fastest)**2/(1 + 1/self.scene.eos.cv)

    def fields(self, x: np.ndarray) -> Start:
        one = np.ones(len(x))
        return one, np.zeros((len(x), 2)), self.T_hot*one


class By(NamedTuple):
    """A method with its own way to be set up: way(variant, scene, seed) -> Ready."""
    way: Callable[..., Ready]
    variant: Any

    def ready(self, scene: Any, seed: int = 1) -> Ready:
        """The method set up in a scene."""
        return self.way(self.variant, scene, seed)


def smooth(variant: Variant, scene: Any, seed: int) -> Ready:
    """Set up smooth particles at the same places for all seeds, away from plates, none where the gas is thin.
    The step is chosen at the start."""
    x = positions(scene.width, scene.L, START_JITTER, 1)
    ready = variant.ready(scene, x=x[scene.fields(x)[0] > THIN])
    return ready._replace(dt=variant.step*ready.limit)


def without_plates(variant: Any, scene: Any, seed: int) -> Ready:
    """Set a method up in a scene without its plates."""
    return variant.ready(Open(scene))   # type: ignore[no-any-return]


def tiled(form: GridForm, scene: Any, seed: int) -> Ready:
    """Set up the compressible grid without plates, and therefore without gravity."""
    box = Tile(width=scene.width, L=scene.L, eos=scene.eos, law=scene.law)
    start = placed(box, round(scene.L), partial(started, scene))
    return form.ready(box, first=block(start))


def hurried(variant: Any, scene: Any, seed: int, **places: Any) -> Ready:
    """Set a method up with its usual step, or with that for the fastest flow to come, if shorter."""
    made, swift = (variant.ready(one, seed, **places) for one in (scene, Swift(scene)))
    return made._replace(dt=min(made.dt, swift.dt))     # type: ignore[no-any-return]


def of_one_mass(variant: Variant, scene: Any, seed: int) -> Ready:
    """As `hurried`, for smooth particles of one mass, which are placed by the density of the scene."""
    x, _ = places_of_one_mass(scene, seed)
    return hurried(variant, scene, seed, x=x)


# --- what is recorded ---------------------------------------------------------------------------------------

def fate(reached: float) -> Row:
    """The part of the time that a method reached, which did not refuse."""
    return {"reached": reached, "refused": ""}


def copied(scene: Any, method: Any, state: np.ndarray) -> Fields:
    """Copies of all fields of a method."""
    at: Fields = method.fields(state)
    return at._make(map(np.copy, at))   # type: ignore[call-arg, arg-type]
