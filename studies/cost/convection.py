"""Methods in Rayleigh-Benard convection: points, smooth particles, the compressible grid, the MAC grid in time.

Of smooth particles K is that of the smoothed field, held against the grid's field smoothed alike.
"""
from collections.abc import Callable
from functools import partial
from typing import Any, NamedTuple

import numpy as np

from continuum.boussinesq import LAYER, Case, State, khp95
from continuum.boussinesq.mac import mac
from continuum.boussinesq.projection import CFL_LIMIT, Projection
from continuum.gas.fields import kinetic_energy
from continuum.scene import RayleighBenard
from particles.limits import limit_of
from particles.observe import fields_at
from particles.plan import Plan
from particles.run import run
from particles.smooth.spam import Spam
from studies.build import ready, variant
from studies.build.measure import Smoothing, smoothed_energy
from studies.build.names import START_ENERGY
from studies.build.spam import OF_LIMIT
from studies.build.unguarded import Unguarded
from studies.cost import layer
from studies.cost.contestants import projected
from studies.cost.layer import END, OFTEN, PR, RA, Followed, Rules, Sizes, reference, scene_of
from studies.cost.problem import Price, Problem, of_method


class OnPoints(NamedTuple):
    """Fixed points, or moving ones, whose K fluctuates: they are averaged from `late` on."""
    name: str
    method: str
    price: Price
    first: float = 0.9
    late: float = 0.0
    sizes: Sizes = Sizes()
    ra: float = RA

    def problem(self, rows: int, seed: int) -> Problem:
        """At a resolution."""
        scene = scene_of(rows, self.ra)
        made = ready(scene, self.method, seed)
        problem = followed(scene, made.method, made.start, variant(self.method).series["ke"])
        rules = Rules(reference(self.sizes, self.ra), self.late)
        return rules.judged(problem, lambda state: in_heights(scene, made.method.fields(state)))


class OnParticles(NamedTuple):
    """Smooth particles; K of the smoothed field."""
    name: str
    method: str
    price: Price = Price(4, 6.8e-4, 3)
    first: float = 2*OF_LIMIT
    sizes: Sizes = Sizes()

    def problem(self, rows: int, seed: int) -> Problem:
        """At a resolution."""
        scene, limit, chosen = scene_of(rows), reference(self.sizes), variant(self.method)
        made = ready(scene, self.method, seed)
        plain, smooth = smoothed_energy(limit.fields[1], Smoothing(chosen.weight, chosen.h, rows))
        rules = Rules(limit, layer.LATE, smooth/plain)
        return rules.judged(followed(scene, made.method, made.start, chosen.series["kg"]),
                            lambda state: in_heights(scene, smoothed(made.method, state)))


def smoothed(method: Spam, state: np.ndarray) -> Any:
    """The smoothed field where the particles are, each of which counts as much    [KHP95, Sec. VI]"""
    sums, ordered, _ = method.look(state)
    at, n = fields_at(sums, ordered, *state[:2]), state.shape[1]
    return method.fields(state)._replace(v=np.stack([at.vx, at.vy], axis=1), T=at.T, V=np.full(n, 1.0/n))


def in_heights(scene: RayleighBenard, fields: Any) -> Any:
    """Fields with places in heights."""
    return fields._replace(x=fields.x/scene.L)


def followed(scene: RayleighBenard, method: Any, first: np.ndarray, energy: Callable) -> Problem:
    """A method of the particles' time loop, with K on the way."""
    unit = scene.L/scene.free_fall

    def follow(state: np.ndarray, dt: float, steps: int) -> Followed:
        plan = Plan(dt=dt, steps=steps, series={"ke": energy}, every=max(1, round(unit/OFTEN/dt)))
        done = run(Unguarded(method), state, plan)
        # the rolls of the start
        times, ke = np.array([0.0, *done.times])/unit, np.array([START_ENERGY, *done.series["ke"]])
        return Followed(times, ke, done.by_id())
    return of_method(method, first, END*unit, lambda done: {})._replace(go=follow)


class OnGrid(NamedTuple):
    """The compressible grid in time."""
    name: str
    price: Price = Price(0.3, 7e-5, 3)
    first: float = 0.9
    sizes: Sizes = Sizes()
    ra: float = RA

    def problem(self, rows: int, seed: int) -> Problem:
        """At a resolution."""
        scene = scene_of(rows, self.ra)
        method, first, _ = ready(scene, "grid")
        unit, march = scene.L/scene.free_fall, method.march(first)

        def follow(S: np.ndarray, dt: float, steps: int) -> Followed:
            going, every = method.march(S, dt), max(1, round(unit/OFTEN/dt))
            t, ke = [0.0], [START_ENERGY]
            while going.steps < steps:
                going.go(min(every, steps - going.steps))
                t.append(going.t/unit)
                ke.append(kinetic_energy(going.S))
            return Followed(np.array(t), np.array(ke), going.S)
        problem = Problem(rows*round(scene.aspect*rows), first, limit_of(method, march.S), END*unit, follow,
                          lambda done: {}, lambda: (march.S, march.scratch), step=method.go)
        rules = Rules(reference(self.sizes, self.ra))
        return rules.judged(problem, lambda S: in_heights(scene, method.fields(S)))


class OnMac(NamedTuple):
    """The MAC grid in time, IMEX; the limit is that of advection with the free-fall velocity."""
    name: str
    price: Price = Price(0.5, 1.5e-4, 3)
    first: float = 0.9
    sizes: Sizes = Sizes()

    def problem(self, rows: int, seed: int) -> Problem:
        """At a resolution."""
        mac.cache_clear()       # what set-up takes is to be seen each time
        case = Case(ra=RA, pr=PR, box=LAYER, rows=rows)
        first = khp95(case, START_ENERGY).q
        made = Projection(case, first)
        problem = Problem(case.rows*case.columns, first, CFL_LIMIT/rows, END, partial(falling, case), lambda done: {},
                          lambda: (made,), step=partial(projected, case))
        return Rules(layer.boussinesq_reference(self.sizes)).judged(problem)


def falling(case: Case, q: np.ndarray, dt: float, steps: int) -> Followed:
    """The MAC grid with K on the way."""
    flow, every = Projection(case, q), max(1, round(1/OFTEN/dt))
    t, ke = [0.0], [START_ENERGY]
    for number in range(1, steps + 1):
        flow.advance(dt)
        if number % every == 0 or number == steps:
            t.append(number*dt)
            ke.append(State(case=case, q=flow.q).K)
            if not np.isfinite(ke[-1]):
                raise FloatingPointError(f"K is {ke[-1]} after {number} steps of {dt:.3g}")
    return Followed(np.array(t), np.array(ke), flow.q)
