"""Round vortex of uniform density, held together by its pressure; lengths in boxes    [Gresho & Chan 1990]

The velocity over its largest value is 5 r up to r = 0.2, then 2 - 5 r up to 0.4. With a viscosity nu it
diffuses, to the order of the Mach number squared, as round incompressible flows do.
"""
from functools import cache

import numpy as np
from scipy.ndimage import map_coordinates

FINE = 512          # grid points along the box; 18 of them span the diffusion length at nu t = 6e-4


def velocity(place: np.ndarray) -> np.ndarray:
    """Velocities (n, 2) at the start, at places (n, 2)."""
    r = np.hypot(*place.T)
    swirl = np.maximum(np.minimum(5*r, 2 - 5*r), 0)/np.maximum(r, 1e-12)
    return np.stack([-swirl*place[:, 1], swirl*place[:, 0]], axis=1)


def pressure(place: np.ndarray) -> np.ndarray:
    """Pressure (n,) over density and largest velocity squared, 0 outside the vortex."""
    r = np.hypot(*place.T)
    outer = np.clip(r, 0.2, 0.4)
    inner = np.minimum(r, 0.2)**2 + outer**2 - 0.04
    return 12.5*inner + 4*(1 - 5*outer + np.log(5*outer)) + 2 - 4*np.log(2)


@cache
def diffused(spread: float) -> np.ndarray:
    """Velocities (2, FINE, FINE) after diffusion with nu t = spread, in a periodic box."""
    axis = np.arange(FINE)/FINE - 0.5
    v = velocity(np.stack(np.meshgrid(axis, axis, indexing="ij"), axis=-1).reshape(-1, 2))
    k = 2*np.pi*FINE*np.fft.fftfreq(FINE)
    decay = np.exp(-spread*np.add.outer(k**2, k**2))
    return np.fft.ifft2(decay*np.fft.fft2(v.T.reshape(2, FINE, FINE))).real


def velocity_at(spread: float, place: np.ndarray) -> np.ndarray:
    """Velocities (n, 2) at nu t = spread, at places (n, 2), interpolated by cubic splines."""
    at = (place + 0.5).T*FINE
    return np.stack([map_coordinates(part, at, mode="grid-wrap") for part in diffused(spread)], axis=1)
