"""Which runs there are: linear theory, growth rates of each solver, rolls in time, energies near onset.

Nothing depends on L. Size `quick` takes a minute, `paper` six on two cores; `fine` (twelve) has other numbers
of particles.
"""
from collections.abc import Iterator
from dataclasses import replace
from itertools import product

from continuum.fluid import ConstEta, ConstNu, IdealGas, VanDerWaals
from continuum.scene import RayleighBenard, Walls
from studies.build.spam import PRINTED, VARIANTS
from studies.kit.case import Case
from studies.kit.study import Part
from studies.onset.claims import ONSET_CLAIMS
from studies.onset.derive import derive
from studies.onset.figures import FIGURES
from studies.onset.rates import GridGrowth, LinearTheory, boussinesq_mac, compressible, pypde_compressible
from studies.onset.runs import LINES, GrowthRun, OnsetEnergies, SpamGrowth
from studies.onset.tables import ALL

Sizes = tuple[int, ...]
Numbers = tuple[float, ...]

PR = 2.0            # of Boussinesq fluids; heat moves isobarically in the gas, whose nu = kappa makes 2 of it
DIFFERENCES = (1.0, 0.5, 0.25, 0.1)
NEAR = (1500.0, 1600.0, 1650.0, 1700.0, 1750.0, 1800.0, 1900.0)
NEAR_SQUARE = (4700.0, 4900.0, 5000.0, 5100.0, 5300.0)
GRIDS = (16, 24, 32, 48, 64)
STRONG = (1400.0, 1600.0, 1700.0, 1800.0, 2000.0, 2200.0, 2600.0, 3000.0, 3400.0)
SHARES = tuple(sorted({share for line in LINES.values() for share in line}))
#: as printed, and with less of the static pressure that holds particles on a lattice: rolls grow earlier
PARTICLES = {
    PRINTED: (1600.0, 1800.0, 2200.0, 2600.0, 3000.0, 3400.0),
    VARIANTS["less-static-90"]: (1000.0, 1150.0, 1300.0, 1450.0, 1600.0, 1800.0),
}
KE = 4e-4           # of rolls of finite energy
#: scenes, whose Ra is set by the case
LAYER = RayleighBenard(ra=1700.0)
SQUARE = replace(LAYER, aspect=1.0, sides=Walls())
THEORY = LinearTheory(ras=tuple(sorted({*NEAR, *STRONG})), pr=PR)


def growth(sizes: Sizes, differences: Numbers) -> Iterator[GridGrowth]:
    """All grids; the gas of all kinds on KHP95's, at all temperature differences there."""
    fluid = replace(LAYER, pr=PR)
    yield GridGrowth(method="boussinesq", solver=boussinesq_mac, scene=fluid, sizes=sizes, ras=NEAR)
    gas = GridGrowth(method="compressible", solver=compressible, scene=SQUARE, sizes=sizes, ras=NEAR_SQUARE)
    yield gas
    for eos, law in product((IdealGas(), VanDerWaals()), (ConstEta, ConstNu)):
        layer = replace(LAYER, eos=eos, transport=law)
        for dT in differences:
            yield replace(gas, scene=replace(layer, T_hot=1 + dT/2, T_cold=1 - dT/2), ras=NEAR)
        yield replace(gas, method="pypde-compressible", solver=pypde_compressible, scene=layer, ras=NEAR)


def strong(ras: Numbers, rows: int) -> Iterator[GrowthRun]:
    """Rolls as strong as those of the particles, on the grid."""
    for ra in ras:
        yield GrowthRun(scene=RayleighBenard(ra=ra), rows=rows, ke=KE)


def particles(rows: int, seeds: Sizes = (1, 2, 3), every: int = 1) -> Iterator[SpamGrowth]:
    """Rolls among particles."""
    for variant, ras in PARTICLES.items():
        for ra, seed in product(ras[::every], seeds):
            layer = RayleighBenard(ra=ra, L=float(rows))
            yield SpamGrowth(scene=layer, variant=variant, seed=seed, ke=KE)


def energies(sizes: Sizes, shares: Numbers) -> Iterator[OnsetEnergies]:
    """KHP95's own way, in their layer and in the square."""
    for rows, box in product(sizes, (LAYER, SQUARE)):
        yield OnsetEnergies(scene=box, rows=rows, shares=shares)


def quick() -> Iterator[Case]:
    """Coarse grids, one seed."""
    yield THEORY
    yield from growth((12, 16, 24), (1.0, 0.5, 0.25))
    yield from energies((12, 16, 24), LINES[0.5][1::2])
    yield from strong(STRONG[::2], 16)
    yield from particles(16, seeds=(1,), every=2)


def paper() -> Iterator[Case]:
    """All grids, 1250 particles."""
    yield THEORY
    yield from growth(GRIDS, DIFFERENCES)
    yield from energies((30, 40, 50, 60), SHARES)
    yield from strong(STRONG, 32)
    yield from particles(25)


def fine() -> Iterator[Case]:
    """Other numbers of particles besides."""
    yield from paper()
    for rows in (16, 35, 50):
        yield from particles(rows)


def cases(size: str) -> list[Case]:
    """All cases of a size."""
    of_size = {"quick": quick, "paper": paper, "fine": fine}
    return [*of_size[size]()]


PART = Part(cases=cases, tables=ALL, derive=derive, figures=FIGURES, claims=ONSET_CLAIMS)
