"""Periodic boxes of smooth particles, and what their compiled sums say of one state."""
from typing import Any

import numpy as np

from continuum.fluid import ConstEta, IdealGas
from particles.smooth.spam import Spam
from particles.threads import Team
from particles.walls.periodic import periodic

FRICTIONLESS = ConstEta(0.0, 0.0)


def fluid(weight: Any, box: tuple[float, float], eos: Any = IdealGas(), law: Any = FRICTIONLESS,  # noqa: B008
          **more: Any) -> Spam:
    """As printed, in a box that is periodic along both axes    [KHP95, Sec. II]"""
    walls = (*periodic(box[0]), *periodic(box[1], axis=1))
    return Spam(weight=weight, eos=eos, law=law, walls=walls, box=box, **more)


def at_rest(x: np.ndarray, e: Any) -> np.ndarray:
    """State (5, n) of particles at x (n, 2) that do not move."""
    return np.array([*x.T, *np.zeros((2, len(x))), np.broadcast_to(e, len(x))], float)


def densities(method: Spam, x: np.ndarray) -> np.ndarray:
    """rho (n,) of particles at x (n, 2), in the order of the lists."""
    sums, state = method.start(len(x), Team(1)), at_rest(x, 1.0)
    sums.around.relist(state, np.arange(len(x)), 0.0)
    sums.densities(state)
    return sums.around.rho[:len(x)].copy()
