"""Sums over few particles: lattices of the two printed weights, and 36 particles in a periodic square.

Mass 1 a particle, lengths in sigma, density 1 but in the square. `particles.weights` normalises its weights
by quadrature. Here the printed factors stand, so that they can be judged    [KHP95, Sec. II]
"""
from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import cache
from itertools import pairwise
from typing import Any, NamedTuple

import numpy as np
from numpy.polynomial import Polynomial

from continuum.fluid import ConstEta, VanDerWaals
from particles.integrators import RK4, Euler
from particles.limits import rates_of
from particles.plan import Plan
from particles.run import run
from particles.smooth.spam import Spam
from particles.weights import Lucy
from studies.build.spam import fluid
from studies.kit import fits, stats
from studies.kit.stats import Measured

RANGE = 3.0

# --- lattices -------------------------------------------------------------------------------------

R = Polynomial([0, 1])
#: primitive vectors, as columns
AXES = {"square": np.eye(2), "hexagonal": np.array([[1.0, 0.5], [0.0, np.sqrt(3)/2]])}


class Printed(NamedTuple):
    """A weight of range 3 in pieces (upper end, polynomial in r)."""
    pieces: tuple[tuple[float, Polynomial], ...]

    def __call__(self, r, h: float = RANGE):
        """w(r) of range h; the printed one stretched, its integral kept."""
        s = np.asarray(r)*RANGE/h
        inside = [s < end for end, _ in self.pieces]
        values = [piece(s) for _, piece in self.pieces]
        return (RANGE/h)**2*np.select(inside, values, 0.0)

    @property
    def integral(self) -> float:
        """Over the plane."""
        ends = [end for end, _ in self.pieces]
        discs = [(2*np.pi*R*piece).integ() for _, piece in self.pieces]
        return float(sum(disc(end) - disc(begin) for disc, begin, end in zip(discs, [0.0, *ends], ends)))

    def jumps(self, order: int) -> list[float]:
        """Jumps of the derivative of that order at the ends of the pieces, over w(0); at r = 0 the slope."""
        slopes = [piece.deriv(order) for _, piece in self.pieces]
        jumps = [after(end) - before(end) for before, after, (end, _) in zip(
            slopes, [*slopes[1:], Polynomial([0.0])], self.pieces)]
        return [jump/float(self(0.0)) for jump in jumps + [slopes[0](0.0)]*(order == 1)]


LUCY = Printed(((3.0, 5/(9*np.pi)*(1 + R)*(1 - R/3)**3),))
MONAGHAN = Printed(((1.5, 40/(63*np.pi)*(1 - 2/3*R**2 + 2/9*R**3)), (3.0, 80/(63*np.pi)*(1 - R/3)**3)))
BOTH = (LUCY, MONAGHAN)


def lattice(kind: str, per_site: float = 1.0, reach: float = 12.0) -> np.ndarray:
    """(2, sites): a lattice of density 1 with so many particles a site, one site at the origin."""
    n = np.arange(-int(2*reach), int(2*reach) + 1)
    sites = AXES[kind]@np.reshape(np.meshgrid(n, n), (2, -1))
    return sites*np.sqrt(per_site/np.linalg.det(AXES[kind]))


def density(weight: Printed, kind: str, per_site: float = 1.0) -> float:
    """The density sum at a particle of a lattice of density 1."""
    return float(per_site*weight(np.hypot(*lattice(kind, per_site))).sum())


def largest_modulus(weight: Printed, kind: str, h: float = RANGE, step: float = 1e-3) -> float:
    """Largest |G/B| of the ideal gas, shear over bulk modulus, sheared along an axis and at 45 degrees.

    By differences of three sums. At constant area only the sum of the density changes: G = P
    d2(rho)/d(gamma)^2, B = rho c^2 = 2 P, gamma = 2 step.
    """
    moduli = []
    for angle in (0.0, np.pi/4):
        cos, sin = np.cos(angle), np.sin(angle)
        turn = np.array([[cos, sin], [-sin, cos]])
        stretches = (np.diag([np.exp(s), np.exp(-s)]) for s in (-step, 0.0, step))
        sums = [weight(np.hypot(*(stretch@turn@lattice(kind))), h).sum() for stretch in stretches]
        moduli.append(abs(np.diff(sums, 2)[0]/step**2/4/2))
    return float(max(moduli))


