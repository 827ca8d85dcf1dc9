"""What a scene is asked: for how long it runs, what its exact answer is, where particles of one mass start.

A scene that knows has `duration`, `answer`, `quantities`, `of_one_mass`; it needs none. `counted` is what a
number of rows stands for, if not its height L.
"""
from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np

from continuum.domain import Domain
from continuum.scene import RayleighBenard
from studies.build.scenes import HEIGHTS, as_dense
from studies.build.setting import shaken

FALLS = 90.0        # free-fall times: K of rolls at Ra 10 000 then changes by 0.1 % at most


def duration(scene: Any) -> tuple[float, float]:
    """(length of a run in units of time of the scene, this unit); with an answer, until it is known."""
    if isinstance(scene, RayleighBenard):
        return FALLS, scene.L/scene.free_fall
    return scene.duration if hasattr(scene, "duration") else (1.0, float(scene.time))


def rows_of(scene: Any) -> int:
    """Points or cells over the height, or over the wavelength of sound."""
    return round(getattr(scene, counted(scene)))


def with_rows(scene: Any, rows: int) -> Any:
    """The same scene of so many points or cells."""
    if hasattr(scene, "resized"):
        return scene.resized(rows)
    name = counted(scene)
    return replace(scene, **{name: type(getattr(scene, name))(rows)})


def counted(scene: Any) -> str:
    """The length of the scene that rows count."""
    return getattr(scene, "counted", "L")


def answer(scene: Any, x: np.ndarray) -> dict[str, np.ndarray]:
    """Exact fields at the end at places (n, 2), by the names vx, vy, T; none where they are not known."""
    return scene.answer(x) if hasattr(scene, "answer") else {}


def quantities(scene: Any) -> dict[str, Callable]:
    """What a history has besides K and Nu: functions of fields; `wave` gives a growth rate."""
    return getattr(scene, "quantities", {})


def of_one_mass(scene: Any, seed: int) -> tuple[Any, Any]:
    """Places (n, 2) of particles of one mass, and fields there; two None where the density is 1."""
    if hasattr(scene, "of_one_mass"):
        return scene.of_one_mass(seed)
    if not isinstance(scene, Domain) or scene.start or not scene.g:
        return None, None
    at_rest = scene.fields(scene.L*np.stack([0*HEIGHTS, HEIGHTS - 0.5], axis=1))[0]
    x = as_dense(shaken(scene, seed), scene.L, at_rest)
    return x, scene.fields(x)
