"""The compressible grid without plates: it takes part in the Taylor-Green vortex and in the sound wave.

Errors are told at nodes.
"""
from collections.abc import Callable
from functools import partial
from typing import NamedTuple

import numpy as np

from continuum.fluid import ConstEta
from continuum.gas.fields import block, node_densities, nodes, placed
from continuum.gas.loop import VX, VY, E, FluxForm
from continuum.gas.solve import March, limits
from continuum.scene import Tile
from studies.cost import names, waves
from studies.cost import vortex as vortices
from studies.cost.problem import Problem, Residuals

#: (rho, u, v, T) at places x, y
Start = Callable[[np.ndarray, np.ndarray], tuple[np.ndarray, ...]]


def places(tile: Tile) -> np.ndarray:
    """Of all nodes but the last column and row, which repeat the first: (n, 2)."""
    x, y = nodes(tile, round(tile.L))
    return np.stack(np.meshgrid(x[:-1], y[:-1]), axis=-1).reshape(-1, 2)


def at_nodes(S: np.ndarray) -> tuple[np.ndarray, ...]:
    """(rho, u, v, e), each (n,), where `places` are."""
    return tuple(f[:-1, :-1].ravel() for f in (node_densities(S), S[VX, 1:, 1:], S[VY, 1:, 1:], S[E, 1:, 1:]))


def problem_of(tile: Tile, start: Start, time: float, residuals: Callable[[np.ndarray], Residuals], known: float) -> Problem:
    """The grid in time."""
    rows = round(tile.L)
    march = March(tile, block(placed(tile, rows, start)), FluxForm(), 1.0)      # fills the ghosts
    first = march.S.copy()

    def go(S: np.ndarray, dt: float, steps: int) -> np.ndarray:
        marched = March(tile, S.copy(), FluxForm(), dt)
        marched.go(steps)
        return marched.S
    return Problem(rows*round(tile.width), first, limits(tile, first).both, time, go, residuals,
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
        tile = Tile(width=resolution, L=resolution, law=ConstEta(vortex.eta, vortex.eta))

        def residuals(S: np.ndarray) -> Residuals:
            rho, u, v, _ = at_nodes(S)
            return vortices.compared(vortex, np.ones_like(rho), places(tile), np.stack([u, v], axis=1))
        return problem_of(tile, partial(vortices.start_at, vortex), vortex.time, residuals, vortices.KNOWN[self.mach])


class OnWave(NamedTuple):
    """Sound along rows."""
    name: str = names.GRID
    first: float = 0.9

    def seconds(self, length: int) -> float:
        return 0.3 + 3e-5*length**2

    def problem(self, length: int, seed: int) -> Problem:
        wave = waves.Wave(length)
        tile = Tile(width=length, L=waves.BREADTH, law=ConstEta(wave.eta, wave.eta))

        def residuals(S: np.ndarray) -> Residuals:
            rho, u, _, e = at_nodes(S)
            return wave.compared(np.ones_like(rho), places(tile)[:, 0], u, e)
        return problem_of(tile, wave.start_at, wave.time, residuals, waves.KNOWN)


VORTEX, WAVE = OnVortex(), OnWave()
