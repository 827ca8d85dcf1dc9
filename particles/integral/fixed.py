"""Common parts of methods on fixed points, in 2D: stored edges, fields, and rates for the time loop."""
from math import fsum
from typing import Any, ClassVar

import numpy as np

from continuum.fluid import check_state, conductivity, diffusivity, sound_speed, temperature, valid, viscosity
from continuum.jit import formula, jit
from particles.fields import Fields, from_densities
from particles.integral.dih import densities
from particles.integral.edges import NONE_BEYOND, NOWHERE, Beyond, Edges
from particles.integral.exchange import At, Convection, Exchange, Pressure, Stage, listed, pressure_of, stages
from particles.integral.transposed_stress import MENDED
from particles.limits import limit_of
from particles.lists import Ghosts
from particles.method import Sums
from particles.neighbours import u32, u64
from particles.pairs import Stored
from particles.threads import Threads

#: convection, pressure read vx .. eps, hydro; friction, heat ux, uy, Td; `Mending` F; P: `OwnPressure`
FIELDS = "rho vx vy T eps ux uy Td eta k Fx Fy hydro P"
Point = np.dtype([(name, "f8") for name in FIELDS.split()])
NO_IMAGES = Ghosts(NOWHERE, np.empty(0), np.empty(0))


def opened(edges: Stored) -> np.ndarray:
    """Open area sum_j S_ij of each row, images included, (n, 2): summed exactly, zero where edges close."""
    return np.array([[2*fsum(part) for part in np.split(q, edges.first[1:])]
                     for q in (edges.sx, edges.sy)]).T.copy()


class OwnPressure(Stage):
    """Sets each row's own P, which `Pressure` subtracts twice, and adds its force on the open area: whole
    pressures would leave a rounding in every row, of one sign at all steps. open (n, 2) : of `opened`."""

    def __init__(self, eos: Any, open: np.ndarray, n: int, threads: Threads):
        self.eos, self.open, self.n, self.threads = eos, open, n, threads

    def prepare(self, at: At) -> None:
        self.threads(_own_pressure, self.n, self.eos, at.points)

    def add(self, at: At, total: np.ndarray) -> None:
        if self.open.any():
            self.threads(_open, self.n, self.open, at.points, total)


@jit
def _own_pressure(first, last, eos, points):
    for i in range(first, last):
        a = points[i]
        a.P = pressure_of(eos, a.rho, a.T)


@jit
def _open(first, last, open, points, total):
    for i in range(first, last):
        total[i, 1] -= open[i, 0]*points[i].P
        total[i, 2] -= open[i, 1]*points[i].P


class OnPoints:
    """Common part of fluids on fixed points x (n, 2). sums : class of their compiled sums."""
    x: Any
    edges: Any
    eos: Any
    law: Any
    transport: Any = MENDED
    sums: Any
    names: ClassVar[tuple[str, ...]] = ("rho", "px", "py", "eps")

    @property
    def fastest(self) -> tuple[float, float]:
        """Largest frequency of sound over its speed, largest rate of diffusion over the diffusivity."""
        return self.edges.fastest

    def state(self, rho: Any, v: np.ndarray, T: Any) -> np.ndarray:
        """State (4, n) from densities, velocities (n, 2) and temperatures."""
        return densities(self.eos, rho*np.ones(len(self.x)), v, T)

    def fields(self, state: np.ndarray) -> Fields:
        return from_densities(self.eos, self.x, self.edges.V, state[0], state[1:3], state[3])

    def start(self, n: int, threads: Threads) -> Any:
        """The sums over stored edges. Raises ValueError: n is not the number of points."""
        check_number(n, len(self.x))
        return self.sums(self, threads)


@limit_of.register
def _(method: OnPoints, start: np.ndarray) -> float:
    """Stability limit of RK4: the fastest sound and the fastest diffusion added, over edges and images."""
    rho, e = inner(*start[:4])
    check_state(method.eos, rho, e)
    (sound, spread), chi = method.fastest, diffusivity(method.eos, method.law, rho, e)
    fast = sound_speed(method.eos, rho, e) + np.sqrt(start[1]**2 + start[2]**2)/rho
    return float(1/(np.max(fast)*sound/2.82 + np.max(chi)*spread/2.78))


