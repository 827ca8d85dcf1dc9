"""Smooth particles in the Rayleigh-Benard scene: the printed scheme, its variants, and one run as a case."""
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from continuum.fluid import energy, pressure, sound_speed
from continuum.scene import Periodic, RayleighBenard
from particles.methods.spam import Direct, LessStatic, Nested, Spam
from particles.observe import Fields, Grid, Profile, field_kinetic, heat_flow, particle_kinetic, wall_layers
from particles.run import Plan, Run, run
from particles.terms import ArithmeticGradients, Gradients
from particles.walls.fixed import fixed_plates
from particles.walls.mirror import AtWall, Copied, Odd, Own, plates, sides
from particles.walls.periodic import periodic
from particles.weights import Lucy, Monaghan, WendlandC2, WendlandC4, WendlandC6
from studies.convection.names import START_ENERGY, scene_columns
from studies.kit.case import Case, Outcome, Report
from studies.kit.stats import mean

JITTER = 0.2           # of the lattice at the start, in spacings: a perfect one stays frozen in places
STEP = 0.6             # in spacings per sound speed of the ideal gas at T = 1


def images(scene: RayleighBenard, rule: Any = AtWall(), pressure_rule: Any = Copied()) -> tuple:  # noqa: B008
    """Mirror images behind the plates; periodic sides or images there too."""
    L, (hot, cold) = scene.L, (scene.T_hot, scene.T_cold)
    side = (periodic(scene.width) if isinstance(scene.sides, Periodic)
            else sides(scene.width, scene.T_mean, -scene.dT/L, rule, pressure_rule))
    return (*plates(L, hot, cold, rule, pressure_rule), *side)


def images_odd(scene):
    """v -> -v, T -> 2 T_w - T."""
    return images(scene, Odd())


def images_own(scene):
    """Specified v and T, pressure from the image's own state."""
    return images(scene, pressure_rule=Own())


def images_odd_own(scene):
    """v -> -v, T -> 2 T_w - T, pressure from the image's own state."""
    return images(scene, Odd(), Own())


def fixed_rows(scene):
    """Six rows of fixed particles behind each plate, periodic sides    [KHP95, Fig. 2]"""
    return (*fixed_plates(scene.L, scene.T_hot, scene.T_cold), *periodic(scene.width))


class Variant(NamedTuple):
    """One way to build the method; the defaults are the scheme as printed with the walls of Fig. 3."""
    name: str
    weight: Any = Lucy
    h: float = 3.0
    walls: Callable = images
    gradients: Any = Gradients()
    transport: type = Nested
    fraction: float = 0.0


PRINTED = Variant("printed")
VARIANTS = {v.name: v for v in (
    PRINTED,
    Variant("printed-fixed-rows", walls=fixed_rows),
    Variant("printed-monaghan", weight=Monaghan),
    Variant("walls-odd", walls=images_odd),
    Variant("walls-own-pressure", walls=images_own),
    Variant("walls-odd-own-pressure", walls=images_odd_own),
    Variant("arithmetic-mean", gradients=ArithmeticGradients()),
    Variant("direct", transport=Direct),
    Variant("less-static-50", fraction=0.5),
    Variant("less-static-90", fraction=0.9),
    Variant("direct-less-static-90", transport=Direct, fraction=0.9),
    Variant("wendland-c2", weight=WendlandC2),
    Variant("wendland-c4", weight=WendlandC4),
    Variant("wendland-c6", weight=WendlandC6),
    Variant("range-4", h=4.0),
)}


def method(scene: RayleighBenard, variant: Variant) -> Spam:
    """The method of unit spacing and mass: a scene of L = rows spacings."""
    static = LessStatic(variant.fraction, float(pressure(scene.eos, 1.0, energy(scene.eos, 1.0, scene.T_mean))))
    return Spam(weight=variant.weight.of(variant.h), eos=scene.eos, law=scene.law, walls=variant.walls(scene),
                box=(scene.width, scene.L), g=scene.g, gradients=variant.gradients, transport=variant.transport, static=static)


def start(scene: RayleighBenard, seed: int) -> np.ndarray:
    """State (5, n): jittered square lattice, rolls of Sec. VI, linear temperature    [KHP95]"""
    columns, rows = round(scene.width), round(scene.L)
    x, y = np.meshgrid(np.arange(columns) + 0.5 - scene.width/2, np.arange(rows) + 0.5 - scene.L/2)
    shift = np.random.default_rng(seed).uniform(-JITTER, JITTER, (2, columns*rows))
    x, y = x.ravel() + shift[0], y.ravel() + shift[1]
    vx, vy = scene.flow(x, y, START_ENERGY)
    return np.array([x, y, vx, vy, energy(scene.eos, 1.0, scene.T(y))])


