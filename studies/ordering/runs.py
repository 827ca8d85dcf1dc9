"""Errors of gradients of waves, of a vortex and of convection on fixed points    [RR98 Eqs 1-6, 28-38, 45]

Weights are Lucy's, their range h in spacings. maker : of `particles.integral.edge_makers.MAKERS`.
"""
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from math import ceil
from pathlib import Path
from typing import Any, ClassVar

import numpy as np

from continuum.exact.vortex import Vortex, solved, velocities
from continuum.fluid import ConstEta, IdealGas
from continuum.scene import RayleighBenard
from particles.integral.edge_makers import MAKERS
from particles.integral.edges import NONE_BEYOND, Edges
from particles.integral.layer import Layer
from particles.integral.points import Points
from particles.integrators import RK4
from particles.limits import limit_of
from particles.run import Divergence, Plan, run
from particles.weights import Lucy
from studies.build.fixed import Scheme, hard_core, settled
from studies.build.measure import ended, followed, rolls
from studies.build.setting import BREADTH, Disorder, shifted
from studies.kit.case import Case, Outcome, Report
from studies.kit.table import Row

#: how a gradient is taken over the edges
FORMS = ("single", "sum", "difference")
PHASES = np.array([[0.0], [np.pi/2]])       # of waves
OF_LIMIT = 0.5      # step of a vortex over its limit: halving it changes errors by 2e-4 of themselves
RA = 1e4
RECORDS = 4         # per free-fall time
#: columns of a layer that did not reach its end
NOTHING = {**dict.fromkeys(("ke", "ke_err", "nu", "nu_err", "exchanges"), np.nan), "rolls": 0,
           "converged": False}


class OnPoints(Case, same="maker h points wavelength seed"):
    """Errors of a flow with edges on one set of points; nan where there are no such edges."""
    maker: Callable[[Points, Any], Edges]
    h: float
    points: Disorder
    wavelength: int
    seed: int = 1

    numbers: ClassVar[tuple[str, ...]]
    breadth: ClassVar[int] = 0          # of the points, in spacings; 0: a wavelength

    def measure(self, report: Report) -> Iterator[Row]:
        counts = self.wavelength, self.breadth or self.wavelength
        points = self.points.make(counts, self.points.size, self.seed)
        try:
            edges = self.maker(points, Lucy.of(h=self.h) if self.h else None)
        except ArithmeticError:     # no such edges exist on these points: that is a result
            yield dict.fromkeys(self.numbers, np.nan)
            return
        yield dict(zip(self.numbers, self.measured(points, edges, report), strict=True))

    def measured(self, points: Points, edges: Edges, report: Report) -> Sequence[float]:
        """Values of the columns `numbers`."""
        raise NotImplementedError


# --- waves --------------------------------------------------------------------------------------------------


class OperatorErrors(OnPoints, table="operators"):
    """Relative rms errors of gradient and Laplacian of a plane wave along x, in 2D."""
    numbers = ("gradient", "laplacian", "closure", "linear")
    breadth = BREADTH

    def measured(self, points: Points, edges: Edges, report: Report) -> Sequence[float]:
        x, k = points.x[:, 0], 2*np.pi/self.wavelength
        bends = [(edges.laplacian@f/edges.V + k**2*f)**2 for f in np.sin(k*x + PHASES)]
        return (form_error(edges, edges.G, x, k), relative(edges.V, bends)/k**2,
                np.abs(edges.closure).max(), np.abs(edges.linear - np.eye(2)).max())


def relative(V: np.ndarray, squares: Sequence[np.ndarray]) -> float:
    """Rms over points, from squares at both phases of a wave, over the rms of the wave."""
    return float(np.sqrt(V@np.sum(squares, axis=0)/V.sum()))


def form_error(edges: Edges, matrices: Sequence[Any], x: np.ndarray, k: float) -> float:
    """Rms error of a wave's gradient. matrices : one for each direction, which give V times the gradient."""
    waves, slopes = np.sin(k*x + PHASES), k*np.cos(k*x + PHASES)
    along, *across = ((M@waves.T).T/edges.V for M in matrices)
    return relative(edges.V, (along - slopes)**2 + sum(g**2 for g in across))/k


def form_errors(edges: Edges, x: np.ndarray, k: float) -> list[float]:
    """Rms errors of the gradient of sin kx in the three FORMS, over the rms of the true one; both phases.

    single : sum_j W_ij V_j e_ji f_j    [Eq. 1, inner sums of Eqs 37, 38]. sum : with f_i + f_j    [Eqs 10-14,
    34-36]. difference : with f_j - f_i. The wave has no mean; one would add to the errors of the first two.
    """
    single = [S/2 for S in edges.areas]
    return [form_error(edges, matrices, x, k) for matrices in (single, edges.D, edges.G)]


class GradientForms(OnPoints, table="brackets", same="h points wavelength seed"):
    """Errors of the gradient of a wave along x in three forms."""
    numbers = FORMS
    breadth = BREADTH

    def measured(self, points: Points, edges: Edges, report: Report) -> Sequence[float]:
        return form_errors(edges, points.x[:, 0], 2*np.pi/self.wavelength)


