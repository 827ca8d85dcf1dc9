"""Methods in flows with exact answers: points and particles as they are built, the compressible grid, the MAC grid."""
from collections.abc import Callable
from dataclasses import replace
from functools import partial
from typing import Any, NamedTuple

import numpy as np

from continuum.boussinesq import Box, BoxEdges, Case, End, State
from continuum.boussinesq.mac import mac
from continuum.boussinesq.projection import Projection
from continuum.exact.vortex import DECAYS, RE, SOUND
from continuum.fluid import energy
from continuum.gas.fields import NodeFields, Nodes, Values, block, nodes
from continuum.gas.loop import VX
from particles.integral.points import lattice
from particles.integrators import TwoStep
from particles.limits import limit_of
from studies.build import ready, variant
from studies.build.names import START_JITTER
from studies.build.scenes import BetweenPlates
from studies.cost.flows import Plates
from studies.cost.problem import Price, Problem, Residuals, of_method

RK4_TO_EULER = 2/2.785      # ends of both stability regions on the negative real axis, where diffusion is
C2 = SOUND**2
#: one of the four vortices between free-slip walls of equal temperature: the flow beyond is its mirror image
FREE = BoxEdges(flow=End.MIRROR, heat=End.WALL)
CELL = Box(width=1.0, sides=BoxEdges(flow=End.MIRROR, heat=End.MIRROR), plates=FREE)
CFL = 0.8           # of two-step advection with some viscosity: `projection.CFL_LIMIT`


# --- forward Euler ----------------------------------------------------------------------------------------------


def sound_limit(method: Any) -> float:
    """Sound grows above (eta + kappa/2)/(rho c^2) whatever its length."""
    return float((method.law.eta + method.law.k/2)/C2)


# --- contestants ------------------------------------------------------------------------------------------------


class Made(NamedTuple):
    """A method in a scene, its state at the start, what is seen of a state; its stability limit if not that of RK4."""
    method: Any
    start: np.ndarray
    see: Callable[[np.ndarray], Any]
    limit: float | None = None


def points(contest: Any, scene: Any, method: str, seed: int) -> Made:
    """Points that stay or move, as they are built."""
    made, start, _ = ready(scene, method, seed)
    return Made(made, start, made.fields)


def less_jittered(contest: Any, scene: Any, method: str, seed: int) -> Made:
    """Points off a lattice by a fifth of a spacing, as moving ones start."""
    made, start, _ = ready(scene, variant(method)._replace(size=START_JITTER), seed)
    return Made(made, start, made.fields)


def on_lattice(contest: Any, scene: Any, method: str, seed: int) -> Made:
    """Moving points from a lattice: in sound jitter would be louder than the wave."""
    made, start, _ = ready(scene, method, seed, x=lattice((scene.width, scene.L)).x)
    return Made(made, start, made.fields)


def particles(contest: Any, scene: Any, method: str, seed: int) -> Made:
    """Smooth particles at places that suit the scene."""
    x, fields = contest.places(scene, seed)
    made, start, _ = ready(scene, method, seed, x=x, fields=fields)
    return Made(made, start, partial(contest.particles, made))


def two_step_points(contest: Any, scene: Any, method: str, seed: int) -> Made:
    """Diffusion grows above 2 over its rate."""
    usual, start, _ = ready(scene, method, seed)
    made = replace(usual, integrator=TwoStep)
    return Made(made, start, made.fields, min(sound_limit(made), 2/(max(made.law)*made.edges.fastest[1])))


def two_step_particles(contest: Any, scene: Any, method: str, seed: int) -> Made:
    """As `particles`."""
    x, fields = contest.places(scene, seed)
    usual, start, _ = ready(scene, method, seed, x=x, fields=fields)
    made = replace(usual, integrator=TwoStep)
    limit = min(sound_limit(made), RK4_TO_EULER*limit_of(made, start))
    return Made(made, start, partial(contest.particles, made), limit)


