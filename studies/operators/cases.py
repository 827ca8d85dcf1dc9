"""What the study operators runs, by size.

Weights before and after they are discretised (Eqs 1-6, 28-33), terms of the equations against exact derivatives (Eqs 10-19,
34-38), what the brackets conserve, keep and let grow (Eqs 34-38), the step of forward Euler (Eq. 40), viscosities of forces
along edges (Eq. 51); waves that decay and shear flows between plates; what grows in a motionless layer. Lengths in
spacings; densities, temperatures and sound speeds about 1. Paper size takes 15 minutes of one core.
"""
from collections.abc import Iterator
from itertools import product
from typing import Any

from particles.integral.dih import NestedFluxes, Pairwise
from particles.integral.edge_makers import MAKERS
from particles.integral.interpolants import Exponential, Gaussian
from particles.weights import WEIGHTS, Lucy, Monaghan, WendlandC2
from studies.build.disorder import DISORDERS
from studies.kit.case import Case
from studies.operators.equations import EquationErrors
from studies.operators.exchange import FORMS, Friction, Invariance, OneKernel
from studies.operators.lattice import Arithmetic, Counted, ExponentialWave, LatticeSums, Symbols
from studies.operators.printed import Dilation, Nulls, Rotation, Stream, Volumes
from studies.operators.stability import Euler, Growth, LayerGrowth
from studies.operators.transport import FLOWS, Decay, ShearFlow
from studies.operators.weights import Continuum

KINDS = (*WEIGHTS.values(), Exponential, Gaussian)
SEEDS = (1, 2, 3)
KEPT = ("lattice", "jittered-0.3", "random")
OFF_LATTICE = ("jittered-0.1", "jittered-0.3", "random", "relaxed")
VISCOSITIES = (0.0, 0.1)
#: cells across the wave, by dimension and range in spacings; 12 spacings on a line, whose sums are integrals
CELLS = {(1, 3.0): (32, 64, 128, 256), (1, 12.0): (128, 256, 384), (2, 3.0): (32, 48, 64, 96),
         (3, 2.0): (16, 20, 24, 32)}
#: of the exponential weight on lattices, by dimension
WIDTHS = {1: (2.0, 4.0, 8.0, 16.0), 2: (2.0, 4.0, 8.0, 16.0), 3: (1.0, 2.0, 4.0, 8.0)}
#: eta, zeta, kappa for the step of forward Euler
GASES = ((0.02, 0.01, 0.03), (0.03, 0.0, 0.0), (0.01, 0.0, 0.05))
#: share of transport along edges in the motionless layer
SHARES = (0.0, 0.003, 0.01, 0.03, 0.05, 0.07, 0.1, 0.3, 1.0)
ZETA = 0.2
#: transport and bulk viscosity of waves: forces along edges share out the two viscosities with zeta > 0 only
#: in 2D
WAVES = (("nested", ZETA), ("pairwise", 0.0), ("pairwise", ZETA))
LONG = 32           # spacings: longer waves on irregular points cost seconds each
MANY = tuple(range(1, 13))      # sets of points between rows of points: their errors scatter by a tenth
JITTER = 0.2        # spacings, of points between plates


def cases(size: str) -> list[Case]:
    """`quick` has fewer sizes, seeds and kinds of points."""
    quick = size == "quick"
    return [*weights(quick), *equations(quick), *exchange(quick), *transport(quick), *layers(quick)]


def weights(quick: bool) -> Iterator[Case]:
    """Every weight as an integral and on the lattice; the exponential one at many widths."""
    kinds, count = ((Lucy, Exponential), 6) if quick else (KINDS, 24)
    yield Arithmetic()
    for kind, d in product(kinds, (1, 2, 3)):
        yield Continuum(kind=kind, d=d)
        yield Symbols(kind=kind, d=d, r0=1.0 if kind in (Exponential, Gaussian) else 3.0, count=count)
        if kind is not Exponential:     # which has a singularity that no lattice resolves
            yield Counted(kind=kind, d=d, r0=20.0 if kind is Gaussian else 200.0)
    for d, widths in WIDTHS.items():
        yield from (LatticeSums(kind=Exponential, d=d, r0=r0) for r0 in widths)
        yield from (LatticeSums(kind=Lucy, d=d, r0=r0) for r0 in (3.0, 6.0))
    for d, r0 in product((2, 3), (2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0)):
        yield ExponentialWave(d=d, r0=r0, wavelength=128.0)


def equations(quick: bool) -> Iterator[Case]:
    """Terms against exact derivatives."""
    for (d, h), cells in CELLS.items():
        if not quick or (d < 3 and h == 3.0):
            yield from (EquationErrors(d=d, kind=WendlandC2, h=h, cells=n) for n in cells)
    yield Volumes()
    yield from (Dilation(d=d) for d in (1, 2, 3))
    kinds = (Lucy,) if quick else WEIGHTS.values()
    yield from (Nulls(kind=kind, d=d, h=h) for kind in kinds for d, h in ((1, 3.0), (2, 3.0), (3, 2.0)))
    for d in (1, 2):
        yield Nulls(kind=Gaussian, d=d, h=0.5)
        yield Nulls(kind=Exponential, d=d, h=0.2)
    yield from (Rotation(d=d, zeta=zeta) for d, zeta in ((2, 0.0), (2, 0.5), (3, 0.0)))
    yield from (Friction(d=d, form=form, h=h) for d, form, h in product((2, 3), FORMS, (2.0, 3.0, 6.0)))


