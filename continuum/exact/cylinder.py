"""Slow flow past a square array of cylinders: published drags, and a series    [Sangani & Acrivos 1982]

Drags are forces on a unit length over viscosity and mean velocity, F/(mu U); c is the solid fraction.
"""
from math import log, pi

from continuum.published import PrintedNumber, published


def drag_of(c: float) -> PrintedNumber:
    """The published drag of solid fraction c, one of 0.05, 0.1, 0.2, 0.3."""
    return published(f"cylinders-drag-{c:g}")


def series(c: float) -> float:
    """F/(mu U) of a dilute array: to 0.1 % up to c = 0.1."""
    s = [published(f"cylinders-series-{n}").value for n in range(4)]
    return 4*pi/(s[0] + s[1]*c + s[2]*c**2 + s[3]*c**3 - log(c)/2)
