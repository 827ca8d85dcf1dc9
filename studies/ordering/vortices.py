"""A decaying Taylor-Green vortex on fixed points, as a case, against the same gas solved by Fourier sums    [RR98 Eqs 34-38]

One wavelength to the periodic box, Mach number small, Re = U lambda/nu. The exact answer of an incompressible fluid is known;
what the Mach number adds to it is measured (`Compression`), and errors are told against the gas of the same Mach number.
"""
from collections.abc import Callable
from dataclasses import dataclass
from functools import cache
from itertools import combinations
from math import ceil
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from continuum.fluid import ConstEta, IdealGas
from particles.integral.edges import NONE_BEYOND, Edges
from particles.integral.layer import Layer
from particles.integral.points import Points, lattice
from particles.integrators import RK4
from particles.limits import limit_of
from particles.run import Divergence, Plan, run
from studies.kit.case import Case, Outcome, Report
from studies.build.disorder import Disorder

RE = 100.0          # several turns of the vortices while they decay: pressure and convection matter, not friction alone
SOUND = np.sqrt(2)  # of the gas with C_V = 1 at T = 1, in 2D
DECAYS = 1.0        # 2 nu k^2 t at the end: velocities are a factor e smaller
OF_LIMIT = 0.5      # of the step to its limit: half of it changes the errors by 2e-4 of themselves
#: points of the Fourier sums along each axis: odd, or the shortest wave goes unseen; with 25 products of short waves feed on the
#: flow faster than friction takes from them
ODD, COARSER = 33, 29
FOUND = ("velocity", "decay", "incompressible", "exchanges")


class Vortex(NamedTuple):
    """A Taylor-Green vortex of a Mach number in a box of `wavelength` spacings."""
    mach: float
    wavelength: int

    @property
    def speed(self) -> float:
        return self.mach*SOUND

    @property
    def k(self) -> float:
        return 2*np.pi/self.wavelength

    @property
    def eta(self) -> float:
        return self.speed*self.wavelength/RE

    @property
    def time(self) -> float:
        return DECAYS/(2*self.eta*self.k**2)

    def velocity(self, x: np.ndarray) -> np.ndarray:
        """(n, 2) at places (n, 2) at the start."""
        a, b = self.k*x.T
        return self.speed*np.stack([np.sin(a)*np.cos(b), -np.cos(a)*np.sin(b)], axis=1)

    def method(self, points: Points, edges: Edges) -> Layer:
        """The fluid on points; kappa = eta."""
        return Layer(x=points.x, edges=edges, beyond=NONE_BEYOND, eos=IdealGas(), law=ConstEta(self.eta, self.eta),
                     T_plates=(1.0, 1.0), g=0.0)

    def start(self, method: Layer) -> np.ndarray:
        """The pressure of the incompressible vortex, at constant entropy: P = rho T = rho^2."""
        rho = np.sqrt(1 + self.speed**2/4*np.cos(2*self.k*method.x).sum(axis=1))
        return method.state(rho, self.velocity(method.x), rho)


class End(NamedTuple):
    """Velocities (n, 2) over the initial speed, ln(K at the start/K) over what friction alone makes it, share of time reached."""
    v: np.ndarray
    decay: float
    reached: float
    steps: int


def decayed(vortex: Vortex, points: Points, edges: Edges, report: Report | None = None) -> End:
    """The vortex after `vortex.time`; where it diverges there are no velocities."""
    method = vortex.method(points, edges)
    first = vortex.start(method)
    steps = ceil(vortex.time/(OF_LIMIT*limit_of(method, first)))
    try:
        last = run(method, first, Plan(dt=vortex.time/steps, steps=steps), report).state
    except Divergence as end:
        return End(np.full((points.n, 2), np.nan), np.nan, end.step/steps, steps)
    before, after = (float(edges.V@((state[1]**2 + state[2]**2)/state[0])) for state in (first, last))
    return End((last[1:3]/last[0]).T/vortex.speed, float(np.log(before/after))/(2*DECAYS), 1.0, steps)


# --- what is exact ----------------------------------------------------------------------------------------------------


def fourier(n: int) -> tuple[Points, Edges]:
    """n x n points, n odd, and edges from each to all in its row and column, whose sums are derivatives of Fourier series."""
    points, pairs = lattice((n, n)), np.array(list(combinations(range(n), 2))).T
    far = pairs[0] - pairs[1]
    slope = np.pi/n*(-1.0)**far/np.sin(np.pi*far/n)
    curve = -2*(np.pi/n)**2*(-1.0)**far*np.cos(np.pi*far/n)/np.sin(np.pi*far/n)**2
    number, zero = np.arange(n*n).reshape(n, n), np.zeros(n*len(far))
    i, j = (np.concatenate([number[end].T.ravel(), number[:, end].ravel()]) for end in pairs)
    along = 2*np.tile(slope, n)
    S = np.concatenate([np.stack([along, zero], axis=1), np.stack([zero, along], axis=1)])
    return points, Edges(i=i, j=j, S=S, k=np.tile(curve, 2*n), apart=points.separation(i, j), V=points.V)


