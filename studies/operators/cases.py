"""What the study operators runs, by size.

Weights before and after they are discretised (Eqs 1-6, 28-33). Terms of the equations against exact
derivatives (Eqs 10-19, 34-38). What the brackets conserve and let grow (Eqs 34-38). The step of forward Euler
(Eq. 40). Viscosities of forces along edges (Eq. 51). Waves that decay, shear flows between plates, a
motionless layer. Lengths in spacings; densities, temperatures and sound speeds about 1. Paper size takes ten
minutes of one core.
"""
from collections.abc import Iterator
from itertools import product
from typing import Any

from continuum.exact.shear import couette, poiseuille
from continuum.exact.waves import LinearGas
from particles.integral.dih import NestedFluxes, Pairwise
from particles.integral.edge_makers import MAKERS, delaunay, exact, renormalised
from particles.integral.interpolants import Exponential, Gaussian
from particles.weights import WEIGHTS, Lucy, WendlandC2
from studies.build.setting import DISORDERS
from studies.kit.case import Case
from studies.operators.equations import EquationErrors, of_dilation, of_rotation, of_volumes
from studies.operators.integrals import Arithmetic, Continuum, of_weights
from studies.operators.kept import EulerLimit, Invariance, LayerGrowth, OneKernel, PointSet, SoundGrowth
from studies.operators.lattice import (
    Counted,
    EdgeForces,
    EdgeViscosities,
    ExponentialWave,
    LatticeSums,
    Power,
    WeightSymbols,
    of_edges,
)
from studies.operators.transport import (
    Between,
    Decay,
    Drive,
    ShearFlow,
    between_rows,
    jittered_images,
    on_lattice,
)

KINDS = (*WEIGHTS.values(), Exponential, Gaussian)
SEEDS = (1, 2, 3)
#: range of the weight, cells across the wave, by dimension
CELLS = {1: (3.0, (32, 64, 128, 256)),
         2: (3.0, (32, 48, 64, 96)),
         3: (2.0, (16, 20, 24, 32))}
#: A(r) and B(r)
FORCES = (EdgeForces("A 1/r", Power(1.0, -1), Power(0.0, 0)),
          EdgeForces("B 1/r", Power(0.0, 0), Power(1.0, -1)),
          EdgeForces("A and B 1/r", Power(3.0, -1), Power(1.0, -1)),
          EdgeForces("A 1, B r^2", Power(1.0, 0), Power(2.0, 2)),
          EdgeForces("A r, B 1", Power(5.0, 1), Power(1.0, 0)))

KEPT = ("lattice", "jittered-0.3", "random")
OFF_LATTICE = ("jittered-0.1", "jittered-0.3", "random", "relaxed")
#: points and range of the weight in 1, 2 and 3 dimensions: of random states, and of sound
STATES = (((20,), 2.7), ((10, 12), 2.7), ((6, 6, 7), 2.2))
BOXES = (((40,), 3.0), ((10, 10), 3.0), ((6, 6, 6), 2.0))
GASES = (LinearGas(0.02, 0.01, 0.03), LinearGas(0.03, 0.0, 0.0), LinearGas(0.01, 0.0, 0.05))
#: share of transport along edges in the motionless layer
SHARES = (0.0, 0.003, 0.01, 0.03, 0.05, 0.07, 0.1, 0.3, 1.0)

ZETA = 0.2          # of waves
LONG = 32           # spacings: longer waves on irregular points cost seconds each
DRIVES = (Drive("couette", 1.0, 0.0, couette), Drive("poiseuille", 0.0, 1.0, poiseuille))
LATTICE = Between("lattice", on_lattice)
IMAGES = Between("jittered-0.2", jittered_images)
ROWS = Between("jittered-0.2, plates", between_rows)
MANY = tuple(range(1, 13))      # sets of points between rows of points: their errors scatter by a tenth


def cases(size: str) -> list[Case]:
    """`quick` has fewer sizes, seeds and kinds of points."""
    quick = size == "quick"
    parts = (weights, equations, points, waves, shear, layers)
    return [case for part in parts for case in part(quick)]


