"""Does (dV)^(1/d) < r0 < lambda (RR98 Eq. 45) govern the error, and how?

Gradients and Laplacians of plane waves, a decaying Taylor-Green vortex and Rayleigh-Benard convection on lattices, jittered,
random and relaxed points: error over a/h and h/lambda, a the spacing, h the range of the weight (RR98's r0 is its rms width,
0.42 h for Lucy's), lambda the wavelength or the height; gradients as printed beside those by differences; and what 1 % costs.
Paper size takes three quarters of an hour of one core.
Writes results/ordering/*.csv and *.png and the rows of study ordering in results/claims.csv.
"""
from collections.abc import Iterator
from itertools import product

from particles.integral.edge_makers import MAKERS
from particles.weights import WEIGHTS, Lucy, Monaghan, WendlandC2
from studies.kit.case import Case
from studies.kit.study import Part
from studies.kit.table import Tables
from studies.ordering import brackets as ordering_brackets
from studies.ordering import brackets_claims as ordering_brackets_claims
from studies.ordering import claims as ordering_claims
from studies.ordering import convection_claims as ordering_convection_claims
from studies.ordering import creep as ordering_creep
from studies.ordering import derive as ordering_derive
from studies.ordering import figures as ordering_figures
from studies.ordering import flows as ordering_flows
from studies.ordering import flows_claims as ordering_flows_claims
from studies.ordering import tables
from studies.ordering.convection import between_images, convection, images, irregular_layers, on_lattice
from studies.ordering.vortices import Compression, TaylorGreen
from studies.ordering.waves import DISORDERS, OperatorErrors

H = (1.2, 1.5, 2.0, 2.5, 3.0, 4.0, 6.0)
#: on a lattice, where each has a factor of its own: between these, to have a range every half spacing
BETWEEN = (3.5, 4.5, 5.0, 5.5)
SEEDS = (1, 2, 3)
#: of the flows
RANGES = (1.2, 1.5, 2.0, 2.5, 3.0, 4.0)
IRREGULAR = ("jittered-0.3", "random", "relaxed")
#: rows of convection between points on the plates, until the error of K is 1 %
PLATES = {"jittered-0.3": (12, 16, 24, 32, 40, 50), "random": (12, 16, 24, 32, 40, 50), "relaxed": (12, 16, 24, 32, 40)}


def wave(maker: str, weight, h: float, disorder: str, wavelength: int) -> Iterator[OperatorErrors]:
    """One point of the surface; points with disorder have seeds."""
    for seed in SEEDS if disorder != "lattice" else SEEDS[:1]:
        yield OperatorErrors(maker=maker, make=MAKERS[maker], weight=weight, h=h, disorder=DISORDERS[disorder],
                             wavelength=wavelength, seed=seed)


def cases(size: str) -> list[Case]:
    """`quick` has few wavelengths and kinds of points; relaxing takes the longer the more points there are."""
    if size == "quick":
        return [*surface((16, 32), ["lattice", "jittered-0.3"]), *ordering_brackets.brackets((1.2, 3.0), (1,), ("jittered-0.3",)),
                *quick_flows()]
    loose = [name for name in DISORDERS if name != "relaxed"]
    return [*surface((16, 24, 32, 48, 64, 96), loose), *surface((16, 20, 24, 32), ["relaxed"]),
            *ordering_brackets.brackets(H, SEEDS), *vortices(), *layers((12, 16, 24, 32), RANGES),
            *irregular_layers(PLATES, SEEDS), *images((16, 24, 32), SEEDS), *ordering_creep.creeps(16, (2, 3, 4))]


