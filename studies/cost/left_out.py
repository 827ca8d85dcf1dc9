"""Model only what a scene needs: what do noise, motion and compressibility cost, and who needs them?

The same flow with and without what it may need: CPU seconds of a point and step, bytes a point, the error
that is made of the velocity of a vortex at Mach 0.05 or K of convection at Ra 10 000. What is left out has no
code that runs and no arrays. The ideal gas with everything has faster loops of its own: what leaving out
alone saves is seen in the loops that all fluids take.
"""
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path
from typing import Any, ClassVar, NamedTuple

import numpy as np

from continuum.exact.vortex import incompressible, solved, velocities
from continuum.fluid import IdealGas
from particles.integral.layer import LayerSums
from particles.integral.points import lattice
from particles.integral.thermal import Thermal
from particles.integrators import RK4
from particles.threads import Threads
from studies.build.fixed import SCHEMES, Scheme, kinetic
from studies.build.moving import CARRIAGES, MOTIONS
from studies.build.scenes import TaylorGreen
from studies.cost.contestants import ExactFlow, carried, on_mac, points
from studies.cost.problem import Problem, of_method, rms
from studies.cost.rolls import HeatedLayer, in_time
from studies.cost.seconds import SHORT, array_bytes, per_step, stepped
from studies.kit.case import Case, Outcome, Report
from studies.kit.stats import Measured, with_errors

OF_LIMIT = 0.9
K_BOLTZMANN = 1e-12     # noise of 1e-6: a flow of 0.07 does not see it
FLOW, LAYER = ExactFlow(TaylorGreen(L=16)), HeatedLayer()
NO_TIME = Measured(np.nan, np.nan)      # what diverges may do so while its steps are timed
LATTICE = SCHEMES["fixed-lattice"]


def difference(part: np.ndarray, whole: np.ndarray) -> float:
    """What leaving out changes of the answer."""
    return rms(part - whole)


def excess(part: np.ndarray, whole: np.ndarray) -> float:
    """Between points in other places: what it adds to the error."""
    return float(np.maximum(0.0, rms(part) - rms(whole)))


class Reduced(NamedTuple):
    """What is left. change(its residual, that of the whole). unit : of its time, in that of the whole."""
    problem: Problem
    change: Callable[[np.ndarray, np.ndarray], float] = difference
    unit: float = 1.0


# --- taylor-green -------------------------------------------------------------------------------------------


def vortex_moving(size: int) -> Reduced:
    """Points that move."""
    return Reduced(points(FLOW, MOTIONS["moving"], size, 1))


def vortex_carried(size: int) -> Reduced:
    """Points that move with their triangulation."""
    return Reduced(carried(FLOW, CARRIAGES["moving-delaunay"], size, 1))


def vortex_without_motion(size: int) -> Reduced:
    """A lattice, elsewhere than the points that move."""
    return vortex(size)._replace(change=excess)


def vortex(size: int) -> Reduced:
    """A lattice."""
    return Reduced(points(FLOW, LATTICE, size, 1))


def vortex_with_noise(size: int) -> Reduced:
    """The readable sums with noise."""
    scene = FLOW.scene(size)
    still, start, _ = LATTICE.ready(scene)
    method = Thermal(edges=still.edges, eos=IdealGas(), law=scene.law, k=K_BOLTZMANN, seed=1, share=1.0)
    return on_square(size, method, start)


def on_square(size: int, method: Any, start: np.ndarray) -> Reduced:
    """A method on a lattice; edges alone know no places."""
    scene, x = FLOW.scene(size), lattice((size, size)).x

    judge = FLOW.judge(scene, lambda state: method.fields(state)._replace(x=x))
    return Reduced(of_method(method, start, scene.time, judge))


def vortex_without_noise(size: int) -> Reduced:
    """The same sums, in four stages."""
    problem = vortex_with_noise(size).problem
    _, sums, _ = problem.held()
    silent, integrator = sums.dih, RK4(problem.start.shape, Threads(1))
    held = problem.start, silent, integrator
    return Reduced(problem._replace(go=partial(stepped, silent), held=lambda: held))


