"""CPU seconds of one step of each method, measured while no other case runs."""
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from time import process_time
from typing import ClassVar

import numpy as np

from continuum.gas.fields import block, initial
from continuum.gas.loop import FluxForm
from continuum.gas.solve import March, choose_step
from continuum.scene import RayleighBenard
from particles.run import Plan, run
from studies.build.names import scene_columns
from studies.build.spam import PRINTED, Variant
from studies.kit.case import Case, Outcome, Report
from studies.kit.timing import REPEATS, SPREAD_TO_ERR, Seconds, median_seconds


@dataclass(frozen=True, kw_only=True)
class SpamStep(Case):
    """A particle step with list upkeep, in the developing rolls of the start."""
    scene: RayleighBenard
    variant: Variant = PRINTED
    alone: ClassVar[bool] = True

    @property
    def cost(self) -> float:
        return 32*max(40000, 10*self.scene.L**2*self.scene.aspect)*4*300e-9 + 4

    def run(self, report: Report, folder: Path) -> Outcome:
        method, start, dt = self.variant.ready(self.scene)
        warm, particles = run(method, start, Plan(dt=dt, steps=50)), start.shape[1]
        steps = max(10, round(40000/particles))
        # the difference of two lengths leaves out what every run pays once: lists, first evaluation, limit
        runs = [partial(run, method, warm.state, Plan(dt=dt, steps=n)) for n in (steps, 3*steps)]
        short, long = (median_seconds(one, REPEATS, process_time) for one in runs)
        seconds = Seconds(long.median - short.median, float(np.hypot(long.spread, short.spread)))
        point = {"method": "spam", "variant": self.variant.name, "resolution": round(self.scene.L)}
        return Outcome({"cost": [{**point, **of_step(self.scene, particles, dt, seconds, 2*steps)}]})


@dataclass(frozen=True, kw_only=True)
class CompressibleStep(Case):
    """A step of the compressible grid."""
    scene: RayleighBenard
    rows: int
    alone: ClassVar[bool] = True

    @property
    def cost(self) -> float:
        return 1e-4*self.rows**2 + 2

    def run(self, report: Report, folder: Path) -> Outcome:
        cells = block(initial(self.scene, self.rows))
        march = March(self.scene, cells, FluxForm(), choose_step(self.scene, cells, None))
        steps, points = max(10, 400000//self.rows**2), self.rows**2*round(self.scene.aspect)
        seconds = median_seconds(partial(march.go, steps), REPEATS, process_time)
        point = {"method": "compressible", "variant": "flux-form", "resolution": self.rows}
        return Outcome({"cost": [{**point, **of_step(self.scene, points, march.dt, seconds, steps)}]})


def of_step(scene: RayleighBenard, points: int, dt: float, seconds: Seconds, steps: int) -> dict:
    """Columns of the table `cost`."""
    where = scene_columns(scene)
    return {"eos": where["eos"], "sides": where["sides"], "points": points, "step_s": seconds.median/steps,
            "step_s_err": seconds.spread*SPREAD_TO_ERR/steps, "dt": dt, "threads": 1}