def surface(wavelengths: tuple[int, ...], disorders: list[str]) -> Iterator[Case]:
    """Lucy's weight everywhere; other weights, all of them on a lattice, and all makers of edges at two ranges."""
    for disorder, wavelength in product(disorders, wavelengths):
        for h in (*H, *BETWEEN) if disorder == "lattice" else H:
            yield from wave("renormalised", Lucy, h, disorder, wavelength)
        for maker, h in product(("plain", "printed", "closed", "exact"), (2.0, 3.0)):
            if maker != "exact" or h == 3.0:
                yield from wave(maker, Lucy, h, disorder, wavelength)
        if wavelength == 32:
            yield from wave("plain", Lucy, 1.2, disorder, wavelength)       # where Eq. 45 does not hold
        for weight in WEIGHTS.values() if disorder == "lattice" else (Monaghan, WendlandC2):
            yield from wave("renormalised", weight, 3.0, disorder, wavelength)
        yield from wave("delaunay", Lucy, 2.0, disorder, wavelength)


def vortex(maker: str, h: float, disorder: str, wavelengths: tuple[int, ...], weight=Lucy, **more) -> Iterator[TaylorGreen]:
    """Vortices of one kind; without a weight where h = 0."""
    for wavelength, seed in product(wavelengths, SEEDS if disorder != "lattice" else SEEDS[:1]):
        yield TaylorGreen(maker=maker, make=MAKERS[maker], weight=weight if h else None, h=h, disorder=DISORDERS[disorder],
                          wavelength=wavelength, seed=seed, **more)


def vortices() -> Iterator[Case]:
    """On a lattice renormalised, closed and exact edges are the same. Exact ones take long to find, relaxed points to relax."""
    yield from (Compression(mach=mach) for mach in (0.02, 0.05, 0.1, 0.2))
    for h in (*RANGES, 6.0):
        yield from vortex("renormalised", h, "lattice", (16, 24, 32, 48, 64))
    for disorder in IRREGULAR:
        sizes = (16, 24, 32) if disorder == "relaxed" else (16, 24, 32, 48)
        yield from vortex("delaunay", 0.0, disorder, (16, 24, 32, 48) if disorder == "relaxed" else (16, 24, 32, 48, 64))
        for maker, h in (*product(("renormalised", "closed"), (2.0, 3.0, 4.0)), ("plain", 3.0)):
            yield from vortex(maker, h, disorder, sizes)
        yield from vortex("exact", 3.0, disorder, (16, 24, 32, 48) if disorder == "jittered-0.3" else (16, 24, 32))
        yield from vortex("exact", 4.0, disorder, (16, 24, 32))
    yield from vortex("plain", 3.0, "relaxed", (16, 24, 32), WendlandC2)      # the weight that these points are relaxed with
    for mach, maker in product((0.02, 0.1), ("delaunay", "closed", "renormalised")):
        yield from vortex(maker, 3.0*(maker != "delaunay"), "jittered-0.3", (32,), mach=mach)


def layers(rows: tuple[int, ...], ranges: tuple[float, ...]) -> Iterator[Case]:
    """Rayleigh-Benard on a lattice."""
    yield from (convection("lattice", on_lattice(h), n) for n, h in product(rows, ranges))


def quick_flows() -> Iterator[Case]:
    """A few small ones of each."""
    yield Compression(mach=0.2)
    for h in (1.2, 2.0, 3.0):
        yield from vortex("renormalised", h, "lattice", (8, 12, 16))
    for maker, h in (("delaunay", 0.0), ("closed", 2.0), ("renormalised", 2.0)):
        yield from vortex(maker, h, "jittered-0.3", (8, 12, 16))
    yield from layers((8, 12), (2.0,))
    yield from ordering_creep.creeps(8, (1,), (8e-3,))
    for maker, h in (("closed", 2.0), ("exact", 3.0)):
        yield from (convection("jittered-0.3", between_images("jittered-0.3", maker, h), n) for n in (8, 12))


def derive(tables: Tables) -> dict[str, list]:
    """Derived rows of the study."""
    parts = (ordering_derive, ordering_brackets, ordering_flows, ordering_creep)
    return {name: rows for part in parts for name, rows in part.derive(tables).items()}


PART = Part(cases=cases, tables=tables.ALL, derive=derive, figures=ordering_figures.figures,
              claims=(*ordering_claims.CLAIMS, *ordering_brackets_claims.CLAIMS, *ordering_flows_claims.CLAIMS,
              *ordering_convection_claims.CLAIMS, *ordering_creep.CLAIMS))
