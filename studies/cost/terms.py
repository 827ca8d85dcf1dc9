"""Model only what a scene needs: what do heat, viscosity, noise, motion and compressibility cost, and who needs them?

The same flow with and without what it may need: CPU seconds of a point and step, bytes a point, compiled loops that an
evaluation calls, and the error that is made. taylor-green: a vortex at Mach 0.05, Re 100; velocity. convection:
Rayleigh-Benard at Ra 10 000; K at the end. What is left out as a term has no code that runs and no arrays; gravity,
viscosity and conductivity of the gas between plates are numbers, which may be zero and save nothing. The ideal gas with
everything has loops of its own, faster ones: what leaving out alone saves is seen in the loops that all fluids take.
"""
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from functools import partial
from math import ceil
from pathlib import Path
from typing import Any, ClassVar, NamedTuple

import numpy as np

from continuum.exact.vortex import SOUND, incompressible, solved, velocities
from continuum.fluid import IdealGas
from particles.integral.edge_makers import renormalised
from particles.integral.isothermal import Carried, ConstantFriction, Isothermal
from particles.integral.layer import edge_by_edge, quickest
from particles.integral.points import lattice
from particles.integral.thermal import Thermal
from particles.integrators import RK4
from particles.run import Run
from particles.threads import Team
from particles.weights import Lucy
from studies.build import fixed, ready
from studies.build.scenes import TaylorGreen
from studies.cost import names
from studies.cost.cases import CONTESTS
from studies.cost.convection import followed
from studies.cost.flows import Vortex
from studies.cost.layer import RA, USUAL, Rules, boussinesq_reference, reference, scene_of
from studies.cost.problem import Problem, holding, marching, of_method, plain, result, rms
from studies.cost.timing import SHORT, Timed, array_bytes, per_step
from studies.kit.case import Case, Outcome, Report

OF_LIMIT = 0.9
SIZE = {"taylor-green": 24, "convection": 16}       # spacings of a wavelength, rows
K_BOLTZMANN = 1e-12     # noise of 1e-6: a flow of 0.07 does not see it
H = 2.0
FLOW = Vortex()


class Watching(Team):
    """Remembers the compiled loops that are called, with the terms that they sum."""

    def __init__(self) -> None:
        super().__init__(1)
        self.called: set[str] = set()

    def __call__(self, function: Callable, rows: int, *arguments: Any) -> list:
        """As it would be without."""
        name = function.__name__.lstrip("_")
        self.called.add(f"{name} {word(arguments[0])}" if name == "sweep" else name)
        return super().__call__(function, rows, *arguments)


def word(term: Any) -> str:
    """A term with those that it lists."""
    inner = "+".join(word(one) for one in getattr(term, "terms", ()))
    return type(term).__name__ + (f"({inner})" if inner else "")


def loops(method: Any, first: np.ndarray) -> tuple[str, ...]:
    """Names of the loops that one evaluation calls."""
    n, team = first.shape[1], Watching()
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


# --- taylor-green -----------------------------------------------------------------------------------------------


def contestant(scene: str, name: str, size: int) -> Made:
    """A method of the contests, as it is."""
    problem = CONTESTS[scene][name].problem(size, 1)
    quantity = "velocity" if scene == "taylor-green" else "K"
    return Made(problem, quantity, loops(problem.held()[1].method, problem.first))


def with_method(problem: Problem, method: Any) -> Problem:
    """The same with another method of the same state."""
    return problem._replace(go=marching(method), step=plain(method), held=holding(method, problem.first))


def gas_alike(size: int) -> Made:
    """Fixed points in the loops that all fluids take, as what leaves a term out does, not in the ideal gas's own."""
    problem = CONTESTS["taylor-green"][names.LATTICE].problem(size, 1)
    method = replace(problem.held()[1].method, form=edge_by_edge)
    return Made(with_method(problem, method), "velocity", loops(method, problem.first))


def in_vortex(scene: TaylorGreen, method: Any, first: np.ndarray) -> Problem:
    """A method of fixed points whose state begins with density and momentum."""
    points = lattice((scene.L, scene.L))

    def residuals(state: np.ndarray) -> dict[str, np.ndarray]:
        exact = velocities(solved(scene.mach), points.x/scene.L)
        return FLOW.against(scene, points.V, exact, (state[1:3]/state[0]).T)
    return of_method(method, first, scene.time, residuals)


def listed(size: int, kinds: tuple = (Carried, ConstantFriction)) -> Made:
    """Fixed points without heat; terms by kind."""
    scene, points = FLOW.scene(size), lattice((size, size))
    terms = tuple(kind(SOUND**2 if kind is Carried else scene.eta) for kind in kinds)
    method = Isothermal(x=points.x, edges=renormalised(points, Lucy.of(h=H)), terms=terms)
    density, v, _ = scene.fields(points.x)
    rho = 1 + (density**2 - 1)/SOUND**2        # the same pressure
    first = np.array([rho, *(rho[:, None]*v).T])
    return Made(in_vortex(scene, method, first), "velocity", loops(method, first))


def noisy(size: int, k: float = K_BOLTZMANN) -> Made:
    """The readable sums with noise."""
    scene = FLOW.scene(size)
    still, first, _ = ready(scene, "fixed-lattice")
    method = Thermal(edges=still.edges, eos=IdealGas(), law=scene.law, k=k, seed=1, share=1.0)
    problem = in_vortex(scene, method, first)._replace(firm=True)
    return Made(problem, "velocity", loops(method, first))


