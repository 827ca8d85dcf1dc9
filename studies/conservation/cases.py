"""Does discretized integral hydrodynamics conserve mass, momentum and energy, and what else does it keep?    [RR98, Sec. III]

Sums over 10 000 steps from random starts, with a book of what is lost where it must be; rates in a wind; energy of linear sound
over 10 000 periods. All of RR98's modes, weights, makers of edges, sets of points and walls would be thousands of runs. There
are instead, on fixed points, all makers with all sets of points: with friction along edges for every weight, with any other
transport for one, and that transport on one set of points for every weight; between mirror plates, held rows and around a body
for one weight, and one set of points for every weight. So any two values of any two factors meet in some run, where they can.
Of moving points every motion has its runs, those that should keep sums with every weight and transport; the conservative scheme
has every weight, and every start in a box and between plates.

Where none can be: Delaunay edges have no weight; sliding sides take edges of a weight on a lattice; held points and sliding
sides are coded for friction along edges with the mended heating; moving points of Eqs 39-49 have edges of plain quadrature and
no walls. On a lattice closed and exact edges are the plain ones times a number. Boxes are small: 8 x 8 points, 10 x 10 with held
points, 6 x 6 that move by Eqs 39-49, 32 in 1D, 6 x 6 or 4^3 with bulk viscosity; between plates in 1D and 3D they have three
makers with one set of points each. Paper size takes about 15 minutes of one core. Writes results/conservation/*.csv and *.png and
the rows of study conservation in results/claims.csv.
"""
from collections.abc import Iterator
from itertools import product

from particles.integral.edge_makers import MAKERS
from particles.integral.rr98_moving_plain import MOTIONS
from particles.weights import WEIGHTS, Lucy
from studies.conservation import claims as conservation_claims
from studies.conservation import commutator as conservation_commutator
from studies.conservation import derive as conservation_derive
from studies.conservation import figures as conservation_figures
from studies.conservation import losses as conservation_losses
from studies.conservation import moving as conservation_moving
from studies.conservation import plates as conservation_plates
from studies.conservation import tables as conservation_tables
from studies.conservation.commutator import Commutator
from studies.conservation.dih import FORMS, DihDrift
from studies.conservation.drift import FILTERED, MODES, WALLS
from studies.conservation.frames import Frame, Sound
from studies.conservation.layers import LayerDrift
from studies.conservation.rates import KEEP, TRANSPORTS, MotionDrift
from studies.conservation.walls import HOLDS, HeldDrift, SlidingDrift
from studies.kit.case import Case
from studies.kit.study import Part
from studies.ordering.waves import DISORDERS

KINDS = ("lattice", "jittered-0.3", "random", "relaxed")
ALL = tuple(WEIGHTS.values())
SEEDS = (1, 2, 3)
CLOSING = ("closed", "exact", "delaunay")
OTHERS = tuple(name for name in MODES if name != "pairwise")
#: one maker on a lattice, one off it
TWO = (("renormalised", "lattice"), ("delaunay", "jittered-0.3"))


def pairs(kinds: tuple[str, ...]) -> list[tuple[str, str]]:
    """Makers and sets of points that go together."""
    return [(maker, points) for points, maker in product(kinds, MAKERS)
            if points != "lattice" or maker not in ("closed", "exact")]


def layer(mode: str, maker: str, points: str, wall: str = "periodic", weight=Lucy, **more) -> LayerDrift:
    """A run of the compiled scheme."""
    return LayerDrift(mode=MODES[mode], maker=maker, make=MAKERS[maker], weight=weight, h=3.0, disorder=DISORDERS[points],
                      wall=WALLS[wall], **more)


def layers(kinds: tuple[str, ...] = KINDS, weights: tuple[type, ...] = ALL, **more) -> Iterator[LayerDrift]:
    """Periodic boxes."""
    for maker, points in pairs(kinds):
        yield from (layer("pairwise", maker, points, weight=weight, **more)
                    for weight in (weights if maker != "delaunay" else weights[:1]))
        yield from (layer(mode, maker, points, **more) for mode in OTHERS)
    yield from (layer(mode, "exact", "jittered-0.3", weight=weight, **more) for mode, weight in product(OTHERS, weights[1:]))


def plates(kinds: tuple[str, ...] = KINDS, weights: tuple[type, ...] = ALL, **more) -> Iterator[LayerDrift]:
    """Between mirror images, which take momentum and heat where there is friction."""
    for mode in ("pairwise", "ideal"):
        yield from (layer(mode, maker, points, "plates", **more) for maker, points in pairs(kinds))
    yield from (layer(mode, maker, points, "plates", **more) for mode, (maker, points) in product(OTHERS[:-1], TWO))
    yield from (layer("ideal", "exact", "jittered-0.3", "plates", weight, **more) for weight in weights[1:])
    yield from (layer("ideal", maker, points, "plates, gravity", **more) for maker, points in TWO)