def exchange(quick: bool) -> Iterator[Case]:
    """What is conserved, kept, and grows."""
    seeds = SEEDS[:1] if quick else SEEDS
    kinds = OFF_LATTICE[1:2] if quick else OFF_LATTICE
    dimensions = (2,) if quick else (1, 2, 3)
    for maker in MAKERS:
        for kind, d in has_edges(maker, dimensions):
            yield Invariance(maker=maker, make=MAKERS[maker], disorder=DISORDERS[kind], d=d)
        yield growth(maker, "lattice")
        yield from (growth(maker, kind, seed) for kind, seed in product(kinds, seeds))
        if not quick:
            yield from other_dimensions(maker)
    for kind, seed in product(kinds, seeds):
        yield Stream(disorder=DISORDERS[kind], seed=seed)
    for kind, d, seed in product(KEPT[1:], dimensions, seeds):
        yield OneKernel(disorder=DISORDERS[kind], d=d, seed=seed)
    for eta, zeta, kappa in GASES:
        yield Euler(transport=NestedFluxes(), eta=eta, zeta=zeta, kappa=kappa)
        yield Euler(transport=Pairwise(), eta=eta, zeta=zeta, kappa=kappa)


def has_edges(maker: str, dimensions: tuple[int, ...]) -> Iterator[tuple[str, int]]:
    """(points, d): triangles need two dimensions, and points that do not lie on spheres."""
    for kind, d in product(KEPT, dimensions):
        if maker != "delaunay" or not (d == 1 or (d == 3 and kind == "lattice")):
            yield kind, d


def growth(maker: str, kind: str, seed: int = 1, d: int = 2) -> Growth:
    """Sound at rest on one set of points."""
    return Growth(maker=maker, make=MAKERS[maker], disorder=DISORDERS[kind], viscosities=VISCOSITIES,
                  seed=seed, d=d)


def other_dimensions(maker: str) -> Iterator[Growth]:
    """The same in one and three dimensions; a lattice has no seeds."""
    for kind, d in has_edges(maker, (1, 3)):
        seeds = SEEDS[:1] if kind == "lattice" else SEEDS
        yield from (growth(maker, kind, seed, d) for seed in seeds)


def transport(quick: bool) -> Iterator[Case]:
    """Waves and shear flows."""
    if quick:
        yield from on_lattice((16, 24, 32))
        yield from list(irregular((16,)))[:3]
        yield from shear((8, 12, 16), (8,), (8,), SEEDS)
        return
    yield from on_lattice((8, 16, 24, 32, 48, 64))
    yield from irregular((16, 24, 32, 48))
    yield from shear((8, 16, 32, 64), (8, 16, 32, 48), (8, 16, 32, 48, 64), MANY)


def on_lattice(wavelengths: tuple[int, ...]) -> Iterator[Case]:
    """Waves along an axis, the strip across as narrow as the range allows; along a diagonal where directions differ."""
    for (way, zeta), weight, h in product(WAVES, (Lucy, Monaghan, WendlandC2), (2.0, 3.0)):
        same: dict[str, Any] = {"transport": way, "zeta": zeta, "maker": "renormalised",
                                "make": MAKERS["renormalised"],
                                "weight": weight, "h": h, "disorder": DISORDERS["lattice"]}
        yield from (Decay(**same, counts=(n, round(2*h) + 1)) for n in wavelengths)
        if weight is Lucy and zeta:
            yield from (Decay(**same, counts=(n, n), turns=(1, 1)) for n in (24, 32, 48)
                        if n <= max(wavelengths))


def irregular(wavelengths: tuple[int, ...]) -> Iterator[Case]:
    """Points jittered by 0.3 a, three sets each; the longest waves with the least that Eq. 51 can be."""
    for (way, zeta), maker, n, seed in product(WAVES, ("delaunay", "exact"), wavelengths, SEEDS):
        if n <= LONG or (way, zeta) == WAVES[1]:
            yield Decay(transport=way, zeta=zeta, maker=maker, make=MAKERS[maker], weight=Lucy, h=3.0,
                        disorder=DISORDERS["jittered-0.3"], counts=(n, 12), seed=seed)


def shear(rows: tuple[int, ...], mirrored: tuple[int, ...], held: tuple[int, ...],
          seeds: tuple[int, ...]) -> Iterator[Case]:
    """Between plates: a lattice, jittered points and their mirror images, jittered points between rows of held ones."""
    for drive in FLOWS.values():
        yield from (ShearFlow(drive=drive, rows=n) for n in rows)
        for plates, n, seed in (*product((False,), mirrored, SEEDS), *product((True,), held, seeds)):
            yield ShearFlow(drive=drive, rows=n, jitter=JITTER, plates=plates, seed=seed)


def layers(quick: bool) -> Iterator[Case]:
    """A motionless layer: two ranges of the weight, two Rayleigh numbers below onset."""
    sizes = (8,) if quick else (8, 12, 16)
    for h, rows, ra, share in product((2.0, 3.0), sizes, (200.0, 1500.0), SHARES):
        yield LayerGrowth(h=h, rows=rows, ra=ra, share=share)
