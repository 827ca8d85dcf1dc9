"""Plane waves of small amplitude in a gas at rest: what the continuum makes of them, and what a lattice does    [RR98, Sec. III]

About rho = T = 1 of an ideal gas, P = rho T, C_V = 1, waves exp(ik.r) of (rho, u, T), u along k, obey

    rho' = -i s u        u' = -i s (rho + T) - l u        T' = -i s u - q T        and across k: v' = -t v

with s = k, l = (2 eta (1 - 1/d) + zeta) k^2, q = kappa k^2, t = eta k^2 in the continuum. A square lattice of unit spacing has
sums over its points r in their place, w = c W(r) with c from sum_r w r = d, e = r/r:

    s = sum_r w e.n sin k.r                                           [Eqs 34-36], n = k/k
    nested: l, q, t with s^2 for k^2                                    [Eqs 37, 38]
    pairwise: sum_r (2 w/r) (1 - cos k.r) times A + B (e.n)^2 for l, A + B (e.m)^2 for t, m across k, and kappa for q   [Eq. 51]

Nothing here knows the matrices that are under test.
"""
from typing import Any, NamedTuple

import numpy as np

from particles.integral.interpolants import W, reach


class Gas(NamedTuple):
    """Shear and bulk viscosity, conductivity."""
    eta: float
    zeta: float
    kappa: float


class Waves(NamedTuple):
    """Linear rates at one wave vector: the matrix (3, 3) of (rho, u, T), and the decay of shear."""
    matrix: np.ndarray
    shear: float


#: what is read off the rates of waves of one length; rates are per time, the others coefficients of the gas
QUANTITIES = ("viscosity", "bulk viscosity", "conductivity", "sound speed", "sound damping", "heat decay")


def waves(s: float, l: float, q: float, t: float) -> Waves:
    """From the numbers above."""
    return Waves(np.array([[0, -1j*s, 0], [-1j*s, -l, -1j*s], [0, -1j*s, -q]]), t)


def continuum(gas: Gas, k: float, d: int = 2) -> Waves:
    """Navier, Stokes and Fourier."""
    return waves(k, (2*gas.eta*(1 - 1/d) + gas.zeta)*k**2, gas.kappa*k**2, gas.eta*k**2)


def neighbours(weight: Any, d: int) -> np.ndarray:
    """Points r (m, d) of the unit lattice within the range of a weight."""
    q = np.arange(-int(reach(weight)), int(reach(weight)) + 1)
    r = np.stack([axis.ravel() for axis in np.meshgrid(*[q]*d)], axis=1)
    size = np.sqrt((r**2).sum(axis=1))
    return r[(size > 0) & (size < reach(weight))]


def lattice_waves(gas: Gas, weight: Any, k: np.ndarray, nested: bool) -> Waves:
    """At the wave vector k (2,) on the square lattice; along an axis or a diagonal, where the gradient is along k."""
    d = len(k)
    r = neighbours(weight, d)
    size, n = np.sqrt((r**2).sum(axis=1)), k/np.hypot(*k)
    w = W(weight, size)
    w *= d/(w@size)
    along, across = r@n/size, r@np.array([-n[1], n[0]])/size
    s = float((w*along)@np.sin(r@k))
    if nested:
        return continuum(gas, s, d)
    slow = 2*w/size*(1 - np.cos(r@k))
    B, A = gas.eta*(1/2 + 1/d) - gas.zeta/2, (d + 2)/2*(gas.eta*(1 - 2/d) + gas.zeta)
    return waves(s, float(slow@(B + A*along**2)), gas.kappa*float(slow.sum()), float(slow@(B + A*across**2)))


def quantities(found: Waves, k: float, d: int = 2) -> dict[str, float]:
    """Viscosities, conductivity, speed and damping of sound, decay of the heat mode."""
    eigen = np.linalg.eigvals(found.matrix)
    sound, heat = eigen[np.argmax(eigen.imag)], eigen[np.argmin(np.abs(eigen.imag))]
    eta, along = found.shear/k**2, -found.matrix[1, 1].real/k**2
    values = (eta, along - 2*(1 - 1/d)*eta, -found.matrix[2, 2].real/k**2, sound.imag/k, -sound.real, -heat.real)
    return dict(zip(QUANTITIES, map(float, values), strict=True))
