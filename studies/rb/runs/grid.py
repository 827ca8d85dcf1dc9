"""Grid references as cases: the gas, also in py-pde, and the Boussinesq fluid; spectral ones of both."""
from collections.abc import Iterator
from functools import partial
from pathlib import Path
from typing import Any

from continuum import boussinesq
from continuum.gas.fields import initial, interpolate
from continuum.gas.solve import Solution, run, steady_on
from continuum.pypde import solve as pypde
from continuum.pypde.gas import Gas
from continuum.scene import RayleighBenard
from continuum.spectral import newton as spectral
from continuum.spectral.laws import BoussinesqLaws, GasLaws
from continuum.steady import Steady, Time
from particles.observe import Grid
from studies.build.grid import FORMS, GridForm, beginning
from studies.build.measure import Smoothing, smoothed_rows
from studies.build.names import START_ENERGY, one_energy, scene_columns
from studies.kit.case import Case, Outcome, Report
from studies.kit.timing import compile_and_run_seconds
from studies.rb.runs import table_rows

NINE = 1e-8         # relative: what nine digits of a table leave of a number
#: columns that solutions have, too
SAME = ("mass_drift", "converged", "dt", "steps", "cpu_s", "compile_s")
#: the same of states without time
AT_ONCE = {"mass_drift": 0.0, "converged": True, "dt": 0.0, "t_end": 0.0}
NO_GAS = {"eos": "", "transport": ""}
STILL = 1e-8        # K of a grid at rest, whose rolls would be those of round-off


def compressible(scene: RayleighBenard, rows: int, variant: str) -> dict:
    """Key columns of a row of one compressible solution."""
    return {"method": "compressible", "variant": variant, **scene_columns(scene), "resolution": rows}


def no_particles(free_fall: float) -> dict:
    """Columns of `kinetic_energy` that are the same for all grids."""
    return {"particles": 0, "seed": 0, "free_fall": free_fall, "threads": 1}


def spent(solution: Any) -> dict:
    """Columns of energy and effort of a solution in time; the change of Nu still to come is in proportion to
    that of K.
    """
    left = 2*solution.ke_err/solution.ke*solution.nu if solution.ke > 1e-9 else 0.0
    return {**one_energy(solution.ke, 2*solution.ke_err), "nu": solution.nu, "nu_err": float(left),
            "t_end": solution.t, **{name: getattr(solution, name) for name in SAME}}


def field_rows(key: dict, scene: RayleighBenard, grid: Grid, at: Any) -> list[dict]:
    """Rows of `fields` at the places of a grid."""
    columns = {"x": grid.x/scene.L, "y": grid.y/scene.L, "rho": at.rho, "T": at.T, "vx": at.vx, "vy": at.vy}
    return table_rows(key, **{name: column.ravel() for name, column in columns.items()})


class CompressibleSteady(Case, table="kinetic_energy"):
    """Steady states of the gas on ever finer grids, each started from the one before, with `sizes` rows.

    keep : if not empty, fields of the finest grid are kept. form : of the equations on the grid.
    """
    sizes: tuple[int, ...]
    scene: RayleighBenard
    keep: str = ""
    smooth: tuple[Smoothing, ...] = ()
    form: GridForm = FORMS["flux-form"]
    longest: float = 60.0

    @property
    def cost(self) -> float:
        return sum(2e-5*rows**3 for rows in self.sizes)*(2 if self.scene.ra < 2500 else 1) + 3

    @property
    def label(self) -> str:
        where = scene_columns(self.scene)
        return (f"compressible {self.form.name} {where['eos']} {where['transport']} {where['sides']} "
                f"Ra {self.scene.ra:g}, rows {self.sizes}")

    def run(self, report: Report, folder: Path) -> Outcome:
        first = beginning(self.scene, self.sizes[0], self.form)
        solutions = steady_on(self.scene, self.sizes, start=first, until=Steady(longest=self.longest),
                              progress=report, continuity=self.form.continuity)
        finest = solutions[-1].fields
        point = compressible(self.scene, self.sizes[-1], self.form.name)
        rows = {"kinetic_energy": [self._row(one) for one in solutions],
                "smoothed": list(smoothed_rows(point, finest, self.smooth))}
        if self.keep:
            grid = Grid.over((self.scene.width, self.scene.L), 30)      # where particles' fields are kept
            at = interpolate(finest, grid.x, grid.y)
            rows["fields"] = field_rows({**point, "seed": 0}, self.scene, grid, at)
        return Outcome(rows)

    def _row(self, solution: Solution) -> dict:
        """Row of `kinetic_energy`."""
        point = compressible(self.scene, solution.rows, self.form.name)
        rolls = solution.rolls if solution.ke > STILL else 0
        return {**point, **no_particles(self.scene.free_fall), **spent(solution), "rolls": rolls}