def hold(wall: str, maker: str, points: str, mode=MODES["pairwise"], weight=Lucy, **more) -> HeldDrift:
    """A run with held points."""
    return HeldDrift(mode=mode, maker=maker, make=MAKERS[maker], weight=weight, h=3.0, disorder=DISORDERS[points],
                     wall=HOLDS[wall], **more)


def walls(kinds: tuple[str, ...] = KINDS, weights: tuple[type, ...] = ALL, **more) -> Iterator[Case]:
    """Held rows and bodies, then sliding sides on a lattice."""
    for wall in ("rows", "body"):
        yield from (hold(wall, maker, points, **more) for maker, points in pairs(kinds))
        yield from (hold(wall, maker, points, mode, **more) for mode, (maker, points) in product((FILTERED, MODES["ideal"]), TWO))
        yield from (hold(wall, "exact", "jittered-0.3", weight=weight, **more) for weight in weights[1:])
    yield from (hold("sliding rows", "renormalised", "lattice", weight=weight, **more) for weight in weights)
    yield from (hold("rows on plates", "delaunay", points, **more) for points in kinds)
    for mode, maker, weight in (*product(("pairwise",), ("printed", "plain"), weights[:1]),
                                *product(("pairwise", "ideal"), ("renormalised",), weights)):
        yield SlidingDrift(mode=MODES[mode], maker=maker, make=MAKERS[maker], weight=weight, h=3.0,
                           disorder=DISORDERS["lattice"], **more)


def dih(form: str, d: int, maker: str, h: float, points: str = "jittered-0.1", weight=Lucy, **more) -> DihDrift:
    """A run of the scheme in d dimensions, with bulk viscosity."""
    return DihDrift(form=FORMS[form], d=d, maker=maker, make=MAKERS[maker], weight=weight, h=h, disorder=DISORDERS[points],
                    zeta=0.05, **more)


def dimensions(**more) -> Iterator[DihDrift]:
    """Bulk viscosity, Eq. 37 as printed, one and three dimensions; a pressure that is not symmetric in ij."""
    yield from (dih(form, 1, "exact", 3.0, **more) for form in ("pairwise", "nested", "printed", "one-sided"))
    yield dih("printed", 2, "exact", 2.8, **more)
    yield dih("pairwise", 3, "exact", 1.9, **more)


def motions(weights: tuple[type, ...] = ALL, **more) -> Iterator[MotionDrift]:
    """Every motion, from jittered points and from a lattice; those that should keep sums with every weight and transport."""
    for name, kind in MOTIONS.items():
        same = {"motion": name, "kind": kind, **more}
        yield from (MotionDrift(**same, transport="unmended", weight=Lucy, jitter=jitter) for jitter in (0.0, 0.1))
        if name in KEEP:
            yield from (MotionDrift(**same, transport=transport, weight=Lucy) for transport in TRANSPORTS)
            yield from (MotionDrift(**same, transport="unmended", weight=weight) for weight in weights)


def frames(seeds: tuple[int, ...] = SEEDS) -> Iterator[Case]:
    """Rates in a wind, and sound, on sets of points that differ."""
    for maker, points in product(MAKERS, KINDS[:3]):
        for seed in seeds if points != "lattice" else seeds[:1]:
            yield from (Frame(mode=mode, maker=maker, make=MAKERS[maker], disorder=DISORDERS[points], seed=seed)
                        for mode in ("pairwise", "everywhere", "unmended", "nested", "printed"))
            if maker in CLOSING:
                yield Commutator(maker=maker, make=MAKERS[maker], disorder=DISORDERS[points], seed=seed)
    for maker, points, bracket in product(MAKERS, KINDS, ("plus", "adjoint")):
        for seed in seeds if points != "lattice" else seeds[:1]:
            yield Sound(bracket=bracket, maker=maker, make=MAKERS[maker], disorder=DISORDERS[points], seed=seed)


def cases(size: str) -> list[Case]:
    """`quick` has runs of 300 steps with one weight, no relaxed points and none that move by the conservative scheme."""
    if size == "quick":
        some = KINDS[:2], ALL[:1]
        return [*layers(*some, steps=300), *plates(*some, steps=300), *walls(*some, steps=300), *dimensions(steps=300),
                *conservation_plates.cases(steps=300), *motions(ALL[:1], steps=300),
                *conservation_losses.cases(SEEDS[:1], steps=300), *frames(SEEDS[:1])]
    return [*layers(), *plates(), *walls(), *dimensions(), *conservation_plates.cases(), *motions(),
            *conservation_moving.cases(KINDS), *conservation_losses.cases(), *frames()]


PART = Part(cases=cases, tables=(*conservation_tables.ALL, conservation_losses.LOSSES),
              derive=conservation_derive.derive, figures=conservation_figures.figures,
              claims=(*conservation_claims.CLAIMS, *conservation_commutator.CLAIMS, *conservation_losses.CLAIMS))
