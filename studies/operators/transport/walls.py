"""Shear flows between plates that start from rest, as cases: Couette and Poiseuille against their series.

RR98 leaves walls open (Sec. III A). Here they are mirror images, friction seeing 2 U - v behind a plate that slides with U, or
rows of points that are held (`Stream`), which triangles of points off a lattice need: their images would see a kink.
"""
from collections.abc import Callable
from dataclasses import dataclass
from math import ceil
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from continuum.fluid import ConstEta, IdealGas
from particles.integral.bodies import held, together, with_plates
from particles.integral.driven import Driven
from particles.integral.edge_makers import renormalised
from particles.integral.edges import between_plates
from particles.integral.layer import Layer
from particles.integral.points import jittered, lattice
from particles.integral.stream import Stream
from particles.integral.triangulation import between, delaunay
from particles.limits import limit_of
from particles.run import Plan, run
from particles.weights import Lucy
from studies.kit.case import Case, Outcome, Report

ETA = KAPPA = 0.5
TIMES = (0.02, 0.05, 0.1, 0.2, 0.5)     # in height^2/nu
INTERVAL = 0.01                         # of which all of these are multiples
SPEED = 1e-3        # of the flow: heating and compression are of the order of its square, 1e-6 of it
COLUMNS = 8         # nothing depends on x but where points are
FROM_PLATE = 0.25   # of a spacing: jittered points come no nearer to a plate
OF_LIMIT = 0.5      # of the step to its limit: RK4's own errors are (0.02)^4 of a decay
TERMS = 60          # of the series: the next one is exp(-60^2 pi^2 0.02) = 1e-308 at the first time


# --- exact solutions --------------------------------------------------------------------------------------------------


def couette(y: np.ndarray, time: float) -> np.ndarray:
    """u over the speed of the upper plate, at heights y above the lower one over the distance, times in height^2/nu."""
    n = np.arange(1, TERMS + 1)
    return y + (2/(n*np.pi)*(-1.0)**n*np.exp(-(n*np.pi)**2*time)*np.sin(np.pi*n*y[:, None])).sum(axis=1)


def poiseuille(y: np.ndarray, time: float) -> np.ndarray:
    """u over its final value in the middle, force height^2/(8 nu)."""
    n = np.arange(1, TERMS + 1, 2)
    return 4*y*(1 - y) - (32/(n*np.pi)**3*np.exp(-(n*np.pi)**2*time)*np.sin(np.pi*n*y[:, None])).sum(axis=1)


class Drive(NamedTuple):
    """What makes a flow: velocity of the upper plate, force height^2/(8 nu), both in SPEED, and the exact u/SPEED."""
    name: str
    slide: float
    force: float
    exactly: Callable[[np.ndarray, float], np.ndarray]


FLOWS = {drive.name: drive for drive in (Drive("couette", 1.0, 0.0, couette), Drive("poiseuille", 0.0, 1.0, poiseuille))}


# --- runs -------------------------------------------------------------------------------------------------------------


def driven(drive: Drive, rows: int, jitter: float, seed: int) -> Driven:
    """A layer of unit spacing: a lattice with Lucy's weight, h = 2, or jittered points with Delaunay edges."""
    at = jittered((COLUMNS, rows), jitter, seed) if jitter else lattice((COLUMNS, rows))
    x = np.stack([at.x[:, 0], np.clip(at.x[:, 1], -rows/2 + FROM_PLATE, rows/2 - FROM_PLATE)], axis=1)
    edges, beyond = between_plates(delaunay if jitter else renormalised, x, COLUMNS, rows, Lucy.of(h=2.0))
    return Driven(x=x, edges=edges, beyond=beyond, eos=IdealGas(), law=ConstEta(ETA, KAPPA), T_plates=(1.0, 1.0), g=0.0,
                  slide=(0.0, drive.slide*SPEED), force=8*ETA*SPEED*drive.force/rows**2)


def between_rows(drive: Drive, rows: int, jitter: float, seed: int) -> Stream:
    """The same on jittered points with Delaunay edges that end on rows of points on the plates."""
    x, lower, upper = with_plates(jittered((COLUMNS, rows - 1), jitter, seed).x, COLUMNS, rows)
    plates = together(held(lower, T=1.0), held(upper, (drive.slide*SPEED, 0.0), T=1.0))
    return Stream(x=x, edges=between(x, COLUMNS, rows), eos=IdealGas(), law=ConstEta(ETA, KAPPA), held=plates,
                  push=(8*ETA*SPEED*drive.force/rows**2, 0.0))


@dataclass(frozen=True, kw_only=True)
class ShearFlow(Case):
    """One flow from rest, `rows` spacings high, on a lattice (jitter 0) or on jittered points; `plates`: of points."""
    drive: Drive
    rows: int
    jitter: float = 0.0
    plates: bool = False
    seed: int = 1

    @property
    def cost(self) -> float:
        return 5e-4*self.rows**2*(0.5 + self.rows/64)*(1 + 2*self.jitter)

    @property
    def label(self) -> str:
        return f"{self.drive.name}, {self.rows} rows, {self.points}, seed {self.seed}"

    def run(self, report: Report, folder: Path) -> Outcome:
        method = (between_rows if self.plates else driven)(self.drive, self.rows, self.jitter, self.seed)
        y, V = method.x[:, 1]/self.rows + 0.5, method.edges.V
        state, last, found = method.state(1.0, 0*method.x, np.ones(len(y))), 0.0, []
        interval = INTERVAL*self.rows**2/ETA
        steps = ceil(interval/(OF_LIMIT*limit_of(method, state)))
        for time in TIMES:
            plan = Plan(dt=interval/steps, steps=steps*round((time - last)/INTERVAL))
            state, last = run(method, state, plan).state, time
            report(time/TIMES[-1])
            u = state[1]/state[0]/SPEED
            off = u - self.drive.exactly(y, time)
            found.append({**self._key, "time": time, "rms": float(np.sqrt(V@off**2/V.sum())), "largest": float(np.abs(off).max()),
                          **neglected(method, state)})
        return Outcome({"shear": found})

    @property
    def points(self) -> str:
        return (f"jittered-{self.jitter:g}" if self.jitter else "lattice") + ", plates"*self.plates

    @property
    def _key(self) -> dict[str, Any]:
        return {"flow": self.drive.name, "points": self.points, "rows": self.rows, "seed": self.seed}


def neglected(method: Layer | Stream, state: np.ndarray) -> dict[str, float]:
    """What the series leave out: heating, compression, and the velocity across the plates over SPEED."""
    rho, v = state[0], state[1:3]/state[0]
    T = state[3]/rho - (v**2).sum(axis=0)/2
    return {"heating": float(np.abs(T - 1).max()), "compression": float(np.abs(rho - 1).max()),
            "across": float(np.abs(v[1]).max()/SPEED)}
