"""Which waves, vortices and layers the study ordering runs, by size.

Gradients and Laplacians of plane waves, a decaying Taylor-Green vortex and Rayleigh-Benard convection on
lattices, jittered, random and relaxed points: error over a/h and h/lambda. a is the spacing, h the range of
Lucy's weight (RR98's r0 is its rms width, 0.42 h), lambda the wavelength or the height. Gradients as printed
stand beside those by differences. Paper size takes 40 minutes of one core.
"""
from collections.abc import Iterator, Mapping, Sequence
from itertools import product

from particles.integral.edge_makers import MAKERS
from studies.build.fixed import SCHEMES
from studies.build.setting import DISORDERS
from studies.kit.case import Case
from studies.ordering.runs import (
    GradientForms,
    OperatorErrors,
    VortexDecay,
    between_images,
    convection,
    on_lattice,
)

H = (1.2, 1.5, 2.0, 2.5, 3.0, 4.0, 6.0)
#: on a lattice, where each has a factor of its own: between these, to have a range every half spacing
BETWEEN = (3.5, 4.5, 5.0, 5.5)
SEEDS = (1, 2, 3)
#: of the flows
RANGES = (1.2, 1.5, 2.0, 2.5, 3.0, 4.0)
IRREGULAR = ("jittered-0.3", "random", "relaxed")
#: irregular points with triangles that end on rows of points on the plates
PLATES = {"jittered-0.3": SCHEMES["fixed-jittered-plates"], "random": SCHEMES["fixed-random-plates"],
          "relaxed": SCHEMES["relaxed-plates"]}
#: rows of convection between these, until the error of K is 1 %
ROWS = (12, 16, 24, 32, 40, 50)
#: makers of edges and ranges of the weight between mirror images; exact ones need the wider
MADE = (*product(("plain", "renormalised", "closed"), (2.0, 3.0)), ("exact", 3.0))
#: wavelengths; more points take longer to relax
WAVES = dict.fromkeys(DISORDERS, (16, 24, 32, 48, 64, 96)) | {"relaxed": (16, 20, 24, 32)}
WAVE = 32           # at which ranges and makers are compared


def cases(size: str) -> list[Case]:
    """`quick` has few wavelengths and kinds of points."""
    if size == "quick":
        waves = {"lattice": (16, 32), "jittered-0.3": (16, 32)}
        return [*surface(waves), *forms((1.2, 3.0), ("jittered-0.3",)), *quick_flows()]
    return [*surface(WAVES), *forms(H, ("lattice", *IRREGULAR)), *vortices(), *layers()]


def seeds(disorder: str) -> tuple[int, ...]:
    """Points with disorder have several."""
    return SEEDS if disorder != "lattice" else SEEDS[:1]


def surface(waves: Mapping[str, Sequence[int]]) -> Iterator[Case]:
    """Renormalised edges of all ranges, and all makers of edges at two."""
    others = (*product(("plain", "printed", "closed"), (2.0, 3.0)), ("exact", 3.0), ("delaunay", 2.0))
    for disorder, wavelengths in waves.items():
        ranges = (*H, *BETWEEN) if disorder == "lattice" else H
        edges = [*(("renormalised", h) for h in ranges), *others]
        for wavelength, (maker, h) in product(wavelengths, edges):
            yield from wave(maker, h, disorder, wavelength)
        if WAVE in wavelengths:
            yield from wave("plain", 1.2, disorder, WAVE)     # where Eq. 45 does not hold


def wave(maker: str, h: float, disorder: str, wavelength: int) -> Iterator[OperatorErrors]:
    """One point of the error surface."""
    for seed in seeds(disorder):
        yield OperatorErrors(make=MAKERS[maker], h=h, disorder=DISORDERS[disorder], wavelength=wavelength,
                             seed=seed)


def forms(ranges: Sequence[float], kinds: Sequence[str]) -> Iterator[Case]:
    """Gradients as printed: all ranges at one wavelength, h = 3 a at all wavelengths."""
    for kind in kinds:
        places = {*product(ranges, [WAVE]), *product([3.0], WAVES[kind])}
        for (h, wavelength), seed in product(sorted(places), seeds(kind)):
            yield GradientForms(disorder=DISORDERS[kind], h=h, wavelength=wavelength, seed=seed)


def vortex(maker: str, h: float, disorder: str, wavelengths: Sequence[int]) -> Iterator[VortexDecay]:
    """Vortices of one kind; without a weight where h = 0."""
    for wavelength, seed in product(wavelengths, seeds(disorder)):
        yield VortexDecay(make=MAKERS[maker], h=h, disorder=DISORDERS[disorder], wavelength=wavelength,
                          seed=seed)


def vortices() -> Iterator[Case]:
    """On a lattice renormalised, closed and exact edges are one. Exact ones take long to find."""
    for h in (*RANGES, 6.0):
        yield from vortex("renormalised", h, "lattice", (16, 24, 32, 48, 64))
    three, four = (16, 24, 32), (16, 24, 32, 48)
    for disorder in IRREGULAR:
        some = three if disorder == "relaxed" else four
        yield from vortex("delaunay", 0.0, disorder, four if disorder == "relaxed" else (*four, 64))
        for maker, h in (*product(("renormalised", "closed"), (2.0, 3.0, 4.0)), ("plain", 3.0)):
            yield from vortex(maker, h, disorder, some)
        yield from vortex("exact", 3.0, disorder, four if disorder == "jittered-0.3" else three)
        yield from vortex("exact", 4.0, disorder, three)


def layers() -> Iterator[Case]:
    """A lattice, triangles between rows of points, edges of a weight between mirror images."""
    for rows, h in product((12, 16, 24, 32), RANGES):
        yield convection("lattice", on_lattice(h), rows)
    for kind, scheme in PLATES.items():
        numbers = ROWS[:-1] if kind == "relaxed" else ROWS
        yield from (convection(kind, scheme, rows, seed) for rows, seed in product(numbers, SEEDS))
        for (maker, h), rows, seed in product(MADE, (16, 24, 32), SEEDS):
            yield convection(kind, between_images(kind, maker, h), rows, seed)


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
