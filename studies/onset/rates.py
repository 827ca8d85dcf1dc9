"""Growth rates of the weakest rolls: of linear theory, and of grids from their own rates, linearised.

Over a fluid at rest between periodic sides a disturbance that varies as cos(kx) and sin(kx) keeps doing so:
the rates are then a matrix of a few numbers a row of the grid, and sigma is its largest eigenvalue. A step in
time turns it into another growth rate, but where sigma = 0, at onset, it stays 0.
"""
from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from continuum import boussinesq
from continuum.gas import newton
from continuum.gas.fields import block, initial
from continuum.gas.ghosts import FluxForm, box_of
from continuum.gas.loop import rates
from continuum.linear.layer import DEGREE, PlateKind, critical, critical_ra, growth_rate
from continuum.pypde.gas import Gas
from continuum.pypde.march import rate
from continuum.scene import RayleighBenard, Walls
from studies.build.names import scene_columns
from studies.kit.case import Case, Outcome, Report

STEP = 1e-5     # of the differences of the rates

#: (scene, rows) -> growth rate per free-fall time, and its uncertainty
Solver = Callable[[RayleighBenard, int], tuple[float, float]]


class RollGrid(NamedTuple):
    """A solver on a grid: d/dt of a state (fields, columns, rows), the state at rest.

    wave : cos or sin(kx) of each field at its points (fields, columns). moves : which rows do (fields, rows).
    """
    rate: Callable[[np.ndarray], np.ndarray]
    rest: np.ndarray
    wave: np.ndarray
    moves: np.ndarray


def matrix(grid: RollGrid, step: float) -> np.ndarray:
    """Slopes of the rates between amplitudes of the rolls, by central differences."""
    fields, rows = np.nonzero(grid.moves)
    slopes = np.empty((len(fields), len(fields)))
    for column, (field, row) in enumerate(zip(fields, rows, strict=True)):
        change = np.zeros_like(grid.rest)
        change[field, :, row] = step*grid.wave[field]
        slope = (grid.rate(grid.rest + change) - grid.rate(grid.rest - change))/(2*step)
        amplitudes = 2*np.einsum("fij,fi->fj", slope, grid.wave)/grid.wave.shape[1]
        slopes[:, column] = amplitudes[fields, rows]
    return slopes


def fastest(scene: RayleighBenard, grid: RollGrid) -> tuple[float, float]:
    """Growth rate of rolls per free-fall time, and what another step of the differences makes of it."""
    unit = scene.L/scene.free_fall
    sigma, other = (np.linalg.eigvals(matrix(grid, step)).real.max() for step in (STEP, 4*STEP))
    return float(unit*sigma), float(unit*abs(sigma - other))


def compressible_rolls(scene: RayleighBenard, rows: int) -> RollGrid:
    """KHP95's grid: rho in cells, v and e at nodes, those of the plates at rest."""
    S, box = block(initial(scene, rows, 0.0)), box_of(scene, rows)
    columns = S.shape[2] - 2
    scratch = np.zeros((2, 8, columns + 2))
    inside = (slice(None), slice(1, -1), slice(1, -1))

    def rate(data: np.ndarray) -> np.ndarray:
        full, out = S.copy(), np.zeros_like(S)
        full[inside] = data.swapaxes(1, 2)
        rates(scene.sides, scene.eos, scene.law, FluxForm(), box, full, scratch, out)
        return out[inside].swapaxes(1, 2)
    at = 2*np.pi/columns*np.arange(columns)
    cos = np.cos(at)
    wave = np.array([np.sin(at), cos, cos, np.cos(at + np.pi/columns)])
    moves = np.ones((4, rows), bool)
    moves[:3, 0] = False
    return RollGrid(rate, S[inside].swapaxes(1, 2).copy(), wave, moves)


def pypde_rolls(scene: RayleighBenard, rows: int) -> RollGrid:
    """py-pde's grid, rho, v and e of the gas."""
    gas = Gas(scene, rows)
    rest = gas.rolls(0.0)
    k = 2*np.pi/gas.grid_box[0]
    at = np.array([k*gas.points(field)[0][1:-1] for field in range(4)])
    wave = np.cos(at)
    wave[1] = np.sin(at[1])
    moves = np.ones((4, rest.shape[2]), bool)
    moves[2, -1] = False        # v_y on the upper plate
    return RollGrid(lambda data: rate(gas.loop, data), rest, wave, moves)


