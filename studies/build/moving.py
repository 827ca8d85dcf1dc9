"""Moving points that exchange over closed faces in the Rayleigh-Benard scene: the scheme, what it is made of, a run as a case."""
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np

from continuum.scene import Periodic, RayleighBenard
from particles.integral.closed_faces import EXCHANGED, Exchanging, Ingredients, Moving
from particles.integral.exchange import PRINTED
from particles.run import Run
from particles.walls.mirror import plates
from particles.walls.periodic import periodic
from particles.weights import WendlandC2
from studies.build.fixed import positions
from studies.build.names import START_ENERGY, START_JITTER, check_spacings
from studies.build.points import OFTEN, AveragedRun, Setting, rolls


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
    Motion("moving-printed-heat", Ingredients(transport=PRINTED)),
    Motion("moving-half-step", of_limit=0.5),
)}


def method(scene: RayleighBenard, motion: Motion) -> Moving:
    """The method of unit spacing: a scene of L = rows spacings."""
    if not isinstance(scene.sides, Periodic):
        raise ValueError("moving points have plates above and below only: take a scene with periodic sides")
    check_spacings(scene)
    return Moving(weight=motion.weight.of(h=motion.h), eos=scene.eos, law=scene.law, box=(scene.width, scene.L), g=scene.g,
                  walls=(*plates(scene.L, scene.T_hot, scene.T_cold), *periodic(scene.width)), ingredients=motion.ingredients)


def start(scene: RayleighBenard, fluid: Moving, seed: int) -> np.ndarray:
    """Jittered lattice, rolls of Sec. VI, linear temperature, density 1    [KHP95]"""
    x = positions(scene.width, scene.L, START_JITTER, seed)
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
class MovingRun(AveragedRun):
    """One run of the conservative scheme."""
    motion: Motion = MOTIONS["moving"]

    @property
    def cost(self) -> float:
        return self.t_end*self.free_fall_time/(0.4*self.motion.of_limit)*self.points*3e-6 + 5

    def setting(self) -> Setting:
        fluid = method(self.scene, self.motion)
        series: dict[str, Any] = {"ke": kinetic, "lower": PlateHeat(-1), "upper": PlateHeat(1)}
        return Setting(fluid, start(self.scene, fluid, self.seed), self.motion.of_limit, series, OFTEN)

    def values(self, setting: Setting, done: Run) -> dict:
        state = done.state
        return {**self.averages(done), "rolls": rolls(self.scene, state[:2].T, state[5]/state[6]),
                "mass_drift": float(state[6].sum()/setting.first[6].sum() - 1)}
