"""What is wrong with where moving points start, told once before the first step."""
from typing import Any

import numpy as np

from continuum.jit import jit
from particles.lists import PairLists, ghosts_of
from particles.pairs import Pairs

#: spacings; of the largest stretch of the points around
OVERLAP, FLAT = 1e-9, 1e-6


def check_volumes(V: np.ndarray) -> None:
    """Refuse volumes that are none."""
    bad = np.flatnonzero(~((V > 0) & (V < np.inf)))
    if len(bad):
        raise ValueError(f"point {bad[0]} has volume {V[bad[0]]:g}: they must be positive and finite")


class Overlap(ValueError):
    """Points lie in one place, as pairing may leave them, too."""


def check_apart(around: PairLists, ids: np.ndarray, a: float) -> None:
    """Refuse points that lie in one place, where they would stay; a : spacing. After `PairLists.place`."""
    n = around.n
    i, j = _together(n, around.pairs, around.x, around.y, (OVERLAP*a)**2)
    if i == n:
        return
    j = j if j < n else ghosts_of(around).origin[j - n]
    told = "lies on a plate, where it meets its own image" if i == j else f"and point {ids[j]} overlap"
    raise Overlap(f"point {ids[i]} {told} at ({around.x[i]:g}, {around.y[i]:g}): move "
                  f"{'it inside' if i == j else 'one of them'}")


def moments(around: PairLists, V: np.ndarray) -> np.ndarray:
    """sum_j V_j W e (x_j - x_i) of plain quadrature, (n, 2, 2): 1 where linear gradients are exact."""
    out = np.zeros((around.n, 2, 2))
    everywhere = np.concatenate([V, V[ghosts_of(around).origin]])
    _moments(around.n, around.pairs, around.x, around.y, everywhere, out)
    return out


def check_reach(weight: Any, moment: np.ndarray, ids: np.ndarray) -> None:
    """Refuse points whose neighbours in range do not span the plane: no gradient can be made of them."""
    least, most = np.linalg.eigvalsh(moment).T
    bad = np.flatnonzero(~(least > FLAT*most))
    if len(bad):
        raise ValueError(f"point {ids[bad[0]]} has no neighbours in two directions within h = "
                         f"{weight.h:g} ({len(bad)} of {len(ids)} have not): take a larger h or more points")


@jit
def _together(n, pairs: Pairs, x, y, least):
    """The first two points whose squared distance is below the least; (n, n) if there are none."""
    for i in range(n):
        for k in range(pairs.first[i], pairs.first[i] + pairs.taken[i]):
            j = pairs.near[k]
            if (x[j] - x[i])**2 + (y[j] - y[i])**2 < least:
                return i, int(j)
    return n, n


@jit
def _moments(n, pairs: Pairs, x, y, V, out):
    for i in range(n):
        for k in range(pairs.first[i], pairs.first[i] + pairs.taken[i]):
            j = pairs.near[k]
            wx, wy, dx, dy = V[j]*pairs.wx[k], V[j]*pairs.wy[k], x[j] - x[i], y[j] - y[i]
            out[i, 0, 0] += wx*dx
            out[i, 0, 1] += wx*dy
            out[i, 1, 0] += wy*dx
            out[i, 1, 1] += wy*dy
