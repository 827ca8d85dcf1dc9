"""Discretized integral hydrodynamics on fixed points, in any scene    [RR98, Sec. III]"""
from collections.abc import Callable
from dataclasses import replace
from functools import cache, partial
from typing import Any, NamedTuple

import numpy as np

from continuum.exact.waves import LinearGas, Waves, continuum, waves
from continuum.scene import Torus
from continuum.sides import Periodic, Plate, Sides, Sliding, warm
from particles.fields import kinetic
from particles.integral.bodies import Held, Rows, held, together, with_sides
from particles.integral.edge_makers import closed, exact, plain, renormalised
from particles.integral.edges import NONE_BEYOND, between_plates
from particles.integral.entropy_stable import StableLayer
from particles.integral.interpolants import W, reach
from particles.integral.layer import Driven, Layer
from particles.integral.nested import mixed
from particles.integral.points import of_positions, random, relaxed
from particles.integral.stream import Stream, Streaming
from particles.integral.triangulation import between, delaunay
from particles.weights import Lucy, Monaghan, WendlandC2
from studies.build.setting import (
    Ready,
    check_points,
    in_scene,
    inside,
    no_layer,
    no_still_layer,
    relaxed_random,
    shifted,
    sticking,
)

OF_LIMIT = 0.8      # time step over its stability limit: the flow is steady, its errors are of space alone


def hard_core(width: float, height: float, size: float, seed: int) -> np.ndarray:
    """Random points (n, 2) in a periodic box, no two nearer than `size` spacings."""
    return random((round(width), round(height)), size, seed).x


@cache
def evened(width: float, height: float, size: float, seed: int) -> np.ndarray:
    """The same (n, 2), relaxed until each is surrounded evenly."""
    return relaxed_random((round(width), round(height)), size, seed).x


@cache
def settled(width: float, height: float, size: float, seed: int) -> np.ndarray:
    """Random points (n, 2) between plates, relaxed with mirror images until each is surrounded evenly."""
    x, shift = inside(height, hard_core(width, height, size, seed)), np.array([0.0, height/2])
    both = of_positions(np.concatenate([x - shift, (x - shift)*[1, -1]]), (width, 2*height))
    return inside(height, relaxed(both, WendlandC2.of(h=3.0), sweeps=4000).x[:len(x)] + shift)


class Scheme(NamedTuple):
    """One way to make points and edges.

    size : disorder of the points, in spacings; points : their places in a periodic box. share : part of
    friction and heat along edges, the rest is nested. mended : friction along edges heats as the stress does.
    held : plates are rows of held points, in place of mirror images behind them. kind : class of the method
    with images or in a periodic box. lacks : function of a scene that names the part which the scheme cannot
    take, empty if none.
    """
    name: str
    make: Callable = renormalised
    weight: Any = Lucy
    h: float = 2.0
    size: float = 0.0
    mended: bool = True
    share: float = 1.0
    points: Callable = shifted
    held: bool = False
    kind: Any = Layer
    lacks: Callable[[Any], str] = no_layer

    def refuses(self, scene: Any) -> str:
        return sticking(scene) if self.held and isinstance(scene.sides, Sides) else self.lacks(scene)

    def ready(self, scene: Any, seed: int = 1) -> Ready:
        return in_scene(fluid(scene, self, seed), scene, OF_LIMIT)

    @property
    def series(self) -> dict[str, Any]:
        return {"ke": kinetic, "lower": partial(heat_in, plate=0), "upper": partial(heat_in, plate=1)}


SCHEMES = {s.name: s for s in (
    Scheme("fixed-lattice"),
    Scheme("fixed-lattice-printed-heat", mended=False),     # Eq. 51, heated by its forces alone
    Scheme("fixed-lattice-h1.2", h=1.2),
    Scheme("fixed-lattice-h3", h=3.0),
    Scheme("fixed-lattice-monaghan", weight=Monaghan),
    Scheme("fixed-lattice-wendland-c2", weight=WendlandC2),
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
    Scheme("fixed-lattice-entropy-stable", kind=StableLayer, lacks=no_still_layer),
    Scheme("fixed-jittered-delaunay-entropy-stable", delaunay, size=0.3, kind=StableLayer,
           lacks=no_still_layer),
)}


def fluid(scene: Any, scheme: Scheme, seed: int = 1) -> Layer | Stream:
    """The method on points of unit spacing in a scene; a torus has no plates to hold points on."""
    check_points(scheme, scene)
    held = scheme.held and not isinstance(scene.sides, Torus)
    return (plates if held else layer)(scene, scheme, seed)


def layer(scene: Any, scheme: Scheme, seed: int) -> Layer:
    """The method between plates with mirror images behind them, or in a periodic box."""
    box, weight = (scene.width, scene.L), scheme.weight.of(h=scheme.h)
    if isinstance(scene.sides, Torus):
        place = evened if scheme.points is settled else scheme.points
        points = of_positions(place(*box, scheme.size, seed), box)
        x, edges, beyond = points.x, scheme.make(points, weight), NONE_BEYOND
    else:
        x = inside(scene.L, scheme.points(*box, scheme.size, seed))
        edges, beyond = between_plates(scheme.make, x, *box, weight)
    kind: Any = partial(Driven, slide=(0.0, scene.slide)) if scene.slide else scheme.kind
    return kind(x=x, edges=edges, beyond=beyond, eos=scene.eos, law=scene.law, g=scene.g,
                T_plates=(scene.T_hot, scene.T_cold), transport=mixed(scheme.share, scheme.mended))


