"""RR98's weights on lattices: discrete moments, symbols, weights counted point by point    [RR98 Eqs 1-5, 28-32, 34-38, 51]"""
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache
from math import gamma, isqrt, pi
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from scipy.linalg import circulant
from scipy.special import gammaincc

from continuum.exact.waves import LinearGas, quantities
from particles.integral.interpolants import Exponential, W, f, moment, reach, sphere, width
from particles.weights import Lucy, Monaghan, WendlandC2, WendlandC4, WendlandC6
from studies.build.symbols import lattice_waves
from studies.kit.case import Case, Outcome, Report
from studies.operators.weights import MOMENTS, smoothed, weight_of

TAIL = 26.0         # r0 of the exponential weight beyond which 1e-9 of the first moment lies
GAS = LinearGas(0.3, 0.2, 0.4)
LONG = 5000.0       # spacings of a wave that is endless to four digits


class Around(NamedTuple):
    """Lattice points around one, alike ones together: x >= 0 along an axis, distance r, how many (of both signs of x)."""
    x: np.ndarray
    r: np.ndarray
    number: np.ndarray


@cache
def shells(d: int, most: int) -> np.ndarray:
    """Number of points of Z^d at squared distances 0 to `most`."""
    count = np.zeros(most + 1)
    count[0] = 1
    for _ in range(d):
        wider = count.copy()
        for n in range(1, isqrt(most) + 1):
            wider[n*n:] += 2*count[:most + 1 - n*n]
        count = wider
    return count


def around(distance: float, d: int) -> Around:
    """The lattice points nearer than a distance, the middle left out."""
    n, most = np.arange(int(distance) + 1), int(distance**2)
    across = shells(d - 1, most)
    m = np.flatnonzero(across)
    squared = n[:, None]**2 + m
    there = (squared > 0) & (squared <= most)
    x = np.broadcast_to(n[:, None], there.shape)[there]
    number = (np.where(n > 0, 2, 1)[:, None]*across[m])[there]
    return Around(x.astype(float), np.sqrt(squared[there]), number)


def span(weight: Any) -> float:
    """How far sums go; those of the exponential weight end where 1e-9 of the first moment is left."""
    return TAIL*weight.r0 if isinstance(weight, Exponential) else reach(weight)


def line_weight(weight: Any, d: int, r: np.ndarray) -> np.ndarray:
    """RR98's discrete weight with dV = 1: 4 pi r^2 W(r) in 3D    [RR98 Eq. 29]"""
    return sphere(d)*r**(d - 1)*W(weight, r)


def epstein(s: float, d: int) -> float:
    """sum over Z^d without 0 of |n|^-s, continued to s < d (by theta functions)."""
    count = shells(d, 20)
    m = np.flatnonzero(count)[1:]
    terms = sum(gammaincc(p, pi*m)*gamma(p)*(pi*m)**-p for p in (s/2, (d - s)/2))
    return pi**(s/2)/gamma(s/2)*(float(count[m]@terms) - 2/s - 2/(d - s))


def predicted_first(weight: Any, d: int) -> float:
    """First moment over d of plain sums: of the exponential weight 1 - q^2/12, 1 + Z(1) q/4 pi, 1 + Z(2) q/6 pi, q = 1/r0.

    The leading singularity of r W at r = 0 is summed by Epstein's zeta function Z; compact weights have none.
    """
    if not isinstance(weight, Exponential):
        return 1.0
    q = 1/weight.r0
    return 1 - q*q/12 if d == 1 else 1 + epstein(d - 1, d)*q/(2*d*pi)


def sums(weight: Any, d: int) -> Iterator[dict[str, Any]]:
    """Discrete moments: over the whole lattice (n = 1), and along one half line from a point (n = 0 to 4)."""
    r0, at = width(weight), around(span(weight), d)
    plain = float(at.number@(W(weight, at.r)*at.r))
    printed = float(at.number@(line_weight(weight, d, at.r)*at.r))
    yield {"how": "plain", "n": 1, "value": plain, "predicted": d*predicted_first(weight, d)}
    yield {"how": "printed", "n": 1, "value": printed,
           "predicted": sphere(d)*moment(weight, d, d)*r0**(d - 1)}
    r = np.arange(1, span(weight) + 1)
    r = r[r < reach(weight)]
    for n in (0, *MOMENTS):
        value = float(np.sum(line_weight(weight, d, r)*r**n))/r0**(n - 1)
        yield {"how": "line", "n": n, "value": value, "predicted": moment(weight, n, d) if n else np.nan}


@dataclass(frozen=True, kw_only=True)
class LatticeSums(Case):
    """Discrete moments of a weight with range or width r0 (in spacings)."""
    kind: Any
    d: int
    r0: float

    def run(self, report: Report, folder: Path) -> Outcome:
        key = {"weight": self.kind.__name__, "d": self.d, "r0": self.r0}
        weight = weight_of(self.kind, self.r0, self.d)
        return Outcome({"lattice": [key | row for row in sums(weight, self.d)]})


def gradient_symbol(w: np.ndarray, at: Around, k: float) -> float:
    """sum w e_x sin(kx)/k."""
    return float(at.number@(w*at.x/at.r*np.sin(k*at.x)))/k


def spread_symbol(w: np.ndarray, at: Around, k: float) -> float:
    """sum (2 w/r) (1 - cos kx)/k^2 of the pairwise Laplacian."""
    return float(at.number@(4*w/at.r*np.sin(k*at.x/2)**2))/k**2


