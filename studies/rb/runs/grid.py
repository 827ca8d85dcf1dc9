"""Grid references as cases: the compressible gas, Boussinesq, and both in py-pde."""
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np

from continuum import boussinesq
from continuum.gas.fields import initial, interpolate
from continuum.gas.solve import Solution, run, steady_on
from continuum.pypde import solve as pypde
from continuum.scene import RayleighBenard
from continuum.steady import Steady, Time
from particles.observe import Grid
from studies.build.grid import FORMS, beginning
from studies.build.measure import Smoothing, smoothed_rows
from studies.build.names import START_ENERGY, one_energy, scene_columns
from studies.kit.case import Case, Outcome, Report
from studies.kit.timing import compile_and_run_seconds

STILL = 1e-8        # K of a grid at rest, whose rolls would be those of round-off


def point(scene: RayleighBenard, solution: Solution, variant: str) -> dict:
    """Key columns of a row of one compressible solution."""
    return {"method": "compressible", "variant": variant, **scene_columns(scene), "resolution": solution.rows}


def settling(solution: Any) -> float:
    """Error of Nu that is left of settling, in proportion to that of K; that of the grid shows in the extrapolation."""
    return float(2*solution.ke_err/solution.ke*solution.nu) if solution.ke > 1e-9 else 0.0


def spent(solution: Any) -> dict:
    """Columns of energy and effort of a solution in time."""
    return {**one_energy(solution.ke, 2*solution.ke_err), "nu": solution.nu, "nu_err": settling(solution),
            "mass_drift": solution.mass_drift, "converged": solution.converged, "dt": solution.dt, "steps": solution.steps,
            "t_end": solution.t, "cpu_s": solution.cpu_s, "compile_s": solution.compile_s}


def energies(scene: RayleighBenard, solution: Solution, variant: str) -> dict:
    """Row of `kinetic_energy` of one compressible solution."""
    return {**point(scene, solution, variant), "particles": 0, "seed": 0, **spent(solution), "free_fall": scene.free_fall,
            "rolls": solution.rolls if solution.ke > STILL else 0, "threads": 1}


def boussinesq_point(method: str, variant: str, ra: float, pr: float) -> dict:
    """Columns that all Boussinesq rows share; their state is steady to round-off."""
    return {"method": method, "variant": variant, "eos": "", "transport": "", "sides": "periodic", "ra": ra, "pr": pr,
            "particles": 0, "seed": 0, "free_fall": 1.0,
            "mass_drift": 0.0, "converged": True, "dt": 0.0, "t_end": 0.0, "threads": 1}


@dataclass(frozen=True, kw_only=True)
class Refined(Case):
    """Steady states on ever finer grids, `sizes` rows, each started from the one before.

    Raises
    ------
    ValueError
        Sizes are empty, or no tuple: nothing would follow from no grids.
    """
    sizes: tuple[int, ...]

    def __post_init__(self):
        if not (isinstance(self.sizes, tuple) and self.sizes):
            raise ValueError(f"sizes must be the rows of one grid or more, got {self.sizes!r}: give them coarsest first, as in "
                             "(16, 24, 32)")


@dataclass(frozen=True, kw_only=True)
class CompressibleSteady(Refined):
    """The gas; the finest grid's fields on request."""
    scene: RayleighBenard
    rtol: float = 1e-5
    keep: str = ""
    smooth: tuple[Smoothing, ...] = ()
    variant: str = "flux-form"
    longest: float = 60.0

    @property
    def cost(self) -> float:
        return sum(2e-5*rows**3 for rows in self.sizes)*(2 if self.scene.ra < 2500 else 1) + 3

    @property
    def label(self) -> str:
        where = scene_columns(self.scene)
        return (f"compressible {self.variant} {where['eos']} {where['transport']} {where['sides']} Ra {self.scene.ra:g}, "
                f"rows {self.sizes}")

    def run(self, report: Report, folder: Path) -> Outcome:
        form = FORMS[self.variant]
        first = beginning(self.scene, self.sizes[0], form)
        solutions = steady_on(self.scene, self.sizes, start=first, continuity=form.continuity,
                              until=Steady(rtol=self.rtol, longest=self.longest), progress=report)
        rows = {"kinetic_energy": [energies(self.scene, s, self.variant) for s in solutions]}
        finest = point(self.scene, solutions[-1], self.variant)
        if self.smooth:
            rows["smoothed"] = list(smoothed_rows(finest, solutions[-1].fields, self.smooth))
        if self.keep:
            grid = Grid.over((self.scene.width, self.scene.L), 30)      # the places where particles' fields are kept
            at = interpolate(solutions[-1].fields, grid.x, grid.y)
            rows["fields"] = field_rows({**finest, "seed": 0}, self.scene, grid, at)
        return Outcome(rows)


