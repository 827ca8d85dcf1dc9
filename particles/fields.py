"""Fields of a state in the variables that all methods share, and their kinetic energy."""
from math import isfinite
from numbers import Real
from typing import Any

import numpy as np

from continuum.fluid import Fields, temperature


def check_numbers(**numbers: Any) -> None:
    """Check that all values are finite numbers. Raises TypeError: not a number; ValueError: not finite."""
    for name, value in numbers.items():
        if isinstance(value, bool) or not isinstance(value, Real):
            raise TypeError(f"{name} must be a number, got {value!r}: give it without quotes or brackets")
        if not isfinite(value):
            raise ValueError(f"{name} must be finite, got {value}: take one that a float holds")


def check_plain(what: str, *arrays: Any) -> None:
    """Check that arrays hold real numbers and have no mask. Raises TypeError."""
    for given in arrays:
        if np.asanyarray(given).dtype.kind not in "iuf" or isinstance(given, np.ma.MaskedArray):
            kind = f"{type(given).__name__} of {np.asanyarray(given).dtype}"
            raise TypeError(f"{what} are an array of numbers, got {kind}: give real ones, without a mask")


def from_densities(eos: Any, x: np.ndarray, V: np.ndarray, rho: np.ndarray, p: np.ndarray,
                   eps: np.ndarray) -> Fields:
    """Fields from density rho (n,), momentum p (d, n) and total energy eps (n,), each per volume."""
    v = (p/rho).T
    e = eps/rho - (v**2).sum(axis=1)/2
    return Fields(x, v, rho, temperature(eos, rho, e), V)


def kinetic_energy(fields: Fields) -> float:
    """Kinetic energy per mass, sum m v^2/2 over sum m."""
    m = fields.rho*fields.V
    return float(0.5*m@(fields.v**2).sum(axis=1)/m.sum())


def kinetic(sums: Any, state: np.ndarray) -> float:
    """Kinetic energy per mass, as a quantity that a run of any method records."""
    return kinetic_energy(sums.method.fields(state))