# --- vortices -----------------------------------------------------------------------------------------------


class VortexDecay(OnPoints, table="vortices"):
    """A decaying Taylor-Green vortex against the gas of its Mach number; h = 0: the maker takes no weight."""
    mach: float = 0.05

    numbers = ("velocity", "exchanges")

    @property
    def cost(self) -> float:
        size = self.wavelength/32
        once = 1.0*(self.maker.__name__ == "exact") + 6.0*(self.points.name == "relaxed")
        return size**3*(0.06*self.h + 0.15)*0.05/self.mach + size**4*once + 0.1

    def measured(self, points: Points, edges: Edges, report: Report) -> Sequence[float]:
        v, steps = decayed(Vortex(self.mach, self.wavelength), points, edges, report)
        known = velocities(solved(self.mach), points.x/self.wavelength)
        squares, of_known = (edges.V@(u**2).sum(axis=1) for u in (v - known, known))
        return np.sqrt(squares/of_known), RK4.evaluations*steps*len(edges.i)


def decayed(vortex: Vortex, points: Points, edges: Edges, report: Report) -> tuple[np.ndarray, float]:
    """Velocities (n, 2) at the end over the initial speed, and steps of the run; nan where it diverged.

    The conductivity is as large as the viscosity.
    """
    method = Layer(x=points.x, edges=edges, beyond=NONE_BEYOND, eos=IdealGas(),
                   law=ConstEta(vortex.eta, vortex.eta), T_plates=(1.0, 1.0), g=0.0)
    rho = vortex.density(points.x)
    first = method.state(rho, vortex.velocity(points.x), rho)
    steps = ceil(vortex.time/(OF_LIMIT*limit_of(method, first)))
    try:
        last = run(method, first, Plan(dt=vortex.time/steps, steps=steps), report).state
    except Divergence:
        return np.full((points.n, 2), np.nan), np.nan
    return method.fields(last).v/vortex.speed, steps


# --- layers -------------------------------------------------------------------------------------------------

#: kinds of irregular points: makers and size of their disorder, in spacings
POINTS: dict[str, tuple[Callable, float]] = {
    "jittered-0.3": (shifted, 0.3), "random": (hard_core, 0.5), "relaxed": (settled, 0.5)}


def on_lattice(h: float) -> Scheme:
    """The scheme of a lattice with this range of the weight."""
    return Scheme(f"fixed-lattice-h{h:g}", h=h)


def between_images(kind: str, maker: str, h: float) -> Scheme:
    """The scheme with edges of a weight over irregular points and their mirror images."""
    points, size = POINTS[kind]
    return Scheme(f"images-{kind}-{maker}-h{h:g}", MAKERS[maker], Lucy, h, size, points=points)


@dataclass(frozen=True, kw_only=True)
class FixedConvection(Case):
    """Rayleigh-Benard convection until it is steady. kind : of its points."""
    scene: RayleighBenard
    scheme: Scheme
    seed: int = 1
    t_end: float = 150.0
    kind: str

    @property
    def cost(self) -> float:
        """Seconds. Relaxed points first move apart, which takes the longer the more there are."""
        L, h = self.scene.L, self.scheme.h
        steps = self.t_end*L/self.scene.free_fall/max(0.2, 1.1 - L/100)
        apart = 0.04*L**2 if self.kind == "relaxed" else 0.0
        return steps*self.scene.width*(L + self.scheme.held)*1e-7*h**2 + 5 + apart

    def run(self, report: Report, folder: Path) -> Outcome:
        h = 0.0 if self.scheme.held else self.scheme.h      # triangles between rows of points have no weight
        key = {"maker": self.scheme.make.__name__, "h": h, "points": self.kind, "rows": round(self.scene.L),
               "seed": self.seed}
        return Outcome({"convection": [key | self.measured(report, folder)]})

    def measured(self, report: Report, folder: Path) -> dict[str, Any]:
        """K, Nu, rolls at the end, and number of exchanges over edges, those to images included."""
        try:
            ready, _, done = followed(self.scene, self.scheme, self.seed, self.t_end, RECORDS, report,
                                      folder/"run.h5")
        except ArithmeticError:     # no such edges exist on these points: that is a result
            return NOTHING
        if done is None:
            return NOTHING
        method, flow = ready.method, ready.method.fields(done.state)
        number = len(method.edges.i) + len(getattr(method, "beyond", NONE_BEYOND).i)
        end = ended(self.scene, done)._asdict()
        return end | {"rolls": rolls(self.scene, flow.x, flow.v[:, 1]),
                      "exchanges": RK4.evaluations*done.step*number}


def convection(kind: str, scheme: Scheme, rows: int, seed: int = 1) -> FixedConvection:
    """The case of convection with so many rows."""
    return FixedConvection(scene=RayleighBenard(ra=RA, L=float(rows)), scheme=scheme, seed=seed, kind=kind)
