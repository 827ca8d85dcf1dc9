"""Discretized integral hydrodynamics in the Rayleigh-Benard scene: what runs on fixed and on moving points share."""
from abc import abstractmethod
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from continuum.fluid import ConstEta
from continuum.scene import RayleighBenard
from particles.limits import limit_of
from particles.run import Divergence, Plan, Run, run
from studies.build.names import HALVES, TRANSPORT_NAMES, VALUES, check_spacings, one_energy, scene_columns
from studies.kit.case import Case, Outcome, Report
from studies.kit.stats import settled

OFTEN = 8           # records of points that move in a free-fall time


class Setting(NamedTuple):
    """What a run starts from; its series, read `often` times in a free-fall time, are ke, lower and upper."""
    method: Any
    first: np.ndarray
    of_limit: float
    series: dict[str, Callable]
    often: int


@dataclass(frozen=True, kw_only=True)
class PointsRun(Case):
    """One run of a scheme with a name until t_end, in free-fall times; a run that diverges leaves a row without values."""
    scene: RayleighBenard
    seed: int = 1
    t_end: float

    def __post_init__(self):
        check_spacings(self.scene)

    @property
    @abstractmethod
    def name(self) -> str:
        """Of the scheme, as tables have it."""

    @abstractmethod
    def setting(self) -> Setting:
        """Points, method, state."""

    @abstractmethod
    def values(self, setting: Setting, done: Run) -> dict:
        """Columns of kinetic_energy that the end of the run or its averages give."""

    @property
    def points(self) -> int:
        return round(self.scene.width)*round(self.scene.L)

    @property
    def label(self) -> str:
        law = self.scene.transport
        told = "" if law is ConstEta else f", {TRANSPORT_NAMES[law.__name__]}"
        return f"dih {self.name} Ra {self.scene.ra:g}{told}, {self.points} points, seed {self.seed}"

    @property
    def free_fall_time(self) -> float:
        return self.scene.L/self.scene.free_fall

    @property
    def heat_at_rest(self) -> float:
        """Conducted through a plate: the unit of Nu."""
        return self.scene.k*self.scene.dT/self.scene.L*self.scene.width

    def run(self, report: Report, folder: Path) -> Outcome:
        setting = self.setting()
        dt, unit = setting.of_limit*limit_of(setting.method, setting.first), self.free_fall_time
        plan = Plan(dt=dt, steps=round(self.t_end*unit/dt), series=setting.series,
                    every=max(1, round(unit/setting.often/dt)), checkpoint=folder/"run.h5")
        try:
            done = run(setting.method, setting.first, plan, report)
        except Divergence as error:
            return self._outcome(error.step, dt, {**dict.fromkeys((*VALUES, "cpu_s"), np.nan), "rolls": 0,
                                                  "converged": False, "mass_drift": 0.0, "compile_s": 0.0})
        return self._outcome(plan.steps, dt, {**self.values(setting, done), "cpu_s": done.cpu_s, "compile_s": done.compile_s})

    def _outcome(self, steps: int, dt: float, values: dict) -> Outcome:
        key = {"method": "dih", "variant": self.name, **scene_columns(self.scene), "resolution": round(self.scene.L),
               "seed": self.seed, "particles": self.points, "free_fall": self.scene.free_fall, "threads": 1}
        return Outcome({"kinetic_energy": [{**key, **values, "dt": dt, "steps": steps, "t_end": steps*dt}]})


@dataclass(frozen=True, kw_only=True)
class AveragedRun(PointsRun):
    """One run of points that move, `motion` a record with a name; averages are taken after `mean_from`, in free-fall times."""
    motion: Any
    t_end: float = 90.0
    mean_from: float = 50.0

    @property
    def name(self) -> str:
        return self.motion.name

    def averages(self, done: Run) -> dict:
        """K and Nu; the heat that both plates do not share is in the error of Nu."""
        late = np.array(done.times) > self.mean_from*self.free_fall_time
        ke, lower, upper = (np.array(done.series[name])[late] for name in ("ke", "lower", "upper"))
        (K, steady), (heat, _) = settled(ke, HALVES), settled((lower - upper)/2/self.heat_at_rest)
        balance = np.mean(lower + upper)/2/self.heat_at_rest
        return {**one_energy(K.value, K.err), "nu": heat.value, "nu_err": float(np.hypot(heat.err, balance)), "converged": steady}


def rolls(scene: RayleighBenard, x: np.ndarray, vy: np.ndarray) -> int:
    """Twice the strongest harmonic of vy (n,) along x (n, 2) at mid-height; 0 at rest."""
    middle = np.abs(x[:, 1]) < scene.L/8
    vy = vy[middle]
    if np.abs(vy).max() < 1e-4*scene.free_fall:
        return 0
    size = [abs(np.mean(vy*np.exp(-2j*np.pi*m*x[middle, 0]/scene.width))) for m in range(1, 7)]
    return 2*(1 + int(np.argmax(size)))
