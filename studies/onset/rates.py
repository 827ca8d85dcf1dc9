"""Growth rates of the weakest rolls: linear theory, and the rates of the gas's grid, linearised.

Between periodic sides a disturbance of a fluid at rest that varies as cos(kx) and sin(kx) keeps this form.
The rates are then a matrix with a few numbers a row of the grid, and the growth rate sigma is its largest
eigenvalue. Steps in time are left out: they change sigma, but not the Ra where it is 0.
"""
from collections.abc import Iterator
from dataclasses import replace
from itertools import product

import numpy as np

from continuum.gas import newton
from continuum.gas.fields import block, initial
from continuum.gas.ghosts import FluxForm, box_of
from continuum.gas.loop import rates
from continuum.linear import DEGREE, RIGID, critical, critical_ra
from continuum.scene import RayleighBenard, Walls
from continuum.spectral.branch import branch
from studies.build.names import scene_columns
from studies.kit.case import Case, Report
from studies.kit.table import Row

STEP = 1e-5     # of the differences of the rates


def matrix(scene: RayleighBenard, rows: int, step: float) -> np.ndarray:
    """Matrix of d(rate of an amplitude)/d(amplitude), by differences of the gas's rates.

    An amplitude is that of one wave of a field in one row of KHP95's grid: rho in a row of cells, v and e in
    a row of nodes between the plates.
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
    """Growth rate of the gas on KHP95's grid, and its error: what differences of another step change."""
    unit = scene.L/scene.free_fall
    if isinstance(scene.sides, Walls):
        return unit*newton.growth_rate(scene, rows), 1e-8
    sigma, other = (np.linalg.eigvals(matrix(scene, rows, step)).real.max() for step in (STEP, 4*STEP))
    return float(unit*sigma), float(unit*abs(sigma - other))


def point(method: str, scene: RayleighBenard, resolution: float, variant: str = "") -> Row:
    """Columns that all rows share."""
    return {**scene_columns(scene), "dT": scene.dT/scene.T_mean,
            "method": method, "variant": variant, "resolution": float(resolution)}


class LinearTheory(Case, table="critical_ra"):
    """Critical Rayleigh numbers of a Boussinesq fluid; err: what four trial functions fewer change."""

    def measure(self, report: Report) -> Iterator[Row]:
        for box, k, sides in (("infinite layer rigid", critical().k, "infinite"),
                              ("periodic aspect 2", np.pi, "periodic")):
            value, other = (critical_ra(k, RIGID, degree) for degree in (DEGREE, DEGREE - 4))
            yield {"method": "linear", "variant": "", "eos": "", "transport": "", "dT": 0.0, "sides": sides,
                   "pr": 1.0, "resolution": np.inf, "quantity": f"ra_c {box}", "value": value,
                   "err": abs(value - other), "way": "eigenvalue", "reach": 0.0, "ke_start": 0.0}


class GridGrowth(Case, table="growth_rates"):
    """Growth rates of the weakest rolls on grids of several sizes, at several Ra."""
    scene: RayleighBenard
    sizes: tuple[int, ...]
    ras: tuple[float, ...]

    def measure(self, report: Report) -> Iterator[Row]:
        for ra, size in product(self.ras, self.sizes):
            scene = replace(self.scene, ra=ra)
            sigma, err = compressible(scene, size)
            yield {**point("compressible", scene, size), "ke_start": 0.0, "seed": 0, "way": "operator",
                   "sigma": sigma, "err": err}


class Branch(Case, table="branch"):
    """Steady rolls of a Boussinesq fluid, followed along their branch from the onset on."""
    pr: float
    width: float
    functions: int
    steps: tuple[float, ...]

    def measure(self, report: Report) -> Iterator[Row]:
        arcs, ra_c = np.cumsum([0.0, *self.steps]), critical_ra(2*np.pi/self.width)
        states = list(branch(self.pr, self.functions, self.steps, self.width))
        first = states[0].equations.laws.ra
        for arc, state in zip(arcs, states, strict=True):
            ra = state.equations.laws.ra
            yield {"pr": self.pr, "width": self.width, "resolution": self.functions, "arc": float(arc),
                   "ra": ra, "above": ra/first - 1, "ke": state.K, "nu": state.Nu,
                   "off_linear": first/ra_c - 1}
