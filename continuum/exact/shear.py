"""Shear flows between plates that start from rest, as series; heights y/H, times in H^2/nu."""
import numpy as np

TERMS = 60          # the next one is exp(-60^2 pi^2 0.02) = 1e-308 at t = 0.02


def couette(y: np.ndarray, time: float) -> np.ndarray:
    """u over the speed of the upper plate."""
    n = np.arange(1, TERMS + 1)
    waves = 2/(n*np.pi)*(-1.0)**n*np.exp(-(n*np.pi)**2*time)*np.sin(np.pi*n*y[:, None])
    return y + waves.sum(axis=1)


def poiseuille(y: np.ndarray, time: float) -> np.ndarray:
    """u over its final value in the middle, force H^2/(8 nu)."""
    n = np.arange(1, TERMS + 1, 2)
    waves = 32/(n*np.pi)**3*np.exp(-(n*np.pi)**2*time)*np.sin(np.pi*n*y[:, None])
    return 4*y*(1 - y) - waves.sum(axis=1)
