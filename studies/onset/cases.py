"""Onset of convection: the critical Rayleigh number by linear theory, by growth rates of each solver, and by the zero of the
straight line of K against Ra^-1/2, extrapolated in L^-2 (KHP95, Sec. V); how many figures does each really give?

Growth rates are per free-fall time, energies in KHP95's units; nothing depends on L. Size `quick` takes a minute, `paper` six
on two cores; `fine` (twelve) has more particles and weaker rolls.
"""
from collections.abc import Iterator
from dataclasses import replace
from typing import Any

from continuum.fluid import ConstEta, ConstNu, IdealGas, VanDerWaals
from continuum.scene import Periodic, RayleighBenard, Walls
from studies.build.spam import PRINTED, VARIANTS, Variant
from studies.kit.case import Case
from studies.kit.study import Part
from studies.onset.claims import ONSET_CLAIMS
from studies.onset.figures import FIGURES
from studies.onset.rates import (
    GridGrowth,
    LinearTheory,
    boussinesq_mac,
    compressible,
    pypde_boussinesq,
    pypde_compressible,
)
from studies.onset.runs import LINES, GrowthRun, OnsetEnergies, SpamGrowth
from studies.onset.tables import ALL, derive

PR = 2.0            # of Boussinesq fluids; heat moves isobarically in the gas, whose nu = kappa makes 2 of it
DIFFERENCES = (1.0, 0.5, 0.25, 0.1)
NEAR = (1500.0, 1600.0, 1650.0, 1700.0, 1750.0, 1800.0, 1900.0)
NEAR_SQUARE = (4700.0, 4900.0, 5000.0, 5100.0, 5300.0)
GRIDS = (16, 24, 32, 48, 64)
STRONG = (1400.0, 1600.0, 1700.0, 1800.0, 2000.0, 2200.0, 2600.0, 3000.0, 3400.0)
SHARES = tuple(sorted({share for line in LINES.values() for share in line}))
#: as printed, and with less of the static pressure that holds particles on a lattice, where rolls grow earlier
PARTICLES = {PRINTED: (1600.0, 1800.0, 2200.0, 2600.0, 3000.0, 3400.0),
             VARIANTS["less-static-90"]: (1000.0, 1150.0, 1300.0, 1450.0, 1600.0, 1800.0)}
FROZEN = (2200.0, 2600.0, 3000.0, 3400.0, 4200.0, 5000.0)   # where weaker rolls among printed particles may begin to grow


def scene(dT: float = 1.0, **more: Any) -> RayleighBenard:
    """The layer around T = 1; its Ra is set by the case."""
    box: dict[str, Any] = {"aspect": 2.0, "sides": Periodic(), **more}
    return RayleighBenard(ra=1700.0, T_hot=1 + dT/2, T_cold=1 - dT/2, **box)


BOUSSINESQ = scene(pr=PR)
SQUARE = scene(aspect=1.0, sides=Walls())


def growth(sizes: tuple[int, ...], differences: tuple[float, ...]) -> Iterator[GridGrowth]:
    """All grids; the gas of all kinds on KHP95's, at all temperature differences there."""
    for method, solver in (("boussinesq", boussinesq_mac), ("pypde-boussinesq", pypde_boussinesq)):
        yield GridGrowth(method=method, solver=solver, scene=BOUSSINESQ, sizes=sizes, ras=NEAR)
    gas = GridGrowth(method="compressible", solver=compressible, scene=SQUARE, sizes=sizes, ras=NEAR_SQUARE)
    yield gas
    for eos in (IdealGas(), VanDerWaals()):
        for law in (ConstEta, ConstNu):
            for dT in differences:
                yield replace(gas, scene=scene(dT, eos=eos, transport=law), ras=NEAR)
            yield GridGrowth(method="pypde-compressible", solver=pypde_compressible,
                             scene=scene(eos=eos, transport=law), sizes=sizes, ras=NEAR)


def strong(ke: float, ras: tuple[float, ...] = STRONG, rows: int = 32) -> Iterator[GrowthRun]:
    """Rolls as strong as those of the particles, on the grid."""
    for ra in ras:
        yield GrowthRun(scene=RayleighBenard(ra=ra), rows=rows, ke=ke)


def particles(ke: float, rows: int, ras: tuple[float, ...], seeds: tuple[int, ...] = (1, 2, 3),
              variant: Variant = PRINTED) -> Iterator[SpamGrowth]:
    """Rolls among particles."""
    for ra in ras:
        for seed in seeds:
            yield SpamGrowth(scene=RayleighBenard(ra=ra, L=float(rows)), variant=variant, seed=seed, ke=ke)


def energies(sizes: tuple[int, ...], shares: tuple[float, ...]) -> Iterator[OnsetEnergies]:
    """KHP95's own way, in their layer and in the square."""
    for rows in sizes:
        for box in (scene(), SQUARE):
            yield OnsetEnergies(scene=box, rows=rows, shares=shares)


def cases(size: str) -> list[Case]:
    """All cases of a size; `fine` has those of `paper` besides its own."""
    if size == "quick":
        return list(quick())
    return [*paper(), *(fine() if size == "fine" else ())]


def theory() -> LinearTheory:
    """At all Ra."""
    return LinearTheory(ras=tuple(sorted({*NEAR, *STRONG})), pr=PR)


def quick() -> Iterator[Case]:
    """Coarse grids, one seed."""
    yield theory()
    yield from growth((12, 16, 24), (1.0, 0.5, 0.25))
    yield from energies((12, 16, 24), LINES[0.5][1::2])
    yield from strong(4e-4, STRONG[::2], rows=16)
    for variant, ras in PARTICLES.items():
        yield from particles(4e-4, 16, ras[::2], seeds=(1,), variant=variant)


def paper() -> Iterator[Case]:
    """All grids, 1250 particles."""
    yield theory()
    yield from growth(GRIDS, DIFFERENCES)
    yield from energies((30, 40, 50, 60), SHARES)
    yield from strong(4e-4)
    for variant, ras in PARTICLES.items():
        yield from particles(4e-4, 25, ras, variant=variant)


def fine() -> Iterator[Case]:
    """Other numbers of particles, weaker rolls."""
    yield from strong(1e-4)
    for rows in (16, 35, 50):
        for variant, ras in PARTICLES.items():
            yield from particles(4e-4, rows, ras, variant=variant)
    for rows in (25, 35):
        yield from particles(1e-4, rows, FROZEN)


PART = Part(cases=cases, tables=ALL, derive=derive, figures=FIGURES, claims=ONSET_CLAIMS)
