"""Set up a method in a scene: code that all families of methods share.

A scene has `width, L` (in spacings), `sides` (`Periodic`, `Walls`, `Torus`), the plates' `T_hot, T_cold`, the
velocity `slide` of the upper one, gravity `g`, the fluid `eos, law`, and `fields(x) -> rho, v, T`, its start.
"""
from collections.abc import Callable
from functools import cache
from math import inf, isclose, nan
from typing import Any, NamedTuple

import numpy as np

from continuum.fluid import conductivity
from continuum.scene import Periodic, Torus, Walls
from continuum.sides import Plate, Sides, Sliding, Slip, warm
from particles.integral.points import Points, jittered, lattice, random, relaxed, wrapped
from particles.limits import limit_of
from particles.walls.mirror import AtWall, Mirror, plates, sides
from particles.walls.periodic import periodic
from particles.weights import WendlandC2
from studies.build.names import START_JITTER

FROM_EDGE = 0.25        # spacings: least distance of jittered points from a plate with images
BREADTH = 16        # spacings across a wave
APART = 0.5         # least distance of random points, in spacings
STEP = 1e-3     # in fields of order 1: errors are STEP^4 = 1e-12 of fifth derivatives, round-off 1e-13
HALVINGS = 8            # of the factor 2 between a stable and an unstable step: to 0.3 %
WIDENINGS = 6           # factors of 2 on either side before the search gives up


class Ready(NamedTuple):
    """A method, its start state (rows, n) and a suitable time step, for `particles.run`."""
    method: Any
    start: np.ndarray
    dt: float

    @property
    def limit(self) -> float:
        """The longest stable step from the start."""
        return limit_of(self.method, self.start)


def stepped(method: Any, start: np.ndarray, of_limit: float) -> Ready:
    """A method and its start with a time step that is a fraction of the stability limit."""
    return Ready(method, start, of_limit*limit_of(method, start))


def of_method(method: Any, scene: Any, seed: int = 1) -> Ready:
    """Any method in a scene: with points `x` and `state(rho, v, T)`, or with `state(x, rho, v, T)`."""
    if not hasattr(method, "x"):
        return placed(method, scene, seed, 0.8)
    check_places(method.x, scene)
    return in_scene(method, scene, 0.8)


def in_scene(method: Any, scene: Any, of_limit: float) -> Ready:
    """A method that has places `x`, with the scene's fields there."""
    return stepped(method, method.state(*scene.fields(method.x)), of_limit)


def placed(method: Any, scene: Any, seed: int, of_limit: float, x: Any = None) -> Ready:
    """A method on points that start at x (n, 2); by default a jittered lattice."""
    x = shaken(scene, seed) if x is None else x
    return stepped(method, method.state(x, *scene.fields(x)), of_limit)


def check_places(x: np.ndarray, scene: Any) -> None:
    """Check that points x (n, 2) were made for the box of the scene. Raises ValueError."""
    box, reach = np.array([scene.width, scene.L]), 2*np.abs(x).max(axis=0)
    if (reach > box*(1 + 1e-9)).any() or (reach < box - 3).any():
        raise ValueError(f"points of the method reach {reach[0]:g} x {reach[1]:g}, the scene is {box[0]:g} x "
                         f"{box[1]:g}: make the method for this scene, or give a class or function of the "
                         "scene, which compare calls for each number of rows")


def walls(scene: Any, rule: Any = AtWall(), own_pressure: bool = False) -> tuple:  # noqa: B008
    """Walls of a scene: images behind plates, periodic sides or images there; a torus is all periodic."""
    if isinstance(scene.sides, Sides):
        return of_sides(scene, rule, own_pressure)
    if isinstance(scene.sides, Torus):
        return (*periodic(scene.width), *periodic(scene.L, axis=1))
    lower, upper = plates(scene.L, scene.T_hot, scene.T_cold, rule, own_pressure)
    upper = upper._replace(v=scene.slide) if scene.slide else upper
    if isinstance(scene.sides, Periodic):
        return lower, upper, *periodic(scene.width)
    return lower, upper, *sides(scene.width, scene.T_mean, -scene.dT/scene.L, rule, own_pressure)


