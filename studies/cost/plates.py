"""Who takes part between plates: heat that spreads, and shear that settles into Couette flow, from smooth starts.

Nothing depends on x. The plates' temperature is 1; the upper one slides with U in Couette flow. Lengths in spacings.
"""
from dataclasses import dataclass
from functools import cache
from typing import Any, NamedTuple

import numpy as np

from continuum.exact.plates import COARSER, FLOWS, MU, Flow, fields
from continuum.fluid import ConstEta, IdealGas, energy
from continuum.gas.fields import Fields, Values, block, nodes
from continuum.gas.loop import VX, E, FluxForm
from continuum.gas.solve import March, limits
from continuum.scene import Periodic
from particles.integral.bodies import held, together, with_plates
from particles.integral.closed_faces import EXCHANGED, Moving
from particles.integral.driven import Driven
from particles.integral.edge_makers import renormalised
from particles.integral.edges import between_plates
from particles.integral.points import jittered, lattice
from particles.integral.stream import Stream
from particles.integral.triangulation import between
from particles.smooth.spam import Spam
from particles.walls.mirror import plates
from particles.walls.periodic import periodic
from particles.walls.sliding_plate import Sliding
from particles.weights import Lucy, Monaghan, WendlandC2
from studies.cost import names
from studies.cost.problem import Problem, Residuals, of_method

COLUMNS = 8         # of points: wider than twice a range of three spacings
JITTER = 0.2


@cache
def known(flow: Flow) -> float:
    """Uncertainty of the exact answer: what fewer Chebyshev points make of the velocity along the plates or the temperature."""
    s = np.linspace(0, 1, 200)
    row = 2 if flow.U else 3
    fine, coarse = (fields(flow, s, *degree)[row] for degree in ((), (COARSER,)))
    return float(np.sqrt(np.mean((fine - coarse)**2)/np.mean((fine - fine.mean())**2)))


def compared(flow: Flow, V: np.ndarray, s: np.ndarray, u: np.ndarray, T: np.ndarray) -> Residuals:
    """Velocity along the plates relative to its rms, or temperature to the rms of what differs from that of the plates."""
    _, _, exact_u, exact_T = fields(flow, s)
    w = np.sqrt(len(V)*V/V.sum())
    if flow.U:
        return {"velocity": w*(u - exact_u)/np.sqrt(np.mean(w**2*exact_u**2))}
    return {"temperature": w*(T - exact_T)/np.sqrt(np.mean(w**2*(exact_T - 1)**2))}


def law(rows: int) -> ConstEta:
    """The same fluid at every resolution: heights are so many spacings."""
    return ConstEta(MU*rows, MU*rows)


class OnLattice(NamedTuple):
    """Fixed points of a lattice between mirror images, a weight of range h."""
    name: str
    flow: Flow
    h: float
    first: float = 0.9

    def seconds(self, rows: int) -> float:
        return 0.5 + 7e-5*rows**2

    def problem(self, rows: int, seed: int) -> Problem:
        x = lattice((COLUMNS, rows)).x
        edges, beyond = between_plates(renormalised, x, COLUMNS, rows, Lucy.of(h=self.h))
        method = Driven(x=x, edges=edges, beyond=beyond, eos=IdealGas(), law=law(rows), T_plates=(1.0, 1.0), g=0.0,
                        slide=(0.0, self.flow.U))
        return on_points(self.flow, rows, method)


class OnTriangles(NamedTuple):
    """Jittered points with Delaunay edges that end on rows of points on the plates."""
    name: str
    flow: Flow
    first: float = 0.9

    def seconds(self, rows: int) -> float:
        return 0.5 + 7e-5*rows**2

    def problem(self, rows: int, seed: int) -> Problem:
        x, lower, upper = with_plates(jittered((COLUMNS, rows - 1), JITTER, seed).x, COLUMNS, rows)
        both = together(held(lower, T=1.0), held(upper, (self.flow.U, 0.0), T=1.0))
        return on_points(self.flow, rows, Stream(x=x, edges=between(x, COLUMNS, rows), eos=IdealGas(), law=law(rows), held=both))


def on_points(flow: Flow, rows: int, method: Any) -> Problem:
    """What both share."""
    s = method.x[:, 1]/rows + 0.5
    rho, v, u, T = flow.start(s)

    def residuals(state: np.ndarray) -> Residuals:
        v = state[1:3]/state[0]
        return compared(flow, method.edges.V, s, v[0], state[3]/state[0] - (v**2).sum(axis=0)/2)
    return of_method(method, method.state(rho, np.stack([u, v], axis=1), T), flow.time*rows, residuals, known=known(flow))


class OnMoving(NamedTuple):
    """Moving points, from a jittered lattice; their plates do not slide."""
    name: str
    flow: Flow
    first: float = 0.9

    def seconds(self, rows: int) -> float:
        return 0.3 + 1.3e-4*rows**2

    def problem(self, rows: int, seed: int) -> Problem:
        x = jittered((COLUMNS, rows), JITTER, seed).x
        x[:, 1] = np.clip(x[:, 1], 0.25 - rows/2, rows/2 - 0.25)
        method = Moving(weight=WendlandC2.of(h=3.0), eos=IdealGas(), law=law(rows), box=(COLUMNS, rows),
                        walls=(*plates(rows, 1.0, 1.0), *periodic(COLUMNS)))
        rho, _, _, T = self.flow.start(x[:, 1]/rows + 0.5)

        def residuals(state: np.ndarray) -> Residuals:
            px, py, m, V, total = state[EXCHANGED]
            return compared(self.flow, V, state[1]/rows + 0.5, px/m, total/m - (px**2 + py**2)/(2*m**2))
        return of_method(method, method.state(x, 0*x, rho, T), self.flow.time*rows, residuals, known=known(self.flow))


