"""Hard cases on points and on the grid, as cases."""
from collections.abc import Iterator
from dataclasses import dataclass
from math import ceil
from pathlib import Path
from typing import Any

import numpy as np

from continuum.gas.fields import Fields, block, initial
from continuum.gas.solve import SAFETY, DivergedError, limits
from continuum.gas.solve import run as march
from continuum.scene import Torus
from continuum.steady import Time
from particles.run import Divergence, Plan, run
from studies.build.names import START_ENERGY
from studies.hardcases.map.methods import TAKES, Body, Built, flow, kinetic
from studies.hardcases.map.scenes import BOXES, LAYERS, ROWS, layer
from studies.kit.case import Case, Outcome, Report

SAMPLES = 60            # of a run; what is told are means over the last third
LATE = 2/3
GRIDS = (ROWS, 2*ROWS, 3*ROWS)
#: where three left undecided what is a tenth off
MORE_GRIDS = {"Ra 1e5": (4*ROWS, 6*ROWS), "high pressure": (4*ROWS, 6*ROWS, 8*ROWS)}
#: rows on which it is asked whether the grid at high Ra is steady, and for how long
FINER, SETTLED = (16, 24, 32, 48), 150.0
HIGH = (1e5, 2e5, 3.5e5)


class Watch:
    """K, flow and mass in time; what it has seen is kept also when a run does not come to its end."""

    def __init__(self, built: Built, box: tuple[float, float]):
        self.built, self.box, self.found = built, box, [observed(built.body(built.start), box)]

    def __call__(self, sums: Any, state: np.ndarray) -> float:
        self.found.append(observed(self.built.body(state), self.box))
        return self.found[-1][0]

    @property
    def late(self) -> dict[str, float]:
        """Means over the last third, the mass, and what there was at the start."""
        k, moves, mass = np.array(self.found).T
        late = slice(min(round(LATE*len(k)), len(k) - 1), None)
        return {"k": float(k[late].mean()), "flow": float(moves[late].mean()), "mass_drift": float(mass[-1]/mass[0] - 1),
                "k_start": float(k[0]), "flow_start": float(moves[0])}


def observed(body: Body, box: tuple[float, float]) -> tuple[float, float, float]:
    """K and the flow's per mass, mass."""
    return kinetic(body), flow(body, box), float(body.m.sum())


def row(case: str, method: str, values: dict[str, Any], rows: int) -> Outcome:
    """One row of `hard_runs`; what is not said is not known."""
    empty = dict.fromkeys(("k", "flow", "mass_drift", "k_start", "flow_start"), np.nan)
    key = {"case": case, "method": method, "rows": rows}
    return Outcome({"hard_runs": [{**key, **empty, "reached": 1.0, "refused": "", **values}]})


@dataclass(frozen=True, kw_only=True)
class Hard(Case):
    """One method in one case. time : in the units of the scene. A method that refuses leaves a row that says why."""
    case: str
    method: str
    scene: Any
    time: float

    @property
    def cost(self) -> float:
        return 6.0 if self.method == "moving" else 2.0

    @property
    def label(self) -> str:
        return f"map {self.case}, {self.method}"

    @property
    def rows(self) -> int:
        """Of points, over the height."""
        return round(self.scene.L)

    def run(self, report: Report, folder: Path) -> Outcome:
        try:
            built = TAKES[self.case][self.method](scene=self.scene)
        except (ValueError, ArithmeticError) as error:
            return row(self.case, self.method, {"reached": 0.0, "refused": f"{type(error).__name__}: {str(error)[:60]}"},
                       self.rows)
        every = ceil(self.time/built.dt/SAMPLES)
        steps = every*SAMPLES
        watch = Watch(built, (self.scene.width, self.scene.L))
        try:
            run(built.method, built.start, Plan(dt=self.time/steps, steps=steps, series={"k": watch}, every=every), report)
        except Divergence as error:
            return row(self.case, self.method, {**watch.late, "k": np.nan, "flow": np.nan, "reached": error.step/steps},
                       self.rows)
        return row(self.case, self.method, watch.late, self.rows)


