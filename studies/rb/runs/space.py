"""Convection in a box of 2:2:1: RR98's points on a lattice in three dimensions beside a spectral gas."""
from functools import partial
from pathlib import Path
from typing import Any, ClassVar

import numpy as np

from continuum.fluid import Fields
from continuum.scene import ROLL_ENERGY, RayleighBenard
from continuum.spectral.space import GasInSpace
from particles.fields import kinetic
from particles.integral.edge_makers import renormalised
from particles.integral.layer3d import Layer3D
from particles.integral.points import lattice
from particles.method import OwnRates
from particles.weights import Lucy
from studies.build.measure import ended, followed
from studies.build.setting import Ready, stepped
from studies.kit.case import Case, Outcome, Report

#: how strong rolls about z and rolls about x are at the start
STARTS = {"rolls": (1.0, 0.0), "crossed": (1.0, 0.5), "squares": (1.0, 1.0)}
H = 2.0             # of the weight, in spacings, as in the plane
THIN = 6            # spacings along z of a lattice whose flow is uniform along z: it does not know the depth
OF_LIMIT = 0.7      # of the step limit at the start: the flow adds a fifth to the speed of sound
RECORDS = 4         # in a free-fall time


class Marched(GasInSpace, OwnRates):
    """The spectral gas in the time loop of points."""

    def __init__(self, scene: RayleighBenard, n: int):
        OwnRates.__init__(self, scene)
        GasInSpace.__init__(self, scene, n)


def through(sums: Any, state: np.ndarray, plate: int) -> float:
    """Heat that enters through a plate, per time and depth."""
    depth = sums.V.sum()/(sums.scene.width*sums.scene.L)
    return float(sums.heat_through(state, plate)/depth)


def across(at: Fields, counts: tuple[int, ...]) -> float:
    """Of v_y, averaged over the height: the weaker of the first harmonics along x and z over the stronger."""
    up = np.average(at.v[:, 2].reshape(counts), axis=2, weights=at.V.reshape(counts)[0, 0])
    size = np.abs(np.fft.fft2(up))
    weaker, stronger = sorted([size[1, 0], size[0, 1]])
    return weaker/stronger


class InSpace(Case, table="three_dimensions"):
    """A run until t_end in free-fall times. n : functions of the spectral gas along each axis; 0: points on a
    lattice, scene.L rows of them."""
    scene: RayleighBenard
    start: str
    n: int = 0
    t_end: float
    series: ClassVar = {"ke": kinetic, **{name: partial(through, plate=plate)
                                          for plate, name in enumerate(("lower", "upper"))}}

    @property
    def cost(self) -> float:
        return self.t_end*2e-6*float((self.n or self.scene.L)*np.prod(self.counts))

    @property
    def counts(self) -> tuple[int, int, int]:
        """Places along x, z, y."""
        rows, columns = round(self.scene.L), round(self.scene.width)
        return (self.n,)*3 if self.n else (columns, THIN if self.start == "rolls" else columns, rows)

    def ready(self, scene: RayleighBenard, seed: int = 1) -> Ready:
        """The method, its start and step, as of any variant."""
        method = Marched(scene, self.n) if self.n else Layer3D(
            scene, lattice(self.counts).x, (scene.width, self.counts[1]), renormalised, Lucy.of(h=H, d=3))
        (x, z, y), (a, b) = method.x.T, STARTS[self.start]
        (vx, up), (vz, too) = (scene.flow(along, y, ROLL_ENERGY) for along in (x, z))
        v = np.stack([a*vx, b*vz, a*up + b*too], axis=1)
        return stepped(method, method.state(np.ones(len(x)), v, scene.T(y)), OF_LIMIT)

    def run(self, report: Report, folder: Path) -> Outcome:
        ready, steps, done = followed(self.scene, self, 1, self.t_end, RECORDS, report, folder/"run.h5")
        if done is None:
            raise FloatingPointError(f"{self.label} diverged at step {steps}: take a smaller OF_LIMIT")
        end, (first, last) = ended(self.scene, done), map(ready.method.fields, (ready.start, done.state))
        row = {"method": "spectral-gas" if self.n else "dih", "variant": "" if self.n else "fixed-lattice",
               "start": self.start, "ra": self.scene.ra, "resolution": self.n or round(self.scene.L),
               "particles": 0 if self.n else len(last.rho), **end._asdict(),
               "across": across(last, self.counts), "dt": ready.dt, "t_end": steps*ready.dt,
               "mass_drift": float(last.V@last.rho/(first.V@first.rho) - 1), "cpu_s": done.cpu_s}
        return Outcome({self.table: [row]})
