"""What ghosts are images of, however many walls lie between."""
from typing import NamedTuple

import numpy as np

from particles.lists import PairLists
from particles.walls.mirror import Mirror


class Ghosts(NamedTuple):
    """Of each ghost: its origin, -1 behind an odd number of plates (else 1), the last plate's T."""
    origin: np.ndarray
    turn: np.ndarray
    plate_T: np.ndarray

    def fill(self, records: np.ndarray, even: tuple[str, ...], odd: tuple[str, ...] = ()) -> None:
        """Fields of ghosts, which come last, from their origins; odd ones change sign in a mirror."""
        first = len(records) - len(self.origin)
        for name in (*even, *odd):
            found = records[name][self.origin]
            records[name][first:] = found*self.turn if name in odd else found

    def fill_work(self, points: np.ndarray, slopes: np.ndarray, V: np.ndarray) -> None:
        """The work F of ghosts: along a plate even, across it odd."""
        self.fill(points, ("Fx",), ("Fy",))


def ghosts_of(around: PairLists) -> Ghosts:
    """The ghosts that the lists have now; mirrors are the only walls that turn anything."""
    origin, turn, plate_T = np.arange(len(around.x)), np.ones(len(around.x)), np.zeros(len(around.x))
    for wall, parent, first, last in around.blocks:
        for q in (origin, turn, plate_T):
            q[first:last] = q[parent]
        if isinstance(wall, Mirror):
            turn[first:last] *= -1
            plate_T[first:last] = wall.T
    return Ghosts(origin[around.n:], turn[around.n:], plate_T[around.n:])
