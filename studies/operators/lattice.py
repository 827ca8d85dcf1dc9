"""RR98's weights as sums over lattices: moments, symbols, forces along edges    [RR98 Eqs 2-5, 28-32, 51]"""
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache
from math import isqrt
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from continuum.exact.waves import LinearGas, quantities
from particles.integral.interpolants import Exponential, W, f, moment, reach, sphere, width
from particles.weights import Lucy, WendlandC2
from studies.build.symbols import lattice_waves
from studies.kit.case import Case, Outcome, Report
from studies.operators.integrals import MOMENTS, integral, smoothed, weight_of

GAS = LinearGas(0.3, 0.2, 0.4)
LONG = 5000.0       # spacings of a wave that is endless to four digits
TAIL = 26.0         # r0 of the exponential weight beyond which 1e-9 of the first moment lies


class Around(NamedTuple):
    """Lattice points around one, alike ones together.

    x : >= 0 along an axis. r : distance. number : of points, with both signs of x.
    """
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
    signs = np.where(n > 0, 2, 1)
    number = (signs[:, None]*across[m])[there]
    return Around(x.astype(float), np.sqrt(squared[there]), number)


def around_weight(weight: Any, d: int) -> Around:
    """The points that a weight sees, but for 1e-9 of the first moment of the exponential one."""
    return around(span(weight), d)


def span(weight: Any) -> float:
    """How far sums go."""
    return TAIL*weight.r0 if isinstance(weight, Exponential) else reach(weight)


# --- moments ------------------------------------------------------------------------------------------------


def line_weight(weight: Any, d: int, r: np.ndarray) -> np.ndarray:
    """RR98's discrete weight with dV = 1: 4 pi r^2 W(r) in 3D    [RR98 Eq. 29]"""
    return sphere(d)*r**(d - 1)*W(weight, r)


def first_moment(w: np.ndarray, at: Around) -> float:
    """sum w r."""
    return float(at.number@(w*at.r))


def sums(weight: Any, d: int) -> Iterator[dict[str, Any]]:
    """Discrete moments: over the whole lattice (n = 1), and along one half line from a point (n = 0 to 4)."""
    r0, at = width(weight), around_weight(weight, d)
    yield {"how": "plain", "n": 1, "value": first_moment(W(weight, at.r), at), "predicted": d}
    factor = sphere(d)*moment(weight, d, d)*r0**(d - 1)
    yield {"how": "printed", "n": 1, "value": first_moment(line_weight(weight, d, at.r), at),
           "predicted": factor}
    r = np.arange(1, span(weight) + 1)
    r = r[r < reach(weight)]
    for n in (0, *MOMENTS):
        total = float(np.sum(line_weight(weight, d, r)*r**n))
        predicted = moment(weight, n, d) if n else np.nan
        yield {"how": "line", "n": n, "value": total/r0**(n - 1), "predicted": predicted}


@dataclass(frozen=True, kw_only=True)
class LatticeSums(Case):
    """Discrete moments of a weight with range or width r0 (in spacings)."""
    kind: Any
    d: int
    r0: float

    def run(self, report: Report, folder: Path) -> Outcome:
        weight = weight_of(self.kind, self.r0, self.d)
        key = {"weight": self.kind.__name__, "d": self.d, "r0": self.r0}
        return Outcome({"lattice": [key | row for row in sums(weight, self.d)]})


@dataclass(frozen=True, kw_only=True)
class Counted(Case):
    """Sum of f over the points of a lattice with `points` to r0: the integral of Eq. 4 without quadrature.

    Compact weights are made to have it by an integral over r; a second one would say nothing.
    """
    kind: Any
    d: int
    points: float

    def run(self, report: Report, folder: Path) -> Outcome:
        weight = weight_of(self.kind, self.points, self.d)
        at = around(reach(weight), self.d)
        total = float(at.number@f(weight, at.r)) + float(f(weight, 0.0))
        return Outcome({"continuum": [{"weight": self.kind.__name__, "d": self.d, "quantity": "counted",
                                       "value": total, "value_err": 0.0, "predicted": 1.0}]})


# --- symbols ------------------------------------------------------------------------------------------------


def gradient_symbol(w: np.ndarray, at: Around, k: float) -> float:
    """sum w e_x sin(kx)/k."""
    return float(at.number@(w*at.x/at.r*np.sin(k*at.x)))/k


def spread_symbol(w: np.ndarray, at: Around, k: float) -> float:
    """sum (2 w/r) (1 - cos kx)/k^2 of the pairwise Laplacian."""
    return float(at.number@(4*w/at.r*np.sin(k*at.x/2)**2))/k**2


