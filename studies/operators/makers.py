"""Errors of gradients, divergences and Laplacians over the areas of today's methods, on sets of points.

Operators of smooth particles are read from the rates of `particles.smooth`: a pressure P pushes by
-momentum(P), a uniform P heats by -P gradient(v), conduction heats by laplacian(T). L_i is the gradient of x,
1 where linear fields are exact.

Heat through plates with odd images is measured in a layer with Nu = 2, T_m - T = dT (s - sin(2 pi s)/2 pi), s
= y/L. This profile is flat in the middle and has no second derivative at the plates. Odd images have none
either, so that they can be right to second order.
"""
from collections.abc import Callable, Iterator
from functools import cache, partial
from math import sqrt
from typing import Any, NamedTuple

import numpy as np

from continuum.fluid import ConstEta
from continuum.scene import RayleighBenard
from particles.integral.edge_makers import delaunay, exact
from particles.integral.edges import between_plates
from particles.integral.points import Points, of_positions, wrapped
from particles.observe import PlateHeat
from particles.pairs import sweep
from particles.run import Plan, run
from particles.weights import WendlandC2
from studies.build import spam
from studies.build.scenes import Tile
from studies.build.setting import DISORDERS, Disorder
from studies.kit.case import Case, Report
from studies.kit.table import Row

#: vortices that carry points: speed, number of turns, viscosity over the height
SPEED, TURNS, ETA = 0.2, 0.5, 0.01
Field = Callable[[np.ndarray], np.ndarray]      # function of places (2, points)


class Operators(NamedTuple):
    """Operators at places x (2, n): gradients (2, n) of pressures and of velocities, Laplacian (n,), L_i."""
    x: np.ndarray
    momentum: Callable[[Field], np.ndarray]
    gradient: Callable[[Field], np.ndarray]
    laplacian: Callable[[Field], np.ndarray]
    linear: np.ndarray


def of_particles(points: Points, weight: Any, transport: Any) -> Operators:
    """Operators of smooth particles of unit mass, kappa = 1, no viscosity."""
    method = spam.fluid(weight, tuple(points.box), law=ConstEta(0.0, 1.0), transport=transport)
    sums, *_ = method.look(spam.at_rest(points.x, 1.0))
    around, n = sums.around, sums.n
    places = np.array([around.x, around.y])

    def respond(P: Any, u: Any = 0.0, v: Any = 0.0, T: Any = 1.0) -> np.ndarray:
        around.vx[:], around.vy[:], around.T[:] = u, v, T
        sums.threads(sweep, n, *sums.exchange(P + 0*around.x), around.pairs, sums.pull)
        return around.rho[:n]*sums.pull[:n, :3].T

    def gradient(f: Field) -> np.ndarray:
        return -np.array([respond(1.0, f(places))[2], respond(1.0, 0.0, f(places))[2]])
    return Operators(places[:, :n], lambda f: -respond(f(places))[:2], gradient,
                     lambda f: 10*respond(0.0, T=1 + 0.1*f(places))[2],
                     np.array([gradient(partial(np.take, indices=a, axis=0)) for a in (0, 1)]))


def of_edges(points: Points, weight: Any, make: Callable) -> Operators:
    """Operators of the edges that a maker makes."""
    edges, x = make(points, weight), points.x.T

    def slopes(matrices: list, f: Field) -> np.ndarray:
        return np.array([matrix@f(x) for matrix in matrices])/edges.V
    return Operators(x, lambda f: slopes(edges.D, f), lambda f: slopes(edges.G, f),
                     lambda f: edges.laplacian@f(x)/edges.V, edges.linear.transpose(2, 1, 0))


#: makers of edges; closed faces: closed, exact, nearest to a weight's
FACES: dict[str, Callable] = {"closed faces": exact, "delaunay": delaunay}
#: name -> exchange of smooth particles, or maker of edges
MAKERS = FACES | {name: spam.TODAY[name].transport
                  for name in ("sph", "sumB", "RKGC", "bonet-lok", "corrected", "CRKSPH", "MFM")}


def hexagonal(counts: tuple[int, ...], size: float, seed: int) -> Points:
    """A triangular lattice of unit volumes, counts[0] points along x, in a box of about that shape."""
    columns, rows = counts[0], 2*round(counts[1]/sqrt(3))
    i, j = (q.ravel() for q in np.meshgrid(np.arange(columns), np.arange(rows), indexing="ij"))
    a = sqrt(2/sqrt(3))
    box, x = a*np.array([columns, rows*sqrt(3)/2]), np.array([i + 0.25 + j % 2/2, (j + 0.5)*sqrt(3)/2])
    return of_positions(wrapped(a*x.T - box/2, box), box)


