"""A conservative scheme on points that move with the fluid and their Delaunay triangulation, in 2D.

Mass, momentum and energy are exchanged over the edges of `rings`, as on fixed points, with the velocity
r = w - v of points relative to the fluid; flips redistribute them among four points. Volumes equal those of
the triangulation to round-off: they need no relaxation, and no static pressure is left out. Held points, on
sides and bodies, stay in place or move with a side that slides along itself. Second order in space.
"""
from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np

from continuum.fluid import check_state, diffusivity, energy, sound_speed
from particles.fields import Fields, from_densities
from particles.integral.bodies import Held
from particles.integral.carried import EXCHANGED, ROWS, Bench, Crossing, Fluid, Point, hold, receive
from particles.integral.exchange import Conduction, Friction, Listing
from particles.integral.fixed import check_number
from particles.integral.march import IMAGINARY, REAL, march
from particles.integral.rings import Rings, geometry, in_order, remade, rows_of, table_of
from particles.limits import limit_of
from particles.lists import unphysical
from particles.method import Leaps, Sums
from particles.threads import Threads

#: largest frequency over c/a and largest rate of diffusion over chi/a^2 on irregular triangles: 1.57 and 17.5
#: were seen; steps in which an edge may be stiffer are divided into parts
SOUND, SPREAD = 1.6, 18.0
#: rate of the shift towards the centre of a point's triangles, over the largest |grad v|: with 1 triangles
#: turn over at Ra 1e7 on 16 rows, from 1.5 on they do not (set after this look)
SHIFT = 2.0
#: steps times points per call, between checks of the clock and the keyboard: a quarter of a second
AT_ONCE = 1_000_000
#: capacity of the stack of edges that are checked after a flip
EDGES_AT_ONCE = 4096
#: number of points from which a step is long enough for calls from Python, which threads need
MANY = 20_000
#: distance in memory between neighbours, median of some points, from which points are sorted again
AFAR, SOME = 32, 10_000