@dataclass(frozen=True, kw_only=True)
class SpamRun(Case):
    """One run of smooth particles.

    scene : with L = particle rows over the height (unit spacing). t_end, mean_from : units of time, averages are taken
    after `mean_from`. keep : "" for energies only, "fields" for the mean fields and profile, too, "all" for the
    particles at the end besides.
    """
    scene: RayleighBenard
    variant: Variant = PRINTED
    seed: int = 1
    t_end: float = 4500.0
    mean_from: float = 2000.0
    keep: str = ""
    dt_factor: float = 1.0

    @property
    def dt(self) -> float:
        """0.6 for the ideal gas, in proportion to 1/c for others."""
        c = sound_speed(self.scene.eos, 1.0, energy(self.scene.eos, 1.0, self.scene.T_mean))
        return float(self.dt_factor*STEP*np.sqrt(2)/c)

    @property
    def particles(self) -> int:
        return round(self.scene.width)*round(self.scene.L)

    @property
    def cost(self) -> float:
        return self.t_end/self.dt*4*self.particles*260e-9*(self.variant.h/3)**2 + 2

    @property
    def label(self) -> str:
        where = scene_columns(self.scene)
        return f"spam {self.variant.name} {where['eos']} Ra {self.scene.ra:g}, {self.particles} particles, seed {self.seed}"

    def run(self, report: Report, folder: Path) -> Outcome:
        plan = Plan(dt=self.dt, steps=round(self.t_end/self.dt), mean_from=self.mean_from,
                    series={"kp": particle_kinetic, "kg": field_kinetic, "heat": heat_flow},
                    means={"grid": self._grid, "profile": Profile(round(self.scene.L)), "walls": wall_layers},
                    checkpoint=folder/"run.h5")
        chosen = method(self.scene, self.variant)
        done = run(chosen, start(self.scene, self.seed), plan, report)
        return Outcome({name: list(rows) for name, rows in self._tables(chosen, done, plan).items()})

    @property
    def _grid(self) -> Grid:
        return Grid.over((self.scene.width, self.scene.L), min(30, round(self.scene.L)))

    @property
    def point(self) -> dict:
        """Key columns of every row."""
        return {"method": "spam", "variant": self.variant.name, **scene_columns(self.scene),
                "resolution": round(self.scene.L), "seed": self.seed}

    def _tables(self, chosen: Spam, done: Run, plan: Plan) -> dict:
        rows = {"kinetic_energy": [self._energies(done, plan)], "walls": self._walls(done), "history": self._history(done)}
        if self.keep:
            rows |= {"fields": self._fields(done), "profiles": self._profiles(done)}
        if self.keep == "all":
            rows["particles"] = self._particles(chosen, done)
        return rows

    def _energies(self, done: Run, plan: Plan) -> dict:
        late = np.array(done.times) > self.mean_from
        kp, kg, heat = (mean(np.array(done.series[name])[late]) for name in ("kp", "kg", "heat"))
        unit = self.scene.k*self.scene.dT/self.scene.L
        return {**self.point, "particles": self.particles, "ke": kp.value, "ke_err": kp.err, "ke_field": kg.value,
                "ke_field_err": kg.err, "ke_fluctuation": kp.value - kg.value, "nu": heat.value/unit, "nu_err": heat.err/unit,
                "rolls": self._rolls(done), "free_fall": self.scene.free_fall, "mass_drift": 0.0, "converged": True,
                "dt": plan.dt, "steps": plan.steps, "t_end": self.t_end, "cpu_s": done.cpu_s, "compile_s": done.compile_s,
                "threads": 1}

    def _rolls(self, done: Run) -> int:
        """Changes of sign of the mean vy along mid-height that stand out of the noise (a fifth of its largest value)."""
        vy = done.means["grid"][2]
        mid = vy[len(vy)//2 - 1:len(vy)//2 + 1].mean(axis=0)
        if np.abs(mid).max() < 5e-3*self.scene.free_fall:
            return 0
        up = mid[np.abs(mid) > 0.2*np.abs(mid).max()] > 0
        return int(np.sum(up[1:] != up[:-1]) + (isinstance(self.scene.sides, Periodic) and up[-1] != up[0]))

    def _walls(self, done: Run) -> list[dict]:
        layers = done.means["walls"]
        temperatures = (("lower", self.scene.T_hot), ("upper", self.scene.T_cold))
        return [{**self.point, "plate": plate, "T_wall": T, "rho_layer": layer[0], "T_layer": layer[1],
                 "reflections": done.reflections} for (plate, T), layer in zip(temperatures, layers, strict=True)]

    def _history(self, done: Run) -> list[dict]:
        """At most 200 samples."""
        every = max(1, len(done.times)//200)
        samples = zip(done.times, done.series["kp"], done.series["kg"], strict=True)
        return [{**self.point, "t": t, "t_viscous": t/self.scene.viscous_time, "ke": kp, "ke_field": kg}
                for t, kp, kg in list(samples)[::every]]

    def _fields(self, done: Run) -> list[dict]:
        values, grid = Fields(*done.means["grid"]), self._grid
        columns = (grid.x/self.scene.L, grid.y/self.scene.L, values.rho, values.T, values.vx, values.vy)
        names = ("x", "y", "rho", "T", "vx", "vy")
        return [{**self.point, **dict(zip(names, map(float, row), strict=True))}
                for row in zip(*(c.ravel() for c in columns), strict=True)]

    def _profiles(self, done: Run) -> list[dict]:
        bins = round(self.scene.L)
        y = (np.arange(bins) + 0.5)/bins - 0.5
        return [{**self.point, "y": float(at), "rho": rho, "T": T, "vy2": vy2, "vyT": vyT}
                for at, rho, T, vy2, vyT in zip(y, *done.means["profile"].tolist(), strict=True)]

    def _particles(self, chosen: Spam, done: Run) -> list[dict]:
        """Fluid particles and what is behind the walls, with velocities, at the end."""
        from particles.team import Team
        sums, state = chosen.start(self.particles, Team(1)), done.state.copy()
        sums.around.relist(state, done.ids.copy(), 0.0)
        sums.densities(state)
        around = sums.around
        kinds = ["fluid"]*sums.n + ["fixed"]*(around.rows - sums.n) + ["image"]*(len(around.x) - around.rows)
        L = self.scene.L
        return [{**self.point, "number": i, "kind": kind, "x": x/L, "y": y/L, "vx": vx, "vy": vy}
                for i, (kind, x, y, vx, vy) in enumerate(zip(kinds, around.x, around.y, around.vx, around.vy, strict=True))]
