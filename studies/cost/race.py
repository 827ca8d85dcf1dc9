"""A method in a flow at a resolution, as a case: its longest step, its errors, its seconds."""
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any, ClassVar

import numpy as np

from particles.run import Divergence
from studies.cost.problem import Problem, Result, Rung, best, climb, rms
from studies.cost.seconds import SHORT, per_step
from studies.kit.case import Case, Outcome, Report
from studies.kit.stats import Measured, with_errors
from studies.kit.table import Row
from studies.kit.timing import of_calls

TRIES = 1.4         # factor in the seconds of a case: the trials of longer steps
LONGER = 10         # times longer are runs that time particles: lists have to be made in them
DIVERGED = Result({"diverged": np.array([np.nan])}, {"diverged": np.nan}, {"diverged": np.nan})


class Race(Case, same="scene method resolution seed"):
    """One method in one flow at one resolution.

    method : name in tables, variant : record of `studies.build`. make(flow, variant, resolution, seed) : the
    `Problem`. price : CPU seconds over points and resolution. first : fraction of the stability limit that is
    tried first.
    """
    scene: str
    method: str
    flow: Any
    variant: Any
    make: Callable[[Any, Any, int, int], Any]
    price: float
    first: float
    resolution: int
    seed: int
    short: float = SHORT
    alone: ClassVar[bool] = True

    @property
    def cost(self) -> float:
        scene = self.flow.scene(self.resolution)
        return TRIES*(1 + self.price*scene.width*scene.L*self.resolution)

    @property
    def label(self) -> str:
        return f"{self.scene}, {self.method}, resolution {self.resolution}, seed {self.seed}"

    def run(self, report: Report, folder: Path) -> Outcome:
        problem = self.made()
        rungs = climb(problem, self.first)
        report(0.7)
        rung = best(rungs)
        errors = self.errors(rung.result or DIVERGED, problem.known)
        rows = {"steps": list(self.steps(rungs)), "errors": list(errors)}
        if rung.result:
            rows["runs"] = [self.timing(problem, rung.fraction, rung.result)]
        return Outcome(rows)

    def made(self) -> Any:
        """The problem, or the gas of a solver."""
        return self.make(self.flow, self.variant, self.resolution, self.seed)

    def steps(self, rungs: list[Rung]) -> Iterator[Row]:
        """Rows of the table `steps`."""
        for rung in rungs:
            for name in rung.time or ("diverged",):
                time_error, space_error = (errors.get(name, np.nan) for errors in (rung.time, rung.space))
                yield {**self.columns, "quantity": name, "of_limit": rung.fraction, "time_error": time_error,
                       "space_error": space_error, "accepted": int(rung.accepted)}

    def errors(self, result: Result, known: float) -> Iterator[Row]:
        """Rows of the table `errors`."""
        for name, residual in result.residuals.items():
            err = float(np.hypot(known, result.uncertain.get(name, 0.0)))
            yield {**self.columns, "quantity": name, "error": rms(residual), "error_err": err,
                   "share": result.share.get(name, 1.0)}

    def timing(self, problem: Problem, fraction: float, result: Result) -> Row:
        """The row of the table `runs`."""
        steps, dt = problem.steps(fraction), problem.dt(fraction)
        seconds = self.a_step(problem, dt, result.state)*steps
        set_up = of_calls(lambda: self.made().set_up())
        return {**self.columns, "points": problem.points, "of_limit": fraction, "dt": dt, "steps": steps,
                **with_errors(run_s=seconds, setup_s=set_up)}

    def a_step(self, problem: Problem, dt: float, end: Any) -> Measured:
        """Seconds of a step; of particles from the disordered end, where lists are made more often."""
        start, short = problem.start, self.short
        if problem.chaotic:
            start, short = end, LONGER*self.short
        safe = min(dt, self.first*problem.limit)      # stable also in more steps than the run has

        def seconds(dt: float) -> Measured:
            return per_step(lambda steps: problem.advance(start, dt, steps), short)
        try:
            return seconds(dt if problem.chaotic else safe)
        except Divergence:
            return seconds(safe)
