"""The same flow with and without what it may need: cost, memory, compiled loops and the error that is made.

taylor-green: a vortex at Mach 0.05, Re 100; velocity. convection: Rayleigh-Benard at Ra 10 000, K at the end.
What is left out as a term has no code that runs and no arrays; gravity, viscosity and conductivity of the gas between plates are
numbers, which may be zero and save nothing. The ideal gas with everything has loops of its own, faster ones: what leaving out
alone saves is told by the base in the loops that all fluids take.
"""
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from functools import partial
from math import ceil
from pathlib import Path
from typing import Any, ClassVar, NamedTuple

import numpy as np

from continuum.exact.vortex import SOUND, Vortex, solved, velocities
from continuum.exact.vortex import incompressible as exactly_incompressible
from continuum.fluid import ConstEta, IdealGas
from particles.integral.dih import Dih
from particles.integral.edge_makers import renormalised
from particles.integral.points import lattice
from particles.integral.thermal import Thermal
from particles.integrators import RK4
from particles.limits import limit_of
from particles.run import Run
from particles.threads import Team
from particles.weights import Lucy
from studies.build import fixed as dih
from studies.build.vortex import fluid, start
from studies.cost import convection, names, others
from studies.cost import layer_runs as convection_rules
from studies.cost import vortex as vortices
from studies.cost.problem import Problem, holding, marching, of_method, plain, result, rms
from studies.cost.scenes.terms import Carried, Friction, Listed
from studies.cost.timing import SHORT, Timed, array_bytes, per_step
from studies.kit.case import Case, Outcome, Report

OF_LIMIT = 0.9
SIZE = {"taylor-green": 24, "convection": 16}       # spacings of a wavelength, rows
K_BOLTZMANN = 1e-12     # noise of 1e-6: a flow of 0.07 does not see it
H = 2.0


class Watching(Team):
    """Remembers the compiled loops that are called, with the terms that they sum."""

    def __init__(self) -> None:
        super().__init__(1)
        self.called: set[str] = set()

    def __call__(self, function: Callable, rows: int, *arguments: Any) -> list:
        """As it would be without."""
        self.called.add(" ".join([function.__name__.lstrip("_"), *(word(arguments[0]),)*(function.__name__ == "sweep")]))
        return super().__call__(function, rows, *arguments)


def word(term: Any) -> str:
    """A term with those that it lists."""
    inner = getattr(term, "terms", ())
    return type(term).__name__ + (f"({'+'.join(map(word, inner))})" if inner else "")


def loops(method: Any, first: np.ndarray) -> tuple[str, ...]:
    """Names of what one evaluation calls."""
    team, n = Watching(), first.shape[1]
    sums, now = method.start(n, team), Run(state=first.copy(), ids=np.arange(n))
    sums.make_ready(now, 1e-9)
    sums.try_out(now)
    return tuple(sorted(team.called))


class Made(NamedTuple):
    """A problem, its main quantity, the loops that it calls, what its units of time are in those of its base.

    model : what another fluid alone changes of the quantity, where that is known without any grid.
    """
    problem: Problem
    quantity: str
    called: tuple[str, ...] = ()
    factor: float = 1.0
    model: float | None = None


# --- taylor-green -------------------------------------------------------------------------------------------------------


def gas(size: int) -> Made:
    """Fixed points with heat."""
    problem = vortices.OnPoints(names.LATTICE, H).problem(size, 1)
    return Made(problem, "velocity", loops(problem.held()[1].method, problem.first))


def gas_alike(size: int) -> Made:
    """The same in the loops that all fluids take, as what leaves a term out does, in place of the ideal gas's own."""
    problem = vortices.OnPoints(names.LATTICE, H).problem(size, 1)
    method = replace(problem.held()[1].method, fast=False)
    problem = problem._replace(go=marching(method), step=plain(method), held=holding(method, problem.first))
    return Made(problem, "velocity", loops(method, problem.first))


