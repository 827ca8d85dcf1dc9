"""Smooth particles that a force drives, with sums as printed, with corrected pressures, or as of today."""
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np

from particles.pairs import entries
from particles.smooth.spam import Spam
from particles.smooth.sums import Direct, Nested
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

    def tensor(self) -> np.ndarray:
        """Components xx, xy, yy (3, points) of the tensor in place of P/rho^2 in the pressure sum."""
        P = self.less/self.around.rho**2
        return np.array([P, 0*P, P])


class PushAlong(Push, Direct):
    """As `Push`, with friction along pairs."""
    symbol = Direct.symbol
    allocate, prepare, exchange = Direct.allocate, Direct.prepare, Direct.exchange


class Corrected(Push):
    """P_i M_i^-1 in place of P_i: the pressure sum of a lattice has no deviator, sheared or not."""

    def tensor(self) -> np.ndarray:
        xx, xy, yy = moments(self)
        return self.less/self.around.rho**2/(xx*yy - xy**2)*np.array([yy, -xy, xx])

    def exchange(self, less: np.ndarray) -> tuple[Any, np.ndarray]:
        term, flux = super().exchange(less)
        change = self.tensor() - super().tensor()
        for name, part in zip(("xx", "xy", "yx", "yy"), change[[0, 1, 1, 2]]):
            flux[name] += part
        return term, flux


#: class of sums -> the same with the force
PUSHED = {Nested: Push, Direct: PushAlong} | {
    kind: type(kind.__name__, (Push, kind), {name: getattr(kind, name) for name in (
        "allocate", "prepare", "exchange", "gradients", "symbol")})
    for kind in (spam.TODAY[name].transport for name in MAKERS) if kind is not Direct}


def moments(sums: Nested) -> np.ndarray:
    """Components xx, xy, yy (3, points) of M_i."""
    around, pairs = sums.around, sums.around.pairs
    row, entry = entries(pairs, np.arange(sums.n))
    near = pairs.near[entry]
    dx, dy = ((q[near] - q[row])/around.rho[near] for q in (around.x, around.y))
    M = np.ones((3, len(around.x)))
    for part, product in zip(M, (dx*pairs.wx[entry], dx*pairs.wy[entry], dy*pairs.wy[entry])):
        part[:sums.n] = np.bincount(row, product, sums.n)
    for _, parent, first, last in around.blocks:
        M[:, first:last] = M[:, parent]
    return M


def stresses(sums: Any) -> np.ndarray:
    """Components (xx - yy)/2 and xy (2, n) of the stress of the pressure sum, for each particle."""
    around, pairs, n = sums.around, sums.around.pairs, sums.n
    row, entry = entries(pairs, np.arange(n))
    near, wx, wy = pairs.near[entry], pairs.wx[entry], pairs.wy[entry]
    P = sums.tensor()
    xx, xy, yy = P[:, row] + P[:, near]
    fx, fy = xx*wx + xy*wy, xy*wx + yy*wy
    dx, dy = (q[row] - q[near] for q in (around.x, around.y))
    return np.array([np.bincount(row, q, n)/4 for q in (fx*dx - fy*dy, fx*dy + fy*dx)])
