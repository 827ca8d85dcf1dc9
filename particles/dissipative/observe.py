"""Quantities of dissipative particles, from the pair sums and the state (3 d, n) = x, v, f."""
from typing import Any, NamedTuple

import numpy as np

from particles.pairs import pair_term


class Static(NamedTuple):
    """Sums of the repulsion F: components, Laplacian of its potential, F.r, and y f_x, f = F + friction."""
    d: int
    a: float


@pair_term(Static, 6)
def _(term, a, b, ab):
    """U'' + (d - 1) U'/r = a - (d - 1) f"""
    fx, fy, fz = ab.f*ab.dx, ab.f*ab.dy, ab.f*ab.dz
    friction = ab.g*(ab.dx*(a.vx - b.vx) + ab.dy*(a.vy - b.vy) + ab.dz*(a.vz - b.vz))
    return (fx, fy, fz, term.a - (term.d - 1)*ab.f, fx*ab.dx + fy*ab.dy + fz*ab.dz,
            (ab.f - friction)*ab.dx*ab.dy)


def static_sums(sums: Any, state: np.ndarray) -> np.ndarray:
    """Sums (n, 6) of `Static`, computed once for all quantities of a record."""
    if sums.seen is None:
        sums.seen = sums.over_pairs(Static(sums.method.d, sums.method.a), state, 6)
    return sums.seen


def forces_squared(sums: Any, state: np.ndarray) -> float:
    """Mean |F|^2 per particle."""
    return float((static_sums(sums, state)[:, :3]**2).sum()/sums.n)


def laplacian(sums: Any, state: np.ndarray) -> float:
    """Mean Laplacian of the potential U per particle."""
    return float(static_sums(sums, state)[:, 3].sum()/sums.n)


def kinetic_temperature(sums: Any, state: np.ndarray) -> float:
    """kT of the velocities."""
    return sums.method.temperature(state)


def configurational_temperature(sums: Any, state: np.ndarray) -> float:
    """kT from positions, <|grad U|^2>/<lap U>, too high by 1/n    [Rugh 1997; Butler et al. 1998]"""
    total = static_sums(sums, state)
    return float((total[:, :3]**2).sum()/total[:, 3].sum())


def pressure(sums: Any, state: np.ndarray) -> float:
    """P = [n kT + sum over pairs F.r/d]/V, kT that of the velocities."""
    n, d = sums.n, sums.places
    virial = static_sums(sums, state)[:, 4].sum()/2
    return float((n*kinetic_temperature(sums, state) + virial/d)/sums.method.volume)
