"""Boussinesq convection as an equation of py-pde: vorticity omega, streamfunction psi, temperature T.

    domega/dt + u.grad omega = nu Lap omega + dT/dx,    dT/dt + u.grad T = kappa Lap T,    Lap psi = -omega

with u = (dpsi/dy, -dpsi/dx), in free-fall units: nu = sqrt(Pr/Ra), kappa = 1/sqrt(Pr Ra), height 1, T = 1/2
on the lower and -1/2 on the upper plate, psi = 0 on both. The rows of py-pde's grid lie at y = h, 2 h, ..., 1
- h, so that its ghosts lie on the plates. There no slip gives Thom's vorticity -2 psi(h)/h^2.
"""
from typing import NamedTuple

import numpy as np
from pde import CartesianGrid

from continuum.jit import jit
from continuum.pypde.solve import Equation, rates
from continuum.scene import ROLL_ENERGY, columns_of, positive
from continuum.steady import RK4_DECAY, RK4_SOUND

FREE_FALL = 1.0                     # largest |u| + |v|


class LayerLoop(NamedTuple):
    """What `solve.rates` takes; X, Y, inverse of `Boussinesq.streamfunction`."""
    nu: float
    kappa: float
    h: float
    X: np.ndarray
    Y: np.ndarray
    inverse: np.ndarray


