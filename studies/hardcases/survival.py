"""Does a method come through a hard case, and with which K, flow and mass? Points, and grids beside them."""
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from math import ceil
from pathlib import Path
from types import MappingProxyType
from typing import Any, NamedTuple

import numpy as np
import pandas as pd

from continuum.gas.fields import NodeFields, at_nodes, initial
from continuum.gas.solve import DivergedError, Solution
from continuum.gas.solve import run as march
from continuum.steady import Time
from particles.fields import Fields, kinetic_energy
from particles.plan import Quantity
from particles.run import Divergence, Plan, run
from studies.build.names import START_ENERGY
from studies.build.setting import Ready
from studies.hardcases.extremes import CHESSBOARD, RATE, SHEAR_FLOW, WAVE_NUMBER, Open
from studies.kit.case import Case, Outcome, Report
from studies.kit.fits import line

SAMPLES, LATE = 60, 2/3  # of a run; means are over the last third
SPACINGS = 4            # of a cell over which velocities are averaged: what is left is flow, the rest noise
GROWN, INSTANTS = 2.5, 50       # growth times of a wave on a shear flow, which ends with a tenth of U
GRID = "grid"
Look = Callable[[Any], Any]
Row = dict[str, float]


class Course(NamedTuple):
    """What was seen, at the start and after each sample, (samples + 1, numbers); part of the time reached;
    what was watched at each sample, of a run that has come to its end."""
    seen: np.ndarray
    reached: float = 1.0
    watched: Mapping[str, list[float]] = MappingProxyType({})


def followed(ready: Ready, time: float, samples: int, look: Look, report: Report | None = None,
             watch: Mapping[str, Quantity] = MappingProxyType({})) -> Course:
    """Any method; `look` takes its fields, quantities to `watch` its sums and its state."""
    method, seen = ready.method, [look(ready.method.fields(ready.start))]

    def see(sums: Any, state: np.ndarray) -> float:
        seen.append(look(method.fields(state)))
        return 0.0
    every = ceil(time/ready.dt/samples)
    steps = every*samples
    plan = Plan(dt=time/steps, steps=steps, series={"seen": see, **watch}, every=every)
    try:
        done = run(method, ready.start, plan, report)
    except Divergence as error:
        return Course(np.array(seen), error.step/steps)
    return Course(np.array(seen), watched=done.series)


def between_plates(start: NodeFields, time: float, samples: int, report: Report,
                   dt: float | None = None) -> tuple[Solution | None, float]:
    """The compressible grid from a start, None if it diverged; the part of the time reached."""
    reached, rows = [0.0], len(start.y) - 1

    def progress(done: float) -> None:
        reached.append(done)
        report(done)
    try:
        return march(start.scene, rows, until=Time(time, samples), start=start, dt=dt, progress=progress), 1.0
    except DivergedError:
        return None, reached[-1]


def flow(at: Fields, box: tuple[float, float]) -> float:
    """K per mass of mean velocities in cells of SPACINGS, which have no noise between neighbours."""
    size, m = np.array(box), at.rho*at.V
    cells = np.maximum(1, np.round(size/SPACINGS)).astype(int)
    place = np.clip(((at.x/size + 0.5)*cells).astype(int), 0, cells - 1)
    sums = pd.DataFrame({"m": m, "px": m*at.v[:, 0], "py": m*at.v[:, 1]}).groupby(list(place.T)).sum()
    energy = (sums.px**2 + sums.py**2)/sums.m/2
    return float(energy.sum()/sums.m.sum())


def energies(scene: Any) -> Look:
    """K and the flow's per mass, and the mass."""
    box = scene.width, scene.L

    def look(at: Fields) -> tuple[float, float, float]:
        return kinetic_energy(at), flow(at, box), float((at.rho*at.V).sum())
    return look


def of_grid(fields: NodeFields) -> Fields:
    """Nodes of one mass each, those in plates too."""
    at = at_nodes(fields)
    return at._replace(V=np.ones_like(at.rho))


def amplitude(at: Fields) -> float:
    """Size of v exp(-i k_x x), the mean over the mass, of the wave on the shear flow."""
    wave, m = np.exp(-1j*WAVE_NUMBER/2*at.x[:, 0]), at.rho*at.V
    return float(abs(np.sum(m*at.v[:, 1]*wave))/m.sum())


