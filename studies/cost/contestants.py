"""Flows with exact answers, and methods in them: points, smooth particles, a compressible and a MAC grid."""
from functools import partial
from typing import Any, NamedTuple

import numpy as np

from continuum.boussinesq import BoussinesqCase, Box, BoxEdges, End, State
from continuum.boussinesq.mac import mac
from continuum.boussinesq.projection import Projection
from continuum.exact import plates
from continuum.exact.vortex import DECAYS, RE, solved, velocities
from continuum.gas.ghosts import RHO
from particles.fields import Fields
from particles.integral.points import lattice
from particles.observe import fields_at
from particles.smooth.spam import Spam
from studies.build.answers import of_one_mass
from studies.build.scenes import BetweenPlates, Sound, TaylorGreen
from studies.build.setting import Ready
from studies.cost.problem import Problem, Residuals, Result, of_method, relative, rms

#: uncertainty of the Fourier sums by Mach number, from the study ordering: velocities of 33 against 29 points
KNOWN = {0.05: 1.4e-6, 0.2: 2.9e-5}
#: one of the four vortices between free-slip walls of equal temperature: the flow beyond is its mirror image
FREE = BoxEdges(flow=End.MIRROR, heat=End.WALL)
CELL = Box(width=1.0, sides=BoxEdges(flow=End.MIRROR, heat=End.MIRROR), plates=FREE)
CFL = 0.8           # of two-step advection with some viscosity: `projection.CFL_LIMIT`


# --- flows --------------------------------------------------------------------------------------------------


class DecayingVortex(NamedTuple):
    """A Taylor-Green vortex of Re 100 that decays by e, as a gas; `velocity` and the `decay` of K."""
    mach: float = 0.05

    @property
    def known(self) -> float:
        return KNOWN[self.mach]

    def scene(self, size: int) -> TaylorGreen:
        return TaylorGreen(L=size, mach=self.mach)

    def residuals(self, scene: TaylorGreen, at: Fields) -> Residuals:
        """Of fields at the end."""
        exact = velocities(solved(self.mach), at.x/scene.L)
        return self.against(scene, exact, at.V, at.v)

    def against(self, scene: TaylorGreen, exact: np.ndarray, V: np.ndarray, v: np.ndarray) -> Residuals:
        """Of velocities (n, 2) of volumes V; exact ones are in units of the speed."""
        measured = v/scene.speed
        squares = (measured**2).sum(axis=1)
        decay = np.log(V.sum()/2/(V@squares))/(2*DECAYS)
        off = decay/solved(self.mach).decay - 1
        return {"velocity": relative(V, measured - exact, exact), "decay": np.array([off])}


class StandingWave(NamedTuple):
    """A sound wave of small amplitude for two periods; `velocity` and `temperature`."""
    known: float = 1e-4

    def scene(self, size: int) -> Sound:
        return Sound(width=size)

    def residuals(self, scene: Sound, at: Fields) -> Residuals:
        """Of fields at the end."""
        _, u, T = scene.exactly(scene.time, at.x[:, 0])
        velocity = relative(at.V, at.v[:, 0] - u, u)
        temperature = relative(at.V, at.T - 1 - T, T)
        return {"velocity": velocity, "temperature": temperature}


class SlabFlow(NamedTuple):
    """Heat that spreads or shear that settles between plates: the `temperature`, or the `velocity`."""
    flow: plates.PlateFlow

    @property
    def known(self) -> float:
        """What fewer Chebyshev points make of the answer."""
        s = np.linspace(0, 1, 200)
        row = 2 if self.flow.U else 3
        fine, coarse = plates.fields(self.flow, s)[row], plates.fields(self.flow, s, plates.COARSER)[row]
        return rms(fine - coarse)/float(np.std(fine))

    def scene(self, size: int) -> BetweenPlates:
        return BetweenPlates(flow=self.flow, L=size)

    def residuals(self, scene: BetweenPlates, at: Fields) -> Residuals:
        """Of fields at the end; of temperatures relative to what differs from the plates'."""
        _, _, u, T = plates.fields(self.flow, at.x[:, 1]/scene.L + 0.5)
        if self.flow.U:
            return {"velocity": relative(at.V, at.v[:, 0] - u, u)}
        return {"temperature": relative(at.V, at.T - T, T - 1)}


# --- points and particles -----------------------------------------------------------------------------------


def points(flow: Any, method: Any, size: int, seed: int) -> Problem:
    """Points that stay or move, as they are built."""
    scene = flow.scene(size)
    return in_flow(flow, scene, method.ready(scene, seed))


