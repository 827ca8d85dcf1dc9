"""All methods in all cases of `columns`: two sizes, three starts where chance places points, two steps."""
from collections.abc import Iterator
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np

from particles.fields import Fields
from particles.integral.positive import switched
from studies.build import ready, variant
from studies.build.answers import of_one_mass, with_rows
from studies.build.scenes import Start
from studies.build.setting import Ready
from studies.build.spam import Variant
from studies.hardcases.columns import COLUMNS
from studies.hardcases.robust import BLENDED, HELD, ROOMY, SAMPLES, STABLE, Strip
from studies.hardcases.survival import followed
from studies.kit.case import Case, Outcome, Report

#: of those of smooth particles that today's practice has, the one that is consistent
WITHOUT = ("grid", "fixed-lattice", "fixed-jittered-delaunay", "moving-delaunay", "moving", "spam",
           "spam-corrected")
METHODS = (*WITHOUT, *STABLE)
SEEDS, STEPS = (1, 2, 3), (1.0, 0.5)
#: of the flux at SAMPLES instants; the last two are counts so far
WATCHED = {"switched": switched, "halved": lambda sums, state: sums.refused,
           "limited": lambda sums, state: sums.limited}
#: method, column -> more sizes
LARGER = {**{(name, "Sod"): (200,) for name in STABLE}, (STABLE[0], "Sod"): (200, 400),
          (STABLE[0], "Mach 10"): (400,), (HELD, "Mach 3 body"): (192,),
          **{(name, "shocked ripple"): (800,) for name in (STABLE[0], BLENDED)}}


@dataclass(frozen=True)
class Swift:
    """A scene at rest, so hot that sound is as fast as what the scene will have."""
    scene: Any

    def __getattr__(self, name: str) -> Any:
        return getattr(self.scene, name)

    @property
    def T_hot(self) -> float:
        return float(self.scene.fastest)**2/(1 + 1/self.scene.eos.cv)

    def fields(self, x: np.ndarray) -> Start:
        one = np.ones(len(x))
        return one, np.zeros((len(x), 2)), self.T_hot*one


def prepared(method: str, scene: Any, seed: int, step: float) -> Ready:
    """With the usual step of the fastest flow to come; `step` : over it."""
    x, _ = of_one_mass(scene, seed) if isinstance(variant(method), Variant) else (None, None)
    places, takes = {} if x is None else {"x": x}, getattr(scene, "takes", {}).get(method, method)
    made, swift = (ready(one, takes, seed, **places) for one in (scene, Swift(scene)))
    flat = made.start.reshape(len(made.start), -1)      # of a block of the grid
    return Ready(made.method, flat, step*min(made.dt, swift.dt))


@dataclass(frozen=True, kw_only=True)
class Trial(Case):
    """One method in one case, so many rows or cells, one start; a step over the usual one."""
    case: str
    scene: Any
    method: str
    rows: int
    seed: int = 1
    step: float = 1.0

    @property
    def cost(self) -> float:
        return 1e-3*self.rows**2/self.step

    @property
    def label(self) -> str:
        return f"{self.case}, {self.method}, {self.rows} rows, seed {self.seed}, step {self.step:g}"

    def run(self, report: Report, folder: Path) -> Outcome:
        key = {name: getattr(self, name) for name in ("case", "method", "rows", "seed", "step")}
        row, scene = {**key, "reached": 0.0, "refused": ""}, with_rows(self.scene, self.rows)
        try:
            made = prepared(self.method, scene, self.seed, self.step)
        except (ValueError, ArithmeticError) as error:
            return Outcome({"trials": [row | {"refused": f"{type(error).__name__}: {str(error)[:60]}"}]})
        seen: list[Fields] = []

        def look(at: Fields) -> None:
            seen.append(at._make(map(np.copy, at)))     # type: ignore[call-arg, arg-type]
        watch: dict[str, Any] = WATCHED if "entropy-stable" in self.method else {}
        samples = SAMPLES if watch else 1
        course = followed(made, scene.time, samples, look, report, watch)
        row["reached"] = course.reached
        if watch and course.watched:
            share, *counts = (course.watched[name] for name in WATCHED)
            row |= dict(zip(WATCHED, (float(np.mean(share)), *(count[-1] for count in counts))))
        return Outcome({"trials": [row | (scene.seen(seen[0], seen[-1]) if course.reached == 1 else {})]})


def cases() -> Iterator[Case]:
    """Starts and steps at the smaller size, one each at others."""
    for case, column in COLUMNS.items():
        for method in column.only or METHODS:
            roomy = method == STABLE[-1] and isinstance(column.scene, Strip)
            scene = replace(column.scene, L=ROOMY) if roomy else column.scene
            common: dict[str, Any] = {"case": case, "scene": scene, "method": method}
            small, *large = *column.sizes, *LARGER.get((method, case), ())
            chance = "lattice" not in method and method != "grid"
            for seed in SEEDS[:3 if chance and not column.only else 1]:
                yield Trial(**common, rows=small, seed=seed)
            if not column.only:
                yield Trial(**common, rows=small, step=min(STEPS))
            yield from (Trial(**common, rows=rows) for rows in large)
