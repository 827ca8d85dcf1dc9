"""The gas of a layer in 3D, periodic along x and z, in time: a reference whose error falls exponentially.

Collocation with n waves along x and z, n polynomials along y, which points upwards; slopes are products with
matrices. The stress is that of the 2D gas, eta (grad v + grad v^T - 1 div v), whose divergence is eta lap v:
a flow uniform along z moves as in 2D. In 3D this stress has a bulk viscosity of -eta/3.
"""
from typing import Any

import numpy as np
from numpy.polynomial import chebyshev

from continuum.fluid import ConstEta, Fields, IdealGas
from continuum.sides import Periodic


class GasInSpace:
    """Rates of states (5, n^3), density, v_x, v_z, v_y, temperature at (x, z, y), of a `RayleighBenard`."""
    names = ("rho", "vx", "vz", "vy", "T")

    def __init__(self, scene: Any, n: int):
        if not (isinstance(scene.eos, IdealGas) and isinstance(scene.law, ConstEta)
                and isinstance(scene.sides, Periodic) and n > 4 and n % 2):
            raise ValueError("a gas in space is IdealGas with ConstEta and Periodic() sides, on an odd "
                             f"number n > 4 of functions, got {scene.eos}, {scene.law}, {scene.sides}, {n}")
        self.scene, self.eos, self.n = scene, scene.eos, n
        (x, dx, along), (y, dy, up) = waves(n, scene.width), polynomials(n, scene.L)
        self.D, self.D2 = (dx, dx, dy), (dx@dx, dx@dx, dy@dy)
        self.x = np.stack([q.ravel() for q in np.meshgrid(x, x, y, indexing="ij")], axis=1)
        self.V = (along[:, None, None]*along[:, None]*up).ravel()

    def state(self, rho: np.ndarray, v: np.ndarray, T: np.ndarray) -> np.ndarray:
        """State of density (n^3,), velocity (n^3, 3) and temperature (n^3,)."""
        return np.stack([rho, *v.T, T])

    def fields(self, state: np.ndarray) -> Fields:
        return Fields(self.x, state[1:4].T, state[0], state[4], self.V)

    def slopes(self, f: np.ndarray, D: Any) -> np.ndarray:
        """Apply the matrices D along the axes of fields (m, n, n, n): (3, m, n, n, n)."""
        n = self.n
        return np.stack([(D[0]@f.reshape(-1, n, n*n)).reshape(f.shape), D[1]@f, f@D[2].T])

    def rates(self, state: np.ndarray, out: np.ndarray) -> None:
        """Write d(state)/dt to `out`; on plates v and temperature do not change."""
        cube, (eta, k), cv = state.reshape(5, *[self.n]*3), self.scene.law, self.eos.cv
        rho, v, T, slope = cube[0], cube[1:4], cube[4], self.slopes(cube, self.D)
        grad, lap = slope[:, 1:4], self.slopes(cube[1:], self.D2).sum(axis=0)      # grad[a, b] = d_a v_b
        div, carried = np.einsum("aa...", grad), np.einsum("a...,ab...->b...", v, slope)
        work = eta*((grad**2).sum(axis=(0, 1)) + np.einsum("ab...,ba...", grad, grad) - div**2)
        rate = out.reshape(cube.shape)
        rate[0] = -np.einsum("aa...", self.slopes(rho*v, self.D))
        rate[1:4] = (eta*lap[:3] - rho*slope[:, 4] - T*slope[:, 0])/rho - carried[1:4]
        rate[3] -= self.scene.g
        rate[4] = ((work + k*lap[3])/rho - T*div)/cv - carried[4]
        rate[1:, ..., [0, -1]] = 0.0

    def heat_through(self, state: np.ndarray, plate: int) -> float:
        """Heat per time that enters through plate 0 (lower) or 1 (upper)."""
        slope = state[4].reshape([self.n]*3).mean(axis=(0, 1))@self.D[2].T
        return float(-self.scene.law.k*slope[-plate]*(1 - 2*plate))*self.scene.width**2


def waves(n: int, width: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Positions, derivative matrix (n, n) and weights for periodic functions."""
    x, k = (np.arange(n) + 0.5)/n*width - width/2, 2j*np.pi*np.fft.fftfreq(n, width/n)
    slopes = np.fft.ifft(k[:, None]*np.fft.fft(np.eye(n), axis=0), axis=0).real
    return x, slopes, np.full(n, width/n)


def polynomials(n: int, height: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """The same for polynomials between plates, on Chebyshev's points with both ends."""
    y = -np.cos(np.pi*np.arange(n)/(n - 1))
    inverse = np.linalg.inv(chebyshev.chebvander(y, n - 1))
    slopes = chebyshev.chebval(y, chebyshev.chebder(np.eye(n))).T@inverse
    integrals = np.array([0 if m % 2 else 2/(1 - m*m) for m in range(n)])
    return y*height/2, slopes*2/height, integrals@inverse*height/2
