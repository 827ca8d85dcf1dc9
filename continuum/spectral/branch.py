"""Branches of steady convection in a Boussinesq fluid, by arc-length continuation from onset    [Keller 1977]

In free-fall units all rates are linear in Ra^-1/2, so that rates at two Ra give their exact derivative. A
point of a branch is z = (amplitudes, s), s being Ra^-1/2 over its value at onset; rates vanish there. The
next point lies at a given distance along the tangent: bifurcations and turning points do no harm.
"""
from collections.abc import Callable, Iterator, Sequence
from functools import partial

import numpy as np
from scipy.linalg import solve

from continuum.linear import critical_ra
from continuum.spectral.laws import BoussinesqLaws
from continuum.spectral.newton import Galerkin, SpectralState, onset
from continuum.steady import newton

#: s, Ra^-1/2 over its value at onset -> equations
At = Callable[[float], Galerkin]


def branch(pr: float, n: int, steps: Sequence[float], width: float = 2.0) -> Iterator[SpectralState]:
    """Yield pairs of rolls in a box of this width, with n functions along an axis: the onset, then a state
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
    """First point of a branch and its tangent: onset, and the neutral rolls, which rise at x = 0."""
    rest = np.zeros(int(equations.kept.sum()))
    rolls = np.linalg.svd(equations.slopes(rest))[2][-1]
    return np.append(rest, 1.0), np.append(rolls*np.sign(rolls[equations.n**2]), 0.0)   # as in `onset`


def farther(at: At, start: np.ndarray, tangent: np.ndarray,
            step: float) -> tuple[np.ndarray, np.ndarray, tuple[float, ...]]:
    """Next point, at distance `step` along the tangent; its tangent; the changes of Newton's steps."""
    def change(z: np.ndarray) -> np.ndarray:
        return solve(bordered(at, z, tangent), np.append(at(z[-1]).rates(z[:-1]), step - tangent@(z - start)))
    z, changes = newton(start + step*tangent, change, f"a step of {step:g} along a branch")
    ahead = solve(bordered(at, z, tangent), np.append(0*z[:-1], 1.0))
    return z, ahead/np.linalg.norm(ahead), changes


def bordered(at: At, z: np.ndarray, tangent: np.ndarray) -> np.ndarray:
    """Jacobian in z of (-rates, distance along the tangent)."""
    q, s = z[:-1], z[-1]
    in_s = 2/s*(at(s/2).rates(q) - at(s).rates(q))      # slope of -rates in s: exact, rates are linear in s
    return np.block([[at(s).slopes(q), in_s[:, None]], [tangent]])
