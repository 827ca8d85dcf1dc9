"""One run of particles or on points, fixed or moving, in the layer    [KHP95; RR98, Sec. III]"""
from abc import abstractmethod
from pathlib import Path
from typing import Any, ClassVar

import numpy as np
from scipy.interpolate import CloughTocher2DInterpolator

from continuum.fluid import Fields
from continuum.scene import RayleighBenard
from particles.observe import Grid, Smoothed
from particles.run import Run
from studies.build.fixed import SCHEMES, Scheme
from studies.build.measure import ended, followed, heat_at_rest, rolls
from studies.build.moving import CARRIAGES, DRIFT_MOTIONS, MOTIONS, Carriage, DriftMotion, FacesMotion
from studies.build.names import HALVES, VALUES, one_energy, scene_columns
from studies.build.setting import Ready, check_spacings
from studies.kit.case import Case, Outcome, Report
from studies.kit.stats import settled
from studies.kit.table import Rows
from studies.rb.runs import table_rows
from studies.rb.runs.grid import field_rows

MANY = 240          # samples of a history that is shown
#: columns of a run that diverged
DIVERGED = {**dict.fromkeys((*VALUES, "cpu_s"), np.nan), "rolls": 0, "converged": False, "mass_drift": 0.0,
            "compile_s": 0.0}