def slopes(w: np.ndarray, at: Around, n: int) -> np.ndarray:
    """The gradient along an axis of fields that vary along it alone, as a matrix (n, n) on a ring of n spacings."""
    ring, half, x = np.zeros(n), at.number*w*at.x/at.r/2, at.x.astype(int)
    np.add.at(ring, x % n, half)
    np.add.at(ring, -x % n, -half)
    return circulant(ring).T


def twice_symbol(G: np.ndarray, k: float) -> float:
    """-grad grad A over k^2 of a wave A, the gradient taken of the gradient."""
    A = np.cos(k*np.arange(len(G)))
    return float(-(A@(G@(G@A)))/(A@A))/k**2


@dataclass(frozen=True, kw_only=True)
class Symbols(Case):
    """Symbols of gradient and Laplacians on the lattice, plain sums scaled to the right first moment, along an axis."""
    kind: Any
    d: int
    r0: float
    count: int = 24

    def run(self, report: Report, folder: Path) -> Outcome:
        weight = weight_of(self.kind, self.r0, self.d)
        at = around(span(weight), self.d)
        w = W(weight, at.r)
        w *= self.d/float(at.number@(w*at.r))
        G = slopes(w, at, 2*self.count)
        key = {"weight": self.kind.__name__, "d": self.d, "r0": self.r0}
        waves = np.pi*np.arange(1, self.count + 1)/self.count
        return Outcome({"symbols": [
            {**key, "k": k, "smoothed": smoothed(weight, self.d, k).value,
             "gradient": gradient_symbol(w, at, k),
             "nested": twice_symbol(G, k), "pairwise": spread_symbol(w, at, k)} for k in waves]})


@dataclass(frozen=True, kw_only=True)
class ExponentialWave(Case):
    """Error of the gradient of a plane wave with the exponential weight    [RR98 Eq. 31]"""
    d: int
    r0: float
    wavelength: float

    def run(self, report: Report, folder: Path) -> Outcome:
        weight, k = Exponential(self.r0, self.d), 2*np.pi/self.wavelength
        at = around(span(weight), self.d)
        w = W(weight, at.r)
        symbol = gradient_symbol(w, at, k)
        first = float(at.number@(w*at.r))/self.d
        key = {"d": self.d, "wavelength": self.wavelength, "r0": self.r0}
        return Outcome({"exponential": [key | {"plain": abs(symbol - 1),
                                               "renormalised": abs(symbol/first - 1)}]})


@dataclass(frozen=True, kw_only=True)
class Counted(Case):
    """Sum of f and of W r over the points of a fine lattice: the two integrals of Eqs 4 and 2 without any quadrature.

    Compact weights are made to have the first one, by an integral over r: a check that takes it again would say nothing.
    """
    kind: Any
    d: int
    r0: float

    def run(self, report: Report, folder: Path) -> Outcome:
        weight = weight_of(self.kind, self.r0, self.d)
        at = around(reach(weight), self.d)
        integral = float(at.number@f(weight, at.r)) + float(f(weight, 0.0))
        first = float(at.number@(W(weight, at.r)*at.r))
        key = {"weight": self.kind.__name__, "d": self.d, "r0": self.r0}
        return Outcome({"counted": [key | {"n": 0, "value": integral, "predicted": 1.0},
                                    key | {"n": 1, "value": first, "predicted": float(self.d)}]})


# --- single numbers -----------------------------------------------------------------------------------------


@dataclass(frozen=True, kw_only=True)
class Arithmetic(Case):
    """Numbers of weights that need no points and no flow."""

    def run(self, report: Report, folder: Path) -> Outcome:
        numbers = {"first moment": first_moment_error(), "third derivatives": third_factor(),
                   "viscosities, h = 8 a": anisotropy(8.0)}
        return Outcome({"numbers": [{"quantity": name, "value": value} for name, value in numbers.items()]})


def first_moment_error() -> float:
    """Largest |M_1/d - 1| of six weights in 1, 2 and 3 dimensions    [RR98 Eq. 2]"""
    kinds = (Lucy, Monaghan, WendlandC2, WendlandC4, WendlandC6)
    compact = [(kind.of(h=1.3, d=d), d) for kind in kinds for d in (1, 2, 3)]
    exponential = [(Exponential(0.3, d), d) for d in (1, 2, 3)]
    return max(abs(moment(weight, 1, d)/d - 1) for weight, d in (*compact, *exponential))


def third_factor() -> float:
    """Factor before the third derivatives in 3D: 1 - f^(k) at small k over 3 k^2 r0^2 M_3/15    [RR98 Eq. 5]"""
    weight, k = Lucy.of(h=1.0, d=3), 0.05
    r = (np.arange(20000) + 0.5)/20000
    transform = float(np.sum(4*pi*r**2*f(weight, r)*np.sin(k*r)/(k*r))/20000)
    return (1 - transform)/(3*k**2*moment(weight, 3, 3)/15)


def anisotropy(h: float) -> float:
    """Largest relative error of the two viscosities of forces along edges, long waves along an axis, by the symbol."""
    k = 2*pi/LONG
    measured = quantities(lattice_waves(GAS, Lucy.of(h=h), np.array([k, 0.0]), nested=False), k)
    return max(abs(measured["viscosity"]/GAS.eta - 1), abs(measured["bulk viscosity"]/GAS.zeta - 1))
