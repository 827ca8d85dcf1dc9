"""Errors of gradients of waves, of a vortex and of convection on fixed points    [RR98 Eqs 1-6, 28-38, 45]

Weights are Lucy's, their range h in spacings. make : of `particles.integral.edge_makers.MAKERS`.
"""
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np

from continuum.exact.vortex import Vortex, solved, velocities
from continuum.scene import RayleighBenard
from particles.integral.edge_makers import MAKERS, exact, plain
from particles.integral.edges import Edges
from particles.integral.points import Points
from particles.integrators import RK4
from particles.weights import Lucy
from studies.build.fixed import Scheme, hard_core, settled
from studies.build.measure import ended, followed, rolls
from studies.build.setting import BREADTH, Disorder, positions
from studies.kit.case import Case, Outcome, Report
from studies.ordering.vortex import decayed

ERRORS = ("gradient", "laplacian", "closure", "linear")
#: how a gradient is taken over the edges
FORMS = ("single", "sum", "difference")
RA = 1e4
RECORDS = 4         # a free-fall time
#: columns of a layer without an end
NOTHING = {**dict.fromkeys(("ke", "ke_err", "nu", "nu_err", "exchanges"), np.nan), "rolls": 0,
           "converged": False}


# --- waves --------------------------------------------------------------------------------------------------


@dataclass(frozen=True, kw_only=True)
class OperatorErrors(Case):
    """Relative rms errors of gradient and Laplacian of a plane wave along x, in 2D.

    Without errors where there are no such edges on the points.
    """
    make: Callable[[Points, Any], Edges]
    h: float
    disorder: Disorder
    wavelength: int
    seed: int = 1

    @property
    def cost(self) -> float:
        settling = 3.0*(self.disorder.name == "relaxed")
        return 2e-5*self.wavelength*BREADTH*self.h**2 + settling

    def run(self, report: Report, folder: Path) -> Outcome:
        points = self.disorder.make((self.wavelength, BREADTH), self.disorder.size, self.seed)
        key = {"maker": self.make.__name__, "h": self.h, "points": self.disorder.name,
               "wavelength": self.wavelength, "seed": self.seed}
        try:
            edges = self.make(points, Lucy.of(h=self.h))
        except ArithmeticError:     # no such edges exist on these points: that is a result
            return Outcome({"operators": [key | dict.fromkeys(ERRORS, np.nan)]})
        gradient, laplacian = wave_errors(edges, points.x[:, 0], 2*np.pi/self.wavelength)
        closure = float(np.abs(edges.closure).max())
        linear = float(np.abs(edges.linear - np.eye(2)).max())
        return Outcome({"operators": [key | {"gradient": gradient, "laplacian": laplacian,
                                             "closure": closure, "linear": linear}]})


def wave_errors(edges: Edges, x: np.ndarray, k: float) -> tuple[float, float]:
    """Rms errors of grad and lap of a wave over the rms of the true ones; both phases."""
    grad, lap = [], []
    for phase in (0.0, np.pi/2):
        f = np.sin(k*x + phase)
        slope = k*np.cos(k*x + phase)
        along, across = edges.grad(f).T
        grad.append((along - slope)**2 + across**2)
        lap.append((edges.lap(f) + k**2*f)**2)
    V, size = edges.V/edges.V.sum(), np.sqrt(1/2)
    gradient = np.sqrt(V@np.mean(grad, axis=0))/(k*size)
    laplacian = np.sqrt(V@np.mean(lap, axis=0))/(k**2*size)
    return float(gradient), float(laplacian)


@dataclass(frozen=True, kw_only=True)
class GradientForms(Case):
    """Errors of the gradient of a wave along x in three forms, by plain quadrature."""
    disorder: Disorder
    h: float
    wavelength: int
    seed: int = 1

    @property
    def cost(self) -> float:
        return 0.05 + 3.0*(self.disorder.name == "relaxed")

    def run(self, report: Report, folder: Path) -> Outcome:
        points = self.disorder.make((self.wavelength, BREADTH), self.disorder.size, self.seed)
        key = {"h": self.h, "points": self.disorder.name, "wavelength": self.wavelength, "seed": self.seed}
        edges = plain(points, Lucy.of(h=self.h))
        errors = form_errors(edges, points.x[:, 0], 2*np.pi/self.wavelength)
        return Outcome({"brackets": [key | errors]})


def form_errors(edges: Edges, x: np.ndarray, k: float) -> dict[str, float]:
    """Rms errors of the gradient of sin kx in three forms, over the rms of the true one; both phases.

    single : sum_j W_ij V_j e_ji f_j    [Eq. 1, inner sums of Eqs 37, 38]. sum : with f_i + f_j    [Eqs 10-14,
    34-36]. difference : with f_j - f_i. The wave has no mean; one would add to the errors of the first two.
    """
    single = [S/2 for S in edges.areas]
    errors = [form_error(edges, matrices, x, k) for matrices in (single, edges.D, edges.G)]
    return dict(zip(FORMS, errors, strict=True))


def form_error(edges: Edges, matrices: Sequence[Any], x: np.ndarray, k: float) -> float:
    """That of V times the gradient by these matrices, one a direction."""
    squares = np.zeros(edges.n)
    for phase in (0.0, np.pi/2):
        f = np.sin(k*x + phase)
        slope = k*np.cos(k*x + phase)
        along, *across = (M@f/edges.V for M in matrices)
        squares += ((along - slope)**2 + sum(g**2 for g in across))/2
    return float(np.sqrt(2*(edges.V@squares)/edges.V.sum()))/k


