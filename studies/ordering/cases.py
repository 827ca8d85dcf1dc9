"""Which waves, vortices and layers the study ordering runs, by size.

Gradients and Laplacians of plane waves, a decaying Taylor-Green vortex and Rayleigh-Benard convection on lattices,
jittered, random and relaxed points: error over a/h and h/lambda, a the spacing, h the range of the weight (RR98's r0 is
its rms width, 0.42 h for Lucy's), lambda the wavelength or the height; gradients as printed beside those by differences.
Paper size takes 40 minutes of one core.
"""
from collections.abc import Iterator, Mapping
from itertools import product
from typing import Any

from particles.integral.edge_makers import MAKERS
from particles.weights import WEIGHTS, Lucy, Monaghan, WendlandC2
from studies.build.disorder import DISORDERS
from studies.kit.case import Case
from studies.ordering.convection import between_images, convection, images, irregular_layers, on_lattice
from studies.ordering.gradients import Brackets, OperatorErrors
from studies.ordering.vortices import TaylorGreen

H = (1.2, 1.5, 2.0, 2.5, 3.0, 4.0, 6.0)
#: on a lattice, where each has a factor of its own: between these, to have a range every half spacing
BETWEEN = (3.5, 4.5, 5.0, 5.5)
SEEDS = (1, 2, 3)
#: of the flows
RANGES = (1.2, 1.5, 2.0, 2.5, 3.0, 4.0)
IRREGULAR = ("jittered-0.3", "random", "relaxed")
#: rows of convection between points on the plates, until the error of K is 1 %
PLATES = {"jittered-0.3": (12, 16, 24, 32, 40, 50), "random": (12, 16, 24, 32, 40, 50),
          "relaxed": (12, 16, 24, 32, 40)}
#: wavelengths; more points take longer to relax
WAVES = dict.fromkeys(DISORDERS, (16, 24, 32, 48, 64, 96)) | {"relaxed": (16, 20, 24, 32)}
WAVE = 32           # at which ranges and makers are compared


def cases(size: str) -> list[Case]:
    """`quick` has few wavelengths and kinds of points."""
    if size == "quick":
        waves = {"lattice": (16, 32), "jittered-0.3": (16, 32)}
        return [*surface(waves), *brackets((1.2, 3.0), ("jittered-0.3",), (1,)), *quick_flows()]
    layers = (convection("lattice", on_lattice(h), rows) for rows, h in product((12, 16, 24, 32), RANGES))
    kinds = ("lattice", "jittered-0.3", "random", "relaxed")
    return [*surface(WAVES), *brackets(H, kinds, SEEDS), *vortices(), *layers,
            *irregular_layers(PLATES, SEEDS), *images((16, 24, 32), SEEDS)]


def seeds(disorder: str) -> tuple[int, ...]:
    """Points with disorder have several."""
    return SEEDS if disorder != "lattice" else SEEDS[:1]


def surface(waves: Mapping[str, tuple[int, ...]]) -> Iterator[Case]:
    """Lucy's weight everywhere; other weights, all of them on a lattice, and all makers of edges at two ranges."""
    for disorder, wavelengths in waves.items():
        for wavelength, (maker, weight, h) in product(wavelengths, edges(disorder)):
            yield from wave(maker, weight, h, disorder, wavelength)
        if WAVE in wavelengths:
            yield from wave("plain", Lucy, 1.2, disorder, WAVE)     # where Eq. 45 does not hold


def edges(disorder: str) -> Iterator[tuple[str, Any, float]]:
    """(maker, weight, range) on a kind of points."""
    even = disorder == "lattice"
    yield from (("renormalised", Lucy, h) for h in (*H, *BETWEEN*even))
    yield from ((maker, Lucy, h) for maker, h in product(("plain", "printed", "closed"), (2.0, 3.0)))
    yield "exact", Lucy, 3.0
    weights = WEIGHTS.values() if even else (Monaghan, WendlandC2)
    yield from (("renormalised", weight, 3.0) for weight in weights)
    yield "delaunay", Lucy, 2.0


def wave(maker: str, weight: Any, h: float, disorder: str, wavelength: int) -> Iterator[OperatorErrors]:
    """One point of the error surface."""
    for seed in seeds(disorder):
        yield OperatorErrors(maker=maker, make=MAKERS[maker], weight=weight, h=h,
                             disorder=DISORDERS[disorder],
                             wavelength=wavelength, seed=seed)


def brackets(ranges: tuple[float, ...], kinds: tuple[str, ...], some: tuple[int, ...]) -> Iterator[Case]:
    """All ranges at one wavelength, h = 3 a at all wavelengths."""
    for kind in kinds:
        places = {*product(ranges, [WAVE]), *product([3.0], WAVES[kind])}
        for (h, wavelength), seed in product(sorted(places), some if kind != "lattice" else some[:1]):
            yield Brackets(disorder=DISORDERS[kind], h=h, wavelength=wavelength, seed=seed)


def vortex(maker: str, h: float, disorder: str, wavelengths: tuple[int, ...], weight: Any = Lucy,
           **more: Any) -> Iterator[TaylorGreen]:
    """Vortices of one kind; without a weight where h = 0."""
    for wavelength, seed in product(wavelengths, seeds(disorder)):
        yield TaylorGreen(maker=maker, make=MAKERS[maker], weight=weight if h else None, h=h,
                          disorder=DISORDERS[disorder], wavelength=wavelength, seed=seed, **more)


def vortices() -> Iterator[Case]:
    """On a lattice renormalised, closed and exact edges are the same. Exact ones take long to find, relaxed points to relax."""
    for h in (*RANGES, 6.0):
        yield from vortex("renormalised", h, "lattice", (16, 24, 32, 48, 64))
    for disorder in IRREGULAR:
        yield from irregular_vortices(disorder)
    yield from vortex("plain", 3.0, "relaxed", (16, 24, 32), WendlandC2)      # with which these points relax
    for mach, maker in product((0.02, 0.1), ("delaunay", "closed", "renormalised")):
        yield from vortex(maker, 3.0*(maker != "delaunay"), "jittered-0.3", (32,), mach=mach)


def irregular_vortices(disorder: str) -> Iterator[Case]:
    """All makers on one kind of irregular points."""
    three, four = (16, 24, 32), (16, 24, 32, 48)
    relaxed = disorder == "relaxed"
    yield from vortex("delaunay", 0.0, disorder, four if relaxed else (*four, 64))
    for maker, h in (*product(("renormalised", "closed"), (2.0, 3.0, 4.0)), ("plain", 3.0)):
        yield from vortex(maker, h, disorder, three if relaxed else four)
    yield from vortex("exact", 3.0, disorder, four if disorder == "jittered-0.3" else three)
    yield from vortex("exact", 4.0, disorder, three)


def quick_flows() -> Iterator[Case]:
    """A few small ones of each."""
    for h in (1.2, 2.0, 3.0):
        yield from vortex("renormalised", h, "lattice", (8, 12, 16))
    for maker, h in (("delaunay", 0.0), ("closed", 2.0), ("renormalised", 2.0)):
        yield from vortex(maker, h, "jittered-0.3", (8, 12, 16))
    yield from (convection("lattice", on_lattice(2.0), rows) for rows in (8, 12))
    for maker, h in (("closed", 2.0), ("exact", 3.0)):
        scheme = between_images("jittered-0.3", maker, h)
        yield from (convection("jittered-0.3", scheme, rows) for rows in (8, 12))
