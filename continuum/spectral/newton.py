"""Steady states of `laws` by Galerkin's method and Newton's method with an exact Jacobian.

Each law is multiplied by the functions of its own field and integrated. By integration in parts its fluxes
multiply slopes of the functions: no second derivatives are needed. Any state obeys the law of total mass; it
is replaced by a fixed mean of density or pressure, whose function is left out.
"""
from collections.abc import Callable
from functools import partial
from typing import Any, NamedTuple

import numpy as np
from scipy.linalg import solve
from scipy.optimize import brentq

from continuum.spectral.modes import RHO, VX, VY, T, along_x, along_y, polynomials_at, waves_at
from continuum.steady import largest, newton

TINY = 1e-30        # complex step: no difference is taken, so that it has no round-off
RISING = 0.2        # velocity and temperature of initial streams, in units of the laws
RELAX = 0.1         # implicit steps are RELAX/(largest rate) long: a factor of 3 either way works, too
MOST = 48           # functions along an axis: the Jacobian is then 0.7 GB; 28 give eight digits at Ra 20 000


class Galerkin:
    """Rates as a function of q: amplitudes (4 fields, n waves, n polynomials) without those fixed at zero."""

    def __init__(self, laws: Any, n: int):
        if not 4 <= n <= MOST:
            raise ValueError(f"a spectral state takes 4 to {MOST} functions along an axis, got {n}: 24 do "
                             "for eight digits up to Ra 10 000")
        self.laws, self.n = laws, n
        self.x, self.y = along_x(n, laws.width), along_y(n)
        self.weights = np.outer(self.x.weights, self.y.weights)
        self.kept = np.ones((4, n, n), bool)
        self.kept[VX, 0] = False            # sin(0)
        self.kept[RHO, 0, 0] = False        # the mean is fixed

    def amplitudes(self, q: np.ndarray) -> np.ndarray:
        """All amplitudes (4, n, n) of q."""
        every = np.zeros(self.kept.shape)
        every[self.kept] = q
        return every

    def kinds(self, f: int) -> list[tuple[np.ndarray, np.ndarray]]:
        """Functions of x and of y whose products give field f, its slope along x, its slope along y."""
        (X, X1), (Y, Y1) = self.x.functions[:, f], self.y.functions[:, f]
        return [(X, Y), (X1, Y), (X, Y1)]

    def anywhere(self, x: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Values at places (points, 2) of the functions along either axis, (4, points, n) each."""
        return waves_at(x[:, 0], self.n, self.laws.width)[0], polynomials_at(x[:, 1], self.n)[0]

    def at(self, q: np.ndarray) -> np.ndarray:
        """Fields and their slopes at the points, (4, 3, points in x, in y)."""
        return np.array([[X@a@Y.T for X, Y in self.kinds(f)] for f, a in enumerate(self.amplitudes(q))])

    def terms(self, at: np.ndarray) -> np.ndarray:
        """Terms of the laws at the points, (law, term, points in x, in y)."""
        return self.laws.terms(at, self.y.points)

    def rates(self, q: np.ndarray) -> np.ndarray:
        """Integrals of each function times the rate of change of the stored quantity of its law."""
        every = [sum(X.T@(self.weights*term)@Y for (X, Y), term in zip(self.kinds(f), law))
                 for f, law in enumerate(self.terms(self.at(q)))]
        return np.array(every)[self.kept]

    def slopes(self, q: np.ndarray, per_dt: float = 0.0) -> np.ndarray:
        """Jacobian of stored*per_dt - rates, (unknowns, unknowns)."""
        at, n, kept = self.at(q), self.n, self.kept.ravel()
        every = np.zeros((4, n*n, 4, n*n))
        for b, t in np.ndindex(4, 3):
            moved = at.astype(complex)
            moved[b, t] += 1j*TINY
            terms = self.terms(moved).imag/TINY
            laws = -terms[:, :3]
            laws[:, 0] += per_dt*terms[:, 3]
            for a, s in np.argwhere(laws.any(axis=(2, 3))):
                every[a, :, b] += products(self.kinds(a)[s], self.weights*laws[a, s], self.kinds(b)[t])
        return every.reshape(kept.size, kept.size)[np.ix_(kept, kept)]


def products(test: tuple, c: np.ndarray, trial: tuple) -> np.ndarray:
    """Sums over all points of U_k W_m c X_l Y_n, as a matrix (k m, l n): first over y, then over x."""
    (U, W), (X, Y), n = test, trial, test[0].shape[1]
    over_y = c@(W[:, :, None]*Y[:, None, :]).reshape(len(W), n*n)
    over_x = (U[:, :, None]*X[:, None, :]).reshape(len(U), n*n).T@over_y
    return over_x.reshape(n, n, n, n).swapaxes(1, 2).reshape(n*n, n*n)


class SpectralState(NamedTuple):
    """A steady state: its equations, amplitudes, largest change in each of Newton's steps."""
    equations: Galerkin
    q: np.ndarray
    changes: tuple[float, ...]

    @property
    def at(self) -> np.ndarray:
        """Fields and their slopes at the points, (4, 3, points in x, in y)."""
        return self.equations.at(self.q)

    def fields(self, x: np.ndarray) -> np.ndarray:
        """Fields of `laws` (4, points) at places (points, 2) in heights, from the middle; in a layer fluid
        rises at x = 0."""
        X, Y = self.equations.anywhere(x)
        values: np.ndarray = ((X@self.equations.amplitudes(self.q))*Y).sum(axis=2)
        return values

    def on(self, n: int) -> np.ndarray:
        """Amplitudes (4, n, n) for more functions or fewer."""
        every, both = np.zeros((4, n, n)), min(n, self.equations.n)
        every[:, :both, :both] = self.equations.amplitudes(self.q)[:, :both, :both]
        return every

    @property
    def K(self) -> float:
        """Kinetic energy per mass; the mean density is 1."""
        (u, v, *_), (momentum_x, momentum_y, *_) = self.at[:, 0], self.equations.terms(self.at)[:, 3]
        return float(np.average(momentum_x*u + momentum_y*v, weights=self.equations.weights)/2)

    @property
    def Nu(self) -> float:
        """Nusselt number of a layer: upward heat flux, averaged over the volume, over that by conduction."""
        up = self.equations.terms(self.at)[T, 2]
        return float(np.average(up, weights=self.equations.weights)/self.equations.laws.units[2])


def steady(laws: Any, n: int, start: SpectralState | None = None) -> SpectralState:
    """Steady state with n waves and n polynomials, reached from `start`, of any n and any parameters; by
    default from warm streams that rise at x = 0 and once per pair of rolls about as wide as high.

    Implicit steps lengthen as rates fall and become Newton's: the state need not be stable. Below onset it is
    at rest. Raises ValueError: n is out of range. NewtonFailed: no convergence.
    """
    every = start.on(n) if start else np.zeros((4, n, n))
    if not start:
        pairs = max(1, round(laws.width/2))
        every[[VY, T], pairs, 0] = RISING*np.array(laws.units[:2])
    return relaxed(Galerkin(laws, n), every)


def relaxed(equations: Galerkin, every: np.ndarray) -> SpectralState:
    """Steady state reached from amplitudes (4, n, n)."""
    return SpectralState(equations, *newton(every[equations.kept], partial(step, equations),
                                            f"{equations.laws}, {equations.n} functions"))


def step(equations: Galerkin, q: np.ndarray) -> np.ndarray:
    """Change of q in an implicit step."""
    rates = equations.rates(q)
    return solve(equations.slopes(q, largest(rates)/RELAX), rates, overwrite_a=True)


def onset(laws_at: Callable[[float], Any], n: int, low: float, high: float) -> float:
    """Ra between low and high at which a pair of rolls neither grows nor decays: there the Jacobian of the
    state at rest is singular, and the response of the first rising stream to a force changes sign."""
    def stiffness(ra: float) -> float:
        slopes = Galerkin(laws_at(ra), n).slopes(np.zeros(4*n*n - n - 1))
        stream = n*n        # index of the first rising stream: after n (n - 1) of v_x and n of v_y
        return float(1/np.linalg.inv(slopes)[stream, stream])
    return float(brentq(stiffness, low, high, xtol=1e-9))
