"""Dissipative particle dynamics in two and three dimensions    [Groot & Warren 1997]

    F_ij = [a w - gamma w^2 (e.v_ij) + sqrt(2 gamma kT/dt) w zeta_ij] e,    w = 1 - r,    e = r_ij/r

zeta_ij = zeta_ji has mean 0 and variance 1, and is new in every step. Masses and the range rc are 1. The
state (3 d, n) is x, v and the force at the end of the last step, which integrators and restarts need.
"""
from dataclasses import dataclass
from math import inf
from typing import Any

import numpy as np

from particles.dissipative import pairs3d
from particles.dissipative.integrators import GrootWarren65
from particles.dissipative.pairs3d import Force, Law
from particles.dissipative.periodic3d import Images
from particles.fields import Fields
from particles.method import Sums
from particles.neighbours import u32, u64
from particles.noise import check_seed
from particles.pairs import pair_term
from particles.threads import Threads

SORT = 20       # steps between sorts of the particles by cells


@dataclass(frozen=True, kw_only=True)
class Dpd:
    """A fluid of dissipative particles in a periodic box (width, height[, depth]) centred on the origin.

    a, gamma, kT : repulsion, friction, temperature. seed : of the noise. skin : of the neighbour lists.
    integrator : one of `integrators`, or `TwoStep` for RR98 Eqs 40, 41. Raises ValueError: a parameter is out
    of range.
    """
    box: tuple[float, ...]
    a: float = 25.0
    gamma: float = 4.5
    kT: float = 1.0
    seed: int = 1
    integrator: type = GrootWarren65
    skin: float = 0.3

    def __post_init__(self):
        check_seed(self.seed)
        for name in ("a", "gamma", "kT", "skin"):
            if not 0 <= getattr(self, name) < inf:
                raise ValueError(f"{name} must be zero or positive, got {getattr(self, name)}")
        if len(self.box) not in (2, 3) or not all(3 <= side < inf for side in self.box):
            raise ValueError(f"the box {self.box} needs two or three sides of at least 3, or a particle "
                             "meets the same one twice: take a larger box")

    @property
    def d(self) -> int:
        """Number of dimensions."""
        return len(self.box)

    @property
    def names(self) -> tuple[str, ...]:
        return tuple(kind + axis for kind in ("", "v", "f") for axis in "xyz"[:self.d])

    @property
    def volume(self) -> float:
        return float(np.prod(self.box))

    def law(self, dt: float) -> Law:
        """Amplitudes of the forces for a step dt: sigma^2 is 2 gamma kT/dt    [Español & Warren 1995]"""
        return Law(self.a, self.gamma, float(np.sqrt(2*self.gamma*self.kT/dt)))

    def limit(self, start: np.ndarray) -> float:
        """The smaller of 2/omega (velocity-Verlet) and 2/Lambda (forward friction), where all neighbours move
        against a particle: omega^2 = 2 rho V a/d, Lambda = 2 rho V gamma <w^2>/d, V that of the unit ball."""
        rho_V = start.shape[1]/self.volume*{2: np.pi, 3: 4*np.pi/3}[self.d]
        w2 = 2/((self.d + 1)*(self.d + 2))       # mean over the ball: d int (1 - s)^2 s^(d - 1) ds
        omega, friction = np.sqrt(2*rho_V*self.a/self.d), 2*rho_V*self.gamma*w2/self.d
        return float(min(2/max(omega, 1e-300), 2/max(friction, 1e-300)))

    def random_start(self, rho: float, seed: int = 1) -> np.ndarray:
        """State (3 d, n) at random places, velocities of kT. Raises ValueError: rho gives no pair."""
        if not 2/self.volume <= rho < inf:
            raise ValueError(f"rho = {rho} makes no two particles in a volume of {self.volume:g}: take 3")
        rng, n = np.random.default_rng(seed), round(rho*self.volume)
        x = rng.uniform(-0.5, 0.5, (self.d, n))*np.array(self.box)[:, None]
        v = np.sqrt(self.kT)*rng.standard_normal((self.d, n))
        v -= v.mean(axis=1, keepdims=True)
        return np.concatenate([x, v, np.zeros_like(x)])

    def temperature(self, state: np.ndarray) -> float:
        """kT of the velocities, with d (n - 1) degrees of freedom, as their sum is conserved."""
        v = state[self.d:2*self.d]
        return float((v**2).sum()/(len(v)*(v.shape[1] - 1)))

    def fields(self, state: np.ndarray) -> Fields:
        """Fields of the particles, (n,) each, with the mean density and the temperature of all velocities."""
        x, v = state[:self.d].T.copy(), state[self.d:2*self.d].T.copy()
        one, n = np.ones(len(x)), len(x)
        return Fields(x, v, n/self.volume*one, self.temperature(state)*one, self.volume/n*one)

    def start(self, n: int, threads: Threads) -> "Forces":
        return Forces(self, n, threads)


