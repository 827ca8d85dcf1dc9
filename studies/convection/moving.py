"""Moving points that exchange over closed faces in the Rayleigh-Benard scene: the scheme, what it is made of, a run as a case."""
from dataclasses import dataclass
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from continuum.scene import Periodic, RayleighBenard
from particles.limits import limit_of
from particles.methods.moving import EXCHANGED, Exchanging, Ingredients, Moving
from particles.run import Divergence, Plan, Run, run
from particles.walls.mirror import plates
from particles.walls.periodic import periodic
from particles.weights import WendlandC2
from studies.convection.dih import positions, rolls
from studies.convection.names import START_ENERGY, VALUES, one_energy, scene_columns
from studies.kit.case import Case, Outcome, Report
from studies.kit.stats import settled

JITTER = 0.2        # of the lattice at the start, in spacings, as for smooth particles
RECORDS = 8         # a free-fall time
HALVES = 0.3        # of K: if halves of the averaging time differ by more, the flow is not steady


class Motion(NamedTuple):
    """The scheme with its ingredients."""
    name: str
    ingredients: Ingredients = Ingredients()
    weight: Any = WendlandC2
    h: float = 3.0
    of_limit: float = 1.0


MOTIONS = {m.name: m for m in (
    Motion("moving"),
    Motion("moving-open-faces", Ingredients(iterations=0)),
    Motion("moving-closer-faces", Ingredients(iterations=12)),
    Motion("moving-no-shift", Ingredients(shift=0.0)),
    Motion("moving-no-follow", Ingredients(follow=0.0)),
    Motion("moving-no-spread", Ingredients(spread=0.0)),
    Motion("moving-plain-spread", Ingredients(smooth=False)),
    Motion("moving-whole-pressure", Ingredients(static=False)),
    Motion("moving-printed-heat", Ingredients(mended=False)),
    Motion("moving-half-step", of_limit=0.5),
)}


def method(scene: RayleighBenard, motion: Motion) -> Moving:
    """The method of unit spacing: a scene of L = rows spacings."""
    if not isinstance(scene.sides, Periodic):
        raise ValueError("moving points have plates above and below only: take a scene with periodic sides")
    return Moving(weight=motion.weight.of(h=motion.h), eos=scene.eos, law=scene.law, box=(scene.width, scene.L), g=scene.g,
                  walls=(*plates(scene.L, scene.T_hot, scene.T_cold), *periodic(scene.width)), ingredients=motion.ingredients)


def start(scene: RayleighBenard, fluid: Moving, seed: int) -> np.ndarray:
    """Jittered lattice, rolls of Sec. VI, linear temperature, density 1    [KHP95]"""
    x = positions(scene, JITTER, seed)
    return fluid.state(x, np.stack(scene.flow(x[:, 0], x[:, 1], START_ENERGY), axis=1), 1.0, scene.T(x[:, 1]))


def kinetic(sums: Exchanging, state: np.ndarray) -> float:
    """K per mass."""
    px, py, m, _, _ = state[EXCHANGED]
    return float(0.5*np.sum((px**2 + py**2)/m)/m.sum())


class PlateHeat(NamedTuple):
    """Heat that enters the fluid through a plate (-1: lower, 1: upper), per time."""
    side: int

    def __call__(self, sums: Exchanging, state: np.ndarray) -> float:
        """Over all faces to images behind the plate."""
        faces, points, n, half = sums.faces, sums.points, sums.n, sums.method.box[1]/2
        near = np.flatnonzero(self.side*state[1] > half - sums.method.weight.h)
        row = np.repeat(near, faces.taken[near])
        offset = np.arange(len(row)) - np.repeat(np.cumsum(faces.taken[near]) - faces.taken[near], faces.taken[near])
        entry = (np.repeat(faces.first[near].astype(np.int64), faces.taken[near]) + offset.astype(np.int64))
        image = faces.near[entry]
        behind = (image >= n) & (self.side*sums.around.y[image] > half)
        a, b, k = points[row[behind]], points[image[behind]], faces.k[entry[behind]]
        return float(np.sum(k*(a["k"] + b["k"])/2*(b["Td"] - a["Td"])))


@dataclass(frozen=True, kw_only=True)
class MovingRun(Case):
    """One run; averages are taken after `mean_from`, in free-fall times."""
    scene: RayleighBenard
    motion: Motion = MOTIONS["moving"]
    seed: int = 1
    t_end: float = 90.0
    mean_from: float = 50.0

    @property
    def points(self) -> int:
        return round(self.scene.width)*round(self.scene.L)

    @property
    def cost(self) -> float:
        return self.t_end*self.scene.L/self.scene.free_fall/(0.4*self.motion.of_limit)*self.points*3e-6 + 5

    @property
    def label(self) -> str:
        return f"dih {self.motion.name} Ra {self.scene.ra:g}, {self.points} points, seed {self.seed}"

    def run(self, report: Report, folder: Path) -> Outcome:
        fluid = method(self.scene, self.motion)
        first, unit = start(self.scene, fluid, self.seed), self.scene.L/self.scene.free_fall
        dt = self.motion.of_limit*limit_of(fluid, first)
        series: dict[str, Any] = {"ke": kinetic, "lower": PlateHeat(-1), "upper": PlateHeat(1)}
        plan = Plan(dt=dt, steps=round(self.t_end*unit/dt), series=series, every=max(1, round(unit/RECORDS/dt)),
                    checkpoint=folder/"run.h5")
        try:
            done = run(fluid, first, plan, report)
        except Divergence as error:
            lost = {**self._key, **dict.fromkeys((*VALUES, "cpu_s"), np.nan), "dt": dt, "rolls": 0, "converged": False,
                    "steps": error.step, "t_end": error.step*dt, "compile_s": 0.0, "mass_drift": 0.0}
            return Outcome({"kinetic_energy": [lost]})
        return Outcome({"kinetic_energy": [self._row(done, plan, first)]})

    @property
    def _key(self) -> dict:
        return {"method": "dih", "variant": self.motion.name, **scene_columns(self.scene), "resolution": round(self.scene.L),
                "seed": self.seed, "particles": self.points, "free_fall": self.scene.free_fall, "threads": 1}

    def _row(self, done: Run, plan: Plan, first: np.ndarray) -> dict:
        unit = self.scene.k*self.scene.dT/self.scene.L*self.scene.width
        late = np.array(done.times) > self.mean_from*self.scene.L/self.scene.free_fall
        ke, lower, upper = (np.array(done.series[name])[late] for name in ("ke", "lower", "upper"))
        (K, steady), (heat, _), balance = settled(ke, HALVES), settled((lower - upper)/2/unit), np.mean(lower + upper)/2/unit
        state = np.stack([done.state[6], done.state[4], done.state[5]])
        return {**self._key, **one_energy(K.value, K.err), "nu": heat.value, "nu_err": float(np.hypot(heat.err, balance)),
                "rolls": rolls(self.scene, done.state[:2].T, state), "mass_drift": float(done.state[6].sum()/first[6].sum() - 1),
                "converged": steady, "dt": plan.dt, "steps": plan.steps, "t_end": plan.steps*plan.dt, "cpu_s": done.cpu_s,
                "compile_s": done.compile_s}
