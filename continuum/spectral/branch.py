"""Branches of steady convection in a Boussinesq fluid, followed along their arc from the state at rest.

In free-fall units all rates are linear in s = Ra^-1/2, so those at two Ra tell their slope in it. A point of
a branch is z = (amplitudes, s over that of the onset): there the rates vanish. The next point lies a step
farther along the tangent, so that neither onsets nor turns are in the way    [Keller 1977].
"""
from collections.abc import Callable, Iterator, Sequence
from functools import partial

import numpy as np
from scipy.linalg import solve

from continuum.linear import critical_ra
from continuum.spectral.laws import BoussinesqLaws
from continuum.spectral.newton import Galerkin, SpectralState, onset
from continuum.steady import newton

#: s over that of the onset -> equations
At = Callable[[float], Galerkin]


def branch(pr: float, n: int, steps: Sequence[float], width: float = 2.0) -> Iterator[SpectralState]:
    """Pairs of rolls in a box of this width, on n functions along an axis: first the onset, then a state
    after each step. Raises ValueError: a step is not positive. NewtonFailed: a step is too long."""
    if not min(steps) > 0:
        raise ValueError(f"steps along a branch must be positive, got {min(steps)}: they lead away from rest")
    laws, near = partial(BoussinesqLaws, pr=pr, width=width), critical_ra(2*np.pi/width)
    first = onset(laws, n, 0.9*near, 1.1*near)

    def at(s: float) -> Galerkin:
        return Galerkin(laws(float(first/s**2)), n)
    z, tangent = begun(at(1.0))
    yield SpectralState(at(1.0), z[:-1], ())
    for step in steps:
        z, tangent, changes = farther(at, z, tangent, step)
        yield SpectralState(at(z[-1]), z[:-1], changes)


def begun(equations: Galerkin) -> tuple[np.ndarray, np.ndarray]:
    """The onset, and the tangent there: rolls that neither grow nor decay, rising at x = 0."""
    rest = np.zeros(int(equations.kept.sum()))
    rolls = np.linalg.svd(equations.slopes(rest))[2][-1]
    return np.append(rest, 1.0), np.append(rolls*np.sign(rolls[equations.n**2]), 0.0)   # as in `onset`


def farther(at: At, start: np.ndarray, tangent: np.ndarray,
            step: float) -> tuple[np.ndarray, np.ndarray, tuple[float, ...]]:
    """The point a step along the tangent, the tangent there, the changes of Newton's steps."""
    def change(z: np.ndarray) -> np.ndarray:
        return solve(bordered(at, z, tangent), np.append(at(z[-1]).rates(z[:-1]), step - tangent@(z - start)))
    z, changes = newton(start + step*tangent, change, f"a step of {step:g} along a branch")
    ahead = solve(bordered(at, z, tangent), np.append(0*z[:-1], 1.0))
    return z, ahead/np.linalg.norm(ahead), changes


def bordered(at: At, z: np.ndarray, tangent: np.ndarray) -> np.ndarray:
    """Slopes of (-rates, distance along the tangent) in z."""
    q, s = z[:-1], z[-1]
    in_s = 2/s*(at(s/2).rates(q) - at(s).rates(q))      # of -rates, exactly: they are linear in s
    return np.block([[at(s).slopes(q), in_s[:, None]], [tangent]])
