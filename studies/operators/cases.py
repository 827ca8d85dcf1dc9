"""Cases of the study operators, by size.

Lengths in spacings; densities, temperatures and sound speeds about 1. Size `paper`: ten minutes on one core.
"""
from collections.abc import Iterator
from itertools import product

from continuum.exact.shear import couette, poiseuille
from continuum.exact.waves import LinearGas
from particles.integral.edge_makers import MAKERS, delaunay, exact, renormalised
from particles.integral.interpolants import Exponential, Gaussian
from particles.weights import WEIGHTS, Lucy, WendlandC2
from studies.build.setting import DISORDERS
from studies.kit.case import Case
from studies.operators.equations import Arithmetic, EquationErrors, of_volumes
from studies.operators.makers import FACES, SETS, SMOOTH, MakerErrors, WallHeat
from studies.operators.makers import MAKERS as TODAY
from studies.operators.points import FLOWS, WAYS, Entropy, LayerGrowth, OneKernel, SoundGrowth
from studies.operators.transport import BETWEEN, Decay, Drive, EulerLimit, ShearFlow, of_edges
from studies.operators.weights import Continuum, ExponentialWave, LatticeSums, of_weights

SEEDS = (1, 2, 3)
#: by dimension: range of the weight, numbers of cells across the wave
CELLS = {1: (3.0, (32, 64, 128, 256)), 2: (3.0, (32, 48, 64, 96)), 3: (2.0, (16, 20, 24, 32))}

#: (points, range of the weight) in 1D, 2D, 3D of random states
STATES = (((20,), 2.7), ((10, 12), 2.7), ((6, 6, 7), 2.2))
GASES = (LinearGas(0.02, 0.01, 0.03), LinearGas(0.03, 0.0, 0.0), LinearGas(0.01, 0.0, 0.05))
#: share of transport along edges in the motionless layer
SHARES = (0.0, 0.003, 0.01, 0.03, 0.05, 0.07, 0.1, 0.3, 1.0)

ZETA = 0.2          # bulk viscosity of waves
LONG = 32           # spacings: longer waves on irregular points cost seconds each
DRIVES = (Drive("couette", 1.0, 0.0, couette), Drive("poiseuille", 0.0, 1.0, poiseuille))
MANY = tuple(range(1, 13))      # seeds of points between rows on plates: their errors scatter by a tenth


def cases(size: str) -> list[Case]:
    """Cases of a size; `quick` has fewer sizes, seeds and kinds of points."""
    quick = size == "quick"
    parts = (weights, equations, points, waves, shear, layers, entropy, makers, wall_heat)
    return [case for part in parts for case in part(quick)]


def weights(quick: bool) -> Iterator[Case]:
    """Integrals of every weight; lattice sums of Lucy's and the exponential one, the last at many widths."""
    yield from (Arithmetic(numbers=numbers) for numbers in (of_weights, of_edges, of_volumes))
    for kind in (Lucy, Exponential) if quick else (*WEIGHTS.values(), Exponential, Gaussian):
        yield from (Continuum(weight=kind, d=d) for d in (1, 2, 3))
    yield from (LatticeSums(weight=Lucy, d=d, r0=r0) for d, r0 in product((1, 2, 3), (3.0, 6.0)))
    yield from (LatticeSums(weight=Exponential, d=3, r0=r0) for r0 in (2.0, 4.0, 8.0))
    yield from (ExponentialWave(r0=float(r0), wavelength=128.0) for r0 in range(2, 9))


def equations(quick: bool) -> Iterator[Case]:
    """Terms against exact derivatives."""
    for d, (h, cells) in CELLS.items():
        if d < 3 or not quick:
            yield from (EquationErrors(d=d, weight=WendlandC2, h=h, cells=n) for n in cells)


def points(quick: bool) -> Iterator[Case]:
    """Pressures that are not symmetric, growth of sound, limits of Euler's step."""
    states, kinds, seeds = (STATES[1:2], ("lattice", "jittered-0.3"), SEEDS[:1]) if quick else (
        STATES, DISORDERS, SEEDS)
    for (counts, h), kind, seed in product(states, ("jittered-0.3", "random"), seeds):
        yield OneKernel(maker=renormalised, points=DISORDERS[kind], counts=counts, h=h, seed=seed)
    for maker, kind in product(MAKERS.values(), kinds):
        for seed in seeds[:1] if kind == "lattice" else seeds:
            yield SoundGrowth(maker=maker, points=DISORDERS[kind], counts=(10, 10), h=3.0, seed=seed)
    yield from (EulerLimit(gas=gas) for gas in GASES)


