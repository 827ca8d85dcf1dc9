"""Small plane waves in a gas at rest: linear rates, and the transport coefficients that follow from them.

Around rho = T = 1 of an ideal gas, P = rho T, C_V = 1, waves exp(ik.r) of (rho, u, T), u along k, obey

    rho' = -i s u        u' = -i s (rho + T) - l u        T' = -i s u - q T        and across k: v' = -t v

with s = k, l = (2 eta (1 - 1/d) + zeta) k^2, q = kappa k^2, t = eta k^2. A scheme has its own s, l, q, t.
"""
from typing import NamedTuple

import numpy as np


class LinearGas(NamedTuple):
    """Shear viscosity, bulk viscosity and heat conductivity."""
    eta: float
    zeta: float
    kappa: float


class Waves(NamedTuple):
    """Linear rates at one wave vector: matrix (3, 3) of (rho, u, T), and the decay rate of shear."""
    matrix: np.ndarray
    shear: float


#: computed from the rates of waves of one length: transport coefficients, speed and decay rates
QUANTITIES = ("viscosity", "bulk viscosity", "conductivity", "sound speed", "sound damping", "heat decay")


def waves(s: float, l: float, q: float, t: float) -> Waves:
    """Rates from the numbers s, l, q, t of the module's docstring."""
    return Waves(np.array([[0, -1j*s, 0], [-1j*s, -l, -1j*s], [0, -1j*s, -q]]), t)


def continuum(gas: LinearGas, k: float, d: int = 2) -> Waves:
    """Rates of the Navier-Stokes-Fourier equations."""
    return waves(k, (2*gas.eta*(1 - 1/d) + gas.zeta)*k**2, gas.kappa*k**2, gas.eta*k**2)


def quantities(rates: Waves, k: float) -> dict[str, float]:
    """QUANTITIES in 2D: viscosities, conductivity, speed and damping of sound, decay of the heat mode."""
    eigen = np.linalg.eigvals(rates.matrix)
    sound, heat = eigen[np.argmax(eigen.imag)], eigen[np.argmin(np.abs(eigen.imag))]
    eta, along = rates.shear/k**2, -rates.matrix[1, 1].real/k**2
    values = eta, along - eta, -rates.matrix[2, 2].real/k**2, sound.imag/k, -sound.real, -heat.real
    return dict(zip(QUANTITIES, map(float, values), strict=True))
