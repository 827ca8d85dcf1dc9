"""The squares of Fig. 10: rolls and pairs of 2500 particles, temperatures 10 and 0.5    [KHP95, Sec. VI]

Printed is Ra 350 000 for eta = k = 0.8 (ideal gas) and 0.4 (dense fluid). The gas has that if alpha is taken
as 1, and 67 150 with its own alpha = 1/<T>; the dense fluid has 340 800 with its own, and 511 200 as scenes
reckon, whose kappa is k/(rho C_V).
"""
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from continuum.fluid import IdealGas
from continuum.scene import RayleighBenard, Walls
from particles.observe import Grid, Smoothed
from particles.run import Plan, run
from studies.build.measure import at_end, turns
from studies.build.names import START_ENERGY
from studies.build.snapshot import Snapshot
from studies.build.spam import Variant
from studies.hardcases.extremes import falls
from studies.kit.case import Case, Outcome, Report

SIDE = 50.0
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
        return 0.5*self.t_end

    @property
    def scene(self) -> RayleighBenard:
        """With eta = k."""
        return RayleighBenard(ra=self.ra, pr=self.eos.cv, eos=self.eos, L=SIDE, aspect=1.0,
                              T_hot=10.0, T_cold=0.5, sides=Walls())

    def run(self, report: Report, folder: Path) -> Outcome:
        scene = self.scene
        variant = Variant("square", weight=self.weight, begin=two_rolls)
        method, start, dt = variant.ready(scene, self.seed)
        unit = falls(scene, 1.0)
        plan = Plan(dt=dt, steps=round(self.t_end*unit/dt), every=max(1, round(unit/4/dt)),
                    mean_from=self.mean_from*unit, means={"grid": Grid.over(method.box, 30)},
                    checkpoint=folder/"run.h5")
        done = run(method, start, plan, report)
        mean, (sums, _) = Smoothed(*done.means["grid"]), at_end(method, done)
        x = np.stack([sums.around.x, sums.around.y], axis=1)
        near = Snapshot(x, np.zeros_like(x), sums.n, SIDE)
        return Outcome({"squares": [{
            "eos": type(self.eos).__name__, "weight": self.weight.__name__, "ra": self.ra, "seed": self.seed,
            "alpha": scene.alpha, "rolls": turns(scene, mean.vy),
            "begun": START_ENERGY*scene.free_fall**2, "flow": kinetic_energy(mean),
            "ratio": near.pairing.value, "ratio_err": near.pairing.err,
            "shared": float(np.mean(near.near(SHARED) > 0))}]})


def kinetic_energy(mean: Smoothed) -> float:
    """K per mass of the mean flow."""
    return float(np.mean(mean.rho*(mean.vx**2 + mean.vy**2))/np.mean(mean.rho)/2)
