"""A round vortex of even density that its pressure holds together, in boxes    [Gresho & Chan 1990]

Velocities 5 r, then 2 - 5 r from r = 0.2 to 0.4, over the largest. With friction nu they diffuse, but for
the square of the Mach number: round flows of a fluid without compression do nothing else.
"""
from functools import cache

import numpy as np
from scipy.ndimage import map_coordinates

FINE = 512          # places along a box, of which 18 are as long as friction reaches at nu t = 6e-4


def velocity(place: np.ndarray) -> np.ndarray:
    """(n, 2) at places (n, 2)."""
    r = np.hypot(*place.T)
    swirl = np.maximum(np.minimum(5*r, 2 - 5*r), 0)/np.maximum(r, 1e-12)
    return np.stack([-swirl*place[:, 1], swirl*place[:, 0]], axis=1)


def pressure(place: np.ndarray) -> np.ndarray:
    """(n,) over density and the square of the largest velocity, 0 outside."""
    r = np.hypot(*place.T)
    outer = np.clip(r, 0.2, 0.4)
    inner = np.minimum(r, 0.2)**2 + outer**2 - 0.04
    return 12.5*inner + 4*(1 - 5*outer + np.log(5*outer)) + 2 - 4*np.log(2)


@cache
def diffused(spread: float) -> np.ndarray:
    """Velocities (2, FINE, FINE) at nu t = spread, in a periodic box."""
    axis = np.arange(FINE)/FINE - 0.5
    v = velocity(np.stack(np.meshgrid(axis, axis, indexing="ij"), axis=-1).reshape(-1, 2))
    k = 2*np.pi*FINE*np.fft.fftfreq(FINE)
    decay = np.exp(-spread*np.add.outer(k**2, k**2))
    return np.fft.ifft2(decay*np.fft.fft2(v.T.reshape(2, FINE, FINE))).real


def velocity_at(spread: float, place: np.ndarray) -> np.ndarray:
    """(n, 2) at places (n, 2), by splines."""
    at = (place + 0.5).T*FINE
    return np.stack([map_coordinates(part, at, mode="grid-wrap") for part in diffused(spread)], axis=1)
