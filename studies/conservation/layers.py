"""Sums of the compiled scheme on fixed points over long runs, in periodic boxes or between mirror plates    [RR98 Eqs 34-38]"""
from dataclasses import dataclass

import numpy as np

from continuum.fluid import ConstEta, IdealGas
from particles.integral.edges import NONE_BEYOND, between_plates
from particles.integral.layer import Layer
from particles.integral.points import Points, of_positions
from studies.build.disorder import Disorder
from studies.conservation.drift import EVERYTHING, Drift
from studies.conservation.sums import random_fields

SIDE = 8                # spacings
FROM_PLATE = 0.25       # of a spacing: irregular points come no nearer to a plate


def around(disorder: Disorder, seed: int, plates: bool) -> Points:
    """SIDE^2 points in the box, away from plates."""
    at = disorder.make((SIDE, SIDE), disorder.size, seed)
    if not plates:
        return at
    edge = SIDE/2 - FROM_PLATE
    return of_positions(np.stack([at.x[:, 0], np.clip(at.x[:, 1], -edge, edge)], axis=1), at.box)


@dataclass(frozen=True, kw_only=True)
class LayerDrift(Drift):
    """A run on SIDE^2 points."""
    scheme = "layer"

    @property
    def cost(self) -> float:
        return self.steps*(1.9e-4 if self.mode.share < 1 else 0.7e-4)

    @property
    def claimed(self) -> str:
        """Plates take momentum and heat; without friction none along themselves. Gravity works on no discrete mass flux."""
        return "mass" if self.wall.g or (self.wall.plates and self.mode.eta) else EVERYTHING

    def points(self) -> Points:
        return around(self.disorder, self.seed, self.wall.plates)

    def method(self, points: Points) -> Layer:
        """The scheme; without plates there are no images."""
        weight, eta = self.weight.of(h=self.h), self.mode.eta
        edges, beyond = (between_plates(self.make, points.x, SIDE, SIDE, weight) if self.wall.plates
                         else (self.make(points, weight), NONE_BEYOND))
        return Layer(x=points.x, edges=edges, beyond=beyond, eos=IdealGas(), law=ConstEta(eta, eta), T_plates=(1.0, 1.0),
                     g=self.wall.g, mended=self.mode.mended, share=self.mode.share)

    def start(self, method: Layer, points: Points) -> np.ndarray:
        return method.state(*random_fields(points, self.mode.size, self.seed, self.wall.plates))

    def totals(self, method: Layer, state: np.ndarray) -> np.ndarray:
        """With the energy of height; between plates momentum along them only."""
        whole = state.copy()
        whole[3] += self.wall.g*method.x[:, 1]*state[0]
        found = super().totals(method, whole)
        found[2] *= not self.wall.plates
        return found
