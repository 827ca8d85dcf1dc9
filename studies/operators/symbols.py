"""RR98's operators on lattices: symbols, weights counted point by point, the fastest sound    [RR98 Eqs 1-4, 31, 34-38]"""
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from scipy.linalg import circulant

from particles.integral.edge_makers import renormalised
from particles.integral.interpolants import Exponential, W, f, reach
from particles.integral.points import lattice
from studies.kit.case import Case, Outcome, Report
from studies.operators.stability import sound
from studies.operators.weights import Around, around, smoothed, span, weight_of


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
        G, rows = slopes(w, at, 2*self.count), []
        for k in np.pi*np.arange(1, self.count + 1)/self.count:
            rows.append({"weight": self.kind.__name__, "d": self.d, "r0": self.r0, "k": k, "gradient": gradient_symbol(w, at, k),
                         "smoothed": smoothed(weight, self.d, k).value, "nested": twice_symbol(G, k),
                         "pairwise": spread_symbol(w, at, k)})
        return Outcome({"symbols": rows})


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
        plain, first = gradient_symbol(w, at, k), float(at.number@(w*at.r))/self.d
        return Outcome({"exponential": [{"d": self.d, "wavelength": self.wavelength, "r0": self.r0, "plain": abs(plain - 1),
                                         "renormalised": abs(plain/first - 1)}]})


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
        found = {0: float(at.number@f(weight, at.r)) + float(f(weight, 0.0)), 1: float(at.number@(W(weight, at.r)*at.r))}
        return Outcome({"counted": [{"weight": self.kind.__name__, "d": self.d, "r0": self.r0, "n": n, "value": value,
                                     "predicted": float(self.d if n else 1)} for n, value in found.items()]})


def longest_step(A: np.ndarray) -> float:
    """The dt at which RK4 begins to amplify dy/dt = A y, by halving an interval; 1e-9 a step is round-off of eigenvalues."""
    modes, low, high = np.linalg.eigvals(A), 0.0, 100.0
    for _ in range(50):
        middle = (low + high)/2
        z = middle*modes
        grows = np.abs(1 + z + z**2/2 + z**3/6 + z**4/24).max() > 1 + 1e-9
        low, high = (low, middle) if grows else (middle, high)
    return low


@dataclass(frozen=True, kw_only=True)
class Fastest(Case):
    """The fastest sound that gradients on a square lattice know, and the longest step that RK4 can take with it."""
    kind: Any
    h: float
    rows: int = 48

    def run(self, report: Report, folder: Path) -> Outcome:
        weight = self.kind.of(h=self.h)
        small, large = (renormalised(lattice((n, n)), weight) for n in (self.rows//3, self.rows))
        return Outcome({"fastest": list(speeds(self.kind.__name__, self.h, {self.rows//3: small, self.rows: large}))})


def speeds(name: str, h: float, sizes: dict[int, Any]) -> Iterator[dict[str, Any]]:
    """Rows of the table; the step from the matrix of sound on the smaller lattice, whose eigenvalues are quickly had."""
    least = min(sizes)
    for rows, edges in sizes.items():
        yield {"weight": name, "h": h, "rows": rows, "fastest": edges.fastest[0],
               "step": longest_step(sound(edges)) if rows == least else np.nan}
