"""Solvers that choose their own steps: a case is one call. Newton's methods here, py-pde in `pypde`."""
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import NamedTuple

import numpy as np

from continuum.boussinesq import HALF_LAYER, Case, steady
from continuum.boussinesq.mac import mac
from continuum.gas.fields import at_nodes
from continuum.gas.newton import Discrete
from continuum.gas.newton import steady as newton
from studies.cost.convection import in_heights
from studies.cost.layer import PR, RA, Sizes, boussinesq_reference, compared, reference, scene_of
from studies.cost.problem import Price, Race, Residuals, rms
from studies.cost.timing import Timed, array_bytes, of_calls
from studies.kit.case import Outcome, Report
from studies.kit.timing import compile_and_run_seconds


class Solved(NamedTuple):
    """Residuals, shares of the seconds by quantity, points, steps, bytes; seconds and compiling where the solver has them."""
    residuals: Residuals
    share: dict[str, float]
    points: int
    steps: int
    bytes: int
    known: float
    seconds: Timed | None = None
    compile_s: float = 0.0
    setup: Timed = Timed(0.0, 0.0)
    of_limit: float = np.nan


@dataclass(frozen=True, kw_only=True)
class Direct(Race):
    """A solver that is called once: its whole call is timed, unless it has its own seconds."""

    def run(self, report: Report, folder: Path) -> Outcome:
        solve = partial(self.method.solve, self.resolution)
        done, compile_s, _ = compile_and_run_seconds(solve)
        report(0.2)
        errors = [{**self.key_columns, "quantity": name, "error": rms(off), "error_err": done.known,
                   "share": done.share.get(name, 1.0)} for name, off in done.residuals.items()]
        timings = self.timings(done.seconds or of_calls(solve), {
            "points": done.points, "of_limit": done.of_limit, "dt": np.nan, "steps": done.steps,
            "setup_s": done.setup.value, "setup_s_err": done.setup.err, "compile_s": done.compile_s or compile_s,
            "bytes": done.bytes, "threads": 1})
        return Outcome({"errors": errors, **timings})


class OnNewton(NamedTuple):
    """The compressible grid's steady state by Newton's method."""
    name: str
    price: Price = Price(1, 5e-3, 2)
    sizes: Sizes = Sizes()

    def solve(self, rows: int) -> Solved:
        """At a resolution."""
        scene, limit = scene_of(rows), reference(self.sizes)
        state = newton(scene, rows)
        residuals = {"K": np.array([state.ke/limit.ke - 1]),
                     **compared(in_heights(scene, at_nodes(state.fields)), limit)}
        return Solved(residuals, {}, rows*round(scene.width), len(state.changes), array_bytes(Discrete(scene, rows)),
                      limit.known)


class OnMacNewton(NamedTuple):
    """The Boussinesq steady state by Newton's method, from the roll of the three-mode model."""
    name: str
    price: Price = Price(0.1, 4e-4, 2)
    sizes: Sizes = Sizes()

    def solve(self, rows: int) -> Solved:
        """At a resolution."""
        mac.cache_clear()
        limit, case = boussinesq_reference(self.sizes), Case(ra=RA, pr=PR, box=HALF_LAYER, rows=rows)
        state = steady(case)
        return Solved({"K": np.array([state.K/limit.ke - 1])}, {}, case.rows*case.columns, len(state.residuals),
                      array_bytes(case.mac), limit.known)
