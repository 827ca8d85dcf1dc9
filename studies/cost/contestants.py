"""Flows with exact answers, and methods in them: points, smooth particles, a compressible and a MAC grid."""
from collections.abc import Callable
from functools import partial
from typing import Any, NamedTuple

import numpy as np

from continuum.boussinesq import BoussinesqCase, Box, BoxEdges, End, State
from continuum.boussinesq.mac import mac
from continuum.boussinesq.projection import Projection
from continuum.exact import plates
from continuum.exact.vortex import DECAYS, RE, solved
from continuum.gas.ghosts import RHO
from particles.fields import Fields
from particles.integral.points import lattice
from particles.smooth.spam import Spam
from studies.build import answer, of_one_mass, with_rows
from studies.build.scenes import BetweenPlates, TaylorGreen
from studies.build.setting import Ready
from studies.cost.problem import Judge, Problem, Residuals, Result, of_grid, of_method, relative, rms
from studies.front.observed import seen

#: uncertainty of the Fourier sums by Mach number: change of velocities from 29 to 33 points along each axis
KNOWN = {0.05: 1.4e-6, 0.2: 2.9e-5}
STEEPENS = 1e-4     # uncertainty of sound, which steepens a little
#: one of the four vortices between free-slip walls of equal temperature: the flow beyond is its mirror image
FREE = BoxEdges(flow=End.MIRROR, heat=End.WALL)
CELL = Box(width=1.0, sides=BoxEdges(flow=End.MIRROR, heat=End.MIRROR), plates=FREE)
CFL = 0.8           # Courant number up to which two-step advection with some viscosity is stable


# --- flows --------------------------------------------------------------------------------------------------


class ExactFlow(NamedTuple):
    """A scene of `studies.build` that has an exact answer; `example` is one of its resolutions."""
    example: Any

    @property
    def known(self) -> float:
        """Relative uncertainty of the exact answer; between plates its change with fewer Chebyshev points."""
        scene = self.example
        if isinstance(scene, TaylorGreen):
            return KNOWN[scene.mach]
        if not isinstance(scene, BetweenPlates):
            return STEEPENS
        s, row = np.linspace(0, 1, 200), 2 if scene.flow.U else 3
        fine, coarse = plates.fields(scene.flow, s)[row], plates.fields(scene.flow, s, plates.COARSER)[row]
        return rms(fine - coarse)/float(np.std(fine))

    def scene(self, size: int) -> Any:
        return with_rows(self.example, size)

    def judge(self, scene: Any, see: Callable[[np.ndarray], Fields]) -> Judge:
        """Judge of the state at the end. see : state -> fields."""
        return lambda state: Result(self.residuals(scene, see(state)))

    def residuals(self, scene: Any, at: Fields) -> Residuals:
        """Residuals of fields at the end; those of temperature are relative to T - 1."""
        exact, errors = answer(scene, at.x), {}
        if "vx" in exact:
            v = np.stack([exact[name] for name in ("vx", "vy") if name in exact], axis=1)
            errors["velocity"] = relative(at.V, at.v[:, :v.shape[1]] - v, v)
        if "T" in exact:
            errors["temperature"] = relative(at.V, at.T - exact["T"], exact["T"] - 1)
        if isinstance(scene, TaylorGreen):
            errors["decay"] = decay(scene, at.V, at.v)
        return errors


def decay(scene: TaylorGreen, V: np.ndarray, v: np.ndarray) -> np.ndarray:
    """Relative error of the decay of a vortex (1,), from velocities (n, 2) of volumes V at the end."""
    squares = (v**2).sum(axis=1)/scene.speed**2
    measured = np.log(V.sum()/2/(V@squares))/(2*DECAYS)
    return np.array([measured/solved(scene.mach).decay - 1])


# --- points and particles -----------------------------------------------------------------------------------

def points(flow: ExactFlow, method: Any, size: int, seed: int) -> Problem:
    """Problem of points that stay or move, from their usual start."""
    scene = flow.scene(size)
    return in_flow(flow, scene, method.ready(scene, seed))


def on_lattice(flow: ExactFlow, method: Any, size: int, seed: int) -> Problem:
    """Problem of moving points that start on a lattice: in sound jitter would be louder than the wave."""
    scene = flow.scene(size)
    x = lattice((scene.width, scene.L)).x
    return in_flow(flow, scene, method.ready(scene, seed, x=x))


def carried(flow: ExactFlow, method: Any, size: int, seed: int) -> Problem:
    """Problem of points that move with their triangulation."""
    return with_triangles(points(flow, method, size, seed))


def with_triangles(problem: Problem) -> Problem:
    """The problem with steps timed from the start, whose triangulation the method has. Two steps give two
    sets of points, which are equally disordered."""
    def timed(state: np.ndarray, dt: float, steps: int) -> Any:
        return problem.advance(problem.start, dt, steps)
    return problem._replace(chaotic=True, timed=timed)