def silent(size: int) -> Made:
    """The same sums without noise, in four stages."""
    problem = noisy(size).problem
    quiet, first = problem.held()[1].method.dih, problem.first

    def go(state: np.ndarray, dt: float, steps: int) -> np.ndarray:
        integrator, now = RK4(state.shape, Team(1)), state.copy()
        for _ in range(steps):
            integrator.step(quiet, now, dt)
        return now
    return Made(problem._replace(go=go, step=None, held=lambda: (first, quiet, RK4(first.shape, Team(1)))), "velocity")


def without_sound(size: int) -> Made:
    """The MAC grid; its height, half of the wavelength, over its velocity is the unit of time."""
    scene, place = FLOW.scene(size), lattice((size, size)).x/size
    flow = incompressible(place)
    apart = rms(velocities(solved(FLOW.mach), place) - flow)/rms(flow)
    problem = CONTESTS["taylor-green"][names.MAC_IMEX].problem(size, 1)
    return Made(problem, "velocity", (), size/2/scene.speed, apart)


# --- convection -------------------------------------------------------------------------------------------------


def layer(rows: int, form: Callable = quickest, g: float = 1.0, scheme: str = "fixed-lattice", **law: float) -> Made:
    """A lattice between plates; `law`, `g`: of the fluid's numbers; `form`: of its loops."""
    scene = scene_of(rows, RA)
    made = ready(scene, scheme)
    changed = replace(made.method, law=made.method.law._replace(**law), g=g*made.method.g, form=form)
    problem = followed(scene, changed, made.start, fixed.kinetic)
    return Made(Rules(reference(USUAL, RA)).judged(problem), "K", loops(changed, made.start))


def without_mending(rows: int) -> Made:
    """Heating is the work of forces along edges, as printed."""
    return layer(rows, scheme="fixed-lattice-printed-heat")


def boussinesq_layer(rows: int) -> Made:
    """The MAC grid at the Prandtl number that is nearest; half of its K is what a Boussinesq fluid says of the gas."""
    apart = boussinesq_reference().ke/2/reference().ke - 1
    problem = CONTESTS["convection-boussinesq"][names.MAC_IMEX].problem(rows, 1)
    return Made(problem, "K", (), float(rows), abs(apart))


GAS = partial(contestant, "taylor-green", names.LATTICE)
COLD = listed
#: scene, base -> what is left out -> what is left
BASES: dict[tuple[str, str], dict[str, Callable[[int], Made]]] = {
    ("taylor-green", "moving points"): {
        "nothing": partial(contestant, "taylor-green", names.MOVING), "motion": GAS},
    ("taylor-green", "fixed points"): {"nothing": GAS, "heat": COLD, "compressibility": without_sound},
    ("taylor-green", "fixed points, loops of all fluids"): {"nothing": gas_alike, "heat": COLD},
    ("taylor-green", "fixed points without heat"): {"nothing": COLD, "viscosity": partial(listed, kinds=(Carried,))},
    ("taylor-green", "fixed points with noise"): {"nothing": noisy, "noise": silent},
    ("convection", "moving points"): {
        "nothing": partial(contestant, "convection", names.MOVING),
        "motion": partial(contestant, "convection", names.LATTICE)},
    ("convection", "fixed points"): {
        "nothing": layer, "gravity": partial(layer, g=0.0), "heat conduction": partial(layer, k=0.0),
        "viscosity": partial(layer, eta=0.0), "mended heating": without_mending, "compressibility": boussinesq_layer},
    ("convection", "fixed points, loops of all fluids"): {
        "nothing": partial(layer, form=edge_by_edge), "mended heating": without_mending},
}


# --- cases ------------------------------------------------------------------------------------------------------


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
            changed = change(residual, whole, left_out != "motion") if made.model is None else made.model
            yield {"scene": self.scene, "base": self.base, "left_out": left_out, **row, "changed": changed}
            report((number + 1)/len(kinds))


def change(residual: np.ndarray, whole: np.ndarray, same_places: bool) -> float:
    """What leaving out changes of the answer; between points in other places what it adds to the error."""
    return rms(residual - whole) if same_places else max(0.0, rms(residual) - rms(whole))


def measured(made: Made, short: float) -> tuple[dict[str, Any], np.ndarray]:
    """Columns of the table, and the residual of the main quantity; not a number where the run diverged."""
    problem, n = made.problem, made.problem.points
    steps = ceil(problem.time/(OF_LIMIT*problem.limit))
    dt, done = problem.time/steps, result(problem, OF_LIMIT)
    if done is None:       # what diverges may do so while its steps are timed
        residual, seconds = np.array([np.nan]), Timed(np.nan, np.nan)
    else:
        residual = done.residuals[made.quantity]
        seconds = per_step(lambda count: (problem.step or problem.go)(problem.first, dt, count), short)
    unit = n*dt*made.factor
    row = {"quantity": made.quantity, "points": n, "step_s": seconds.value/n, "step_s_err": seconds.err/n,
           "time_s": seconds.value/unit, "time_s_err": seconds.err/unit, "bytes": array_bytes(problem.held())/n,
           "loops": len(made.called), "names": "; ".join(made.called), "error": rms(residual),
           "error_err": problem.known}
    return row, residual


def cases(size: str) -> list[Case]:
    """`quick` has two of the bases, timed shortly; `paper` takes two minutes."""
    if size == "quick":
        few = (("taylor-green", "fixed points without heat"), ("convection", "fixed points"))
        return [Compared(scene=scene, base=base, size=12, short=0.001) for scene, base in few]
    return [Compared(scene=scene, base=base, size=SIZE[scene]) for scene, base in BASES]
