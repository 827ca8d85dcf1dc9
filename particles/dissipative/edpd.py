"""Dissipative particles with internal energies, which friction heats and conduction exchanges (eDPD)

    F_ij = [a w - gamma_ij w^2 u + sigma w zeta/sqrt(dt)] r_ij/r,    u = (v_i - v_j).r_ij/r,    w = 1 - r
    de_i/dt = sum_j -1/2 (friction and noise of F_ij).(v_i - v_j) + q_ij,    T_i = e_i/C
    q_ij = k_ij w^2 (1/T_i - 1/T_j) + sqrt(2 k_ij/dt) w zeta'_ij,    k_ij = kappa C^2 (T_i + T_j)^2/4

With sigma independent of temperatures and gamma_ij = sigma^2/4 (1/T_i + 1/T_j), equilibrium has exactly the
entropy sum C ln e_i    [Espanol 1997; Avalos & Mackie 1997]. Conduction is that of Li et al. 2014: exchanges
between i and j do not change k_ij. Units: k_B, masses and the range are 1.
"""
from dataclasses import dataclass, replace
from math import inf
from typing import NamedTuple

import numpy as np

from particles.dissipative.dpd import Dpd, Forces
from particles.dissipative.integrators import KickDriftFrictionDriftKick
from particles.dissipative.pairs3d import Law
from particles.noise import uniform, words_of_pair
from particles.pairs import pair_term
from particles.threads import Threads

PASSES = 4      # iterations for friction at the mean velocity of a step: each cuts the error some 20 times


class Exchange(NamedTuple):
    """Force of friction and noise (3), and heat, with its work on velocities u (n, 3); T, u by id."""
    seed: int
    step: int
    dt: float
    sigma: float
    k: float
    T: np.ndarray
    u: np.ndarray


@pair_term(Exchange, 4)
def _(term, a, b, ab):
    """F = [...] r_ij/r without a w, and -F.(u_i - u_j)/2 + q_ij"""
    x, y, z = ab.dx, ab.dy, ab.dz
    r = np.sqrt(x*x + y*y + z*z)
    T, other, u, v = term.T[a.id], term.T[b.id], term.u[a.id], term.u[b.id]
    one, two, _, _ = words_of_pair(term.seed, term.step, a.id, b.id, 0)
    w, gamma, k = 1 - r, term.sigma**2/4*(1/T + 1/other), term.k*(T + other)**2/4
    along = (x*(a.vx - b.vx) + y*(a.vy - b.vy) + z*(a.vz - b.vz))/r
    c = (term.sigma/np.sqrt(term.dt)*uniform(one) - gamma*w*along)*w/r
    swap = np.sqrt(2*k/term.dt)*uniform(two)*(1.0 if a.id < b.id else -1.0)
    work = c*(x*(u[0] - v[0]) + y*(u[1] - v[1]) + z*(u[2] - v[2]))
    return c*x, c*y, c*z, w*(k*w*(1/T - 1/other) + swap) - work/2


@dataclass(frozen=True, kw_only=True)
class Edpd(Dpd):
    """A `Dpd` fluid with energies. gamma : friction where all temperatures are kT. C : heat capacity of each.

    State rows are x, v, the force of repulsion, e. Raises ValueError: C or kappa is out of range.
    """
    C: float = 100.0
    kappa: float = 0.01
    integrator: type = KickDriftFrictionDriftKick

    def __post_init__(self):
        super().__post_init__()
        if not (0 < self.C < inf and 0 <= self.kappa < inf):
            raise ValueError(f"C must be positive, kappa zero or positive, got {self.C}, {self.kappa}")

    @property
    def names(self) -> tuple[str, ...]:
        return (*super().names, "e")

    def law(self, dt: float) -> Law:
        """Amplitudes of repulsion only."""
        return Law(self.a, 0.0, 0.0)

    def limit(self, start: np.ndarray) -> float:
        """Limit of `Dpd`, where conduction counts as a friction of d kappa C."""
        return Dpd.limit(replace(self, gamma=max(self.gamma, self.d*self.kappa*self.C)), start)

    def random_start(self, rho: float, seed: int = 1) -> np.ndarray:
        """State (3 d + 1, n) at random places, all temperatures kT."""
        state = super().random_start(rho, seed)
        return np.vstack([state, np.full(state.shape[1], self.C*self.kT)])

    def start(self, n: int, threads: Threads) -> "Exchanges":
        return Exchanges(self, n, threads)


class Exchanges(Forces):
    """Pair sums of n particles that exchange energy as well."""
    method: Edpd

    def fault(self, state: np.ndarray, ids: np.ndarray) -> str:
        i = int(np.argmin(state[-1]))
        return f"particle {ids[i]} has e = {state[-1, i]:.6g}: shorten the step"*bool(state[-1, i] <= 0)

    def rub(self, x: np.ndarray, v: np.ndarray, dt: float) -> None:
        """Apply friction, noise and conduction to v and the energies for a time dt.

        Friction is taken at the mean of v before and after, which keeps kT at any step. Heat is the work of
        the same forces on this mean, which conserves energy to round-off.
        """
        method, ids, e, d = self.method, self.now.ids, self.now.state[-1], len(v)
        sigma, k = np.sqrt(2*method.gamma*method.kT), method.kappa*method.C**2
        T, u, mean = np.empty(self.n), np.zeros((self.n, 3)), v
        T[ids] = e/method.C
        term = Exchange(method.seed, self.now.step + 1, dt, sigma, k, T, u)
        for _ in range(PASSES):
            seen = np.concatenate([x, mean])
            F = self.over_pairs(term, seen, 4)[:, :d].T
            mean = v + dt/2*F
        u[ids, :d] = mean.T
        e += dt*self.over_pairs(term, seen, 4)[:, 3]
        v += dt*F
