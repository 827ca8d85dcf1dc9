"""What becomes of particles that are left alone: one a site, or two, or more?    [KHP95, Secs IV, VI, Figs 4, 10]"""
from dataclasses import dataclass
from math import pi
from pathlib import Path
from typing import Any

import numpy as np
from scipy.spatial import cKDTree

from continuum.fluid import ConstEta
from particles.limits import step_limit
from particles.run import STUDIES, Plan, run
from studies.build.names import START_JITTER
from studies.build.periodic_box import at_rest, fluid
from studies.kit.case import Case, Outcome, Report
from studies.lattices.waves import sites_of_least_energy

SIDE = 16               # particles along each side
SPEED = 0.3             # rms of each velocity at the start: half of what flows of KHP95 have at most, friction takes it away
LAW = ConstEta(0.5, 0.5)
TIME = 300.0            # 20 times L/c
PARTNER = 0.5           # spacings within which a neighbour shares a site: sites of one particle are 1.07 apart


def median_ratio(x: np.ndarray, box: tuple[float, float]) -> float:
    """Median of second over first neighbour distance of particles (n, 2) in a periodic box."""
    at = wrapped(x, box)
    distances, _ = cKDTree(at, boxsize=np.array(box)).query(at, 3)
    _, first, second = np.transpose(distances)
    return float(np.median(second/first))


def partners(x: np.ndarray, box: tuple[float, float]) -> np.ndarray:
    """(n,): other particles within half a spacing."""
    at = wrapped(x, box)
    return cKDTree(at, boxsize=np.array(box)).query_ball_point(at, PARTNER, return_length=True) - 1


def wrapped(x: np.ndarray, box: tuple[float, float]) -> np.ndarray:
    """Places as scipy wants them: from 0 to the box."""
    return np.mod(x, box) % box


@dataclass(frozen=True, kw_only=True)
class Fate(Case):
    """Particles of the viscous, conducting ideal gas in a periodic square, from a shifted lattice and random velocities."""
    weight: Any
    h: float
    seed: int = 1

    @property
    def cost(self) -> float:
        return 1.0

    def run(self, report: Report, folder: Path) -> Outcome:
        weight, box = self.weight.of(h=self.h), (float(SIDE), float(SIDE))
        method, start = fluid(weight, box, law=LAW), self._start()
        dt = STUDIES*step_limit(method, 1.0)
        x = run(method, start, Plan(dt=dt, steps=round(TIME/dt)), report).state[:2].T
        near = partners(x, box)
        return Outcome({"fates": [{"weight": self.weight.__name__, "h": self.h, "seed": self.seed,
                                   "predicted": sites_of_least_energy(weight), "sites": 1 + float(np.median(near)),
                                   "shared": float(np.mean(near > 0)), "ratio": median_ratio(x, box),
                                   "chance": 1 - np.exp(-pi*PARTNER**2)}]})

    def _start(self) -> np.ndarray:
        rng = np.random.default_rng(self.seed)
        x = np.stack(np.meshgrid(*2*[np.arange(SIDE) + 0.5 - SIDE/2]), axis=-1).reshape(-1, 2)
        state = at_rest(x + rng.uniform(-START_JITTER, START_JITTER, x.shape), 1.0)
        state[2:4] = SPEED*rng.standard_normal((2, len(x)))
        return state
