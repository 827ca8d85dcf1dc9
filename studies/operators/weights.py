"""RR98's weights as integrals and as sums over a lattice: moments, symbols, leading errors    [RR98 Eqs 1-6, 28-32]"""
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import cache
from itertools import pairwise
from math import gamma, isqrt, pi
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from scipy.integrate import quad
from scipy.special import gammaincc, j0, j1, spherical_jn

from particles.integral.interpolants import Exponential, W, f, moment, reach, sphere, width
from studies.kit.case import Case, Outcome, Report
from studies.kit.stats import Measured

WAVES = (0.3, 1.0, 2.0, 4.0)        # k r0 at which the interpolant is held against the smoothed field
MOMENTS = (1, 2, 3, 4)
TAIL = 26.0                         # r0 of the exponential weight beyond which 1e-9 of the first moment lies

#: means over directions e of cos(z e_x), 1 - cos(z e_x) and e_x sin(z e_x), by dimension
COSINE: dict[int, Callable] = {1: np.cos, 2: j0, 3: lambda z: np.sinc(z/pi)}
LESS: dict[int, Callable] = {1: lambda z: 2*np.sin(z/2)**2, 2: lambda z: 1 - j0(z), 3: lambda z: 1 - np.sinc(z/pi)}
PULL: dict[int, Callable] = {1: np.sin, 2: j1, 3: lambda z: spherical_jn(1, z)}


def weight_of(kind: Any, r0: float, d: int) -> Any:
    """The weight of width r0: compact ones of that range."""
    return kind.of(h=r0, d=d) if hasattr(kind, "of") else kind(r0, d)


def integral(weight: Any, d: int, g: Callable[[float], Any]) -> Measured:
    """int g(r) dV over the reach of a weight, with the quadrature's estimate of its error."""
    r0, end = width(weight), reach(weight)/width(weight)
    value, err = quad(lambda q: float(g(q*r0))*(q*r0)**(d - 1), 0, end, limit=400, epsabs=1e-13, epsrel=1e-12,
                      points=[0.5, 1.0] if end > 1 else [0.5])
    return Measured(sphere(d)*r0*value, sphere(d)*r0*err)


def power_of(g: Callable, weight: Any, d: int, n: int) -> Measured:
    """int g r^n dV of f or W."""
    return integral(weight, d, lambda r: g(weight, r)*r**n)


def smoothed(weight: Any, d: int, k: float) -> Measured:
    """f^(k), what is left of a wave that is smoothed with f."""
    return integral(weight, d, lambda r: f(weight, r)*COSINE[d](k*r))


def interpolated(weight: Any, d: int, k: float) -> Measured:
    """Amplitude of the interpolant of grad sin(kx)    [RR98 Eq. 1]"""
    return integral(weight, d, lambda r: W(weight, r)*PULL[d](k*r))


def defect(weight: Any, d: int, k: float) -> float:
    """1 - f^(k), without cancellation."""
    return integral(weight, d, lambda r: f(weight, r)*LESS[d](k*r)).value


def leading(weight: Any, d: int, k: float = 0.2) -> Measured:
    """Limit of (1 - f^)/(k r0)^2: three wave numbers, each half of the one before, extrapolated in k^2 twice."""
    r0 = width(weight)
    C = [defect(weight, d, k/r0/2**n)/(k/2**n)**2 for n in range(3)]
    once = [(4*fine - coarse)/3 for coarse, fine in pairwise(C)]
    twice = (16*once[1] - once[0])/15
    return Measured(twice, abs(twice - once[1]))


def order(weight: Any, d: int, k: float = 0.1) -> Measured:
    """d ln(1 - f^)/d ln k at small k; the error is what halving k changes."""
    E = [defect(weight, d, k/width(weight)/2**n) for n in range(3)]
    coarse, fine = np.log2(E[0]/E[1]), np.log2(E[1]/E[2])
    return Measured(float(fine), float(abs(fine - coarse)))


def slope_error(weight: Any) -> float:
    """Largest |W + f'|/|W|, f' by central differences."""
    r0 = width(weight)
    r, step = np.linspace(0.2, 0.9, 8)*r0, 1e-5*r0
    slope = (f(weight, r + step) - f(weight, r - step))/(2*step)
    return float(np.abs(1 + slope/W(weight, r)).max())


def symbol_error(weight: Any, d: int) -> Measured:
    """Largest difference of the interpolant's symbol and k f^(k), over k."""
    found = []
    for k in np.array(WAVES)/width(weight):
        one, other = interpolated(weight, d, k), smoothed(weight, d, k)
        found.append(Measured(float(abs(one.value/k - other.value)), float(one.err/k + other.err)))
    return max(found)


def quantities(weight: Any, d: int) -> Iterator[tuple[str, Measured, float]]:
    """(name, measured, predicted) of a weight with r0 = 1; M_n = (n + d - 1) <r^(n-1)>_f by parts."""
    yield "integral", integral(weight, d, lambda r: f(weight, r)), 1.0
    for n in MOMENTS:
        yield f"moment {n}", power_of(W, weight, d, n), (n + d - 1)*power_of(f, weight, d, n - 1).value
    yield "slope", Measured(slope_error(weight), 0.0), 0.0
    yield "symbol", symbol_error(weight, d), 0.0
    yield "leading", leading(weight, d), moment(weight, 3, d)/(2*d*(d + 2))
    yield "order", order(weight, d), 2.0


@dataclass(frozen=True, kw_only=True)
class Continuum(Case):
    """A kind of weight in d dimensions, before anything is discretised."""
    kind: Any
    d: int

    def run(self, report: Report, folder: Path) -> Outcome:
        weight = weight_of(self.kind, 1.0, self.d)
        return Outcome({"continuum": [{"weight": self.kind.__name__, "d": self.d, "quantity": name, "value": found.value,
                                       "value_err": found.err, "predicted": predicted}
                                      for name, found, predicted in quantities(weight, self.d)]})


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
    x, count = np.broadcast_to(n[:, None], there.shape)[there], (np.where(n > 0, 2, 1)[:, None]*across[m])[there]
    return Around(x.astype(float), np.sqrt(squared[there]), count)


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
    yield {"how": "plain", "n": 1, "value": float(at.number@(W(weight, at.r)*at.r)), "predicted": d*predicted_first(weight, d)}
    yield {"how": "printed", "n": 1, "value": float(at.number@(line_weight(weight, d, at.r)*at.r)),
           "predicted": sphere(d)*moment(weight, d, d)*r0**(d - 1)}
    r = np.arange(1, span(weight) + 1)
    r = r[r < reach(weight)]
    for n in (0, *MOMENTS):
        yield {"how": "line", "n": n, "value": float(np.sum(line_weight(weight, d, r)*r**n))/r0**(n - 1),
               "predicted": moment(weight, n, d) if n else np.nan}


@dataclass(frozen=True, kw_only=True)
class LatticeSums(Case):
    """Discrete moments of a weight with range or width r0 (in spacings)."""
    kind: Any
    d: int
    r0: float

    def run(self, report: Report, folder: Path) -> Outcome:
        key = {"weight": self.kind.__name__, "d": self.d, "r0": self.r0}
        return Outcome({"lattice": [key | row for row in sums(weight_of(self.kind, self.r0, self.d), self.d)]})
