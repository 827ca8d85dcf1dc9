"""Who takes part in Rayleigh-Benard convection: the compressible grid, fixed and moving points, smooth particles.

Of smooth particles K is that of the smoothed field, told against the grid's field smoothed alike.
"""
from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np

from continuum.fluid import temperature
from continuum.gas.fields import block, initial, kinetic_energy, node_densities, nodes
from continuum.gas.loop import VX, VY, E, FluxForm
from continuum.gas.solve import March, limits
from continuum.scene import RayleighBenard
from particles.integral.closed_faces import EXCHANGED
from particles.limits import limit_of
from particles.observe import field_kinetic, fields_at
from particles.run import Plan, run
from particles.threads import Team
from studies.build import fixed as dih
from studies.build import moving, ready, spam
from studies.build.names import START_ENERGY
from studies.build.smoothing import Smoothing, smoothed_energy
from studies.build.unguarded import Unguarded
from studies.cost import names
from studies.cost.layer_runs import LATE, LOWER_RA, OFTEN, RA, SETTLED, SIZES, Followed, Seen, problem_of, reference, scene_of
from studies.cost.problem import Problem, holding, plain


def sampled(method: Any, quantity: Callable, unit: float) -> Callable[[np.ndarray, float, int], Followed]:
    """`go` of a method of the particles' time loop, with K on the way."""
    def follow(first: np.ndarray, dt: float, steps: int) -> Followed:
        every = max(1, round(unit/OFTEN/dt))
        done = run(Unguarded(method), first, Plan(dt=dt, steps=steps, series={"ke": quantity}, every=every))
        # the rolls of the start
        return Followed(np.array([0.0, *done.times])/unit, np.array([START_ENERGY, *done.series["ke"]]), done.by_id())
    return follow


class OnFixed(NamedTuple):
    """Fixed points."""
    name: str
    scheme: dih.Scheme
    first: float = 0.9
    sizes: tuple[int, int, int] = SIZES
    dear: float = 2.2e-4        # seconds of a case over rows^3
    makes: float = 0.0          # the same of making points, over rows^2
    ra: float = RA

    def seconds(self, rows: int) -> float:
        return 1 + self.dear*rows**3 + self.makes*rows**2

    def problem(self, rows: int, seed: int) -> Problem:
        scene = scene_of(rows, self.ra)
        (method, first, _), unit = self.scheme.ready(scene, seed), scene.L/scene.free_fall

        def see(state: np.ndarray) -> Seen:
            v = (state[1:3]/state[0]).T
            T = temperature(scene.eos, state[0], state[3]/state[0] - (v**2).sum(axis=1)/2)
            return Seen(method.x/scene.L, v, T, method.edges.V)
        return problem_of(first.shape[1], first, limit_of(method, first), sampled(method, dih.kinetic, unit), plain(method),
                          holding(method, first), see, unit=unit, found=reference(self.sizes, self.ra))


class OnMoving(NamedTuple):
    """Moving points."""
    name: str
    first: float = 1.0
    sizes: tuple[int, int, int] = SIZES

    def seconds(self, rows: int) -> float:
        return 1 + 2.1e-3*rows**3

    def problem(self, rows: int, seed: int) -> Problem:
        scene = scene_of(rows)
        (method, first, _), unit = ready(scene, "moving", seed), scene.L/scene.free_fall

        def see(state: np.ndarray) -> Seen:
            px, py, m, V, total = state[EXCHANGED]
            v = np.stack([px, py], axis=1)/m[:, None]
            return Seen(state[:2].T/scene.L, v, temperature(scene.eos, m/V, total/m - (v**2).sum(axis=1)/2), V)
        return problem_of(first.shape[1], first, limit_of(method, first), sampled(method, moving.kinetic, unit), plain(method),
                          holding(method, first), see, unit=unit, late=SETTLED, found=reference(self.sizes))


