"""What the pair loops need besides particles: fixed ones, ghosts of the walls, lists, pairs.

Points are numbered particles first, then fixed particles, then ghosts wall by wall, which have no rows.
"""
from typing import Any, NamedTuple

import numpy as np

from continuum.fluid import valid
from particles.method import Sums
from particles.neighbours import farthest, make_lists, sort_into_cells
from particles.pairs import empty_pairs, weigh
from particles.threads import Threads
from particles.walls import check_ends, confine, fixed_points, move_images, parents, place_images
from particles.walls.mirror import Mirror
from particles.walls.periodic import wrap

EMPTY = np.empty(0)
ROUND_OFF = 1e-12       # of places: that of some thousand operations
MARGIN = 1.25  # a particle may speed up within a step by this factor before the lists miss a pair


def fastest(state: np.ndarray) -> float:
    """The largest speed of a state (x, y, vx, vy, e)."""
    return float(np.sqrt((state[2]**2 + state[3]**2).max()))


def outside(walls: tuple, state: np.ndarray, box: tuple[float, float]) -> np.ndarray:
    """Numbers of the particles that walls would reflect, or that are more than a box beyond the box."""
    inside = state.copy()
    for wall in walls:
        confine(wall, inside)
    far = np.abs(state[:2]) > 1.5*(1 + ROUND_OFF)*np.array(box)[:, None]
    return np.flatnonzero(((inside[:2] != state[:2]) | far).any(axis=0))


def check_room(weight: Any, walls: tuple, box: tuple[float, float]) -> None:
    """Refuse a box that is none, a weight that is too wide for it, and walls of another one: ValueError."""
    if len(box) != 2 or not all(0 < side < np.inf for side in box):
        raise ValueError(f"a box is (width, height), both positive and finite, got {box}")
    if 2*weight.h > min(box):
        raise ValueError(f"the weight's diameter 2 h = {2*weight.h:g} is wider than the box {box[0]:g} x "
                         f"{box[1]:g}: take more particles or a shorter range")
    check_ends(walls, box)


class PairLists:
    """Fixed particles, ghosts, neighbour lists and pairs of N particles between walls.

    x, y, vx, vy, T, rho, P : (points,) fields of all points; of the particles written by the method.
    pairs : lists and pairs in range of the `rows` particles and fixed particles.
    blocks : (wall, parents, first, last) of the ghosts, in the order in which they are filled.
    """

    def __init__(self, weight, walls, n: int, box: tuple[float, float], *, skin: float, threads: Threads):
        if not skin > 0:
            raise ValueError(f"the skin of the neighbour list must be positive, got {skin}: take 0.2 h")
        check_room(weight, walls, box)
        self.weight, self.walls, self.skin, self.threads, self.n = weight, walls, skin, threads, n
        holding = [wall for wall in walls if type(wall) in fixed_points.kinds]
        held = [fixed_points(wall, *box) for wall in holding] or [(EMPTY, EMPTY, EMPTY)]
        self._fixed = tuple(np.concatenate(column) for column in zip(*held, strict=True))
        self.rows = n + len(self._fixed[0])
        self.anchor: np.ndarray | None = None
        self.pairs, self.lists_made = empty_pairs(self.rows, 0), 0

    def must_relist(self, state: np.ndarray, dt: float) -> bool:
        """True if some particle may leave half of the skin within the coming step."""
        return self.anchor is None or self.moved(state) + MARGIN*fastest(state)*dt > self.skin/2

    def moved(self, state: np.ndarray) -> float:
        """The farthest that any particle has moved since the lists were made."""
        assert self.anchor is not None, "lists come before steps"
        return farthest(state[:2], self.anchor)

    def relist(self, state: np.ndarray, ids: np.ndarray, dt: float) -> None:
        """Wrap the particles, sort them by cells (in place), make lists; the skin grows with the speed."""
        stride = MARGIN*fastest(state)*dt
        if not stride < self.weight.h:
            raise FloatingPointError(f"a particle at speed {fastest(state):.4g} would cross the weight's "
                                     f"range {self.weight.h:g} within one step")
        if 2*stride > self.skin:
            self.skin = 2.4*stride
        wrap(self.walls, state)
        order = sort_into_cells(state[0], state[1], self.reach/2).order
        state[:], ids[:] = state[:, order], ids[order]
        self.make_lists(state[:2])

    @property
    def reach(self) -> float:
        return self.weight.h + self.skin

    def make_lists(self, anchor: np.ndarray) -> None:
        """Ghosts and lists for particles at `anchor` (2, n), which a restart takes from its checkpoint."""
        self.anchor, self.lists_made = anchor.copy(), self.lists_made + 1
        x, y = (np.concatenate([a, f]) for a, f in zip(anchor, self._fixed, strict=False))
        self.blocks = []
        for wall in (wall for wall in self.walls if type(wall) in parents.kinds):
            parent, first = parents(wall, x, y, self.reach), len(x)
            x, y = np.append(x, np.empty(len(parent))), np.append(y, np.empty(len(parent)))
            place_images(first, len(x), wall, parent, x, y)
            self.blocks.append((wall, parent, first, len(x)))
        self.x, self.y = x, y
        self.vx, self.vy, self.T, self.rho, self.P = (np.zeros(len(x)) for _ in range(5))
        self.T[self.n:self.rows] = self._fixed[2]
        cells = sort_into_cells(x, y, self.reach)
        rows, old = slice(self.rows), self.pairs
        start, length, listed = make_lists(self.threads, cells, x[rows], y[rows], self.reach, 0, old.listed)
        pairs = old if listed is old.listed else empty_pairs(self.rows, len(listed))
        self.pairs = pairs._replace(start=start, length=length, listed=listed)

    def place(self, state: np.ndarray, m: float) -> None:
        """Positions of all points and, over the pairs in range, density of the rows and of their images."""
        self.x[:self.n], self.y[:self.n] = state[0], state[1]
        for wall, parent, first, last in self.blocks:
            place_images(first, last, wall, parent, self.x, self.y)
        self.threads(weigh, self.rows, self.weight, m, self.x, self.y, self.pairs, self.rho)
        for _, parent, first, last in self.blocks:
            self.rho[first:last] = self.rho[parent]

    def move(self) -> None:
        """Velocities and temperatures of the images from those of their parents."""
        for wall, parent, first, last in self.blocks:
            move_images(first, last, wall, parent, self.x, self.y, self.vx, self.vy, self.T)


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