def of_sides(scene: Any, rule: Any, own_pressure: bool) -> tuple:
    """Walls of a scene with four sides: periodic ones, and mirror images by the kind of each side."""
    left, right, bottom, top = scene.sides
    k = float(conductivity(scene.law, 1.0, scene.T_mean))
    made: list[Any] = []
    for axis, pair, length in ((1, (bottom, top), scene.L), (0, (left, right), scene.width)):
        if isinstance(pair[0], Periodic):
            made += periodic(length, axis)
            continue
        for side, inner in zip(pair, (1.0, -1.0)):
            q = nan if warm(side) else side.q
            made.append(Mirror(axis, -inner*length/2, inner, side.T, 0.0, rule, own_pressure,
                               getattr(side, "v", 0.0), isinstance(side, Slip), q, k))
    return tuple(made)


def shifted(width: float, height: float, size: float, seed: int) -> np.ndarray:
    """A jittered lattice (n, 2) of unit spacing in a periodic box: coordinates shifted by up to `size`."""
    x = lattice((round(width), round(height))).x
    return wrapped(x + np.random.default_rng(seed).uniform(-size, size, x.shape), np.array([width, height]))


def inside(height: float, x: np.ndarray, axis: int = 1) -> np.ndarray:
    """Points (n, 2), moved inwards where nearer than FROM_EDGE to the ends of a `height` along an axis."""
    moved = x.copy()
    moved[:, axis] = np.clip(x[:, axis], -height/2 + FROM_EDGE, height/2 - FROM_EDGE)
    return moved


def positions(width: float, height: float, size: float, seed: int) -> np.ndarray:
    """A jittered lattice (n, 2) between plates: no point is nearer to one than FROM_EDGE."""
    return inside(height, shifted(width, height, size, seed))


def shaken(scene: Any, seed: int) -> np.ndarray:
    """Start positions (n, 2) of moving points: a jittered lattice."""
    place = shifted if isinstance(scene.sides, Torus) else positions
    return place(scene.width, scene.L, START_JITTER, seed)


def check_spacings(scene: Any) -> None:
    """Check that whole rows and columns of unit spacing fill the box. Raises ValueError: they do not."""
    for name, length in (("height L", scene.L), ("width aspect L", scene.width)):
        if not isclose(length, max(1, round(length)), rel_tol=1e-9):
            raise ValueError(f"points of unit spacing need whole rows and columns, got {name} = "
                             f"{length:.6g}: give L as the number of rows, aspect as columns over rows")


class CannotTake(ValueError):
    """Names the part of a scene that a method cannot take; `studies.build.ready` adds which methods can."""


def check_taken(chosen: Any, scene: Any) -> None:
    """Check that a variant can take a scene. Raises CannotTake with the part that it cannot take."""
    if part := chosen.refuses(scene):
        raise CannotTake(part)


def check_points(chosen: Any, scene: Any) -> None:
    """`check_taken` for points of unit spacing, which must fill the box. Raises ValueError: they do not."""
    check_taken(chosen, scene)
    check_spacings(scene)


def no_layer(scene: Any) -> str:
    """The part of a scene that a method cannot take if it knows only plates of given temperatures above and
    below, or a torus; empty if none."""
    if isinstance(scene.sides, Walls):
        return f"sides = {scene.sides}"
    if not isinstance(scene.sides, Sides):
        return ""
    left, _, bottom, _ = scene.sides
    odd = {"left": not isinstance(left, Periodic), "bottom": not (isinstance(bottom, Plate) and warm(bottom))}
    return part(scene, next((name for name, is_odd in odd.items() if is_odd), "top"))


