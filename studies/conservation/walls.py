"""Sums of schemes on fixed points over long runs with the walls that RR98 leaves open: held points and sliding sides.

What held points take of momentum and energy is entered in a book, so that fluid and walls together can be watched.
"""
from dataclasses import dataclass
from math import fsum
from typing import Any, NamedTuple

import numpy as np

from continuum.fluid import ConstEta, IdealGas
from particles.integral.bodies import Held, held, in_disc, together, with_plates
from particles.integral.fixed import Exchange
from particles.integral.points import Points, of_positions
from particles.integral.sheared import Sheared, Shearing, above
from particles.integral.stream import Stream, Streaming
from particles.integral.triangulation import between
from particles.pairs import sweep
from particles.threads import Team
from studies.conservation.drift import Drift
from studies.conservation.sums import exact_sums, random_fields

SIDE = 10               # spacings
DEPTH = 3               # of rows of held points: the range of the weights
RADIUS = 2.5            # of the body
SPEED = 0.1             # of the upper rows, of the box above a sliding side


@dataclass(frozen=True, kw_only=True, repr=False)
class Booked(Stream):
    """A stream with a book in its first point's columns: momentum and energy that all walls have taken, over its volume.

    One book of the sum: what held points push each other by cancels at once. Books of single points grow to a thousand times
    the fluid's momentum, and round accordingly.
    """

    names = (*Stream.names, "taken_x", "taken_y", "taken_e")      # type: ignore[assignment]

    def state(self, rho: Any, v: np.ndarray, T: Any) -> np.ndarray:
        """(7, n), nothing taken yet."""
        return np.concatenate([super().state(rho, v, T), np.zeros((3, len(self.x)))])

    def start(self, n: int, team: Team) -> "Booking":
        """The sums over stored edges."""
        super().start(n, team)
        return Booking(self, team)


class Booking(Streaming):
    """The compiled sums of a stream, and what goes into the book."""

    def rates(self, state: np.ndarray, out: np.ndarray) -> None:
        """d(state)/dt of a state (7, n), written to `out`."""
        super().rates(state[:4], out[:4])
        out[4:] = 0
        out[4:, 0] = [fsum(q)/self.method.edges.V[0] for q in self.received.T]


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
class BookedSides(Sheared):
    """Sliding sides with a book: momentum along them and energy that they have given, per volume of the box.

    What leaves below is what enters above seen from the box above, which moves with U: of mass m, momentum p and energy e that
    enter, U m of momentum and U p - U^2 m/2 of energy stay.
    """

    names = (*Sheared.names, "given_x", "given_e")      # type: ignore[assignment]

    def state(self, rho: Any, v: np.ndarray, T: Any) -> np.ndarray:
        """(7, n), nothing given yet."""
        return np.concatenate([super().state(rho, v, T), np.zeros((2, self.points.n))])

    def start(self, n: int, team: Team) -> "BookingSides":
        """The sums over stored edges."""
        super().start(n, team)
        return BookingSides(self, team)


class BookingSides(Shearing):
    """The compiled sums, and what goes into the book."""

    def rates(self, state: np.ndarray, out: np.ndarray) -> None:
        """d(state)/dt of a state (7, n), written to `out`."""
        super().rates(state[:5], out[:5])
        sweep(0, self.n, Exchange(self.method.eos), self.all, above(self.edges, self.method.sides), self.total)
        (m, p, _, _), U = self.total.sum(axis=0)/self.method.edges.V.sum(), self.method.speed
        out[5], out[6] = U*m, U*p - U**2*m/2


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
