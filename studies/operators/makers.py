"""The map of makers: what pressures, velocities and heat do over the areas of today's methods on points.

Smooth particles are asked as they run: pressures P push by -momentum(P), uniform ones heat by -P gradient(v),
heat flows by laplacian(T): the areas are those of `particles.smooth` themselves. L_i is the gradient of x, 1
where linear fields are exact; its deviator is that of P M, a stress which a fluid has not.

Heat through a plate with odd images is that of a layer with Nu = 2, T_m - T = dT (s - sin(2 pi s)/2 pi), s =
y/L: flat in the middle, without a second derivative at the plates, so that images, which have none, may be
right to second order.
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

#: vortices that carry points: their speed, turns, and viscosity over the height
SPEED, TURNS, ETA = 0.2, 0.5, 0.01
Field = Callable[[np.ndarray], np.ndarray]      # of places (2, points)


class Operators(NamedTuple):
    """At places x (2, n): slopes (2, n) as pressures and as velocities have them, Laplacian (n,); L_i."""
    x: np.ndarray
    momentum: Callable[[Field], np.ndarray]
    gradient: Callable[[Field], np.ndarray]
    laplacian: Callable[[Field], np.ndarray]
    linear: np.ndarray


def of_particles(points: Points, weight: Any, transport: type) -> Operators:
    """Of smooth particles of unit mass, kappa = 1, no viscosity."""
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
    """Of edges."""
    edges, x = make(points, weight), points.x.T

    def slopes(matrices: list, f: Field) -> np.ndarray:
        return np.array([matrix@f(x) for matrix in matrices])/edges.V
    return Operators(x, lambda f: slopes(edges.D, f), lambda f: slopes(edges.G, f),
                     lambda f: edges.lap(f(x)), edges.linear.transpose(2, 1, 0))


NAMES = ("sph", "sumB", "RKGC", "bonet-lok", "corrected", "CRKSPH", "MFM")
#: how, and of what; closed faces: of those that close and are exact the nearest to those of a weight
MAKERS: dict[str, tuple[Callable, Any]] = {name: (of_particles, spam.TODAY[name].transport) for name in NAMES}
MAKERS |= {"closed faces": (of_edges, exact), "delaunay": (of_edges, delaunay)}


def hexagonal(counts: tuple[int, ...], size: float, seed: int) -> Points:
    """A triangular lattice, so many points along x, in a box of about that height."""
    columns, rows = counts[0], 2*round(counts[1]/sqrt(3))
    i, j = (q.ravel() for q in np.meshgrid(np.arange(columns), np.arange(rows), indexing="ij"))
    a = sqrt(2/sqrt(3))
    box, x = a*np.array([columns, rows*sqrt(3)/2]), np.array([i + 0.25 + j % 2/2, (j + 0.5)*sqrt(3)/2])
    return of_positions(wrapped(a*x.T - box/2, box), box)


@cache
def flowed(counts: tuple[int, ...], size: float, seed: int) -> Points:
    """Where classic particles are that vortices have carried for half of a turn."""
    L = float(counts[0])
    ready = spam.TODAY["sph"].ready(Tile(width=L, L=L, law=ConstEta(ETA*L, ETA*L)), seed)
    x, y = 2*np.pi/L*ready.start[:2]
    ready.start[2:4] = SPEED*np.array([np.sin(x)*np.cos(y), -np.cos(x)*np.sin(y)])
    done = run(ready.method, ready.start, Plan(dt=ready.dt, steps=round(TURNS*L/SPEED/ready.dt)))
    return of_positions(wrapped(done.state[:2].T, np.array([L, L])), (L, L))


SETS = {**DISORDERS, "hexagonal": Disorder("hexagonal", hexagonal), "flowed": Disorder("flowed", flowed)}


def size(q: np.ndarray) -> float:
    """Root of the mean square over points of numbers (..., n)."""
    return float(np.sqrt((q.reshape(-1, q.shape[-1])**2).sum(axis=0).mean()))


class OnPoints(Case, same="maker points cells seed"):
    """Something that a maker does on cells x cells points of SETS; no row where edges cannot be made."""
    maker: str
    points: Disorder
    cells: int
    seed: int = 1

    @property
    def cost(self) -> float:
        return 1e-3*self.cells**2

    def measure(self, report: Report) -> Iterator[Row]:
        points = self.points.make((self.cells, self.cells), self.points.size, self.seed)
        try:
            yield self.row(points)
        except ArithmeticError:     # no such edges exist on these points: that is a result
            return

    def row(self, points: Points) -> Row:
        """Of a set of points."""
        raise NotImplementedError


class MakerErrors(OnPoints, table="makers"):
    """Errors of one maker of MAKERS, waves as long as the box."""
    make: Callable
    kind: Any

    def row(self, points: Points) -> Row:
        return errors(points, self.make(points, WendlandC2.of(h=3.0), self.kind))


def errors(points: Points, at: Operators) -> dict[str, float]:
    """Over the size of what is exact, means of waves along x and y."""
    L, eye, waves = at.linear, np.eye(2)[:, :, None], []
    for a in (0, 1):
        k = 2*np.pi/points.box[a]

        def sine(x: np.ndarray, a: int = a, k: float = k) -> np.ndarray:
            return np.sin(k*x[a])
        right = k*np.cos(k*at.x[a])*eye[a]
        lap = size(at.laplacian(sine) + k**2*sine(at.x))/size(k**2*sine(at.x))
        waves.append([*(size(slope(sine) - right)/size(right) for slope in (at.momentum, at.gradient)), lap])
    return {"closure": points.a*size(at.momentum(lambda x: 1 + 0*x[0])), "linear": size(L - eye)/sqrt(2),
            "deviator": size(L - eye*np.trace(L)/2)/sqrt(2),
            **dict(zip(("divergence", "gradient", "laplacian"), np.mean(waves, axis=0)))}


# --- heat through plates ---------------------------------------------------------------------------------

NU, WARMER = 2.0, 0.1
#: what else there is pushes in another way and conducts as sph does
SMOOTH = ("sph", "corrected", "delta-plus")
FACES: dict[str, Callable] = {"closed faces": exact, "delaunay": delaunay}


def layer(points: Points) -> tuple[RayleighBenard, np.ndarray]:
    """The layer in the box of some points, and their temperatures."""
    width, L = points.box
    scene = RayleighBenard(ra=1e4, L=float(L), aspect=width/L, T_hot=1 + WARMER/2, T_cold=1 - WARMER/2)
    s = points.x[:, 1]/L
    return scene, scene.T_mean - scene.dT*(s - np.sin(2*np.pi*s)/(2*np.pi))


def through_pairs(points: Points, maker: str) -> np.ndarray:
    """Nu at both plates, of smooth particles at rest."""
    scene, T = layer(points)
    variant, fields = spam.TODAY[maker], (np.ones(len(T)), 0*points.x, T)
    method = spam.method(scene, variant)
    start = variant.transport.complete(spam.start(scene, x=points.x, fields=fields), 1.0, 1.0)
    sums, state, _ = method.look(start)
    sums.prepare(state)
    return scene.L/scene.k/scene.dT*np.array([-side*PlateHeat(side)(sums, state) for side in (-1, 1)])


def through_faces(points: Points, make: Callable) -> np.ndarray:
    """The same over edges, kappa = 1."""
    scene, T = layer(points)
    _, beyond = between_plates(make, points.x, *points.box, WendlandC2.of(h=3.0))      # type: ignore[call-arg]
    plate = np.array([scene.T_hot, scene.T_cold])[beyond.plate]
    flux = beyond.k*(2*plate - T[beyond.parent] - T[beyond.i])*np.where(beyond.plate == 0, 1, -1)
    return scene.L/scene.dT/scene.width*np.bincount(beyond.plate, flux, 2)


class WallHeat(OnPoints, table="wall_heat"):
    """Heat of one maker between plates, so many cells apart."""

    def row(self, points: Points) -> Row:
        through: Any = through_faces if self.maker in FACES else through_pairs
        nu = through(points, FACES.get(self.maker, self.maker))
        return {"wall": np.sqrt(np.mean((nu/NU - 1)**2))}
