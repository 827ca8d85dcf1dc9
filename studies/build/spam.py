"""Smooth particles: the scheme as printed and its variants, in any scene    [KHP95]"""
from collections.abc import Callable
from functools import cache
from typing import Any, NamedTuple

import numpy as np

from continuum.fluid import energy, pressure
from continuum.gas.fields import interpolate
from continuum.gas.solve import steady_on
from continuum.scene import Torus
from particles.limits import step_limit
<<<<<<< HEAD
from particles.observe import (
    Grid,
    PlateHeat,
    Profile,
    Smoothed,
    field_kinetic,
    heat_flow,
    particle_kinetic,
    wall_layers,
)
from particles.run import Divergence, Plan, Run, run
=======
from particles.observe import PlateHeat, field_kinetic, heat_flow, particle_kinetic
>>>>>>> build
from particles.smooth.spam import Direct, LessStatic, Nested, Spam
from particles.terms import ArithmeticGradients, Gradients
from particles.walls.fixed import fixed_plates
from particles.walls.mirror import Odd, Own
from particles.walls.periodic import periodic
from particles.weights import Lucy, Monaghan, WendlandC2, WendlandC4, WendlandC6
from studies.build.names import START_JITTER
from studies.build.setting import Ready, check_spacings
from studies.build.setting import walls as around

#: time step over its stability limit: dt = 0.4 for the printed scheme. RK4 damps the fastest waves by 0.04 % a step; what
#: counts is that particles turn at a plate up to v dt beyond it, which leaves errors of first order in dt g L: half of the
#: step raises the Nusselt number by 4 % at 16 rows, 0.6 % at 25, 0.2 % at 50.
OF_LIMIT = 0.22


def images(scene: Any) -> tuple:
    """Images at rest with the plate's temperature, pressure of the particle    [KHP95, Fig. 3]"""
    return around(scene)


def images_odd(scene: Any) -> tuple:
    """v -> -v, T -> 2 T_w - T."""
    return around(scene, Odd())


def images_own(scene: Any) -> tuple:
    """Specified v and T, pressure from the image's own state."""
    return around(scene, pressure=Own())


def images_odd_own(scene: Any) -> tuple:
    """v -> -v, T -> 2 T_w - T, pressure from the image's own state."""
    return around(scene, Odd(), Own())


def fixed_rows(scene: Any) -> tuple:
    """Six rows of fixed particles behind each plate, periodic sides    [KHP95, Fig. 2]"""
    return (*fixed_plates(scene.L, scene.T_hot, scene.T_cold), *periodic(scene.width))


def developed(scene: Any, x: np.ndarray) -> tuple:
    """(rho, v, T) of the grid's steady flow at x (n, 2): not every state that can go on is reached from weak rolls."""
    at = interpolate(steady_on(scene, (16, 24))[-1].fields, x[:, 0], np.clip(x[:, 1], -scene.L/2, scene.L/2))
    return np.ones(len(x)), np.stack([at.vx, at.vy], axis=1), at.T


class _Choices(NamedTuple):
    name: str
    weight: Any = Lucy
    h: float = 3.0
    walls: Callable = images
    gradients: Any = Gradients()
    transport: type = Nested
    fraction: float = 0.0
    step: float = OF_LIMIT
    begin: Callable | None = None


class Variant(_Choices):
    """One way to build the method; the defaults are the scheme as printed with the walls of Fig. 3.

    weight : a class of `particles.weights`; h : its range. step : over its limit. begin : (scene, x) -> (rho, v, T) at the start;
    None for the scene's own.

    Raises
    ------
    TypeError
        The weight is no class of weights.
    """

    def __new__(cls, *choices, **more):
        self = super().__new__(cls, *choices, **more)
        if not (isinstance(self.weight, type) and hasattr(self.weight, "of")):
            raise TypeError(f"the weight of a variant must be a class of weights, got {self.weight!r}: give the class, such as "
                            "Lucy, and its range as h")
        return self

    def ready(self, scene: Any, seed: int = 1, x: np.ndarray | None = None, fields: tuple | None = None) -> Ready:
        """The method in a scene; from places x (n, 2) and fields (rho, v, T) there, if given."""
        return Ready(method(scene, self), start(scene, seed, self.begin, x, fields), step(scene, self))

    @property
    def series(self) -> dict[str, Any]:
        """Quantities of a run: K of all particles and of the smoothed field, heat upwards and through both plates."""
        return {"kp": particle_kinetic, "kg": field_kinetic, "heat": heat_flow, "lower": PlateHeat(-1), "upper": PlateHeat(1)}


