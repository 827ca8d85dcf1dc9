"""Which runs there are.

Sums over 10 000 steps; rates in a wind; energy of linear sound over 10 000 periods; patterns and sound on
points that move, time steps; drags, torques, shear. Not all of RR98's modes, weights, makers of edges, sets
of points and walls are combined. On fixed points in periodic boxes all makers meet all sets of points, with
friction along edges for every weight; any other transport has one weight, and on one set of points every
weight; so do mirror plates, held rows and bodies. Any two values of two factors meet in some run, where they
can: Delaunay edges have no weight, sliding sides take edges of a weight on a lattice, on which closed and
exact edges are the plain ones times a number. Paper size takes about 15 minutes of one core.
"""
from collections.abc import Iterator
from itertools import product

from particles.integral.closed_faces import Ingredients
from particles.integral.edge_makers import MAKERS
from particles.integral.exchange import PRINTED
from particles.weights import WEIGHTS, Lucy
from studies.build.disorder import DISORDERS
from studies.conservation.bodies import bodies
from studies.conservation.claims import CLAIMS
from studies.conservation.derive import derive
from studies.conservation.dimensions import dimensions, unsymmetric
from studies.conservation.drift import FILTERED, MODES, WALLS, LayerDrift, MovingDrift
from studies.conservation.figures import figures
from studies.conservation.frames import KINDS, frames
from studies.conservation.motions import motions
from studies.conservation.tables import ALL
from studies.conservation.walls import HOLDS, HeldDrift, SlidingDrift
from studies.conservation.waves import waves
from studies.kit.case import Case
from studies.kit.part import Part

WEIGHT_KINDS = tuple(WEIGHTS.values())
OTHERS = tuple(name for name in MODES if name != "pairwise")
#: one maker on a lattice, one off it
TWO = (("renormalised", "lattice"), ("delaunay", "jittered-0.3"))
#: what is left out of the scheme of moving points
LESS = {"heating as printed": Ingredients(transport=PRINTED), "open faces": Ingredients(iterations=0),
        "whole pressure": Ingredients(static=False), "mass not spread": Ingredients(spread=0.0)}


def pairs(kinds: tuple[str, ...]) -> list[tuple[str, str]]:
    """Makers and sets of points that go together."""
    return [(maker, points) for points, maker in product(kinds, MAKERS)
            if points != "lattice" or maker not in ("closed", "exact")]


def layer(mode: str, maker: str, points: str, wall: str = "periodic", weight=Lucy, **more) -> LayerDrift:
    """A run of the compiled scheme."""
    return LayerDrift(mode=MODES[mode], maker=maker, make=MAKERS[maker], weight=weight, h=3.0,
                      disorder=DISORDERS[points], wall=WALLS[wall], **more)


def layers(kinds: tuple[str, ...], weights: tuple[type, ...], **more) -> Iterator[LayerDrift]:
    """Periodic boxes."""
    for maker, points in pairs(kinds):
        some = weights if maker != "delaunay" else weights[:1]
        yield from (layer("pairwise", maker, points, weight=weight, **more) for weight in some)
        yield from (layer(mode, maker, points, **more) for mode in OTHERS)
    for mode, weight in product(OTHERS, weights[1:]):
        yield layer(mode, "exact", "jittered-0.3", weight=weight, **more)


def plates(kinds: tuple[str, ...], weights: tuple[type, ...], **more) -> Iterator[LayerDrift]:
    """Between mirror images, which take momentum and heat where there is friction."""
    for mode, (maker, points) in product(("pairwise", "ideal"), pairs(kinds)):
        yield layer(mode, maker, points, "plates", **more)
    for maker, points in TWO:
        yield from (layer(mode, maker, points, "plates", **more) for mode in OTHERS[:-1])
        yield layer("ideal", maker, points, "plates, gravity", **more)
    for weight in weights[1:]:
        yield layer("ideal", "exact", "jittered-0.3", "plates", weight, **more)


def hold(wall: str, maker: str, points: str, mode=MODES["pairwise"], weight=Lucy, **more) -> HeldDrift:
    """A run with held points."""
    return HeldDrift(mode=mode, maker=maker, make=MAKERS[maker], weight=weight, h=3.0,
                     disorder=DISORDERS[points], wall=HOLDS[wall], **more)


def walls(kinds: tuple[str, ...], weights: tuple[type, ...], **more) -> Iterator[Case]:
    """Held rows and bodies, then sliding sides on a lattice."""
    for wall in ("rows", "body"):
        yield from (hold(wall, maker, points, **more) for maker, points in pairs(kinds))
        for mode, (maker, points) in product((FILTERED, MODES["ideal"]), TWO):
            yield hold(wall, maker, points, mode, **more)
        yield from (hold(wall, "exact", "jittered-0.3", weight=weight, **more) for weight in weights[1:])
    yield from (hold("sliding rows", "renormalised", "lattice", weight=weight, **more) for weight in weights)
    yield from (hold("rows on plates", "delaunay", points, **more) for points in kinds)
    yield from (sliding("pairwise", maker, Lucy, **more) for maker in ("printed", "plain"))
    for name, weight in product(("pairwise", "ideal"), weights):
        yield sliding(name, "renormalised", weight, **more)


def sliding(mode: str, maker: str, weight: type, **more) -> SlidingDrift:
    """A run between sliding sides."""
    return SlidingDrift(mode=MODES[mode], maker=maker, make=MAKERS[maker], weight=weight, h=3.0,
                        disorder=DISORDERS["lattice"], **more)


def moving() -> Iterator[MovingDrift]:
    """Every start in a box and between plates, then every weight, then without an ingredient."""
    for kind, wall in product(KINDS, ("periodic", "plates")):
        yield MovingDrift(disorder=DISORDERS[kind], wall=WALLS[wall])
    yield from (MovingDrift(weight=weight) for weight in WEIGHT_KINDS)
    yield from (MovingDrift(name=name, ingredients=ingredients) for name, ingredients in LESS.items())


def cases(size: str) -> list[Case]:
    """`quick` has short runs with one weight, no relaxed points and none that move over closed faces."""
    if size == "quick":
        some, steps = (KINDS[:2], WEIGHT_KINDS[:1]), 300
        return [*layers(*some, steps=steps), *plates(*some, steps=steps), *walls(*some, steps=steps),
                *dimensions(steps=steps), *unsymmetric(2, steps=steps), *frames((1,)),
                *motions(40, WEIGHT_KINDS[:1]), *waves(size), *bodies(size)]
    whole = KINDS, WEIGHT_KINDS
    return [*layers(*whole), *plates(*whole), *walls(*whole), *dimensions(), *unsymmetric(), *moving(),
            *frames((1, 2, 3)), *motions(), *waves(size), *bodies(size)]


PART = Part(cases=cases, tables=ALL, derive=derive, figures=figures, claims=CLAIMS)