def on_lattice(flow: Any, method: Any, size: int, seed: int) -> Problem:
    """Moving points from a lattice: in sound jitter would be louder than the wave."""
    scene = flow.scene(size)
    x = lattice((scene.width, scene.L)).x
    return in_flow(flow, scene, method.ready(scene, seed, x=x))


def in_flow(flow: Any, scene: Any, ready: Ready) -> Problem:
    """Fields as the method has them."""
    def judge(state: np.ndarray) -> Result:
        at = ready.method.fields(state)
        return Result(flow.residuals(scene, at))
    return of_method(ready.method, ready.start, scene.time, judge, known=flow.known)


def particles(flow: Any, method: Any, size: int, seed: int) -> Problem:
    """Smooth particles at places that suit the flow; limits of lattice sums are firm."""
    scene = flow.scene(size)
    x, fields = of_one_mass(scene, seed)
    made, start, _ = method.ready(scene, seed, x=x, fields=fields)

    def judge(state: np.ndarray) -> Result:
        at = made.fields(state)._replace(V=np.ones(len(x)))
        return Result(flow.residuals(scene, at))
    return of_method(made, start, scene.time, judge, known=flow.known, firm=True)


def restless(flow: Any, method: Any, size: int, seed: int) -> Problem:
    """The same where two steps give two flows."""
    return particles(flow, method, size, seed)._replace(chaotic=True)


def trembling(flow: Any, method: Any, size: int, seed: int) -> Problem:
    """The same where they tremble: the smoothed field counts    [KHP95, Sec. VI]"""
    problem, scene = restless(flow, method, size, seed), flow.scene(size)
    _, sums, _ = problem.held()

    def judge(state: np.ndarray) -> Result:
        at = smoothed(sums.method, state)
        return Result(flow.residuals(scene, at))
    return problem._replace(judge=judge)


def smoothed(method: Spam, state: np.ndarray) -> Fields:
    """The smoothed field where the particles are, each of which counts as much."""
    sums, ordered, _ = method.look(state)
    x, y, *_ = state
    at = fields_at(sums, ordered, x, y)
    v = np.stack([at.vx, at.vy], axis=1)
    V = np.full(len(x), 1/len(x))
    return Fields(state[:2].T, v, at.rho, at.T, V)


# --- grids --------------------------------------------------------------------------------------------------


def on_grid(flow: Any, form: Any, size: int, seed: int) -> Problem:
    """The compressible grid in time."""
    scene = flow.scene(size)
    return in_cells(flow, scene, form.ready(scene))


def of_mean_one(flow: SlabFlow, form: Any, size: int, seed: int) -> Problem:
    """The same from densities whose mean over cells is 1."""
    scene = flow.scene(size)
    first = form.ready(scene).start
    first[RHO] /= first[RHO, 1:-1, 1:-1].mean()
    return in_cells(flow, scene, form.ready(scene, first=first))


def in_cells(flow: Any, scene: Any, ready: Ready) -> Problem:
    """Fields at the nodes."""
    method, march = ready.method, ready.method.march(ready.start)

    def judge(S: np.ndarray) -> Result:
        at = method.fields(S)
        return Result(flow.residuals(scene, at))

    def held() -> tuple:
        return march.S, march.scratch
    cells = round(scene.L*scene.width)
    return Problem(cells, ready.start, ready.limit, scene.time, method.go, judge, held, flow.known)


def on_mac(flow: DecayingVortex, form: None, size: int, seed: int) -> Problem:
    """The Boussinesq MAC grid at one temperature, IMEX: the vortex of an incompressible fluid.

    Height 1 is half of a wavelength, the largest velocity 1.
    """
    nu = 2/RE
    case = BoussinesqCase(ra=1/nu**2, pr=1.0, box=CELL, rows=size//2)
    mac.cache_clear()       # what set-up takes is to be seen each time
    start = stirred(case)
    made, fastest = Projection(case, start), np.abs(start).max()
    limit, time = CFL/case.rows/fastest, DECAYS/(2*nu*np.pi**2)

    go, judge = partial(projected, case), partial(decayed, case, start)
    return Problem(case.rows*case.columns, start, limit, time, go, judge, lambda: (made,), firm=True)


def projected(case: BoussinesqCase, q: np.ndarray, dt: float, steps: int) -> np.ndarray:
    """The state so many steps later."""
    flow = Projection(case, q)
    for _ in range(steps):
        flow.advance(dt)
    return flow.q


def decayed(case: BoussinesqCase, start: np.ndarray, q: np.ndarray) -> Result:
    """Against the start, smaller by e."""
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