class Contestant(NamedTuple):
    """A method of the particles' time loop in a contest. method : of `studies.build`; make : how it is set up."""
    name: str
    contest: Any
    method: str
    price: Price
    make: Callable[[Any, Any, str, int], Made] = points
    first: float = 0.9
    chaotic: bool = False

    def problem(self, size: int, seed: int) -> Problem:
        """At a resolution."""
        scene = self.contest.scene(size)
        made = self.make(self.contest, scene, self.method, seed)

        def residuals(state: np.ndarray) -> Residuals:
            return self.contest.residuals(scene, made.see(state))
        return of_method(made.method, made.start, scene.time, residuals, limit=made.limit, known=self.contest.known,
                         chaotic=self.chaotic)


class OnGrid(NamedTuple):
    """The compressible grid in time in a contest."""
    name: str
    contest: Any
    price: Price
    first: float = 0.9

    def problem(self, size: int, seed: int) -> Problem:
        scene = self.contest.scene(size)
        between = isinstance(self.contest, Plates)
        method, first, _ = ready(scene, "grid", first=beside_plates(scene) if between else None)
        march = method.march(first)

        def residuals(S: np.ndarray) -> Residuals:
            at = method.fields(S)
            return self.contest.residuals(scene, column(at, scene) if between else at)
        return Problem(round(scene.L)*round(scene.width), first, limit_of(method, march.S), scene.time, method.go, residuals,
                       lambda: (march.S, march.scratch), self.contest.known)


def column(at: Nodes, scene: BetweenPlates) -> Nodes:
    """The nodes of one column: all are alike."""
    first = slice(None, None, scene.width)
    return Nodes(*(values[first] for values in at))


def beside_plates(scene: BetweenPlates) -> np.ndarray:
    """The start; densities in cells are those of their middle, their mean made 1. A plate slides where its nodes do."""
    x, y = nodes(scene, scene.L)
    _, v, u, T = (np.tile(q[:, None], len(x)) for q in scene.flow.start(y/scene.L + 0.5))
    rho = scene.flow.start((np.arange(scene.L) + 0.5)/scene.L)[0]
    cells = np.tile((rho/rho.mean())[:, None], len(x) - 1)
    at = Values(u, v, energy(scene.eos, 1.0, T), T, np.ones_like(T))
    S = block(NodeFields(scene, x, y, at, cells))
    S[VX, -1] = scene.slide
    return S


# --- the MAC grid -----------------------------------------------------------------------------------------------


class OnMac(NamedTuple):
    """Boussinesq MAC grid with the projection driver (IMEX), at one temperature: the vortex of an incompressible fluid."""
    name: str
    price: Price = Price(0.3)
    first: float = 0.9

    def problem(self, size: int, seed: int) -> Problem:
        """Height 1 is half of a wavelength, the largest velocity 1."""
        nu = 2/RE
        case = Case(ra=1/nu**2, pr=1.0, box=CELL, rows=size//2)
        mac.cache_clear()       # what set-up takes is to be seen each time
        first = stirred(case)
        made = Projection(case, first)

        def residuals(q: np.ndarray) -> Residuals:
            ended = first*np.exp(-DECAYS)
            flow = slice(0, case.mac.ends[1])
            K, K0 = (State(case=case, q=p).K for p in (q, first))
            return {"velocity": (q - ended)[flow]/np.sqrt(np.mean(ended[flow]**2)),
                    "decay": np.array([np.log(K0/K)/(2*DECAYS) - 1])}
        limit = CFL/case.rows/np.abs(first).max()
        return Problem(case.rows*case.columns, first, limit, DECAYS/(2*nu*np.pi**2), partial(projected, case), residuals,
                       lambda: (made,), firm=True)


def projected(case: Case, q: np.ndarray, dt: float, steps: int) -> np.ndarray:
    """The state so many steps later."""
    flow = Projection(case, q)
    for _ in range(steps):
        flow.advance(dt)
    return flow.q


def stirred(case: Case) -> np.ndarray:
    """The state of the incompressible vortex, streamfunction sin(pi x) sin(pi y)/pi."""
    (xu, yu), (xv, yv) = case.mac.points[:2]
    u = np.outer(np.sin(np.pi*xu), np.cos(np.pi*yu))
    v = -np.outer(np.cos(np.pi*xv), np.sin(np.pi*yv))
    return np.r_[u.ravel(), v.ravel(), np.zeros(case.mac.ends[-1] - case.mac.ends[1])]
