"""RR98's weights as integrals and as sums over lattices: moments, errors    [Eqs 1-6, 28-32]"""
from collections.abc import Callable, Iterator
from functools import cache
from math import isqrt
from typing import Any, NamedTuple

import numpy as np
from scipy.integrate import quad
from scipy.special import j0, j1, spherical_jn

from particles.integral.interpolants import Exponential, Gaussian, W, f, moment, reach, sphere, width
from particles.weights import Lucy, Monaghan, WendlandC2, WendlandC4, WendlandC6
from studies.kit.case import Case, Report
from studies.kit.stats import Measured
from studies.kit.table import Row

WAVES = (0.3, 1.0, 2.0, 4.0)        # k r0 at which the interpolant is compared with the smoothed field
MOMENTS = (1, 2, 3, 4)
SMALL = 0.1         # k r0 at which the order in k is measured
TAIL = 26.0         # in r0: 1e-9 of the first moment of the exponential weight lies beyond

#: means over directions e of cos(z e_x) and of e_x sin(z e_x), by dimension
COSINE: dict[int, Callable] = {1: np.cos, 2: j0, 3: lambda z: np.sinc(z/np.pi)}
PULL: dict[int, Callable] = {1: np.sin, 2: j1, 3: lambda z: spherical_jn(1, z)}


def weight_of(kind: Any, r0: float, d: int) -> Any:
    """The weight of width r0, which is the range of compact weights."""
    return kind.of(h=r0, d=d) if hasattr(kind, "of") else kind(r0, d)


def integral(weight: Any, d: int, g: Callable[[float], Any]) -> Measured:
    """int g(r) dV over the reach of a weight, with the quadrature's estimate of its error."""
    r0 = width(weight)
    end = reach(weight)/r0
    breaks = [0.5, 1.0] if end > 1 else [0.5]
    value, err = quad(lambda q: float(g(q*r0))*(q*r0)**(d - 1), 0, end, limit=400, epsabs=1e-13,
                      epsrel=1e-12, points=breaks)
    return Measured(sphere(d)*r0*value, sphere(d)*r0*err)


def power_of(g: Callable, weight: Any, d: int, n: int) -> Measured:
    """int g r^n dV of f or W."""
    return integral(weight, d, lambda r: g(weight, r)*r**n)


def smoothed(weight: Any, d: int, k: float) -> Measured:
    """f^(k): amplitude that remains of a wave smoothed with f."""
    return integral(weight, d, lambda r: f(weight, r)*COSINE[d](k*r))


def interpolated(weight: Any, d: int, k: float) -> Measured:
    """Amplitude of the interpolant of grad sin(kx)    [RR98 Eq. 1]"""
    return integral(weight, d, lambda r: W(weight, r)*PULL[d](k*r))


def defect(weight: Any, d: int, k: float) -> float:
    """1 - f^(k)."""
    return integral(weight, d, lambda r: f(weight, r)*(1 - COSINE[d](k*r))).value


def order(weight: Any, d: int) -> Measured:
    """d ln(1 - f^)/d ln k at small k; the error is the change when k is halved."""
    k = SMALL/width(weight)
    coarse, fine = (np.log2(defect(weight, d, q)/defect(weight, d, q/2)) for q in (k, k/2))
    return Measured(float(fine), float(abs(fine - coarse)))


def symbol_error(weight: Any, d: int) -> Measured:
    """Largest difference of the interpolant's symbol and k f^(k), over k."""
    errors = []
    for k in np.array(WAVES)/width(weight):
        symbol, transform = interpolated(weight, d, k), smoothed(weight, d, k)
        errors.append(Measured(abs(symbol.value/k - transform.value), symbol.err/k + transform.err))
    return max(errors)


#: listed by name, so that a new weight does not make finished cases run again
COMPACT = (Lucy, Monaghan, WendlandC2, WendlandC4, WendlandC6)


def of_weights() -> dict[str, float]:
    """Largest |M_1/d - 1| of six weights [RR98 Eq. 2]; the factor before the third derivatives [Eq. 5].

    The factor is 1 - f^ at small k over 3 k^2 r0^2 M_3/15, in 3D.
    """
    errors = []
    for d in (1, 2, 3):
        weights = [*(kind.of(h=1.3, d=d) for kind in COMPACT), Exponential(0.3, d)]
        errors += [abs(moment(weight, 1, d)/d - 1) for weight in weights]
    lucy, k = Lucy.of(h=1.0, d=3), 0.05
    third = defect(lucy, 3, k)/(3*k**2*moment(lucy, 3, 3)/15)
    return {"first moment": max(errors), "third derivatives": third}