def moving(size: int) -> Made:
    """The same gas on points that move."""
    problem = vortices.MOVING.problem(size, 1)
    return Made(problem, "velocity", loops(problem.held()[1].method, problem.first))


def listed(size: int, *kinds: Any) -> Made:
    """Fixed points without heat; terms by kind."""
    vortex, points = Vortex(vortices.MACH, size), lattice((size, size))
    method = Listed(x=points.x, edges=renormalised(points, Lucy.of(h=H)),
                    terms=tuple(kind(SOUND**2 if kind is Carried else vortex.eta) for kind in kinds))
    rho = 1 + (vortex.density(points.x)**2 - 1)/SOUND**2        # the same pressure
    first = np.array([rho, *(rho[:, None]*vortex.velocity(points.x)).T])
    problem = of_method(method, first, vortex.time, lambda state: vortices.compared(
        vortex, points.V, points.x, (state[1:3]/state[0]).T))
    return Made(problem, "velocity", loops(method, first))


def noisy(size: int, k: float = K_BOLTZMANN) -> Made:
    """The readable sums with noise."""
    vortex, points = Vortex(vortices.MACH, size), lattice((size, size))
    edges = renormalised(points, Lucy.of(h=H))
    method = Thermal(edges=edges, eos=IdealGas(), law=ConstEta(vortex.eta, vortex.eta), k=k, seed=1, share=1.0)
    first = start(vortex, fluid(vortex, points, edges))
    problem = of_method(method, first, vortex.time, lambda state: vortices.compared(
        vortex, points.V, points.x, (state[1:3]/state[0]).T), limit=limit_of(method, first))
    return Made(problem, "velocity", loops(method, first))


def silent(size: int) -> Made:
    """The same sums without noise, in four stages."""
    with_noise = noisy(size).problem
    method = with_noise.held()[1].method
    quiet: Dih = method.dih

    def go(state: np.ndarray, dt: float, steps: int) -> np.ndarray:
        integrator, now = RK4(state.shape, Team(1)), state.copy()
        for _ in range(steps):
            integrator.step(quiet, now, dt)
        return now
    problem = with_noise._replace(go=go, step=None, held=lambda: (with_noise.first, quiet, RK4(with_noise.first.shape, Team(1))))
    return Made(problem, "velocity")


def incompressible(size: int) -> Made:
    """The MAC grid; its height, half of the wavelength, over its velocity is the unit of time."""
    vortex, place = Vortex(vortices.MACH, size), lattice((size, size)).x/size
    flow = exactly_incompressible(place)
    apart = rms(velocities(solved(vortices.MACH), place) - flow)/rms(flow)
    return Made(vortices.MAC.problem(size, 1), "velocity", (), size/2/vortex.speed, apart)


# --- convection ---------------------------------------------------------------------------------------------------------


def layer(rows: int, mended: bool = True, fast: bool = True, **changes: Any) -> Made:
    """A lattice between plates; `changes`: numbers of the fluid that are set to zero; not `fast`: in the loops of all fluids."""
    contestant = convection.LATTICES[1]
    problem = contestant._replace(scheme=contestant.scheme._replace(mended=mended)).problem(rows, 1)
    method = problem.held()[1].method
    if changes or not fast:
        law = method.law._replace(**{name: value for name, value in changes.items() if name != "g"})
        method = replace(method, law=law, g=changes.get("g", method.g), fast=fast)
        unit = problem.time/convection_rules.END
        problem = problem._replace(limit=limit_of(method, problem.first), go=convection.sampled(method, dih.kinetic, unit),
                                   step=plain(method), held=holding(method, problem.first))
    return Made(problem, "K", loops(method, problem.first))


def moving_layer(rows: int) -> Made:
    """The same on points that move."""
    problem = convection.MOVING.problem(rows, 1)
    return Made(problem, "K", loops(problem.held()[1].method, problem.first))


