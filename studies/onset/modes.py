"""Growth rates of rolls on the grids of the solvers, from their own rates: no run, no noise, no error of the step.

Over a fluid at rest between periodic sides a disturbance that varies as cos(kx) and sin(kx) keeps doing so: the rates
are then a matrix of a few numbers a row of the grid, and sigma is its largest eigenvalue. A step in time turns it into
another growth rate, but where sigma = 0, at onset, it stays 0.
"""
from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from continuum import boussinesq
from continuum.gas import newton as compressible_newton
from continuum.gas.fields import block, initial
from continuum.gas.loop import FluxForm, box_of, rates
from continuum.pypde.boussinesq import Boussinesq
from continuum.pypde.gas import Gas
from continuum.scene import RayleighBenard, Walls

STEP = 1e-5     # of the differences of the rates


class Grid(NamedTuple):
    """A solver on a grid: d/dt of a state (fields, columns, rows), the state at rest, cos or sin(kx) of each field at its
    points (fields, columns), and which rows of a field move (fields, rows)."""
    rate: Callable[[np.ndarray], np.ndarray]
    rest: np.ndarray
    wave: np.ndarray
    moves: np.ndarray


def matrix(grid: Grid, step: float) -> np.ndarray:
    """Slopes of the rates between amplitudes of the rolls, by central differences."""
    fields, rows = np.nonzero(grid.moves)
    slopes = np.empty((len(fields), len(fields)))
    for column, (f, j) in enumerate(zip(fields, rows)):
        there, back = grid.rest.copy(), grid.rest.copy()
        there[f, :, j] += step*grid.wave[f]
        back[f, :, j] -= step*grid.wave[f]
        slope = (grid.rate(there) - grid.rate(back))/(2*step)
        slopes[:, column] = 2*np.einsum("fij,fi->fj", slope, grid.wave)[fields, rows]/grid.wave.shape[1]
    return slopes


def fastest(grid: Grid) -> tuple[float, float]:
    """Growth rate of rolls per unit of time, and what another step of the differences makes of it."""
    sigma, other = (float(np.linalg.eigvals(matrix(grid, step)).real.max()) for step in (STEP, 4*STEP))
    return sigma, abs(sigma - other)


# --- solvers ----------------------------------------------------------------------------------------------


def compressible_rolls(scene: RayleighBenard, rows: int) -> Grid:
    """KHP95's grid: rho in cells, v and e at nodes, those of the plates at rest."""
    S = block(initial(scene, rows, 0.0))
    columns = S.shape[2] - 2
    box = box_of(scene, rows)
    scratch, inside = np.zeros((2, 8, columns + 2)), (slice(None), slice(1, -1), slice(1, -1))

    def rate(data):
        full, out = S.copy(), np.zeros_like(S)
        full[inside] = data.swapaxes(1, 2)
        rates(scene.sides, scene.eos, scene.law, FluxForm(), box, full, scratch, out)
        return out[inside].swapaxes(1, 2)
    at = 2*np.pi/columns*np.arange(columns)
    moves = np.ones((4, rows), bool)
    moves[:3, 0] = False
    wave = np.array([np.sin(at), np.cos(at), np.cos(at), np.cos(at + np.pi/columns)])
    return Grid(rate, S[inside].swapaxes(1, 2).copy(), wave, moves)


def pypde_rolls(equation: Gas | Boussinesq, odd: int) -> Grid:
    """A grid of py-pde's, where field `odd` varies as sin(kx)."""
    rest = equation.rolls(0.0) if isinstance(equation, Gas) else still(equation)
    rate = equation.make_evolution_rate(None, None)
    k = 2*np.pi/equation.grid_box[0]
    at = np.array([k*equation.points(f)[0][1:-1] for f in range(len(rest))])
    moves = np.ones((len(rest), rest.shape[2]), bool)
    if isinstance(equation, Gas):
        moves[2, -1] = False        # v_y on the upper plate
    wave = np.cos(at)
    wave[odd] = np.sin(at[odd])
    return Grid(lambda data: rate(data, 0.0), rest, wave, moves)


def still(equation: Boussinesq) -> np.ndarray:
    """(omega, T) of conduction."""
    columns, inner = equation.grid.shape
    return np.array([np.zeros((columns, inner)), np.broadcast_to(0.5 - equation.points(1)[1][1:-1], (columns, inner))])


# --- growth rates per free-fall time, with their uncertainty ----------------------------------------------


def compressible(scene: RayleighBenard, rows: int) -> tuple[float, float]:
    """Of the gas on KHP95's grid; between walls from its sparse matrix."""
    unit = scene.L/scene.free_fall
    if isinstance(scene.sides, Walls):
        return unit*compressible_newton.growth_rate(scene, rows), 1e-8
    sigma, err = fastest(compressible_rolls(scene, rows))
    return unit*sigma, unit*err


def pypde_compressible(scene: RayleighBenard, rows: int) -> tuple[float, float]:
    """Of the gas on py-pde's grid."""
    sigma, err = fastest(pypde_rolls(Gas(scene, rows), odd=1))
    return sigma*scene.L/scene.free_fall, err*scene.L/scene.free_fall


def pypde_boussinesq(scene: RayleighBenard, rows: int) -> tuple[float, float]:
    """Of the Boussinesq fluid on py-pde's grid; of the scene only Ra and Pr count."""
    return fastest(pypde_rolls(Boussinesq(ra=scene.ra, pr=scene.pr, rows=rows), odd=0))


def boussinesq_mac(scene: RayleighBenard, rows: int) -> tuple[float, float]:
    """Of the Boussinesq fluid on the staggered grid; of the scene only Ra, Pr and the sides count."""
    box = boussinesq.CONDUCTING_SQUARE if isinstance(scene.sides, Walls) else boussinesq.HALF_LAYER
    case = boussinesq.Case(ra=scene.ra, pr=scene.pr, box=box, rows=rows)
    return float(boussinesq.growth_rates(boussinesq.rest(case), count=2)[0].real), 1e-10


#: method -> (scene, rows) -> (growth rate, uncertainty) per free-fall time
SOLVERS: dict[str, Callable[[RayleighBenard, int], tuple[float, float]]] = {
    "boussinesq": boussinesq_mac, "compressible": compressible, "pypde-boussinesq": pypde_boussinesq,
    "pypde-compressible": pypde_compressible}