PRINTED = Variant("printed")
VARIANTS = {v.name: v for v in (
    PRINTED,
    Variant("printed-half-step", step=OF_LIMIT/2),
    Variant("printed-from-flow", begin=developed),
    Variant("printed-fixed-rows", walls=fixed_rows),
    Variant("printed-monaghan", weight=Monaghan),
    Variant("walls-odd", walls=images_odd),
    Variant("walls-own-pressure", walls=images_own),
    Variant("walls-odd-own-pressure", walls=images_odd_own),
    Variant("arithmetic-mean", gradients=ArithmeticGradients()),
    Variant("direct", transport=Direct),
    Variant("more-static-400", fraction=-4.0),
    Variant("more-static-100", fraction=-1.0),
    Variant("less-static-50", fraction=0.5),
    Variant("less-static-90", fraction=0.9),
    Variant("direct-less-static-90", transport=Direct, fraction=0.9),
    Variant("wendland-c2", weight=WendlandC2),
    Variant("wendland-c4", weight=WendlandC4),
    Variant("wendland-c6", weight=WendlandC6),
    Variant("range-4", h=4.0),
    Variant("range-6", h=6.0),
)}


def method(scene: Any, variant: Variant) -> Spam:
    """The method of unit spacing and mass: a scene of L = rows spacings."""
    static = LessStatic(variant.fraction, float(pressure(scene.eos, 1.0, energy(scene.eos, 1.0, scene.T_mean))))
    walls = (around if isinstance(scene.sides, Torus) else variant.walls)(scene)
    return Spam(weight=variant.weight.of(variant.h), eos=scene.eos, law=scene.law, walls=walls, box=(scene.width, scene.L),
                g=scene.g, gradients=variant.gradients, transport=variant.transport, static=static)


@cache
def step(scene: Any, variant: Variant) -> float:
    """Time step, in units of time: its fraction of the limit of lattice waves at the plates' temperatures, for all seeds."""
    return variant.step*step_limit(method(scene, variant), energy(scene.eos, 1.0, np.array([scene.T_cold, scene.T_hot])))


def start(scene: Any, seed: int = 1, begin: Callable | None = None, x: np.ndarray | None = None,
          fields: tuple | None = None) -> np.ndarray:
    """State (5, n); `begin` as a variant has it."""
    x = scattered(scene, seed) if x is None else x
    _, v, T = fields or (begin(scene, x) if begin else scene.fields(x))
    return np.array([*x.T, *v.T, energy(scene.eos, 1.0, T)])


def scattered(scene: Any, seed: int) -> np.ndarray:
    """Places (n, 2): a jittered square lattice."""
    check_spacings(scene)
    columns, rows = round(scene.width), round(scene.L)
    x, y = np.meshgrid(np.arange(columns) + 0.5 - scene.width/2, np.arange(rows) + 0.5 - scene.L/2)
    shift = np.random.default_rng(seed).uniform(-START_JITTER, START_JITTER, (2, columns*rows))
