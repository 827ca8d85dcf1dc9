"""Gas in a square periodic box by Fourier sums, from any smooth start; k may differ from eta.

The equations are those of `vortex`. Where viscosity is small, products of waves would pile up in the shortest
ones: each step multiplies wave m by exp(-36 (m/m_max)^16)    [Hou & Li 2007]

Lengths are in boxes: a start takes places (m, 2) from -1/2 to 1/2 and gives rho (m,), v (m, 2), T (m,).
"""
from collections.abc import Callable
from functools import cache, partial

import numpy as np

from continuum.exact.vortex import ODD, advanced, at, derivative, longest_step, rates, waves

OF_LIMIT = 0.9      # of the longest stable step: waves that matter are far longer than the shortest one
Start = Callable[[np.ndarray], tuple[np.ndarray, np.ndarray, np.ndarray]]


@cache
def solved(start: Start, eta: float, k: float, time: float, n: int = ODD) -> np.ndarray:
    """Fourier amplitudes (n, n, 4) of (rho, u, v, T) after a time, on n x n points, n odd, by RK4."""
    axis = np.arange(n) - (n - 1)/2
    rho, v, T = start(np.stack(np.meshgrid(axis, axis, indexing="ij"), axis=-1).reshape(-1, 2)/n)
    state = np.array([rho, *(rho*v.T), rho*(T + (v**2).sum(axis=1)/2)]).reshape(4, n, n)
    into_waves = waves(axis/n, n).conj()/n
    smooth = (np.conj(n*into_waves)*np.exp(-36*np.linspace(-1, 1, n)**16)@into_waves.T).real
    state = advanced(state, partial(slopes, eta=n*eta, k=n*k, D=derivative(n)), n*time,
                     OF_LIMIT*longest_step(state, n*max(eta, k)), smooth)
    rho, (u, v) = state[0], state[1:3]/state[0]
    fields = np.array([rho, u, v, state[3]/rho - (u**2 + v**2)/2])
    return np.einsum("xk,yl,axy->kla", into_waves, into_waves, fields, optimize=True)


def slopes(state: np.ndarray, eta: float, k: float, D: np.ndarray) -> np.ndarray:
    """d(state)/dt, (4, n, n): `rates`, where k = eta, and the conduction by k - eta."""
    out = rates(state, eta, D)
    if k != eta:
        rho = state[0]
        T = state[3]/rho - (state[1:3]**2).sum(axis=0)/(2*rho**2)
        out[3] += (k - eta)*(D@(D@T) + (T@D.T)@D.T)
    return out


def fields(amplitudes: np.ndarray, place: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """rho (p,), v (p, 2), T (p,) at places (p, 2)."""
    rho, u, v, T = at(amplitudes, place)
    return rho, np.stack([u, v], axis=1), T
