"""What is wrong with where moving points start, told once before the first step."""
from typing import Any, NamedTuple

import numpy as np

from particles.ghosts import ghosts_of
from particles.surroundings import Surroundings

#: spacings; of the largest stretch of the points around: below these no direction leads to or between neighbours
OVERLAP, FLAT = 1e-9, 1e-6


class Near(NamedTuple):
    """Pairs in range, each both ways: rows i (pairs,), points j, x_j - x_i (pairs, 2), -w'(r)/r times it (pairs, 2)."""
    i: np.ndarray
    j: np.ndarray
    apart: np.ndarray
    slope: np.ndarray


def near(around: Surroundings) -> Near:
    """What `Surroundings.place` found."""
    pairs = around.pairs
    taken, first = pairs.taken.astype(int), pairs.first.astype(int)
    entry = np.arange(taken.sum()) + np.repeat(first - np.cumsum(taken) + taken, taken)
    i, j = np.repeat(np.arange(len(taken)), taken), pairs.near[entry].astype(int)
    x = np.stack([around.x, around.y], axis=1)
    return Near(i, j, x[j] - x[i], np.stack([pairs.wx[entry], pairs.wy[entry]], axis=1))


def check_volumes(V: np.ndarray) -> None:
    """Refuse volumes that are none."""
    bad = np.flatnonzero(~((V > 0) & (V < np.inf)))
    if len(bad):
        raise ValueError(f"point {bad[0]} has volume {V[bad[0]]:g}: they must be positive and finite; `state` makes equal ones")


def check_apart(around: Surroundings, ids: np.ndarray, a: float) -> None:
    """Refuse points that lie in one place; a : spacing. They would never part."""
    pairs, n = near(around), around.n
    together = np.flatnonzero((pairs.apart**2).sum(axis=1) < (OVERLAP*a)**2)
    if not len(together):
        return
    i, j = pairs.i[together[0]], pairs.j[together[0]]
    j = j if j < n else ghosts_of(around).origin[j - n]
    told = "lies on a plate, where it meets its own image" if i == j else f"and point {ids[j]} overlap"
    raise ValueError(f"point {ids[i]} {told} at ({around.x[i]:g}, {around.y[i]:g}): no direction leads from one to the other; "
                     f"move {'it inside' if i == j else 'one of them'}")


def moments(around: Surroundings, V: np.ndarray) -> np.ndarray:
    """sum_j V_j W e (x_j - x_i) of plain quadrature, (n, 2, 2): the unit matrix where linear fields have exact gradients."""
    pairs, n = near(around), around.n
    of = np.concatenate([np.arange(n), ghosts_of(around).origin])
    parts = V[of[pairs.j], None, None]*pairs.slope[:, :, None]*pairs.apart[:, None, :]
    return np.stack([np.bincount(pairs.i, q, n)[:n] for q in parts.reshape(-1, 4).T], axis=1).reshape(n, 2, 2)


def check_reach(weight: Any, moment: np.ndarray, ids: np.ndarray) -> None:
    """Refuse points whose neighbours in range do not span the plane: no gradient can be made of them."""
    least, most = np.linalg.eigvalsh(moment).T
    bad = np.flatnonzero(~(least > FLAT*most))
    if len(bad):
        raise ValueError(f"point {ids[bad[0]]} has no neighbours in two directions within the weight's range h = {weight.h:g} "
                         f"({len(bad)} of {len(ids)} have not; Eq. 45 asks for several spacings): take a larger h or more points")
