"""Runs from rolls of finite energy, among particles and on the gas's grid; steady energies near onset."""
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from scipy.optimize import brentq

from continuum.gas import newton, solve
from continuum.gas.fields import NodeFields, Values, initial
from continuum.linear import critical_ra, critical_ra_square
from continuum.scene import Periodic, RayleighBenard
from continuum.steady import Time
from particles.run import Plan, run
from studies.build.names import START_ENERGY
from studies.build.spam import PRINTED, Variant, method, start, step
from studies.kit.case import Case, Outcome, Report
from studies.onset.rates import compressible, point

SAMPLES = 200
BAND = 2.0      # a growth rate counts while the amplitude is within this factor of its first
#: lines of K: the largest share 1 - sqrt(Ra_c/Ra) -> shares of the points; 0.5 is KHP95's four times Ra_c
LINES = {0.5: (0.05, 0.1, 0.15, 0.2, 0.25, 0.3, 0.35, 0.4, 0.45, 0.5),
         0.1: (0.02, 0.04, 0.06, 0.08, 0.1),
         0.02: (0.005, 0.01, 0.015, 0.02)}


class History(NamedTuple):
    """Amplitude of the rolls (of v_y, for the printed rolls) at times in free-fall units."""
    t: np.ndarray
    amplitude: np.ndarray

    def growth(self, after: float) -> tuple[float, float]:
        """Slope of ln A after a time while A stays in its band, and how its halves disagree.

        Raises ValueError: fewer than 8 samples are left.
        """
        t, a = self.t[self.t >= after], self.amplitude[self.t >= after]
        inside = np.append((a > a[0]/BAND) & (a < a[0]*BAND), False)
        stop = int(np.argmin(inside))
        if stop < 8:
            raise ValueError(f"{stop} samples after t = {after} within a factor {BAND} of the amplitude "
                             f"{a[0]:.3g}: a growth rate needs 8; sample more often or start from more")
        half, log = stop//2, np.log(a)
        whole, first, last = (float(np.polyfit(t[part], log[part], 1)[0])
                              for part in (slice(stop), slice(half), slice(half, stop)))
        return whole, abs(first - last)/2


@dataclass(frozen=True, kw_only=True)
class RollRun(Case):
    """Growth rate of rolls of kinetic energy `ke` in a run, after `after` free-fall times."""
    scene: RayleighBenard
    ke: float
    after: float = 2.0
    until: float = 30.0
    seed: int = 0

    def at(self) -> dict[str, Any]:
        """Columns of the method and the scene."""
        raise NotImplementedError

    def history(self, report: Report, folder: Path) -> History:
        """Of the rolls."""
        raise NotImplementedError

    def run(self, report: Report, folder: Path) -> Outcome:
        sigma, err = self.history(report, folder).growth(self.after)
        known = {"way": "run", "ke_start": self.ke, "seed": self.seed}
        return Outcome({"growth_rates": [{**self.at(), **known, "sigma": sigma, "err": err}]})


@dataclass(frozen=True, kw_only=True)
class GrowthRun(RollRun):
    """On KHP95's grid."""
    rows: int

    def at(self) -> dict[str, Any]:
        return point("compressible", self.scene, self.rows)

    def history(self, report: Report, folder: Path) -> History:
        """v_x and v_y of printed rolls have the same energy, A^2/4 = K."""
        unit = self.scene.L/self.scene.free_fall
        rolls = newton.warm_rolls(self.scene, self.rows, self.ke)
        series = solve.run(self.scene, self.rows, until=Time(self.until*unit, SAMPLES), start=rolls,
                           progress=report).series
        return History(series.t/unit, 2*np.sqrt(series.ke))


def roll(sums: Any, state: np.ndarray, wave: Callable) -> float:
    """Amplitude of v_y along cos or sin(2 pi x/width) cos(pi y/height), from the particles."""
    x, y, _, vy, _ = state
    width, height = sums.method.box
    return 4*float(np.mean(vy*wave(2*np.pi*x/width)*np.cos(np.pi*y/height)))


@dataclass(frozen=True, kw_only=True)
class SpamGrowth(RollRun):
    """Among particles; the scene has L = rows of particles."""
    variant: Variant = PRINTED
    seed: int = 1

    @property
    def cost(self) -> float:
        steps = self.until*self.scene.L/self.scene.free_fall/step(self.scene, self.variant)
        return steps*4*self.scene.width*self.scene.L*230e-9*(self.variant.h/3)**2 + 2

    def at(self) -> dict[str, Any]:
        return point("spam", self.scene, round(self.scene.L), self.variant.name)

    def history(self, report: Report, folder: Path) -> History:
        """Rolls may drift along x, so that both phases are recorded."""
        state = start(self.scene, self.seed)
        state[2:4] *= np.sqrt(self.ke/START_ENERGY)
        state[4] += self.scene.eos.cv*newton.heat_of_rolls(self.scene, state[3])
        unit, dt = self.scene.L/self.scene.free_fall, step(self.scene, self.variant)
        plan = Plan(dt=dt, steps=round(self.until*unit/dt), every=5, checkpoint=folder/"run.h5",
                    series={"cos": partial(roll, wave=np.cos), "sin": partial(roll, wave=np.sin)})
        done = run(method(self.scene, self.variant), state, plan, report)
        return History(np.array(done.times)/unit, np.hypot(done.series["cos"], done.series["sin"]))


@dataclass(frozen=True, kw_only=True)
class OnsetEnergies(Case):
    """Steady K of the gas on one grid where 1 - sqrt(Ra_c/Ra), with the grid's own Ra_c, has some values."""
    scene: RayleighBenard
    rows: int
    shares: tuple[float, ...]

    @property
    def cost(self) -> float:
        return len(self.shares)*2e-5*self.rows**3 + 2

    def run(self, report: Report, folder: Path) -> Outcome:
        own, fields, rows = self.own_onset(), None, []
        for number, share in enumerate(sorted(self.shares, reverse=True)):
            scene = replace(self.scene, ra=own/(1 - share)**2)
            steady = newton.steady(scene, self.rows, fields and faded(scene, self.rows, fields))
            fields = steady.fields
            at = point("compressible", scene, self.rows)
            rows.append({**at, "share": share, "ke": steady.ke, "rolls": steady.rolls})
            report((number + 1)/len(self.shares))
        return Outcome({"energies": rows})

    def own_onset(self) -> float:
        """The grid's Ra_c; a tenth on either side of Boussinesq fluid's is enough for all scenes."""
        near = boussinesq_onset(self.scene)
        return float(brentq(lambda ra: compressible(replace(self.scene, ra=ra), self.rows)[0],
                            0.9*near, 1.1*near, xtol=1e-6*near))


def boussinesq_onset(scene: RayleighBenard) -> float:
    """Where Boussinesq fluid in the box begins to move."""
    return critical_ra(np.pi) if isinstance(scene.sides, Periodic) else critical_ra_square()


def faded(scene: RayleighBenard, rows: int, fields: NodeFields) -> NodeFields:
    """Steady rolls of a higher Ra made weaker: K is nearly proportional to 1 - sqrt(Ra_c/Ra)."""
    old, new = (1 - np.sqrt(boussinesq_onset(scene)/ra) for ra in (fields.scene.ra, scene.ra))
    factor = np.sqrt(max(new, 0.005)/max(old, 0.005))
    rest = initial(scene, rows, 0.0).at
    at = Values(*(one + factor*(other - one) for one, other in zip(rest, fields.at, strict=True)))
    return replace(fields, at=at, cells=1 + factor*(fields.cells - 1))
