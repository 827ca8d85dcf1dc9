"""Who takes part in a Taylor-Green vortex of Mach 0.05 and Re 100 that decays by e.

Errors are told against the gas of that Mach number, solved by Fourier sums; of the MAC grid, whose fluid is incompressible,
against the exact incompressible vortex.
"""
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np

from continuum.boussinesq import Box, Case, Edges, End, State
from continuum.boussinesq.mac import mac
from continuum.boussinesq.projection import Projection
from continuum.exact.vortex import DECAYS, RE, SOUND, Vortex, solved, velocities
from continuum.fluid import ConstEta, IdealGas
from particles.integral.closed_faces import EXCHANGED, Moving
from particles.integral.edge_makers import renormalised
from particles.integral.layer import Layer
from particles.integral.points import jittered, lattice
from particles.integral.triangulation import delaunay
from particles.integrators import TwoStep
from particles.observe import fields_at
from particles.smooth.spam import Spam
from particles.threads import Team
from particles.walls.periodic import periodic
from particles.weights import Lucy, Monaghan, WendlandC2
from studies.build.names import START_JITTER
from studies.build.vortex import fluid, start
from studies.cost import names
from studies.cost.problem import Problem, Residuals, of_method

MACH = 0.05
#: of the Fourier sums by Mach number: velocities of 33 against 29 points
KNOWN = {0.05: 1.4e-6, 0.2: 2.9e-5}


@dataclass(frozen=True, kw_only=True, repr=False)
class Euler(Layer):
    """The two-step scheme of Eqs 40, 41 on points that stay: forward Euler."""
    integrator = TwoStep


def euler_limit(method: Layer, c2: float) -> float:
    """Of forward Euler: sound, or diffusion, which grows above 2 over its rate."""
    _, spread = method.edges.fastest
    return min(sound_limit(method, c2), 2/(max(method.law)*spread))


def sound_limit(method: Any, c2: float) -> float:
    """Sound grows above (eta + kappa/2)/(rho c^2) whatever its length."""
    return float((method.law.eta + method.law.k/2)/c2)


def compared(vortex: Vortex, V: np.ndarray, x: np.ndarray, v: np.ndarray) -> Residuals:
    """Velocities (n, 2) at places (n, 2) of volumes V, and the decay of K, relative."""
    return told(vortex, V, exactly(vortex, x), v)


def exactly(vortex: Vortex, x: np.ndarray) -> np.ndarray:
    """Velocities (n, 2) at the end, at places (n, 2), in units of the speed."""
    return velocities(solved(vortex.mach), x/vortex.wavelength)


def told(vortex: Vortex, V: np.ndarray, known: np.ndarray, v: np.ndarray) -> Residuals:
    """The same for velocities that are known in units of the speed."""
    found = v/vortex.speed
    scale = np.sqrt(2*len(V)/(V@(known**2).sum(axis=1)))
    off = np.sqrt(V)[:, None]*(found - known)*scale
    first = float(V.sum()/2)        # of v^2 in units of the speed, at the start
    decay = np.log(first/float(V@(found**2).sum(axis=1)))/(2*DECAYS)
    return {"velocity": off.ravel(), "decay": np.array([decay/solved(vortex.mach).decay - 1])}


class OnPoints(NamedTuple):
    """Fixed points: a lattice with a weight of range h, or jittered points with Delaunay edges (h = 0)."""
    name: str
    h: float = 0.0
    euler: bool = False
    first: float = 0.9
    mach: float = MACH
    weight: Any = Lucy

    def seconds(self, resolution: int) -> float:
        return 0.5 + (0.013*resolution**2 if self.euler else 1.3e-5*resolution**3)

    def problem(self, resolution: int, seed: int) -> Problem:
        vortex, counts = Vortex(self.mach, resolution), (resolution, resolution)
        points = lattice(counts) if self.h else jittered(counts, 0.3, seed)
        edges = renormalised(points, self.weight.of(h=self.h)) if self.h else delaunay(points)
        method = fluid(vortex, points, edges)
        if self.euler:
            method = Euler(**{name: getattr(method, name) for name in ("x", "edges", "beyond", "eos", "law", "T_plates", "g")})
        limit = euler_limit(method, SOUND**2) if self.euler else None
        return of_method(method, start(vortex, method), vortex.time, lambda state: compared(
            vortex, edges.V, points.x, (state[1:3]/state[0]).T), limit=limit, known=KNOWN[self.mach])


class OnParticles(NamedTuple):
    """Smooth particles as printed, from a jittered lattice; the velocity is that of the smoothed field where particles are."""
    name: str
    weight: Any = Lucy
    h: float = 3.0
    first: float = 0.7
    mach: float = MACH

    def seconds(self, resolution: int) -> float:
        return 1.3 + 1e-4*resolution**3

    def problem(self, resolution: int, seed: int) -> Problem:
        vortex, points = Vortex(self.mach, resolution), jittered((resolution, resolution), START_JITTER, seed)
        method = Spam(weight=self.weight.of(h=self.h), eos=IdealGas(), law=ConstEta(vortex.eta, vortex.eta),
                      walls=(*periodic(resolution), *periodic(resolution, axis=1)), box=(resolution, resolution))
        first = np.array([*points.x.T, *vortex.velocity(points.x).T, vortex.density(points.x)])

        def residuals(state: np.ndarray) -> Residuals:
            v = smoothed(method, state)
            return compared(vortex, points.V, state[:2].T, v)
        return of_method(method, first, vortex.time, residuals, known=KNOWN[self.mach], chaotic=True)


