"""Which runs there are: linear theory, growth rates of each solver, rolls in time, energies near onset.

Nothing depends on L. Size `quick` takes a minute, `paper` six on two cores; `fine` (twelve) has other numbers
of particles.
"""
from collections.abc import Iterator
from dataclasses import replace
from itertools import product
from typing import Any

from continuum.fluid import ConstEta, ConstNu, IdealGas, VanDerWaals
from continuum.scene import Periodic, RayleighBenard, Walls
from studies.build.spam import PRINTED, VARIANTS
from studies.kit.case import Case
from studies.kit.study import Part
from studies.onset.claims import ONSET_CLAIMS
from studies.onset.figures import FIGURES
from studies.onset.rates import GridGrowth, LinearTheory, boussinesq_mac, compressible, pypde_compressible
from studies.onset.runs import LINES, GrowthRun, OnsetEnergies, SpamGrowth
from studies.onset.tables import ALL, derive

PR = 2.0            # of Boussinesq fluids; heat moves isobarically in the gas, whose nu = kappa makes 2 of it
DIFFERENCES = (1.0, 0.5, 0.25, 0.1)
NEAR = (1500.0, 1600.0, 1650.0, 1700.0, 1750.0, 1800.0, 1900.0)
NEAR_SQUARE = (4700.0, 4900.0, 5000.0, 5100.0, 5300.0)
GRIDS = (16, 24, 32, 48, 64)
STRONG = (1400.0, 1600.0, 1700.0, 1800.0, 2000.0, 2200.0, 2600.0, 3000.0, 3400.0)
SHARES = tuple(sorted({share for line in LINES.values() for share in line}))
#: as printed, and with less of the static pressure that holds particles on a lattice: rolls grow earlier
PARTICLES = {PRINTED: (1600.0, 1800.0, 2200.0, 2600.0, 3000.0, 3400.0),
             VARIANTS["less-static-90"]: (1000.0, 1150.0, 1300.0, 1450.0, 1600.0, 1800.0)}
KE = 4e-4           # of rolls of finite energy


def scene(dT: float = 1.0, **more: Any) -> RayleighBenard:
    """The layer around T = 1; its Ra is set by the case."""
    box: dict[str, Any] = {"aspect": 2.0, "sides": Periodic(), **more}
    return RayleighBenard(ra=1700.0, T_hot=1 + dT/2, T_cold=1 - dT/2, **box)


SQUARE = scene(aspect=1.0, sides=Walls())


def growth(sizes: tuple[int, ...], differences: tuple[float, ...]) -> Iterator[GridGrowth]:
    """All grids; the gas of all kinds on KHP95's, at all temperature differences there."""
    yield GridGrowth(method="boussinesq", solver=boussinesq_mac, scene=scene(pr=PR), sizes=sizes, ras=NEAR)
    gas = GridGrowth(method="compressible", solver=compressible, scene=SQUARE, sizes=sizes, ras=NEAR_SQUARE)
    yield gas
    for eos in (IdealGas(), VanDerWaals()):
        for law in (ConstEta, ConstNu):
            for dT in differences:
                yield replace(gas, scene=scene(dT, eos=eos, transport=law), ras=NEAR)
            yield GridGrowth(method="pypde-compressible", solver=pypde_compressible,
                             scene=scene(eos=eos, transport=law), sizes=sizes, ras=NEAR)


def strong(ras: tuple[float, ...], rows: int) -> Iterator[GrowthRun]:
    """Rolls as strong as those of the particles, on the grid."""
    for ra in ras:
        yield GrowthRun(scene=RayleighBenard(ra=ra), rows=rows, ke=KE)


def particles(rows: int, seeds: tuple[int, ...] = (1, 2, 3), every: int = 1) -> Iterator[SpamGrowth]:
    """Rolls among particles."""
    for variant, ras in PARTICLES.items():
        for ra, seed in product(ras[::every], seeds):
            layer = RayleighBenard(ra=ra, L=float(rows))
            yield SpamGrowth(scene=layer, variant=variant, seed=seed, ke=KE)


def energies(sizes: tuple[int, ...], shares: tuple[float, ...]) -> Iterator[OnsetEnergies]:
    """KHP95's own way, in their layer and in the square."""
    for rows in sizes:
        for box in (scene(), SQUARE):
            yield OnsetEnergies(scene=box, rows=rows, shares=shares)


def cases(size: str) -> list[Case]:
    """All cases of a size; `fine` has those of `paper` besides its own."""
    if size == "quick":
        return [*quick()]
    return [*paper(), *fine()] if size == "fine" else [*paper()]


def theory() -> LinearTheory:
    """At all Ra."""
    return LinearTheory(ras=tuple(sorted({*NEAR, *STRONG})), pr=PR)


def quick() -> Iterator[Case]:
    """Coarse grids, one seed."""
    yield theory()
    yield from growth((12, 16, 24), (1.0, 0.5, 0.25))
    yield from energies((12, 16, 24), LINES[0.5][1::2])
    yield from strong(STRONG[::2], 16)
    yield from particles(16, seeds=(1,), every=2)


def paper() -> Iterator[Case]:
    """All grids, 1250 particles."""
    yield theory()
    yield from growth(GRIDS, DIFFERENCES)
    yield from energies((30, 40, 50, 60), SHARES)
    yield from strong(STRONG, 32)
    yield from particles(25)


def fine() -> Iterator[Case]:
    """Other numbers of particles."""
    for rows in (16, 35, 50):
        yield from particles(rows)


PART = Part(cases=cases, tables=ALL, derive=derive, figures=FIGURES, claims=ONSET_CLAIMS)
