"""One call for every method: particles, points, grids, py-pde, Boussinesq, linear theory."""
import sys
from dataclasses import replace
from math import ceil
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import pandas as pd
from tqdm import tqdm

from continuum.fluid import Fields
from particles.integral.points import lattice
from particles.run import Plan, run
from studies.build import METHODS, near, ready
from studies.build.answers import duration, of_one_mass, rows_of, with_rows
from studies.build.moving import FacesMotion
from studies.build.named import SCENES
from studies.build.rr98_moving import DriftMotion
from studies.build.scenes import Sound
from studies.build.setting import Ready
from studies.build.spam import Variant
from studies.front.observed import numbers, recorded, seen
from studies.front.references import REFERENCES
from studies.front.solution import Solution

SAMPLES = 400       # of a history
#: name -> what solves a scene
ALL: dict[str, Any] = {**METHODS, **REFERENCES}


class How(NamedTuple):
    """How a run in time is made.

    time : its length in the scene's unit: free-fall times of convection, viscous times of a box. dt : its
    step, if not the method's own. resume : a file that an interrupted run goes on from. progress : a bar; by
    default where one looks.
    """
    seed: int = 1
    time: float | None = None
    dt: float | None = None
    resume: str | Path | None = None
    progress: bool | None = None

    @property
    def silent(self) -> bool:
        """Whether there is no bar."""
        return not (sys.stderr.isatty() if self.progress is None else self.progress)


def solve(scene: Any, method: Any, *, rows: int | None = None, seed: int = 1, time: float | None = None,
          dt: float | None = None, resume: str | Path | None = None, progress: bool | None = None,
          **of_scene: Any) -> Solution:
    """A scene solved by a method.

    scene : a name of `SCENES`, which takes its numbers besides, such as ra=1e4; or an object. method : a name
    of `ALL`, a variant or a method of one's own, or a class that takes the scene. rows : points or cells over
    the height. seed, time, dt, resume, progress : as of `How`.
    Raises ValueError: there is no such scene or method, or the method cannot take the scene. Divergence.
    """
    check_rows(rows)
    where, chosen = placed(scene, rows, **of_scene), named(method)
    if hasattr(chosen, "solved"):
        solution: Solution = chosen.solved(where, method, seed)
        return solution
    return stepped(where, chosen, called(method), How(seed, time, dt, resume, progress))


def placed(scene: Any, rows: int | None, **of_scene: Any) -> Any:
    """The scene with so many rows. Raises ValueError: there is no such scene."""
    if isinstance(scene, str):
        if scene not in SCENES:
            raise ValueError(f"no scene is called {scene!r}; near to it are {near(scene, SCENES)}")
        return SCENES[scene](**of_scene) if rows is None else SCENES[scene](rows=rows, **of_scene)
    fresh = replace(scene, **of_scene) if of_scene else scene
    return fresh if rows is None else with_rows(fresh, rows)


def check_rows(rows: int | None) -> None:
    """Refuse what is no number of rows. Raises ValueError."""
    if rows is not None and (rows < 4 or rows != round(rows)):
        raise ValueError(f"rows must be a whole number of 4 or more, got {rows}: 16 or 24 are usual")


def named(method: Any) -> Any:
    """What stands for a method. Raises ValueError: no method has this name."""
    if not isinstance(method, str):
        return method
    if method not in ALL:
        raise ValueError(f"no method is called {method!r}; near to it are {near(method, ALL)}")
    return ALL[method]


def called(method: Any) -> str:
    """The name of a method in titles and tables."""
    if isinstance(method, str):
        return method
    return str(getattr(method, "name", "") or getattr(method, "__name__", type(method).__name__))


def stepped(scene: Any, chosen: Any, name: str, how: How) -> Solution:
    """By steps in time, of any method."""
    made = prepared(scene, chosen, how.seed)
    plan, unit = planned(scene, chosen, made.dt, how), duration(scene)[1]
    with tqdm(total=plan.steps, desc=name, unit="step", disable=how.silent, leave=False) as bar:
        def tell(part: float) -> None:
            bar.update(round(part*plan.steps) - bar.n)
        done = run(made.method, made.start, plan, tell)
    history = pd.DataFrame({"t": np.array(done.times)/unit, **done.series})
    at = seen(made.method, done.by_id())
    return Solution(scene=scene, method=name, rows=rows_of(scene), seed=how.seed, history=history,
                    numbers=numbers(scene, history, at), places=frame(at), dt=plan.dt, steps=plan.steps,
                    cpu_s=done.cpu_s, compile_s=done.compile_s)


def planned(scene: Any, chosen: Any, longest: float, how: How) -> Plan:
    """Steps of the same length, none longer than it may be, and what they record."""
    usual, unit = duration(scene)
    length = (how.time or usual)*unit
    steps = ceil(length/(how.dt or longest))
    return Plan(dt=length/steps, steps=steps, series=recorded(scene, chosen), every=max(1, steps//SAMPLES),
                checkpoint=Path(how.resume) if how.resume else None)


def prepared(scene: Any, chosen: Any, seed: int = 1) -> Ready:
    """A method at its start in a scene, for `run`: of grids a block is as flat as states of points."""
    made = ready(scene, chosen, seed, **begun(scene, chosen, seed))
    return made._replace(start=made.start.reshape(made.start.shape[0], -1))


def begun(scene: Any, chosen: Any, seed: int) -> dict[str, Any]:
    """Where particles start, if not as all points do: those of one mass as dense as the scene has it, and in
    sound, which jitter would drown, moving points on a lattice."""
    if isinstance(chosen, Variant):
        x, fields = of_one_mass(scene, seed)
        return {"x": x, "fields": fields}
    if isinstance(scene, Sound) and isinstance(chosen, (FacesMotion, DriftMotion)):
        return {"x": lattice((scene.width, scene.L)).x}
    return {}


def frame(at: Fields) -> pd.DataFrame:
    """Fields as columns."""
    return pd.DataFrame({"x": at.x[:, 0], "y": at.x[:, 1], "vx": at.v[:, 0], "vy": at.v[:, 1], "rho": at.rho,
                         "T": at.T, "V": at.V})