class Around(NamedTuple):
    """Lattice points around one: |x| along an axis, distance r, number of points that share both."""
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
    """The lattice points within a distance, without the central one."""
    n, most = np.arange(int(distance) + 1), int(distance**2)
    across = shells(d - 1, most)
    squared = n[:, None]**2 + np.flatnonzero(across)
    rows, columns = np.nonzero((squared > 0) & (squared <= most))
    signs = np.where(rows > 0, 2, 1)
    number = signs*across[across > 0][columns]
    return Around(rows.astype(float), np.sqrt(squared[rows, columns]), number)


def span(weight: Any) -> float:
    """Radius of lattice sums: the reach of a weight, but TAIL for the exponential one."""
    return TAIL*weight.r0 if isinstance(weight, Exponential) else reach(weight)


def counted(kind: Any, d: int) -> float:
    """The integral of f without quadrature: its sum over a lattice of spacing r0/200, Gaussian r0/20.

    Compact weights are normalised by an integral over r; a second such integral would test nothing.
    """
    weight = weight_of(kind, 20.0 if kind is Gaussian else 200.0, d)
    at = around(reach(weight), d)
    return float(at.number@f(weight, at.r) + f(weight, 0.0))


def quantities(kind: Any, d: int) -> Iterator[tuple[str, Measured, float]]:
    """(name, measured, predicted) of a weight with r0 = 1; M_n = (n + d - 1) <r^(n-1)>_f by parts."""
    weight = weight_of(kind, 1.0, d)
    yield "integral", power_of(f, weight, d, 0), 1.0
    for n in MOMENTS:
        predicted = (n + d - 1)*power_of(f, weight, d, n - 1).value
        yield f"moment {n}", power_of(W, weight, d, n), predicted
    yield "symbol", symbol_error(weight, d), 0.0
    yield "order", order(weight, d), 2.0
    if kind is not Exponential:         # which has a singularity that no lattice resolves
        yield "counted", Measured(counted(kind, d)), 1.0


class Continuum(Case, table="continuum", same="weight d"):
    """Integrals of a kind of weight in d dimensions, before discretisation."""
    weight: Any
    d: int

    def measure(self, report: Report) -> Iterator[Row]:
        for name, (value, err), predicted in quantities(self.weight, self.d):
            yield {"quantity": name, "value": value, "value_err": err, "predicted": predicted}


def line_weight(weight: Any, d: int, r: np.ndarray) -> np.ndarray:
    """RR98's discrete weight with dV = 1: 4 pi r^2 W(r) in 3D    [RR98 Eq. 29]"""
    return sphere(d)*r**(d - 1)*W(weight, r)


def gradient_symbol(w: np.ndarray, at: Around, k: float) -> float:
    """sum w e_x sin(kx)/k."""
    return float(at.number@(w*at.x/at.r*np.sin(k*at.x)))/k


class LatticeSums(Case, table="lattice", same="weight d r0"):
    """Discrete moments of a weight with range or width r0 (in spacings).

    Over the whole lattice (n = 1), and along one half line from a point (n = 0 to 4).
    """
    weight: Any
    d: int
    r0: float

    def measure(self, report: Report) -> Iterator[Row]:
        weight, d, r0 = weight_of(self.weight, self.r0, self.d), self.d, self.r0
        at = around(span(weight), d)
        plain, printed = (at.number@(w*at.r) for w in (W(weight, at.r), line_weight(weight, d, at.r)))
        yield {"how": "plain", "n": 1, "value": plain, "predicted": d}
        yield {"how": "printed", "n": 1, "value": printed,
               "predicted": sphere(d)*moment(weight, d, d)*r0**(d - 1)}
        r = np.arange(1, span(weight) + 1)
        r = r[r < reach(weight)]
        for n in (0, *MOMENTS):
            total = np.sum(line_weight(weight, d, r)*r**n)
            predicted = moment(weight, n, d) if n else np.nan
            yield {"how": "line", "n": n, "value": total/r0**(n - 1), "predicted": predicted}


class ExponentialWave(Case, table="exponential", same="wavelength r0"):
    """Error of the gradient of a plane wave, exponential weight, square lattice    [RR98 Eq. 31]"""
    r0: float
    wavelength: float

    def measure(self, report: Report) -> Iterator[Row]:
        weight = Exponential(self.r0, 2)
        at = around(span(weight), 2)
        w = W(weight, at.r)
        yield {"d": 2, "plain": abs(gradient_symbol(w, at, 2*np.pi/self.wavelength) - 1)}
