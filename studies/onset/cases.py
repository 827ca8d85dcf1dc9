"""Onset of convection: the critical Rayleigh number by linear theory, by growth rates of each time-dependent solver, and
by the zero of the straight line of K against Ra^-1/2, extrapolated in L^-2 (KHP95, Sec. V); how many figures does each
really give?

Scaling: growth rates per free-fall time, energies in KHP95's units; nothing depends on L.
Sizes: `quick` (a minute) and `paper` (six minutes on two cores) have all grids and the particles at 16 and at 25 rows,
`fine` (twelve) more particles and weaker rolls. Writes results/onset/*.csv and *.png and the rows of study onset in
results/claims.csv.
"""
from collections.abc import Iterator
from typing import Any

from continuum.fluid import ConstEta, ConstNu, IdealGas, VanDerWaals
from continuum.scene import Periodic, RayleighBenard, Walls
from studies.build.spam import PRINTED, VARIANTS, Variant
from studies.kit.case import Case
from studies.kit.study import Part
from studies.onset import tables as onset_tables
from studies.onset.claims import ONSET_CLAIMS
from studies.onset.derive import derive
from studies.onset.figures import FIGURES
from studies.onset.runs import LINES, Energies, Growth, GrowthRun, LinearTheory, SpamGrowth

LAYER: dict[str, Any] = {"aspect": 2.0, "sides": Periodic()}
SQUARE: dict[str, Any] = {"aspect": 1.0, "sides": Walls()}
FLUIDS: list[dict[str, Any]] = [{"eos": eos, "transport": law} for eos in (IdealGas(), VanDerWaals())
                                for law in (ConstEta, ConstNu)]
PR = 2.0            # of Boussinesq fluids; heat moves isobarically in the gas, whose nu = kappa makes 2 of it
DIFFERENCES = (1.0, 0.5, 0.25, 0.1)
NEAR = (1500.0, 1600.0, 1650.0, 1700.0, 1750.0, 1800.0, 1900.0)
NEAR_SQUARE = (4700.0, 4900.0, 5000.0, 5100.0, 5300.0)
GRIDS = (16, 24, 32, 48, 64)
RUN_RA = (1600.0, 1650.0, 1700.0, 1750.0, 1800.0)
STRONG = (1400.0, 1600.0, 1700.0, 1800.0, 2000.0, 2200.0, 2600.0, 3000.0, 3400.0)
SHARES = tuple(sorted({share for line in LINES.values() for share in line}))
#: as printed, and with less of the static pressure that holds particles on a lattice, where rolls grow earlier
PARTICLES = {PRINTED: (1600.0, 1800.0, 2200.0, 2600.0, 3000.0, 3400.0),
             VARIANTS["less-static-90"]: (1000.0, 1150.0, 1300.0, 1450.0, 1600.0, 1800.0)}
FROZEN = (2200.0, 2600.0, 3000.0, 3400.0, 4200.0, 5000.0)   # where weaker rolls among printed particles may begin to grow


def scene(dT: float = 1.0, **more) -> RayleighBenard:
    """The layer around T = 1; its Ra is set by the case."""
    return RayleighBenard(ra=1700.0, T_hot=1 + dT/2, T_cold=1 - dT/2, **(LAYER | more))


def growth(sizes=GRIDS, ras=NEAR, differences=DIFFERENCES) -> Iterator[Growth]:
    """All grids; the gas of all kinds on KHP95's and the ideal one on py-pde's."""
    for method in ("boussinesq", "pypde-boussinesq"):
        yield Growth(method=method, scene=scene(pr=PR), sizes=sizes, ras=ras)
    for fluid in FLUIDS:
        for dT in differences:
            yield Growth(method="compressible", scene=scene(dT, **fluid), sizes=sizes, ras=ras)
        yield Growth(method="pypde-compressible", scene=scene(**fluid), sizes=sizes, ras=ras)


