"""Basis functions of fields: waves in x, polynomials in y, and the quadrature points along both axes.

Half of a pair of rolls is enough: the flow is mirror-symmetric about the middles of rising and falling
streams. So v_x is a sum of sines, each other field of cosines of 2 pi k x/width, k < n. In y there are n
polynomials, with Legendre's P_m: P_m - P_(m+2) for fields that vanish at the plates, P_m for density or
pressure. They span the same space as Chebyshev's, and their integrals are better conditioned. Velocities have
two degrees more than the pressure, which excludes spurious pressure modes.
"""
from functools import lru_cache
from typing import NamedTuple

import numpy as np
from numpy.polynomial import legendre

VX, VY, RHO, T = range(4)   # fields; of a Boussinesq fluid the third is the pressure
POINTS = 1.5                # per function, along each axis: integrals of products of three are exact


class Along(NamedTuple):
    """Points and weights along an axis; values and slopes of each field's functions, (2, 4, points, n)."""
    points: np.ndarray
    weights: np.ndarray
    functions: np.ndarray


def waves_at(x: np.ndarray, n: int, width: float) -> np.ndarray:
    """Values and slopes of each field's n waves at x (points,), (2, 4, points, n). Fluid rises at x = 0."""
    k = 2*np.pi*np.arange(n)/width
    sin, cos = np.sin(np.outer(x, k)), np.cos(np.outer(x, k))
    return np.array([[sin, cos, cos, cos], [k*cos, -k*sin, -k*sin, -k*sin]])


def polynomials_at(y: np.ndarray, n: int) -> np.ndarray:
    """Values and slopes of each field's n polynomials at y (points,) of -1/2 to 1/2, (2, 4, points, n)."""
    slopes = legendre.legval(2*y, 2*legendre.legder(np.eye(n + 2))).T
    every = np.array([legendre.legvander(2*y, n + 1), slopes])
    free, fixed = every[..., :-2], every[..., :-2] - every[..., 2:]
    return np.stack([fixed, fixed, free, fixed], axis=1)


@lru_cache(maxsize=8)
def along_x(n: int, width: float) -> Along:
    """Waves on 0 < x < width/2; lengths are in heights of the layer."""
    count = int(POINTS*n) + 1
    x = (np.arange(count) + 0.5)/count*width/2
    return Along(x, np.full(count, width/2/count), waves_at(x, n, width))


@lru_cache(maxsize=8)
def along_y(n: int) -> Along:
    """Polynomials on -1/2 < y < 1/2."""
    z, weights = legendre.leggauss(int(POINTS*n) + 3)
    return Along(z/2, weights/2, polynomials_at(z/2, n))
