"""One call for every method: particles, points, grids, py-pde, Boussinesq, linear theory."""
import re
import sys
import warnings
from collections.abc import Callable, Iterable, Sequence
from dataclasses import fields, replace
from difflib import get_close_matches
from functools import partial
from inspect import signature
from math import ceil
from numbers import Integral, Real
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
from numba.core.errors import TypingError
from tqdm import tqdm

from continuum.domain import Domain
from continuum.scene import positive
from particles.integral.points import lattice
from particles.run import Divergence, Plan, run
from studies.build import (
    METHODS,
    SCENES,
    called,
    counted,
    duration,
    of_name,
    of_one_mass,
    ready,
    rows_of,
    variant,
    with_rows,
)
from studies.build.moving import DriftMotion, FacesMotion
from studies.build.scenes import Sound
from studies.build.setting import Ready
from studies.build.spam import Variant
from studies.front.observed import numbers, recorded, seen
from studies.front.references import REFERENCES, solved
from studies.front.solution import Comparison, Solution

SAMPLES = 400       # approximate number of samples in a history
#: name -> method or reference solver
ALL: dict[str, Any] = {**METHODS, **REFERENCES}


def solve(scene: Any, method: Any, *, rows: int | None = None, seed: int = 1, time: float | None = None,
          dt: float | None = None, resume: str | Path | None = None, progress: bool | None = None,
          **of_scene: Any) -> Solution:
    """Solve a scene by a method.

    scene : a name of `SCENES`, with its numbers as keywords, such as ra=1e4; or an object. method : a name of
    `ALL`, a variant or a method of one's own, or a class or function that takes the scene. rows : points or
    cells over the height. seed : of random positions. time : length of the run in the scene's unit: free-fall
    times of convection, viscous times of a box. dt : the time step, if not the method's own. resume : a file
    from which an interrupted run goes on. progress : show a bar; by default if stderr is a terminal.
    Raises ValueError: unknown scene or method, or the method cannot take the scene. TypeError: scene or
    method is of no such kind, or a formula of one's own does not fit. Divergence.
    """
    positive(**{name: given for name, given in (("time", time), ("dt", dt)) if given is not None})
    if not isinstance(seed, Integral) or seed < 0:
        raise ValueError(f"seed must be a whole number of 0 or more, got {seed!r}: 1 is usual")
    where, chosen = placed(scene, rows, **of_scene), named(method)
    try:
        if isinstance(method, str) and method in REFERENCES:
            parts = solved(method, where)
        else:
            made = prepared(where, chosen, seed)
            plan = planned(where, chosen, dt or made.dt, time, resume)
            warn_of_heat(where, plan.dt*plan.steps)
            parts = followed(where, made, plan, called(method), progress)
    except TypingError as error:
        raise TypeError(misfit(str(error))) from error
    except KeyError as error:
        raise TypeError(f"a formula asks for {error}, which it is not given") from error
    return Solution(scene=where, method=called(method), rows=rows_of(where), seed=seed, **parts)


def misfit(words: str) -> str:
    """Innermost of numba's messages in one line: what a formula of one's own was called with, or gave."""
    words = re.sub(r"Record\([^()]*\)", "point", words)
    inner = words.split("(step: nopython frontend)")[-1].strip()
    what, whole = ("", inner) if ">>> " in inner else (f": {inner.splitlines()[0]}", words)
    return f"a formula is missing or does not fit in {whole.partition('>>> ')[2].splitlines()[0]}{what}"


def placed(scene: Any, rows: int | None, **of_scene: Any) -> Any:
    """The scene with its rows and numbers. Raises ValueError: unknown scene or number, or wrong rows.
    TypeError: this is no scene."""
    if rows is not None and (not isinstance(rows, Real) or rows < 4 or rows != round(rows)):
        raise ValueError(f"rows must be a whole number of 4 or more, got {rows!r}: 16 or 24 are usual")
    if isinstance(scene, type) or not (isinstance(scene, str) or hasattr(scene, "fields")):
        raise TypeError(f"a scene is a name or an object such as Domain(...), got {scene!r}: make words "
                        "lists the names")
    make = of_name("scene", scene, SCENES) if isinstance(scene, str) else partial(replace, scene)
    check_keywords(of_scene, make)
    if isinstance(scene, str):
        return make(**of_scene) if rows is None else make(rows=rows, **of_scene)
    fresh = make(**of_scene) if of_scene else scene
    return fresh if rows is None else with_rows(fresh, rows)


def check_keywords(given: Iterable[str], make: Callable) -> None:
    """Raise ValueError, with the nearest names, for a keyword that neither a scene nor `solve` takes."""
    for name in given:
        if name not in (known := numbers_of(make)):
            alike = get_close_matches(name, known, 2, 0.5)
            told = f"near to it are {', '.join(alike)}" if alike else f"there are {', '.join(known)}"
            raise ValueError(f"in this scene nothing is called {name!r}; {told}")


