"""Hard cases on points: K, flow and mass of one method in one case, and the growth of a wave on a shear flow.
"""
from dataclasses import dataclass
from math import ceil
from pathlib import Path
from typing import Any

import numpy as np

from particles.run import Divergence, Plan, run
from studies.hardcases.methods import SHEARED, TAKES, Body, Built, flow, kinetic
from studies.hardcases.scenes import Open, ShearFlow
from studies.kit.case import Case, Outcome, Report
from studies.kit.fits import line

SAMPLES = 60            # of a run; means are over the last third
LATE = 2/3
GROWN = 2.5             # growth times that a shear flow is watched: its wave ends with a tenth of U
LOOKS = 50              # at it


class Watch:
    """K, flow and mass in time, kept also when a run does not come to its end."""

    def __init__(self, built: Built, box: tuple[float, float]):
        self.built, self.box = built, box
        self.values = [observed(built.body(built.start), box)]

    def __call__(self, sums: Any, state: np.ndarray) -> float:
        self.values.append(observed(self.built.body(state), self.box))
        return self.values[-1][0]

    @property
    def late(self) -> dict[str, float]:
        """Means over the last third, the mass, and what there was at the start."""
        k, moves, mass = np.array(self.values).T
        late = slice(min(round(LATE*len(k)), len(k) - 1), None)
        return {"k": float(k[late].mean()), "flow": float(moves[late].mean()), "mass_drift": float(mass[-1]/mass[0] - 1),
                "k_start": float(k[0]), "flow_start": float(moves[0])}


def observed(body: Body, box: tuple[float, float]) -> tuple[float, float, float]:
    """K and the flow's per mass, mass."""
    return kinetic(body), flow(body, box), float(body.m.sum())


def row(case: str, method: str, values: dict[str, Any], rows: int) -> Outcome:
    """One row of `hard_runs`; what is not given is not known."""
    empty = dict.fromkeys(("k", "flow", "mass_drift", "k_start", "flow_start"), np.nan)
    key = {"case": case, "method": method, "rows": rows}
    return Outcome({"hard_runs": [{**key, **empty, "reached": 1.0, "refused": "", **values}]})


@dataclass(frozen=True, kw_only=True)
class Hard(Case):
    """One method in one case. time : in the units of the scene.

    A method that refuses leaves a row that says why.
    """
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

    def run(self, report: Report, folder: Path) -> Outcome:
        rows = round(self.scene.L)
        try:
            built = TAKES[self.case][self.method](scene=self.scene)
        except (ValueError, ArithmeticError) as error:
            refused = f"{type(error).__name__}: {str(error)[:60]}"
            return row(self.case, self.method, {"reached": 0.0, "refused": refused}, rows)
        every = ceil(self.time/built.dt/SAMPLES)
        steps, watch = every*SAMPLES, Watch(built, (self.scene.width, self.scene.L))
        plan = Plan(dt=self.time/steps, steps=steps, series={"k": watch}, every=every)
        try:
            run(built.method, built.start, plan, report)
        except Divergence as error:
            ended = {"k": np.nan, "flow": np.nan, "reached": error.step/steps}
            return row(self.case, self.method, {**watch.late, **ended}, rows)
        return row(self.case, self.method, watch.late, rows)


# --- the shear flow -------------------------------------------------------------------------------


class Amplitude:
    """Size of v exp(-i k_x x), the mean over the mass, in time."""

    def __init__(self, built: Built, kx: float):
        self.built, self.kx = built, kx
        self.values = [amplitude(built.body(built.start), kx)]

    def __call__(self, sums: Any, state: np.ndarray) -> float:
        self.values.append(amplitude(self.built.body(state), self.kx))
        return self.values[-1]


def amplitude(body: Body, kx: float) -> float:
    """Of one state."""
    wave = np.exp(-1j*kx*body.x[:, 0])
    return float(abs(np.sum(body.m*body.v[:, 1]*wave))/body.m.sum())


@dataclass(frozen=True, kw_only=True)
class Shear(Case):
    """The growth rate by one method."""
    method: str

    @property
    def cost(self) -> float:
        return 3.0

    @property
    def label(self) -> str:
        return f"map shear layer, {self.method}"

    def run(self, report: Report, folder: Path) -> Outcome:
        scene = ShearFlow()
        built, time = SHEARED[self.method](scene=Open(scene)), GROWN/scene.wave.rate
        every = int(np.ceil(time/built.dt/LOOKS))
        seen, reached = Amplitude(built, scene.k/2), 1.0
        plan = Plan(dt=time/every/LOOKS, steps=every*LOOKS, series={"v": seen}, every=every)
        try:
            run(built.method, built.start, plan, report)
        except Divergence as error:
            reached = error.step/plan.steps
        return growth(self.method, scene, time, seen, reached)


def growth(method: str, scene: ShearFlow, time: float, seen: Amplitude, reached: float) -> Outcome:
    """The row of a run."""
    rate = err = np.nan
    if reached == 1:
        rate, err = line(np.linspace(0, time, len(seen.values)), np.log(seen.values)).slope
    return Outcome({"shear": [{"method": method, "predicted": scene.wave.rate, "measured": rate, "measured_err": err,
                               "reached": reached}]})
