"""One run of smooth particles in the layer or the box, as a case    [KHP95, Secs IV-VI]"""
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from continuum.scene import Periodic, RayleighBenard
from particles.observe import Grid, Profile, Smoothed, wall_layers
from particles.run import Divergence, Plan, Run, run
from particles.smooth.spam import Spam
from particles.vtk import write_grid, write_particles
from studies.build.measure import at_end, flowing, turns
from studies.build.names import HALVES, scene_columns
from studies.build.setting import check_spacings
from studies.build.spam import PRINTED, Variant, step
from studies.kit.case import Case, Outcome, Report
from studies.kit.stats import mean, settled
from studies.rb.runs.grid import field_rows
from studies.rb.runs.points import DIVERGED

RECORDS = 8            # a time L/free_fall


@dataclass(frozen=True, kw_only=True)
class SpamRun(Case):
    """One run of smooth particles.

    scene : with L = particle rows over the height (unit spacing). t_end, mean_from : in free-fall times L/free_fall,
    averages are taken after `mean_from`. keep : "" for energies only, "history" for K(t) in detail, "fields" for the mean
    fields and profile besides, "all" for the particles at the end besides, then in files for ParaView, too. A run that
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
    def dt(self) -> float:
        """A fraction of the stability limit of lattice waves at the temperatures of the plates."""
        return step(self.scene, self.variant)

    @property
    def unit(self) -> float:
        """Free-fall time."""
        return self.scene.L/self.scene.free_fall

    @property
    def particles(self) -> int:
        return round(self.scene.width)*round(self.scene.L)

    @property
    def cost(self) -> float:
        return self.t_end*self.unit/self.dt*4*self.particles*230e-9*(self.variant.h/3)**2 + 2

    @property
    def label(self) -> str:
        where = scene_columns(self.scene)
        return f"spam {self.variant.name} {where['eos']} Ra {self.scene.ra:g}, {self.particles} particles, seed {self.seed}"

    def run(self, report: Report, folder: Path) -> Outcome:
        (chosen, start, _), plan = self.variant.ready(self.scene, self.seed), self.plan(folder)
        try:
            done = run(chosen, start, plan, report)
        except Divergence as error:
            return Outcome({"kinetic_energy": [self._row(plan, error.step, DIVERGED)]})
        if self.keep == "all":
            self._draw(chosen, done, folder.parent/"paraview")
        return Outcome({name: list(rows) for name, rows in self._tables(chosen, done, plan).items()})

    def plan(self, folder: Path) -> Plan:
        """Steps, and what is recorded on the way."""
        return Plan(dt=self.dt, steps=round(self.t_end*self.unit/self.dt), mean_from=self.mean_from*self.unit,
                    series=self.variant.series, means={"grid": self._grid, "profile": Profile(round(self.scene.L)),
                                                       "walls": wall_layers},
                    every=max(1, round(self.unit/RECORDS/self.dt)), checkpoint=folder/"run.h5")

    @property
    def _grid(self) -> Grid:
        return Grid.over((self.scene.width, self.scene.L), min(30, round(self.scene.L)))

    @property
    def point(self) -> dict:
        """Key columns of every row."""
        return {"method": "spam", "variant": self.variant.name, **scene_columns(self.scene),
                "resolution": round(self.scene.L), "seed": self.seed}

    def _tables(self, chosen: Spam, done: Run, plan: Plan) -> dict:
        row = self._row(plan, plan.steps, self._energies(done))
        rows = {"kinetic_energy": [row], "walls": self._walls(done), "history": self._history(done)}
        if self.keep in ("fields", "all"):
            at = field_rows(self.point, self.scene, self._grid, Smoothed(*done.means["grid"]))
            rows |= {"fields": at, "profiles": self._profiles(done)}
        if self.keep == "all":
            rows["particles"] = self._particles(chosen, done)
        return rows

    def _energies(self, done: Run) -> dict:
        (kp, steady), (kg, too), (heat, _) = (settled(self._late(done, name), HALVES) for name in ("kp", "kg", "heat"))
        fields = Smoothed(*done.means["grid"])._asdict()
        flow = flowing({name: fields[name] for name in ("rho", "vx", "vy")}, isinstance(self.scene.sides, Periodic))
        return {"ke": kp.value, "ke_err": kp.err, "ke_field": kg.value, "ke_field_err": kg.err, "ke_mean": flow.value,
                "ke_mean_err": flow.err, "ke_fluctuation": kp.value - kg.value, "nu": heat.value/self._heat_unit,
                "nu_err": heat.err/self._heat_unit, "rolls": turns(self.scene, done.means["grid"][2]),
                "converged": steady and too, "cpu_s": done.cpu_s, "compile_s": done.compile_s}

    def _row(self, plan: Plan, steps: int, values: dict) -> dict:
        """Of `kinetic_energy`."""
        return {**self.point, "particles": self.particles, "free_fall": self.scene.free_fall, "mass_drift": 0.0, "dt": plan.dt,
                "threads": 1, **values, "steps": steps, "t_end": steps*plan.dt}

    @property
    def _heat_unit(self) -> float:
        """Conduction alone, per area."""
        return self.scene.k*self.scene.dT/self.scene.L

    def _late(self, done: Run, name: str) -> np.ndarray:
        """A series after `mean_from`."""
        return np.array(done.series[name])[np.array(done.times) > self.mean_from*self.unit]

    def _walls(self, done: Run) -> list[dict]:
        """Layers at the plates, and heat in at the lower, out at the upper one."""
        plates = (("lower", self.scene.T_hot, 1), ("upper", self.scene.T_cold, -1))
        return [{**self.point, "plate": plate, "T_wall": T, "rho_layer": layer[0], "T_layer": layer[1],
                 "reflections": done.reflections, "nu_plate": sign*heat.value/self._heat_unit,
                 "nu_plate_err": heat.err/self._heat_unit}
                for (plate, T, sign), layer in zip(plates, done.means["walls"], strict=True)
                for heat in [mean(self._late(done, plate))]]

    def _history(self, done: Run) -> list[dict]:
        """Some 240 samples where more than energies is kept, 40 elsewhere."""
        every = max(1, len(done.times)//(240 if self.keep else 40))
        samples = zip(done.times, done.series["kp"], done.series["kg"], strict=True)
        return [{**self.point, "t": t, "t_viscous": t/self.scene.viscous_time, "ke": kp, "ke_field": kg}
                for t, kp, kg in list(samples)[::every]]

    def _profiles(self, done: Run) -> list[dict]:
        bins = round(self.scene.L)
        y = (np.arange(bins) + 0.5)/bins - 0.5
        return [{**self.point, "y": float(at), "rho": rho, "T": T, "vy2": vy2, "vyT": vyT}
                for at, rho, T, vy2, vyT in zip(y, *done.means["profile"].tolist(), strict=True)]

    def _particles(self, chosen: Spam, done: Run) -> list[dict]:
        """Fluid particles and what is behind the walls, with velocities and temperatures, at the end."""
        sums, _ = at_end(chosen, done)
        around, L = sums.around, self.scene.L
        kinds = ["fluid"]*sums.n + ["fixed"]*(around.rows - sums.n) + ["image"]*(len(around.x) - around.rows)
        columns = (kinds, around.x/L, around.y/L, around.vx, around.vy, around.T)
        names = ("kind", "x", "y", "vx", "vy", "T")
        return [{**self.point, "number": i, **dict(zip(names, row, strict=True))}
                for i, row in enumerate(zip(*columns, strict=True))]

    def _draw(self, chosen: Spam, done: Run, folder: Path) -> None:
        """Particles at the end and mean fields as files for ParaView, which stay when the case is finished."""
        (sums, state), grid = at_end(chosen, done), self._grid
        n, name = sums.n, "-".join(str(self.point[column]) for column in ("variant", "eos", "ra", "resolution", "seed"))
        folder.mkdir(parents=True, exist_ok=True)
        write_particles(folder/f"{name}.vtp", state, rho=sums.around.rho[:n], T=sums.around.T[:n])
        write_grid(folder/f"{name}.vti", grid.x, grid.y, Smoothed(*done.means["grid"])._asdict())