class CompressibleApproach(Case, table="history"):
    """K(t) from the rolls of Sec. VI, until t_end in free-fall times    [KHP95, Fig. 8]"""
    scene: RayleighBenard
    rows: int = 50
    t_end: float = 90.0

    @property
    def cost(self) -> float:
        return 4e-5*self.rows**3*self.t_end/90 + 3

    def measure(self, report: Report) -> list[dict]:
        scene = self.scene
        until = Time(self.t_end*scene.L/scene.free_fall, 300)
        start = initial(scene, self.rows, START_ENERGY)
        solution = run(scene, self.rows, until=until, start=start, progress=report)
        t, ke = solution.series.t, solution.series.ke
        key = {**compressible(scene, self.rows, "flux-form"), "seed": 0}
        return table_rows(key, t=t, t_viscous=t/scene.viscous_time, ke=ke, ke_field=ke)


class BoussinesqSteady(Case, table="kinetic_energy"):
    """The periodic pair of rolls (as one roll between planes of symmetry) in the Boussinesq fluid.

    Below onset Newton's method ends at rest. States are steady to round-off: the tables' digits are their
    error.
    """
    ra: float
    pr: float
    sizes: tuple[int, ...] = (24, 32, 48, 64)

    def measure(self, report: Report) -> Iterator[dict]:
        state: Any = None
        for size in self.sizes:
            case = boussinesq.BoussinesqCase(ra=self.ra, pr=self.pr, box=boussinesq.HALF_LAYER, rows=size)
            state, compile_s, cpu_s = compile_and_run_seconds(partial(boussinesq.steady, case, state))
            seen = state.observe()
            nu = (seen.nu_bottom + seen.nu_top)/2
            yield {"method": "boussinesq", "variant": "mac", **NO_GAS, "sides": "periodic", "ra": self.ra,
                   "pr": self.pr, "resolution": size, **no_particles(1.0), **AT_ONCE,
                   **one_energy(seen.K, NINE*seen.K), "nu": nu,
                   "nu_err": abs(seen.nu_bottom - seen.nu_top) + NINE*nu, "rolls": 2*state.rolls,
                   "steps": len(state.changes), "cpu_s": cpu_s, "compile_s": compile_s}


class SpectralGas(Case, table="kinetic_energy"):
    """The gas in ever more functions along each axis: a truth for grids."""
    scene: RayleighBenard
    sizes: tuple[int, ...] = (16, 20, 24, 28)

    def laws(self) -> tuple[dict, Any]:
        """How rows name the equations, and the equations."""
        return {"method": "spectral-gas", "free_fall": self.scene.free_fall}, GasLaws(self.scene)

    def measure(self, report: Report) -> Iterator[dict]:
        runs: list[Any] = []
        names, laws = self.laws()
        for n in self.sizes:
            start = runs[-1][0] if runs else None
            runs.append(compile_and_run_seconds(partial(spectral.steady, laws, n, start)))
            report(n/self.sizes[-1])
        (before, *_), (last, *_) = runs[-2:]
        for state, compile_s, cpu_s in runs:
            other = before if state is last else last       # the distance to it is the error
            yield {**scene_columns(self.scene), **no_particles(1.0), **AT_ONCE, "variant": "", **names,
                   **one_energy(state.K, abs(state.K - other.K)), "nu": state.Nu,
                   "nu_err": abs(state.Nu - other.Nu), "resolution": state.equations.n,
                   "rolls": 2*(state.K > STILL), "steps": len(state.changes), "cpu_s": cpu_s,
                   "compile_s": compile_s}


class SpectralBoussinesq(SpectralGas):
    """The Boussinesq fluid at the Ra and Pr of a scene."""

    def laws(self) -> tuple[dict, Any]:
        return {"method": "spectral-boussinesq", **NO_GAS}, BoussinesqLaws(self.scene.ra, self.scene.pr)


class PypdeSteady(Case, table="kinetic_energy"):
    """The compressible gas in py-pde."""
    scene: RayleighBenard
    sizes: tuple[int, ...]

    def measure(self, report: Report) -> Iterator[dict]:
        solution: pypde.PdeSolution | None = None
        for size in self.sizes:
            solution = pypde.solve(Gas(self.scene, size), start=solution)
            yield {"method": "pypde-compressible", "variant": "staggered", **scene_columns(self.scene),
                   **no_particles(self.scene.free_fall), "resolution": size, **spent(solution),
                   "rolls": solution.rolls}