class OnSpam(NamedTuple):
    """Smooth particles; K of the smoothed field."""
    name: str
    variant: spam.Variant
    first: float = 2*spam.OF_LIMIT
    sizes: tuple[int, int, int] = SIZES

    def seconds(self, rows: int) -> float:
        return 4 + 6.8e-4*rows**3

    def problem(self, rows: int, seed: int) -> Problem:
        scene, found = scene_of(rows), reference(self.sizes)
        (method, first, _), unit = self.variant.ready(scene, seed), scene.L/scene.free_fall
        plainly, smooth = smoothed_energy(found.fields[1], Smoothing(self.variant.weight, self.variant.h, rows))

        def see(state: np.ndarray) -> Seen:
            n = state.shape[1]
            sums, copy = method.start(n, Team(1)), state.copy()
            sums.around.relist(copy, np.arange(n), 0.0)
            sums.densities(copy)
            at = fields_at(sums, copy, *state[:2])
            return Seen(state[:2].T/scene.L, np.stack([at.vx, at.vy], axis=1), at.T, np.full(n, 1.0/n))
        return problem_of(first.shape[1], first, limit_of(method, first), sampled(method, field_kinetic, unit), plain(method),
                          holding(method, first), see, unit=unit, late=LATE, factor=smooth/plainly, found=found, firm=True)


class OnGrid(NamedTuple):
    """The compressible grid in time."""
    name: str
    first: float = 0.9
    sizes: tuple[int, int, int] = SIZES
    ra: float = RA

    def seconds(self, rows: int) -> float:
        return 0.3 + 7e-5*rows**3

    def problem(self, rows: int, seed: int) -> Problem:
        scene = scene_of(rows, self.ra)
        first, unit = block(initial(scene, rows, START_ENERGY)), scene.L/scene.free_fall

        def follow(S: np.ndarray, dt: float, steps: int) -> Followed:
            march, every = March(scene, S.copy(), FluxForm(), dt), max(1, round(unit/OFTEN/dt))
            t, ke = [0.0], [START_ENERGY]
            while march.steps < steps:
                march.go(min(every, steps - march.steps))
                t.append(march.t/unit)
                ke.append(kinetic_energy(march.S))
            return Followed(np.array(t), np.array(ke), march.S)

        def see(S: np.ndarray) -> Seen:
            """All nodes but those on the right side, which are those on the left."""
            x, y = nodes(scene, rows)
            X, Y = (q[:, :-1].ravel()/scene.L for q in np.meshgrid(x, y))
            rho, (vx, vy, e) = node_densities(S)[:, :-1], (S[f, 1:, 1:-1] for f in (VX, VY, E))
            V = np.ones_like(rho)
            V[[0, -1]] = 0.5
            return Seen(np.stack([X, Y], axis=1), np.stack([vx.ravel(), vy.ravel()], axis=1),
                        temperature(scene.eos, rho, e).ravel(), V.ravel())
        march = March(scene, first.copy(), FluxForm(), 1.0)
        return problem_of(rows*round(scene.aspect*rows), first, limits(scene, filled(scene, first)).both, follow,
                          lambda S, dt, steps: March(scene, S.copy(), FluxForm(), dt).go(steps),
                          lambda: (march.S, march.scratch), see, unit=unit, found=reference(self.sizes, self.ra))


def filled(scene: RayleighBenard, S: np.ndarray) -> np.ndarray:
    """A block with its ghosts."""
    march = March(scene, S.copy(), FluxForm(), 1.0)
    return march.S


GRID = OnGrid(names.GRID)
LATTICES = (OnFixed(names.NEAREST, dih.SCHEMES["fixed-lattice-h1.2"]), OnFixed(names.LATTICE, dih.SCHEMES["fixed-lattice"]),
            OnFixed(names.WIDE, dih.SCHEMES["fixed-lattice-h3"]))
JITTERED = OnFixed(names.JITTERED, dih.SCHEMES["fixed-jittered-plates"], dear=5.3e-4)
RELAXED = OnFixed(names.RELAXED, dih.SCHEMES["relaxed-plates"], dear=5.3e-4, makes=0.11)
PRINTED = OnSpam(names.LUCY, spam.PRINTED)
PARTICLES = (OnSpam(names.MONAGHAN, spam.VARIANTS["printed-monaghan"]), OnSpam(names.WENDLAND, spam.VARIANTS["wendland-c2"]),
             OnSpam(names.LESS_STATIC, spam.VARIANTS["less-static-50"]))
MOVING = OnMoving(names.MOVING)
#: the two that decide what fixed points cost, at half the Rayleigh number
GRID_LOWER, NEAREST_LOWER = GRID._replace(ra=LOWER_RA), LATTICES[0]._replace(ra=LOWER_RA)