def least(weight: Printed, kind: str) -> tuple[float, int]:
    """Least density sum, which is the least energy at any pressure, and its number of particles a site."""
    return min((density(weight, kind, sites), sites) for sites in (1, 2, 3, 4))


# --- 36 particles ---------------------------------------------------------------------------------

SIDE = 6.5                      # more than twice the range: no pair is counted twice
TIME = 4.8
STEPS = (8, 16, 32, 64)         # of that time: dt from 0.6, the largest stable one, down
SMALL = (64, 128, 256, 512)     # dt from 0.075 down
AS_RUN = 12                     # dt = 0.4, as in the runs of the study
SEEDS = (1, 2, 3, 4, 5, 6)
MORE = range(1, 25)             # of the order at steps as in runs, which six left open
GAS = fluid(Lucy.of(RANGE), (SIDE, SIDE), law=ConstEta(0.3, 0.3))
#: P = rho^2: van der Waals without excluded volume, of a heat capacity so large that energy adds nothing
RHO_SQUARED = VanDerWaals(a=-1.0, b=0.0, cv=1e300)
MOLECULES = fluid(Lucy.of(RANGE), (SIDE, SIDE), RHO_SQUARED)
TURN = np.array([1, 1, -1, -1, 1])[:, None]     # of velocities
Errors = Callable[[Spam, int, Sequence[int]], list[float]]


class Midpoint(Euler):
    """Runge-Kutta of second order: two evaluations a step."""

    def step(self, sums: Any, y: np.ndarray, dt: float) -> None:
        sums.rates(y, self._k)
        sums.rates(y + dt/2*self._k, self._k)
        y += dt*self._k


#: of whole numbers: sums in another order differ by 1e-16, but all except 1e-8 of them are rounded alike
GRID = 2.0**-24


def whole(q: np.ndarray) -> np.ndarray:
    """The nearest multiples of GRID."""
    return np.rint(q/GRID)*GRID


class WholeLeapfrog(Euler):
    """Half a kick, a drift, half a kick in whole numbers: reversible bit by bit [Levesque & Verlet 1993].

    Energies stay, as nothing depends on them.
    """

    def step(self, sums: Any, y: np.ndarray, dt: float) -> None:
        for drift in (dt, 0.0):
            sums.rates(y, self._k)
            y[2:4] += whole(self._k[2:4]*dt/2)
            y[:2] += whole(y[2:4]*drift)


def start(method: Spam = GAS, seed: int = 1) -> np.ndarray:
    """A jittered lattice with random velocities; e about 1, or so large that any density is valid."""
    rng = np.random.default_rng(seed)
    sites = np.indices((6, 6)).reshape(2, 36)
    x = (sites + 0.5)*SIDE/6 - SIDE/2 + rng.uniform(-0.2, 0.2, (2, 36))
    v = 0.3*rng.standard_normal((2, 36))
    e = 1 + 0.1*rng.standard_normal((1, 36))
    return np.concatenate([x, v, e if method is GAS else 1e3*e])


def rates(method: Spam, state: np.ndarray) -> np.ndarray:
    """d/dt of a state (5, n) by the sums that run."""
    sums, ordered, ids = method.look(state)
    return rates_of(sums, ordered)[:, np.argsort(ids)]


@cache
def end(method: Spam, seed: int, steps: int, integrator: type = RK4) -> np.ndarray:
    """State at the end of TIME after so many steps; kept, as several numbers need it."""
    return march(replace(method, integrator=integrator), start(method, seed), steps)


def march(method: Spam, state: np.ndarray, steps: int, time: float = TIME) -> np.ndarray:
    """State after some time."""
    return run(method, state, Plan(dt=time/steps, steps=steps)).by_id()


