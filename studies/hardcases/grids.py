"""Hard cases on the compressible grid: as coarse as the points, and finer as their reference."""
from dataclasses import dataclass
from math import ceil
from pathlib import Path
from typing import Any

import numpy as np

from continuum.gas.fields import NodeFields, block, initial, placed, unblock
from continuum.gas.loop import FluxForm
from continuum.gas.solve import DivergedError, March, limits
from continuum.gas.solve import run as march
from continuum.scene import Tile, Torus
from continuum.steady import SAFETY, Time
from studies.build.grid import started
from studies.build.names import START_ENERGY
from studies.hardcases.methods import Body, Built
from studies.hardcases.points import GROWN, LATE, SAMPLES, Amplitude, Watch, growth, observed, row
from studies.hardcases.scenes import BOXES, LAYERS, ShearFlow, layer
from studies.kit.case import Case, Outcome, Report

GRID = "grid"
SETTLED = 150.0         # free-fall times after which a steady flow has long settled


# --- between plates -------------------------------------------------------------------------------


class Progress:
    """The part of a run that is done, passed on and kept."""

    def __init__(self, report: Report):
        self.report, self.done = report, 0.0

    def __call__(self, done: float) -> None:
        self.done = done
        self.report(done)


@dataclass(frozen=True, kw_only=True)
class OnGrid(Case):
    """The compressible grid in one case."""
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
        energy = START_ENERGY if self.case in LAYERS else 0.0     # else nothing moves but for round-off
        start, progress = initial(self.scene, self.rows, energy), Progress(report)
        try:
            done = march(self.scene, self.rows, until=Time(self.time, SAMPLES), start=start, progress=progress)
        except DivergedError:
            return row(self.case, GRID, {"reached": progress.done}, self.rows)
        box = (self.scene.width, self.scene.L)
        k_start, flow_start, _ = observed(of_grid(start), box)
        k_end, flow_end, _ = observed(of_grid(done.fields), box)
        k = float(done.series.ke[round(LATE*len(done.series.ke)):].mean())
        return row(self.case, GRID, {"k": k, "flow": k*flow_end/max(k_end, 1e-300), "mass_drift": done.mass_drift,
                                     "k_start": k_start, "flow_start": flow_start}, self.rows)


def of_grid(fields: NodeFields) -> Body:
    """Nodes as bodies, without columns and rows that repeat the first."""
    torus, whole, but_last = isinstance(fields.scene.sides, Torus), slice(None), slice(None, -1)
    rows, columns = but_last if torus else whole, but_last if torus or fields.periodic else whole
    x, y = np.meshgrid(fields.x[columns], fields.y[rows])
    vx, vy, rho = (q[rows, columns].ravel() for q in (fields.at.vx, fields.at.vy, fields.at.rho))
    return Body(np.stack([x.ravel(), y.ravel()], axis=1), np.stack([vx, vy], axis=1), rho)


@dataclass(frozen=True, kw_only=True)
class Steadiness(Case):
    """Does the grid at high Ra come to rest, and does a finer one?    [KHP95, Sec. VI]"""
    ra: float
    rows: int

    @property
    def cost(self) -> float:
        return 8e-5*self.rows**3

    @property
    def label(self) -> str:
        return f"map steadiness, Ra {self.ra:g}, {self.rows} rows"

    def run(self, report: Report, folder: Path) -> Outcome:
        scene, progress = layer(self.ra), Progress(report)
        start = initial(scene, self.rows, START_ENERGY)
        until = Time(SETTLED*scene.L/scene.free_fall, 4*SAMPLES)
        key = {"ra": self.ra, "rows": self.rows}
        try:
            done = march(scene, self.rows, until=until, start=start, progress=progress)
        except DivergedError:
            unknown = dict.fromkeys(("k", "swing", "before"), np.nan)
            return Outcome({"steadiness": [{**key, **unknown, "rolls": 0, "reached": progress.done}]})
        before, late = np.split(done.series.ke[-2*SAMPLES:], 2)
        return Outcome({"steadiness": [{**key, "k": float(late.mean()), "swing": swing(late), "before": swing(before),
                                        "rolls": done.rolls, "reached": 1.0}]})


def swing(k: np.ndarray) -> float:
    """Largest less smallest over the mean."""
    return float(np.ptp(k)/k.mean())


# --- without plates -------------------------------------------------------------------------------


class Going:
    """A grid that has started in a periodic box."""

    def __init__(self, scene: Any):
        self.rows, self.tile = round(scene.L), Tile(width=scene.width, L=scene.L, eos=scene.eos, law=scene.law)
        start = placed(self.tile, self.rows, lambda x, y: started(scene, x, y))
        # the ghosts of a block are filled by its march
        self.first = March(self.tile, block(start), FluxForm(), 1.0).S

    @property
    def built(self) -> Built:
        """As those who look at points want it."""
        return Built(None, self.first, SAFETY*limits(self.tile, self.first).both, lambda S: of_grid(unblock(self.tile, S)))

    def go(self, time: float, samples: int, look: Any, report: Report) -> float:
        """The part of the time that was reached; look(None, block) at the end of each sample."""
        every = ceil(time/samples/self.built.dt)
        march = March(self.tile, self.first.copy(), FluxForm(), time/samples/every)
        for sample in range(samples):
            try:
                march.go(every)
            except DivergedError:
                return march.steps/(every*samples)
            look(None, march.S)
            report((sample + 1)/samples)
        return 1.0


@dataclass(frozen=True, kw_only=True)
class OnTorus(Case):
    """The grid in a box whose points have no plates either."""
    case: str

    @property
    def cost(self) -> float:
        return 2.0

    @property
    def label(self) -> str:
        return f"map {self.case}, {GRID}"

    def run(self, report: Report, folder: Path) -> Outcome:
        scene, time = BOXES[self.case]
        grid = Going(scene)
        watch = Watch(grid.built, (scene.width, scene.L))
        reached = grid.go(time, SAMPLES, watch, report)
        unknown = {} if reached == 1 else {"k": np.nan, "flow": np.nan}
        return row(self.case, GRID, {**watch.late, **unknown, "reached": reached}, grid.rows)


@dataclass(frozen=True, kw_only=True)
class Sheared(Case):
    """The growth of the wave on a shear flow."""

    @property
    def cost(self) -> float:
        return 2.0

    @property
    def label(self) -> str:
        return f"map shear layer, {GRID}"

    def run(self, report: Report, folder: Path) -> Outcome:
        scene = ShearFlow()
        time, grid = GROWN/scene.wave.rate, Going(scene)
        seen = Amplitude(grid.built, scene.k/2)
        return growth(GRID, scene, time, seen, grid.go(time, SAMPLES, seen, report))
