"""Methods on moving points, in any scene: with their triangulation, over closed faces, by RR98's motions

    [RR98 Eqs 39, 46-51]
"""
from functools import partial
from typing import Any, NamedTuple

import numpy as np

from continuum.fluid import energy, pressure, viscosity
from continuum.scene import Torus, Walls
from particles.fields import kinetic
from particles.integral.bodies import Held, Rows, held, together
from particles.integral.closed_faces import FaceSums, Ingredients, Moving
from particles.integral.drifts import DRIFTS, ConstantMassDrift, OverPairs, Powers
from particles.integral.exchange import PRINTED
from particles.integral.moving_delaunay import SHIFT, MovingDelaunay, RingSums
from particles.integral.points import lattice
from particles.integral.rings import rings, spokes
from particles.integral.rr98_moving import Drift, Drifts, scale_of
from particles.integral.transposed_stress import MENDED
from particles.observe import pairs_behind
from particles.pairs import entries, pair_term, sweep
from particles.smooth.spam import LessStatic
from particles.weights import WendlandC2
from studies.build.fixed import between_sides, bodies_of, four_sides, on_plate
from studies.build.names import START_JITTER
from studies.build.setting import (
    Ready,
    check_points,
    in_scene,
    no_still_layer,
    placed,
    shifted,
    sticking,
    walls,
)


class FacesMotion(NamedTuple):
    """The scheme of closed faces with its ingredients; of_limit : time step over its limit."""
    name: str
    ingredients: Ingredients = Ingredients()
    weight: Any = WendlandC2
    h: float = 3.0
    of_limit: float = 1.0

    def refuses(self, scene: Any) -> str:
        return no_still_layer(scene)

    def ready(self, scene: Any, seed: int = 1, x: Any = None) -> Ready:
        check_points(self, scene)
        method = Moving(weight=self.weight.of(h=self.h), eos=scene.eos, law=scene.law, g=scene.g,
                        box=(scene.width, scene.L), walls=walls(scene), ingredients=self.ingredients)
        return placed(method, scene, seed, self.of_limit, x)

    @property
    def series(self) -> dict[str, Any]:
        return of_heat(heat_over_faces)


MOTIONS = {m.name: m for m in (
    FacesMotion("moving"),
    FacesMotion("moving-open-faces", Ingredients(iterations=0)),
    FacesMotion("moving-closer-faces", Ingredients(iterations=12)),
    FacesMotion("moving-no-shift", Ingredients(shift=0.0)),
    FacesMotion("moving-no-follow", Ingredients(follow=0.0)),
    FacesMotion("moving-no-spread", Ingredients(spread=0.0)),
    FacesMotion("moving-plain-spread", Ingredients(smooth=0.0)),
    FacesMotion("moving-whole-pressure", Ingredients(static=0.0)),
    FacesMotion("moving-printed-heat", Ingredients(transport=PRINTED)),
    FacesMotion("moving-half-step", of_limit=0.5),
)}


class DriftMotion(NamedTuple):
    """A motion of RR98. mended : friction heats like the stress. less : share of static pressure left out."""
    name: str
    motion: Any
    mended: bool = True
    less: float = 0.0
    weight: Any = WendlandC2
    h: float = 3.0

    def refuses(self, scene: Any) -> str:
        return no_still_layer(scene)

    def ready(self, scene: Any, seed: int = 1, x: Any = None) -> Ready:
        check_points(self, scene)
        weight = self.weight.of(h=self.h)
        method = Drift(motion=self.motion, weight=weight, scale=scale_of(lattice((12, 12)), weight),
                       eos=scene.eos, law=scene.law, box=(scene.width, scene.L), g=scene.g,
                       walls=walls(scene), transport=MENDED if self.mended else PRINTED,
                       static=LessStatic(self.less, scene.T_mean))
        return placed(method, scene, seed, 1.0, x)

    @property
    def series(self) -> dict[str, Any]:
        return of_heat(heat_of_pairs)


DRIFT_MOTIONS = {m.name: m for m in (
    DriftMotion("moving-literal", DRIFTS["literal"]),
    DriftMotion("moving-literal-printed-heat", DRIFTS["literal"], mended=False),
    DriftMotion("moving-convective", DRIFTS["convective"]),
    DriftMotion("moving-carried", DRIFTS["carried"]),
    DriftMotion("moving-constant-mass", DRIFTS["constant-mass"]),
    DriftMotion("moving-constant-mass-printed-heat", DRIFTS["constant-mass"], mended=False),
    DriftMotion("moving-sph", ConstantMassDrift(Powers(1.0, -1.0))),
    DriftMotion("moving-less-static", DRIFTS["constant-mass"], less=1.0),
)}


