"""Checks of the places where moving points start, made once before the first step."""
from typing import Any

import numpy as np

from particles.lists import PairLists, ghosts_of
from particles.pairs import entries

#: distance of overlapping points in spacings; least ratio of the eigenvalues of `moments`
OVERLAP, FLAT = 1e-9, 1e-6


def check_volumes(V: np.ndarray) -> None:
    """Check that volumes are positive and finite. Raises ValueError."""
    bad = np.flatnonzero(~((V > 0) & (V < np.inf)))
    if len(bad):
        raise ValueError(f"point {bad[0]} has volume {V[bad[0]]:g}: they must be positive and finite")


def check_apart(around: PairLists, ids: np.ndarray, a: float) -> None:
    """Raise ValueError if two points lie in one place, where they would stay. a : spacing. After `place`."""
    i, entry = entries(around.pairs, np.arange(around.n))
    j = around.pairs.near[entry]
    met = np.flatnonzero((around.x[j] - around.x[i])**2 + (around.y[j] - around.y[i])**2 < (OVERLAP*a)**2)
    if not len(met):
        return
    i, j = i[met[0]], j[met[0]]
    j = j if j < around.n else ghosts_of(around).origin[j - around.n]
    told = "lies on a plate, where it meets its own image" if i == j else f"and point {ids[j]} overlap"
    raise ValueError(f"point {ids[i]} {told} at ({around.x[i]:g}, {around.y[i]:g}): move "
                     f"{'it inside' if i == j else 'one of them'}")


def moments(around: PairLists, V: np.ndarray) -> np.ndarray:
    """sum_j V_j W e (x_j - x_i) by quadrature, (n, 2, 2): 1 where gradients of linear fields are exact."""
    V = np.concatenate([V, V[ghosts_of(around).origin]])
    i, entry = entries(around.pairs, np.arange(around.n))
    j = around.pairs.near[entry]
    weights = V[j]*around.pairs.wx[entry], V[j]*around.pairs.wy[entry]
    apart = around.x[j] - around.x[i], around.y[j] - around.y[i]
    sums = [np.bincount(i, w*d, around.n) for w in weights for d in apart]
    return np.stack(sums, axis=1).reshape(-1, 2, 2)


def check_reach(weight: Any, moment: np.ndarray, ids: np.ndarray) -> None:
    """Check that neighbours in range span the plane, which gradients need. Raises ValueError."""
    least, most = np.linalg.eigvalsh(moment).T
    bad = np.flatnonzero(~(least > FLAT*most))
    if len(bad):
        raise ValueError(f"point {ids[bad[0]]} has no neighbours in two directions within h = "
                         f"{weight.h:g} ({len(bad)} of {len(ids)} have not): take a larger h or more points")
