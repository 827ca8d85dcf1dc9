"""Decaying Taylor-Green vortex of a gas, by Fourier sums.

    rho' = -div(rho v)        p' = -div(v p) - grad P + eta lap v
    e' = -div((e + P) v) + eta [lap |v|^2/2 + div((v.grad) v - v div v)] + k lap T

with P = rho T, C_V = 1, k = eta, in 2D without bulk viscosity. The periodic box is one wavelength wide;
lengths are in spacings of the points that sample the vortex. Products of two fields are differentiated as
a grad b + b grad a, which conserves sums.
"""
from collections.abc import Callable
from functools import cache, partial
from math import ceil
from typing import NamedTuple

import numpy as np

RE = 100.0          # the vortex turns several times as it decays: pressure and convection matter
SOUND = np.sqrt(2)  # speed of sound of the gas at T = 1 in 2D
DECAYS = 1.0        # 2 nu k^2 t at the end, where velocities are a factor e smaller
ODD = 33            # grid points along each axis, odd: the shortest wave has a derivative; 25 are too few
OF_LIMIT = 0.5      # of the longest stable step


class Vortex(NamedTuple):
    """Vortex of a Mach number in a box of `wavelength` spacings; RE = speed wavelength/nu."""
    mach: float
    wavelength: int

    @property
    def speed(self) -> float:
        return self.mach*SOUND

    @property
    def k(self) -> float:
        return 2*np.pi/self.wavelength

    @property
    def eta(self) -> float:
        return self.speed*self.wavelength/RE

    @property
    def time(self) -> float:
        return DECAYS/(2*self.eta*self.k**2)

    def velocity(self, x: np.ndarray) -> np.ndarray:
        """Velocities (n, 2) at places (n, 2) at the start."""
        a, b = self.k*x.T
        return self.speed*np.stack([np.sin(a)*np.cos(b), -np.cos(a)*np.sin(b)], axis=1)

    def density(self, x: np.ndarray) -> np.ndarray:
        """Densities (n,) at the start, with the incompressible pressure at constant entropy, P = rho^2."""
        return np.sqrt(1 + self.speed**2/4*np.cos(2*self.k*x).sum(axis=1))


class Solved(NamedTuple):
    """Fourier amplitudes (n, n, 2) of the velocity at the end over the initial speed.

    decay : ln(K at the start/K at the end) over its value in incompressible flow.
    """
    amplitudes: np.ndarray
    decay: float


@cache
def solved(mach: float, n: int = ODD) -> Solved:
    """Solution for a gas of a Mach number on n x n points, n odd, by RK4."""
    vortex = Vortex(mach, n)
    axis = np.arange(n) - (n - 1)/2
    x = np.stack(np.meshgrid(axis, axis, indexing="ij"), axis=-1).reshape(-1, 2)
    rho = vortex.density(x)
    v = vortex.velocity(x).T
    energy = rho*(rho + (v**2).sum(axis=0)/2)
    first = np.array([rho, *(rho*v), energy]).reshape(4, n, n)
    last = advanced(first, partial(rates, eta=vortex.eta, D=derivative(n)), vortex.time,
                    OF_LIMIT*longest_step(first, vortex.eta))
    into_waves = waves(axis/n, n).conj()/n
    amplitudes = np.einsum("xk,yl,axy->kla", into_waves, into_waves, last[1:3]/last[0]/vortex.speed)
    before, after = (((q[1]**2 + q[2]**2)/q[0]).sum() for q in (first, last))       # kinetic energies
    return Solved(amplitudes, float(np.log(before/after)/(2*DECAYS)))


def derivative(n: int) -> np.ndarray:
    """Matrix (n, n) of the derivative of a Fourier series on n points of unit spacing, n odd."""
    far = np.subtract.outer(np.arange(n), np.arange(n))
    away = np.where(far == 0, 1, far)
    return np.where(far == 0, 0.0, np.pi/n*(-1.0)**far/np.sin(np.pi*away/n))


def advanced(state: np.ndarray, slopes: Callable, time: float, longest: float,
             smooth: np.ndarray | None = None) -> np.ndarray:
    """State (4, n, n) after a time, by RK4; each step ends with `smooth` along both axes."""
    steps = ceil(time/longest)
    dt = time/steps
    for _ in range(steps):
        a = slopes(state)
        b = slopes(state + dt/2*a)
        c = slopes(state + dt/2*b)
        state = state + dt/6*(a + 2*b + 2*c + slopes(state + dt*c))
        state = state if smooth is None else smooth@state@smooth.T
    return state


def longest_step(state: np.ndarray, eta: float) -> float:
    """Longest stable step of RK4, from the fastest sound and diffusion of the shortest wave."""
    rho, v = state[0], state[1:3]/state[0]
    speed = np.sqrt((v**2).sum(axis=0))
    T = state[3]/rho - speed**2/2
    shortest = np.pi*(1 - 1/len(rho))       # its wave number along an axis
    sound = np.sqrt(2)*shortest*np.max(np.sqrt(2*T) + speed)
    spread = 2*shortest**2*np.max(eta/rho)
    return float(1/(sound/2.82 + spread/2.78))


def rates(state: np.ndarray, eta: float, D: np.ndarray) -> np.ndarray:
    """d(state)/dt, (4, n, n), of the equations above."""
    rho, p, v = state[0], state[1:3], state[1:3]/state[0]
    T = state[3]/rho - (v**2).sum(axis=0)/2

    def grad(f: np.ndarray) -> np.ndarray:
        return np.array([D@f, f@D.T])

    def div(f: np.ndarray) -> np.ndarray:
        return D@f[0] + f[1]@D.T

    def lap(f: np.ndarray) -> np.ndarray:
        return div(grad(f))

    def carried(f: np.ndarray, flux: np.ndarray) -> np.ndarray:
        return f*div(flux) + (flux*grad(f)).sum(axis=0)

    slope = np.array([grad(v[0]), grad(v[1])])      # [a, b] = d_b v_a
    F = np.einsum("abxy,bxy->axy", slope, v) - v*div(v)
    force = eta*np.array([lap(v[0]), lap(v[1])]) - rho*grad(T) - T*grad(rho)
    heating = eta*(lap((v**2).sum(axis=0))/2 + div(F) + lap(T)) - carried(T, p)
    convected = np.array([carried(f, v) for f in state])
    return np.array([0*rho, *force, heating]) - convected


def waves(place: np.ndarray, n: int) -> np.ndarray:
    """exp(2 pi i m x) at places (p,) in wavelengths, (p, n)."""
    return np.exp(2j*np.pi*np.outer(place, np.arange(n) - n//2))


def velocities(gas: Solved, place: np.ndarray) -> np.ndarray:
    """Velocities (p, 2) at the end over the initial speed, at places (p, 2) in wavelengths."""
    return at(gas.amplitudes, place).T


def at(amplitudes: np.ndarray, place: np.ndarray) -> np.ndarray:
    """Fields (f, p) of Fourier amplitudes (n, n, f) at places (p, 2) in wavelengths."""
    x, y = (waves(axis, len(amplitudes)) for axis in place.T)
    return np.einsum("pk,pl,kla->ap", x, y, amplitudes, optimize=True).real
