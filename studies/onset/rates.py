"""Growth rates of rolls: of a grid from its own rates, linearised, and of rolls of any energy from runs in time.

Over a fluid at rest between periodic sides a disturbance that varies as cos(kx) and sin(kx) keeps doing so: the rates
are then a matrix of a few numbers a row of the grid, and sigma is its largest eigenvalue. A step in time turns it into
another growth rate, but where sigma = 0, at onset, it stays 0.
"""
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np

from continuum import boussinesq
from continuum.gas import newton as compressible_newton
from continuum.gas import solve
from continuum.gas.fields import block, initial
from continuum.gas.loop import FluxForm, box_of, rates
from continuum.gas.newton import heat_of_rolls, warm_rolls
from continuum.pypde.boussinesq import Boussinesq
from continuum.pypde.gas import Gas
from continuum.pypde.solve import Rolls, solve_boussinesq, solve_gas
from continuum.scene import RayleighBenard, Walls
from continuum.steady import Time
from particles.run import Plan
from particles.run import run as run_particles
from studies.build.names import START_ENERGY
from studies.build.spam import Variant, method, start
from studies.kit.case import Report

STEP = 1e-5     # of the differences of the rates
SAMPLES = 200
BAND = 2.0      # a growth rate counts while the amplitude is within this factor of its first


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


# --- runs in time ---------------------------------------------------------------------------------


class History(NamedTuple):
    """Amplitude of the rolls (of v_y, for the printed rolls) at times in free-fall units."""
    t: np.ndarray
    amplitude: np.ndarray

    def growth(self, after: float) -> tuple[float, float]:
        """Slope of ln A after a time while A stays in its band, and how much its halves disagree.

        Raises
        ------
        ValueError
            Fewer than 8 samples are left.
        """
        t, a = self.t[self.t >= after], self.amplitude[self.t >= after]
        left = np.flatnonzero(~((a > a[0]/BAND) & (a < a[0]*BAND)))
        stop = left[0] if len(left) else len(a)
        if stop < 8:
            raise ValueError(f"{stop} samples after t = {after} within a factor {BAND} of the amplitude {a[0]:.3g}: "
                             "a growth rate needs 8; sample more often or start with stronger rolls")
        t, log, half = t[:stop], np.log(a[:stop]), stop//2
        slopes = [float(np.polyfit(t[part], log[part], 1)[0]) for part in (slice(None), slice(half), slice(half, None))]
        return slopes[0], abs(slopes[1] - slopes[2])/2


def from_energy(t: np.ndarray, ke: np.ndarray) -> History:
    """The amplitude of printed rolls of that energy: v_x and v_y have the same, A^2/4 = K."""
    return History(t, 2*np.sqrt(ke))


# --- runs of grids ------------------------------------------------------------------------------------------------


def compressible_run(scene: RayleighBenard, rows: int, ke: float, until: float, report: Report) -> History:
    """KHP95's grid."""
    unit = scene.L/scene.free_fall
    series = solve.run(scene, rows, until=Time(until*unit, SAMPLES), start=warm_rolls(scene, rows, ke),
                              progress=report).series
    return from_energy(series.t/unit, series.ke)


def boussinesq_run(scene: RayleighBenard, rows: int, ke: float, until: float, report: Report) -> History:
    """The staggered grid's transients; of the scene only Ra and Pr count, as below."""
    case = boussinesq.Case(ra=scene.ra, pr=scene.pr, box=boussinesq.LAYER, rows=rows)
    series = boussinesq.transient(case, boussinesq.khp95(case, ke), until=until, within=0.0, progress=report)
    return from_energy(series.t, series.K)


def pypde_gas_run(scene: RayleighBenard, rows: int, ke: float, until: float, report: Report) -> History:
    """The gas on py-pde's grid."""
    unit = scene.L/scene.free_fall
    series = solve_gas(scene, rows, until=Time(until*unit, SAMPLES), start=Rolls(ke), progress=report).series
    return from_energy(series.t/unit, series.ke)


def pypde_boussinesq_run(scene: RayleighBenard, rows: int, ke: float, until: float, report: Report) -> History:
    """Boussinesq on py-pde's grid."""
    series = solve_boussinesq(ra=scene.ra, pr=scene.pr, rows=rows, until=Time(until, SAMPLES), start=Rolls(ke),
                              progress=report).series
    return from_energy(series.t, series.ke)


RUNS: dict[str, Callable[[RayleighBenard, int, float, float, Report], History]] = {
    "boussinesq": boussinesq_run, "compressible": compressible_run, "pypde-boussinesq": pypde_boussinesq_run,
    "pypde-compressible": pypde_gas_run}


# --- particles --------------------------------------------------------------------------------------------


@dataclass(frozen=True)
class RollOf:
    """Amplitude of v_y along cos or sin(2 pi x/width) cos(pi y/height), from the particles."""
    wave: Callable

    def __call__(self, sums: Any, state: np.ndarray) -> float:
        width, height = sums.method.box
        return 4*float(np.mean(state[3]*self.wave(2*np.pi*state[0]/width)*np.cos(np.pi*state[1]/height)))


def spam_run(scene: RayleighBenard, variant: Variant, seed: int, ke: float, until: float, dt: float, report: Report,
             folder) -> History:
    """Particles; rolls may drift along x, so that both phases are recorded."""
    state, chosen = start(scene, seed), method(scene, variant)
    state[2:4] *= np.sqrt(ke/START_ENERGY)
    state[4] += scene.eos.cv*heat_of_rolls(scene, state[3])
    unit = scene.L/scene.free_fall
    plan = Plan(dt=dt, steps=round(until*unit/dt), every=5, checkpoint=folder/"run.h5",
                series={"cos": RollOf(np.cos), "sin": RollOf(np.sin)})
    done = run_particles(chosen, state, plan, report)
    return History(np.array(done.times)/unit, np.hypot(done.series["cos"], done.series["sin"]))
