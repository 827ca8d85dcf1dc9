"""Fields of a state, in terms that all methods share, and their kinetic energy."""
from typing import Any

import numpy as np

from continuum.fluid import Fields, temperature


def from_densities(eos: Any, x: np.ndarray, V: np.ndarray, rho: np.ndarray, p: np.ndarray,
                   eps: np.ndarray) -> Fields:
    """Fields of density rho (n,), momentum p (d, n) and total energy eps (n,), each per volume."""
    v = (p/rho).T
    e = eps/rho - (v**2).sum(axis=1)/2
    return Fields(x, v, rho, temperature(eos, rho, e), V)


def kinetic_energy(fields: Fields) -> float:
    """Kinetic energy per mass, sum m v^2/2 over sum m."""
    m = fields.rho*fields.V
    return float(0.5*m@(fields.v**2).sum(axis=1)/m.sum())


def kinetic(sums: Any, state: np.ndarray) -> float:
    """The same as a quantity of a run, of any method."""
    return kinetic_energy(sums.method.fields(state))
