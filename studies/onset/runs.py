"""Runs that begin with rolls of finite energy, of particles and of the gas's grid; steady K near onset."""
from collections.abc import Callable, Iterator
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
from scipy.optimize import brentq

from continuum.gas import newton, solve
from continuum.gas.fields import NodeFields, Values, initial
from continuum.linear import critical_ra, critical_ra_square
from continuum.scene import Periodic, RayleighBenard
from continuum.steady import Time
from particles.run import Plan, run
from studies.build.names import START_ENERGY
from studies.build.spam import Variant, method, start, step
from studies.kit.case import Case, Outcome, Report
from studies.kit.table import Row
from studies.onset.rates import compressible, point

SAMPLES = 200
AFTER, UNTIL = 2.0, 30.0    # free-fall times between which growth rates are taken
BAND = 2.0      # a growth rate counts while the amplitude is within this factor of its first
#: lines of K: the largest share 1 - sqrt(Ra_c/Ra) -> shares of the points; 0.5 is KHP95's four times Ra_c
LINES = {0.5: (0.05, 0.1, 0.15, 0.2, 0.25, 0.3, 0.35, 0.4, 0.45, 0.5),
         0.1: (0.02, 0.04, 0.06, 0.08, 0.1),
         0.02: (0.005, 0.01, 0.015, 0.02)}


def growth(t: np.ndarray, amplitude: np.ndarray, after: float) -> tuple[float, float]:
    """Growth rate d ln(amplitude)/dt, and half the difference between the two halves of the samples.

    Samples count from the time `after` on until the amplitude has changed by the factor BAND. Raises
    ValueError: fewer than 8 of them.
    """
    t, a = t[t >= after], amplitude[t >= after]
    inside = np.append((a > a[0]/BAND) & (a < a[0]*BAND), False)
    stop = int(np.argmin(inside))
    if stop < 8:
        raise ValueError(f"{stop} samples after t = {after} within a factor {BAND} of the amplitude "
                         f"{a[0]:.3g}: a growth rate needs 8; sample more often or start from more")
    half, log = stop//2, np.log(a)
    whole, first, last = (float(np.polyfit(t[part], log[part], 1)[0])
                          for part in (slice(stop), slice(half), slice(half, stop)))
    return whole, abs(first - last)/2


class GrowthRun(Case, table="growth_rates"):
    """Growth rate of rolls on KHP95's grid from kinetic energy `ke` on; `until` in free-fall times."""
    scene: RayleighBenard
    rows: int
    ke: float
    until: float = UNTIL

    def measure(self, report: Report) -> Iterator[Row]:
        sigma, err = growth(*self.history(report), AFTER)
        yield {**point("compressible", self.scene, self.rows), "way": "run", "ke_start": self.ke, "seed": 0,
               "sigma": sigma, "err": err}

    def history(self, report: Report) -> tuple[np.ndarray, np.ndarray]:
        """Times and amplitude of v_y: v_x and v_y of KHP95's rolls have the same energy, A^2/4 = K."""
        unit = self.scene.L/self.scene.free_fall
        rolls = newton.warm_rolls(self.scene, self.rows, self.ke)
        series = solve.run(self.scene, self.rows, until=Time(self.until*unit, SAMPLES), start=rolls,
                           progress=report).series
        return series.t/unit, 2*np.sqrt(series.ke)


def roll(sums: Any, state: np.ndarray, wave: Callable) -> float:
    """Amplitude of wave(2 pi x/width) cos(pi y/height) in v_y of particles; `wave` is cos or sin."""
    x, y, _, vy, _ = state
    width, height = sums.method.box
    return 4*float(np.mean(vy*wave(2*np.pi*x/width)*np.cos(np.pi*y/height)))


class SpamGrowth(Case, table="growth_rates"):
    """Growth rate of rolls of particles from kinetic energy `ke` on; L of the scene is the number of rows."""
    scene: RayleighBenard
    variant: Variant
    seed: int
    ke: float

    @property
    def cost(self) -> float:
        steps = UNTIL*self.scene.L/self.scene.free_fall/step(self.scene, self.variant)
        return steps*4*self.scene.width*self.scene.L*230e-9*(self.variant.h/3)**2 + 2

    def run(self, report: Report, folder: Path) -> Outcome:
        """Both phases of the rolls are recorded, since they may drift along x."""
        state = start(self.scene, self.seed)
        state[2:4] *= np.sqrt(self.ke/START_ENERGY)
        state[4] += self.scene.eos.cv*newton.heat_of_rolls(self.scene, state[3])
        unit, dt = self.scene.L/self.scene.free_fall, step(self.scene, self.variant)
        plan = Plan(dt=dt, steps=round(UNTIL*unit/dt), every=5, checkpoint=folder/"run.h5",
                    series={"cos": partial(roll, wave=np.cos), "sin": partial(roll, wave=np.sin)})
        done = run(method(self.scene, self.variant), state, plan, report)
        amplitude = np.hypot(done.series["cos"], done.series["sin"])
        sigma, err = growth(np.array(done.times)/unit, amplitude, AFTER)
        at = point("spam", self.scene, round(self.scene.L), self.variant.name)
        return Outcome({"growth_rates": [{**at, "way": "run", "ke_start": self.ke, "seed": self.seed,
                                          "sigma": sigma, "err": err}]})


class OnsetEnergies(Case, table="energies"):
    """Steady K of the gas on one grid; shares : values of 1 - sqrt(Ra_c/Ra), with Ra_c of this grid."""
    scene: RayleighBenard
    rows: int
    shares: tuple[float, ...]

    @property
    def cost(self) -> float:
        return len(self.shares)*2e-5*self.rows**3 + 2

    def measure(self, report: Report) -> Iterator[Row]:
        own, fields = self.own_onset(), None
        for share in sorted(self.shares, reverse=True):
            scene = replace(self.scene, ra=own/(1 - share)**2)
            steady = newton.steady(scene, self.rows, fields and faded(scene, self.rows, fields))
            fields = steady.fields
            yield {**point("compressible", scene, self.rows), "share": share, "ke": steady.ke,
                   "rolls": steady.rolls}

    def own_onset(self) -> float:
        """Ra_c of the grid, sought within a tenth of that of the Boussinesq fluid."""
        near = boussinesq_onset(self.scene)
        return float(brentq(lambda ra: compressible(replace(self.scene, ra=ra), self.rows)[0],
                            0.9*near, 1.1*near, xtol=1e-6*near))


def boussinesq_onset(scene: RayleighBenard) -> float:
    """Ra_c of a Boussinesq fluid in this box."""
    return critical_ra(np.pi) if isinstance(scene.sides, Periodic) else critical_ra_square()


def faded(scene: RayleighBenard, rows: int, fields: NodeFields) -> NodeFields:
    """Guess of steady rolls from those at a higher Ra: K is nearly proportional to 1 - sqrt(Ra_c/Ra)."""
    old, new = (1 - np.sqrt(boussinesq_onset(scene)/ra) for ra in (fields.scene.ra, scene.ra))
    factor = np.sqrt(max(new, 0.005)/max(old, 0.005))
    rest = initial(scene, rows, 0.0).at
    at = Values(*(one + factor*(other - one) for one, other in zip(rest, fields.at, strict=True)))
    return replace(fields, at=at, cells=1 + factor*(fields.cells - 1))
