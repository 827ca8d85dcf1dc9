"""RR98's weights as integrals: moments, symbols, order of the error    [RR98 Eqs 1-6]"""
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from math import pi
from pathlib import Path
from typing import Any

import numpy as np
from scipy.integrate import quad
from scipy.special import j0, j1, spherical_jn

from particles.integral.interpolants import Exponential, W, f, moment, reach, sphere, width
from particles.weights import Lucy, Monaghan, WendlandC2, WendlandC4, WendlandC6
from studies.kit.case import Case, Outcome, Report
from studies.kit.stats import Measured

WAVES = (0.3, 1.0, 2.0, 4.0)        # k r0 at which the interpolant is held against the smoothed field
MOMENTS = (1, 2, 3, 4)
SMALL = 0.1         # k r0 at which the order is taken
SHELLS = 20000      # of a sum over the radius that stands for an integral

#: means over directions e of cos(z e_x), 1 - cos(z e_x) and e_x sin(z e_x), by dimension
COSINE: dict[int, Callable] = {1: np.cos, 2: j0, 3: lambda z: np.sinc(z/pi)}
LESS: dict[int, Callable] = {1: lambda z: 2*np.sin(z/2)**2, 2: lambda z: 1 - j0(z),
                             3: lambda z: 1 - np.sinc(z/pi)}
PULL: dict[int, Callable] = {1: np.sin, 2: j1, 3: lambda z: spherical_jn(1, z)}


def weight_of(kind: Any, r0: float, d: int) -> Any:
    """The weight of width r0: compact ones of that range."""
    return kind.of(h=r0, d=d) if hasattr(kind, "of") else kind(r0, d)


def integral(weight: Any, d: int, g: Callable[[float], Any]) -> Measured:
    """int g(r) dV over the reach of a weight, with the quadrature's estimate of its error."""
    r0 = width(weight)
    end = reach(weight)/r0
    breaks = [0.5, 1.0] if end > 1 else [0.5]

    def shell(q: float) -> float:
        return float(g(q*r0))*(q*r0)**(d - 1)
    value, err = quad(shell, 0, end, limit=400, epsabs=1e-13, epsrel=1e-12, points=breaks)
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


def order(weight: Any, d: int) -> Measured:
    """d ln(1 - f^)/d ln k at small k; the error is what halving k changes."""
    k = SMALL/width(weight)
    first, second, third = (defect(weight, d, k/n) for n in (1, 2, 4))
    coarse, fine = np.log2(first/second), np.log2(second/third)
    return Measured(float(fine), float(abs(fine - coarse)))


def symbol_error(weight: Any, d: int) -> Measured:
    """Largest difference of the interpolant's symbol and k f^(k), over k."""
    errors = []
    for k in np.array(WAVES)/width(weight):
        symbol, transform = interpolated(weight, d, k), smoothed(weight, d, k)
        error = abs(symbol.value/k - transform.value)
        errors.append(Measured(float(error), float(symbol.err/k + transform.err)))
    return max(errors)


def quantities(weight: Any, d: int) -> Iterator[tuple[str, Measured, float]]:
    """(name, measured, predicted) of a weight with r0 = 1; M_n = (n + d - 1) <r^(n-1)>_f by parts."""
    yield "integral", integral(weight, d, lambda r: f(weight, r)), 1.0
    for n in MOMENTS:
        predicted = (n + d - 1)*power_of(f, weight, d, n - 1).value
        yield f"moment {n}", power_of(W, weight, d, n), predicted
    yield "symbol", symbol_error(weight, d), 0.0
    yield "order", order(weight, d), 2.0


@dataclass(frozen=True, kw_only=True)
class Continuum(Case):
    """A kind of weight in d dimensions, before anything is discretised."""
    kind: Any
    d: int

    def run(self, report: Report, folder: Path) -> Outcome:
        weight = weight_of(self.kind, 1.0, self.d)
        key = {"weight": self.kind.__name__, "d": self.d}
        rows = [key | {"quantity": name, "value": value, "value_err": err, "predicted": predicted}
                for name, (value, err), predicted in quantities(weight, self.d)]
        return Outcome({"continuum": rows})


@dataclass(frozen=True, kw_only=True)
class Arithmetic(Case):
    """Single numbers without parameters. numbers : makes them, by name."""
    numbers: Callable[[], dict[str, float]]

    def run(self, report: Report, folder: Path) -> Outcome:
        rows = [{"quantity": name, "value": value} for name, value in self.numbers().items()]
        return Outcome({"numbers": rows})


def of_weights() -> dict[str, float]:
    """What takes neither points nor a flow."""
    return {"first moment": first_moment_error(), "third derivatives": third_factor()}


def first_moment_error() -> float:
    """Largest |M_1/d - 1| of six weights in 1, 2 and 3 dimensions    [RR98 Eq. 2]"""
    errors = []
    for d in (1, 2, 3):
        compact = [kind.of(h=1.3, d=d) for kind in (Lucy, Monaghan, WendlandC2, WendlandC4, WendlandC6)]
        errors += [moment(weight, 1, d)/d - 1 for weight in (*compact, Exponential(0.3, d))]
    return max(map(abs, errors))


def third_factor() -> float:
    """Factor before the third derivatives in 3D: 1 - f^ at small k over 3 k^2 r0^2 M_3/15    [RR98 Eq. 5]"""
    weight, k = Lucy.of(h=1.0, d=3), 0.05
    r = (np.arange(SHELLS) + 0.5)/SHELLS
    wave = np.sin(k*r)/(k*r)
    transform = float(np.sum(4*pi*r**2*f(weight, r)*wave)/SHELLS)
    return (1 - transform)/(3*k**2*moment(weight, 3, 3)/15)