def waves(quick: bool) -> Iterator[Case]:
    """Decaying waves in a narrow strip of lattice, and on three sets of points jittered by 0.3 a."""
    wavelengths = (16, 24, 32) if quick else (8, 16, 24, 32, 48, 64)
    for way in ("nested", "pairwise"):
        for h, n in product((2.0, 3.0), wavelengths):
            yield Decay(transport=way, maker=renormalised, h=h, points=DISORDERS["lattice"],
                        counts=(n, round(2*h) + 1), zeta=ZETA)
        irregular = product((delaunay, exact), (16, 24, LONG), SEEDS)
        for make, n, seed in [(delaunay, 16, 1)] if quick else irregular:
            yield Decay(transport=way, maker=make, h=3.0, points=DISORDERS["jittered-0.3"], counts=(n, 12),
                        zeta=ZETA, seed=seed)


def shear(quick: bool) -> Iterator[Case]:
    """Shear flows between plates; one seed for a lattice."""
    all_rows = ((8, 12, 16), (8,), (8,)) if quick else ((8, 16, 32, 64), (8, 16, 32, 48), (8, 16, 32, 48, 64))
    all_seeds = ((1,), SEEDS, SEEDS if quick else MANY)
    for points, sizes, seeds in zip(BETWEEN, all_rows, all_seeds, strict=True):
        for drive, rows, seed in product(DRIVES, sizes, seeds):
            yield ShearFlow(flow=drive, points=points, rows=rows, seed=seed)


def layers(quick: bool) -> Iterator[Case]:
    """A motionless layer: two ranges of the weight, two Rayleigh numbers below onset."""
    sizes = (8,) if quick else (8, 12, 16)
    for h, rows, ra, share in product((2.0, 3.0), sizes, (200.0, 1500.0), SHARES):
        yield LayerGrowth(h=h, rows=rows, ra=ra, share=share)


def entropy(quick: bool) -> Iterator[Case]:
    """Entropy in smooth, random and worst states, range 2.5 a: six cells hold it. Flows need closed edges."""
    sets = ((renormalised, "lattice"), (delaunay, "jittered-0.3"), (exact, "jittered-0.3"))
    states = (("smooth", (16,) if quick else (16, 32, 64), (1,)), ("random", (10,), (1,)),
              ("sought", (6,), SEEDS[:1 if quick else 3]))
    ways = (*product(WAYS, sets), *product(FLOWS, sets[:2]))
    for (way, (make, kind)), (state, sizes, seeds) in product(ways, states):
        for n, seed in product(sizes, seeds[:1] if way in FLOWS else seeds):
            yield Entropy(transport=way, maker=make, points=DISORDERS[kind], counts=(n, n), h=2.5,
                          state=state, seed=seed)


def makers(quick: bool) -> Iterator[Case]:
    """Errors of the areas of today's methods on all sets of points."""
    cells, seeds = ((8, 12, 16), (1,)) if quick else ((16, 32, 48), SEEDS[:2])
    for (name, kind), (points, disorder), n in product(TODAY.items(), SETS.items(), cells):
        for seed in seeds[:1] if points in ("lattice", "hexagonal", "relaxed") else seeds:
            yield MakerErrors(maker=name, kind=kind, points=disorder, cells=n, seed=seed)
    for name, kind in () if quick else TODAY.items():       # one seed: three sizes give no order
        yield MakerErrors(maker=name, kind=kind, points=SETS["lattice"], cells=24)


def wall_heat(quick: bool) -> Iterator[Case]:
    """Heat through plates on the same points; fewer rows for closed faces: 64 would cost minutes each."""
    sizes, seeds = ((8, 12, 16), (1,)) if quick else ((16, 32, 64), SEEDS)
    for maker, (points, disorder), rows in product((*SMOOTH, *FACES), SETS.items(), sizes):
        rows = rows if maker != "closed faces" or quick else 8 + rows//4
        for seed in seeds[:1] if points in ("lattice", "hexagonal", "relaxed") else seeds:
            yield WallHeat(maker=maker, points=disorder, cells=rows, seed=seed)
