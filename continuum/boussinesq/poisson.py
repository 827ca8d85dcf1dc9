"""Fast solves with the five-point Laplacian: sine and cosine modes are its exact eigenvectors."""
from collections.abc import Callable
from functools import partial
from typing import NamedTuple

import numpy as np
from scipy import fft

from continuum.boussinesq.mac import Axis, End, Mac


class Modes(NamedTuple):
    """Transform along one axis, its inverse, and the eigenvalues of the second difference there."""
    forward: Callable
    backward: Callable
    eigenvalues: np.ndarray


def modes(axis: Axis, along: int, end: End) -> Modes:
    """For what sits in cells."""
    n = axis.cells
    if end is End.MIRROR:
        return Modes(partial(fft.dct, axis=along), partial(fft.idct, axis=along),
                     bend(axis.h, np.arange(n)/n))
    return Modes(partial(fft.dst, axis=along), partial(fft.idst, axis=along),
                 bend(axis.h, np.arange(1, n + 1)/n))


def face_modes(axis: Axis, along: int) -> Modes:
    """For what sits on faces and vanishes in the walls."""
    return Modes(partial(fft.dst, type=1, axis=along), partial(fft.idst, type=1, axis=along),
                 bend(axis.h, np.arange(1, axis.cells)/axis.cells))


def bend(h: float, half_turns: np.ndarray) -> np.ndarray:
    """Second difference of a wave that advances by pi*half_turns from point to point."""
    return -(2/h*np.sin(np.pi*half_turns/2))**2


class Solver:
    """Solves (a + b Lap) f = g on one of the staggered sets of points."""

    def __init__(self, x: Modes, y: Modes):
        self.x, self.y = x, y
        self.lap = x.eigenvalues[:, None] + y.eigenvalues[None, :]

    def __call__(self, g: np.ndarray, a: float, b: float) -> np.ndarray:
        """f of the shape of g (x, y); with a = 0 and ends that leave a constant free, its mean is zero."""
        factor = a + b*self.lap
        amplitude = self.x.forward(self.y.forward(g))
        amplitude = np.divide(amplitude, factor, out=np.zeros_like(amplitude), where=factor != 0)
        return self.y.backward(self.x.backward(amplitude))


def solvers(mac: Mac) -> tuple[Solver, Solver, Solver, Solver]:
    """For u, v, T and the pressure."""
    x, y, sides, plates = mac.x, mac.y, mac.box.sides, mac.box.plates
    return (Solver(face_modes(x, 0), modes(y, 1, plates.flow)),
            Solver(modes(x, 0, sides.flow), face_modes(y, 1)),
            Solver(modes(x, 0, sides.heat), modes(y, 1, plates.heat)),
            Solver(modes(x, 0, End.MIRROR), modes(y, 1, End.MIRROR)))
