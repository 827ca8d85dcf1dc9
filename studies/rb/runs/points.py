"""One run on points, fixed or moving, in the layer    [RR98, Sec. III]"""
from abc import abstractmethod
from dataclasses import dataclass
from pathlib import Path
from typing import Any, ClassVar

import numpy as np

from continuum.fluid import ConstEta
from continuum.scene import RayleighBenard
from particles.run import Run
from studies.build.fixed import SCHEMES, Scheme
from studies.build.measure import ended, followed, heat_at_rest, rolls
from studies.build.moving import MOTIONS, FacesMotion
from studies.build.names import HALVES, TRANSPORT_NAMES, VALUES, one_energy, scene_columns
from studies.build.rr98_moving import DRIFT_MOTIONS, DriftMotion
from studies.build.setting import Ready, check_spacings
from studies.kit.case import Case, Outcome, Report
from studies.kit.stats import settled
from studies.rb.tables import POINT

OFTEN = 8           # records of points that move in a free-fall time
RECORDS = 4         # the same of fixed points
LAYERS = 16         # of the profile
#: columns of a run that diverged
DIVERGED = {**dict.fromkeys((*VALUES, "cpu_s"), np.nan), "rolls": 0, "converged": False, "mass_drift": 0.0, "compile_s": 0.0}


@dataclass(frozen=True, kw_only=True)
class PointsRun(Case):
    """One run of a scheme with a name until t_end, in free-fall times; a run that diverges leaves a row without values."""
    scene: RayleighBenard
    seed: int = 1
    t_end: float
    often: ClassVar[int] = OFTEN        # records in a free-fall time

    def __post_init__(self):
        check_spacings(self.scene)

    @property
    @abstractmethod
    def variant(self) -> Any:
        """Of `studies.build`."""

    @abstractmethod
    def values(self, setting: Ready, done: Run) -> dict:
        """Columns of kinetic_energy that the end of the run or its averages give."""

    @property
    def points(self) -> int:
        return round(self.scene.width)*round(self.scene.L)

    @property
    def label(self) -> str:
        law = self.scene.transport
        named = "" if law is ConstEta else f", {TRANSPORT_NAMES[law.__name__]}"
        return f"dih {self.variant.name} Ra {self.scene.ra:g}{named}, {self.points} points, seed {self.seed}"

    def run(self, report: Report, folder: Path) -> Outcome:
        setting, steps, done = followed(self.scene, self.variant, self.seed, self.t_end, self.often, report, folder/"run.h5")
        if done is None:
            return self._outcome(steps, setting.dt, DIVERGED)
        values = {**self.values(setting, done), "cpu_s": done.cpu_s, "compile_s": done.compile_s}
        return self._outcome(steps, setting.dt, values)

    def _outcome(self, steps: int, dt: float, values: dict) -> Outcome:
        key = {"method": "dih", "variant": self.variant.name, **scene_columns(self.scene), "resolution": round(self.scene.L),
               "seed": self.seed, "particles": self.points, "free_fall": self.scene.free_fall, "threads": 1}
        return Outcome({"kinetic_energy": [{**key, **values, "dt": dt, "steps": steps, "t_end": steps*dt}]})


@dataclass(frozen=True, kw_only=True)
class DihRun(PointsRun):
    """One run on fixed points until t_end in free-fall times, when nothing changes any more."""
    scheme: Scheme = SCHEMES["fixed-lattice"]
    t_end: float = 150.0

    often: ClassVar[int] = RECORDS

    @property
    def variant(self) -> Scheme:
        return self.scheme

    @property
    def points(self) -> int:
        """With rows on both plates there is one more than between images."""
        return round(self.scene.width)*(round(self.scene.L) + self.scheme.held)

    @property
    def cost(self) -> float:
        steps = self.t_end*self.scene.L/self.scene.free_fall/max(0.2, 1.1 - self.scene.L/100)
        return steps*4*self.points*100e-9*(self.scheme.h/2)**2 + 5

    def values(self, setting: Ready, done: Run) -> dict:
        """The last ones."""
        x, V, state, end = setting.method.x, setting.method.edges.V, done.state, ended(self.scene, done)
        return {**one_energy(end.ke, end.ke_err), "nu": end.nu, "nu_err": end.nu_err, "converged": end.converged,
                "rolls": rolls(self.scene, x, state[2]/state[0]), "mass_drift": float(V@state[0]/(V@setting.start[0]) - 1)}