# --- vortices -----------------------------------------------------------------------------------------------


@dataclass(frozen=True, kw_only=True)
class VortexDecay(Case):
    """A decaying Taylor-Green vortex against the gas of its Mach number; h = 0: the maker takes no weight.

    Without an error where the run diverges or there are no such edges.
    """
    make: Callable[[Points, Any], Edges]
    h: float
    disorder: Disorder
    wavelength: int
    mach: float = 0.05
    seed: int = 1

    @property
    def cost(self) -> float:
        size = self.wavelength/32
        once = 1.0*(self.make.__name__ == "exact") + 6.0*(self.disorder.name == "relaxed")
        return size**3*(0.06*self.h + 0.15)*0.05/self.mach + size**4*once + 0.1

    def run(self, report: Report, folder: Path) -> Outcome:
        points = self.disorder.make((self.wavelength, self.wavelength), self.disorder.size, self.seed)
        key = {"maker": self.make.__name__, "h": self.h, "points": self.disorder.name,
               "wavelength": self.wavelength, "seed": self.seed}
        try:
            edges = self.make(points, Lucy.of(h=self.h) if self.h else None)
        except ArithmeticError:     # no such edges exist on these points: that is a result
            return Outcome({"vortices": [key | {"velocity": np.nan, "exchanges": np.nan}]})
        end = decayed(Vortex(self.mach, self.wavelength), points, edges, report)
        error = difference(edges.V, end.v, velocities(solved(self.mach), points.x/self.wavelength))
        exchanges = RK4.evaluations*end.steps*len(edges.i) if end.reached == 1 else np.nan
        return Outcome({"vortices": [key | {"velocity": error, "exchanges": exchanges}]})


def difference(V: np.ndarray, v: np.ndarray, known: np.ndarray) -> float:
    """Relative rms difference of velocities (n, 2)."""
    squares = ((v - known)**2).sum(axis=1)
    return float(np.sqrt(V@squares/(V@(known**2).sum(axis=1))))


# --- layers -------------------------------------------------------------------------------------------------


@cache
def moved_apart(width: float, height: float, size: float, seed: int) -> np.ndarray:
    """`settled`, once for all makers of edges."""
    return settled(width, height, size, seed)


#: kinds of irregular points: makers and size of their disorder, in spacings
POINTS: dict[str, tuple[Callable, float]] = {
    "jittered-0.3": (positions, 0.3),
    "random": (hard_core, 0.5),
    "relaxed": (moved_apart, 0.5)}


def on_lattice(h: float) -> Scheme:
    """A range of the weight."""
    return Scheme(f"fixed-lattice-h{h:g}", h=h)


def between_images(kind: str, maker: str, h: float) -> Scheme:
    """Edges of a weight over irregular points and their mirror images."""
    points, size = POINTS[kind]
    return Scheme(f"images-{kind}-{maker}-h{h:g}", MAKERS[maker], Lucy, h, size, points=points)


@dataclass(frozen=True, kw_only=True)
class FixedConvection(Case):
    """Rayleigh-Benard convection until nothing changes any more; `kind`: of its points."""
    scene: RayleighBenard
    scheme: Scheme
    seed: int = 1
    t_end: float = 150.0
    kind: str

    @property
    def cost(self) -> float:
        """Points that move apart take the longer the more there are."""
        L, h = self.scene.L, self.scheme.h
        steps = self.t_end*L/self.scene.free_fall/max(0.2, 1.1 - L/100)
        points = self.scene.width*(L + self.scheme.held)
        apart = 0.04*L**2 if self.kind == "relaxed" else 0.0
        return steps*points*1e-7*h**2 + 5 + apart

    @property
    def label(self) -> str:
        points = round(self.scene.width)*(round(self.scene.L) + self.scheme.held)
        return f"dih {self.scheme.name} Ra {self.scene.ra:g}, {points} points, seed {self.seed}"

    def run(self, report: Report, folder: Path) -> Outcome:
        """A row of `convection`; without exchanges where the points have no such edges."""
        try:
            values = self.measured(report, folder)
        except ArithmeticError:
            if self.scheme.make is not exact:       # others exist on all points
                raise
            values = NOTHING | {"exchanges": 0.0}
        h = 0.0 if self.scheme.held else self.scheme.h      # triangles between rows of points have no weight
        key = {"maker": self.scheme.make.__name__, "h": h, "points": self.kind, "rows": round(self.scene.L),
               "seed": self.seed}
        return Outcome({"convection": [key | values]})

    def measured(self, report: Report, folder: Path) -> dict[str, Any]:
        """K, Nu, rolls at the end, and exchanges over edges, to images among them."""
        ready, _, done = followed(self.scene, self.scheme, self.seed, self.t_end, RECORDS, report,
                                  folder/"run.h5")
        if done is None:
            return NOTHING
        method, flow = ready.method, ready.method.fields(done.state)
        beyond = getattr(method, "beyond", None)
        number = len(method.edges.i) + (len(beyond.i) if beyond else 0)
        end = ended(self.scene, done)._asdict()
        number_of_rolls = rolls(self.scene, flow.x, flow.v[:, 1])
        return end | {"rolls": number_of_rolls, "exchanges": RK4.evaluations*done.step*number}


def convection(kind: str, scheme: Scheme, rows: int, seed: int = 1) -> FixedConvection:
    """The case of so many rows."""
    return FixedConvection(scene=RayleighBenard(ra=RA, L=float(rows)), scheme=scheme, seed=seed, kind=kind)
