"""The highest Rayleigh number that 16 rows bear: KHP95's layer, followed for 50 free-fall times.

A run is wrong if it ends early, or if K of its last third differs by more than the factor OFF from that of a
grid of 48 rows at the same Ra. The map calls a tenth wrong, of flow at Ra 1e5 and 1e6; grids of 16 and of 96
rows differ by a tenth in K at Ra 1e5, so that OFF leaves room for as much again. Ra is raised by half decades
until a run is wrong, and further until one ends; then the interval is halved on the scale of the cell number
v a/nu of the free-fall velocity, (Ra/Pr)^(1/2)/16. K is judged up to Ra 1e6 only, since the fine grid is not
known to reach its end beyond. All is repeated with shorter steps, since v grows after the step is chosen.
"""
from collections.abc import Callable
from dataclasses import dataclass, field, replace
from functools import cache
from math import log
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from continuum.gas.fields import block, initial
from continuum.gas.solve import step_limit
from continuum.steady import SAFETY
from particles.fields import kinetic_energy
from studies.build.fixed import OF_LIMIT, Scheme
from studies.build.names import START_ENERGY
from studies.build.setting import Ready, bisected, stepped
from studies.hardcases.extremes import ROWS, falls, late, layer
from studies.hardcases.runs import SAMPLES, between_plates, followed
from studies.kit.case import Case, Outcome, Report

OFF = 1.25              # factor in K beyond which a run is wrong
STEPS = (1.0, 0.25)     # time steps over those of other studies
FINE = 48               # rows of the reference grid
RUNGS = tuple(float(f"{10.0**(n/2):.9g}") for n in range(8, 17))        # 1e4 .. 1e8
KNOWN = 1e6             # Ra up to which K is compared with the fine grid
TIME = 50.0             # free-fall times, as in the map
NOISE = 1e-6            # relative noise of the start, by which seeds differ where points do not


class Attempt(NamedTuple):
    """Mean K of the last third of a run, nan if it ended early, and the part of the time that it reached."""
    k: float
    reached: float


def ripple(seed: int, *shape: int) -> np.ndarray:
    """Random factors, 1 with relative noise NOISE."""
    return 1 + NOISE*np.random.default_rng(seed).standard_normal(shape)


def rippled(scheme: Scheme, scene: Any, seed: int) -> Ready:
    """Fixed points whose start has relative noise NOISE."""
    method, start, _ = scheme.ready(scene, seed)
    return stepped(method, start*ripple(seed, len(method.x)), OF_LIMIT)


def on_points(variant: Any, ra: float, seed: int, step: float) -> Attempt:
    """Run fixed or moving points at one Ra. variant : has ready(scene, seed)."""
    scene = layer(ra)
    ready = variant.ready(scene, seed)
    seen, reached, _ = followed(ready._replace(dt=step*ready.dt), falls(scene, TIME), SAMPLES, kinetic)
    return Attempt(np.mean(seen[late(seen)]) if reached == 1 else np.nan, reached)


def kinetic(method: Any, state: np.ndarray) -> float:
    """Kinetic energy per mass."""
    return kinetic_energy(method.fields(state))


def on_grid(rows: int, ra: float, seed: int, step: float) -> Attempt:
    """Run the compressible grid at one Ra."""
    scene = layer(ra)
    start = initial(scene, rows, START_ENERGY)
    dt = step*SAFETY*step_limit(scene, block(start))
    start = replace(start, cells=start.cells*ripple(seed, *start.cells.shape))
    done, reached = between_plates(start, falls(scene, TIME), lambda part: None, dt)
    return Attempt(done.series.ke[late(done.series.ke)].mean() if done else np.nan, reached)


@cache
def reference() -> dict[float, Attempt]:
    """Runs of the fine grid at the Ra of RUNGS up to KNOWN."""
    return {ra: on_grid(FINE, ra, 1, 1.0) for ra in RUNGS if ra <= KNOWN}


def should_be(ra: float) -> float:
    """K of the fine grid, linear between RUNGS in Ra^(-1/2)    [KHP95, Sec. VI]; nan beyond KNOWN."""
    if ra > KNOWN*(1 + 1e-9):
        return np.nan
    x, k = np.array([(rung**-0.5, run.k) for rung, run in reference().items()]).T
    return float(np.interp(ra**-0.5, x[::-1], k[::-1]))


@dataclass
class Search:
    """Search for limits of Ra. trials : Ra -> result of attempt(ra), which is called once for each Ra."""
    attempt: Callable[[float], Attempt]
    trials: dict[float, Attempt] = field(default_factory=dict)

    def at(self, ra: float) -> Attempt:
        """The run at a Rayleigh number, which is rounded to nine digits so that RUNGS are found again."""
        ra = float(f"{ra:.9g}")
        if ra not in self.trials:
            self.trials[ra] = self.attempt(ra)
        return self.trials[ra]

    def ends(self, ra: float) -> bool:
        """Whether the run at this Ra ends early."""
        return self.at(ra).reached < 1

    def wrong(self, ra: float) -> bool:
        """Whether the run ends early, or its K is off by more than the factor OFF."""
        return self.ends(ra) or abs(log(self.at(ra).k/should_be(ra))) > log(OFF)

    def seek(self, bad: Callable[[float], bool], most: float) -> None:
        """Try RUNGS up to the first bad run, and halve the interval below it."""
        ra = next((ra for ra in RUNGS if ra <= most and bad(ra)), None)
        if ra is not None:
            bisected(lambda cell: bad((ROWS*cell)**2), ra**0.5/ROWS)

    def limit(self, bad: Callable[[float], bool], most: float) -> dict[str, Any]:
        """Interval between the lowest bad trial up to `most` and the trial below; good ones may lie above."""
        tried = sorted(ra for ra in self.trials if ra <= most)
        first = next((n for n, ra in enumerate(tried) if bad(ra)), None)
        if first is None:
            return {"ra": np.nan, "ra_err": np.nan, "tried": tried[-1], "outcome": "none"}
        low, high = tried[max(first - 1, 0)], tried[first]
        return {"ra": (low*high)**0.5, "ra_err": (high - low)/2, "tried": tried[-1],
                "outcome": "ends" if self.ends(high) else "wrong but stable"}


@dataclass(frozen=True, kw_only=True)
class HighRa(Case):
    """Limits of Ra of one method from one start.

    attempt : takes variant, Ra, seed, step and makes a run. step : over that of other studies.
    """
    method: str
    attempt: Callable[..., Attempt]
    variant: Any
    seed: int
    step: float = STEPS[0]

    @property
    def cost(self) -> float:
        return (60.0 if self.method == "moving" else 10.0)/self.step

    @property
    def label(self) -> str:
        return f"high Ra, {self.method}, seed {self.seed}, step {self.step:g}"

    def run(self, report: Report, folder: Path) -> Outcome:
        search = Search(lambda ra: self.attempt(self.variant, ra, self.seed, self.step))
        kinds = {"wrong": (search.wrong, KNOWN), "ends": (search.ends, RUNGS[-1])}
        for bad, most in kinds.values():
            search.seek(bad, most)
        key = {"method": self.method, "step": self.step, "seed": self.seed}
        rows = [{**key, "kind": kind, **search.limit(*question)} for kind, question in kinds.items()]
        trials = [{**key, "ra": ra, "k": run.k, "over": run.k/should_be(ra), "reached": run.reached}
                  for ra, run in search.trials.items()]
        return Outcome({"high_ra": rows, "high_ra_trials": trials})