class Boussinesq(Equation):
    """The layer between rigid plates on `rows` rows of square cells, periodic in x with period `aspect`."""

    names = ("omega", "T")

    def __init__(self, *, ra: float, pr: float, rows: int, aspect: float = 2.0):
        super().__init__()
        positive(ra=ra, pr=pr)
        self.rows, self.h = rows, 1/rows
        self.nu, self.kappa = float(np.sqrt(pr/ra)), float(1/np.sqrt(pr*ra))
        self.grid = CartesianGrid([(0, aspect), (self.h/2, 1 - self.h/2)],
                                  (columns_of(aspect, rows), rows - 1), periodic=(True, False))
        self.basis = self._poisson_basis()
        self.loop = LayerLoop(self.nu, self.kappa, self.h, *self.basis)

    @property
    def viscous_time(self) -> float:
        return 1/self.nu

    @property
    def grid_box(self) -> tuple[float, float]:
        return float(self.grid.axes_bounds[0][1]), 1.0

    def step_limit(self) -> float:
        """Largest stable step of RK4, for the largest decay rate and the fastest advection together."""
        decay, wave = 8*max(self.nu, self.kappa)/self.h**2, FREE_FALL/self.h
        return 1/(decay/RK4_DECAY + wave/RK4_SOUND)

    def _poisson_basis(self) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Eigenvectors of the second differences in x and y, and the inverse of -Lap_h in them."""
        columns, inner = self.grid.shape
        x = np.eye(columns, k=1) + np.eye(columns, k=1 - columns)
        y = np.eye(inner, k=1)
        (kx, X), (ky, Y) = (np.linalg.eigh((2*np.eye(len(a)) - a - a.T)/self.h**2) for a in (x, y))
        return np.ascontiguousarray(X), np.ascontiguousarray(Y), 1/(kx[:, None] + ky)

    def streamfunction(self, omega: np.ndarray) -> np.ndarray:
        """psi of Lap_h psi = -omega, zero on the plates; fast diagonalisation, exact to round-off."""
        X, Y, inverse = self.basis
        return X@(inverse*(X.T@omega@Y))@Y.T

    def points(self, field: int) -> tuple[np.ndarray, np.ndarray]:
        columns, inner = self.grid.shape
        return self.h*(np.arange(columns + 2) - 0.5), self.h*np.arange(inner + 2)

    def rolls(self, ke: float = ROLL_ENERGY) -> np.ndarray:
        """Rolls psi ~ sin(kx) sin^2(pi y) of kinetic energy `ke`, linear temperature."""
        width = self.grid_box[0]
        number = 2*max(1, round(width/2))
        if not ke >= 0:
            raise ValueError(f"the kinetic energy of the initial rolls cannot be negative, got {ke}")
        x, y = np.meshgrid(*(p[1:-1] for p in self.points(0)), indexing="ij")
        X, Y, inverse = self.basis
        psi = np.sin(np.pi*number*x/width)*np.sin(np.pi*y)**2
        data = np.array([X@((X.T@psi@Y)/inverse)@Y.T, 0.5 - y])
        data[0] *= np.sqrt(ke/self.kinetic_energy(data))
        return data

    def padded(self, data: np.ndarray) -> np.ndarray:
        """(omega, T, psi) with their ghosts, each (columns+2, rows+1)."""
        full = np.empty((3, *(n + 2 for n in self.grid.shape)))
        pad(self.h, data, self.streamfunction(data[0]), full)
        return full

    def trouble(self, data: np.ndarray) -> str:
        names = [name for name, f in zip(self.names, data) if not np.isfinite(f).all()]
        return f"{' and '.join(names)} not finite" if names else ""

    def kinetic_energy(self, data: np.ndarray) -> float:
        """K = <psi omega>/2, the sum of (grad_h psi)^2/2 over all links."""
        return float(0.5*np.sum(self.streamfunction(data[0])*data[0])*self.h**2/self.grid_box[0])

    def measure(self, data: np.ndarray) -> tuple[float, float, float]:
        return self.kinetic_energy(data), self.nusselt(data)[0], 1.0

    def rising(self, data: np.ndarray) -> np.ndarray:
        psi = self.streamfunction(data[0])[:, self.rows//2 - 1]
        return (np.roll(psi, 1) - np.roll(psi, -1))/(2*self.h)

    def nusselt(self, data: np.ndarray) -> tuple[float, float]:
        """Of the lower and the upper plate. The difference of the first two rows is the flux that the scheme
        itself sends through a plate; it is of second order because T'' is zero there, where nothing moves."""
        T = self.padded(data)[1]
        bottom, top = (float(np.mean((f[:, 0] - f[:, 1])[1:-1]))/self.h for f in (T, -T[:, ::-1]))
        return bottom, top


@jit
def pad(h, data, psi, S):
    """(omega, T, psi) between ghosts."""
    nx, ny = psi.shape
    for i in range(nx):
        for j in range(ny):
            S[0, i + 1, j + 1], S[1, i + 1, j + 1] = data[0, i, j], data[1, i, j]
            S[2, i + 1, j + 1] = psi[i, j]
        S[0, i + 1, 0], S[0, i + 1, ny + 1] = -2*psi[i, 0]/h**2, -2*psi[i, ny - 1]/h**2
        S[1, i + 1, 0], S[1, i + 1, ny + 1] = 0.5, -0.5
        S[2, i + 1, 0], S[2, i + 1, ny + 1] = 0.0, 0.0
    for f in range(3):
        for j in range(ny + 2):
            S[f, 0, j], S[f, nx + 1, j] = S[f, nx, j], S[f, 1, j]


@jit
def spread_and_carry(diffusivity, h, u, v, f, i, j):
    """diffusivity Lap f - u.grad f at one point."""
    lap = ((f[i + 1, j] + f[i - 1, j]) + (f[i, j + 1] + f[i, j - 1]) - 4*f[i, j])/h**2
    return diffusivity*lap - (u*(f[i + 1, j] - f[i - 1, j]) + v*(f[i, j + 1] - f[i, j - 1]))/(2*h)


@rates.of(LayerLoop)
def _(loop, data, out):
    nu, kappa, h, X, Y, inverse = loop
    nx, ny = data.shape[1:]
    S = np.empty((3, nx + 2, ny + 2))
    hat = inverse*np.dot(np.dot(X.T, data[0]), Y)
    pad(h, data, np.dot(np.dot(X, hat), Y.T), S)
    omega, T, psi = S[0], S[1], S[2]
    for i in range(1, nx + 1):
        for j in range(1, ny + 1):
            u, v = (psi[i, j + 1] - psi[i, j - 1])/(2*h), (psi[i - 1, j] - psi[i + 1, j])/(2*h)
            lift = (T[i + 1, j] - T[i - 1, j])/(2*h)
            out[0, i - 1, j - 1] = spread_and_carry(nu, h, u, v, omega, i, j) + lift
            out[1, i - 1, j - 1] = spread_and_carry(kappa, h, u, v, T, i, j)