@dataclass(frozen=True, kw_only=True)
class AveragedRun(PointsRun):
    """One run of points that move; averages are taken after `mean_from`, in free-fall times."""
    motion: Any
    t_end: float = 90.0
    mean_from: float = 50.0

    @property
    def variant(self) -> Any:
        return self.motion

    def averages(self, done: Run) -> dict:
        """K and Nu; the heat that both plates do not share is in the error of Nu."""
        late, unit = np.array(done.times) > self.mean_from*self.scene.L/self.scene.free_fall, heat_at_rest(self.scene)
        ke, lower, upper = (np.array(done.series[name])[late] for name in ("ke", "lower", "upper"))
        (K, steady), (heat, _) = settled(ke, HALVES), settled((lower - upper)/2/unit)
        balance = np.mean(lower + upper)/2/unit
        return {**one_energy(K.value, K.err), "nu": heat.value, "nu_err": float(np.hypot(heat.err, balance)), "converged": steady}


@dataclass(frozen=True, kw_only=True)
class MovingRun(AveragedRun):
    """One run of the conservative scheme."""
    motion: FacesMotion = MOTIONS["moving"]

    @property
    def cost(self) -> float:
        return self.t_end*self.scene.L/self.scene.free_fall/(0.4*self.motion.of_limit)*self.points*3e-6 + 5

    def values(self, setting: Ready, done: Run) -> dict:
        state = done.state
        return {**self.averages(done), "rolls": rolls(self.scene, state[:2].T, state[5]/state[6]),
                "mass_drift": float(state[6].sum()/setting.start[6].sum() - 1)}


@dataclass(frozen=True, kw_only=True)
class DriftRun(AveragedRun):
    """One run of RR98's own motions. The first seed keeps K(t) and the last profile."""
    motion: DriftMotion = DRIFT_MOTIONS["moving-literal"]

    @property
    def cost(self) -> float:
        return self.t_end*self.scene.L/self.scene.free_fall/0.6*self.points*1.6e-6 + 5

    def values(self, setting: Ready, done: Run) -> dict:
        state, fluid = done.state, setting.method
        drift = fluid.conserved(state)[0]/fluid.conserved(setting.start)[0] - 1
        return {**self.averages(done), "rolls": rolls(self.scene, state[:2].T, state[3]/state[4]), "mass_drift": float(drift),
                "history": self.history(done), "profiles": self.profile(fluid, state)}

    def history(self, done: Run) -> list[dict]:
        """K(t), once a free-fall time."""
        samples = list(zip(done.times, done.series["ke"], strict=True))[::OFTEN]
        return [{"t": t, "t_viscous": t/self.scene.viscous_time, "ke": ke, "ke_field": ke} for t, ke in samples]

    def profile(self, fluid: Any, state: np.ndarray) -> list[dict]:
        """Mass per area, and means over the mass of each layer, at the end."""
        owned, L = fluid.motion.owned(state[6]), self.scene.L
        m, vy = state[4]*state[6]/owned, state[3]/state[4]
        T = fluid.temperature(state)
        layer = np.clip(((state[1]/L + 0.5)*LAYERS).astype(int), 0, LAYERS - 1)
        mass, *sums = (np.bincount(layer, m*q, LAYERS) for q in (np.ones_like(m), T, vy**2, vy*T))
        means = [total/mass for total in sums]
        columns = ((np.arange(LAYERS) + 0.5)/LAYERS - 0.5, mass/(L*self.scene.width/LAYERS), *means)
        return [dict(zip(("y", "rho", "T", "vy2", "vyT"), map(float, row), strict=True)) for row in zip(*columns, strict=True)]

    def _outcome(self, steps: int, dt: float, values: dict) -> Outcome:
        more = {name: values[name] for name in ("history", "profiles") if name in values}
        rows = super()._outcome(steps, dt, {name: value for name, value in values.items() if name not in more}).rows
        [row] = rows["kinetic_energy"]
        key = {name: row[name] for name in (*POINT, "seed")}
        kept = {name: [{**key, **one} for one in some] for name, some in more.items()} if self.seed == 1 else {}
        return Outcome({**rows, **kept})
