"""Slow flow around a cylinder in a square array as a case: its drag [Sangani & Acrivos 1982], and the stream itself"""
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from scipy.optimize import brentq

from continuum.fluid import ConstEta, IdealGas
from continuum.published import published
from particles.integral.bodies import held, in_disc, with_surface
from particles.integral.edge_makers import renormalised
from particles.integral.edges import Edges
from particles.integral.points import Points, lattice
from particles.integral.stream import Stream, Streaming
from particles.integral.triangulation import delaunay
from particles.limits import limit_of
from particles.run import Plan, Run, run
from particles.weights import Lucy
from studies.kit.case import Case, Outcome, Report

ETA, SPEED = 2.0, 1e-3      # the step is the longest where sound and friction limit it alike; Re and Mach below 0.01
TIMES = 15.0                # until the end, in those of the slowest motion: of the mean, or of a wave as long as the cell
OF_LIMIT = 0.9              # of the step to its stability limit: a steady flow knows no error of the step
PRESSURE = 0.05             # chi nu/(a^2 c^2) of the filter


class Variant(NamedTuple):
    """Points and edges of a body; `grown`: spacings by which the disc of frozen points is larger than the body."""
    name: str
    make: Callable[[int, float, float], tuple[Points, np.ndarray, Edges]]
    h: float = 2.0
    grown: float = 0.0
    filtered: float = PRESSURE

    def points(self, rows: int, radius: float) -> tuple[Points, np.ndarray, Edges]:
        """Points of spacing 1, those of the body, and edges."""
        return self.make(rows, radius + self.grown, self.h)


def frozen(rows: int, radius: float, h: float) -> tuple[Points, np.ndarray, Edges]:
    """Lattice points within the disc, edges of Lucy's weight."""
    at = lattice((rows, rows))
    return at, in_disc(at, radius), renormalised(at, Lucy.of(h=h))


def triangulated(rows: int, radius: float, h: float) -> tuple[Points, np.ndarray, Edges]:
    """Points on the circle, edges of a triangulation, which has no range h."""
    at, which = with_surface((rows, rows), radius)
    return at, which, delaunay(at)


VARIANTS = {v.name: v for v in (
    Variant("surface", triangulated),
    Variant("surface-unfiltered", triangulated, filtered=0.0),
    Variant("frozen", frozen),
    Variant("frozen-grown", frozen, grown=0.5),
    Variant("frozen-h3", frozen, h=3.0),
)}


def drag_of(fraction: float) -> tuple[float, float]:
    """Published F/(mu U) and its uncertainty."""
    found = published(f"cylinders-drag-{fraction:g}")
    return found.value, found.uncertainty


def series(c: float) -> float:
    """F/(mu U) of a dilute square array with solid fraction c: to 0.1 % up to c = 0.1."""
    s = [published(f"cylinders-series-{n}").value for n in range(4)]
    return 4*np.pi/(s[0] + s[1]*c + s[2]*c**2 + s[3]*c**3 - np.log(c)/2)


def radius_of(drag: float, fraction: float) -> float:
    """Radius that has this drag, over the true one: by the series, held against itself, so that its own error drops out.

    nan where the array is too dense for it.
    """
    if fraction > 0.11:
        return np.nan
    wanted = drag/drag_of(fraction)[0]*series(fraction)
    return float(np.sqrt(brentq(lambda c: series(c) - wanted, 0.2*fraction, 1.9*fraction)/fraction))


def momentum(sums: Streaming, state: np.ndarray) -> float:
    """Of all points, along the stream."""
    return float(sums.method.edges.V@state[1])


def force(sums: Streaming, state: np.ndarray) -> float:
    """On the body, along the stream; of the last stage of the last step."""
    return float(sums.received[:, 0].sum())


