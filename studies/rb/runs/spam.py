"""One run of smooth particles in the layer or the box, as a case    [KHP95, Secs IV-VI]"""
from typing import Any, ClassVar

import numpy as np

from continuum.scene import Periodic
from particles.observe import Grid, Smoothed, wall_layers
from particles.run import Run
from particles.smooth.spam import Spam
from studies.build.measure import flowing, turns
from studies.build.names import HALVES
from studies.build.setting import Ready
from studies.build.spam import PRINTED, Variant
from studies.kit.stats import mean, settled
from studies.kit.table import Rows
from studies.rb.runs import table_rows
from studies.rb.runs.grid import field_rows
from studies.rb.runs.points import MANY, AveragedRun

FEW = 40            # samples of a history that is not shown


class SpamRun(AveragedRun, table="kinetic_energy"):
    """One run of smooth particles; L of the scene is the number of rows.

    keep : "" for energies only, "history" for K(t) in detail, "fields" for the mean fields besides, "all" for
    the particles at the end besides.
    """
    variant: Variant = PRINTED
    mean_from: float = 40.0
    keep: str = ""
    each: ClassVar[float] = 2.3e-6
    method: ClassVar[str] = "spam"

    @property
    def grid(self) -> Grid:
        """Places of the mean fields."""
        return Grid.over((self.scene.width, self.scene.L), min(30, round(self.scene.L)))

    @property
    def plan(self) -> dict[str, Any]:
        return {"means": {"grid": self.grid, "walls": wall_layers}, "mean_from": self.mean_from*self.unit}

    def more(self, ready: Ready, done: Run) -> Rows:
        samples = MANY if self.keep else FEW
        rows = {"walls": self.walls(done), "history": self.history(done, samples, "kp", "kg")}
        if self.keep in ("fields", "all"):
            rows["fields"] = field_rows(self.point, self.scene, self.grid, Smoothed(*done.means["grid"]))
        if self.keep == "all":
            rows["particles"] = self.last(ready.method, done)
        return rows

    def flow(self, ready: Ready, done: Run) -> dict:
        return {"rolls": turns(self.scene, Smoothed(*done.means["grid"]).vy), "mass_drift": 0.0}

    def energies(self, done: Run) -> dict:
        """Means of K, of its parts, and of Nu."""
        late = [self.late(done, name) for name in ("kp", "kg", "heat")]
        (kp, steady), (kg, too), (heat, _) = (settled(series, HALVES) for series in late)
        at = Smoothed(*done.means["grid"])
        flow = flowing(at._asdict(), isinstance(self.scene.sides, Periodic))
        return {"ke": kp.value, "ke_err": kp.err, "ke_field": kg.value, "ke_field_err": kg.err,
                "ke_mean": flow.value, "ke_mean_err": flow.err, "ke_fluctuation": kp.value - kg.value,
                "nu": heat.value/self.conduction, "nu_err": heat.err/self.conduction,
                "converged": steady and too}

    @property
    def conduction(self) -> float:
        """Heat current of the layer at rest, per area."""
        return self.scene.k*self.scene.dT/self.scene.L

    def walls(self, done: Run) -> list[dict]:
        """Layers at the plates, and heat in at the lower, out at the upper one."""
        (rho_lower, T_lower), (rho_upper, T_upper) = done.means["walls"]
        lower, upper = (mean(self.late(done, plate)) for plate in ("lower", "upper"))
        return table_rows(
            self.point, plate=["lower", "upper"], T_wall=[self.scene.T_hot, self.scene.T_cold],
            rho_layer=[rho_lower, rho_upper], T_layer=[T_lower, T_upper], reflections=done.reflections,
            nu_plate=[lower.value/self.conduction, -upper.value/self.conduction],
            nu_plate_err=[lower.err/self.conduction, upper.err/self.conduction])

    def last(self, chosen: Spam, done: Run) -> list[dict]:
        """Fluid particles and what is behind the walls, with velocities and temperatures, at the end."""
        sums, *_ = chosen.look(done.state)
        around, L = sums.around, self.scene.L
        number = np.arange(len(around.x))
        kinds = np.select([number < sums.n, number < around.rows], ["fluid", "fixed"], "image")
        return table_rows(self.point, number=number, kind=kinds, x=around.x/L, y=around.y/L, vx=around.vx,
                          vy=around.vy, T=around.T)


class MakerRun(SpamRun, table="makers"):
    """The same in a table of its own: `kinetic_energy` is as long as a table may be."""
