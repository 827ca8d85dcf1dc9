"""Time integrators of particles with friction and noise; a state is x, v and the last force.

sums.places : d. sums.forces(x, v, out) writes the forces at x, v with the noise of this step;
sums.soft(x, out) writes those that depend neither on velocities nor on noise; sums.rub(x, v, dt) applies
friction and noise to v, pair by pair.
"""
from typing import Any

import numpy as np

from continuum.jit import jit
from particles.threads import Threads


@jit
def _drift(first, last, x, v, f, dt, lam, guess):
    """x += dt v + dt^2/2 f, guess = v + lam dt f"""
    for i in range(first, last):
        x[i] += dt*(v[i] + dt/2*f[i])
        guess[i] = v[i] + lam*dt*f[i]


@jit
def _kick(first, last, v, f, new, dt):
    """v += dt/2 (f + new), f = new"""
    for i in range(first, last):
        v[i] += dt/2*(f[i] + new[i])
        f[i] = new[i]


class GrootWarren:
    """Velocity-Verlet with friction at v + lam dt f    [Groot & Warren 1997, lam = 1/2]"""
    lam = 0.5

    def __init__(self, shape: tuple[int, ...], threads: Threads):
        self._guess, self._new = np.empty((2, shape[0]//3, shape[1]))
        self._threads = threads

    def step(self, sums: Any, y: np.ndarray, dt: float) -> None:
        """Advance y in place by dt."""
        d, guess, new = sums.places, self._guess, self._new
        x, v, f = y[:d], y[d:2*d], y[2*d:]
        self._threads(_drift, x.size, x.ravel(), v.ravel(), f.ravel(), dt, self.lam, guess.ravel())
        self.forces(sums, x, guess, new)
        self._threads(_kick, x.size, v.ravel(), f.ravel(), new.ravel(), dt)

    def forces(self, sums: Any, x: np.ndarray, v: np.ndarray, out: np.ndarray) -> None:
        """Write the forces at the end of the step."""
        sums.forces(x, v, out)


class GrootWarren65(GrootWarren):
    """As `GrootWarren` with lam = 0.65, which they find best for the temperature at rho = 3."""
    lam = 0.65


class VelocityVerlet(GrootWarren):
    """Velocity-Verlet, with forces once more at the final velocities    [Besold et al. 2000, DPD-VV]"""

    def step(self, sums: Any, y: np.ndarray, dt: float) -> None:
        super().step(sums, y, dt)
        d = sums.places
        sums.forces(y[:d], y[d:2*d], y[2*d:])


class Shardlow(GrootWarren):
    """Friction and noise pair by pair, implicitly, then velocity-Verlet without them [Shardlow 2003, S1].
    Pairs are taken in the order of the lists, the same for any number of threads and after a restart."""
    lam = 0.0

    def step(self, sums: Any, y: np.ndarray, dt: float) -> None:
        d = sums.places
        sums.rub(y[:d], y[d:2*d], dt)
        super().step(sums, y, dt)

    def forces(self, sums: Any, x: np.ndarray, v: np.ndarray, out: np.ndarray) -> None:
        sums.soft(x, out)


class KickDriftFrictionDriftKick(GrootWarren):
    """Half a kick, half a drift, friction and noise for a whole step, half a drift, half a kick.

    Momentum is conserved; the error of kT is of second order    [Leimkuhler & Matthews 2013, BAOAB]
    """

    def step(self, sums: Any, y: np.ndarray, dt: float) -> None:
        d, new = sums.places, self._new
        x, v, f = y[:d], y[d:2*d], y[2*d:]
        v += dt/2*f
        x += dt/2*v
        sums.rub(x, v, dt)
        x += dt/2*v
        sums.soft(x, new)
        v += dt/2*new
        f[:] = new
