"""Slow flow past a square array of cylinders on whose surface the fluid slips, by collocation    [Sangani & Acrivos 1982]

On a surface of slip length b the velocity along it is b times the shear rate there [Navier]. Lengths are in radii.
"""
from functools import cache

import numpy as np
from scipy.optimize import brentq

TERMS, PLACES = 12, 60      # the drag is then good to 2e-4 of itself at a solid fraction of 0.3, to 1e-6 at 0.2
LEAST, MOST = -0.3, 3.0     # slip lengths among which that of a drag is looked for


@cache
def drag(fraction: float, slip: float = 0.0) -> float:
    """F/(eta U) of a cylinder at this solid fraction, U the velocity averaged over the cell, F with the mean pressure gradient's.

    psi is a sum of biharmonic functions, odd in y, that keep both conditions on the cylinder; least squares on a quarter of the
    cell's boundary do the rest: psi_x = omega_x = 0 beside, psi = U y and omega = 0 above. F = 4 pi eta times the factor of
    y ln r in psi. A negative slip length is of a fluid that sticks so far outside: to first order the same, and there is a flow.

    Raises
    ------
    ValueError
        There is no room between cylinders.
    """
    if slip < 0:
        return drag(fraction*(1 - slip)**2)
    if not 0 < fraction < np.pi/4:
        raise ValueError(f"no flow past cylinders of solid fraction {fraction:g} in a square array: it is positive, and they "
                         "touch at pi/4")
    half = float(np.sqrt(np.pi/fraction))/2
    along = (np.arange(PLACES) + 0.5)/PLACES*half
    columns, heads = [], []
    for m in range(1, 2*TERMS, 2):
        beside, above = functions(m, half + 1j*along), functions(m, along + 1j*half)
        for k, weights in enumerate(on_surface(m, slip)):
            weights = weights*half**-(m + 2*k)      # all of one size on the boundary
            columns.append(np.concatenate([weights@beside[1], weights@beside[3], weights@above[0], weights@above[2]]))
            heads.append(weights[3] if m == 1 else 0.0)
    found = np.linalg.lstsq(np.array(columns).T, np.repeat([0.0, 0.0, half, 0.0], PLACES), rcond=None)[0]
    return float(4*np.pi*found@np.array(heads))


def on_surface(m: int, slip: float) -> np.ndarray:
    """The two combinations (2, 4) of r^m, r^(m+2), r^-m, r^(2-m), the last r ln r if m = 1, that keep the conditions at r = 1.

    No fluid crosses: f = 0; it slips: f' = slip (f'' - f').
    """
    power = np.array([m, m + 2, -m, 2 - m], float)
    value, first, second = np.ones(4), power, power*(power - 1)
    if m == 1:
        value, first, second = np.array([1, 1, 1, 0.0]), np.array([1, 3, -1, 1.0]), np.array([0, 6, 2, 1.0])
    rules = np.array([value, first - slip*(second - first)])
    return np.concatenate([np.eye(2), -np.linalg.solve(rules[:, 2:], rules[:, :2])]).T


def functions(m: int, z: np.ndarray) -> np.ndarray:
    """psi, psi_x, lap psi, (lap psi)_x (4, 4, points) of the four functions times sin(m angle) at z = x + iy."""
    x, r2 = z.real, np.abs(z)**2
    out, in_ = (z**m).imag, -(z**-m).imag
    out_x, in_x = (m*z**(m - 1)).imag, (m*z**(-m - 1)).imag
    zero = np.zeros_like(x)
    made = [[out, r2*out, in_, r2*in_],
            [out_x, 2*x*out + r2*out_x, in_x, 2*x*in_ + r2*in_x],
            [zero, 4*(1 + m)*out, zero, 4*(1 - m)*in_],
            [zero, 4*(1 + m)*out_x, zero, 4*(1 - m)*in_x]]
    if m == 1:
        y = z.imag
        for row, last in zip(made, (y*np.log(r2)/2, x*y/r2, 2*y/r2, -4*x*y/r2**2), strict=True):
            row[3] = last
    return np.array(made)


def slip_of(ratio: float, fraction: float) -> float:
    """Slip length in radii with which the drag is so many times that without; nan beyond what is looked at."""
    def miss(slip: float) -> float:
        return drag(fraction, slip)/drag(fraction) - ratio
    return float(brentq(miss, LEAST, MOST)) if miss(LEAST)*miss(MOST) < 0 else float("nan")