def field_rows(key: dict, scene: RayleighBenard, grid: Grid, at: Any) -> list[dict]:
    """Rows of `fields` at the places of a grid."""
    columns = (grid.x/scene.L, grid.y/scene.L, at.rho, at.T, at.vx, at.vy)
    return [{**key, **dict(zip(("x", "y", "rho", "T", "vx", "vy"), map(float, row), strict=True))}
            for row in zip(*(np.ravel(c) for c in columns), strict=True)]


@dataclass(frozen=True, kw_only=True)
class CompressibleApproach(Case):
    """K(t) from the rolls of Sec. VI, until t_end in free-fall times    [KHP95, Fig. 8]"""
    scene: RayleighBenard
    rows: int = 50
    t_end: float = 90.0

    @property
    def cost(self) -> float:
        return 4e-5*self.rows**3*self.t_end/90 + 3

    @property
    def label(self) -> str:
        return f"compressible approach Ra {self.scene.ra:g}, rows {self.rows}"

    def run(self, report: Report, folder: Path) -> Outcome:
        scene = self.scene
        start, t_end = initial(scene, self.rows, START_ENERGY), self.t_end*scene.L/scene.free_fall
        solution = run(scene, self.rows, until=Time(t_end, 300), start=start, progress=report)
        key = {**point(scene, solution, "flux-form"), "seed": 0}
        return Outcome({"history": [{**key, "t": t, "t_viscous": t/scene.viscous_time, "ke": ke, "ke_field": ke}
                                    for t, ke in zip(solution.series.t, solution.series.ke, strict=True)]})


@dataclass(frozen=True, kw_only=True)
class BoussinesqSteady(Refined):
    """The periodic pair of rolls (as one roll between planes of symmetry) in the Boussinesq fluid.

    Below onset Newton's method ends at rest, and one grid tells as much as three.
    """
    ra: float
    pr: float
    sizes: tuple[int, ...] = (32, 48, 64)

    @property
    def cost(self) -> float:
        return sum(6e-5*rows**2 for rows in self.sizes)

    @property
    def label(self) -> str:
        return f"boussinesq Ra {self.ra:g}, Pr {self.pr:g}, rows {self.sizes}"

    def run(self, report: Report, folder: Path) -> Outcome:
        rows: list[dict] = []
        state: boussinesq.State | None = None
        for number, size in enumerate(self.sizes):
            case = boussinesq.Case(ra=self.ra, pr=self.pr, box=boussinesq.HALF_LAYER, rows=size)
            steady, compile_s, cpu_s = compile_and_run_seconds(partial(boussinesq.steady, case, state))
            state = steady
            rows.append({**self._row(steady), "resolution": size, "cpu_s": cpu_s, "compile_s": compile_s})
            report((number + 1)/len(self.sizes))
        return Outcome({"kinetic_energy": rows})

    def _row(self, state: boussinesq.State) -> dict:
        seen = state.observe()
        return {**boussinesq_point("boussinesq", "mac", self.ra, self.pr), **one_energy(seen.K, 0.0),
                "nu": (seen.nu_bottom + seen.nu_top)/2, "nu_err": abs(seen.nu_bottom - seen.nu_top),
                "rolls": 2*state.rolls, "steps": len(state.residuals) - 1}


@dataclass(frozen=True, kw_only=True)
class PypdeSteady(Refined):
    """py-pde's Boussinesq layer (`scene` None) or compressible gas."""
    ra: float
    pr: float = 1.0
    scene: RayleighBenard | None = None
    sizes: tuple[int, ...] = (16, 24, 32)

    @property
    def cost(self) -> float:
        return sum(5 + 6e-5*rows**3 for rows in self.sizes)

    @property
    def label(self) -> str:
        return f"py-pde {'boussinesq' if self.scene is None else 'gas'} Ra {self.ra:g}, Pr {self.pr:g}, rows {self.sizes}"

    def run(self, report: Report, folder: Path) -> Outcome:
        rows, last = [], None
        for number, size in enumerate(self.sizes):
            last = self._solve(size, {} if last is None else {"start": last})
            rows.append({**self._point(), "resolution": last.rows, **spent(last), "rolls": last.rolls})
            report((number + 1)/len(self.sizes))
        return Outcome({"kinetic_energy": rows})

    def _solve(self, rows: int, start: dict) -> pypde.PdeSolution:
        if self.scene is None:
            return pypde.solve_boussinesq(ra=self.ra, pr=self.pr, rows=rows, **start)
        return pypde.solve_gas(self.scene, rows, **start)

    def _point(self) -> dict:
        point = boussinesq_point("pypde-boussinesq", "vorticity", self.ra, self.pr)
        return point if self.scene is None else {**point, "method": "pypde-compressible", "variant": "staggered",
                                                 **scene_columns(self.scene), "free_fall": self.scene.free_fall}
