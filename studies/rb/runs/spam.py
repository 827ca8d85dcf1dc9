"""One run of smooth particles in the layer or the box, as a case    [KHP95, Secs IV-VI]"""
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from continuum.scene import Periodic, RayleighBenard
from particles.observe import Grid, Smoothed, wall_layers
from particles.run import Divergence, Plan, Run, run
from particles.smooth.spam import Spam
from studies.build.measure import at_end, flowing, turns
from studies.build.names import HALVES, scene_columns
from studies.build.setting import check_spacings
from studies.build.spam import PRINTED, Variant, step
from studies.kit.case import Case, Outcome, Report
from studies.kit.stats import mean, settled
from studies.rb.runs import table_rows
from studies.rb.runs.grid import field_rows
from studies.rb.runs.points import DIVERGED

RECORDS = 8            # a time L/free_fall


@dataclass(frozen=True, kw_only=True)
class SpamRun(Case):
    """One run of smooth particles.

    scene : with L = particle rows over the height (unit spacing). t_end, mean_from : in free-fall times
    L/free_fall, averages are taken after `mean_from`. keep : "" for energies only, "history" for K(t) in
    detail, "fields" for the mean fields besides, "all" for the particles at the end besides. A run that
    diverges is a result: its row has no energies and the time of the failure.
    """
    scene: RayleighBenard
    variant: Variant = PRINTED
    seed: int = 1
    t_end: float = 90.0
    mean_from: float = 40.0
    keep: str = ""

    def __post_init__(self):
        check_spacings(self.scene)

    @property
    def unit(self) -> float:
        """Free-fall time."""
        return self.scene.L/self.scene.free_fall

    @property
    def particles(self) -> int:
        return round(self.scene.width)*round(self.scene.L)

    @property
    def cost(self) -> float:
        steps = self.t_end*self.unit/step(self.scene, self.variant)
        return steps*4*self.particles*230e-9*(self.variant.h/3)**2 + 2

    @property
    def point(self) -> dict:
        """Key columns of every row."""
        return {"method": "spam", "variant": self.variant.name, **scene_columns(self.scene),
                "resolution": round(self.scene.L), "seed": self.seed}

    @property
    def grid(self) -> Grid:
        """Places of the mean fields."""
        return Grid.over((self.scene.width, self.scene.L), min(30, round(self.scene.L)))

    def plan(self, folder: Path) -> Plan:
        """Steps, a fraction of the limit at the temperatures of the plates, and what is recorded."""
        dt = step(self.scene, self.variant)
        return Plan(dt=dt, steps=round(self.t_end*self.unit/dt), mean_from=self.mean_from*self.unit,
                    series=self.variant.series, means={"grid": self.grid, "walls": wall_layers},
                    every=max(1, round(self.unit/RECORDS/dt)), checkpoint=folder/"run.h5")

    def run(self, report: Report, folder: Path) -> Outcome:
        (chosen, start, _), plan = self.variant.ready(self.scene, self.seed), self.plan(folder)
        try:
            done = run(chosen, start, plan, report)
        except Divergence as error:
            return Outcome({"kinetic_energy": [self.row(plan.dt, error.step) | DIVERGED]})
        row = self.row(plan.dt, plan.steps) | self.energies(done)
        rows = {"kinetic_energy": [row], "walls": self.walls(done), "history": self.history(done)}
        if self.keep in ("fields", "all"):
            rows["fields"] = field_rows(self.point, self.scene, self.grid, Smoothed(*done.means["grid"]))
        if self.keep == "all":
            rows["particles"] = self.last(chosen, done)
        return Outcome(rows)

    def row(self, dt: float, steps: int) -> dict:
        """Of `kinetic_energy`, but for the energies."""
        return {**self.point, "particles": self.particles, "free_fall": self.scene.free_fall,
                "mass_drift": 0.0, "threads": 1, "dt": dt, "steps": steps, "t_end": steps*dt}

    def energies(self, done: Run) -> dict:
        """Means of K, of its parts, and of Nu."""
        late = [self.late(done, name) for name in ("kp", "kg", "heat")]
        (kp, steady), (kg, too), (heat, _) = (settled(series, HALVES) for series in late)
        at = Smoothed(*done.means["grid"])
        periodic = isinstance(self.scene.sides, Periodic)
        flow = flowing({"rho": at.rho, "vx": at.vx, "vy": at.vy}, periodic)
        return {"ke": kp.value, "ke_err": kp.err, "ke_field": kg.value, "ke_field_err": kg.err,
                "ke_mean": flow.value, "ke_mean_err": flow.err, "ke_fluctuation": kp.value - kg.value,
                "nu": heat.value/self.conduction, "nu_err": heat.err/self.conduction,
                "rolls": turns(self.scene, at.vy), "converged": steady and too, "cpu_s": done.cpu_s,
                "compile_s": done.compile_s}

    @property
    def conduction(self) -> float:
        """Heat current of the layer at rest, per area."""
        return self.scene.k*self.scene.dT/self.scene.L

    def late(self, done: Run, name: str) -> np.ndarray:
        """A series after `mean_from`."""
        return np.array(done.series[name])[np.array(done.times) > self.mean_from*self.unit]

    def walls(self, done: Run) -> list[dict]:
        """Layers at the plates, and heat in at the lower, out at the upper one."""
        (rho_lower, T_lower), (rho_upper, T_upper) = done.means["walls"]
        lower, upper = (mean(self.late(done, plate)) for plate in ("lower", "upper"))
        return table_rows(
            self.point, plate=["lower", "upper"], T_wall=[self.scene.T_hot, self.scene.T_cold],
            rho_layer=[rho_lower, rho_upper], T_layer=[T_lower, T_upper], reflections=done.reflections,
            nu_plate=[lower.value/self.conduction, -upper.value/self.conduction],
            nu_plate_err=[lower.err/self.conduction, upper.err/self.conduction])

    def history(self, done: Run) -> list[dict]:
        """Some 240 samples where more than energies is kept, 40 elsewhere."""
        every = slice(None, None, max(1, len(done.times)//(240 if self.keep else 40)))
        t, kp, kg = (np.array(series)[every] for series in (done.times, done.series["kp"], done.series["kg"]))
        return table_rows(self.point, t=t, t_viscous=t/self.scene.viscous_time, ke=kp, ke_field=kg)

    def last(self, chosen: Spam, done: Run) -> list[dict]:
        """Fluid particles and what is behind the walls, with velocities and temperatures, at the end."""
        sums, _ = at_end(chosen, done)
        around, L = sums.around, self.scene.L
        number = np.arange(len(around.x))
        kinds = np.select([number < sums.n, number < around.rows], ["fluid", "fixed"], "image")
        return table_rows(self.point, number=number, kind=kinds, x=around.x/L, y=around.y/L, vx=around.vx,
                          vy=around.vy, T=around.T)
