"""What a scene is asked: for how long it runs, what its exact answer is, where particles of one mass start.

Functions of the kind of scene, so that a scene of one's own needs none of them, or registers its own.
"""
from collections.abc import Callable
from dataclasses import replace
from functools import singledispatch
from typing import Any

import numpy as np
from scipy.integrate import cumulative_trapezoid

from continuum.domain import Domain
from continuum.exact import plates
from continuum.exact.vortex import solved, velocities
from continuum.fluid import Fields
from continuum.scene import RayleighBenard
from particles.integral.points import lattice
from studies.build.names import START_JITTER
from studies.build.scenes import BetweenPlates, Sound, Start, TaylorGreen
from studies.build.setting import shaken, shifted

FALLS = 90.0        # free-fall times: K of rolls at Ra 10 000 then changes by 0.1 % at most


@singledispatch
def duration(scene: Any) -> tuple[float, float]:
    """(length of a run in units of time of the scene, this unit); with an answer, until it is known."""
    return 1.0, float(scene.time)


@duration.register
def _(scene: RayleighBenard) -> tuple[float, float]:
    return FALLS, scene.L/scene.free_fall


@singledispatch
def rows_of(scene: Any) -> int:
    """Points or cells over the height, or over the wavelength of sound."""
    return round(scene.L)


rows_of.register(Sound, lambda scene: scene.width)


@singledispatch
def with_rows(scene: Any, rows: int) -> Any:
    """The same scene of so many points or cells."""
    return scene.resized(float(rows)) if hasattr(scene, "resized") else replace(scene, L=type(scene.L)(rows))


with_rows.register(Sound, lambda scene, rows: replace(scene, width=rows))


@singledispatch
def answer(scene: Any, x: np.ndarray) -> dict[str, np.ndarray]:
    """Exact fields at the end at places (n, 2), by the names vx, vy, T; none where they are not known."""
    return {}


@answer.register
def _(scene: TaylorGreen, x: np.ndarray) -> dict[str, np.ndarray]:
    v = scene.speed*velocities(solved(scene.mach), x/scene.L)
    return {"vx": v[:, 0], "vy": v[:, 1]}


@answer.register
def _(scene: Sound, x: np.ndarray) -> dict[str, np.ndarray]:
    _, u, T = scene.exactly(scene.time, x[:, 0])
    return {"vx": u, "T": 1 + T}


@answer.register
def _(scene: BetweenPlates, x: np.ndarray) -> dict[str, np.ndarray]:
    _, _, u, T = plates.fields(scene.flow, x[:, 1]/scene.L + 0.5)
    return {"vx": u} if scene.flow.U else {"T": T}


@singledispatch
def quantities(scene: Any) -> dict[str, Callable[[Fields], float]]:
    """What a history of the scene has besides K and Nu: functions of fields; `wave` gives a growth rate."""
    return {}


@singledispatch
def of_one_mass(scene: Any, seed: int) -> tuple[Any, Any]:
    """Places (n, 2) of particles of one mass, and fields there; two None where the density is 1."""
    return None, None


@of_one_mass.register
def _(scene: TaylorGreen, seed: int) -> tuple[np.ndarray, Start]:
    x = shifted(scene.L, scene.L, START_JITTER, seed)
    return x, scene.fields(x)


@of_one_mass.register
def _(scene: Sound, seed: int) -> tuple[np.ndarray, Start]:
    """A lattice, displaced as the density wants it, with the fields of the lattice."""
    x = lattice((scene.width, scene.L)).x
    fields = scene.fields(x)
    x[:, 0] -= scene.amplitude/scene.k*np.sin(scene.k*x[:, 0])
    return x, fields


@of_one_mass.register
def _(scene: Domain, seed: int) -> tuple[Any, Any]:
    """Rows as far apart as gravity wants them."""
    if scene.start or not scene.g:
        return None, None
    x, s = shaken(scene, seed), np.linspace(-0.5, 0.5, 2001)
    rho = scene.fields(scene.L*np.stack([0*s, s], axis=1))[0]
    mass = cumulative_trapezoid(rho, s, initial=0)
    x[:, 1] = scene.L*np.interp((x[:, 1]/scene.L + 0.5)*mass[-1], mass, s)
    return x, scene.fields(x)


@of_one_mass.register
def _(scene: BetweenPlates, seed: int) -> tuple[np.ndarray, Start]:
    """A lattice whose rows are as far apart as the density wants them."""
    x, s = lattice((scene.width, scene.L)).x, np.linspace(0, 1, 2001)
    mass = cumulative_trapezoid(scene.flow.start(s)[0], s, initial=0)
    below = x[:, 1]/scene.L + 0.5
    x[:, 1] = scene.L*(np.interp(below*mass[-1], mass, s) - 0.5)
    return x, scene.fields(x)