@cache
def flowed(counts: tuple[int, ...], size: float, seed: int) -> Points:
    """Places of classic SPH particles after vortices have carried them for half a turn."""
    L = float(counts[0])
    ready = spam.TODAY["sph"].ready(Tile(width=L, L=L, law=ConstEta(ETA*L, ETA*L)), seed)
    x, y = 2*np.pi/L*ready.start[:2]
    ready.start[2:4] = SPEED*np.array([np.sin(x)*np.cos(y), -np.cos(x)*np.sin(y)])
    done = run(ready.method, ready.start, Plan(dt=ready.dt, steps=round(TURNS*L/SPEED/ready.dt)))
    return of_positions(wrapped(done.state[:2].T, np.array([L, L])), (L, L))


SETS = {**DISORDERS, "hexagonal": Disorder("hexagonal", hexagonal), "flowed": Disorder("flowed", flowed)}


def size(q: np.ndarray) -> float:
    """Root of the mean squared norm over points, of q (..., n)."""
    return float(np.sqrt((q.reshape(-1, q.shape[-1])**2).sum(axis=0).mean()))


class OnPoints(Case, same="maker points cells seed"):
    """Base of measurements of a maker on cells x cells points of SETS."""
    maker: str
    points: Disorder
    cells: int
    seed: int = 1

    @property
    def cost(self) -> float:
        return 1e-3*self.cells**2

    def measure(self, report: Report) -> Iterator[Row]:
        yield self.row(self.points.make((self.cells, self.cells), self.points.size, self.seed))

    def row(self, points: Points) -> Row:
        """The row measured on these points."""
        raise NotImplementedError


class MakerErrors(OnPoints, table="makers"):
    """Errors of the operators of one of MAKERS, for waves as long as the box."""
    kind: Callable

    def row(self, points: Points) -> Row:
        read = of_particles if isinstance(self.kind, type) else of_edges
        return errors(points, read(points, WendlandC2.of(h=3.0), self.kind))


def errors(points: Points, at: Operators) -> dict[str, float]:
    """Errors of operators relative to exact values, means over waves along x and y."""
    eye, waves = np.eye(2)[:, :, None], []
    for a in (0, 1):
        k = 2*np.pi/points.box[a]

        def sine(x: np.ndarray, a: int = a, k: float = k) -> np.ndarray:
            return np.sin(k*x[a])
        right = k*np.cos(k*at.x[a])*eye[a]
        lap = size(at.laplacian(sine) + k**2*sine(at.x))/size(k**2*sine(at.x))
        waves.append([*(size(slope(sine) - right)/size(right) for slope in (at.momentum, at.gradient)), lap])
    return {"closure": points.a*size(at.momentum(lambda x: 1 + 0*x[0])),
            "linear": size(at.linear - eye)/sqrt(2),
            **dict(zip(("divergence", "gradient", "laplacian"), np.mean(waves, axis=0)))}


# --- heat through plates ---------------------------------------------------------------------------------

NU, WARMER = 2.0, 0.1
#: the other methods differ from these in pressures and conduct heat as sph does
SMOOTH = ("sph", "corrected", "delta-plus")


def layer(points: Points) -> tuple[RayleighBenard, np.ndarray]:
    """The layer that fills the box of the points, and the temperatures of the points."""
    width, L = points.box
    scene = RayleighBenard(ra=1e4, L=float(L), aspect=width/L, T_hot=1 + WARMER/2, T_cold=1 - WARMER/2)
    s = points.x[:, 1]/L
    return scene, scene.T_mean - scene.dT*(s - np.sin(2*np.pi*s)/(2*np.pi))


def through_pairs(points: Points, maker: str) -> np.ndarray:
    """Nu at both plates, for smooth particles at rest."""
    scene, T = layer(points)
    fields = np.ones(len(T)), 0*points.x, T
    method, start, _ = spam.TODAY[maker].ready(scene, x=points.x, fields=fields)
    sums, state, _ = method.look(start)
    sums.prepare(state)
    return scene.L/scene.k/scene.dT*np.array([-side*PlateHeat(side)(sums, state) for side in (-1, 1)])


def through_faces(points: Points, make: Callable) -> np.ndarray:
    """Nu at both plates, over edges, kappa = 1."""
    scene, T = layer(points)
    _, beyond = between_plates(make, points.x, *points.box, WendlandC2.of(h=3.0))      # type: ignore[call-arg]
    plate = np.array([scene.T_hot, scene.T_cold])[beyond.plate]
    flux = beyond.k*(2*plate - T[beyond.parent] - T[beyond.i])*np.where(beyond.plate == 0, 1, -1)
    return scene.L/scene.dT/scene.width*np.bincount(beyond.plate, flux, 2)


class WallHeat(OnPoints, table="wall_heat"):
    """Error of the heat through plates for one maker; cells : rows between the plates."""

    def row(self, points: Points) -> Row:
        through: Any = through_faces if self.maker in FACES else through_pairs
        nu = through(points, FACES.get(self.maker, self.maker))
        return {"wall": np.sqrt(np.mean((nu/NU - 1)**2))}