# --- smooth particles -------------------------------------------------------------------------------------------------


class OnParticles(NamedTuple):
    """Smooth particles as printed, on a lattice whose rows are as far apart as the density at the start wants them."""
    name: str
    flow: Flow
    weight: Any = Lucy
    first: float = 0.7

    def seconds(self, rows: int) -> float:
        return 1.7

    def problem(self, rows: int, seed: int) -> Problem:
        x = lattice((COLUMNS, rows)).x
        x[:, 1] = rows*(spread(self.flow, rows)[np.round(x[:, 1] + rows/2 - 0.5).astype(int)] - 0.5)
        lower, upper = plates(rows, 1.0, 1.0)
        method = Spam(weight=self.weight.of(h=3.0), eos=IdealGas(), law=law(rows), box=(COLUMNS, rows),
                      walls=(lower, Sliding(upper, self.flow.U), *periodic(COLUMNS)))
        _, _, u, T = self.flow.start(x[:, 1]/rows + 0.5)
        first = np.array([*x.T, u, 0*u, T])

        def residuals(state: np.ndarray) -> Residuals:
            return compared(self.flow, np.ones(state.shape[1]), state[1]/rows + 0.5, state[2], state[4])
        return of_method(method, first, self.flow.time*rows, residuals, known=known(self.flow), chaotic=True)


def spread(flow: Flow, rows: int) -> np.ndarray:
    """Heights (rows,) between which the mass of a row lies at the start."""
    s = np.linspace(0, 1, 2001)
    rho = flow.start(s)[0]
    mass = np.r_[0, np.cumsum((rho[1:] + rho[:-1])/2*np.diff(s))]
    return np.interp((np.arange(rows) + 0.5)/rows*mass[-1], mass, s)


# --- the compressible grid --------------------------------------------------------------------------------------------


@dataclass(frozen=True, kw_only=True)
class Slab:
    """What the grid's march asks of a scene: plates of equal temperature, periodic sides, no gravity."""
    rows: int
    T_hot: float = 1.0
    T_cold: float = 1.0
    g: float = 0.0
    sides: Any = Periodic()  # noqa: RUF009 (immutable)
    eos: Any = IdealGas()  # noqa: RUF009

    @property
    def L(self) -> float:
        return float(self.rows)

    @property
    def width(self) -> float:
        return float(COLUMNS)

    @property
    def aspect(self) -> float:
        return COLUMNS/self.rows

    @property
    def law(self) -> ConstEta:
        return law(self.rows)


class OnGrid(NamedTuple):
    """The compressible grid in time; a plate slides where its nodes, which never change, have a velocity."""
    name: str
    flow: Flow
    first: float = 0.9

    def seconds(self, rows: int) -> float:
        return 0.5 + 7e-5*rows**2

    def problem(self, rows: int, seed: int) -> Problem:
        scene = Slab(rows=rows)
        first = self._block(scene)

        def go(S: np.ndarray, dt: float, steps: int) -> np.ndarray:
            march = March(scene, S.copy(), FluxForm(), dt)
            march.go(steps)
            return march.S

        def residuals(S: np.ndarray) -> Residuals:
            s, V = np.linspace(0, 1, rows + 1), np.ones(rows + 1)
            V[[0, -1]] = 0.5
            return compared(self.flow, V, s, S[VX, 1:, 1], S[E, 1:, 1])
        march = March(scene, first.copy(), FluxForm(), 1.0)
        return Problem(rows*COLUMNS, first, limits(scene, march.S).both, self.flow.time*rows, go, residuals,
                       lambda: (march.S, march.scratch), known(self.flow))

    def _block(self, scene: Slab) -> np.ndarray:
        """The start; densities in cells are those of their middle, their mean made 1."""
        x, y = nodes(scene, scene.rows)
        _, v, u, T = (np.tile(q[:, None], len(x)) for q in self.flow.start(y/scene.L + 0.5))
        rho = self.flow.start((np.arange(scene.rows) + 0.5)/scene.rows)[0]
        cells = np.tile((rho/rho.mean())[:, None], len(x) - 1)
        at = Values(u, v, energy(scene.eos, 1.0, T), T, np.ones_like(T))
        S = block(Fields(scene, x, y, at, cells))
        S[VX, -1] = self.flow.U
        return S


def contestants(flow: Flow) -> dict[str, Any]:
    """By name."""
    made: list[Any] = [OnGrid(names.GRID, flow), OnLattice(names.NEAREST, flow, 1.2), OnLattice(names.LATTICE, flow, 2.0),
                       OnLattice(names.WIDE, flow, 3.0), OnTriangles(names.JITTERED, flow), OnParticles(names.LUCY, flow),
                       OnParticles(names.MONAGHAN, flow, Monaghan), OnParticles(names.WENDLAND, flow, WendlandC2)]
    return {one.name: one for one in made + [OnMoving(names.MOVING, flow)]*(not flow.U)}


CONTESTANTS = {name: contestants(flow) for name, flow in FLOWS.items()}