def of_heat(heat: Any) -> dict[str, Any]:
    """Series of a run: K, and heat per time into the fluid through both plates; heat : its function."""
    return {"ke": kinetic, "lower": partial(heat, side=-1), "upper": partial(heat, side=1)}


def heat_over_faces(sums: FaceSums, state: np.ndarray, side: int) -> float:
    """Heat per time that points get over faces from images behind a plate (-1: lower, 1: upper)."""
    faces, half = sums.maker.faces, sums.method.box[1]/2
    row, entry = entries(faces, np.flatnonzero(side*state[1] > half - sums.method.weight.h))
    image = faces.near[entry]
    behind = (image >= sums.n) & (side*sums.around.y[image] > half)
    a = sums.points[row[behind]]
    b, k = sums.points[image[behind]], faces.k[entry[behind]]
    return float(np.sum(k*(a["k"] + b["k"])/2*(b["Td"] - a["Td"])))


@pair_term(1)
def PairHeat(term, a, b, ab):
    """Pair term: heat per time that the first point gets from the second."""
    return (0.5*(a.k + b.k)*ab.k*(b.Td - a.Td),)


def heat_of_pairs(sums: Drifts, state: np.ndarray, side: int) -> float:
    """Heat per time that points get from images behind a plate (-1: lower, 1: upper)."""
    heat = np.zeros((sums.n, 1))
    sums.threads(sweep, sums.n, OverPairs(PairHeat()), sums.points, pairs_behind(sums, side), heat)
    return float(heat.sum())


class Carriage(NamedTuple):
    """Points that move with their triangulation. size : disorder of the points at the start, in spacings."""
    name: str
    shift: float = SHIFT
    size: float = START_JITTER
    of_limit: float = 0.9

    def refuses(self, scene: Any) -> str:
        return sticking(scene)

    def ready(self, scene: Any, seed: int = 1) -> Ready:
        check_points(self, scene)
        size, along = (scene.width, scene.L), scene.sides.axes
        closed = not along[0], not along[1]
        x, rows = between_sides(size, closed, shifted, self.size, seed)
        method = MovingDelaunay(x=x, rings=rings(x, size, closed), held=held_of(scene, x, rows),
                                eos=scene.eos, law=scene.law, g=scene.g, rides=closed != (True, True),
                                shift=self.shift)
        return in_scene(method, scene, self.of_limit)

    @property
    def series(self) -> dict[str, Any]:
        return {"ke": kinetic, "lower": partial(heat_in, plate=0), "upper": partial(heat_in, plate=1),
                "carried": heat_carried}


CARRIAGES = {one.name: one for one in (
    Carriage("moving-delaunay"),
    Carriage("moving-delaunay-half-step", of_limit=0.45),
    Carriage("moving-delaunay-quarter-step", of_limit=0.225),
)}


NONE_HELD = Held(np.empty(0, int), np.empty((0, 2)), np.empty(0), np.empty(0, int), np.empty(0))


def held_of(scene: Any, x: np.ndarray, rows: Rows) -> Held:
    """Held points on the sides: lower row, upper row, then others; none on a torus."""
    if isinstance(scene.sides, Torus):
        return NONE_HELD
    if not isinstance(scene.sides, Walls):
        return together(*bodies_of(four_sides(scene), rows))
    beside = np.concatenate([rows.left, rows.right, rows.corners])
    return together(held(rows.bottom, T=scene.T_hot), held(rows.top, T=scene.T_cold),
                    held(beside)._replace(T=scene.T(x[beside, 1])))


def heat_in(sums: RingSums, state: np.ndarray, plate: int) -> float:
    """Heat that enters the fluid through a plate (0: lower, 1: upper), per time."""
    return -float(sums.received[on_plate(sums.held, plate), 2].sum())


def heat_carried(sums: RingSums, state: np.ndarray) -> float:
    """Mean upward heat of the flow, (E/V + P) v_y - (tau v)_y, times the width; conduction comes besides."""
    at, (near, _, sx, sy) = sums.method.fields(state), spokes(sums.rings)
    step = at.v[near] - at.v[:, None]
    (xx, xy), (yx, yy) = ((S[:, :, None]*step).sum(axis=1).T for S in (sx, sy))        # V d_x v, V d_y v
    eta, (vx, vy) = viscosity(sums.method.law, at.rho, at.T), at.v.T
    P = pressure(sums.method.eos, at.rho, energy(sums.method.eos, at.rho, at.T))
    flux = (state[8] + P*at.V)*vy - eta*(vx*(xy + yx) + vy*(yy - xx))
    return float(flux.sum()/sums.rings.size[1])
