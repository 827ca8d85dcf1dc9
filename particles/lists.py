"""Data that pair loops need besides the particles: fixed particles, ghosts of walls, neighbour lists, pairs.

The order of points is particles, fixed particles, ghosts wall by wall. Ghosts have no rows in pair sums.
"""
from typing import Any, NamedTuple

import numpy as np

from continuum.fluid import valid
from particles.method import Sums
from particles.neighbours import NO_LISTS, farthest, make_lists, sort_into_cells
from particles.pairs import empty_pairs, weigh
from particles.threads import Threads
from particles.walls import check_ends, confine, fixed_points, move_images, parents, place_images
from particles.walls.mirror import Mirror
from particles.walls.periodic import wrap

ROUND_OFF = 1e-12       # relative, of places after some thousand operations
MARGIN = 1.25  # factor by which a particle may speed up within a step before the lists miss a pair


def fastest(state: np.ndarray) -> float:
    """The largest speed of a state (x, y, vx, vy, e)."""
    return float(np.sqrt((state[2]**2 + state[3]**2).max()))


def outside(walls: tuple, state: np.ndarray, box: tuple[float, float]) -> np.ndarray:
    """Indices of particles behind a reflecting wall, or farther than the box's own size outside the box."""
    inside = state.copy()
    for wall in walls:
        confine(wall, inside)
    far = np.abs(state[:2]) > 1.5*(1 + ROUND_OFF)*np.array(box)[:, None]
    return np.flatnonzero(((inside[:2] != state[:2]) | far).any(axis=0))


def check_room(weight: Any, walls: tuple, box: tuple[float, float]) -> None:
    """Check the box, that twice the weight's range fits into it, and its walls. Raises ValueError."""
    if len(box) != 2 or not all(0 < side < np.inf for side in box):
        raise ValueError(f"a box is (width, height), both positive and finite, got {box}")
    if 2*weight.h > min(box):
        raise ValueError(f"the weight's diameter 2 h = {2*weight.h:g} is wider than the box {box[0]:g} x "
                         f"{box[1]:g}: take more particles or a shorter range")
    check_ends(walls, box)


class PairLists:
    """Fixed particles, ghosts, neighbour lists and pairs of n particles between walls.

    x, y, vx, vy, T, rho, P : (points,) fields of all points; the method writes those of the particles.
    pairs : neighbour lists and pairs in range of the particles and fixed particles, `rows` in all.
    blocks : (wall, parents, first, last) of the ghosts of each wall, in the order in which they are filled.
    """

    def __init__(self, weight, walls, n: int, box: tuple[float, float], *, skin: float, threads: Threads):
        if not skin > 0:
            raise ValueError(f"the skin of the neighbour list must be positive, got {skin}: take 0.2 h")
        check_room(weight, walls, box)
        self.weight, self.walls, self.skin, self.threads, self.n = weight, walls, skin, threads, n
        held = [fixed_points(wall, *box) for wall in walls if type(wall) in fixed_points.kinds]
        self._fixed = np.hstack([np.empty((3, 0)), *held])
        self.rows = n + len(self._fixed[0])
        self.anchor: np.ndarray | None = None
        self.pairs, self.lists_made = empty_pairs(NO_LISTS), 0

    def must_relist(self, state: np.ndarray, dt: float) -> bool:
        """True if some particle may have moved farther than half of the skin after the coming step."""
        return self.anchor is None or self.moved(state) + MARGIN*fastest(state)*dt > self.skin/2

    def moved(self, state: np.ndarray) -> float:
        """Largest displacement of a particle since the lists were made."""
        assert self.anchor is not None, "lists come before steps"
        return farthest(state[:2], self.anchor)

    def relist(self, state: np.ndarray, ids: np.ndarray, dt: float) -> None:
        """Wrap and sort the particles in place, then make lists, with a wider skin if particles are fast."""
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
        """Make ghosts and lists for particles at `anchor` (2, n), which a restart reads from a checkpoint."""
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
        lists = make_lists(self.threads, cells, x[rows], y[rows], self.reach, 0, old.listed)
        same = lists.listed is old.listed
        self.pairs = old._replace(**lists._asdict()) if same else empty_pairs(lists)

    def place(self, state: np.ndarray, m: float) -> None:
        """Set positions of all points, find pairs in range, and sum the density of rows; images copy it."""
        self.x[:self.n], self.y[:self.n] = state[0], state[1]
        for wall, parent, first, last in self.blocks:
            place_images(first, last, wall, parent, self.x, self.y)
        self.threads(weigh, self.rows, self.weight, m, self.x, self.y, self.pairs, self.rho)
        for _, parent, first, last in self.blocks:
            self.rho[first:last] = self.rho[parent]

    def move(self) -> None:
        """Set velocities and temperatures of images from those of their parents."""
        for wall, parent, first, last in self.blocks:
            move_images(first, last, wall, parent, self.x, self.y, self.vx, self.vy, self.T)


