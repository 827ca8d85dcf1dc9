"""Discretized integral hydrodynamics on fixed points in the Rayleigh-Benard scene: one run as a case    [RR98, Sec. III]"""
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np

from continuum.scene import Periodic, RayleighBenard
from particles.integral.bodies import held, together, with_plates
from particles.integral.edge_makers import closed, exact, plain, renormalised
from particles.integral.edges import between_plates
from particles.integral.layer import Exchanging, Layer
from particles.integral.nested import mixed
from particles.integral.points import lattice, of_positions, random, relaxed, wrapped
from particles.integral.stream import Stream, Streaming
from particles.integral.triangulation import between, delaunay
from particles.run import Run
from particles.weights import Lucy, WendlandC2
from studies.build.names import START_ENERGY, check_spacings, one_energy
from studies.build.points import PointsRun, Setting, rolls

OF_LIMIT = 0.8          # of the step to its stability limit: the flow is steady, its errors are of space alone
RECORDS = 4             # a free-fall time
FROM_EDGE = 0.25        # of a spacing: jittered points come no nearer to a plate with images, three quarters to one with points


def positions(width: float, height: float, size: float, seed: int) -> np.ndarray:
    """Points (n, 2) of unit spacing: a lattice, every coordinate shifted by up to `size`."""
    x = lattice((round(width), round(height))).x
    return inside(height, wrapped(x + np.random.default_rng(seed).uniform(-size, size, x.shape), np.array([width, height])))


def inside(height: float, x: np.ndarray) -> np.ndarray:
    """Points too near to the edge of their room moved away from it."""
    return np.stack([x[:, 0], np.clip(x[:, 1], -height/2 + FROM_EDGE, height/2 - FROM_EDGE)], axis=1)


def hard_core(width: float, height: float, size: float, seed: int) -> np.ndarray:
    """Points (n, 2) at random, none nearer to another than `size` spacings."""
    return inside(height, random((round(width), round(height)), size, seed).x)


def settled(width: float, height: float, size: float, seed: int) -> np.ndarray:
    """Random points that have moved apart together with their mirror images until each is surrounded evenly."""
    x, shift, mirror = hard_core(width, height, size, seed), np.array([0.0, height/2]), np.array([1.0, -1.0])
    both = of_positions(np.concatenate([x - shift, (x - shift)*mirror]), (width, 2*height))
    return inside(height, relaxed(both, WendlandC2.of(h=3.0), sweeps=4000).x[:len(x)] + shift)


class Scheme(NamedTuple):
    """One way to make points and edges; `size`: of the points' disorder, in spacings; `share` of transport along edges.

    held : plates are rows of points that are held, in place of mirror images behind them.
    """
    name: str
    make: Callable = renormalised
    weight: Any = Lucy
    h: float = 2.0
    size: float = 0.0
    mended: bool = True
    share: float = 1.0
    points: Callable = positions
    held: bool = False


SCHEMES = {s.name: s for s in (
    Scheme("fixed-lattice"),
    Scheme("fixed-lattice-printed-heat", mended=False),     # Eq. 51 with the work of its forces as the only heating
    Scheme("fixed-lattice-h3", h=3.0),
    Scheme("fixed-lattice-nested", share=0.1),              # Eqs 37, 38, with a tenth along edges
    Scheme("fixed-lattice-nested-only", share=0.0),         # Eqs 37, 38
    Scheme("fixed-jittered-plates", delaunay, size=0.3, held=True),
    Scheme("fixed-random-plates", delaunay, size=0.5, points=hard_core, held=True),
    Scheme("relaxed-plates", delaunay, size=0.5, points=settled, held=True),
    Scheme("fixed-jittered-delaunay", delaunay, size=0.3),
    Scheme("fixed-random-delaunay", delaunay, size=0.5, points=hard_core),
    Scheme("relaxed-delaunay", delaunay, size=0.5, points=settled),
    Scheme("relaxed-plain", plain, WendlandC2, 3.0, 0.5, points=settled),
    Scheme("fixed-jittered-exact", exact, WendlandC2, 3.0, 0.3),
    Scheme("fixed-jittered-closed", closed, WendlandC2, 3.0, 0.3),
    Scheme("fixed-jittered-plain", plain, WendlandC2, 3.0, 0.3),
)}


