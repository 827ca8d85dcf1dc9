"""Rolls that grow or die in runs of the time-dependent solvers: amplitude against time, from rolls of any energy."""
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np

from continuum import boussinesq
from continuum.gas import solve as compressible
from continuum.gas.newton import heat_of_rolls, warm_rolls
from continuum.pypde.solve import Rolls, solve_boussinesq, solve_gas
from continuum.scene import RayleighBenard
from continuum.steady import Time
from particles.run import Plan
from particles.run import run as run_particles
from studies.build.names import START_ENERGY
from studies.build.spam import Variant, method, start
from studies.kit.case import Report

SAMPLES = 200
BAND = 2.0      # a growth rate counts while the amplitude is within this factor of its first


class History(NamedTuple):
    """Amplitude of the rolls (of v_y, for the printed rolls) at times in free-fall units."""
    t: np.ndarray
    amplitude: np.ndarray

    def growth(self, after: float) -> tuple[float, float]:
        """Slope of ln A after a time while A stays in its band, and how much its halves disagree.

        Raises
        ------
        ValueError
            Fewer than 8 samples are left.
        """
        t, a = self.t[self.t >= after], self.amplitude[self.t >= after]
        left = np.flatnonzero(~((a > a[0]/BAND) & (a < a[0]*BAND)))
        stop = left[0] if len(left) else len(a)
        if stop < 8:
            raise ValueError(f"{stop} samples after t = {after} within a factor {BAND} of the amplitude {a[0]:.3g}: "
                             "a growth rate needs 8; sample more often or start with stronger rolls")
        t, log, half = t[:stop], np.log(a[:stop]), stop//2
        slopes = [float(np.polyfit(t[part], log[part], 1)[0]) for part in (slice(None), slice(half), slice(half, None))]
        return slopes[0], abs(slopes[1] - slopes[2])/2


def from_energy(t: np.ndarray, ke: np.ndarray) -> History:
    """The amplitude of printed rolls of that energy: v_x and v_y have the same, A^2/4 = K."""
    return History(t, 2*np.sqrt(ke))


# --- grids ------------------------------------------------------------------------------------------------


def compressible_run(scene: RayleighBenard, rows: int, ke: float, until: float, report: Report) -> History:
    """KHP95's grid."""
    unit = scene.L/scene.free_fall
    series = compressible.run(scene, rows, until=Time(until*unit, SAMPLES), start=warm_rolls(scene, rows, ke),
                              progress=report).series
    return from_energy(series.t/unit, series.ke)


def boussinesq_run(scene: RayleighBenard, rows: int, ke: float, until: float, report: Report) -> History:
    """The staggered grid's transients; of the scene only Ra and Pr count, as below."""
    case = boussinesq.Case(ra=scene.ra, pr=scene.pr, box=boussinesq.LAYER, rows=rows)
    series = boussinesq.transient(case, boussinesq.khp95(case, ke), until=until, within=0.0, progress=report)
    return from_energy(series.t, series.K)


def pypde_gas_run(scene: RayleighBenard, rows: int, ke: float, until: float, report: Report) -> History:
    """The gas on py-pde's grid."""
    unit = scene.L/scene.free_fall
    series = solve_gas(scene, rows, until=Time(until*unit, SAMPLES), start=Rolls(ke), progress=report).series
    return from_energy(series.t/unit, series.ke)


def pypde_boussinesq_run(scene: RayleighBenard, rows: int, ke: float, until: float, report: Report) -> History:
    """Boussinesq on py-pde's grid."""
    series = solve_boussinesq(ra=scene.ra, pr=scene.pr, rows=rows, until=Time(until, SAMPLES), start=Rolls(ke),
                              progress=report).series
    return from_energy(series.t, series.ke)


RUNS: dict[str, Callable[[RayleighBenard, int, float, float, Report], History]] = {
    "boussinesq": boussinesq_run, "compressible": compressible_run, "pypde-boussinesq": pypde_boussinesq_run,
    "pypde-compressible": pypde_gas_run}


# --- particles --------------------------------------------------------------------------------------------


@dataclass(frozen=True)
class RollOf:
    """Amplitude of v_y along cos or sin(2 pi x/width) cos(pi y/height), from the particles."""
    wave: Callable

    def __call__(self, sums: Any, state: np.ndarray) -> float:
        width, height = sums.method.box
        return 4*float(np.mean(state[3]*self.wave(2*np.pi*state[0]/width)*np.cos(np.pi*state[1]/height)))


def spam_run(scene: RayleighBenard, variant: Variant, seed: int, ke: float, until: float, dt: float, report: Report,
             folder) -> History:
    """Particles; rolls may drift along x, so that both phases are recorded."""
    state, chosen = start(scene, seed), method(scene, variant)
    state[2:4] *= np.sqrt(ke/START_ENERGY)
    state[4] += scene.eos.cv*heat_of_rolls(scene, state[3])
    unit = scene.L/scene.free_fall
    plan = Plan(dt=dt, steps=round(until*unit/dt), every=5, checkpoint=folder/"run.h5",
                series={"cos": RollOf(np.cos), "sin": RollOf(np.sin)})
    done = run_particles(chosen, state, plan, report)
    return History(np.array(done.times)/unit, np.hypot(done.series["cos"], done.series["sin"]))
