"""Points that move with their triangulation and an entropy-stable flux: `entropy_fluxes`, `positive` steps.

Fluxes over an edge that moves at {w} take the relative velocity r = w - v; so the terms keep the sum of
V rho s as on fixed points. Steps are divided into parts that are short enough, in Python over compiled loops.
"""
from dataclasses import dataclass
from math import ceil
from typing import Any

import numpy as np

from particles.integral import march
from particles.integral.carried import EXCHANGED, complete, follow, heat, hold, read, receive
from particles.integral.entropy_fluxes import MeanPressure
from particles.integral.entropy_stable import flow_of
from particles.integral.exchange import At, Listing
from particles.integral.fixed import NO_IMAGES, first_invalid
from particles.integral.lanes import Point
from particles.integral.moving_delaunay import MovingDelaunay, RingSums
from particles.integral.positive import COURANT, LEAST, OLD, PART, Limits, Slopes, divided
from particles.integral.rings import remade
from particles.integral.stable_rings import _along, _at_sides, _gained, _sound, _turned
from particles.pairs import Faces, sweep
from particles.threads import Threads

#: rows of a state: mass, momentum and energy, in the order of `dih.densities`
DENSITIES = [6, 4, 5, 8]


class StableRings(Limits, RingSums):
    """Compiled sums, stepped in Python."""
    method: "StableDelaunay"

    def __init__(self, method: "StableDelaunay", threads: Threads):
        super().__init__(method, threads)
        self.set_limits(method.flow)
        self.images, self.turned = NO_IMAGES, -1
        # pressures are sent without the correction of slopes on sides
        self.sending.slopes, self.densities = np.zeros((self.n, 8)), np.zeros((2, 4, self.n))
        self.points = np.zeros(self.n, Point)
        self.bench = self.bench._replace(points=self.points)
        self.fluid = self.fluid._replace(terms=Listing((*method.transport, *method.flow)))

    def reorder(self, order: np.ndarray) -> None:
        super().reorder(order)
        self.widen()

    def widen(self) -> None:
        """Give the edges arrays for their separations dx, dy."""
        edges = self.rings.edges
        self.edges = Faces(*edges[:6], *np.zeros((2, len(edges.near))))
        self.rings = self.rings._replace(edges=self.edges)  # type: ignore[arg-type]

    def try_out(self, now: Any) -> None:
        """Load or compile the code, without a step."""
        self.look_at(now.state)

    def look_at(self, state: np.ndarray) -> None:
        """Compute what held points receive, with edges at the current places."""
        self.meet(state[:2])
        self.lead(state[:2])
        self.look(state)
        receive(self.fluid, self.rings, self.held, state, self.bench, self.received)

    def meet(self, x: np.ndarray) -> None:
        """Compute edges and volumes at places x (2, n)."""
        bench = self.bench
        march.edges_of(self.threads, self.n, x, self.rings, bench.V, bench.pull, bench.spread, bench.crossed)

    def lead(self, x: np.ndarray) -> None:
        """Compute separations along the edges; copy the volumes, whose memory is reused."""
        self.threads(_along, self.n, x, self.rings)
        self.V = self.bench.V.copy()

    def fields(self, y: np.ndarray) -> None:
        """Compute the fields of points."""
        read(self.threads, self.n, y, self.method.eos, self.method.law, self.points)
        self.threads(_sound, self.n, self.method.eos, y, self.points)

    def look(self, y: np.ndarray) -> None:
        """Compute the fields of points and their gradients."""
        self.fields(y)
        n, points, rings = self.n, self.points, self.rings
        self.threads(sweep, n, Slopes(), points, self.edges, self.slopes)
        np.copyto(self.sending.slopes, self.slopes)
        self.threads(_at_sides, n, Slopes(), points, rings, self.slopes)
        self.threads(divided, n, self.slopes, self.V, points)

    def longest(self, y: np.ndarray) -> float:
        """Longest step proven to keep the state last looked at positive; nan if triangles are turned over."""
        sound = (self.speeds - self.bench.flow/2)/y[7]
        return float(1/PART/np.max(sound/COURANT + self.bench.spread*self.chi))

    def march(self, state: np.ndarray, dt: float, steps: int) -> None:
        """Advance by so many steps. Raises FloatingPointError: in the shortest part of a step a triangle,
        a density or an energy does not stay positive."""
        for _ in range(steps):
            left, most = dt, self.guess(state, dt)
            while left > 0:
                h = left/ceil(left/most)
                before = state.copy(), self.rings, [q.copy() for q in self.changing()]
                done, most = self.part(state, h)
                if done:
                    left -= h
                    continue
                self.go_back(state, *before)
                if not most > LEAST*dt:
                    raise FloatingPointError(self.end(state, h))
        self.flips += int(self.bench.flipped[0])
        self.bench.flipped[0] = 0

    def guess(self, y: np.ndarray, dt: float) -> float:
        """First guess of the longest step, from edges at the current places; dt if these give none."""
        self.meet(y[:2])
        self.fields(y)
        follow(self.threads, self.n, self.fluid, self.rings, self.bench)
        longest = self.longest(y)
        return longest if longest > 0 else dt

    def part(self, y: np.ndarray, h: float) -> tuple[bool, float]:
        """Advance by h: (whether it is done, longest next part)."""
        self.lost, self.turned = self.n, self.flip(y, h)
        if self.turned >= 0 or not self.sound(y):
            return False, h/2
        hold(self.method.eos, self.held, y)
        self.look(y)
        follow(self.threads, self.n, self.fluid, self.rings, self.bench)
        longest, shift = self.longest(y), self.fluid.shift*march.fastest(self.bench.strain, self.bench.free)
        if h*COURANT > longest:
            return False, longest
        start = y[EXCHANGED].copy()
        for number, old in enumerate(OLD):
            if number:
                self.look(y)
                complete(self.threads, self.n, 1.0, self.rings, self.bench)
            heat(self.held, 1.0, self.bench.once)
            if not self.euler(y, PART*h):
                return False, h/2
            if old:
                y[EXCHANGED] = old*start + (1 - old)*y[EXCHANGED]
            hold(self.method.eos, self.held, y)
        march.move(self.threads, self.n, h, shift, self.bench, y)
        return True, longest

    def flip(self, y: np.ndarray, h: float) -> int:
        """Make edges Delaunay halfway through a step; a point whose triangle turns over by its end, or -1."""
        bench, full, turned = self.bench, 0, -1
        march.halfway(self.threads, self.n, h, y, bench.middle)
        while full >= 0:
            self.meet(bench.middle)
            full, turned = march.mend(self.method.eos, y, self.rings, bench)
            if full >= 0:
                self.rings = remade(self.rings)
                self.widen()
        self.lead(bench.middle)
        self.sending.follow(self.edges)
        if turned < 0:
            found = self.threads(_turned, self.n, y[:2] + h*y[2:4], self.rings)
            turned = min((i for i in found if i >= 0), default=-1)      # the first, whatever the threads
        return int(turned)

    def sound(self, y: np.ndarray) -> bool:
        """Did flips leave volumes, densities and energies positive?"""
        self.lost = first_invalid(y[DENSITIES]/y[7], self.method.eos) if (y[7] > 0).all() else y[7].argmin()
        return bool(self.lost == self.n)

    def euler(self, y: np.ndarray, h: float) -> bool:
        """Euler step without moving points. False: not even Rusanov's flux keeps rho, e > 0."""
        total = self.sending.sum(At(self.points, self.edges, NO_IMAGES, self.V))
        before, after = self.densities
        self.threads(_gained, self.n, h, self.method.g, total, self.bench, y, before, after)
        self.lost = self.n if (y[7] > 0).all() else int(y[7].argmin())
        less = self.less(before, after, h/y[7]) if self.lost == self.n else None
        if less is None:
            return False
        y[DENSITIES] += y[7]*less
        return True

    def go_back(self, state: np.ndarray, before: np.ndarray, rings: Any, parts: list[np.ndarray]) -> None:
        """Restore the start of a part; free points around a triangle that would turn get one velocity."""
        state[:], self.rings, self.edges = before, rings, rings.edges
        for array, old in zip(self.changing(), parts):
            array[:] = old
        self.refused += self.turned >= 0 or self.lost < self.n
        if self.turned >= 0:
            first = self.edges.first[self.turned]
            near = self.edges.near[first:first + self.edges.taken[self.turned]]
            ring = np.array([self.turned, *near.astype(int)])
            state[2:4, ring[self.bench.free[ring]]] = state[2:4, ring].mean(axis=1, keepdims=True)

    def changing(self) -> tuple[np.ndarray, ...]:
        """Arrays that flips change, and their number."""
        edges, rings = self.rings.edges, self.rings
        return edges.first, edges.taken, edges.near, rings.room, rings.end, self.bench.flipped

    def end(self, state: np.ndarray, h: float) -> str:
        """Message why the run cannot go on, with the point, its state and its edges."""
        i = self.turned if self.turned >= 0 else self.lost
        (x, y), V = state[:2, i], state[7, i]
        return (f"no step of {h:.3g} or more leaves the point at ({x:.4g}, {y:.4g}) triangles, density and "
                f"energy that are positive: m = {state[6, i]:.4g}, V = {V:.4g}, E = {state[8, i]:.4g}, "
                f"{self.edges.taken[i]} edges; take more rows, or a smoother start")


@dataclass(frozen=True, kw_only=True)
class StableDelaunay(MovingDelaunay):
    """A fluid with an entropy on points that move with their triangulation. flow : listed terms in place of
    `carried.Crossing`; by default an ideal gas has `MeanPressure`, which is nearest to that."""
    flow: tuple = ()

    sums = StableRings

    def __post_init__(self):
        super().__post_init__()
        flow_of(self, MeanPressure)