def row(case: str, method: str, rows: int, **values: Any) -> Outcome:
    """One row of `hard_runs`; what is not given is not known."""
    known = {"case": case, "method": method, "rows": rows, "reached": 1.0, "refused": ""}
    return Outcome({"hard_runs": [{**known, **values}]})


@dataclass(frozen=True, kw_only=True)
class Hard(Case):
    """One method in one case; if it refuses, a row that says why.

    variant : has ready(scene). time : in the units of the scene.
    """
    case: str
    method: str
    variant: Any
    scene: Any
    time: float

    @property
    def label(self) -> str:
        return f"map {self.case}, {self.method}, L {self.scene.L:g}"

    def run(self, report: Report, folder: Path) -> Outcome:
        rows = round(self.scene.L)
        try:
            ready = self.variant.ready(self.scene)
        except (ValueError, ArithmeticError) as error:
            refused = f"{type(error).__name__}: {str(error)[:60]}"
            return row(self.case, self.method, rows, reached=0.0, refused=refused)
        course = followed(ready, self.time, SAMPLES, energies(self.scene), report)
        return row(self.case, self.method, rows, **late(course))


def late(course: Course) -> Row:
    """Means over the last third, if it was reached; the mass, and what there was at the start."""
    k, moves, mass = course.seen.T
    last = min(round(LATE*len(k)), len(k) - 1)
    means = {"k": k[last:].mean(), "flow": moves[last:].mean()} if course.reached == 1 else {}
    return {**means, "mass_drift": mass[-1]/mass[0] - 1, "k_start": k[0], "flow_start": moves[0],
            "reached": course.reached}


@dataclass(frozen=True, kw_only=True)
class HardOnGrid(Case):
    """The compressible grid between plates in one case."""
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
        start, look = initial(self.scene, self.rows, START_ENERGY), energies(self.scene)
        done, reached = between_plates(start, self.time, SAMPLES, report)
        if done is None:
            return row(self.case, GRID, self.rows, reached=reached)
        (k_start, flow_start, _), (k_end, flow_end, _) = look(of_grid(start)), look(of_grid(done.fields))
        k = done.series.ke[round(LATE*len(done.series.ke)):].mean()
        return row(self.case, GRID, self.rows, k=k, flow=k*flow_end/max(k_end, 1e-300),
                   mass_drift=done.mass_drift, k_start=k_start, flow_start=flow_start)


# --- numbers that are known ---------------------------------------------------------------------------------

def growth(scene: Any, variant: Any, report: Report) -> Row:
    """The rate of the wave on the shear flow."""
    time = GROWN/RATE
    seen, reached, _ = followed(variant.ready(Open(scene)), time, INSTANTS, amplitude, report)
    row = {"predicted": RATE, "reached": reached}
    if reached < 1:
        return row
    rate, err = line(np.linspace(0, time, len(seen)), np.log(seen)).slope
    return row | {"measured": rate, "measured_err": err}


class Kept(NamedTuple):
    """What is left of what `look` sees in the last third, over that of the start."""
    look: Look
    predicted: float
    time: float

    def __call__(self, scene: Any, variant: Any, report: Report) -> Row:
        seen, reached, _ = followed(variant.ready(Open(scene)), self.time, SAMPLES, self.look, report)
        left = seen[round(LATE*len(seen)):].mean()/seen[0] if reached == 1 else np.nan
        return {"predicted": self.predicted, "measured": left, "measured_err": 0.0, "reached": reached}


def unevenness(at: Fields) -> float:
    """Rms deviation of densities from their mean."""
    return float(np.sqrt(at.V@(at.rho - 1)**2/at.V.sum()))


class Question(NamedTuple):
    """A scene without its plates, ask(scene, variant, report), and the number's name."""
    scene: Any
    ask: Any
    number: str


PROBES = {
    "shear layer": Question(SHEAR_FLOW, growth, "growth/linear"),
    "alternating densities": Question(CHESSBOARD, Kept(unevenness, 0.0, 300.0), "left/start"),
}


@dataclass(frozen=True, kw_only=True)
class Probe(Case):
    """One number that is known, by one method; fields as of `Hard`."""
    case: str
    method: str
    variant: Any
    question: Question

    @property
    def label(self) -> str:
        return f"map {self.case}, {self.method}"

    def run(self, report: Report, folder: Path) -> Outcome:
        row = self.question.ask(self.question.scene, self.variant, report)
        return Outcome({"probes": [{"case": self.case, "method": self.method, **row}]})
