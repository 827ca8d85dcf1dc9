"""Who takes part in a sound wave of small amplitude that rings for two periods in a periodic box.

Density and temperature start as isentropic cosines, at rest; the answer is exact for small amplitudes, from the rates of plane
waves (studies/build/symbols.py). Points and particles start on lattices, but for jittered ones: the noise of
particles that lie at random is larger than any wave whose answer is known to many digits.
"""
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
from scipy.linalg import expm

from continuum.exact.vortex import SOUND
from continuum.exact.waves import Gas, continuum
from continuum.fluid import ConstEta, IdealGas
from particles.integral.closed_faces import EXCHANGED, Moving
from particles.integral.edge_makers import renormalised
from particles.integral.edges import NONE_BEYOND, Edges
from particles.integral.layer import Layer
from particles.integral.points import Points, jittered, lattice
from particles.integral.triangulation import delaunay
from particles.integrators import TwoStep
from particles.limits import limit_of
from particles.smooth.spam import Nested, Spam
from particles.threads import Team
from particles.walls.periodic import periodic
from particles.weights import Lucy, Monaghan, WendlandC2
from studies.cost import names
from studies.cost.problem import Problem, Residuals, of_method
from studies.cost.vortex import Euler, euler_limit, sound_limit

AMPLITUDE = 1e-5    # steepening is of the order of its product with the phase, 12: 1e-4 of the wave
KNOWN = 1e-4
PERIODS = 2.125     # and an eighth: density and velocity are both there
DAMPING = 0.01      # eta = kappa, in wavelengths: a third of the wave is left
RK4_TO_EULER = 2/2.785      # ends of both stability regions on the negative real axis, where diffusion is
BREADTH = 8         # spacings across: wider than twice a range of three


class Wave(NamedTuple):
    """A standing wave of a length in spacings."""
    length: int

    @property
    def k(self) -> float:
        return 2*np.pi/self.length

    @property
    def eta(self) -> float:
        return DAMPING*self.length

    @property
    def time(self) -> float:
        return PERIODS*self.length/SOUND

    def exactly(self, time: float, x: np.ndarray) -> np.ndarray:
        """(rho, u, T), each (n,), less their means."""
        matrix = continuum(Gas(self.eta, 0.0, self.eta), self.k).matrix
        return AMPLITUDE*np.real(np.outer(expm(matrix*time)@np.array([1, 0, 1]), np.exp(1j*self.k*x)))

    def start_at(self, x: np.ndarray, y: np.ndarray) -> tuple[np.ndarray, ...]:
        """(rho, u, v, T) of the start at places x, y of any shape."""
        rho, _, T = self.exactly(0.0, x.ravel()).reshape(3, *x.shape)
        return 1 + rho, 0*x, 0*x, 1 + T

    def compared(self, V: np.ndarray, x: np.ndarray, u: np.ndarray, T: np.ndarray, x_u: np.ndarray | None = None) -> Residuals:
        """Velocity (at `x_u` if given) and temperature, each relative to its rms."""
        exact_T, exact_u = self.exactly(self.time, x)[2], self.exactly(self.time, x if x_u is None else x_u)[1]
        w = np.sqrt(len(V)*V/V.sum())
        pairs = {"velocity": (u, exact_u), "temperature": (T - 1, exact_T)}
        return {name: w*(found - exact)/np.sqrt(np.mean(w**2*exact**2)) for name, (found, exact) in pairs.items()}


class OnPoints(NamedTuple):
    """Fixed points: a lattice with a weight of range h, or jittered points with Delaunay edges (h = 0)."""
    name: str
    h: float = 0.0
    euler: bool = False
    first: float = 0.9
    weight: Any = Lucy

    def seconds(self, length: int) -> float:
        return 0.5 + (4e-4 if self.euler else 7e-5)*length**2

    def problem(self, length: int, seed: int) -> Problem:
        wave, counts = Wave(length), (length, BREADTH)
        points = lattice(counts) if self.h else jittered(counts, 0.3, seed)
        edges = renormalised(points, self.weight.of(h=self.h)) if self.h else delaunay(points)
        method = self._method(wave, points, edges)
        rho, u, T = wave.exactly(0.0, points.x[:, 0])

        def residuals(state: np.ndarray) -> Residuals:
            v = state[1:3]/state[0]
            return wave.compared(edges.V, points.x[:, 0], v[0], state[3]/state[0] - (v**2).sum(axis=0)/2)
        limit = euler_limit(method, SOUND**2) if self.euler else None
        return of_method(method, method.state(1 + rho, np.stack([u, 0*u], axis=1), 1 + T), wave.time, residuals, limit=limit,
                         known=KNOWN)

    def _method(self, wave: Wave, points: Points, edges: Edges) -> Layer:
        return (Euler if self.euler else Layer)(x=points.x, edges=edges, beyond=NONE_BEYOND, eos=IdealGas(),
                                                law=ConstEta(wave.eta, wave.eta), T_plates=(1.0, 1.0), g=0.0)


