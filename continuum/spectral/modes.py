"""Functions that fields are made of: waves in x, polynomials in y, and the points where they are looked at.

One half of a pair of rolls is enough: the flow is its own mirror image about the middle of a rising and of a
falling stream. So v_x is made of sines, all else of cosines of 2 pi k x/width, k < n. In y there are n
polynomials, P_m - P_(m+2) for what vanishes at the plates, P_m for density or pressure, P_m being Legendre's:
they span what Chebyshev's span, and their integrals are better conditioned. Velocities so have two degrees
more than the pressure, which leaves no false pressures.
"""
from functools import lru_cache
from typing import NamedTuple

import numpy as np
from numpy.polynomial import legendre

VX, VY, RHO, T = range(4)   # fields; of a Boussinesq fluid the third is the pressure
POINTS = 1.5                # for each function, along each axis: integrals of three functions are exact


class Along(NamedTuple):
    """Points and weights along an axis; functions of each field there and their slopes (2, 4, points, n)."""
    points: np.ndarray
    weights: np.ndarray
    functions: np.ndarray


@lru_cache(maxsize=8)
def along_x(n: int, width: float) -> Along:
    """Waves on 0 < x < width/2, lengths in heights of the layer."""
    count = int(POINTS*n) + 1
    x = (np.arange(count) + 0.5)/count*width/2
    k = 2*np.pi*np.arange(n)/width
    sin, cos = np.sin(np.outer(x, k)), np.cos(np.outer(x, k))
    values, slopes = [sin, cos, cos, cos], [k*cos, -k*sin, -k*sin, -k*sin]
    return Along(x, np.full(count, width/2/count), np.array([values, slopes]))


@lru_cache(maxsize=8)
def along_y(n: int) -> Along:
    """Polynomials on -1/2 < y < 1/2."""
    z, weights = legendre.leggauss(int(POINTS*n) + 3)
    slopes = legendre.legval(z, 2*legendre.legder(np.eye(n + 2))).T
    every = np.array([legendre.legvander(z, n + 1), slopes])
    free, fixed = every[..., :-2], every[..., :-2] - every[..., 2:]
    return Along(z/2, weights/2, np.stack([fixed, fixed, free, fixed], axis=1))
