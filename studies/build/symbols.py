"""Plane waves of small amplitude in a gas at rest, as computed on a square lattice    [RR98, Sec. III]

Numbers as in `continuum.exact.waves`. Sums are over points r of a lattice of unit spacing, w = c W(r) with
c from sum_r w r = d, e = r/|r|, n = k/|k|, m normal to n:

    s = sum_r w e.n sin k.r                                        [Eqs 34-36]
    nested: l, q, t with s^2 for k^2                               [Eqs 37, 38]
    pairwise: sum_r (2 w/r) (1 - cos k.r) times                    [Eq. 51]
        A + B (e.n)^2 for l, A + B (e.m)^2 for t, kappa for q

This module shares no code with the matrices under test.
"""
from typing import Any

import numpy as np

from continuum.exact.waves import LinearGas, Waves, continuum, waves
from particles.integral.interpolants import W, reach


def neighbours(weight: Any, d: int) -> np.ndarray:
    """Points r (m, d) of the unit lattice within the range of a weight."""
    q = np.arange(-int(reach(weight)), int(reach(weight)) + 1)
    r = np.stack([axis.ravel() for axis in np.meshgrid(*[q]*d)], axis=1)
    size = np.sqrt((r**2).sum(axis=1))
    return r[(size > 0) & (size < reach(weight))]


def lattice_waves(gas: LinearGas, weight: Any, k: np.ndarray, nested: bool) -> Waves:
    """Waves of the lattice at a wave vector k (2,) along an axis or a diagonal; gradients are along k."""
    d = len(k)
    r = neighbours(weight, d)
    size, n = np.sqrt((r**2).sum(axis=1)), k/np.hypot(*k)
    w = W(weight, size)
    w *= d/(w@size)
    m = np.array([-n[1], n[0]])
    along, across = r@n/size, r@m/size
    s = float((w*along)@np.sin(r@k))
    if nested:
        return continuum(gas, s, d)
    slow = 2*w/size*(1 - np.cos(r@k))
    A = gas.eta*(1/2 + 1/d) - gas.zeta/2
    B = (d + 2)/2*(gas.eta*(1 - 2/d) + gas.zeta)
    l, t = slow@(A + B*along**2), slow@(A + B*across**2)
    return waves(s, float(l), gas.kappa*float(slow.sum()), float(t))
