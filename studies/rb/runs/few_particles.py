"""The sums of KHP95, Sec. II, by plain numpy for 36 particles in a periodic square, Lucy's weight, m = 1.

State (5, n) = x, y, vx, vy, e. Readable and slow; not the code that runs flows.
"""
from collections.abc import Callable, Sequence
from functools import cache
from itertools import pairwise

import numpy as np

from continuum.fluid import stress_tensor
from studies.kit import stats
from studies.kit.stats import Measured

RANGE = 3.0
SIDE = 6.5                      # more than twice the range: no pair is counted twice
TIME = 4.8
STEPS = (8, 16, 32, 64)         # of that time: dt from 0.6, the largest stable one, down
SMALL = (64, 128, 256, 512)     # dt from 0.075 down
AS_RUN = 12                     # dt = 0.4, as in the runs of the study
SEEDS = (1, 2, 3, 4, 5, 6)
Pressure = Callable[[np.ndarray, np.ndarray], np.ndarray]
Errors = Callable[[np.ndarray, Sequence[np.ndarray]], list[float]]


def lucy(r: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """w(r) and w'(r)/r."""
    s = np.minimum(r/RANGE, 1.0)
    scale = 5/(np.pi*RANGE**2)
    return scale*(1 + 3*s)*(1 - s)**3, -12*scale/RANGE**2*(1 - s)**2


def start(seed: int = 1, columns: int = 6) -> np.ndarray:
    """A jittered lattice with random velocities, e about 1."""
    rng = np.random.default_rng(seed)
    n = columns**2
    sites = np.indices((columns, columns)).reshape(2, n)
    at = (sites + 0.5)*SIDE/columns - SIDE/2
    x = at + rng.uniform(-0.2, 0.2, (2, n))
    v = 0.3*rng.standard_normal((2, n))
    e = 1 + 0.1*rng.standard_normal((1, n))
    return np.concatenate([x, v, e])


def separations(state: np.ndarray) -> np.ndarray:
    """(n, n, 2): r_i - r_j to the nearest image."""
    x = state[:2].T
    d = x[:, None] - x[None]
    return d - SIDE*np.round(d/SIDE)


def densities(state: np.ndarray) -> np.ndarray:
    """rho_i = sum_j m w_ij"""
    r = np.linalg.norm(separations(state), axis=2)
    return lucy(r)[0].sum(axis=1)


def ideal(rho: np.ndarray, e: np.ndarray) -> np.ndarray:
    """P = rho e    [Eq. 1]"""
    return rho*e


def quadratic(rho: np.ndarray, e: np.ndarray) -> np.ndarray:
    """P = rho^2    [Sec. III]"""
    return rho**2


def rates(state: np.ndarray, pressure: Pressure = ideal, eta: float = 0.0) -> np.ndarray:
    """d/dt of the state: density; gradients of v and T; divergences of P and Q, eta = k, T = e."""
    d = separations(state)
    v, e = state[2:4].T, state[4]
    w, slope = lucy(np.linalg.norm(d, axis=2))
    rho = w.sum(axis=1)
    grad = slope[:, :, None]*d
    dv = v[None] - v[:, None]
    dT = e[None] - e[:, None]
    mean = np.sqrt(rho[:, None]*rho)
    square = rho[:, None, None]**2
    grad_v = np.einsum("ija,ijb->iab", grad, dv/mean[:, :, None])
    stress = stress_tensor(eta, 0.0, grad_v)
    P = (pressure(rho, e)[:, None, None]*np.eye(2) - stress)/square
    Q = -eta*np.einsum("ija,ij->ia", grad, dT/mean)/square[:, 0]
    force = np.einsum("ijab,ijb->ija", P[:, None] + P[None], grad)
    heat = np.einsum("ija,ija->i", Q[:, None] + Q[None], grad)
    work = np.einsum("ija,ija->i", force, dv)
    return np.array([*v.T, *-force.sum(axis=1).T, -0.5*work - heat])


def march(state: np.ndarray, dt: float, steps: int, **law) -> np.ndarray:
    """Classical fourth-order Runge-Kutta steps."""
    for _ in range(steps):
        a = rates(state, **law)
        b = rates(state + dt/2*a, **law)
        c = rates(state + dt/2*b, **law)
        d = rates(state + dt*c, **law)
        state = state + dt/6*(a + 2*b + 2*c + d)
    return state


def march_midpoint(state: np.ndarray, dt: float, steps: int, **law) -> np.ndarray:
    """Midpoint steps, Runge-Kutta of second order: two evaluations each."""
    for _ in range(steps):
        middle = state + dt/2*rates(state, **law)
        state = state + dt*rates(middle, **law)
    return state


def not_molecular(step: float = 1e-5) -> float:
    """Largest difference of SPAM accelerations, P = rho^2, from -grad of sum 2 w(r), relative."""
    state = start()
    force = rates(state, quadratic)[2:4]
    slopes = np.zeros_like(force)
    for at in np.ndindex(force.shape):
        there, back = state.copy(), state.copy()
        there[at] += step
        back[at] -= step
        slopes[at] = (densities(there).sum() - densities(back).sum())/(2*step)
    difference = np.abs(force + slopes).max()
    return float(difference/np.abs(force).max())


def momentum_left() -> float:
    """Sum of m dv/dt over the sum of moduli, with viscosity and conduction."""
    terms = rates(start(), eta=0.3)[2:4]
    left = np.abs(terms.sum(axis=1)).max()
    return float(left/np.abs(terms).sum())


def energy_left() -> float:
    """Sum of m(de/dt + v.dv/dt) over the sum of moduli, with viscosity and conduction."""
    state = start()
    rate = rates(state, eta=0.3)
    terms = np.array([rate[4], state[2]*rate[2], state[3]*rate[3]])
    return float(np.abs(terms.sum())/np.abs(terms).sum())


def energy_drift() -> float:
    """Change of kinetic energy and sum of w over kinetic energy, after t = 4.8 with dt = 0.075; P = rho^2."""
    first, last = start(), end(1, 64, pressure=quadratic)
    before = kinetic(first) + densities(first).sum()
    after = kinetic(last) + densities(last).sum()
    return float(abs(after - before)/kinetic(first))


def kinetic(state: np.ndarray) -> float:
    """Kinetic energy."""
    return float((state[2:4]**2).sum()/2)


@cache
def end(seed: int, steps: int, **law) -> np.ndarray:
    """State at the end of TIME, by so many steps; kept, because several numbers need the same."""
    return march(start(seed), TIME/steps, steps, **law)


def order(error: Errors, steps: tuple[int, ...], **law) -> Measured:
    """Slope of log error against log dt, mean over starts; `error` gets the start and all ends."""
    orders = []
    for seed in SEEDS:
        ends = [end(seed, n, **law) for n in steps]
        errors = error(start(seed), ends)
        log_steps = np.log(steps[:len(errors)])
        slope, _ = np.polyfit(log_steps, np.log(errors), 1)
        orders.append(-slope)
    return stats.over_seeds(orders)


def against_midpoint() -> Measured:
    """Error of Runge-Kutta of order 4, dt = 0.4, over that of order 2 with as many evaluations."""
    ratios = []
    for seed in SEEDS:
        true = end(seed, SMALL[-1], eta=0.3)
        fourth = end(seed, AS_RUN, eta=0.3)
        second = march_midpoint(start(seed), TIME/(2*AS_RUN), 2*AS_RUN, eta=0.3)
        ratios.append(distance(fourth, true)/distance(second, true))
    return stats.over_seeds(ratios)


def distance(one: np.ndarray, other: np.ndarray) -> float:
    """Root mean square of the difference of two states."""
    return float(np.sqrt(np.mean((one - other)**2)))


def return_errors(first: np.ndarray, ends: Sequence[np.ndarray]) -> list[float]:
    """Distance from the start after as many steps with all velocities turned; P = rho^2."""
    turn = np.array([1, 1, -1, -1, 1])[:, None]
    distances = []
    for last, n in zip(ends, STEPS, strict=False):
        back = march(last*turn, TIME/n, n, pressure=quadratic)
        apart = np.abs(back[:2] - first[:2])
        distances.append(float(apart.max()))
    return distances


def step_errors(first: np.ndarray, ends: Sequence[np.ndarray]) -> list[float]:
    """Distance between the ends of one step size and of half of it."""
    return [distance(a, b) for a, b in pairwise(ends)]
