"""Hard cases without plates on the compressible grid, as coarse as the points are."""
from collections.abc import Iterator
from dataclasses import dataclass
from math import ceil
from pathlib import Path
from typing import Any

import numpy as np

from continuum.gas.fields import block, placed, unblock
from continuum.gas.loop import FluxForm
from continuum.gas.solve import SAFETY, DivergedError, March, limits
from continuum.scene import Tile
from studies.hardcases.map.cases import SAMPLES, Watch, of_grid, row
from studies.hardcases.map.methods import Built, fields
from studies.hardcases.map.scenes import BOXES
from studies.hardcases.map.shear import GROWN, Amplitude, ShearFlow, growth
from studies.kit.case import Case, Outcome, Report

CASES = ("zero viscosity", "vacuum")
GRID = "grid"


class Going:
    """A grid that has started."""

    def __init__(self, scene: Any):
        self.tile, self.rows = Tile(width=scene.width, L=scene.L, eos=scene.eos, law=scene.law), round(scene.L)

        def start(x: np.ndarray, y: np.ndarray) -> tuple[np.ndarray, ...]:
            rho, v, T = fields(scene, np.stack([x.ravel(), y.ravel()], axis=1))
            return tuple(f.reshape(x.shape) for f in (rho, *v.T, T))
        # the ghosts of a block are filled by its march
        self.first = March(self.tile, block(placed(self.tile, self.rows, start)), FluxForm(), 1.0).S

    @property
    def built(self) -> Built:
        """As those who look at points want it."""
        return Built(None, self.first, SAFETY*limits(self.tile, self.first).both, lambda S: of_grid(unblock(self.tile, S)))

    def go(self, time: float, samples: int, look: Any, report: Report) -> float:
        """The part of the time that was reached; look(None, block) at the end of each sample."""
        every = ceil(time/samples/self.built.dt)
        march = March(self.tile, self.first.copy(), FluxForm(), time/samples/every)
        for sample in range(samples):
            try:
                march.go(every)
            except DivergedError:
                return march.steps/(every*samples)
            look(None, march.S)
            report((sample + 1)/samples)
        return 1.0


@dataclass(frozen=True, kw_only=True)
class OnTorus(Case):
    """The grid in a box whose points have no plates either."""
    case: str

    @property
    def cost(self) -> float:
        return 2.0

    @property
    def label(self) -> str:
        return f"map {self.case}, {GRID}"

    def run(self, report: Report, folder: Path) -> Outcome:
        scene, time = BOXES[self.case]
        grid = Going(scene)
        watch = Watch(grid.built, (scene.width, scene.L))
        reached = grid.go(time, SAMPLES, watch, report)
        lost = {} if reached == 1 else {"k": np.nan, "flow": np.nan}
        return row(self.case, GRID, {**watch.late, **lost, "reached": reached}, grid.rows)


@dataclass(frozen=True, kw_only=True)
class Sheared(Case):
    """The growth of the wave on a shear flow."""

    @property
    def cost(self) -> float:
        return 2.0

    @property
    def label(self) -> str:
        return f"map shear layer, {GRID}"

    def run(self, report: Report, folder: Path) -> Outcome:
        scene = ShearFlow()
        time, grid = GROWN/scene.wave.rate, Going(scene)
        seen = Amplitude(grid.built, scene.k/2)
        return growth(GRID, scene, time, seen, grid.go(time, SAMPLES, seen, report))


def cases(size: str) -> Iterator[Case]:
    """All of them."""
    if size != "quick":
        yield from (OnTorus(case=case) for case in CASES)
        yield Sheared()