class FixedSums(Sums):
    """Compiled sums over stored edges. images : arrays, one entry per image, such as `Ghosts`. push (2,) :
    force per mass."""

    def __init__(self, method: Any, threads: Threads, edges: Stored, images: Any, push: tuple[float, float],
                 *first: Stage):
        self.method, self.threads, self.n, self.push = method, threads, len(method.x), np.array(push)
        self.points = np.zeros(self.n + len(images[0]), Point)
        self.at = At(self.points, edges, images, method.edges.V)
        needed = stages(method.transport, method.law, self.n, threads)
        terms = (*method.transport, Convection(), Pressure(method.eos))
        self.exchange = Exchange(listed(terms), (*first, *needed), self.n, threads)

    def look_at(self, state: np.ndarray) -> None:
        """Compute fields of points and images, and prepare the stages."""
        self.threads(read, self.n, state, self.method.eos, self.method.law, self.points)
        self.surround(state)
        for stage in self.exchange.stages:
            stage.prepare(self.at)

    def surround(self, state: np.ndarray) -> None:
        """Set fields of images and of held points; there are none here."""

    def rates(self, state: np.ndarray, out: np.ndarray) -> None:
        """d(state)/dt of a state (4, n), written to `out`    [Eqs 34-36, 51]"""
        self.look_at(state)
        self.threads(driven, self.n, self.exchange.sum(self.at), self.at.V, self.points, self.push, out)

    def fault(self, state: np.ndarray, ids: np.ndarray) -> str:
        i = first_invalid(state, self.method.eos)
        if i == state.shape[1]:
            return ""
        eos, (rho, e) = type(self.method.eos).__name__, inner(*state[:4, i])
        return f"point {i} has rho = {rho:.6g}, e = {e:.6g}, outside the validity of {eos}"


@formula
def inner(rho, px, py, eps):
    """Density and internal energy per mass."""
    return rho, (eps - (px*px + py*py)/(2*rho))/rho


@jit
def first_invalid(state, eos):
    """The first point outside the validity of the equation of state; n where there is none."""
    for i in range(state.shape[1]):
        rho, e = inner(state[0, i], state[1, i], state[2, i], state[3, i])
        if not valid(eos, rho, e):
            return i
    return state.shape[1]


def check_number(n: int, points: int) -> None:
    """Raise ValueError if a state has another number of points."""
    if n != points:
        raise ValueError(f"a state of {n} points for {points} fixed ones: make it with `state`")


def stored(edges: Edges, beyond: Beyond = NONE_BEYOND, image: np.ndarray = NOWHERE) -> Stored:
    """Edges stored by rows: to other points, in both directions, and to images, of indices `image`."""
    rows = np.concatenate([edges.i, edges.j, beyond.i])
    near = np.concatenate([edges.j, edges.i, image])
    order = np.lexsort((near, rows))
    S = np.concatenate([edges.S, -edges.S, beyond.S])[order]/2
    k = np.concatenate([edges.k, edges.k, beyond.k])[order]
    taken = np.bincount(rows, minlength=edges.n)
    first = np.cumsum(taken) - taken
    return Stored(first.astype(u64), taken.astype(u32), near[order].astype(u32), S[:, 0].copy(),
                  S[:, 1].copy(), k)


@jit
def read(first, last, state, eos, law, points):
    for i in range(first, last):
        a, rho = points[i], state[0, i]
        a.rho, a.vx, a.vy, a.eps = rho, state[1, i]/rho, state[2, i]/rho, state[3, i]
        a.T = temperature(eos, rho, a.eps/rho - 0.5*(a.vx**2 + a.vy**2))
        a.ux, a.uy, a.Td = a.vx, a.vy, a.T
        a.eta, a.k = viscosity(law, rho, a.T), conductivity(law, rho, a.T)


@jit
def driven(first, last, total, V, points, push, out):
    """Rates of free points: gains over edges per volume, and the force per mass."""
    for i in range(first, last):
        a = points[i]
        out[0, i], out[1, i] = total[i, 0]/V[i], total[i, 1]/V[i] + push[0]*a.rho
        out[2, i] = total[i, 2]/V[i] + push[1]*a.rho
        out[3, i] = total[i, 3]/V[i] + (push[0]*a.vx + push[1]*a.vy)*a.rho
