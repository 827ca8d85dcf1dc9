"""Properties of a scene besides its start: length of a run, exact solution, particles of equal mass.

A scene may define `duration`, `answer`, `quantities`, `of_one_mass`; here each has a default. `counted` names
the length that is the number of rows, if that is not the height L.
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
    """(length of a run in the scene's unit of time, this unit); exact solutions are known at its end."""
    if isinstance(scene, RayleighBenard):
        return FALLS, scene.L/scene.free_fall
    return scene.duration if hasattr(scene, "duration") else (1.0, float(scene.time))


def rows_of(scene: Any) -> int:
    """Number of points or cells over the counted length: the height, or the wavelength of sound."""
    return round(getattr(scene, counted(scene)))


def with_rows(scene: Any, rows: int) -> Any:
    """The same scene with another number of rows of points or cells."""
    if hasattr(scene, "resized"):
        return scene.resized(rows)
    name = counted(scene)
    return replace(scene, **{name: type(getattr(scene, name))(rows)})


def counted(scene: Any) -> str:
    """Name of the scene's length that is its number of rows."""
    return getattr(scene, "counted", "L")


def answer(scene: Any, x: np.ndarray) -> dict[str, np.ndarray]:
    """Exact fields at the end of a run at positions x (n, 2), by names such as vx, T; empty if not known."""
    return scene.answer(x) if hasattr(scene, "answer") else {}


def quantities(scene: Any) -> dict[str, Callable]:
    """Functions of fields that a history records besides K and Nu; `wave` grows at a rate to be measured."""
    return getattr(scene, "quantities", {})


def of_one_mass(scene: Any, seed: int) -> tuple[Any, Any]:
    """Start positions (n, 2) of particles of equal mass, and fields there; two None if the density is 1."""
    if hasattr(scene, "of_one_mass"):
        return scene.of_one_mass(seed)
    if not isinstance(scene, Domain) or scene.start or not scene.g:
        return None, None
    at_rest = scene.fields(scene.L*np.stack([0*HEIGHTS, HEIGHTS - 0.5], axis=1))[0]
    x = as_dense(shaken(scene, seed), scene.L, at_rest)
    return x, scene.fields(x)