class PointsRun(Case, table="kinetic_energy"):
    """One run of a variant until t_end, in free-fall times; one that diverges leaves a row without values."""
    scene: RayleighBenard
    variant: Any
    seed: int = 1
    t_end: float
    often: ClassVar[int] = 8            # records in a free-fall time
    each: ClassVar[float]               # CPU seconds for each point and unit of time
    method: ClassVar[str] = "dih"

    def __post_init__(self):
        check_spacings(self.scene)

    @abstractmethod
    def energies(self, done: Run) -> dict:
        """K and Nu with their errors, and whether they have settled."""

    @property
    def cost(self) -> float:
        return self.each*self.scene.width*self.scene.L*self.t_end*self.unit + 5

    @property
    def unit(self) -> float:
        """Free-fall time."""
        return self.scene.L/self.scene.free_fall

    @property
    def plan(self) -> dict[str, Any]:
        """What is recorded besides the series of the variant, as `Plan` has it."""
        return {}

    @property
    def point(self) -> dict:
        """Key columns of every row."""
        return {"method": self.method, "variant": self.variant.name, **scene_columns(self.scene),
                "resolution": round(self.scene.L), "seed": self.seed}

    def run(self, report: Report, folder: Path) -> Outcome:
        ready, steps, done = followed(self.scene, self.variant, self.seed, self.t_end, self.often, report,
                                      folder/"run.h5", **self.plan)
        row = {**self.point, "particles": ready.start.shape[1], "free_fall": self.scene.free_fall,
               "threads": 1, "dt": ready.dt, "steps": steps, "t_end": steps*ready.dt}
        if done is None:
            return Outcome({self.table: [row | DIVERGED]})
        values = {**self.energies(done), "cpu_s": done.cpu_s, "compile_s": done.compile_s}
        return Outcome({self.table: [row | values | self.flow(ready, done)], **self.more(ready, done)})

    def more(self, ready: Ready, done: Run) -> Rows:
        """Rows of other tables."""
        return {}

    def history(self, done: Run, samples: int, ke: str = "ke", field: str = "ke") -> list[dict]:
        """K(t) of all and of the field, some samples."""
        every = slice(None, None, max(1, len(done.times)//samples))
        t, all_of, smooth = (np.array(q)[every] for q in (done.times, done.series[ke], done.series[field]))
        return table_rows(self.point, t=t, t_viscous=t/self.scene.viscous_time, ke=all_of, ke_field=smooth)

    def flow(self, ready: Ready, done: Run) -> dict:
        """Rolls at the end, and the relative change of mass."""
        first, last = ready.method.fields(ready.start), ready.method.fields(done.state)
        return {"rolls": rolls(self.scene, last.x, last.v[:, 1]),
                "mass_drift": float(last.V@last.rho/(first.V@first.rho) - 1)}


class DihRun(PointsRun, table="kinetic_energy"):
    """One run on fixed points until t_end in free-fall times, when nothing changes any more."""
    variant: Scheme = SCHEMES["fixed-lattice"]
    t_end: float = 150.0
    often: ClassVar[int] = 4
    each: ClassVar[float] = 0.7e-6

    def energies(self, done: Run) -> dict:
        """K and Nu at the end of the run."""
        end = ended(self.scene, done)
        return {**one_energy(end.ke, end.ke_err), "nu": end.nu, "nu_err": end.nu_err,
                "converged": end.converged}


class AveragedRun(PointsRun, table="kinetic_energy"):
    """One run of points that move; averages are taken after `mean_from`, in free-fall times."""
    t_end: float = 90.0
    mean_from: float = 50.0

    def late(self, done: Run, name: str) -> np.ndarray:
        """A series after `mean_from`."""
        return np.array(done.series[name])[np.array(done.times) > self.mean_from*self.unit]

    def energies(self, done: Run) -> dict:
        """Means over time; the error of Nu contains the difference of heat at both plates."""
        ke, lower, upper = (self.late(done, name) for name in ("ke", "lower", "upper"))
        twice = 2*heat_at_rest(self.scene)
        (K, steady), (heat, _) = settled(ke, HALVES), settled((lower - upper)/twice)
        nu_err = np.hypot(heat.err, np.mean(lower + upper)/twice)
        return {**one_energy(K.value, K.err), "nu": heat.value, "nu_err": float(nu_err), "converged": steady}


class MovingRun(AveragedRun, table="kinetic_energy"):
    """One run of the conservative scheme."""
    variant: FacesMotion = MOTIONS["moving"]
    each: ClassVar[float] = 11e-6


class DriftRun(AveragedRun, table="kinetic_energy"):
    """One run of RR98's own motions."""
    variant: DriftMotion = DRIFT_MOTIONS["moving-literal"]
    each: ClassVar[float] = 2.7e-6


class CarriedRun(AveragedRun, table="kinetic_energy"):
    """One run of points that move with their triangulation. keep : K(t) and the last fields besides?"""
    variant: Carriage = CARRIAGES["moving-delaunay"]
    t_end: float = 200.0        # two viscous times at Ra 10 000: K is 0.1 % low after 90 free-fall times
    mean_from: float = 150.0
    keep: bool = False
    each: ClassVar[float] = 0.7e-6

    def more(self, ready: Ready, done: Run) -> Rows:
        """Nu at both plates and of the whole layer; what is kept."""
        unit = heat_at_rest(self.scene)
        through = {"lower": self.late(done, "lower"), "upper": -self.late(done, "upper"),
                   "layer": unit + self.late(done, "carried")}
        nu = [settled(heat/unit)[0] for heat in through.values()]
        rows = {"walls": table_rows(self.point, plate=list(through), nu_plate=[one.value for one in nu],
                                    nu_plate_err=[one.err for one in nu])}
        if self.keep:
            rows["history"] = self.history(done, MANY)
            at, grid = ready.method.fields(done.state), Grid.over((self.scene.width, self.scene.L), 30)
            rows["fields"] = field_rows(self.point, self.scene, grid, between(at, self.scene.width, grid))
        return rows


def between(at: Fields, width: float, grid: Grid) -> Smoothed:
    """Fields of points at the places of a grid, by smooth interpolation between points, periodic along x."""
    x = np.concatenate([at.x - [width, 0], at.x, at.x + [width, 0]])
    values = np.tile(np.stack([at.rho, *at.v.T, np.full(len(at.x), np.nan), at.T], axis=1), (3, 1))
    return Smoothed(*CloughTocher2DInterpolator(x, values)(grid.x, grid.y).transpose(2, 0, 1))
