"""Smooth particles that a force drives, with sums as printed or as of today."""
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np

from particles.pairs import entries
from particles.smooth.spam import Spam
from particles.smooth.sums import Nested
from studies.build import spam

Flowing = Callable[[np.ndarray], np.ndarray]     # of phases k (x, y), (2, n)
#: today's smooth particles that are stirred, too
MAKERS = ("sph", "riemann", "sumB", "RKGC", "bonet-lok", "corrected", "CRKSPH", "MFM", "MFM-adiabatic")


class Mode(NamedTuple):
    """A flow U v of wave number k = halves pi/L. Its rate of strain ((xx - yy)/2, xy) is n U k/2 times d."""
    name: str
    v: Flowing
    d: Flowing
    n: int = 1
    halves: int = 2
    phase: float = 0.0


def swirl(p: np.ndarray) -> np.ndarray:
    """Taylor-Green vortices, whose advection is balanced by a pressure."""
    return np.array([np.sin(p[0])*np.cos(p[1]), -np.cos(p[0])*np.sin(p[1])])


def stretch(p: np.ndarray) -> np.ndarray:
    return np.array([np.cos(p[0])*np.cos(p[1]), 0*p[0]])


def slide(p: np.ndarray) -> np.ndarray:
    return np.array([np.sin(p[1]), 0*p[0]])


def slope(p: np.ndarray) -> np.ndarray:
    return np.array([0*p[0], np.cos(p[1])])


STIRRED = Mode("stirred", swirl, stretch, n=2)
SHEARED = Mode("sheared", slide, slope)
PLATES = Mode("plates", slide, slope, halves=1, phase=np.pi/2)


@dataclass(frozen=True, kw_only=True)
class Driven(Spam):
    """Smooth particles with a force that holds the flow U v of a mode."""
    mode: Mode
    U: float

    @property
    def k(self) -> float:
        return self.mode.halves*np.pi/self.box[1]

    @property
    def friction(self) -> float:
        """Amplitude of the stress of friction in a flow of amplitude 1."""
        return self.mode.n*self.law.eta*self.k

    def v(self, state: np.ndarray) -> np.ndarray:
        return self.mode.v(self.k*state[:2] + self.mode.phase)

    def d(self, state: np.ndarray) -> np.ndarray:
        return self.mode.d(self.k*state[:2] + self.mode.phase)


class Push(Nested):
    """Sums with the force, at constant energies."""

    def rates(self, state: np.ndarray, out: np.ndarray) -> None:
        super().rates(state, out)
        method = self.method
        out[2:4] += method.friction*method.k*method.U*method.v(state)
        out[4] = 0.0


#: class of sums -> the same with the force
PUSHED = {kind: type(kind.__name__, (Push, kind), {name: getattr(kind, name) for name in (
    "allocate", "prepare", "exchange", "gradients", "symbol")}) for kind in (
        Nested, *(spam.TODAY[name].transport for name in MAKERS))}


def stresses(sums: Any) -> np.ndarray:
    """Components (xx - yy)/2 and xy (2, n) of the stress of the pressure sum, for each particle."""
    around, pairs, n = sums.around, sums.around.pairs, sums.n
    row, entry = entries(pairs, np.arange(n))
    near, wx, wy = pairs.near[entry], pairs.wx[entry], pairs.wy[entry]
    P = sums.less/around.rho**2
    fx, fy = (P[row] + P[near])*np.array([wx, wy])
    dx, dy = (q[row] - q[near] for q in (around.x, around.y))
    return np.array([np.bincount(row, q, n)/4 for q in (fx*dx - fy*dy, fx*dy + fy*dx)])