class Solved(NamedTuple):
    """Fourier amplitudes (n, n, 2) of the velocity at the end over the initial speed, and the decay of K."""
    amplitudes: np.ndarray
    decay: float


@cache
def solved(mach: float, n: int = ODD) -> Solved:
    """The gas of a Mach number, by Fourier sums on n x n points."""
    points, edges = fourier(n)
    end = decayed(Vortex(mach, n), points, edges)
    waves = _waves(points.x[:n, 1]/n, n).conj()/n
    return Solved(np.einsum("xk,yl,xya->kla", waves, waves, end.v.reshape(n, n, 2)), end.decay)


def _waves(place: np.ndarray, n: int) -> np.ndarray:
    """exp(2 pi i m x) at places (p,) in wavelengths, (p, n)."""
    return np.exp(2j*np.pi*np.outer(place, np.arange(n) - n//2))


def velocities(found: Solved, place: np.ndarray) -> np.ndarray:
    """(p, 2) at places (p, 2) in wavelengths."""
    n = len(found.amplitudes)
    x, y = (_waves(q, n) for q in place.T)
    return np.einsum("pk,pl,kla->pa", x, y, found.amplitudes, optimize=True).real


def incompressible(place: np.ndarray) -> np.ndarray:
    """The exact velocities (p, 2) at the end over the initial speed, at places (p, 2) in wavelengths."""
    return Vortex(1/SOUND, 1).velocity(place)*np.exp(-DECAYS)


def off(V: np.ndarray, v: np.ndarray, known: np.ndarray) -> float:
    """Relative rms difference of velocities (n, 2)."""
    return float(np.sqrt(V@((v - known)**2).sum(axis=1)/(V@(known**2).sum(axis=1))))


# --- cases ------------------------------------------------------------------------------------------------------------


@dataclass(frozen=True, kw_only=True)
class TaylorGreen(Case):
    """One vortex on one set of points; runs that diverge, and points without such edges, leave a row without errors.

    make : of `particles.integral.edge_makers.MAKERS`. weight : class, its range h in spacings; None where the maker takes none. wavelength in
    spacings.
    """
    maker: str
    make: Callable[[Points, Any], Edges]
    weight: Any = None
    h: float = 0.0
    disorder: Disorder
    wavelength: int
    mach: float = 0.05
    seed: int = 1

    @property
    def cost(self) -> float:
        size = self.wavelength/32
        once = 1.0*(self.maker == "exact") + 6.0*(self.disorder.name == "relaxed")
        return size**3*(0.06*self.h + 0.15)*0.05/self.mach + size**4*once + 0.1

    @property
    def label(self) -> str:
        return (f"taylor-green {self.maker} {self._weight} h {self.h:g}, {self.disorder.name}, wavelength {self.wavelength}, "
                f"Mach {self.mach:g}, seed {self.seed}")

    @property
    def _weight(self) -> str:
        return self.weight.__name__ if self.weight else "none"

    def run(self, report: Report, folder: Path) -> Outcome:
        points = self.disorder.make((self.wavelength, self.wavelength), self.disorder.size, self.seed)
        key = {"maker": self.maker, "weight": self._weight, "h": self.h, "points": self.disorder.name,
               "wavelength": self.wavelength, "mach": self.mach, "seed": self.seed}
        try:
            edges = self.make(points, self.weight.of(h=self.h) if self.weight else None)
        except ArithmeticError:     # no such edges exist on these points: that is a result
            return Outcome({"vortices": [{**key, **dict.fromkeys(FOUND, np.nan), "reached": 0.0}]})
        end = decayed(Vortex(self.mach, self.wavelength), points, edges, report)
        gas, place = solved(self.mach), points.x/self.wavelength
        found = (off(edges.V, end.v, velocities(gas, place)), end.decay/gas.decay - 1, off(edges.V, end.v, incompressible(place)),
                 RK4.evaluations*end.steps*len(edges.i) if end.reached == 1 else np.nan)
        return Outcome({"vortices": [{**key, **dict(zip(FOUND, found, strict=True)), "reached": end.reached}]})


@dataclass(frozen=True, kw_only=True)
class Compression(Case):
    """What the Mach number alone does to the vortex: the Fourier sums against the incompressible answer."""
    mach: float

    @property
    def cost(self) -> float:
        return 0.05/self.mach

    @property
    def label(self) -> str:
        return f"taylor-green, Fourier sums, Mach {self.mach:g}"

    def run(self, report: Report, folder: Path) -> Outcome:
        place = lattice((ODD, ODD)).x/ODD
        fine, coarse = solved(self.mach), solved(self.mach, COARSER)
        exactly, found = incompressible(place), velocities(fine, place)
        err = off(np.ones(len(place)), velocities(coarse, place), found)
        return Outcome({"compression": [{
            "mach": self.mach, "velocity": off(np.ones(len(place)), found, exactly), "velocity_err": err,
            "decay": fine.decay - 1, "decay_err": abs(fine.decay - coarse.decay)}]})