def boussinesq_layer(rows: int) -> Made:
    """The MAC grid at the Prandtl number that is nearest; half of its K is what a Boussinesq fluid says of the gas."""
    apart = others.boussinesq_reference().ke/2/convection_rules.reference().ke - 1
    return Made(others.OnMac().problem(rows, 1), "K", (), float(rows), abs(apart))


def cold(size: int) -> Made:
    """Without heat."""
    return listed(size, Carried, Friction)


def without_friction(size: int) -> Made:
    """Without heat and viscosity."""
    return listed(size, Carried)


#: scene, base -> what is left out -> what is left
BASES: dict[tuple[str, str], dict[str, Callable[[int], Made]]] = {
    ("taylor-green", "moving points"): {"nothing": moving, "motion": gas},
    ("taylor-green", "fixed points"): {"nothing": gas, "heat": cold, "compressibility": incompressible},
    ("taylor-green", "fixed points, loops of all fluids"): {"nothing": gas_alike, "heat": cold},
    ("taylor-green", "fixed points without heat"): {"nothing": cold, "viscosity": without_friction},
    ("taylor-green", "fixed points with noise"): {"nothing": noisy, "noise": silent},
    ("convection", "moving points"): {"nothing": moving_layer, "motion": layer},
    ("convection", "fixed points"): {
        "nothing": layer, "gravity": partial(layer, g=0.0), "heat conduction": partial(layer, k=0.0),
        "viscosity": partial(layer, eta=0.0), "mended heating": partial(layer, mended=False),
        "compressibility": boussinesq_layer},
    ("convection", "fixed points, loops of all fluids"): {
        "nothing": partial(layer, fast=False), "mended heating": partial(layer, mended=False)},
}


@dataclass(frozen=True, kw_only=True)
class Compared(Case):
    """One base with everything, and without each of what may be left out, one after the other."""
    scene: str
    base: str
    size: int
    short: float = SHORT
    alone: ClassVar[bool] = True

    @property
    def cost(self) -> float:
        return 0.05*self.size**2

    @property
    def label(self) -> str:
        return f"{self.scene}, {self.base}, {self.size} spacings"

    def run(self, report: Report, folder: Path) -> Outcome:
        return Outcome({"measured": list(self._rows(report))})

    def _rows(self, report: Report) -> Iterator[dict[str, Any]]:
        kinds, whole = BASES[self.scene, self.base], np.empty(0)
        for number, (left_out, make) in enumerate(kinds.items()):
            made = make(self.size)
            row, residual = measured(made, self.short)
            whole = residual if number == 0 else whole
            changed = made.model if made.model is not None else change(residual, whole, left_out != "motion")
            yield {"scene": self.scene, "base": self.base, "left_out": left_out, **row, "changed": changed}
            report((number + 1)/len(kinds))


def change(residual: np.ndarray, whole: np.ndarray, same_places: bool) -> float:
    """What leaving out changes of the answer; between points in other places what it adds to the error."""
    return rms(residual - whole) if same_places else max(0.0, rms(residual) - rms(whole))


def measured(made: Made, short: float) -> tuple[dict[str, Any], np.ndarray]:
    """Columns of the table, and the residual of the main quantity; not a number where the run diverged."""
    problem, n = made.problem, made.problem.points
    steps = ceil(problem.time/(OF_LIMIT*problem.limit))
    dt, found = problem.time/steps, result(problem, OF_LIMIT)
    if found is None:       # what diverges may do so while its steps are timed
        residual, seconds = np.array([np.nan]), Timed(*[np.nan]*4)
    else:
        residual = found.residuals[made.quantity]
        seconds = per_step(lambda count: (problem.step or problem.go)(problem.first, dt, count), short)
    row = {"quantity": made.quantity, "points": n, "step_s": seconds.value/n, "step_s_err": seconds.err/n,
           "time_s": seconds.value/(n*dt*made.factor), "time_s_err": seconds.err/(n*dt*made.factor),
           "bytes": array_bytes(problem.held())/n, "loops": len(made.called), "names": "; ".join(made.called),
           "error": rms(residual), "error_err": problem.known}
    return row, residual