@dataclass(frozen=True, kw_only=True)
class CylinderDrag(Case):
    """A stream through a square array of cylinders, `rows` spacings from one to the next, until it is steady.

    speed : about that which the mean velocity gets, by the published drag. shows : the field goes into a table.
    """
    variant: Variant
    fraction: float
    rows: int
    speed: float = SPEED
    shows: bool = False

    @property
    def cost(self) -> float:
        return 4e-5*self.rows**4/self.slowest*(2 if self.variant.make is triangulated else 1) + 1

    @property
    def label(self) -> str:
        return f"drag {self.variant.name}, solid fraction {self.fraction:g}, {self.rows} rows, speed {self.speed:g}"

    @property
    def radius(self) -> float:
        return self.rows*float(np.sqrt(self.fraction/np.pi))

    @property
    def slowest(self) -> float:
        """Rate of the slowest motion, in nu/L^2: F/(eta U) for the mean velocity, (2 pi)^2 for sound that friction damps."""
        return min(drag_of(self.fraction)[0], 4*np.pi**2)

    def run(self, report: Report, folder: Path) -> Outcome:
        points, which, edges = self.variant.points(self.rows, self.radius)
        drag, _ = drag_of(self.fraction)
        push = drag*ETA*self.speed/self.rows**2
        method = Stream(x=points.x, edges=edges, eos=IdealGas(), law=ConstEta(ETA, ETA), held=held(which, T=1.0),
                        push=(push, 0.0), chi=self.variant.filtered/ETA)
        first = method.state(1.0, np.full((points.n, 2), [self.speed, 0.0]), 1.0)
        dt = OF_LIMIT*limit_of(method, first)
        steps = round(TIMES*self.rows**2/(self.slowest*ETA)/dt)
        plan = Plan(dt=dt, steps=steps, every=max(1, steps//40), series={"momentum": momentum, "force": force})
        done = run(method, first, plan, report)
        rows: dict[str, list[dict[str, Any]]] = {"drag": [self._row(method, done, plan)]}
        if self.shows:
            rows["field"] = self._field(method, done)
        return Outcome(rows)

    def _row(self, method: Stream, done: Run, plan: Plan) -> dict[str, Any]:
        """Drag = (force over edges + what the mean pressure gradient does to the volume that is not driven)/(eta U)."""
        free = np.ones(len(method.x), bool)
        free[method.held.which] = False
        V, cell = method.edges.V, float(self.rows**2)
        U = np.array(done.series["momentum"])/cell
        total = done.series["force"] + method.push[0]*(cell - V[free].sum())
        drags, (known, known_err) = total/(ETA*U), drag_of(self.fraction)
        drag, err = drags[-1], float(np.ptp(drags[-4:]))        # the last tenth of the time
        return {"variant": self.variant.name, "fraction": self.fraction, "rows": self.rows, "radius": self.radius,
                "points": int(free.sum()), "drag": drag, "drag_err": err, "published": known, "published_err": known_err,
                "error": drag/known - 1, "error_err": float(np.hypot(err/known, drag*known_err/known**2)),
                "balance": done.series["force"][-1]/(method.push[0]*(V*done.state[0])[free].sum()) - 1,
                "offset": (radius_of(drag, self.fraction) - 1)*self.radius,
                "reynolds": 2*self.speed*self.radius/ETA, "mach": self.speed/np.sqrt(2.0),
                "density_range": float(np.ptp(done.state[0, free])), "dt": plan.dt, "steps": plan.steps,
                "cpu_s": done.cpu_s, "compile_s": done.compile_s}

    def _field(self, method: Stream, done: Run) -> list[dict[str, Any]]:
        """Velocities over the mean one, places in radii."""
        U = float(method.edges.V@done.state[1])/self.rows**2
        inside = np.isin(np.arange(len(method.x)), method.held.which)
        v = done.state[1:3]/done.state[0]/U
        return [{"variant": self.variant.name, "fraction": self.fraction, "rows": self.rows, "point": i,
                 "x": method.x[i, 0]/self.radius, "y": method.x[i, 1]/self.radius, "u": v[0, i], "v": v[1, i],
                 "held": int(inside[i])} for i in range(len(method.x))]