def with_term(method: Any, term: Any) -> Layer:
    """The method with a pair term of one's own added, over the same edges.

    Raises TypeError: the method is not a `Layer`, whose edges pair terms need.
    """
    if not isinstance(method, Layer):
        able = [name for name, scheme in SCHEMES.items() if not scheme.held]
        raise TypeError(f"{type(method).__name__} takes no {type(term).__name__}: pair terms are for methods "
                        f"with edges and images, which are {', '.join(able)}")
    return replace(method, transport=(*method.transport, term))


def plates(scene: Any, scheme: Scheme, seed: int) -> Stream:
    """The method with rows of held points on closed sides, where triangles end."""
    box, sides = (scene.width, scene.L), four_sides(scene)
    closed = not sides.axes[0], not sides.axes[1]
    x, rows = between_sides(box, closed, scheme.points, scheme.size, seed)
    return Stream(x=x, edges=between(x, *box, closed), eos=scene.eos, law=scene.law,
                  held=together(*bodies_of(sides, rows)), push=(0.0, 0.0 - scene.g), solid=False)


def four_sides(scene: Any) -> Sides:
    """The four sides of a scene; a layer has periodic sides, and plates of which the upper one may slide."""
    layer = Sides(Periodic(), Periodic(), Plate(T=scene.T_hot), Sliding(scene.slide, T=scene.T_cold))
    return scene.sides if isinstance(scene.sides, Sides) else layer


def between_sides(box: tuple[float, float], closed: tuple[bool, bool], place: Callable, size: float,
                  seed: int) -> tuple[np.ndarray, Rows]:
    """Disordered points (n, 2), with rows of points on closed sides in place of one inner row; these rows."""
    room = box[0] - closed[0], box[1] - closed[1]
    x = place(*room, size, seed)
    for axis in (axis for axis in (0, 1) if closed[axis]):
        x = inside(room[axis], x, axis)
    return with_sides(x, box, closed)


def bodies_of(sides: Sides, rows: Rows) -> list[Held]:
    """Held rows lower, upper, left, right, then corners; each point gets the heat of a spacing."""
    level, upright = np.eye(2)
    made = [held(which, tuple(getattr(side, "v", 0.0)*along), side.T, side.q)
            for side, which, along in ((sides.bottom, rows.bottom, level), (sides.top, rows.top, level),
                                       (sides.left, rows.left, upright), (sides.right, rows.right, upright))
            if len(which)]
    meet = [(one, other) for other in sides[2:] for one in sides[:2]]
    return made + [in_corner(one, other, corner) for (one, other), corner in zip(meet, rows.corners)]


def in_corner(one: Any, other: Any, corner: int) -> Held:
    """Corner at rest: mean temperature of the sides that have one, or the heat of half a spacing of each."""
    T = [side.T for side in (one, other) if warm(side)]
    return held(np.array([corner]), T=float(np.mean(T)) if T else np.nan, heat=(one.q + other.q)/2)


def heat_in(sums: Any, state: np.ndarray, plate: int) -> float:
    """Heat that enters the fluid through a plate (0: lower, 1: upper), per time."""
    if not isinstance(sums, Streaming):
        return float(sums.heat_through(plate))
    sums.rates(state, np.empty_like(state))
    return -float(sums.received[on_plate(sums.method.held, plate), 2].sum())


def on_plate(held: Held, plate: int) -> np.ndarray:
    """Mask of held points on the lower or upper plate (0, 1), and of its corners that it alone heats."""
    ends = (held.body >= 4 + 2*plate) & (held.body < 6 + 2*plate)
    at = held.body == plate
    return at | ends & np.isin(held.T, held.T[at])

# --- plane waves, exactly -----------------------------------------------------------------------------------


def neighbours(weight: Any, d: int) -> np.ndarray:
    """Points r (m, d) of the unit lattice within the range of a weight."""
    q = np.arange(-int(reach(weight)), int(reach(weight)) + 1)
    r = np.stack([axis.ravel() for axis in np.meshgrid(*[q]*d)], axis=1)
    size = np.sqrt((r**2).sum(axis=1))
    return r[(size > 0) & (size < reach(weight))]


def lattice_waves(gas: LinearGas, weight: Any, k: np.ndarray, nested: bool) -> Waves:
    """Plane waves of small amplitude on a square lattice, without code of the sums    [RR98, Sec. III]

    k (2,) : wave vector along an axis or a diagonal. Numbers as in `continuum.exact.waves`. Sums are over
    points r of a lattice of unit spacing, w = c W(r) with c from sum_r w r = d, e = r/|r|, n = k/|k|, m
    normal to n:

        s = sum_r w e.n sin k.r                                        [Eqs 34-36]
        nested: l, q, t with s^2 for k^2                               [Eqs 37, 38]
        pairwise: sum_r (2 w/r) (1 - cos k.r) times                    [Eq. 51]
            A + B (e.n)^2 for l, A + B (e.m)^2 for t, kappa for q
    """
    d = len(k)
    r = neighbours(weight, d)
    size, n = np.sqrt((r**2).sum(axis=1)), k/np.hypot(*k)
    w = W(weight, size)
    w *= d/(w@size)
    m = np.array([-n[1], n[0]])
    along, across = r@n/size, r@m/size
    s = float((w*along)@np.sin(r@k))
    if nested:
        return continuum(gas, s, d)
    slow = 2*w/size*(1 - np.cos(r@k))
    A = gas.eta*(1/2 + 1/d) - gas.zeta/2
    B = (d + 2)/2*(gas.eta*(1 - 2/d) + gas.zeta)
    l, t = slow@(A + B*along**2), slow@(A + B*across**2)
    return waves(s, float(l), gas.kappa*float(slow.sum()), float(t))