@dataclass(frozen=True, kw_only=True)
class OnGrid(Case):
    """The compressible grid in one case: as coarse as the points, where it is a method, and finer, where it is the reference."""
    case: str
    scene: Any
    time: float
    rows: int

    @property
    def cost(self) -> float:
        return 3e-5*self.rows**3

    @property
    def label(self) -> str:
        return f"map {self.case}, grid of {self.rows} rows"

    def run(self, report: Report, folder: Path) -> Outcome:
        start = initial(self.scene, self.rows, START_ENERGY) if self.case in LAYERS else still(self.scene, self.rows)
        box = (self.scene.width, self.scene.L)
        part = Part(report)
        try:
            done = march(self.scene, self.rows, until=Time(self.time, SAMPLES), start=start, progress=part)
        except DivergedError:
            return row(self.case, "grid", {"reached": part.done}, self.rows)
        first, last = (observed(of_grid(fields), box) for fields in (start, done.fields))
        k = float(done.series.ke[round(LATE*len(done.series.ke)):].mean())
        return row(self.case, "grid", {"k": k, "flow": k*last[1]/max(last[0], 1e-300), "mass_drift": done.mass_drift,
                                       "k_start": first[0], "flow_start": first[1]}, self.rows)


class Part:
    """The part of a run that is done, told on and kept."""

    def __init__(self, report: Report):
        self.report, self.done = report, 0.0

    def __call__(self, done: float) -> None:
        self.done = done
        self.report(done)


def still(scene: Any, rows: int) -> Fields:
    """The start of a box, in which nothing moves but for velocities of the size of round-off."""
    return initial(scene, rows, 0.0)


def of_grid(fields: Fields) -> Body:
    """Nodes as bodies; between periodic sides the last column repeats the first, on a torus the last row does, too."""
    torus, whole, but_last = isinstance(fields.scene.sides, Torus), slice(None), slice(None, -1)
    own = (but_last if torus else whole, but_last if torus or fields.periodic else whole)
    x, y = np.meshgrid(fields.x[own[1]], fields.y[own[0]])
    at = fields.at
    return Body(np.stack([x.ravel(), y.ravel()], axis=1), np.stack([at.vx[own].ravel(), at.vy[own].ravel()], axis=1),
                at.rho[own].ravel())


@dataclass(frozen=True, kw_only=True)
class Steadiness(Case):
    """Does the grid at high Ra come to rest, and does a finer one?    [KHP95, Sec. VI]

    step : over the grid's own.
    """
    ra: float
    rows: int
    step: float = 1.0

    @property
    def cost(self) -> float:
        return 8e-5*self.rows**3

    @property
    def label(self) -> str:
        return f"map steadiness, Ra {self.ra:g}, {self.rows} rows"

    def run(self, report: Report, folder: Path) -> Outcome:
        scene, part = layer(self.ra), Part(report)
        key = {"ra": self.ra, "rows": self.rows, "step": self.step}
        start = initial(scene, self.rows, START_ENERGY)
        dt = self.step*SAFETY*limits(scene, block(start)).both
        try:
            done = march(scene, self.rows, until=Time(SETTLED*scene.L/scene.free_fall, 4*SAMPLES), start=start, dt=dt,
                         progress=part)
        except DivergedError:
            lost = dict.fromkeys(("k", "swing", "before"), np.nan)
            return Outcome({"steadiness": [{**key, **lost, "rolls": 0, "reached": part.done}]})
        before, late = np.split(done.series.ke[-2*SAMPLES:], 2)
        return Outcome({"steadiness": [{**key, "k": float(late.mean()), "swing": float(np.ptp(late)/late.mean()),
                                        "before": float(np.ptp(before)/before.mean()), "rolls": done.rolls, "reached": 1.0}]})


def cases(size: str) -> Iterator[Case]:
    """All of them; quick: one."""
    if size == "quick":
        scene, time = LAYERS["Prandtl 100"]
        yield Hard(case="Prandtl 100", method="fixed lattice", scene=scene, time=time/10*scene.L/scene.free_fall)
        return
    for case, (scene, time) in LAYERS.items():
        unit = scene.L/scene.free_fall
        yield from (OnGrid(case=case, scene=scene, time=time*unit, rows=rows)
                    for rows in (*GRIDS, *MORE_GRIDS.get(case, ())))
        yield from (Hard(case=case, method=method, scene=scene, time=time*unit) for method in TAKES[case])
    for case, (scene, time) in BOXES.items():
        yield from (Hard(case=case, method=method, scene=scene, time=time) for method in TAKES[case])
    corner, time = BOXES["wall corner"]
    yield OnGrid(case="wall corner", scene=corner, time=time, rows=round(corner.L))
    yield from (Steadiness(ra=ra, rows=rows) for ra in HIGH for rows in FINER)
    yield Steadiness(ra=HIGH[-1], rows=FINER[1], step=0.5)