def apart(one: np.ndarray, other: np.ndarray) -> np.ndarray:
    """Difference of two states, places to the nearest image."""
    change = one - other
    change[:2] -= SIDE*np.round(change[:2]/SIDE)
    return change


def distance(one: np.ndarray, other: np.ndarray) -> float:
    """Root mean square of the difference of two states."""
    return float(np.sqrt(np.mean(apart(one, other)**2)))


def potential(state: np.ndarray) -> float:
    """Sum of 2 w over all pairs, and of each particle's own w."""
    return float(MOLECULES.fields(state).rho.sum())


def not_molecular(step: float = 1e-5) -> float:
    """Largest difference of SPAM accelerations, P = rho^2, from -grad of sum 2 w(r), relative."""
    state = start(MOLECULES)
    force = rates(MOLECULES, state)[2:4]
    slopes = np.zeros_like(force)
    for at in np.ndindex(force.shape):
        change = np.zeros_like(state)
        change[at] = step
        slopes[at] = (potential(state + change) - potential(state - change))/(2*step)
    return float(np.abs(force + slopes).max()/np.abs(force).max())


def left_over() -> tuple[float, float]:
    """Sums of m dv/dt and of m(de/dt + v.dv/dt) over the sums of moduli, with viscosity and conduction."""
    state = start()
    rate = rates(GAS, state)
    forces, energies = rate[2:4], np.array([rate[4], *(state[2:4]*rate[2:4])])
    momentum = np.abs(forces.sum(axis=1)).max()/np.abs(forces).sum()
    return float(momentum), float(np.abs(energies.sum())/np.abs(energies).sum())


def energy_drift() -> float:
    """Change of kinetic energy and sum of w over kinetic energy, after t = 4.8 with dt = 0.075; P = rho^2."""
    states = start(MOLECULES), end(MOLECULES, 1, 64)
    kinetic = [(state[2:4]**2).sum()/2 for state in states]
    before, after = (K + potential(state) for K, state in zip(kinetic, states))
    return float(abs(after - before)/kinetic[0])


def order(error: Errors, method: Spam, steps: Sequence[int], seeds: Sequence[int] = SEEDS) -> Measured:
    """-d ln error/d ln steps, mean over starts; of as many numbers of steps as there are errors."""
    errors = [error(method, seed, steps) for seed in seeds]
    return stats.over_seeds([-fits.power_law(steps[:len(some)], some).slope.value for some in errors])


def against_midpoint() -> Measured:
    """Error of Runge-Kutta of order 4, dt = 0.4, over that of order 2 with as many evaluations."""
    ends = [(end(GAS, seed, AS_RUN), end(GAS, seed, 2*AS_RUN, Midpoint), end(GAS, seed, SMALL[-1]))
            for seed in SEEDS]
    return stats.over_seeds([distance(fourth, true)/distance(second, true) for fourth, second, true in ends])


def return_errors(method: Spam, seed: int, steps: Sequence[int]) -> list[float]:
    """Largest distance from the start after as many steps with all velocities turned."""
    back = [march(method, TURN*end(method, seed, n), n) for n in steps]
    return [float(np.abs(apart(one, start(method, seed))[:2]).max()) for one in back]


def returned(time: float = 100.0, steps: int = 400) -> float:
    """Least part of places and velocities that come back to the last bit, in whole numbers, of all starts."""
    method = replace(MOLECULES, integrator=WholeLeapfrog)
    starts = [whole(start(MOLECULES, seed)) for seed in SEEDS]
    ends = [TURN*march(method, TURN*march(method, first, steps, time), steps, time) for first in starts]
    return float(min(np.mean(apart(last, first)[:4] == 0) for last, first in zip(ends, starts)))


def step_errors(method: Spam, seed: int, steps: Sequence[int]) -> list[float]:
    """Distance between the ends of one step size and of half of it."""
    return [distance(a, b) for a, b in pairwise(end(method, seed, n) for n in steps)]
