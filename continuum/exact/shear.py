"""Shear flows: start-up between plates as Fourier series; waves on a periodic one."""
import numpy as np
from scipy.integrate import solve_ivp

HARMONICS = 20      # of either sign: the error of the growth rate is 1e-9
TERMS = 60          # of a series; the next one is exp(-60^2 pi^2 0.02) = 1e-308 at t = 0.02


def couette(y: np.ndarray, time: float) -> np.ndarray:
    """u (n,) at heights y/H over the speed of the upper plate, time in H^2/nu."""
    n = np.arange(1, TERMS + 1)
    waves = 2/(n*np.pi)*(-1.0)**n*np.exp(-(n*np.pi)**2*time)*np.sin(np.pi*n*y[:, None])
    return y + waves.sum(axis=1)


def poiseuille(y: np.ndarray, time: float) -> np.ndarray:
    """u (n,) at heights y/H over its final value in the middle, force H^2/(8 nu), time in H^2/nu."""
    n = np.arange(1, TERMS + 1, 2)
    waves = 32/(n*np.pi)**3*np.exp(-(n*np.pi)**2*time)*np.sin(np.pi*n*y[:, None])
    return 4*y*(1 - y) - waves.sum(axis=1)


def growing_wave(U: float, k: float, kx: float) -> tuple[float, np.ndarray]:
    """Growth rate of the wave exp(i k_x x) on u = U sin ky that grows fastest, and its amplitudes psi_n.

    n = -HARMONICS .. HARMONICS    [Rayleigh 1880; Meshalkin & Sinai 1961]

    Small waves obey q_t = -i k_x u (q + k^2 psi), q = lap psi, so harmonics q_n exp(inky) of each other:

        dq_n/dt = -(k_x U/2) [(1 - k^2/K_(n-1)^2) q_(n-1) - (1 - k^2/K_(n+1)^2) q_(n+1)]
        K_n^2 = k_x^2 + n^2 k^2
    """
    n = np.arange(-HARMONICS, HARMONICS + 1)
    K2 = kx**2 + (n*k)**2
    part = kx*U/2*(1 - k**2/K2)
    rates, modes = np.linalg.eig(np.diag(part[1:], 1) - np.diag(part[:-1], -1))
    best = int(np.argmax(rates.real))
    return float(rates[best].real), -modes[:, best]/K2


def layer_with_wave(x: np.ndarray, U: float, k: float, size: float) -> np.ndarray:
    """Velocities (n, 2) at places (n, 2): U sin ky plus its growing wave of k_x = k/2, amplitude size U."""
    kx, (_, psi) = k/2, growing_wave(U, k, k/2)
    psi = psi*size*U/(kx*abs(psi[HARMONICS]))
    n = np.arange(-HARMONICS, HARMONICS + 1)[:, None]
    waves = psi[:, None]*np.exp(1j*(kx*x[:, 0] + n*k*x[:, 1]))
    u = U*np.sin(k*x[:, 1]) + (1j*n*k*waves).sum(axis=0).real
    return np.stack([u, -(1j*kx*waves).sum(axis=0).real], axis=1)


def viscous_growth(U: float, k: float, kx: float, nu: float, time: float) -> float:
    """Factor by which the wave of `growing_wave` grows in a time, on u = U sin ky exp(-nu k^2 t).

    The rates are those of `growing_wave` with U(t), minus nu K_n^2 q_n.
    """
    n = np.arange(-HARMONICS, HARMONICS + 1)
    K2 = kx**2 + (n*k)**2
    part = kx*U/2*(1 - k**2/K2)
    mixing = np.diag(part[1:], 1) - np.diag(part[:-1], -1)
    _, psi = growing_wave(U, k, kx)
    first = -K2*psi/psi[HARMONICS]

    def slope(t: float, q: np.ndarray) -> np.ndarray:
        return np.exp(-nu*k**2*t)*(mixing@q) - nu*K2*q
    q = solve_ivp(slope, (0, time), first.astype(complex), rtol=1e-9, atol=1e-12).y[:, -1]
    return float(abs(q[HARMONICS]/first[HARMONICS]))