<<<<<<< HEAD
    x, y = x.ravel() + shift[0], y.ravel() + shift[1]
    if begin is None:
        (vx, vy), T = scene.flow(x, y, START_ENERGY), scene.T(y)
    else:
        vx, vy, T = begin(scene, x, np.clip(y, -scene.L/2, scene.L/2))
    return np.array([x, y, vx, vy, energy(scene.eos, 1.0, T)])


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
        chosen, plan = method(self.scene, self.variant), self.plan(folder)
        try:
            done = run(chosen, start(self.scene, self.seed, self.variant.begin), plan, report)
        except Divergence as error:
            return Outcome({"kinetic_energy": [self._diverged(plan, error.step)]})
        if self.keep == "all":
            self._draw(done, folder.parent/"paraview")
        return Outcome({name: list(rows) for name, rows in self._tables(chosen, done, plan).items()})

    def plan(self, folder: Path) -> Plan:
        """Steps, and what is recorded on the way."""
        series: dict[str, Any] = {"kp": particle_kinetic, "kg": field_kinetic, "heat": heat_flow, "lower": PlateHeat(-1),
                                  "upper": PlateHeat(1)}
        return Plan(dt=self.dt, steps=round(self.t_end*self.unit/self.dt), mean_from=self.mean_from*self.unit, series=series,
                    means={"grid": self._grid, "profile": Profile(round(self.scene.L)), "walls": wall_layers},
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
        rows = {"kinetic_energy": [self._energies(done, plan)], "walls": self._walls(done), "history": self._history(done)}
        if self.keep in ("fields", "all"):
            rows |= {"fields": self._fields(done), "profiles": self._profiles(done)}
        if self.keep == "all":
            rows["particles"] = self._particles(chosen, done)
        return rows

    def _energies(self, done: Run, plan: Plan) -> dict:
        (kp, steady), (kg, too), (heat, _) = (settled(self._late(done, name), HALVES) for name in ("kp", "kg", "heat"))
        fields = Smoothed(*done.means["grid"])._asdict()
        flow = flowing({name: fields[name] for name in ("rho", "vx", "vy")}, isinstance(self.scene.sides, Periodic))
        return {**self.point, **self._spent(plan), "ke": kp.value, "ke_err": kp.err, "ke_field": kg.value,
                "ke_field_err": kg.err, "ke_mean": flow.value, "ke_mean_err": flow.err,
                "ke_fluctuation": kp.value - kg.value, "nu": heat.value/self._heat_unit,
                "nu_err": heat.err/self._heat_unit, "rolls": self._rolls(done), "converged": steady and too,
                "steps": plan.steps, "t_end": plan.steps*plan.dt, "cpu_s": done.cpu_s, "compile_s": done.compile_s}

    def _diverged(self, plan: Plan, steps: int) -> dict:
        empty = dict.fromkeys((*VALUES, "cpu_s"), np.nan)
        return {**self.point, **self._spent(plan), **empty, "rolls": 0, "converged": False, "steps": steps,
                "t_end": steps*plan.dt, "compile_s": 0.0}

    def _spent(self, plan: Plan) -> dict:
        return {"particles": self.particles, "free_fall": self.scene.free_fall, "mass_drift": 0.0, "dt": plan.dt, "threads": 1}

    @property
    def _heat_unit(self) -> float:
        """Conduction alone, per area."""
        return self.scene.k*self.scene.dT/self.scene.L

    def _late(self, done: Run, name: str) -> np.ndarray:
        """A series after `mean_from`."""
        return np.array(done.series[name])[np.array(done.times) > self.mean_from*self.unit]

    def _rolls(self, done: Run) -> int:
        """Changes of sign of the mean vy along mid-height that stand out of the noise (a fifth of its largest value)."""
        vy = done.means["grid"][2]
        mid = vy[len(vy)//2 - 1:len(vy)//2 + 1].mean(axis=0)
        if np.abs(mid).max() < 5e-3*self.scene.free_fall:
            return 0
        up = mid[np.abs(mid) > 0.2*np.abs(mid).max()] > 0
        return int(np.sum(up[1:] != up[:-1]) + (isinstance(self.scene.sides, Periodic) and up[-1] != up[0]))

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

    def _fields(self, done: Run) -> list[dict]:
        values, grid = Smoothed(*done.means["grid"]), self._grid
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
        """Fluid particles and what is behind the walls, with velocities and temperatures, at the end."""
        sums, _ = at_end(chosen, done)
        around, L = sums.around, self.scene.L
        kinds = ["fluid"]*sums.n + ["fixed"]*(around.rows - sums.n) + ["image"]*(len(around.x) - around.rows)
        columns = (kinds, around.x/L, around.y/L, around.vx, around.vy, around.T)
        names = ("kind", "x", "y", "vx", "vy", "T")
        return [{**self.point, "number": i, **dict(zip(names, row, strict=True))}
                for i, row in enumerate(zip(*columns, strict=True))]

    def _draw(self, done: Run, folder: Path) -> None:
        """Particles at the end and mean fields as files for ParaView, which stay when the case is finished."""
        (sums, state), grid = at_end(method(self.scene, self.variant), done), self._grid
        n, name = sums.n, "-".join(str(self.point[column]) for column in ("variant", "eos", "ra", "resolution", "seed"))
        folder.mkdir(parents=True, exist_ok=True)
        write_particles(folder/f"{name}.vtp", state, rho=sums.around.rho[:n], T=sums.around.T[:n])
        write_grid(folder/f"{name}.vti", grid.x, grid.y, Smoothed(*done.means["grid"])._asdict())


def at_end(chosen: Spam, done: Run) -> tuple[Any, np.ndarray]:
    """(sums, state): the last state in the order of new lists, with densities, motion and images."""
    sums, state = chosen.start(done.state.shape[1], Team(1)), done.state.copy()
    sums.around.relist(state, done.ids.copy(), 0.0)
    sums.densities(state)
    return sums, state
=======
    return np.stack([x.ravel() + shift[0], y.ravel() + shift[1]]).T
>>>>>>> build