def unphysical(eos: Any, V: np.ndarray, rho: np.ndarray, e: np.ndarray, ids: np.ndarray) -> str:
    """The first point with a volume, density or energy that no fluid has; empty if there is none."""
    good = (V > 0) & (rho > 0) & valid(eos, rho, e)
    if good.all():
        return ""
    i = int(np.argmin(good))
    return (f"point {ids[i]} has V = {V[i]:.4g}, rho = {rho[i]:.6g}, e = {e[i]:.6g}, outside the "
            f"validity of {type(eos).__name__}")


class Listed(Sums):
    """What the time loop asks of sums over neighbour lists, whatever is summed."""
    around: PairLists

    def evaluate(self, state: np.ndarray) -> None:
        self.rates(state, np.empty_like(state))

    def resume(self, now: Any) -> None:
        if now.anchor is not None:
            self.around.skin = now.skin
            self.around.make_lists(now.anchor)

    def try_out(self, now: Any) -> None:
        """One evaluation on a copy of the particles; at a start they are looked over."""
        state, fresh = now.state.copy(), now.anchor is None
        if fresh:
            ids = now.ids.copy()
            self.around.relist(state, ids, 0.0)
            self.look_over(state, ids)
        self.evaluate(state)
        if fresh:
            self.around.anchor = None       # lists are made anew before the first step

    def look_over(self, state: np.ndarray, ids: np.ndarray) -> None:
        """Refuse points that the sums would take without a word, once at the start; here none."""

    def make_ready(self, now: Any, dt: float) -> None:
        """New lists if particles may leave the old ones within the step; particles are then sorted."""
        if self.around.must_relist(now.state, dt):
            self.around.relist(now.state, now.ids, dt)
            now.anchor, now.skin = self.around.anchor, self.around.skin

    def confine(self, state: np.ndarray) -> int:
        return sum(confine(wall, state) for wall in self.method.walls)

    def outran(self, state: np.ndarray) -> str:
        """What is wrong if a particle has left the skin of the lists; empty if none has."""
        far = self.around.moved(state) > self.around.skin/2
        return "a particle sped up by more than a quarter within one step" if far else ""