class Ghosts(NamedTuple):
    """Index of each ghost's origin; -1 behind an odd number of plates, else 1; T of the last plate."""
    origin: np.ndarray
    turn: np.ndarray
    plate_T: np.ndarray

    def fill(self, records: np.ndarray, even: tuple[str, ...], odd: tuple[str, ...] = ()) -> None:
        """Copy fields from origins to ghosts, the last records; `odd` ones change sign in a mirror."""
        first = len(records) - len(self.origin)
        for name in (*even, *odd):
            found = records[name][self.origin]
            records[name][first:] = found*self.turn if name in odd else found

    def fill_work(self, points: np.ndarray, slopes: np.ndarray, V: np.ndarray) -> None:
        """Copy F, the energy flux by work, to ghosts: Fx, along plates, is even, Fy, across them, odd."""
        self.fill(points, ("Fx",), ("Fy",))


def ghosts_of(around: PairLists) -> Ghosts:
    """The ghosts of the present lists; `Mirror` is the only wall that changes signs."""
    origin, turn, plate_T = np.arange(len(around.x)), np.ones(len(around.x)), np.zeros(len(around.x))
    for wall, parent, first, last in around.blocks:
        for q in (origin, turn, plate_T):
            q[first:last] = q[parent]
        if isinstance(wall, Mirror):
            turn[first:last] *= -1
            plate_T[first:last] = wall.T
    return Ghosts(origin[around.n:], turn[around.n:], plate_T[around.n:])


def unphysical(eos: Any, V: np.ndarray, rho: np.ndarray, e: np.ndarray, ids: np.ndarray) -> str:
    """Message on the first point whose volume, density or energy is not valid; empty if all are valid."""
    good = (V > 0) & (rho > 0) & valid(eos, rho, e)
    if good.all():
        return ""
    i = int(np.argmin(good))
    return (f"point {ids[i]} has V = {V[i]:.4g}, rho = {rho[i]:.6g}, e = {e[i]:.6g}, outside the "
            f"validity of {type(eos).__name__}")


class Listed(Sums):
    """Base class of sums over neighbour lists: what the time loop calls, whatever is summed."""
    around: PairLists

    def evaluate(self, state: np.ndarray) -> None:
        self.rates(state, np.empty_like(state))

    def resume(self, now: Any) -> None:
        if now.anchor is not None:
            self.around.skin = now.skin
            self.around.make_lists(now.anchor)

    def try_out(self, now: Any) -> None:
        """Evaluate once on a copy of the particles; at a start, check them by `look_over`."""
        state, fresh = now.state.copy(), now.anchor is None
        if fresh:
            ids = now.ids.copy()
            self.around.relist(state, ids, 0.0)
            self.look_over(state, ids)
        self.evaluate(state)
        if fresh:
            self.around.anchor = None       # lists are made anew before the first step

    def look_over(self, state: np.ndarray, ids: np.ndarray) -> None:
        """Check points at the start for faults that the sums would not notice; does nothing here."""

    def make_ready(self, now: Any, dt: float) -> None:
        """Sort particles and make new lists if the step may bring a particle beyond the skin."""
        if self.around.must_relist(now.state, dt):
            self.around.relist(now.state, now.ids, dt)
            now.anchor, now.skin = self.around.anchor, self.around.skin

    def confine(self, state: np.ndarray) -> int:
        return sum(confine(wall, state) for wall in self.method.walls)

    def outran(self, state: np.ndarray) -> str:
        """Message if a particle has moved farther than half of the skin; empty if none has."""
        far = self.around.moved(state) > self.around.skin/2
        return "a particle sped up by more than a quarter within one step" if far else ""