def weights(quick: bool) -> Iterator[Case]:
    """Every weight as an integral and on the lattice; the exponential one at many widths."""
    for numbers in (of_weights, of_edges, of_volumes, of_dilation, of_rotation):
        yield Arithmetic(numbers=numbers)
    kinds, count = ((Lucy, Exponential), 6) if quick else (KINDS, 24)
    for kind in kinds:
        yield WeightSymbols(kind=kind, r0=1.0 if kind in (Exponential, Gaussian) else 3.0, count=count)
        for d in (1, 2, 3):
            yield Continuum(kind=kind, d=d)
            if kind is not Exponential:     # which has a singularity that no lattice resolves
                yield Counted(kind=kind, d=d, points=20.0 if kind is Gaussian else 200.0)
    yield from (LatticeSums(kind=Lucy, d=d, r0=r0) for d, r0 in product((1, 2, 3), (3.0, 6.0)))
    yield from (LatticeSums(kind=Exponential, d=3, r0=r0) for r0 in (2.0, 4.0, 8.0))
    yield from (ExponentialWave(r0=float(r0), wavelength=128.0) for r0 in range(2, 9))


def equations(quick: bool) -> Iterator[Case]:
    """Terms against exact derivatives."""
    for d, (h, cells) in CELLS.items():
        if d < 3 or not quick:
            yield from (EquationErrors(d=d, kind=WendlandC2, h=h, cells=n) for n in cells)
    yield from (EdgeViscosities(d=d, forces=forces, h=6.0) for d, forces in product((2, 3), FORCES))


def points(quick: bool) -> Iterator[Case]:
    """What is conserved, and what grows."""
    dimensions, seeds = ((2,), SEEDS[:1]) if quick else ((1, 2, 3), SEEDS)
    for d, kind in product(dimensions, KEPT):
        yield from on_points(Invariance, STATES[d - 1], kind, (3,))
    for d, kind in product(dimensions, KEPT[1:]):
        yield from one_maker(OneKernel, STATES[d - 1], "renormalised", kind, seeds)
    for d in dimensions:
        yield from on_points(SoundGrowth, BOXES[d - 1], "lattice", (1,))
        for kind in ("jittered-0.3",) if quick else OFF_LATTICE if d == 2 else KEPT[1:]:
            yield from on_points(SoundGrowth, BOXES[d - 1], kind, seeds)
    yield from (EulerLimit(gas=gas) for gas in GASES)


def on_points(case: type[PointSet], box: tuple[tuple[int, ...], float], kind: str,
              seeds: tuple[int, ...]) -> Iterator[PointSet]:
    """All makers; triangles need two dimensions, and points that do not lie on spheres."""
    d = len(box[0])
    for maker in MAKERS:
        if maker != "delaunay" or not (d == 1 or (d == 3 and kind == "lattice")):
            yield from one_maker(case, box, maker, kind, seeds)


def one_maker(case: type[PointSet], box: tuple[tuple[int, ...], float], maker: str, kind: str,
              seeds: tuple[int, ...]) -> Iterator[PointSet]:
    """One kind of edges on sets of points."""
    counts, h = box
    for seed in seeds:
        yield case(make=MAKERS[maker], disorder=DISORDERS[kind], counts=counts, h=h, seed=seed)


def waves(quick: bool) -> Iterator[Case]:
    """On a lattice, a strip as narrow as the range allows, and on three sets of points jittered by 0.3 a."""
    wavelengths = (16, 24, 32) if quick else (8, 16, 24, 32, 48, 64)
    for way in (NestedFluxes(), Pairwise()):
        for h, n in product((2.0, 3.0), wavelengths):
            yield Decay(transport=way, make=renormalised, h=h, disorder=DISORDERS["lattice"],
                        counts=(n, round(2*h) + 1), zeta=ZETA)
        irregular = product((delaunay, exact), (16, 24, LONG), SEEDS)
        for make, n, seed in [(delaunay, 16, 1)] if quick else irregular:
            yield Decay(transport=way, make=make, h=3.0, disorder=DISORDERS["jittered-0.3"], counts=(n, 12),
                        zeta=ZETA, seed=seed)


def shear(quick: bool) -> Iterator[Case]:
    """Flows between plates; a lattice has no seeds."""
    plans: Any = ((LATTICE, (8, 16, 32, 64), (1,)), (IMAGES, (8, 16, 32, 48), SEEDS),
                  (ROWS, (8, 16, 32, 48, 64), MANY))
    if quick:
        plans = ((LATTICE, (8, 12, 16), (1,)), (IMAGES, (8,), SEEDS), (ROWS, (8,), SEEDS))
    for drive, (between, rows, seeds) in product(DRIVES, plans):
        for n, seed in product(rows, seeds):
            yield ShearFlow(drive=drive, between=between, rows=n, seed=seed)


def layers(quick: bool) -> Iterator[Case]:
    """A motionless layer: two ranges of the weight, two Rayleigh numbers below onset."""
    sizes = (8,) if quick else (8, 12, 16)
    for h, rows, ra, share in product((2.0, 3.0), sizes, (200.0, 1500.0), SHARES):
        yield LayerGrowth(h=h, rows=rows, ra=ra, share=share)
