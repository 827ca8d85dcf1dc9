"""The squares of Fig. 10: rolls and pairs of 2500 particles between temperatures 10 and 0.5    [KHP95, Sec. VI]

Printed is Ra 350 000 for eta = k = 0.8 (ideal gas) and 0.4 (dense fluid). The gas has that if alpha is taken as 1, and 67 150
with its own alpha = 1/<T>; the dense fluid has 340 800 with its own, and 511 200 as scenes reckon, whose kappa is k/(rho C_V).
"""
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from continuum.fluid import IdealGas
from continuum.scene import RayleighBenard, Walls
from particles.observe import Grid, Smoothed, particle_kinetic
from particles.run import Plan, run
from studies.build.measure import at_end, turns
from studies.build.names import START_ENERGY
from studies.build.spam import Variant
from studies.kit.case import Case, Outcome, Report
from studies.rb.claims.snapshots import Snapshot

SIDE = 50.0
SHARED = 0.5            # spacings within which a neighbour is a partner


def two_rolls(scene: RayleighBenard, x: np.ndarray) -> tuple:
    """(rho, v, T) of two rolls, as energetic over the square of free fall as those of Sec. VI, and conduction."""
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
        chosen, start, dt = Variant("square", weight=self.weight, begin=two_rolls).ready(scene, self.seed)
        unit = scene.L/scene.free_fall
        plan = Plan(dt=dt, steps=round(self.t_end*unit/dt), every=max(1, round(unit/4/dt)),
                    mean_from=self.mean_from*unit, series={"kp": particle_kinetic},
                    means={"grid": Grid.over(chosen.box, 30)}, checkpoint=folder/"run.h5")
        done = run(chosen, start, plan, report)
        sums, _ = at_end(chosen, done)
        around = sums.around
        at = Snapshot(np.stack([around.x, around.y], axis=1), np.stack([around.vx, around.vy], axis=1), sums.n, SIDE)
        near = at.tree.query_ball_point(at.x[at.bulk], SHARED, return_length=True) - 1
        kp = np.array(done.series["kp"])[np.array(done.times) > plan.mean_from]
        mean = Smoothed(*done.means["grid"])
        return Outcome({"squares": [{"eos": type(self.eos).__name__, "weight": self.weight.__name__, "ra": self.ra,
                                     "seed": self.seed, "eta": scene.eta, "alpha": scene.alpha,
                                     "rolls": turns(scene, done.means["grid"][2]),
                                     "begun": START_ENERGY*scene.free_fall**2, "ke": float(kp.mean()),
                                     "flow": float(np.mean(mean.rho*(mean.vx**2 + mean.vy**2))/np.mean(mean.rho)/2),
                                     "ratio": at.pairing.value, "ratio_err": at.pairing.err,
                                     "shared": float(np.mean(near > 0))}]})