def fluid(scene: RayleighBenard, scheme: Scheme, seed: int) -> Layer | Stream:
    """The method of unit spacing: a scene of L = rows spacings."""
    if not isinstance(scene.sides, Periodic):
        raise ValueError("fixed points have plates above and below only: take a scene with periodic sides")
    check_spacings(scene)
    return (plates if scheme.held else layer)(scene, scheme, seed)


def layer(scene: RayleighBenard, scheme: Scheme, seed: int) -> Layer:
    """Plates with mirror images behind."""
    x = scheme.points(scene.width, scene.L, scheme.size, seed)
    edges, beyond = between_plates(scheme.make, x, scene.width, scene.L, scheme.weight.of(h=scheme.h))
    return Layer(x=x, edges=edges, beyond=beyond, eos=scene.eos, law=scene.law, T_plates=(scene.T_hot, scene.T_cold), g=scene.g,
                 transport=mixed(scheme.share, scheme.mended))


def plates(scene: RayleighBenard, scheme: Scheme, seed: int) -> Stream:
    """Plates with rows of points on them: triangles end there. One row of points less between them."""
    inner = scheme.points(scene.width, scene.L - 1, scheme.size, seed)
    x, lower, upper = with_plates(inner, round(scene.width), scene.L)
    both = together(held(lower, T=scene.T_hot), held(upper, T=scene.T_cold))
    return Stream(x=x, edges=between(x, scene.width, scene.L), eos=scene.eos, law=scene.law, held=both, push=(0.0, -scene.g))


def start(scene: RayleighBenard, method: Layer | Stream) -> np.ndarray:
    """State (4, n): rolls of Sec. VI, linear temperature, density 1    [KHP95]"""
    x, y = method.x.T
    return method.state(1.0, np.stack(scene.flow(x, y, START_ENERGY), axis=1), scene.T(y))


def kinetic(sums: Exchanging | Streaming, state: np.ndarray) -> float:
    """K per mass."""
    V = sums.method.edges.V
    return float(0.5*V@((state[1]**2 + state[2]**2)/state[0])/(V@state[0]))


class PlateHeat(NamedTuple):
    """Heat that enters the fluid through a plate (0: lower, 1: upper), per time."""
    plate: int

    def __call__(self, sums: Exchanging | Streaming, state: np.ndarray) -> float:
        """Over all edges to images behind the plate, along them and nested; what its points give."""
        if isinstance(sums, Streaming):
            sums.rates(state, np.empty_like(state))
            return -float(sums.received[sums.method.held.body == self.plate, 2].sum())
        return sums.heat_through(self.plate)


@dataclass(frozen=True, kw_only=True)
class DihRun(PointsRun):
    """One run on fixed points until t_end in free-fall times, when nothing changes any more."""
    scheme: Scheme = SCHEMES["fixed-lattice"]
    t_end: float = 150.0

    @property
    def name(self) -> str:
        return self.scheme.name

    @property
    def points(self) -> int:
        """With rows on both plates there is one more than between images."""
        return round(self.scene.width)*(round(self.scene.L) + self.scheme.held)

    @property
    def cost(self) -> float:
        steps = self.t_end*self.free_fall_time/max(0.2, 1.1 - self.scene.L/100)
        return steps*4*self.points*100e-9*(self.scheme.h/2)**2 + 5

    def setting(self) -> Setting:
        method = fluid(self.scene, self.scheme, self.seed)
        series: dict[str, Any] = {"ke": kinetic, "lower": PlateHeat(0), "upper": PlateHeat(1)}
        return Setting(method, start(self.scene, method), OF_LIMIT, series, RECORDS)

    def values(self, setting: Setting, done: Run) -> dict:
        """The last ones; errors are what the last tenth of the time changed."""
        x, V, state = setting.method.x, setting.method.edges.V, done.state
        ke, lower, upper = (np.array(done.series[name]) for name in ("ke", "lower", "upper"))
        nu, late = (lower - upper)/2/self.heat_at_rest, slice(-max(2, len(ke)//10), None)
        err = float(np.ptp(ke[late]))
        nu_err = float(np.ptp(nu[late]) + abs(lower[-1] + upper[-1])/2/self.heat_at_rest)
        return {**one_energy(ke[-1], err), "nu": nu[-1], "nu_err": nu_err, "rolls": rolls(self.scene, x, state[2]/state[0]),
                "mass_drift": float(V@state[0]/(V@setting.first[0]) - 1), "converged": bool(err < 1e-3*ke[-1] + 1e-7)}
