"""Why runs at Prandtl number 0.01 end before their time: step, viscosity or speed?

The flow at Ra 10 000 is driven by a conductivity a hundred times its viscosity and speeds up to the end: a step that was
allowed at the start need not be allowed later, and viscosity does not reach from point to point (v a/nu is far above 2).
"""
from collections.abc import Iterator
from dataclasses import dataclass
from math import ceil
from pathlib import Path
from typing import Any

import numpy as np

from continuum.scene import RayleighBenard
from particles.limits import limit_of
from particles.run import Divergence, Plan, run
from studies.build.read import Value, select
from studies.hardcases.map.methods import USUAL, Built
from studies.hardcases.map.scenes import LAYERS, SOUND
from studies.kit.case import Case, Outcome, Report
from studies.kit.claim import Claim
from studies.kit.stats import Measured
from studies.kit.table import Table, Tables

CASE = "Prandtl 0.01"
LOOKS = 200             # at a run
NEARLY = 0.95           # of the time that it ran: before what ends it has grown
FIXED = ("fixed lattice", "fixed nested", "fixed jittered")
HALF, VISCOUS = 0.5, 0.03       # of the step; Prandtl number at the same Ra
KEY = ["method", "pr", "rows", "step"]
#: step: over the map's; reached: part of the time; after NEARLY of what was reached: speed: the largest over that of sound at
#: T = 1; cell_re: the same speed times spacing over viscosity; beyond: largest step over limit until then
ENDS = Table("map_ends", key=KEY, columns=[*KEY, "reached", "speed", "cell_re", "beyond"])


class Look:
    """Largest speed, and the step over the longest that the method allows, in time."""

    def __init__(self, built: Built, dt: float):
        self.built, self.dt = built, dt
        self.found: list[tuple[float, float]] = []

    def __call__(self, sums: Any, state: np.ndarray) -> float:
        speed = float(np.hypot(*self.built.body(state).v.T).max())
        self.found.append((speed, self.dt/limit_of(self.built.method, state)))
        return speed


@dataclass(frozen=True, kw_only=True)
class Ending(Case):
    """One method at a Prandtl number. rows : over the height. step : over the map's."""
    method: str
    pr: float = 0.01
    rows: int = 16
    step: float = 1.0

    @property
    def cost(self) -> float:
        return (4.0 if self.method == "moving" else 1.0)*(self.rows/16)**3/self.step

    @property
    def label(self) -> str:
        return f"map ends, {self.method}, Pr {self.pr:g}, {self.rows} rows, step x {self.step:g}"

    def run(self, report: Report, folder: Path) -> Outcome:
        like, units = LAYERS[CASE]
        scene = RayleighBenard(ra=like.ra, pr=self.pr, L=float(self.rows), T_hot=like.T_hot, T_cold=like.T_cold)
        built, time = USUAL[self.method](scene=scene), units*scene.L/scene.free_fall
        every = ceil(time/(self.step*built.dt)/LOOKS)
        steps, reached = every*LOOKS, 1.0
        look = Look(built, time/steps)
        try:
            run(built.method, built.start, Plan(dt=time/steps, steps=steps, series={"v": look}, every=every), report)
        except Divergence as error:
            reached = error.step/steps
        speed, beyond = np.array(look.found[:ceil(NEARLY*len(look.found))]).T
        return Outcome({"map_ends": [{"method": self.method, "pr": self.pr, "rows": self.rows, "step": self.step,
                                      "reached": reached, "speed": float(speed[-1]/SOUND), "cell_re": float(speed[-1]/scene.nu),
                                      "beyond": float(beyond.max())}]})


def cases(size: str) -> Iterator[Case]:
    """Half of the step; three times the viscosity over the conductivity; twice as many rows."""
    if size != "quick":
        yield from (Ending(method=method, step=step) for method in (*FIXED, "moving") for step in (1.0, HALF))
        yield from (Ending(method=method, pr=VISCOUS) for method in FIXED)
        yield Ending(method=FIXED[0], rows=32)


def sooner(tables: Tables) -> Measured:
    """Largest |time with half of the step/time with all of it - 1| of fixed points."""
    rows = select(tables, "map_ends", pr=0.01, rows=16)
    whole, half = (rows[rows["step"] == step].set_index("method")["reached"].loc[list(FIXED)] for step in (1.0, HALF))
    return Measured(float((half/whole - 1).abs().max()), 0.0)


def least(column: str, **where) -> Value:
    """Smallest number of some rows."""
    return lambda tables: Measured(float(select(tables, "map_ends", **where)[column].min()), 0.0)


def viscous(tables: Tables) -> Measured:
    """Part of the time, the least of fixed points, at the higher Prandtl number."""
    return least("reached", pr=VISCOUS)(tables)


ENDED = "[asked after runs at Prandtl 0.01 had ended]"
CLAIMS = (
    Claim(id="map-prandtl-0.01-fixed-step", source="RR98 Eqs 34-36", value=sooner, at_most=0.01,
          statement=f"where fixed points end at Prandtl 0.01 does not hang on the step: time with half of it over time with all, "
                    f"largest difference from 1, three sets of points {ENDED}", because="1 %: what ends them grows in 3 % of it"),
    Claim(id="map-prandtl-0.03-fixed", source="RR98 Eqs 34-36", value=viscous, at_least=1.0,
          statement=f"at the same Ra and Prandtl 0.03, where v a/nu is half as large and the flow slower, fixed points come "
                    f"to the end: least part of the time, three sets of points {ENDED}", because="1 is the end"),
    Claim(id="map-prandtl-0.01-fixed-rows", source="RR98 Eqs 34-36", value=least("reached", rows=32), at_least=1.0,
          statement=f"with 32 rows, whose v a/nu is half as large, points on a lattice come to the end at Prandtl 0.01 {ENDED}",
          because="1 is the end"),
    Claim(id="map-prandtl-0.01-moving-step", source="RR98 Eqs 46-48", value=least("reached", method="moving", step=HALF),
          at_least=1.0, because="1 is the end",
          statement=f"moving points come to the end at Prandtl 0.01 with half of the step {ENDED}"),
    Claim(id="map-prandtl-0.01-moving-limit", source="RR98 Eqs 46-48", value=least("beyond", method="moving", step=1.0),
          at_least=1.0, because="1 is the longest that the formula allows",
          statement=f"the step at which moving points end, allowed by their formula at the start, is not allowed when the flow "
                    f"has sped up: step over limit {ENDED}"),
)