def vortex_without_sound(size: int) -> Reduced:
    """The MAC grid; its height, half of the wavelength, over its velocity is the unit of time.

    What another fluid changes of the answer is known without any grid.
    """
    scene, place = FLOW.scene(size), lattice((size, size)).x/size
    flow = incompressible(place)
    known = rms(velocities(solved(scene.mach), place) - flow)/rms(flow)
    return Reduced(on_mac(FLOW, None, size, 1), lambda part, whole: known, size/2/scene.speed)


# --- convection ---------------------------------------------------------------------------------------------


def layer(rows: int, scheme: Scheme = LATTICE, form: type[LayerSums] | None = None) -> Reduced:
    """A lattice between plates. form : of its loops."""
    scene = LAYER.scene(rows)
    ready = scheme.ready(scene)
    method = replace(ready.method, form=form)
    return Reduced(in_time(LAYER, scene, ready._replace(method=method), kinetic, method.fields))


def layer_edge_by_edge(rows: int) -> Reduced:
    """In the loops that all fluids take."""
    return layer(rows, form=LayerSums)


def layer_without_mending(rows: int) -> Reduced:
    """Heating is the work of forces along edges, as printed."""
    return layer(rows, SCHEMES["fixed-lattice-printed-heat"])


# --- cases --------------------------------------------------------------------------------------------------

Make = Callable[[int], Reduced]


class Base(NamedTuple):
    """A method and flow with everything, and what is left without each of what may be left out."""
    scene: str
    name: str
    quantity: str
    size: int
    whole: Make
    without: dict[str, Make]


BASES = (
    Base("taylor-green", "moving", "velocity", 24, vortex_moving, {"motion": vortex_without_motion}),
    Base("taylor-green", "fixed-lattice", "velocity", 24, vortex,
         {"compressibility": vortex_without_sound}),
    Base("taylor-green", "fixed-lattice-noise", "velocity", 24, vortex_with_noise,
         {"noise": vortex_without_noise}),
    Base("convection", "fixed-lattice", "K", 16, layer, {"mended heating": layer_without_mending}),
    Base("convection", "fixed-lattice-edge-by-edge", "K", 16, layer_edge_by_edge,
         {"mended heating": layer_without_mending}),
    Base("taylor-green", "moving-delaunay", "velocity", 24, vortex_carried,
         {"motion": vortex_without_motion}),
)


@dataclass(frozen=True, kw_only=True)
class LeavingOut(Case):
    """One base with everything, and without each of what may be left out, one after the other."""
    base: Base
    size: int
    short: float = SHORT
    alone: ClassVar[bool] = True

    @property
    def cost(self) -> float:
        return 0.05*self.size**2

    @property
    def label(self) -> str:
        return f"{self.base.scene}, {self.base.name}, {self.size} spacings"

    def run(self, report: Report, folder: Path) -> Outcome:
        first = self.base.whole(self.size)
        whole = self.residual(first.problem)
        rows = [self.row("nothing", first, whole, whole)]
        for name, make in self.base.without.items():
            part = make(self.size)
            rows.append(self.row(name, part, self.residual(part.problem), whole))
            report(len(rows)/(len(self.base.without) + 1))
        return Outcome({"measured": rows})

    def residual(self, problem: Problem) -> np.ndarray:
        """Of the main quantity; not a number where the run diverged."""
        result = problem.result(OF_LIMIT)
        return result.residuals[self.base.quantity] if result else np.array([np.nan])

    def row(self, left_out: str, made: Reduced, residual: np.ndarray, whole: np.ndarray) -> dict[str, Any]:
        """Of the table."""
        problem, n = made.problem, made.problem.points
        dt, step = problem.dt(OF_LIMIT), NO_TIME
        if np.isfinite(residual).all():
            step = per_step(partial(problem.advance, problem.start, dt), self.short)*(1/n)
        return {"scene": self.base.scene, "base": self.base.name, "quantity": self.base.quantity,
                "left_out": left_out, "points": n, "bytes": array_bytes(problem.held())/n,
                **with_errors(step_s=step, time_s=step*(1/(dt*made.unit))), "error": rms(residual),
                "error_err": problem.known, "changed": made.change(residual, whole)}


def cases(size: str) -> list[Case]:
    """`quick` has two of the bases, timed shortly; `paper` takes two minutes."""
    if size == "quick":
        return [LeavingOut(base=base, size=12, short=0.001) for base in (BASES[2], BASES[3])]
    return [LeavingOut(base=base, size=base.size) for base in BASES]
