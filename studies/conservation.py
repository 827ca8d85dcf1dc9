"""Does discretized integral hydrodynamics conserve mass, momentum and energy, and what else does it keep?    [RR98, Sec. III]

Sums over 10 000 steps from random starts, for each transport, weight, maker of edges, set of points and wall; rates in a wind;
energy of linear sound over 10 000 periods. Boxes are small: 12 x 12 points in 2D (6 x 6 for Eq. 37 as printed), 32 in 1D,
4^3 in 3D. Paper size takes about three minutes. Writes results/conservation/*.csv and *.png and the rows of study conservation
in results/claims.csv.
"""
from collections.abc import Iterator
from importlib.util import find_spec
from itertools import product

from particles.makers import MAKERS
from particles.weights import Lucy, Monaghan, WendlandC2
from studies.integral import (
    conservation_claims,
    conservation_commutator,
    conservation_derive,
    conservation_figures,
    conservation_tables,
)
from studies.integral.conservation_commutator import Commutator
from studies.integral.conservation_dih import FORMS, DihDrift
from studies.integral.conservation_frames import Frame, Sound
from studies.integral.conservation_layers import MODES, WALLS, LayerDrift
from studies.integral.operators import DISORDERS
from studies.kit.case import Case
from studies.kit.study import Study, main

KINDS = ("lattice", "jittered-0.3", "random", "relaxed")
#: edges on each kind of points: on a lattice closed and exact ones are the plain ones times a number
EDGES = {"lattice": ("printed", "plain", "delaunay"), "jittered-0.3": tuple(MAKERS),
         "random": ("plain", "closed", "exact", "delaunay"), "relaxed": ("plain", "closed", "delaunay")}
SEEDS = (1, 2, 3)
CLOSING = ("closed", "exact", "delaunay")


def layer(mode: str, maker: str, points: str, wall: str = "periodic", weight=Lucy, **more) -> LayerDrift:
    """A run of the compiled scheme."""
    return LayerDrift(mode=MODES[mode], maker=maker, make=MAKERS[maker], weight=weight, h=3.0, disorder=DISORDERS[points],
                      wall=WALLS[wall], **more)


def layers(kinds: tuple[str, ...] = KINDS, **more) -> Iterator[LayerDrift]:
    """Edges on all points with forces along edges, other transports and weights on some, then plates."""
    yield from (layer("pairwise", maker, points, **more) for points in kinds for maker in EDGES[points])
    nested = [("renormalised", "lattice"), ("delaunay", "random"), *product(("renormalised", *CLOSING), ["jittered-0.3"])]
    yield from (layer("nested", maker, points, **more) for maker, points in nested)
    yield from (layer("unmended", maker, "jittered-0.3", **more) for maker in ("exact", "delaunay"))
    ideal = [("renormalised", "lattice"), *product(("renormalised", *CLOSING), ["jittered-0.3"])]
    yield from (layer("ideal", maker, points, **more) for maker, points in ideal)
    yield from (layer("pairwise", "exact", "jittered-0.3", weight=weight, **more) for weight in (Monaghan, WendlandC2))
    for mode, wall in (("pairwise", "plates"), ("ideal", "plates"), ("ideal", "plates, gravity")):
        yield layer(mode, "renormalised", "lattice", wall, **more)
        yield layer(mode, "delaunay", "jittered-0.3", wall, **more)


def dih(form: str, d: int, maker: str, h: float, points: str = "jittered-0.1", **more) -> DihDrift:
    """A run of the scheme in d dimensions, with bulk viscosity."""
    return DihDrift(form=FORMS[form], d=d, maker=maker, make=MAKERS[maker], weight=Lucy, h=h, disorder=DISORDERS[points],
                    zeta=0.05, **more)


def dimensions(**more) -> Iterator[DihDrift]:
    """Bulk viscosity, Eq. 37 as printed, one and three dimensions; a pressure that is not symmetric in ij."""
    yield from (dih(form, 1, "exact", 3.0, **more) for form in ("pairwise", "printed", "one-sided"))
    yield dih("printed", 2, "exact", 2.8, **more)
    yield dih("pairwise", 3, "exact", 1.9, **more)


def moving() -> Iterator[Case]:
    """The conservative scheme on moving points, where it is installed."""
    if find_spec("particles.methods.moving"):
        from studies.integral.conservation_moving import CASES
        yield from CASES


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
    """`quick` has runs of 300 steps, no relaxed points and no points that move."""
    if size == "quick":
        return [*layers(KINDS[:2], steps=300), *dimensions(steps=300), *frames(SEEDS[:1])]
    return [*layers(), *dimensions(), *moving(), *frames()]


STUDY = Study(name="conservation", cases=cases, tables=conservation_tables.ALL, derive=conservation_derive.derive,
              figures=conservation_figures.figures, claims=(*conservation_claims.CLAIMS, *conservation_commutator.CLAIMS))

if __name__ == "__main__":
    main(STUDY)