def square_growth(sizes=GRIDS) -> Iterator[Growth]:
    yield Growth(method="boussinesq", scene=scene(pr=PR, **SQUARE), sizes=sizes, ras=NEAR_SQUARE)
    for transport in (ConstEta, ConstNu):
        yield Growth(method="compressible", scene=scene(transport=transport, **SQUARE), sizes=sizes, ras=NEAR_SQUARE)


def runs(methods=("boussinesq", "compressible", "pypde-boussinesq", "pypde-compressible"), rows=16,
         ras=RUN_RA) -> Iterator[GrowthRun]:
    """Weak rolls in runs in time, to be compared with the same grid's linearised rates."""
    for method in methods:
        pr = PR if method.endswith("boussinesq") else 1.0
        for ra in ras:
            yield GrowthRun(method=method, scene=RayleighBenard(ra=ra, pr=pr), rows=rows)


def strong(ke: float, ras=STRONG, rows=32) -> Iterator[GrowthRun]:
    """Rolls as strong as those of the particles, on the grid."""
    for ra in ras:
        yield GrowthRun(method="compressible", scene=RayleighBenard(ra=ra), rows=rows, ke=ke, after=2.0, until=30.0)


def particles(ke: float, rows: int, ras: tuple[float, ...], seeds=(1, 2, 3), variant: Variant = PRINTED) -> Iterator[SpamGrowth]:
    for ra in ras:
        for seed in seeds:
            yield SpamGrowth(scene=RayleighBenard(ra=ra, L=float(rows)), variant=variant, seed=seed, ke=ke)


def energies(sizes=(30, 40, 50, 60), shares=SHARES) -> Iterator[Energies]:
    """KHP95's own way."""
    for rows in sizes:
        yield Energies(method="boussinesq", scene=scene(pr=PR), rows=rows, shares=shares)
        for fluid in FLUIDS[:3]:
            yield Energies(method="compressible", scene=scene(**fluid), rows=rows, shares=shares)
        variants: tuple[dict[str, Any], ...] = (SQUARE, {"dT": 0.1}, {"dT": 0.1, "transport": ConstNu})
        for more in variants:
            yield Energies(method="compressible", scene=scene(**more), rows=rows, shares=shares if more is SQUARE else LINES[0.5])


def cases(size: str) -> list[Case]:
    """All cases of a size; `fine` has those of `paper` besides its own."""
    if size == "quick":
        return list(quick())
    return [*paper(), *(fine() if size == "fine" else ())]


def quick() -> Iterator[Case]:
    yield LinearTheory(ras=tuple(sorted({*NEAR, *STRONG})), prs=(1.0, PR))
    yield from growth((12, 16, 24), differences=(1.0, 0.5, 0.25))
    yield from square_growth((12, 16, 24))
    yield from runs(("boussinesq", "compressible"), rows=12, ras=RUN_RA[::2])
    yield from energies((12, 16, 24), LINES[0.5][1::2])
    yield from strong(4e-4, STRONG[::2], rows=16)
    for variant, ras in PARTICLES.items():
        yield from particles(4e-4, 16, ras[::2], seeds=(1,), variant=variant)


def paper() -> Iterator[Case]:
    yield LinearTheory(ras=tuple(sorted({*NEAR, *STRONG})), prs=(1.0, PR))
    yield from growth()
    yield from square_growth()
    yield from runs()
    yield from energies()
    yield from strong(4e-4)
    for variant, ras in PARTICLES.items():
        yield from particles(4e-4, 25, ras, variant=variant)


def fine() -> Iterator[Case]:
    yield from strong(1e-4)
    for rows in (16, 35, 50):
        for variant, ras in PARTICLES.items():
            yield from particles(4e-4, rows, ras, variant=variant)
    for rows in (25, 35):
        yield from particles(1e-4, rows, FROZEN)


PART = Part(cases=cases, tables=onset_tables.ALL, derive=derive, figures=FIGURES, claims=ONSET_CLAIMS)
