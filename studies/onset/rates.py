"""Growth rates of the weakest rolls: of linear theory, and of the gas's grid from its rates, linearised.

Over a fluid at rest between periodic sides a disturbance that varies as cos(kx) and sin(kx) keeps doing so:
the rates are then a matrix of a few numbers a row of the grid, and sigma is its largest eigenvalue. A step in
time turns it into another growth rate, but where sigma = 0, at onset, it stays 0.
"""
from dataclasses import dataclass, replace
from itertools import product
from pathlib import Path
from typing import Any

import numpy as np

from continuum.gas import newton
from continuum.gas.fields import block, initial
from continuum.gas.ghosts import FluxForm, box_of
from continuum.gas.loop import rates
from continuum.linear import DEGREE, PlateKind, critical, critical_ra, growth_rate
from continuum.scene import RayleighBenard, Walls
from continuum.spectral.branch import branch
from studies.build.names import scene_columns
from studies.kit.case import Case, Outcome, Report

STEP = 1e-5     # of the differences of the rates
WEAKEST = {"ke_start": 0.0, "seed": 0}      # columns of rolls without energy


def matrix(scene: RayleighBenard, rows: int, step: float) -> np.ndarray:
    """Slopes of the gas's rates between amplitudes of rolls, by differences of the rates.

    On KHP95's grid: rho in cells, v and e at nodes, those of the plates at rest.
    """
    S, box = block(initial(scene, rows, 0.0)), box_of(scene, rows)
    columns = S.shape[2] - 2
    scratch = np.zeros((2, 8, columns + 2))
    inside = (slice(None), slice(1, -1), slice(1, -1))

    def rate(change: np.ndarray) -> np.ndarray:
        full, out = S.copy(), np.zeros_like(S)
        full[inside] += change
        rates(scene.sides, scene.eos, scene.law, FluxForm(), box, full, scratch, out)
        return out[inside]
    at = 2*np.pi/columns*np.arange(columns)
    cos = np.cos(at)
    waves = np.array([np.sin(at), cos, cos, np.cos(at + np.pi/columns)])
    moves = np.ones((4, rows), bool)
    moves[:3, 0] = False
    slopes = []
    for field, row in np.argwhere(moves):
        change = np.zeros((4, rows, columns))
        change[field, row] = step*waves[field]
        slope = (rate(change) - rate(-change))/(2*step)
        amplitudes = 2*np.einsum("fji,fi->fj", slope, waves)/columns
        slopes.append(amplitudes[moves])
    return np.array(slopes).T


def compressible(scene: RayleighBenard, rows: int) -> tuple[float, float]:
    """Of the gas on KHP95's grid, and what another step makes of it; between walls from its sparse matrix."""
    unit = scene.L/scene.free_fall
    if isinstance(scene.sides, Walls):
        return unit*newton.growth_rate(scene, rows), 1e-8
    sigma, other = (np.linalg.eigvals(matrix(scene, rows, step)).real.max() for step in (STEP, 4*STEP))
    return float(unit*sigma), float(unit*abs(sigma - other))


def point(method: str, scene: RayleighBenard, resolution: float, variant: str = "") -> dict[str, Any]:
    """Columns that all rows share; a Boussinesq fluid has no equation of state."""
    known = {**scene_columns(scene), "dT": scene.dT/scene.T_mean}
    known |= {"method": method, "variant": variant, "resolution": float(resolution)}
    if method == "linear":
        known |= {"eos": "", "transport": "", "dT": 0.0}
    return known


@dataclass(frozen=True, kw_only=True)
class LinearTheory(Case):
    """Critical Rayleigh numbers, each with what fewer trial functions change, and growth rates."""
    ras: tuple[float, ...]
    pr: float

    def run(self, report: Report, folder: Path) -> Outcome:
        rows = []
        for ra in self.ras:
            at = point("linear", RayleighBenard(ra=ra, pr=self.pr), np.inf) | WEAKEST
            sigma = growth_rate(ra=ra, pr=self.pr, k=np.pi)
            rows.append(at | {"way": "eigenvalue", "sigma": sigma, "err": 0.0})
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
    """Growth rates of the gas's grid, from its own rates at some Ra."""
    scene: RayleighBenard
    sizes: tuple[int, ...]
    ras: tuple[float, ...]

    @property
    def cost(self) -> float:
        return len(self.ras)*sum(1e-5*rows**2.5 for rows in self.sizes) + 1

    def run(self, report: Report, folder: Path) -> Outcome:
        rows = []
        for ra, size in product(self.ras, self.sizes):
            scene = replace(self.scene, ra=ra)
            at = point("compressible", scene, size) | WEAKEST
            sigma, err = compressible(scene, size)
            rows.append(at | {"way": "operator", "sigma": sigma, "err": err})
        return Outcome({"growth_rates": rows})


@dataclass(frozen=True, kw_only=True)
class Branch(Case):
    """Steady rolls of the Boussinesq fluid, followed from rest along their arc, beside linear theory."""
    pr: float
    width: float
    functions: int
    steps: tuple[float, ...]

    @property
    def cost(self) -> float:
        return 1e-8*self.functions**6*len(self.steps)

    def run(self, report: Report, folder: Path) -> Outcome:
        states, rows = branch(self.pr, self.functions, self.steps, self.width), list[dict[str, Any]]()
        arcs, ra_c = np.cumsum([0.0, *self.steps]), critical_ra(2*np.pi/self.width)
        for arc, state in zip(arcs, states):
            ra = state.equations.laws.ra
            first = rows[0]["ra"] if rows else ra
            rows.append({"pr": self.pr, "width": self.width, "resolution": self.functions, "arc": float(arc),
                         "ra": ra, "above": ra/first - 1, "ke": state.K, "nu": state.Nu,
                         "off_linear": first/ra_c - 1})
            report(len(rows)/len(arcs))
        return Outcome({"branch": rows})