def compressible(scene: RayleighBenard, rows: int) -> tuple[float, float]:
    """Of the gas on KHP95's grid; between walls from its sparse matrix."""
    if isinstance(scene.sides, Walls):
        return newton.growth_rate(scene, rows)*scene.L/scene.free_fall, 1e-8
    return fastest(scene, compressible_rolls(scene, rows))


def pypde_compressible(scene: RayleighBenard, rows: int) -> tuple[float, float]:
    """Of the gas on py-pde's grid."""
    return fastest(scene, pypde_rolls(scene, rows))


def boussinesq_mac(scene: RayleighBenard, rows: int) -> tuple[float, float]:
    """Of the Boussinesq fluid on the staggered grid; of the scene only Ra and Pr count."""
    case = boussinesq.BoussinesqCase(ra=scene.ra, pr=scene.pr, box=boussinesq.HALF_LAYER, rows=rows)
    return float(boussinesq.growth_rates(boussinesq.rest(case), count=2)[0].real), 1e-10


def point(method: str, scene: RayleighBenard, resolution: float, variant: str = "") -> dict[str, Any]:
    """Columns that all rows share; a Boussinesq fluid has no equation of state."""
    known = {**scene_columns(scene), "dT": scene.dT/scene.T_mean}
    known |= {"method": method, "variant": variant, "resolution": float(resolution)}
    if method in ("boussinesq", "linear"):
        known |= {"eos": "", "transport": "", "dT": 0.0}
    return known


def weakest(at: dict[str, Any], way: str, sigma: float, err: float) -> dict[str, Any]:
    """Row of `growth_rates` of rolls without energy."""
    return {**at, "way": way, "ke_start": 0.0, "seed": 0, "sigma": sigma, "err": err}


@dataclass(frozen=True, kw_only=True)
class LinearTheory(Case):
    """Critical Rayleigh numbers, each with what fewer trial functions change, and growth rates."""
    ras: tuple[float, ...]
    pr: float

    def run(self, report: Report, folder: Path) -> Outcome:
        rows = []
        for ra in self.ras:
            at = point("linear", RayleighBenard(ra=ra, pr=self.pr), np.inf)
            sigma = growth_rate(ra=ra, pr=self.pr, k=np.pi)
            rows.append(weakest(at, "eigenvalue", sigma, 0.0))
        onsets = [self.onset("ra_c infinite layer rigid", critical(PlateKind.RIGID).k, "infinite"),
                  self.onset("ra_c periodic aspect 2", np.pi, "periodic")]
        return Outcome({"growth_rates": rows, "critical_ra": onsets})

    def onset(self, quantity: str, k: float, sides: str) -> dict[str, Any]:
        """Row of `critical_ra`."""
        value, other = (critical_ra(k, PlateKind.RIGID, degree) for degree in (DEGREE, DEGREE - 4))
        at = point("linear", RayleighBenard(ra=value), np.inf)
        at.pop("ra")
        return {**at, "sides": sides, "quantity": quantity, "value": value, "err": abs(value - other),
                "way": "eigenvalue", "reach": 0.0, "ke_start": 0.0}


@dataclass(frozen=True, kw_only=True)
class GridGrowth(Case):
    """Growth rates of a grid's own rates at some Ra. solver : one of the above, `method` its name."""
    method: str
    solver: Solver
    scene: RayleighBenard
    sizes: tuple[int, ...]
    ras: tuple[float, ...]

    @property
    def cost(self) -> float:
        return len(self.ras)*sum(1e-5*rows**2.5 for rows in self.sizes) + 1

    def run(self, report: Report, folder: Path) -> Outcome:
        rows = []
        for number, ra in enumerate(self.ras):
            scene = replace(self.scene, ra=ra)
            for size in self.sizes:
                at = point(self.method, scene, size)
                rows.append(weakest(at, "operator", *self.solver(scene, size)))
            report((number + 1)/len(self.ras))
        return Outcome({"growth_rates": rows})
