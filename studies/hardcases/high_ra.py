"""Up to which Rayleigh number do 16 rows last? KHP95's layer, followed for 50 free-fall times.

A run is wrong if K of its last third is off by a factor of more than OFF from the grid's of 48 rows at the
same Ra, or if it ended before. The map calls a tenth wrong, of flow at Ra 1e5 and 1e6; grids of 16 and of 96
rows differ by a tenth in K at Ra 1e5, so that OFF leaves room for as much again. Ra is raised by half decades
until a run is wrong, and beyond until one ends; then the interval is halved, on the scale of v a/nu of the
free-fall velocity, (Ra/Pr)^(1/2)/16. Whether K is off is asked up to 1e6 only, as far as the fine grid has
been seen to come. All is done again in shorter steps, since v grows after these are chosen.

Expected: central differences keep order while v a/nu of the fastest flow, that of the fine grid, is below 2.
This is no limit of stability: no formula is known that says where a run ends.
"""
from collections.abc import Callable
from dataclasses import dataclass
from functools import cache, partial
from math import ceil, log
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from continuum.gas.fields import block, initial
from continuum.gas.solve import DivergedError, limits
from continuum.gas.solve import run as on_grid
from continuum.steady import SAFETY, Time
from particles.limits import limit_of
from particles.run import Divergence, Plan, run
from studies.build import fixed as fixed_points
from studies.build import moving, ready
from studies.build.names import START_ENERGY
from studies.build.unguarded import bisected
from studies.hardcases.scenes import ROWS, layer
from studies.kit.case import Case, Outcome, Report

OFF = 1.25              # factor in K
STEPS = (1.0, 0.25)     # over those of other studies
FINE, FINER = 32, 48    # rows of grids that tell what K should be: the second, from which the first tells how far off it may be
RUNGS = tuple(float(f"{10.0**(n/2):.9g}") for n in range(8, 17))        # 1e4 .. 1e8
KNOWN = 1e6             # Ra up to which K is held against the fine grid
TIME = 50.0             # free-fall times, as in the map
SAMPLES, LATE = 60, 40  # of a run; from where on K is averaged
NOISE = 1e-6            # of the density at the start, by which seeds differ where points do not


# --- one run --------------------------------------------------------------------------------------


class Attempt(NamedTuple):
    """K of the last third, not a number if the run ended before, and the part of the time that it reached."""
    k: float
    reached: float


def ripple(seed: int, *shape: int) -> np.ndarray:
    """Factors that are 1 but for NOISE."""
    return 1 + NOISE*np.random.default_rng(seed).standard_normal(shape)


class Energies:
    """K in time, kept also when the run ends."""

    def __init__(self, kinetic: Callable):
        self.kinetic = kinetic
        self.k: list[float] = []

    def __call__(self, sums: Any, state: np.ndarray) -> float:
        self.k.append(self.kinetic(sums, state))
        return self.k[-1]


def points(ra: float, seed: int, step: float, build: Callable) -> Attempt:
    """Fixed or moving points."""
    scene = layer(ra)
    method, start, dt, kinetic = build(scene, seed)
    time, energies = TIME*scene.L/scene.free_fall, Energies(kinetic)
    every = ceil(time/(step*dt)/SAMPLES)
    steps = every*SAMPLES
    try:
        run(method, start, Plan(dt=time/steps, steps=steps, series={"k": energies}, every=every))
    except Divergence as error:
        return Attempt(np.nan, error.step/steps)
    return Attempt(float(np.mean(energies.k[LATE:])), 1.0)


def fixed(scheme: str) -> Callable:
    """Fixed points between plates, by the name of a scheme."""
    def build(scene: Any, seed: int) -> tuple:
        method, start, _ = ready(scene, scheme, seed)
        start *= ripple(seed, len(method.x))
        return method, start, fixed_points.OF_LIMIT*limit_of(method, start), fixed_points.kinetic
    return build


def shifted(scene: Any, seed: int) -> tuple:
    """Moving points with closed faces."""
    return *ready(scene, "moving", seed), moving.kinetic


def gridded(ra: float, seed: int, step: float) -> Attempt:
    """The compressible grid."""
    return grid_run(ra, seed, step, ROWS)[0]


def grid_run(ra: float, seed: int, step: float, rows: int) -> tuple[Attempt, float]:
    """A run and the cell number of its fastest flow at the end, in cells of 16 rows."""
    scene, reached = layer(ra), [0.0]
    start, until = initial(scene, rows, START_ENERGY), Time(TIME*scene.L/scene.free_fall, SAMPLES)
    dt = step*SAFETY*limits(scene, block(start)).both
    start.cells[:] *= ripple(seed, *start.cells.shape)
    try:
        done = on_grid(scene, rows, until=until, start=start, dt=dt, progress=reached.append)
    except DivergedError:
        return Attempt(np.nan, reached[-1]), np.nan
    fastest = float(np.hypot(done.fields.at.vx, done.fields.at.vy).max())
    return Attempt(float(done.series.ke[LATE + 1:].mean()), 1.0), fastest*scene.L/ROWS/scene.nu


