"""Which waves, vortices and layers the study ordering runs, by size: error over a/h and h/lambda.

a is the spacing, h the range of Lucy's weight (RR98's r0 is its rms width, 0.42 h), lambda the wavelength or
the height. Paper size takes 40 minutes of one core.
"""
from collections.abc import Iterator, Mapping, Sequence
from itertools import product

from particles.integral.edge_makers import MAKERS
from studies.build.fixed import SCHEMES
from studies.build.setting import DISORDERS
from studies.kit.case import Case
from studies.ordering import runs
from studies.ordering.runs import between_images, convection, on_lattice

H = (1.2, 1.5, 2.0, 2.5, 3.0, 4.0, 6.0)
#: further ranges on a lattice, where each has its own factor in the error: one every half spacing
BETWEEN = (3.5, 4.5, 5.0, 5.5)
SEEDS = (1, 2, 3)
#: gradients with wide weights: range -> seeds besides those above, where three do not decide
WIDE = {5.0: range(1, 21), 6.0: range(4, 10)}
RANGES = H[:-1]     # ranges of the flows
IRREGULAR = ("jittered-0.3", "random", "relaxed")
#: irregular points with triangles that end on rows of points on the plates
PLATES = {"jittered-0.3": SCHEMES["fixed-jittered-plates"], "random": SCHEMES["fixed-random-plates"],
          "relaxed": SCHEMES["relaxed-plates"]}
#: numbers of rows of convection on such points, until the error of K is 1 %
ROWS = (12, 16, 24, 32, 40, 50)
#: makers of edges and ranges of the weight between mirror images; exact edges need the wider one
MADE = (*product(("plain", "renormalised", "closed"), (2.0, 3.0)), ("exact", 3.0))
#: kind of points -> wavelengths; more points take longer to relax
WAVES = dict.fromkeys(DISORDERS, (16, 24, 32, 48, 64, 96)) | {"relaxed": (16, 20, 24, 32)}
WAVE = 32           # wavelength at which ranges and makers are compared


def cases(size: str) -> list[Case]:
    """All cases of a size; `quick` has few wavelengths and kinds of points."""
    if size == "quick":
        waves = {"lattice": (16, 32), "jittered-0.3": (16, 32)}
        return [*surface(waves), *forms((1.2, 3.0), ("jittered-0.3",)), *quick_flows()]
    return [*surface(WAVES), *forms(H, ("lattice", *IRREGULAR)), *wide_forms(), *vortices(), *layers()]


def surface(waves: Mapping[str, Sequence[int]]) -> Iterator[Case]:
    """Operators with renormalised edges at all ranges, and with all makers of edges at one range or two."""
    others = (*product(("plain", "printed", "closed"), (2.0, 3.0)), ("exact", 3.0), ("delaunay", 2.0))
    for disorder, wavelengths in waves.items():
        ranges = (*H, *BETWEEN) if disorder == "lattice" else H
        for edge in (*product(("renormalised",), ranges), *others):
            yield from on_points(runs.OperatorErrors, *edge, disorder, wavelengths)
        yield from on_points(runs.OperatorErrors, "plain", 1.2, disorder, [WAVE])     # Eq. 45 does not hold


def on_points(case: type[runs.OnPoints], maker: str, h: float, disorder: str, wavelengths: Sequence[int],
              seeds: Sequence[int] = SEEDS) -> Iterator[runs.OnPoints]:
    """Cases of all wavelengths and seeds on a kind of points. h : 0 for edges without a weight.

    A lattice has one seed, since all are alike.
    """
    for wavelength, seed in product(wavelengths, seeds[:1] if disorder == "lattice" else seeds):
        yield case(maker=MAKERS[maker], h=h, points=DISORDERS[disorder], wavelength=wavelength, seed=seed)


def forms(ranges: Sequence[float], kinds: Sequence[str]) -> Iterator[Case]:
    """Gradients as printed: all ranges at one wavelength, h = 3 a at all wavelengths."""
    for kind, h in product(kinds, ranges):
        yield from on_points(runs.GradientForms, "plain", h, kind, WAVES[kind] if h == 3 else [WAVE])


def wide_forms() -> Iterator[Case]:
    """The same with wide weights and more seeds."""
    for h, seeds in WIDE.items():
        yield from on_points(runs.GradientForms, "plain", h, "jittered-0.3", [WAVE], seeds)


def vortices() -> Iterator[Case]:
    """Decaying vortices. On a lattice renormalised, closed and exact edges agree; exact ones are slow."""
    for h in (*RANGES, 6.0):
        yield from on_points(runs.VortexDecay, "renormalised", h, "lattice", (16, 24, 32, 48, 64))
    three, four = (16, 24, 32), (16, 24, 32, 48)
    for disorder in IRREGULAR:
        some, more = (three, four) if disorder == "relaxed" else (four, (*four, 64))
        edges = {("delaunay", 0.0): more, ("plain", 3.0): some, ("exact", 4.0): three,
                 ("exact", 3.0): four if disorder == "jittered-0.3" else three}
        edges |= dict.fromkeys(product(("renormalised", "closed"), (2.0, 3.0, 4.0)), some)
        for edge, wavelengths in edges.items():
            yield from on_points(runs.VortexDecay, *edge, disorder, wavelengths)


def layers() -> Iterator[Case]:
    """Convection: a lattice, triangles between rows of points, edges of a weight between mirror images."""
    for rows, h in product((12, 16, 24, 32), RANGES):
        yield convection("lattice", on_lattice(h), rows)
    for kind, scheme in PLATES.items():
        numbers = ROWS[:-1] if kind == "relaxed" else ROWS
        yield from (convection(kind, scheme, rows, seed) for rows, seed in product(numbers, SEEDS))
        for (maker, h), rows, seed in product(MADE, (16, 24, 32), SEEDS):
            yield convection(kind, between_images(kind, maker, h), rows, seed)


def quick_flows() -> Iterator[Case]:
    """A few small vortices and layers."""
    for h in (1.2, 2.0, 3.0):
        yield from on_points(runs.VortexDecay, "renormalised", h, "lattice", (8, 12, 16))
    for maker, h in (("delaunay", 0.0), ("closed", 2.0), ("renormalised", 2.0)):
        yield from on_points(runs.VortexDecay, maker, h, "jittered-0.3", (8, 12, 16))
    yield from (convection("lattice", on_lattice(2.0), rows) for rows in (8, 12))
    for maker, h in (("closed", 2.0), ("exact", 3.0)):
        scheme = between_images("jittered-0.3", maker, h)
        yield from (convection("jittered-0.3", scheme, rows) for rows in (8, 12))
