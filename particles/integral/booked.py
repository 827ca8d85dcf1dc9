"""Walls with a book of what they take or give, so that fluid and walls together can be watched over a run."""
from dataclasses import dataclass
from math import fsum
from typing import Any

import numpy as np

from particles.integral.sheared import Sheared, Shearing, above
from particles.integral.stream import Stream, Streaming
from particles.threads import Team


@dataclass(frozen=True, kw_only=True, repr=False)
class Booked(Stream):
    """A stream with a book in its first point's columns: momentum and energy taken by all walls.

    One book of the sum: what held points push each other by cancels at once. Books of single points grow to a
    thousand times the fluid's momentum, and round accordingly.
    """

    names = (*Stream.names, "taken_x", "taken_y", "taken_e")

    def state(self, rho: Any, v: np.ndarray, T: Any) -> np.ndarray:
        """(7, n), nothing taken yet."""
        return np.concatenate([super().state(rho, v, T), np.zeros((3, len(self.x)))])

    def sums(self, team: Team) -> "Booking":
        """With a book."""
        return Booking(self, team)


class Booking(Streaming):
    """The compiled sums of a stream, and what goes into the book."""

    def rates(self, state: np.ndarray, out: np.ndarray) -> None:
        """d(state)/dt of a state (7, n), written to `out`."""
        super().rates(state[:4], out[:4])
        out[4:] = 0
        out[4:, 0] = [fsum(q)/self.method.edges.V[0] for q in self.received.T]


@dataclass(frozen=True, kw_only=True)
class BookedSides(Sheared):
    """Sliding sides with a book: momentum along them and energy that they have given, per volume of the box.

    What leaves below is what enters above seen from the box above, which moves with U: of mass m, momentum p
    and energy e that enter, U m of momentum and U p - U^2 m/2 of energy stay.
    """

    names = (*Sheared.names, "given_x", "given_e")

    def state(self, rho: Any, v: np.ndarray, T: Any) -> np.ndarray:
        """(7, n), nothing given yet."""
        return np.concatenate([super().state(rho, v, T), np.zeros((2, self.points.n))])

    def sums(self, team: Team) -> "BookingSides":
        """With a book."""
        return BookingSides(self, team)


class BookingSides(Shearing):
    """The compiled sums, and what goes into the book."""

    def rates(self, state: np.ndarray, out: np.ndarray) -> None:
        """d(state)/dt of a state (7, n), written to `out`."""
        super().rates(state[:5], out[:5])
        through = self.exchange.sum(self.at._replace(edges=above(self.at.edges, self.method.sides)))
        (m, p, _, _), U = through.sum(axis=0)/self.method.edges.V.sum(), self.method.speed
        out[5], out[6] = U*m, U*p - U**2*m/2
