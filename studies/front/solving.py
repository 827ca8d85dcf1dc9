"""One call for every method: particles, points, grids, py-pde, Boussinesq, linear theory."""
import sys
from dataclasses import replace
from math import ceil
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
from tqdm import tqdm

from continuum.fluid import Fields
from particles.integral.points import lattice
from particles.run import Plan, run
from studies.build import METHODS, near, ready
from studies.build.answers import duration, of_one_mass, rows_of
from studies.build.moving import FacesMotion
from studies.build.named import SCENES
from studies.build.rr98_moving import DriftMotion
from studies.build.scenes import Sound
from studies.build.spam import Variant
from studies.front.observed import numbers, recorded, seen
from studies.front.references import REFERENCES
from studies.front.solution import Solution

SAMPLES = 400       # of a history
#: name -> what solves a scene
ALL: dict[str, Any] = {**METHODS, **REFERENCES}


def solve(scene: Any, method: Any, *, rows: int | None = None, seed: int = 1, time: float | None = None,
          resume: str | Path | None = None, progress: bool | None = None, **of_scene: Any) -> Solution:
    """A scene solved by a method.

    scene : a name of `SCENES`, which takes its numbers besides, such as ra=1e4; or an object. method : a name
    of `ALL`, a variant or a method of one's own, or a class that takes the scene. rows : points or cells over
    the height. time : length of the run in the scene's unit, for convection free-fall times. resume : a file
    that an interrupted run goes on from. progress : a bar; by default where somebody looks.
    Raises ValueError: there is no such scene or method, or the method cannot take the scene. Divergence.
    """
    where = placed(scene, rows, **of_scene)
    chosen = named(method)
    if hasattr(chosen, "solved"):
        return chosen.solved(where, method, seed)
    return stepped(where, chosen, called(method), seed, time, resume, progress)


def placed(scene: Any, rows: int | None, **of_scene: Any) -> Any:
    """The scene with so many rows. Raises ValueError: there is no such scene."""
    if isinstance(scene, str):
        if scene not in SCENES:
            raise ValueError(f"no scene is called {scene!r}; near to it are {near(scene, SCENES)}")
        return SCENES[scene](rows=rows, **of_scene) if rows else SCENES[scene](**of_scene)
    fresh = replace(scene, **of_scene) if of_scene else scene
    return replace(fresh, L=type(scene.L)(rows)) if rows else fresh


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


def stepped(scene: Any, chosen: Any, name: str, seed: int, time: float | None, resume: str | Path | None,
            progress: bool | None) -> Solution:
    """By steps in time, of any method."""
    method, start, dt = ready(scene, chosen, seed, **begun(scene, chosen, seed))
    usual, unit = duration(scene)
    steps = ceil((time or usual)*unit/dt)
    plan = Plan(dt=(time or usual)*unit/steps, steps=steps, series=recorded(scene, chosen),
                every=max(1, steps//SAMPLES), checkpoint=Path(resume) if resume else None)
    shown = sys.stderr.isatty() if progress is None else progress
    with tqdm(total=steps, desc=name, unit="step", disable=not shown, leave=False) as bar:
        def tell(part: float) -> None:
            bar.update(round(part*steps) - bar.n)
        done = run(method, start.reshape(start.shape[0], -1), plan, tell)
    history = pd.DataFrame({"t": np.array(done.times)/unit, **done.series})
    at = seen(method, done.by_id())
    return Solution(scene=scene, method=name, rows=rows_of(scene), seed=seed, history=history,
                    numbers=numbers(scene, history, at), places=frame(at), dt=plan.dt, steps=steps,
                    cpu_s=done.cpu_s, compile_s=done.compile_s)


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