def in_flow(flow: ExactFlow, scene: Any, ready: Ready) -> Problem:
    """Problem of a method that is judged by its own fields."""
    judge = flow.judge(scene, ready.method.fields)
    return of_method(ready.method, ready.start, scene.time, judge, known=flow.known)


def alike(method: Spam, state: np.ndarray) -> Fields:
    """The fields of particles, with equal volumes."""
    return method.fields(state)._replace(V=np.ones(state.shape[1]))


def particles(flow: ExactFlow, method: Any, size: int, seed: int,
              see: Callable[[Any, np.ndarray], Fields] = alike) -> Problem:
    """Problem of smooth particles of one mass, placed by the density of the flow; step limits by lattice sums
    are firm. see : what is judged."""
    scene = flow.scene(size)
    x, fields = of_one_mass(scene, seed)
    ready = method.ready(scene, seed, x=x, fields=fields)
    judge = flow.judge(scene, partial(see, ready.method))
    return in_flow(flow, scene, ready)._replace(judge=judge, firm=True)


def restless(flow: ExactFlow, method: Any, size: int, seed: int) -> Problem:
    """As `particles`, in flows where two steps give two flows."""
    return particles(flow, method, size, seed)._replace(chaotic=True)


def trembling(flow: ExactFlow, method: Any, size: int, seed: int) -> Problem:
    """As `restless`, where particles are noisy: the smoothed field is judged    [KHP95, Sec. VI]"""
    return particles(flow, method, size, seed, smoothed)._replace(chaotic=True)


def smoothed(method: Spam, state: np.ndarray) -> Fields:
    """The smoothed fields at the particles, with equal volumes."""
    n = state.shape[1]
    return seen(method, state)._replace(V=np.full(n, 1/n))


# --- grids --------------------------------------------------------------------------------------------------


def on_grid(flow: ExactFlow, form: Any, size: int, seed: int, first: np.ndarray | None = None) -> Problem:
    """Problem of the compressible grid in time."""
    scene = flow.scene(size)
    ready = form.ready(scene, first=first)
    return of_grid(ready, scene.time, flow.judge(scene, ready.method.fields), known=flow.known)


def of_mean_one(flow: ExactFlow, form: Any, size: int, seed: int) -> Problem:
    """As `on_grid`, from densities whose mean over cells is 1."""
    ready = form.ready(flow.scene(size))
    first = ready.method.block(ready.start)
    first[RHO] /= first[RHO, 1:-1, 1:-1].mean()
    return on_grid(flow, form, size, seed, first)


def on_mac(flow: ExactFlow, form: None, size: int, seed: int) -> Problem:
    """Problem of the Boussinesq MAC grid (IMEX) at one temperature: the vortex of an incompressible fluid.

    The height 1 is half of a wavelength; the largest velocity is 1.
    """
    nu = 2/RE
    case = BoussinesqCase(ra=1/nu**2, pr=1.0, box=CELL, rows=size//2)
    mac.cache_clear()       # so that each set-up is timed in full
    start = stirred(case)
    limit, time = CFL/case.rows/np.abs(start).max(), DECAYS/(2*nu*np.pi**2)

    go, judge = partial(projected, case), partial(decayed, case, start)
    set_up = partial(Projection, case, start)
    return Problem(case.rows*case.columns, start, limit, time, go, judge, set_up, firm=True)


def projected(case: BoussinesqCase, q: np.ndarray, dt: float, steps: int) -> np.ndarray:
    """The state so many steps later."""
    flow = Projection(case, q)
    for _ in range(steps):
        flow.advance(dt)
    return flow.q


def decayed(case: BoussinesqCase, start: np.ndarray, q: np.ndarray) -> Result:
    """Errors of the vortex at the end against the start times exp(-DECAYS)."""
    flow = slice(0, case.mac.ends[1])
    exact = start[flow]*np.exp(-DECAYS)
    first, last = (State(case=case, q=state).K for state in (start, q))
    decay = np.log(first/last)/(2*DECAYS)
    velocity = relative(np.ones(exact.size), q[flow] - exact, exact)
    return Result({"velocity": velocity, "decay": np.array([decay - 1])})


def stirred(case: BoussinesqCase) -> np.ndarray:
    """The state of the incompressible vortex, streamfunction sin(pi x) sin(pi y)/pi."""
    (xu, yu), (xv, yv) = case.mac.points[:2]
    u = np.outer(np.sin(np.pi*xu), np.cos(np.pi*yu))
    v = -np.outer(np.cos(np.pi*xv), np.sin(np.pi*yv))
    _, flow, *_, end = case.mac.ends
    return np.r_[u.ravel(), v.ravel(), np.zeros(end - flow)]