#: of Ra, seed, and the step over that of other studies
METHODS: dict[str, Callable[[float, int, float], Attempt]] = {
    "grid": gridded,
    "fixed lattice": partial(points, build=fixed("fixed-lattice")),
    "fixed jittered": partial(points, build=fixed("fixed-jittered-delaunay")),
    "moving": partial(points, build=shifted)}


# --- what K should be -----------------------------------------------------------------------------


@cache
def reference(rows: int) -> list[dict[str, float]]:
    """Rows of the table: the fine grid on the rungs up to KNOWN."""
    runs = [(ra, *grid_run(ra, 1, 1.0, rows)) for ra in RUNGS if ra <= KNOWN]
    return [{"ra": ra, "rows": rows, "k": trial.k, "cell_number": cell_number, "reached": trial.reached}
            for ra, trial, cell_number in runs]


def should_be(ra: float) -> float:
    """K of the fine grid, linear between rungs in Ra^(-1/2)    [KHP95, Sec. VI]; nothing beyond KNOWN."""
    x, k = np.array([(row["ra"]**-0.5, row["k"]) for row in reference(FINER)])[::-1].T
    return float(np.interp(ra**-0.5, x, k)) if ra <= KNOWN*(1 + 1e-9) else np.nan


@dataclass(frozen=True, kw_only=True)
class FineGrid(Case):
    """What K should be."""
    rows: int

    @property
    def cost(self) -> float:
        return 1.5e-4*self.rows**3

    @property
    def label(self) -> str:
        return f"high Ra, grid of {self.rows} rows"

    def run(self, report: Report, folder: Path) -> Outcome:
        return Outcome({"high_ra_grid": reference(self.rows)})


# --- the search -----------------------------------------------------------------------------------


class Search:
    """Trials of one method, each run once."""

    def __init__(self, method: str, seed: int, step: float):
        self.method, self.seed, self.step = method, seed, step
        self.trials: dict[float, Attempt] = {}

    def at(self, ra: float) -> Attempt:
        """The run at a Rayleigh number; nine digits count, so that rungs are met again."""
        ra = float(f"{ra:.9g}")
        if ra not in self.trials:
            self.trials[ra] = METHODS[self.method](ra, self.seed, self.step)
        return self.trials[ra]

    def ends(self, ra: float) -> bool:
        """Before its time."""
        return self.at(ra).reached < 1

    def wrong(self, ra: float) -> bool:
        """Ends, or K is off."""
        return self.ends(ra) or abs(log(self.at(ra).k/should_be(ra))) > log(OFF)

    def seek(self, bad: Callable[[float], bool], rungs: tuple[float, ...]) -> None:
        """Try up to the first rung at which a run is bad, and halve the interval."""
        for ra in rungs:
            if bad(ra):
                bisected(lambda cell: bad((ROWS*cell)**2), ra**0.5/ROWS)
                return

    def limit(self, bad: Callable[[float], bool], most: float) -> dict[str, Any]:
        """The first bad trial up to `most`, and the last before it: a search may pass over an island."""
        tried = sorted(ra for ra in self.trials if ra <= most)
        judged = [bad(ra) for ra in tried]
        if not any(judged):
            return {"ra": np.nan, "ra_err": np.nan, "tried": tried[-1], "again": 0, "outcome": "none"}
        first = judged.index(True)
        low, high = tried[max(first - 1, 0)], tried[first]
        return {"ra": (low*high)**0.5, "ra_err": (high - low)/2, "tried": tried[-1], "again": judged[first:].count(False),
                "outcome": "ends" if self.ends(high) else "wrong but stable"}


@dataclass(frozen=True, kw_only=True)
class HighRa(Case):
    """One method's limits from one start. step : over that of other studies."""
    method: str
    seed: int
    step: float = STEPS[0]

    @property
    def cost(self) -> float:
        return (60.0 if self.method == "moving" else 10.0)/self.step

    @property
    def label(self) -> str:
        return f"high Ra, {self.method}, seed {self.seed}, step {self.step:g}"

    def run(self, report: Report, folder: Path) -> Outcome:
        search = Search(self.method, self.seed, self.step)
        kinds = {"wrong": (search.wrong, KNOWN), "ends": (search.ends, RUNGS[-1])}
        for bad, most in kinds.values():
            search.seek(bad, tuple(ra for ra in RUNGS if ra <= most))
        key = {"method": self.method, "step": self.step, "seed": self.seed}
        rows = [{**key, "kind": kind, **search.limit(bad, most)} for kind, (bad, most) in kinds.items()]
        trials = [{**key, "ra": ra, "k": trial.k, "over": trial.k/should_be(ra), "reached": trial.reached}
                  for ra, trial in search.trials.items()]
        return Outcome({"high_ra": rows, "high_ra_trials": trials})