class Forces(Sums):
    """Pair sums of n particles, for the time loop and the integrators."""

    def __init__(self, method: Dpd, n: int, threads: Threads):
        self.method, self.n, self.threads, self.places = method, n, threads, method.d
        self.images = Images(n, method.box, method.skin, threads)
        self.total, self.taken = np.empty((n, 3)), (np.empty(n, u64), np.empty(n, u32))
        self.particle, self.dt = np.empty(0, pairs3d.Record), 1.0
        self.now: Any = None                       # the run
        self.seen: np.ndarray | None = None        # sums that measured quantities share

    def resume(self, now: Any) -> None:
        """Make the lists that the interrupted run had."""
        self.now = now
        if now.anchor is not None:
            self.images.relist(now.anchor)

    def try_out(self, now: Any) -> None:
        if now.anchor is None:
            self.rates(now.state.copy(), np.empty_like(now.state))
            self.images.anchor = now.anchor = None      # lists are made anew before the first step

    def make_ready(self, now: Any, dt: float) -> None:
        """Sort particles every SORT steps; make the first force."""
        d, self.dt = self.places, dt
        if now.step % SORT == 0:
            order = self.images.order(now.state[:d])
            now.state[:], now.ids[:], self.images.anchor = now.state[:, order], now.ids[order], None
        if now.step == 0:
            self._force(self.method.law(dt), 0, *now.state.reshape(3, d, -1))

    def fault(self, state: np.ndarray, ids: np.ndarray) -> str:
        """Every finite state is valid."""
        return ""

    def look_at(self, state: np.ndarray) -> None:
        """Forget the sums of an earlier state; the first quantity that needs sums computes them."""
        self.seen = None

    def velocity(self, state: np.ndarray) -> np.ndarray:
        return state[self.places:2*self.places]

    def rates(self, state: np.ndarray, out: np.ndarray) -> None:
        """d(state)/dt with the noise of this step, for `TwoStep`    [RR98 Eqs 39, 40, 49, 51]"""
        d = self.places
        out[:d], out[2*d:] = state[d:2*d], 0.0
        self.forces(state[:d], state[d:2*d], out[d:2*d])

    def forces(self, x: np.ndarray, v: np.ndarray, out: np.ndarray) -> None:
        """Forces (d, n) at x, v with the noise of this step."""
        self._force(self.method.law(self.dt), self.now.step + 1, x, v, out)

    def soft(self, x: np.ndarray, out: np.ndarray) -> None:
        """Forces (d, n) of repulsion only."""
        self._force(Law(self.method.a, 0.0, 0.0), 0, x, x, out)

    def rub(self, x: np.ndarray, v: np.ndarray, dt: float) -> None:
        """Apply friction and noise to v for a time dt."""
        method = self.method
        self._records(x, v)
        pairs3d.rub_pairs(self.n, method.law(dt), method.seed, self.now.step + 1, dt, self.particle,
                          self.images.lists, self.taken)
        for component, name in zip(v, ("vx", "vy", "vz")):
            component[:] = self.particle[name][:self.n]

    def static(self, state: np.ndarray) -> np.ndarray:
        """Sums (n, 5) of `Static`, computed once for all quantities of a record."""
        if self.seen is None:
            d, a, self.seen = self.places, self.method.a, np.empty((self.n, 5))
            self._sum(Static(d, a), Law(a, 0.0, 0.0), 0, state[:d], state[d:2*d], self.seen)
        return self.seen

    def _force(self, law, step, x, v, out):
        self._sum(Force(), law, step, x, v, self.total)
        out[:] = self.total[:, :self.places].T

    def _sum(self, term, law, step, x, v, out):
        self._records(x, v)
        self.threads(pairs3d.sum_pairs, self.n, term, law, self.method.seed, step, self.particle,
                     self.images.lists, self.taken, out)

    def _records(self, x, v):
        """Write records of particles and ghosts at x, v; make new lists if the old ones may miss a pair."""
        images = self.images
        if images.stale(x):
            images.relist(x)
            self.now.anchor = images.anchor
        points = len(images.parent)
        if len(self.particle) != points:
            self.particle = np.empty(points, pairs3d.Record)
        self.threads(pairs3d.record, points, x, v, self.now.ids, images.parent, images.shift, self.particle)


# --- quantities of a run, from its pair sums and the state ---------------------------------------


@pair_term(5, "d", "a")
def Static(term, a, b, ab):
    """Sums of the repulsion F: components, Laplacian U'' + (d - 1) U'/r of its potential, F.r."""
    fx, fy, fz = ab.f*ab.dx, ab.f*ab.dy, ab.f*ab.dz
    return fx, fy, fz, term.a - (term.d - 1)*ab.f, fx*ab.dx + fy*ab.dy + fz*ab.dz


def forces_squared(sums: Any, state: np.ndarray) -> float:
    """Mean |F|^2 per particle."""
    return float((sums.static(state)[:, :3]**2).sum()/sums.n)


def laplacian(sums: Any, state: np.ndarray) -> float:
    """Mean Laplacian of the potential U per particle."""
    return float(sums.static(state)[:, 3].sum()/sums.n)


def kinetic_temperature(sums: Any, state: np.ndarray) -> float:
    """kT of the velocities."""
    return sums.method.temperature(state)


def configurational_temperature(sums: Any, state: np.ndarray) -> float:
    """kT from positions, <|grad U|^2>/<lap U>, too high by 1/n    [Rugh 1997; Butler et al. 1998]"""
    return forces_squared(sums, state)/laplacian(sums, state)


def pressure(sums: Any, state: np.ndarray) -> float:
    """P = [n kT + sum over pairs F.r/d]/V, kT that of the velocities."""
    n, d = sums.n, sums.places
    virial = sums.static(state)[:, 4].sum()/2
    return float((n*kinetic_temperature(sums, state) + virial/d)/sums.method.volume)