def numbers_of(make: Callable) -> list[str]:
    """Keywords for a scene: its maker's, its numbers but the length that rows set, those of `solve`."""
    taken, scene = signature(make).parameters.values(), make()
    own = [one.name for one in taken if one.kind is not one.VAR_KEYWORD]
    length = counted(scene) if "rows" in own else ""
    more = [one.name for one in fields(scene) if one.name != length and len(own) < len(taken)]
    call = [name for name, one in signature(solve).parameters.items() if one.kind is one.KEYWORD_ONLY]
    return [*dict.fromkeys([*own, *more, *call])]


def warn_of_heat(scene: Any, time: float) -> None:
    """Warn if net heat enters or leaves a box whose sides have no temperature: it gets no steady state."""
    if not isinstance(scene, Domain) or scene.temperatures:
        return
    left, right, bottom, top = (getattr(side, "q", 0.0) for side in scene.four)
    heat = (left + right)*scene.L + (bottom + top)*scene.width
    if heat:
        rise = heat*time/(scene.width*scene.L*float(scene.eos.cv))
        warnings.warn(f"heat {heat:.3g} enters the box per time and no side has a temperature to let it out: "
                      f"T will change by {rise:.3g} in this run; give a side T, or sides a total q of 0",
                      stacklevel=3)


def named(method: Any) -> Any:
    """The method of a name, or the object itself. Raises ValueError: unknown name. TypeError: no method."""
    return of_name("method", method, ALL) if isinstance(method, str) else variant(method)


def prepared(scene: Any, chosen: Any, seed: int = 1) -> Ready:
    """A method with its initial state in a scene, for `run`.

    Particles of one mass start with the density of the scene. In sound, moving points start on a lattice,
    as jitter would exceed the wave.
    """
    begun: dict[str, Any] = {}
    if isinstance(chosen, Variant):
        begun["x"], begun["fields"] = of_one_mass(scene, seed)
    elif isinstance(scene, Sound) and isinstance(chosen, (FacesMotion, DriftMotion)):
        begun["x"] = lattice((scene.width, scene.L)).x
    return ready(scene, chosen, seed, **begun)


def planned(scene: Any, chosen: Any, longest: float, time: float | None = None,
            resume: str | Path | None = None) -> Plan:
    """Plan of a run: equal time steps, at most ``longest``, and the series that it records."""
    usual, unit = duration(scene)
    length = (time or usual)*unit
    steps = ceil(length/longest)
    return Plan(dt=length/steps, steps=steps, series=recorded(scene, chosen), every=max(1, steps//SAMPLES),
                checkpoint=Path(resume) if resume else None)


def followed(scene: Any, made: Ready, plan: Plan, name: str, progress: bool | None) -> dict[str, Any]:
    """Parts of a solution from a run in time steps."""
    shown = sys.stderr.isatty() if progress is None else progress
    with tqdm(total=plan.steps, desc=name, unit="step", disable=not shown, leave=False) as bar:
        def tell(part: float) -> None:
            bar.update(round(part*plan.steps) - bar.n)
        try:
            done = run(made.method, made.start, plan, tell)
        except Divergence as error:     # no step is short enough for a flow that is not resolved
            sturdy = f"{name}-entropy-stable"
            more = f", or {sturdy}, which takes shocks" if sturdy in METHODS else ""
            raise Divergence(error.step, f"{error}; or take more rows{more}") from None
    history = pd.DataFrame({"t": np.array(done.times)/duration(scene)[1], **done.series})
    at = seen(made.method, done.by_id())
    return {"history": history, "at": at, "numbers": numbers(scene, history, at), "dt": plan.dt,
            "steps": plan.steps, "cpu_s": done.cpu_s}


def compare(scene: Any, methods: Sequence[Any], rows: Sequence[int] | int = (16, 25),
            **more: Any) -> Comparison:
    """Solve a scene by several methods at several resolutions; runs that diverge are listed apart.

    scene, methods, more : as of `solve`. Raises ValueError: no method or no number of rows; as `solve`, for
    each run when its turn comes.
    """
    solutions, diverged = [], {}
    chosen = [methods] if isinstance(methods, str) else methods
    counts = [rows] if isinstance(rows, int) else rows
    if not (len(chosen) and len(counts)):
        raise ValueError(f"nothing to compare: got methods {methods!r}, rows {rows!r}; give one of each")
    for method in chosen:
        for count in counts:
            try:
                solutions.append(solve(scene, method, rows=count, **more))
            except Divergence as error:
                diverged[f"{called(method)}, {count} rows"] = str(error)
    return Comparison(solutions, diverged)
