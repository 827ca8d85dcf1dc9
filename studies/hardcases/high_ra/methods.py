"""One run of KHP95's layer at a Rayleigh number on 16 rows: the compressible grid, fixed points, moving points."""
from collections.abc import Callable
from functools import partial
from math import ceil
from typing import Any, NamedTuple

import numpy as np

from continuum.gas.fields import block, initial
from continuum.gas.solve import SAFETY, DivergedError, limits
from continuum.gas.solve import run as on_grid
from continuum.steady import Time
from particles.limits import limit_of
from particles.run import Divergence, Plan, run
from studies.build import fixed as dih
from studies.build import moving, ready
from studies.build.names import START_ENERGY
from studies.hardcases.map.scenes import ROWS, layer

TIME = 50.0             # free-fall times, as in the map
SAMPLES, LATE = 60, 40  # of a run; from where on K is averaged
NOISE = 1e-6            # of the density at the start, by which seeds differ where points do not


class Trial(NamedTuple):
    """K of the last third, not a number if the run ended before, and the part of the time that it reached."""
    k: float
    reached: float


def ripple(seed: int, *shape: int) -> np.ndarray:
    """Factors that are 1 but for NOISE."""
    return 1 + NOISE*np.random.default_rng(seed).standard_normal(shape)


def points(ra: float, seed: int, step: float, build: Callable) -> Trial:
    """Fixed or moving points."""
    scene = layer(ra)
    method, start, dt, kinetic = build(scene, seed)
    every = ceil(TIME*scene.L/scene.free_fall/(step*dt)/SAMPLES)
    steps, ke = every*SAMPLES, []

    def watch(sums: Any, state: np.ndarray) -> float:
        ke.append(kinetic(sums, state))
        return ke[-1]
    try:
        run(method, start, Plan(dt=TIME*scene.L/scene.free_fall/steps, steps=steps, series={"k": watch}, every=every))
    except Divergence as error:
        return Trial(np.nan, error.step/steps)
    return Trial(float(np.mean(ke[LATE:])), 1.0)


def fixed(scheme: str) -> Callable:
    """Fixed points between plates, by the name of a scheme of the main study."""
    def build(scene: Any, seed: int) -> tuple:
        method, start, _ = ready(scene, scheme, seed)
        start *= ripple(seed, len(method.x))
        return method, start, dih.OF_LIMIT*limit_of(method, start), dih.kinetic
    return build


def shifted(scene: Any, seed: int) -> tuple:
    """Moving points with closed faces."""
    return *ready(scene, "moving", seed), moving.kinetic


def gridded(ra: float, seed: int, step: float) -> Trial:
    """The compressible grid."""
    return grid_run(ra, seed, step, ROWS)[0]


def grid_run(ra: float, seed: int, step: float, rows: int) -> tuple[Trial, float]:
    """A run and the cell number of its fastest flow at the end, in cells of 16 rows."""
    scene, reached = layer(ra), [0.0]
    start = initial(scene, rows, START_ENERGY)
    dt = step*SAFETY*limits(scene, block(start)).both
    start.cells[:] *= ripple(seed, *start.cells.shape)
    try:
        done = on_grid(scene, rows, until=Time(TIME*scene.L/scene.free_fall, SAMPLES), start=start, dt=dt,
                       progress=reached.append)
    except DivergedError:
        return Trial(np.nan, reached[-1]), np.nan
    fastest = float(np.hypot(done.fields.at.vx, done.fields.at.vy).max())
    return Trial(float(done.series.ke[LATE + 1:].mean()), 1.0), fastest*scene.L/ROWS/scene.nu


#: of Ra, seed, and the step over that of other studies
METHODS: dict[str, Callable[[float, int, float], Trial]] = {
    "grid": gridded,
    "fixed lattice": partial(points, build=fixed("fixed-lattice")),
    "fixed jittered": partial(points, build=fixed("fixed-jittered-delaunay")),
    "moving": partial(points, build=shifted)}
