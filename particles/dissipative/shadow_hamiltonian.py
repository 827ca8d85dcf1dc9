"""What Verlet's rule does to temperatures at a step dt, from sums over dissipative particles in three dimensions.

Velocity-Verlet follows not H but H + dt^2 [(v.K v)/12 - |F|^2/24] to second order, K the second derivatives of the potential U
and F = -grad U    [Hairer, Lubich & Wanner 2006, Sec. IX]. Friction G that is weak, set against noise, finds kT' for this energy
by tr G <v v> = kT tr G. As <v v> = kT' (1 - dt^2 K/6) at given places, and these have the density
exp(-[U + dt^2 (kT lap U/12 - |F|^2/24)]/kT'),

    kT'/kT - 1     = dt^2 tr<K G>/(6 tr<G>)
    kinetic kT     = kT' (1 - dt^2 <lap U>/(6 d n))
    |F|^2/<lap U>  = kT' (1 + dt^2 [<F.K F> - cov(|F|^2 - kT lap U, lap U)]/(12 kT <lap U>))

to second order, by parts: <(|F|^2 - kT lap U) q> = -kT <F.grad q>. One harmonic frequency
omega has 0 and omega^2 dt^2/4, exactly so. K is bounded and jumps at rc: what comes next may be of third order.
"""
from typing import Any, NamedTuple

import numpy as np

from particles.dissipative.observe import static_sums
from particles.pairs import nothing, rate


class Curved(NamedTuple):
    """K q of the repulsion, q in place of the velocities."""
    stiffness: float        # a/rc


@rate.of(Curved)
def _(term, a, b, ab):
    """[U'' - U'/r] (e.q_ab) e + (U'/r) q_ab, U'' = a/rc, U'/r = -f"""
    qx, qy, qz = a.vx - b.vx, a.vy - b.vy, a.vz - b.vz
    along = (term.stiffness + ab.f)*(ab.dx*qx + ab.dy*qy + ab.dz*qz)/(ab.dx*ab.dx + ab.dy*ab.dy + ab.dz*ab.dz)
    return along*ab.dx - ab.f*qx, along*ab.dy - ab.f*qy, along*ab.dz - ab.f*qz


class Blocks(NamedTuple):
    """Of a particle with itself xx, yy, zz, xy, yz, zx of K, of G = gamma w^2 e e; trace over its blocks with others of K G."""
    stiffness: float


@rate.of(Blocks)
def _(term, a, b, ab):
    """k = [U'' - U'/r] e e + U'/r, g = gamma w^2 e e, tr k g = U'' gamma w^2"""
    x, y, z, r2 = ab.dx, ab.dy, ab.dz, ab.dx*ab.dx + ab.dy*ab.dy + ab.dz*ab.dz
    k, g = (term.stiffness + ab.f)/r2, ab.g
    return (k*x*x - ab.f, k*y*y - ab.f, k*z*z - ab.f, k*x*y, k*y*z, k*z*x,
            g*x*x, g*y*y, g*z*z, g*x*y, g*y*z, g*z*x, term.stiffness*g*r2)


nothing.of(Curved)(lambda term: (0.0, 0.0, 0.0))
nothing.of(Blocks)(lambda term: (0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0))


def forces_squared(sums: Any, state: np.ndarray) -> float:
    """|F|^2 a particle."""
    return float((static_sums(sums, state)[:, :3]**2).sum()/sums.n)


def laplacian(sums: Any, state: np.ndarray) -> float:
    """lap U a particle."""
    return float(static_sums(sums, state)[:, 3].sum()/sums.n)


def forces_curved(sums: Any, state: np.ndarray) -> float:
    """F.K F a particle."""
    F = static_sums(sums, state)[:, :3]
    curved = sums.over_pairs(Curved(sums.method.a/sums.method.rc), np.concatenate([state[:3], F.T]), 3)
    return float((F*curved).sum()/sums.n)


def blocks(sums: Any, state: np.ndarray) -> tuple[float, float]:
    """tr K G and tr G a particle."""
    found = sums.over_pairs(Blocks(sums.method.a/sums.method.rc), state, 13)
    K, G = found[:, :6], found[:, 6:12]
    both = (K[:, :3]*G[:, :3]).sum() + 2*(K[:, 3:]*G[:, 3:]).sum() + found[:, 12].sum()
    return float(both/sums.n), float(G[:, :3].sum()/sums.n)


def friction_curved(sums: Any, state: np.ndarray) -> float:
    """tr K G a particle."""
    return blocks(sums, state)[0]


def friction(sums: Any, state: np.ndarray) -> float:
    """tr G a particle."""
    return blocks(sums, state)[1]


class Second(NamedTuple):
    """What dt^2 multiplies in kinetic and configurational kT over kT less 1, and in kT'."""
    kinetic: float
    configurational: float
    bath: float


def second_order(n: int, kT: float, F2: np.ndarray, lap: np.ndarray, FKF: np.ndarray, KG: np.ndarray, G: np.ndarray) -> Second:
    """From records of what n particles have on the mean, in three dimensions."""
    bath, off = KG.mean()/G.mean()/6, F2 - kT*lap
    covariance = n*float(np.mean((off - off.mean())*(lap - lap.mean())))
    return Second(bath - lap.mean()/18, bath + (FKF.mean() - covariance)/(12*kT*lap.mean()), bath)
