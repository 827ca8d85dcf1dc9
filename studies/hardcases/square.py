"""The squares of Fig. 10: rolls and pairs of 2500 particles between temperatures 10 and 0.5    [KHP95, Sec.
VI]

Printed is Ra 350 000 for eta = k = 0.8 (ideal gas) and 0.4 (dense fluid). The gas has that if alpha is taken
as 1, and 67 150 with its own alpha = 1/<T>; the dense fluid has 340 800 with its own, and 511 200 as scenes
reckon, whose kappa is k/(rho C_V).
"""
from dataclasses import dataclass
from math import sqrt
from pathlib import Path
from typing import Any

import numpy as np
from scipy.spatial import cKDTree

from continuum.fluid import IdealGas
from continuum.scene import RayleighBenard, Walls
from particles.observe import Grid, Smoothed, particle_kinetic
from particles.run import Plan, run
from studies.build.measure import at_end, turns
from studies.build.names import START_ENERGY
from studies.build.spam import Variant
from studies.kit.case import Case, Outcome, Report
from studies.kit.stats import Measured

SIDE = 50.0
RANGE = 3.0             # of the weight: particles nearer to a plate are not counted
SHARED = 0.5            # spacings within which a neighbour is a partner


def two_rolls(scene: RayleighBenard, x: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """(rho, v, T) of conduction and two rolls, as energetic over free fall squared as in Sec. VI."""
    y = np.clip(x[:, 1], -scene.L/2, scene.L/2)
    v = scene.flow(x[:, 0], y, START_ENERGY*scene.free_fall**2, rolls=2)
    return np.ones(len(x)), np.stack(v, axis=1), scene.T(y)


@dataclass(frozen=True, kw_only=True)
class Square(Case):
    """One run. t_end, mean_from : in free-fall times."""
    weight: Any
    ra: float
    t_end: float
    mean_from: float
    seed: int = 1
    eos: Any = IdealGas()  # noqa: RUF009 (immutable)

    @property
    def cost(self) -> float:
        return 0.3*self.t_end*(1 if isinstance(self.eos, IdealGas) else 3)

    def run(self, report: Report, folder: Path) -> Outcome:
        scene = RayleighBenard(ra=self.ra, L=SIDE, aspect=1.0, T_hot=10.0, T_cold=0.5, sides=Walls(), eos=self.eos,
                               pr=self.eos.cv)      # eta = k
        method, start, dt = Variant("square", weight=self.weight, begin=two_rolls).ready(scene, self.seed)
        unit = scene.L/scene.free_fall
        plan = Plan(dt=dt, steps=round(self.t_end*unit/dt), every=max(1, round(unit/4/dt)),
                    mean_from=self.mean_from*unit, series={"kp": particle_kinetic},
                    means={"grid": Grid.over(method.box, 30)}, checkpoint=folder/"run.h5")
        done = run(method, start, plan, report)
        sums, _ = at_end(method, done)
        near = Neighbours.of(np.stack([sums.around.x, sums.around.y], axis=1), sums.n)
        kp = np.array(done.series["kp"])[np.array(done.times) > plan.mean_from]
        return Outcome({"squares": [{
            "eos": type(self.eos).__name__, "weight": self.weight.__name__, "ra": self.ra, "seed": self.seed,
            "eta": scene.eta, "alpha": scene.alpha, "rolls": turns(scene, done.means["grid"][2]),
            "begun": START_ENERGY*scene.free_fall**2, "ke": float(kp.mean()), "flow": energy(Smoothed(*done.means["grid"])),
            "ratio": near.ratio.value, "ratio_err": near.ratio.err, "shared": near.shared}]})


def energy(mean: Smoothed) -> float:
    """K per mass of the mean flow."""
    return float(np.mean(mean.rho*(mean.vx**2 + mean.vy**2))/np.mean(mean.rho)/2)


@dataclass(frozen=True)
class Neighbours:
    """Of n particles away from the plates: distances (n,), partners (n,) within SHARED."""
    first: np.ndarray
    second: np.ndarray
    partners: np.ndarray

    @classmethod
    def of(cls, x: np.ndarray, n: int) -> "Neighbours":
        """x (points, 2): n particles of the fluid first, then images."""
        bulk = x[:n][np.abs(x[:n, 1]) < SIDE/2 - RANGE]
        tree = cKDTree(x)
        distances, _ = tree.query(bulk, 3)
        _, first, second = np.asarray(distances).T
        return cls(first, second, tree.query_ball_point(bulk, SHARED, return_length=True) - 1)

    @property
    def ratio(self) -> Measured:
        """Median of second over first neighbour distance; partners of a pair are one sample."""
        width = 0.98/sqrt(len(self.first)/2)
        low, middle, high = np.quantile(self.second/self.first, [0.5 - width, 0.5, 0.5 + width])
        return Measured(float(middle), float(high - low)/2)

    @property
    def shared(self) -> float:
        """Part of the particles that have a partner."""
        return float(np.mean(self.partners > 0))
