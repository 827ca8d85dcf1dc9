"""The spectral method as cases: K of the gas and of the Boussinesq fluid to eight digits, truth for grids."""
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any

from continuum.scene import RayleighBenard
from continuum.spectral.laws import BoussinesqLaws, GasLaws
from continuum.spectral.newton import SpectralState, steady
from continuum.steady import STILL
from studies.build.names import one_energy, scene_columns
from studies.kit.case import Case, Outcome, Report
from studies.kit.timing import compile_and_run_seconds
from studies.rb.runs.grid import no_particles


@dataclass(frozen=True, kw_only=True)
class SpectralGas(Case):
    """The gas, in `sizes` functions along each axis, each state started from the one before."""
    scene: RayleighBenard
    sizes: tuple[int, ...] = (16, 20, 24, 28)

    @property
    def cost(self) -> float:
        return sum(3e-9*n**6 for n in self.sizes) + 1

    @property
    def laws(self) -> Any:
        return GasLaws(self.scene)

    @property
    def point(self) -> dict:
        return {"method": "spectral-gas", "variant": "", **scene_columns(self.scene), "converged": True,
                "mass_drift": 0.0, "dt": 0.0, "t_end": 0.0, **no_particles(self.scene.free_fall)}

    def run(self, report: Report, folder: Path) -> Outcome:
        """An error is the distance to the last size, of the last one that to the one before."""
        rows: list[dict] = []
        start: SpectralState | None = None
        for n in self.sizes:
            state, compile_s, cpu_s = compile_and_run_seconds(partial(steady, self.laws, n, start))
            rows.append({**self.point, "resolution": n, "ke": state.K, "nu": state.Nu,
                         "rolls": 2*(state.K > STILL), "steps": len(state.changes),
                         "cpu_s": cpu_s, "compile_s": compile_s})
            start = state
            report(len(rows)/len(self.sizes))
        for row, other in zip(rows, [rows[-1]]*(len(rows) - 1) + [rows[-2]]):
            row["nu_err"] = abs(row["nu"] - other["nu"])
            row |= one_energy(row["ke"], abs(row["ke"] - other["ke"]))
        return Outcome({"kinetic_energy": rows})


@dataclass(frozen=True, kw_only=True)
class SpectralBoussinesq(SpectralGas):
    """The Boussinesq fluid in a layer of this aspect, Ra and Pr, in free-fall units."""

    @property
    def laws(self) -> Any:
        return BoussinesqLaws(self.scene.ra, self.scene.pr, self.scene.aspect)

    @property
    def point(self) -> dict:
        fluid = {"eos": "", "transport": "", "free_fall": 1.0}
        return {**super().point, "method": "spectral-boussinesq", **fluid}