class OnMovingPoints(NamedTuple):
    """Moving points that exchange over closed faces, from a jittered lattice."""
    name: str
    first: float = 0.9
    mach: float = MACH

    def seconds(self, resolution: int) -> float:
        return 0.5 + 1.8e-4*resolution**3

    def problem(self, resolution: int, seed: int) -> Problem:
        vortex, points = Vortex(self.mach, resolution), jittered((resolution, resolution), START_JITTER, seed)
        method = Moving(weight=WendlandC2.of(h=3.0), eos=IdealGas(), law=ConstEta(vortex.eta, vortex.eta),
                        walls=(*periodic(resolution), *periodic(resolution, axis=1)), box=(resolution, resolution))
        rho = vortex.density(points.x)

        def residuals(state: np.ndarray) -> Residuals:
            px, py, m, V, _ = state[EXCHANGED]
            return compared(vortex, V, state[:2].T, np.stack([px/m, py/m], axis=1))
        first = method.state(points.x, vortex.velocity(points.x), rho, rho)
        return of_method(method, first, vortex.time, residuals, known=KNOWN[self.mach])


def start_at(vortex: Vortex, x: np.ndarray, y: np.ndarray) -> tuple[np.ndarray, ...]:
    """(rho, u, v, T) of the start at places x, y of any shape."""
    at = np.stack([x.ravel(), y.ravel()], axis=1)
    T = vortex.density(at).reshape(x.shape)
    u, v = (one.reshape(x.shape) for one in vortex.velocity(at).T)
    return T, u, v, T


def smoothed(method: Spam, state: np.ndarray) -> np.ndarray:
    """Velocities (n, 2) of the smoothed field where the particles are, in their order    [KHP95, Sec. VI]"""
    n = state.shape[1]
    sums, copy = method.start(n, Team(1)), state.copy()
    sums.around.relist(copy, np.arange(n), 0.0)
    sums.densities(copy)
    at = fields_at(sums, copy, *state[:2])
    return np.stack([at.vx, at.vy], axis=1)


# --- the MAC grid -----------------------------------------------------------------------------------------------------

#: one of the four vortices between free-slip walls of equal temperature: the flow beyond is its mirror image
FREE = Edges(flow=End.MIRROR, heat=End.WALL)
CELL = Box(width=1.0, sides=Edges(flow=End.MIRROR, heat=End.MIRROR), plates=FREE)
CFL = 0.8           # of two-step advection with some viscosity: `projection.CFL_LIMIT`


class OnMac(NamedTuple):
    """Boussinesq MAC grid with the projection driver (IMEX), at one temperature: an incompressible fluid."""
    name: str
    first: float = 0.9

    def seconds(self, resolution: int) -> float:
        return 0.3

    def problem(self, resolution: int, seed: int) -> Problem:
        """Height 1 is half of a wavelength, the largest velocity 1."""
        nu = 2/RE
        case = Case(ra=1/nu**2, pr=1.0, box=CELL, rows=resolution//2)
        mac.cache_clear()       # what set-up takes is to be seen each time
        first = stirred(case)
        made = Projection(case, first)

        def go(q: np.ndarray, dt: float, steps: int) -> np.ndarray:
            flow = Projection(case, q)
            for _ in range(steps):
                flow.advance(dt)
            return flow.q

        def residuals(q: np.ndarray) -> Residuals:
            ended = first*np.exp(-DECAYS)
            size = slice(0, case.mac.ends[1])
            K, K0 = (State(case=case, q=p).K for p in (q, first))
            return {"velocity": (q - ended)[size]/np.sqrt(np.mean(ended[size]**2)),
                    "decay": np.array([np.log(K0/K)/(2*DECAYS) - 1])}
        h = 1/case.rows
        return Problem(case.rows*case.columns, first, CFL*h/np.abs(first).max(), DECAYS/(2*nu*np.pi**2), go, residuals,
                       lambda: (made,), firm=True)


def stirred(case: Case) -> np.ndarray:
    """The state of the incompressible vortex, streamfunction sin(pi x) sin(pi y)/pi."""
    (xu, yu), (xv, yv) = case.mac.points[:2]
    u = np.outer(np.sin(np.pi*xu), np.cos(np.pi*yu))
    v = -np.outer(np.cos(np.pi*xv), np.sin(np.pi*yv))
    return np.r_[u.ravel(), v.ravel(), np.zeros(case.mac.ends[-1] - case.mac.ends[1])]


POINTS = (OnPoints(names.NEAREST, 1.2), OnPoints(names.LATTICE, 2.0), OnPoints(names.WIDE, 3.0))
WEIGHTS = (OnPoints(names.LATTICE_MONAGHAN, 2.0, weight=Monaghan), OnPoints(names.LATTICE_WENDLAND, 2.0, weight=WendlandC2))
TWO_STEP = OnPoints(names.TWO_STEP, 2.0, euler=True)
IRREGULAR = OnPoints(names.JITTERED)
PARTICLES = (OnParticles(names.LUCY), OnParticles(names.MONAGHAN, Monaghan), OnParticles(names.WENDLAND, WendlandC2))
MOVING = OnMovingPoints(names.MOVING)
MAC = OnMac(names.MAC_IMEX)
