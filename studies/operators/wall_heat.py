"""What heat passes a plate with odd images, over pairs of today's methods on points that end at the plate.

The profile is that of a layer with Nu = 2, T_m - T = dT (s - sin(2 pi s)/2 pi), s = y/L: flat in the middle,
without a second derivative at the plates, so that images, which have none, may be right to second order.
"""
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from continuum.scene import RayleighBenard
from particles.integral.edge_makers import delaunay, exact
from particles.integral.edges import between_plates
from particles.integral.points import Points
from particles.observe import PlateHeat
from particles.weights import WendlandC2
from studies.build import spam
from studies.build.setting import Disorder
from studies.kit.case import Case, Outcome, Report

NU, WARMER = 2.0, 0.1
#: what else there is pushes in another way and conducts as sph does
SMOOTH = ("sph", "corrected", "delta-plus")
FACES: dict[str, Callable] = {"closed faces": exact, "delaunay": delaunay}


def layer(points: Points) -> tuple[RayleighBenard, np.ndarray]:
    """The layer in the box of some points, and their temperatures."""
    width, L = points.box
    scene = RayleighBenard(ra=1e4, L=float(L), aspect=width/L, T_hot=1 + WARMER/2, T_cold=1 - WARMER/2)
    s = points.x[:, 1]/L
    return scene, scene.T_mean - scene.dT*(s - np.sin(2*np.pi*s)/(2*np.pi))


def through_pairs(points: Points, maker: str) -> np.ndarray:
    """Nu at both plates, of smooth particles at rest."""
    scene, T = layer(points)
    variant, fields = spam.TODAY[maker], (np.ones(len(T)), 0*points.x, T)
    method = spam.method(scene, variant)
    start = variant.transport.complete(spam.start(scene, x=points.x, fields=fields), 1.0, 1.0)
    sums, state, _ = method.look(start)
    sums.prepare(state)
    return scene.L/scene.k/scene.dT*np.array([-side*PlateHeat(side)(sums, state) for side in (-1, 1)])


def through_faces(points: Points, make: Callable) -> np.ndarray:
    """The same over edges, kappa = 1."""
    scene, T = layer(points)
    _, beyond = between_plates(make, points.x, *points.box, WendlandC2.of(h=3.0))      # type: ignore[call-arg]
    plate = np.array([scene.T_hot, scene.T_cold])[beyond.plate]
    flux = beyond.k*(2*plate - T[beyond.parent] - T[beyond.i])*np.where(beyond.plate == 0, 1, -1)
    return scene.L/scene.dT/scene.width*np.bincount(beyond.plate, flux, 2)


@dataclass(frozen=True, kw_only=True)
class WallHeat(Case):
    """One maker between plates; no row where edges cannot be made."""
    maker: str
    disorder: Disorder
    rows: int
    seed: int = 1

    @property
    def cost(self) -> float:
        return 1e-3*self.rows**2

    def run(self, report: Report, folder: Path) -> Outcome:
        points = self.disorder.make((self.rows, self.rows), self.disorder.size, self.seed)
        through: Any = through_faces if self.maker in FACES else through_pairs
        try:
            nu = through(points, FACES.get(self.maker, self.maker))
        except ArithmeticError:     # as of `MakerErrors`
            return Outcome({})
        key = {"maker": self.maker, "points": self.disorder.name, "cells": self.rows, "seed": self.seed}
        return Outcome({"wall_heat": [key | {"wall": np.sqrt(np.mean((nu/NU - 1)**2))}]})