class Places(Nested):
    """Sums that tell the two-step scheme which rows are places."""
    places = 2

    def velocity(self, state: np.ndarray) -> np.ndarray:
        return state[2:4]


@dataclass(frozen=True, kw_only=True, repr=False)
class Stepped(Spam):
    """Smooth particles by the two-step scheme of Eqs 40, 41."""
    integrator = TwoStep

    def start(self, n: int, team: Team) -> Places:
        return Places(self, n, team)


class OnParticles(NamedTuple):
    """Smooth particles as printed, on a lattice that is displaced as the density at the start wants it."""
    name: str
    weight: Any = Lucy
    euler: bool = False
    first: float = 0.9

    def seconds(self, length: int) -> float:
        return 1.5 + (2e-3 if self.euler or self.weight is Monaghan else 0.0)*length**2

    def problem(self, length: int, seed: int) -> Problem:
        wave, x = Wave(length), lattice((length, BREADTH)).x
        T = 1 + wave.exactly(0.0, x[:, 0])[2]
        x[:, 0] -= AMPLITUDE/wave.k*np.sin(wave.k*x[:, 0])
        method = (Stepped if self.euler else Spam)(
            weight=self.weight.of(h=3.0), eos=IdealGas(), law=ConstEta(wave.eta, wave.eta), box=(length, BREADTH),
            walls=(*periodic(length), *periodic(BREADTH, axis=1)))
        first = np.array([*x.T, 0*T, 0*T, T])

        def residuals(state: np.ndarray) -> Residuals:
            return wave.compared(np.ones(state.shape[1]), state[0], state[2], state[4])
        limit = min(sound_limit(method, SOUND**2), RK4_TO_EULER*limit_of(method, first)) if self.euler else None
        return of_method(method, first, wave.time, residuals, limit=limit, known=KNOWN)


class OnMoving(NamedTuple):
    """Moving points, on a lattice."""
    name: str
    first: float = 0.9

    def seconds(self, length: int) -> float:
        return 0.3 + 2.7e-4*length**2

    def problem(self, length: int, seed: int) -> Problem:
        wave, x = Wave(length), lattice((length, BREADTH)).x
        method = Moving(weight=WendlandC2.of(h=3.0), eos=IdealGas(), law=ConstEta(wave.eta, wave.eta), box=(length, BREADTH),
                        walls=(*periodic(length), *periodic(BREADTH, axis=1)))
        rho, _, T = wave.exactly(0.0, x[:, 0])

        def residuals(state: np.ndarray) -> Residuals:
            px, py, m, V, total = state[EXCHANGED]
            return wave.compared(V, state[0], px/m, total/m - (px**2 + py**2)/(2*m**2))
        return of_method(method, method.state(x, 0*x, 1 + rho, 1 + T), wave.time, residuals, known=KNOWN)


POINTS = (OnPoints(names.NEAREST, 1.2), OnPoints(names.LATTICE, 2.0), OnPoints(names.WIDE, 3.0))
WEIGHTS = (OnPoints(names.LATTICE_MONAGHAN, 2.0, weight=Monaghan), OnPoints(names.LATTICE_WENDLAND, 2.0, weight=WendlandC2))
TWO_STEP = OnPoints(names.TWO_STEP, 2.0, euler=True)
IRREGULAR = OnPoints(names.JITTERED)
PARTICLES = (OnParticles(names.LUCY), OnParticles(names.MONAGHAN, Monaghan), OnParticles(names.WENDLAND, WendlandC2))
PARTICLES_TWO_STEP = OnParticles(names.LUCY_TWO_STEP, euler=True)
MOVING = OnMoving(names.MOVING)
