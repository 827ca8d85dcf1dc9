"""Hard layers and boxes, and what is measured there of any method    [KHP95, Sec. VI; RR98, Sec. III]

All have 8 to 16 rows, but one with a million points: which method fails first? Units: spacing, mean density,
P/rho at T = 1.
"""
from dataclasses import dataclass
from math import sqrt
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import pandas as pd

from continuum.gas.fields import NodeFields, at_nodes, initial
from continuum.scene import RayleighBenard, Walls
from particles.fields import Fields, kinetic_energy
from studies.build.names import START_ENERGY
from studies.build.scenes import Slab
from studies.hardcases.runs import THIN, Course, Hard, Question, Row, between_plates, fate
from studies.kit.case import Outcome, Report

ROWS = 16
SOUND = sqrt(2)
SPEED = 0.1         # largest velocity of the vortex: Mach number 0.07


@dataclass(frozen=True, kw_only=True)
class Chamber(Slab):
    """A gas between plates, at first in a vortex of largest velocity `speed`.

    strip : whether only |x| < L is dense. ripple : amplitude of densities that alternate from one spacing to
    the next.
    """
    viscosity: float = 0.0
    heat: float = 0.0
    speed: float = 0.0
    strip: bool = False
    ripple: float = 0.0

    def flow(self, x, y, ke: float = 0.0, rolls: int | None = None) -> tuple[np.ndarray, np.ndarray]:
        """Velocities of a steady vortex, tangential at plates; `ke` and `rolls` are ignored."""
        k = 2*np.pi/self.L
        return self.speed*np.sin(k*x)*np.cos(k*y), -self.speed*np.cos(k*x)*np.sin(k*y)

    def fields(self, x: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Density, velocity, temperature at places (n, 2)."""
        v = np.stack(self.flow(*x.T), axis=1)
        outside = self.strip and np.abs(x[:, 0]) >= self.L
        sign = 1 - 2*(np.floor(x).sum(axis=1) % 2)
        return np.where(outside, THIN, 1 + self.ripple*sign), v, self.T(x[:, 1])


VORTEX = Chamber(L=ROWS, aspect=1.0, speed=SPEED)
STRIP = Chamber(L=8.0, aspect=12.0, strip=True)
CORNER = Chamber(L=12.0, aspect=1.0, viscosity=0.3, heat=0.3, sides=Walls())
CROWD = Chamber(L=1000.0, aspect=1.0, speed=SPEED)
ALTERNATING = "alternating densities"
CHESSBOARD = Chamber(L=12.0, aspect=1.0, viscosity=0.3, heat=0.3, ripple=0.1)


def rarefied(t: float) -> float:
    """K per mass of the strip before its rarefactions meet at t = L/c, 0.2 c^3 t/L for gamma = 2.

    From u = 2 (c + x/t)/3 and rho = (2 - x/ct)^2/9; fronts run out at 2 c/(gamma - 1) = 2 c.
    """
    return 0.2*SOUND**3*t/STRIP.L


def layer(ra: float, pr: float = 1.0, T: float = 1.0) -> RayleighBenard:
    """KHP95's layer with mean temperature T: the static pressure is T, the flow that of Ra and Pr."""
    return RayleighBenard(ra=ra, pr=pr, L=float(ROWS), T_hot=T + 0.5, T_cold=T - 0.5)


def falls(scene: RayleighBenard, times: float) -> float:
    """Time of so many free falls, in the units of the scene."""
    return times*scene.L/scene.free_fall


class Situation(NamedTuple):
    """A scene and the duration of its runs."""
    scene: Any
    time: float


def convection(times: float, *layer_of: float) -> Situation:
    """The layer of these numbers and a duration of so many free-fall times."""
    scene = layer(*layer_of)
    return Situation(scene, falls(scene, times))


LAYERS = {
    "Ra 1e5": convection(50.0, 1e5),
    "Ra 1e6": convection(50.0, 1e6),
    "Ra 1e7": convection(50.0, 1e7),
    "Ra 1e8": convection(50.0, 1e8),
    "Prandtl 0.01": convection(30.0, 1e4, 0.01),
    "Prandtl 100": convection(30.0, 1e4, 100.0),
    "high pressure": convection(20.0, 1e4, 1.0, 4.0),
    "disordered points": convection(30.0, 1e4),
}
#: the vortex turns SPEED t/L = 5 times, rarefactions go 0.7 of the way to the middle, sound crosses the
#: corner 35 times, the layer below onset stays at rest, a million points take about a hundred steps
BOXES = {
    "zero viscosity": Situation(VORTEX, 800.0),
    "vacuum": Situation(STRIP, 0.7*8/SOUND),
    "wall corner": Situation(CORNER, 300.0),
    "long rest": convection(1e4, 1e3),
    "a million points": Situation(CROWD, 60.0),
}
SITUATIONS = {**LAYERS, **BOXES}


# --- questions ----------------------------------------------------------------------------------------------

LATE = 2/3          # part of a run after which means are taken
SPACINGS = 4        # width of a cell over which velocities are averaged: their mean is flow, the rest noise


def late(values: Any) -> slice:
    """Slice of the last third of the samples, the start being the first one."""
    return slice(round(LATE*len(values)), None)


def flow(at: Fields, box: tuple[float, float]) -> float:
    """K per mass of velocities averaged in cells of SPACINGS, which removes noise between neighbours."""
    size, m = np.array(box), at.rho*at.V
    cells = np.maximum(1, np.round(size/SPACINGS)).astype(int)
    place = np.clip(((at.x/size + 0.5)*cells).astype(int), 0, cells - 1)
    momentum = m[:, None]*at.v
    sums = pd.DataFrame({"m": m, "px": momentum[:, 0], "py": momentum[:, 1]}).groupby(list(place.T)).sum()
    energy = (sums.px**2 + sums.py**2)/sums.m/2
    return float(energy.sum()/sums.m.sum())


def energies(scene: Any, at: Fields) -> tuple[float, float, float]:
    """K per mass, K per mass of the averaged flow, and the mass."""
    return kinetic_energy(at), flow(at, (scene.width, scene.L)), float((at.rho*at.V).sum())


def seen(scene: Any, method: Any, state: np.ndarray) -> tuple[float, float, float]:
    """The `energies` of a state of any method."""
    return energies(scene, method.fields(state))


def means(scene: Any, course: Course) -> Row:
    """Means over the last third, if the run reached its end; change of the mass, energies at the start."""
    k, moves, mass = np.transpose(course.seen)
    last = late(k)
    whole = {"k": k[last].mean(), "flow": moves[last].mean()} if course.reached == 1 else {}
    return {**whole, "mass_drift": mass[-1]/mass[0] - 1, "k_start": k[0], "flow_start": moves[0],
            **fate(course.reached)}


#: does a run reach its end, and with which K, flow and mass?
SURVIVAL = Question(seen, means)


class OnGrid(Hard):
    """A hard case of the compressible grid between plates, in its own time loop. entrant : number of rows."""

    def run(self, report: Report, folder: Path) -> Outcome:
        start = initial(self.scene, self.entrant, START_ENERGY)
        done, reached = between_plates(start, self.time, report)
        came = fate(reached)
        if done is None:
            return self.outcome(**came)
        k_start, flow_start, _ = self.energies(start)
        k_end, flow_end, _ = self.energies(done.fields)
        k = done.series.ke[late(done.series.ke)].mean()
        return self.outcome(k=k, flow=k*flow_end/max(k_end, 1e-300), mass_drift=done.mass_drift,
                            k_start=k_start, flow_start=flow_start, **came)

    def energies(self, fields: NodeFields) -> tuple[float, float, float]:
        """The `energies` of nodes of unit volume each, nodes in plates included."""
        at = at_nodes(fields)
        return energies(self.scene, at._replace(V=np.ones_like(at.rho)))


def unevenness(scene: Any, method: Any, state: np.ndarray) -> float:
    """Rms deviation of densities from their mean, 1."""
    at = method.fields(state)
    return float(np.sqrt(at.V@(at.rho - 1)**2/at.V.sum()))


def remaining(scene: Any, course: Course) -> Row:
    """Mean of the last third over the value at the start; it should be 0."""
    measured = np.mean(course.seen[late(course.seen)])/course.seen[0] if course.reached == 1 else np.nan
    return {"measured": measured, "reached": course.reached}


#: how much is left of densities that alternate
UNEVENNESS = Question(unevenness, remaining)