def no_still_layer(scene: Any) -> str:
    """`no_layer` of a method whose plates cannot slide, either."""
    return no_layer(scene) or (f"slide = {scene.slide}" if scene.slide else "")


def sticking(scene: Any) -> str:
    """The part of a scene that rows of points on sides cannot take: slip, or a sliding side of a closed box.

    All neighbours of a corner point may be held: nothing takes away what a sliding one brings, so that the
    density grows by a factor e per spacing of sliding. Without this a chessboard mode still grows there.
    """
    if not isinstance(scene.sides, Sides):
        return ""
    odd = Slip if any(scene.sides.axes) else (Slip, Sliding)
    names = [name for name, side in scene.sides._asdict().items() if isinstance(side, odd)]
    return part(scene, names[0]) if names else ""


def part(scene: Any, name: str) -> str:
    """A side of the scene as text, "name = value"."""
    return f"{name} = {getattr(scene.sides, name)}"


class Disorder(NamedTuple):
    """A kind of periodic point set; `size`: jitter, or the least distance of random points, in spacings."""
    name: str
    make: Callable[[tuple[int, ...], float, int], Points]
    size: float = 0.0


def on_lattice(counts: tuple[int, ...], size: float, seed: int) -> Points:
    """The square lattice, whatever the seed."""
    return lattice(counts)


@cache
def relaxed_random(counts: tuple[int, ...], apart: float, seed: int) -> Points:
    """Random points, relaxed until a|c| < 2e-3."""
    return relaxed(random(counts, apart, seed), WendlandC2.of(h=3.0), until=2e-3, sweeps=4000)


DISORDERS = {d.name: d for d in (
    Disorder("lattice", on_lattice),
    Disorder("jittered-0.1", jittered, 0.1),
    Disorder("jittered-0.3", jittered, 0.3),
    Disorder("random", random, APART),
    Disorder("relaxed", relaxed_random, APART))}


# --- the largest stable step by trial -----------------------------------------------------------------------


class Unguarded:
    """A method whose time step is not checked against its limit."""

    def __init__(self, method: Any):
        self.method = method

    def __getattr__(self, name: str) -> Any:
        return getattr(self.method, name)


@limit_of.register
def _(method: Unguarded, start: np.ndarray) -> float:
    return inf


def bisected(grows: Callable[[float], bool], first: float) -> tuple[float, float]:
    """The step above which `grows` is true, and the half width of its interval; nan if none was found.

    From `first` by factors of 2, then by bisecting the logarithm.
    """
    low, high = bracket(grows, first)
    for _ in range(HALVINGS if low < high else 0):
        middle = float(np.sqrt(low*high))
        low, high = (low, middle) if grows(middle) else (middle, high)
    return (low + high)/2, (high - low)/2


def bracket(grows: Callable[[float], bool], first: float) -> tuple[float, float]:
    """Two steps a factor of 2 apart, `grows` false at the first and true at the second; nan if not found."""
    step, bad = first, grows(first)
    for _ in range(WIDENINGS):
        other = step/2 if bad else 2*step
        if grows(other) != bad:
            return (other, step) if bad else (step, other)
        step = other
    return np.nan, np.nan


# --- derivatives of rates -----------------------------------------------------------------------------------


def jacobian(rates: Callable[[np.ndarray, np.ndarray], None], state: np.ndarray,
             points: Any = slice(None)) -> np.ndarray:
    """d rates/d state at a state (fields, n) by differences of fourth order, (size, columns), with columns of
    `points` only. rates(state, out) writes the rates to `out`."""
    numbers = np.arange(state.size).reshape(state.shape)[:, points].ravel()
    J, out = np.zeros((state.size, len(numbers))), np.empty(state.shape)
    for column, number in enumerate(numbers):
        for shift, weight in ((-2, 1/12), (-1, -8/12), (1, 8/12), (2, -1/12)):
            moved = state.copy()
            moved.ravel()[number] += shift*STEP
            rates(moved, out)
            J[:, column] += weight*out.ravel()/STEP
    return J
