"""Which equations of RR98 hold on fixed points, and by how much do the others miss?

Weights before and after they are discretised (Eqs 1-6, 28-33), terms of the equations against exact derivatives (Eqs 10-19,
34-38), what the brackets conserve, keep and let grow (Eqs 34-38), the step of forward Euler (Eq. 40), viscosities of forces along
edges (Eq. 51). Lengths in spacings; densities, temperatures and sound speeds about 1. Paper size takes a minute of one core.
Writes results/operators/*.csv and *.png and the rows of study operators in results/claims.csv.
"""
from collections.abc import Iterator
from itertools import product

from particles.integral.dih import Nested, Pairwise
from particles.integral.edge_makers import MAKERS
from particles.integral.interpolants import Exponential, Gaussian
from particles.weights import WEIGHTS, Lucy, WendlandC2
from studies.kit.case import Case
from studies.kit.study import Part
from studies.operators import claims as operators_claims
from studies.operators import derive as operators_derive
from studies.operators import figures as operators_figures
from studies.operators import tables as operators_tables
from studies.operators.equations import EquationErrors
from studies.operators.exchange import FORMS, Friction, Invariance, Work, pairs_of
from studies.operators.printed import Dilation, Nulls, Rotation, Stream, Volumes
from studies.operators.stability import Euler, Growth
from studies.operators.symbols import Counted, ExponentialWave, Fastest, Symbols
from studies.operators.weights import Continuum, LatticeSums
from studies.ordering.waves import DISORDERS, Distance

KINDS = (*WEIGHTS.values(), Exponential, Gaussian)
SEEDS = (1, 2, 3)
OFF = ("jittered-0.1", "jittered-0.3", "random", "relaxed")
VISCOSITIES = (0.0, 0.1)
#: cells across the wave, by dimension and range in spacings; 12 spacings on a line, whose sums are integrals
CELLS = {(1, 3.0): (32, 64, 128, 256), (1, 12.0): (128, 256, 384), (2, 3.0): (32, 48, 64, 96), (3, 2.0): (16, 20, 24, 32)}
#: of the exponential weight on lattices, by dimension
WIDTHS = {1: (2.0, 4.0, 8.0, 16.0), 2: (2.0, 4.0, 8.0, 16.0), 3: (1.0, 2.0, 4.0, 8.0)}
#: eta, zeta, kappa for the step of forward Euler
GASES = ((0.02, 0.01, 0.03), (0.03, 0.0, 0.0), (0.01, 0.0, 0.05))


def weights(size: str) -> Iterator[Case]:
    """Every weight as an integral and on the lattice; the exponential one at many widths."""
    kinds, count = (KINDS, 24) if size != "quick" else ((Lucy, Exponential), 6)
    for kind, d in product(kinds, (1, 2, 3)):
        yield Continuum(kind=kind, d=d)
        yield Symbols(kind=kind, d=d, r0=1.0 if kind in (Exponential, Gaussian) else 3.0, count=count)
        if kind is not Exponential:     # which has a singularity that no lattice resolves
            yield Counted(kind=kind, d=d, r0=20.0 if kind is Gaussian else 200.0)
    yield from (Fastest(kind=Lucy, h=h) for h in (2.0, 3.0, 4.0))
    for d, widths in WIDTHS.items():
        for r0 in widths:
            yield LatticeSums(kind=Exponential, d=d, r0=r0)
        for r0 in (3.0, 6.0):
            yield LatticeSums(kind=Lucy, d=d, r0=r0)
    for d, r0 in product((2, 3), (2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0)):
        yield ExponentialWave(d=d, r0=r0, wavelength=128.0)


def equations(size: str) -> Iterator[Case]:
    """Terms against exact derivatives."""
    for (d, h), cells in CELLS.items():
        if size != "quick" or (d < 3 and h == 3.0):
            yield from (EquationErrors(d=d, kind=WendlandC2, h=h, cells=n) for n in cells)
    yield Volumes()
    yield from (Dilation(d=d) for d in (1, 2, 3))
    kinds = WEIGHTS.values() if size != "quick" else (Lucy,)
    yield from (Nulls(kind=kind, d=d, h=h) for kind in kinds for d, h in ((1, 3.0), (2, 3.0), (3, 2.0)))
    yield from (Nulls(kind=kind, d=d, h=r0) for kind, r0 in ((Gaussian, 0.5), (Exponential, 0.2)) for d in (1, 2))
    yield from (Rotation(d=d, zeta=zeta) for d, zeta in ((2, 0.0), (2, 0.5), (3, 0.0)))
    yield from (Friction(d=d, form=form, h=h) for d, form, h in product((2, 3), FORMS, (2.0, 3.0, 6.0)))


def exchange(size: str) -> Iterator[Case]:
    """What is conserved, kept, and grows."""
    seeds, off, dimensions = (SEEDS, OFF, (1, 2, 3)) if size != "quick" else (SEEDS[:1], OFF[1:2], (2,))
    for maker, make in MAKERS.items():
        for kind, d in pairs_of(maker, ["lattice", "jittered-0.3", "random"], dimensions):
            yield Invariance(maker=maker, make=make, disorder=DISORDERS[kind], d=d)
        yield Growth(maker=maker, make=make, disorder=DISORDERS["lattice"], viscosities=VISCOSITIES)
        for kind, seed in product(off, seeds):
            yield Growth(maker=maker, make=make, disorder=DISORDERS[kind], viscosities=VISCOSITIES, seed=seed)
        for (kind, d), seed in product(pairs_of(maker, ["lattice", "jittered-0.3", "random"], (1, 3)), seeds):
            if size != "quick" and (seed == seeds[0] or kind != "lattice"):
                yield Growth(maker=maker, make=make, disorder=DISORDERS[kind], viscosities=VISCOSITIES, seed=seed, d=d)
    for length, (kind, disorder) in product((16, 32, 64) if size != "quick" else (16,), DISORDERS.items()):
        if size != "quick" or kind != "relaxed":
            yield from (Distance(disorder=disorder, length=length, seed=seed) for seed in seeds[:None if kind in OFF else 1])
    for kind, seed in product(off, seeds):
        yield Stream(disorder=DISORDERS[kind], seed=seed)
    yield from (Work(disorder=DISORDERS[kind], d=d, seed=seed)
                for kind, d, seed in product(("jittered-0.3", "random"), dimensions, seeds))
    for eta, zeta, kappa in GASES:
        yield Euler(transport=Nested(), eta=eta, zeta=zeta, kappa=kappa)
        yield Euler(transport=Pairwise(), eta=eta, zeta=zeta, kappa=kappa)


def cases(size: str) -> list[Case]:
    """`quick` has fewer sizes, seeds and kinds of points."""
    return [*weights(size), *equations(size), *exchange(size)]


PART = Part(cases=cases, tables=operators_tables.ALL, derive=operators_derive.derive,
              figures=operators_figures.figures, claims=operators_claims.CLAIMS)