class Carry(Leaps):
    """Integrator: places half a step later, triangulation and edges there, stages of exchange, new places."""

    def __init__(self, shape: tuple[int, ...], threads: Threads):
        self.most = max(1, AT_ONCE//shape[1])

    def step(self, sums: "RingSums", state: np.ndarray, dt: float, steps: int = 1) -> None:
        """Advance a state in place by so many steps."""
        sums.march(state, dt, steps)


class RingSums(Sums):
    """Compiled sums on a moving triangulation, for the time loop.

    received (m, 3) : momentum and energy that held points take per time, at the state last looked at.
    ids (n,) : numbers of the points in their present order in memory.
    """
    method: "MovingDelaunay"

    def __init__(self, method: "MovingDelaunay", threads: Threads):
        n = len(method.x)
        self.method, self.threads, self.n, self.flips = method, threads, n, 0
        self.rings = remade(method.rings)
        self.fluid = Fluid(method.eos, method.law, Listing((Crossing(), *method.transport)), float(method.g),
                           float(method.shift))
        self.received = np.zeros((len(method.held.which), 3))
        before = np.zeros((5, n))
        self.bench = Bench(     # nothing in it outlives a step
            points=np.zeros(n, Point), before=before, middle=before[:2], spread=before[2], V=before[3],
            strain=before[3], stiffness=before[4], pull=np.zeros((n, 2)), flow=np.zeros(n),
            once=np.zeros((n, 3)), crossed=np.zeros(n, bool), changed=np.zeros(n, bool),
            stack=np.zeros((EDGES_AT_ONCE, 2), np.int64), free=np.zeros(n, bool),
            flipped=np.zeros(1, np.int64), left=np.zeros(2, np.int64))
        self.reorder(np.arange(n))

    def go(self, steps: int, dt: float, state: np.ndarray) -> tuple[int, int, int]:
        """Call `march`, with many points uncompiled, so that threads can share the loops in it."""
        on, threads = (march.py_func, self.threads) if self.n >= MANY else (march, None)
        return on(threads, steps, dt, self.fluid, self.rings, self.held, state, self.bench)

    def march(self, state: np.ndarray, dt: float, steps: int) -> None:
        """Advance by so many steps. Raises FloatingPointError: a triangle has turned over."""
        done = 0
        while done < steps:
            more, full, turned = self.go(steps - done, dt, state)
            done += more
            if turned >= 0:
                x, y = state[:2, turned]
                raise FloatingPointError(f"{done} steps later a triangle of the point at ({x:.4g}, {y:.4g}) "
                                         "has turned over: it is stretched faster than points shift; take "
                                         f"more rows, or a shift above {self.fluid.shift:g}")
            if full >= 0:
                self.rings = remade(self.rings)
        self.flips += int(self.bench.flipped[0])
        self.bench.flipped[0] = 0

    def mark(self, now: Any) -> None:
        now.anchor = table_of(self.rings)

    def resume(self, now: Any) -> None:
        """Restore the triangulation of an interrupted run, and its order of points."""
        if now.anchor is None and not np.array_equal(now.state[:2].T, self.method.x):
            raise ValueError("the state is not where the triangulation of the method is: start from the "
                             "method's own `state`, or make a method on these points")
        if now.anchor is not None:
            self.rings = remade(rows_of(now.anchor, *self.rings[1:4]))
            self.reorder(now.ids)

    def reorder(self, order: np.ndarray) -> None:
        """Renumber held points and sides for points in this order."""
        self.ids, place = order, np.argsort(order)
        self.held = self.method.held._replace(which=place[self.method.held.which])
        self.rings = self.rings._replace(rim=self.method.rings.rim[order])
        self.bench.free[:] = True
        self.bench.free[self.held.which] = False

    def make_ready(self, now: Any, dt: float) -> None:
        """Sort points in memory once neighbours are far apart there, which makes steps 1.5 times as slow."""
        some = np.arange(0, self.n, 1 + self.n//SOME)
        if np.median(np.abs(self.rings.edges.near[self.rings.edges.first[some]].astype(int) - some)) > AFAR:
            order = in_order(now.state[:2], self.rings.size)
            self.rings = remade(self.rings, order)
            now.state[:], now.ids[:] = now.state[:, order], now.ids[order]
            self.reorder(now.ids)

    def try_out(self, now: Any) -> None:
        """Load or compile the code, without a step."""
        self.go(0, 1.0, now.state)
        self.look_at(now.state)

    def look_at(self, state: np.ndarray) -> None:
        """Compute what held points receive, with edges at the current places."""
        bench = self.bench
        geometry(0, self.n, state[:2], self.rings, bench.V, bench.pull, bench.spread, bench.crossed)
        receive(self.fluid, self.rings, self.held, state, bench, self.received)

    def fault(self, state: np.ndarray, ids: np.ndarray) -> str:
        px, py, m, V, E = state[EXCHANGED]
        return unphysical(self.method.eos, V, m/V, (E - (px**2 + py**2)/(2*m))/m, ids)


@dataclass(frozen=True, kw_only=True)
class MovingDelaunay:
    """A fluid on points x (n, 2) that move with their triangulation, of `rings`.

    held : points on all sides and in bodies. rides : whether these move at their velocities. g : gravity,
    downwards. shift : see SHIFT. transport : listed terms; the correction of friction, `carried.complete`,
    is always added.
    Raises ValueError: a point on a side is not held.
    """
    x: np.ndarray
    rings: Rings
    held: Held
    eos: Any
    law: Any
    g: float = 0.0
    rides: bool = False
    shift: float = SHIFT
    transport: tuple = (Friction(), Conduction())

    names = ROWS
    integrator = Carry
    sums: ClassVar[type] = RingSums

    def __post_init__(self):
        loose = np.setdiff1d(np.flatnonzero(self.rings.rim), self.held.which)
        if len(loose):
            raise ValueError(f"point {loose[0]} at {self.x[loose[0]]} is on a side and not held "
                             f"({len(loose)} are not): hold what is on sides, or move it inside")

    def state(self, rho: Any, v: np.ndarray, T: Any) -> np.ndarray:
        """(9, n) of densities (n,), velocities (n, 2), temperatures (n,); held points get their own."""
        n, which = len(self.x), self.held.which
        V, v, T = np.zeros(n), np.array(v, float), T*np.ones(n)
        rings = remade(self.rings)       # a copy: edges that are written take memory
        geometry(0, n, self.x.T.copy(), rings, V, np.zeros((n, 2)), np.zeros(n), np.zeros(n, bool))
        w = v.copy()
        v[which], w[which] = self.held.v, self.rides*self.held.v
        m, e = rho*V, energy(self.eos, rho, T)
        state = np.stack([*self.x.T, *w.T, *(m[:, None]*v).T, m, V, m*(e + (v**2).sum(axis=1)/2)])
        hold(self.eos, self.held, state)
        return state

    def fields(self, state: np.ndarray) -> Fields:
        """Fields of the points, (n,) each, with places wrapped into the box."""
        px, py, m, V, E = state[EXCHANGED]
        x = state[:2].T - self.rings.size*np.rint(state[:2].T*self.rings.per)
        return from_densities(self.eos, x, V.copy(), m/V, np.stack([px, py])/V, E/V)

    def start(self, n: int, threads: Threads) -> Any:
        """The sums over the triangulation. Raises ValueError: a state of another number of points."""
        check_number(n, len(self.x))
        return self.sums(self, threads)


@limit_of.register
def _(method: MovingDelaunay, start: np.ndarray) -> float:
    """Longest stable step: sound and diffusion on stiff edges; points move along, so flow does not count."""
    px, py, m, V, E = start[EXCHANGED]
    rho, e = m/V, E/m - (px**2 + py**2)/(2*m**2)
    check_state(method.eos, rho, e)
    a, chi = np.sqrt(V.mean()), np.max(diffusivity(method.eos, method.law, rho, e))
    return float(1/max(SOUND*np.max(sound_speed(method.eos, rho, e))/a/IMAGINARY, SPREAD*chi/a**2/REAL))