@dataclass(frozen=True, kw_only=True)
class WeightSymbols(Case):
    """Gradient and Laplacians of waves along an axis of the square lattice; w has the right first moment."""
    kind: Any
    r0: float
    count: int = 24

    def run(self, report: Report, folder: Path) -> Outcome:
        weight = weight_of(self.kind, self.r0, 2)
        at = around_weight(weight, 2)
        w = W(weight, at.r)
        w *= 2/first_moment(w, at)
        key = {"weight": self.kind.__name__, "d": 2, "r0": self.r0}
        rows = []
        for k in np.pi*np.arange(1, self.count + 1)/self.count:
            gradient = gradient_symbol(w, at, k)
            rows.append(key | {"k": k, "smoothed": smoothed(weight, 2, k).value, "gradient": gradient,
                               "nested": gradient**2, "pairwise": spread_symbol(w, at, k)})
        return Outcome({"symbols": rows})


@dataclass(frozen=True, kw_only=True)
class ExponentialWave(Case):
    """Error of the gradient of a plane wave, exponential weight, square lattice    [RR98 Eq. 31]"""
    r0: float
    wavelength: float

    def run(self, report: Report, folder: Path) -> Outcome:
        weight = Exponential(self.r0, 2)
        at = around_weight(weight, 2)
        w = W(weight, at.r)
        symbol = gradient_symbol(w, at, 2*np.pi/self.wavelength)
        mended = symbol/(first_moment(w, at)/2)
        return Outcome({"exponential": [{"d": 2, "wavelength": self.wavelength, "r0": self.r0,
                                         "plain": abs(symbol - 1), "renormalised": abs(mended - 1)}]})


# --- forces along edges -------------------------------------------------------------------------------------


class Power(NamedTuple):
    """c q^p of q = r/h."""
    c: float
    p: int

    def __call__(self, q: Any) -> Any:
        return self.c*q**self.p


class EdgeForces(NamedTuple):
    """A(r) and B(r) of Eq. 51."""
    name: str
    A: Power
    B: Power


def viscosities(d: int, M_A: float, M_B: float) -> tuple[float, float]:
    """eta = M_A/2d(d+2) + M_B/2d, zeta = M_A/d(d+2) - (1 - 2/d) eta, with M_X = int W X r^2 dV."""
    eta = M_A/(2*d*(d + 2)) + M_B/(2*d)
    return eta, M_A/(d*(d + 2)) - (1 - 2/d)*eta


def wave_viscosities(d: int, A: np.ndarray, B: np.ndarray, at: Around) -> tuple[float, float]:
    """eta and zeta of long waves along an axis. A, B : times W r^2/2."""
    ex2 = (at.x/at.r)**2
    fourth = at.number@(A*ex2**2)
    mixed = at.number@(A*ex2*(1 - ex2))/(d - 1)
    plain = at.number@(B*ex2)
    eta = mixed + plain
    return eta, fourth + plain - 2*(1 - 1/d)*eta


@dataclass(frozen=True, kw_only=True)
class EdgeViscosities(Case):
    """Of forces A(r) e (e.v_ij) + B(r) v_ij [RR98 Eq. 51]: long waves on a lattice, and M_A and M_B."""
    d: int
    forces: EdgeForces
    h: float

    def run(self, report: Report, folder: Path) -> Outcome:
        d, h, (name, *laws) = self.d, self.h, self.forces
        weight, at = WendlandC2.of(h=h, d=d), around(h, d)
        half = W(weight, at.r)*at.r**2/2
        A, B = (half*X(at.r/h) for X in laws)
        eta, zeta = wave_viscosities(d, A, B, at)
        M_A, M_B = (self.second_moment(weight, X) for X in laws)
        eta_predicted, zeta_predicted = viscosities(d, M_A, M_B)
        return Outcome({"friction": [{"d": d, "form": name, "h": h, "eta": eta, "zeta": zeta,
                                      "eta_predicted": eta_predicted, "zeta_predicted": zeta_predicted}]})

    def second_moment(self, weight: Any, X: Power) -> float:
        """M_X = int W X r^2 dV."""
        return integral(weight, self.d, lambda r: W(weight, r)*X(r/self.h)*r**2).value


def of_edges() -> dict[str, float]:
    """Largest error of both viscosities of forces along edges: long waves along an axis, by the symbol."""
    k = 2*np.pi/LONG
    values = quantities(lattice_waves(GAS, Lucy.of(h=8.0), np.array([k, 0.0]), nested=False), k)
    shear, bulk = values["viscosity"]/GAS.eta - 1, values["bulk viscosity"]/GAS.zeta - 1
    return {"viscosities, h = 8 a": max(abs(shear), abs(bulk))}
