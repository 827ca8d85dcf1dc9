"""Sums of schemes on fixed points over long runs with the walls that RR98 leaves open: held points and sliding sides.

What held points take of momentum and energy is entered in a book, so that fluid and walls together can be watched.
"""
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from continuum.fluid import ConstEta, IdealGas
from particles.integral.bodies import Held, held, in_disc, together, with_plates
from particles.integral.booked import Booked, BookedSides
from particles.integral.points import Points, of_positions
from particles.integral.triangulation import between
from studies.conservation.drift import Drift
from studies.conservation.sums import exact_sums, random_fields

SIDE = 10               # spacings
DEPTH = 3               # of rows of held points: the range of the weights
RADIUS = 2.5            # of the body
SPEED = 0.1             # of the upper rows, of the box above a sliding side


class Hold(NamedTuple):
    """What is held: rows below and above at T = 1, of which the upper may slide, such rows of points on the plates themselves, or
    an adiabatic body at rest. Rows that slide past others off a lattice would leave points without mass.
    """
    name: str
    speed: float = 0.0
    on_plates: bool = False
    body: bool = False

    def held(self, points: Points) -> Held:
        """The points, how they move, their temperature."""
        if self.body:
            return held(in_disc(points, RADIUS))
        edge, y = SIDE/2 - (0 if self.on_plates else DEPTH), points.x[:, 1]
        lower, upper = (np.flatnonzero(side*y >= edge) for side in (-1, 1))
        return together(held(lower, T=1.0), held(upper, (self.speed, 0.0), 1.0))


HOLDS = {hold.name: hold for hold in (Hold("rows"), Hold("sliding rows", SPEED), Hold("rows on plates", SPEED, on_plates=True),
                                      Hold("body", body=True))}


@dataclass(frozen=True, kw_only=True)
class HeldDrift(Drift):
    """A run of fluid and held points: with what these took, momentum and energy stay."""
    scheme = "held"
    wall: Hold

    @property
    def cost(self) -> float:
        return 2e-4*self.steps

    def points(self) -> Points:
        if not self.wall.on_plates:
            return self.disorder.make((SIDE, SIDE), self.disorder.size, self.seed)
        inner = self.disorder.make((SIDE, SIDE - 1), self.disorder.size, self.seed).x
        return of_positions(with_plates(inner, SIDE, SIDE)[0], (SIDE, SIDE))

    def method(self, points: Points) -> Booked:
        edges = between(points.x, SIDE, SIDE) if self.wall.on_plates else self.make(points, self.weight.of(h=self.h))
        return Booked(x=points.x, edges=edges, eos=IdealGas(), law=ConstEta(self.mode.eta, self.mode.eta),
                      held=self.wall.held(points), chi=self.mode.chi)

    def start(self, method: Booked, points: Points) -> np.ndarray:
        return method.state(*random_fields(points, self.mode.size, self.seed, not self.wall.body))

    def totals(self, method: Booked, state: np.ndarray) -> np.ndarray:
        return exact_sums(method.edges.V, state[:4]) + np.array([0.0, *exact_sums(method.edges.V, state[4:])])


class Slide(NamedTuple):
    """The box above slides past."""
    name: str = "sliding sides"


@dataclass(frozen=True, kw_only=True)
class SlidingDrift(Drift):
    """A run between sliding sides, on a lattice: with what these gave, momentum and energy stay."""
    scheme = "sliding"
    wall: Slide = Slide()  # noqa: RUF009 (immutable)

    @property
    def cost(self) -> float:
        return 6e-4*self.steps

    def points(self) -> Points:
        return self.disorder.make((SIDE, SIDE), self.disorder.size, self.seed)

    def method(self, points: Points) -> BookedSides:
        return BookedSides(points=points, edges=self.make(points, self.weight.of(h=self.h)), eos=IdealGas(),
                           law=ConstEta(self.mode.eta, self.mode.eta), rate=SPEED/SIDE)

    def start(self, method: BookedSides, points: Points) -> np.ndarray:
        # a wind across would come from boxes that move ever faster
        rho, v, T = random_fields(points, self.mode.size, self.seed, True)
        v[:, 0] += method.rate*points.x[:, 1]
        return method.state(rho, v, T)

    def totals(self, method: BookedSides, state: np.ndarray) -> np.ndarray:
        (px, e) = exact_sums(method.edges.V, state[5:])
        return exact_sums(method.edges.V, state[:4]) - np.array([0.0, px, 0.0, e])
