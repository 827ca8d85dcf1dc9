"""The sums of KHP95, Sec. II, by plain numpy for a few particles in a periodic square, Lucy's weight, m = 1.

State (5, n) = x, y, vx, vy, e. Small enough for a verdict in a fraction of a second; not the code that runs studies.
"""
from collections.abc import Callable

import numpy as np

from continuum.fluid import stress_tensor

RANGE = 3.0
SIDE = 6.5  # more than twice the range: no pair is counted twice
Pressure = Callable[[np.ndarray, np.ndarray], np.ndarray]


def lucy(r: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """w(r) and w'(r)/r."""
    s = np.minimum(r/RANGE, 1.0)
    scale = 5/(np.pi*RANGE**2)
    return scale*(1 + 3*s)*(1 - s)**3, -12*scale/RANGE**2*(1 - s)**2


def start(seed: int = 1, columns: int = 6) -> np.ndarray:
    """A jittered lattice with random velocities, e about 1."""
    rng, n = np.random.default_rng(seed), columns**2
    at = (np.indices((columns, columns)).reshape(2, n) + 0.5)*SIDE/columns - SIDE/2
    return np.concatenate([at + rng.uniform(-0.2, 0.2, (2, n)), 0.3*rng.standard_normal((2, n)),
                           1 + 0.1*rng.standard_normal((1, n))])


def apart(state: np.ndarray) -> np.ndarray:
    """(n, n, 2): r_i - r_j to the nearest image."""
    d = state[:2].T[:, None] - state[:2].T[None]
    return d - SIDE*np.round(d/SIDE)


def densities(state: np.ndarray) -> np.ndarray:
    """rho_i = sum_j m w_ij"""
    return lucy(np.linalg.norm(apart(state), axis=2))[0].sum(axis=1)


def ideal(rho: np.ndarray, e: np.ndarray) -> np.ndarray:
    """P = rho e    [Eq. 1]"""
    return rho*e


def quadratic(rho: np.ndarray, e: np.ndarray) -> np.ndarray:
    """P = rho^2    [Sec. III]"""
    return rho**2


def rates(state: np.ndarray, pressure: Pressure = ideal, eta: float = 0.0) -> np.ndarray:
    """d/dt of the state: density; gradients of v and T; divergences of P and Q, eta = k, T = e."""
    d, v, e = apart(state), state[2:4].T, state[4]
    w, slope = lucy(np.linalg.norm(d, axis=2))
    grad, rho = slope[:, :, None]*d, w.sum(axis=1)
    dv, dT, mean = v[None] - v[:, None], e[None] - e[:, None], np.sqrt(rho[:, None]*rho)
    stress = stress_tensor(eta, 0.0, np.einsum("ija,ijb->iab", grad, dv/mean[:, :, None]))
    P = (pressure(rho, e)[:, None, None]*np.eye(2) - stress)/rho[:, None, None]**2
    Q = -eta*np.einsum("ija,ij->ia", grad, dT/mean)/rho[:, None]**2
    force = np.einsum("ijab,ijb->ija", P[:, None] + P[None], grad)
    heat = np.einsum("ija,ija->i", Q[:, None] + Q[None], grad)
    return np.array([*v.T, *-force.sum(axis=1).T, -0.5*np.einsum("ija,ija->i", force, dv) - heat])


def march_midpoint(state: np.ndarray, dt: float, steps: int, **law) -> np.ndarray:
    """Midpoint steps, Runge-Kutta of second order: two evaluations each."""
    for _ in range(steps):
        state = state + dt*rates(state + dt/2*rates(state, **law), **law)
    return state


def march(state: np.ndarray, dt: float, steps: int, **law) -> np.ndarray:
    """Classical fourth-order Runge-Kutta steps."""
    for _ in range(steps):
        a = rates(state, **law)
        b = rates(state + dt/2*a, **law)
        c = rates(state + dt/2*b, **law)
        state = state + dt/6*(a + 2*b + 2*c + rates(state + dt*c, **law))
    return state
