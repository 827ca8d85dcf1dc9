"""The compressible grid without plates: it takes part in the Taylor-Green vortex and in the sound wave.

Densities are those of the middle of their cells, velocities and energies those of nodes; errors are told at nodes.
"""
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np

from continuum.compressible import March, limits
from continuum.compressible_fields import Fields, Values, block, node_densities, nodes
from continuum.compressible_loop import VX, VY, E, FluxForm
from continuum.fluid import ConstEta, IdealGas, energy
from continuum.scene import Torus
from studies.cost import speed_cases_vortex as vortices
from studies.cost import speed_cases_waves as waves
from studies.cost import speed_names as names
from studies.cost.speed_problem import Problem, Residuals

#: (rho, u, v, T) at places x, y
Start = Callable[[np.ndarray, np.ndarray], tuple[np.ndarray, ...]]


@dataclass(frozen=True, kw_only=True)
class Tile:
    """What the grid's march asks of a scene: rows and columns of cells of size 1, periodic both ways, one fluid."""
    rows: int
    columns: int
    law: ConstEta
    T_hot: float = 1.0
    T_cold: float = 1.0
    g: float = 0.0
    sides: Any = Torus()  # noqa: RUF009 (immutable)
    eos: Any = IdealGas()  # noqa: RUF009

    @property
    def L(self) -> float:
        return float(self.rows)

    @property
    def width(self) -> float:
        return float(self.columns)

    @property
    def aspect(self) -> float:
        return self.columns/self.rows

    @property
    def places(self) -> np.ndarray:
        """Of all nodes but the last column and row, which repeat the first: (rows*columns, 2)."""
        x, y = nodes(self, self.rows)
        return np.stack(np.meshgrid(x[:-1], y[:-1]), axis=-1).reshape(-1, 2)


def started(tile: Tile, start: Start) -> np.ndarray:
    """The block of a start; its ghosts are filled."""
    x, y = nodes(tile, tile.rows)
    rho, u, v, T = start(*np.meshgrid(x, y))
    cells = start(*np.meshgrid((x[1:] + x[:-1])/2, (y[1:] + y[:-1])/2))[0]
    return March(tile, block(Fields(tile, x, y, Values(u, v, energy(tile.eos, rho, T), T, rho), cells)), FluxForm(), 1.0).S


def at_nodes(S: np.ndarray) -> tuple[np.ndarray, ...]:
    """(rho, u, v, e), each (rows*columns,), where `Tile.places` are."""
    return tuple(f[:-1, :-1].ravel() for f in (node_densities(S), S[VX, 1:, 1:], S[VY, 1:, 1:], S[E, 1:, 1:]))


def problem_of(tile: Tile, start: Start, time: float, residuals: Callable[[np.ndarray], Residuals], known: float) -> Problem:
    """The grid in time."""
    first = started(tile, start)
    march = March(tile, first.copy(), FluxForm(), 1.0)

    def go(S: np.ndarray, dt: float, steps: int) -> np.ndarray:
        marched = March(tile, S.copy(), FluxForm(), dt)
        marched.go(steps)
        return marched.S
    return Problem(tile.rows*tile.columns, first, limits(tile, first).both, time, go, residuals,
                   lambda: (march.S, march.scratch), known)


class OnVortex(NamedTuple):
    """The Taylor-Green vortex."""
    name: str = names.GRID
    first: float = 0.9
    mach: float = vortices.MACH

    def seconds(self, resolution: int) -> float:
        return 0.5 + 8e-6*resolution**3

    def problem(self, resolution: int, seed: int) -> Problem:
        vortex = vortices.Vortex(self.mach, resolution)
        tile = Tile(rows=resolution, columns=resolution, law=ConstEta(vortex.eta, vortex.eta))

        def start(x: np.ndarray, y: np.ndarray) -> tuple[np.ndarray, ...]:
            at = np.stack([x.ravel(), y.ravel()], axis=1)
            T = vortices.start_density(vortex, at).reshape(x.shape)
            u, v = (one.reshape(x.shape) for one in vortex.velocity(at).T)
            return T, u, v, T

        def residuals(S: np.ndarray) -> Residuals:
            rho, u, v, _ = at_nodes(S)
            return vortices.compared(vortex, np.ones_like(rho), tile.places, np.stack([u, v], axis=1))
        return problem_of(tile, start, vortex.time, residuals, vortices.KNOWN[self.mach])


class OnWave(NamedTuple):
    """Sound along rows."""
    name: str = names.GRID
    first: float = 0.9

    def seconds(self, length: int) -> float:
        return 0.3 + 3e-5*length**2

    def problem(self, length: int, seed: int) -> Problem:
        wave = waves.Wave(length)
        tile = Tile(rows=waves.BREADTH, columns=length, law=ConstEta(wave.eta, wave.eta))

        def start(x: np.ndarray, y: np.ndarray) -> tuple[np.ndarray, ...]:
            rho, _, T = wave.exactly(0.0, x.ravel()).reshape(3, *x.shape)
            return 1 + rho, 0*x, 0*x, 1 + T

        def residuals(S: np.ndarray) -> Residuals:
            rho, u, _, e = at_nodes(S)
            return wave.compared(np.ones_like(rho), tile.places[:, 0], u, e)
        return problem_of(tile, start, wave.time, residuals, waves.KNOWN)


VORTEX, WAVE = OnVortex(), OnWave()
