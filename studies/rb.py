"""Rayleigh-Benard: do smooth particles converge on the equations of the gas, and what does KHP95 print that holds?

Scaling: spacing, mass and kB are 1, L = particle rows, g = dT/L, eta from Ra: energies then do not depend on L.
Sizes: `paper` (half an hour on two cores) has what the main figure and the verdicts need, `quick` (minutes) the same
path small, `fine` (hours) all variants, walls, resolutions.
Writes results/rb/*.csv and *.png and the rows of study rb in results/claims.csv.
"""
from collections.abc import Iterator
from typing import Any

from continuum.fluid import ConstNu, DenseFluid, VanDerWaals
from continuum.scene import Periodic, RayleighBenard, Walls
from studies.convection import tables
from studies.convection.claims import RB_CLAIMS
from studies.convection.cost import CompressibleStep, SpamStep
from studies.convection.derive import derive
from studies.convection.figures import figures
from studies.convection.grids import BoussinesqSteady, CompressibleApproach, CompressibleSteady, PypdeSteady
from studies.convection.spam import PRINTED, VARIANTS, SpamRun, Variant
from studies.kit.case import Case
from studies.kit.study import Study, main

LAYER: dict[str, Any] = {"aspect": 2.0, "sides": Periodic()}     # Fig. 5
BOX: dict[str, Any] = {"aspect": 1.0, "sides": Walls()}          # Fig. 6
NU: dict[str, Any] = {"transport": ConstNu}
VDW: dict[str, Any] = {"eos": VanDerWaals()}
DENSE: dict[str, Any] = {"eos": DenseFluid(), "pr": 1.5}    # C_V = 1.5: pr = 1.5 is the printed eta = k
SEEDS = (1, 2, 3)
RA = (1500.0, 2500.0, 5000.0, 10000.0, 20000.0)  # of the particles
LINE = (1500.0, 1750.0, 2000.0, 2500.0, 3000.0, 3500.0, 4200.0, 5000.0, 6000.0, 6830.0, 10000.0, 20000.0,
        50000.0)  # of the grids


def spam(ra: float, rows: int, seeds=SEEDS, variant: Variant = PRINTED, t_end=4500.0, mean_from=2000.0, keep="",
         **scene) -> Iterator[SpamRun]:
    """The same point for several seeds; only the first keeps its fields or particles."""
    where = RayleighBenard(ra=ra, L=float(rows), **(LAYER | scene))
    for seed in seeds:
        yield SpamRun(scene=where, variant=variant, seed=seed, t_end=t_end, mean_from=mean_from,
                      keep=keep if seed == seeds[0] else "")


def gas(ra: float, sizes: tuple[int, ...], keep="", **scene) -> CompressibleSteady:
    return CompressibleSteady(scene=RayleighBenard(ra=ra, **(LAYER | scene)), sizes=sizes, keep=keep)


def cases(size: str) -> list[Case]:
    """All cases of a size; `fine` has those of `paper` besides its own."""
    if size == "quick":
        return list(quick())
    return [*paper(), *(fine() if size == "fine" else ())]


def quick() -> Iterator[Case]:
    for ra in (1500.0, 5000.0, 10000.0):
        yield gas(ra, (12, 16, 24))
        yield BoussinesqSteady(ra=ra, pr=2.0, sizes=(12, 16, 24))
        yield from spam(ra, 16, t_end=900.0, mean_from=400.0, keep="all" if ra == 10000 else "")
    yield CompressibleApproach(scene=RayleighBenard(ra=1e4), rows=16, t_end=900.0)
    yield PypdeSteady(ra=5000.0, pr=2.0, sizes=(12, 16, 24))
    yield PypdeSteady(ra=5000.0, scene=RayleighBenard(ra=5000.0), sizes=(12, 16, 24))
    yield from speed((16,), (12, 16, 24))


def speed(particle_rows: tuple[int, ...], grid_rows: tuple[int, ...]) -> Iterator[Case]:
    """What a step costs, measured alone."""
    for rows in particle_rows:
        yield SpamStep(scene=RayleighBenard(ra=1e4, L=float(rows)))
    for rows in grid_rows:
        yield CompressibleStep(scene=RayleighBenard(ra=1e4), rows=rows)


def paper() -> Iterator[Case]:
    """Figs 5, 6, 8, 9, 12 and the numbers of Sec. VI."""
    for ra in LINE:
        yield gas(ra, (24, 32, 48), keep="fields" if ra == 10000 else "")
        for pr in (0.71, 1.0, 2.0, 7.0):
            yield BoussinesqSteady(ra=ra, pr=pr)
    for ra in RA:
        yield from spam(ra, 50, keep={1e4: "all", 5e3: "fields"}.get(ra, ""))
        yield from spam(ra, 35)
        yield from spam(ra, 25)
    for ra in (2000.0, 2500.0, 3500.0, 5000.0, 6830.0, 10000.0):
        yield gas(ra, (24, 32, 48), **NU)
        yield gas(ra, (24, 32, 48), **VDW)
    for ra in (2500.0, 5000.0, 10000.0):
        yield from spam(ra, 50, **NU)
        yield from spam(ra, 50, keep="fields" if ra == 10000 else "", **VDW)
    for ra in (5000.0, 7000.0, 10000.0, 20000.0):
        yield gas(ra, (24, 32, 48), **BOX)
        for rows in (40, 28, 20):
            yield from spam(ra, rows, **BOX)
    for ra in (5000.0, 10000.0):
        yield PypdeSteady(ra=ra, scene=RayleighBenard(ra=ra), sizes=(16, 24, 32, 48))
        for pr in (1.0, 7.0):
            yield PypdeSteady(ra=ra, pr=pr, sizes=(16, 24, 32, 48))
    yield from speed((16, 25, 35, 50, 70), (16, 24, 32, 48, 64))
    yield CompressibleApproach(scene=RayleighBenard(ra=1e4))
    yield from spam(10000.0, 50, variant=VARIANTS["printed-fixed-rows"], keep="all")
    yield from spam(10000.0, 16, seeds=(1,), keep="all", **VDW)      # Fig. 7: 512 particles
    yield gas(3000.0, (16, 24, 32), **DENSE)
    for name in ("printed", "printed-monaghan"):                     # Fig. 4: 512 particles, frozen
        yield from spam(3000.0, 16, variant=VARIANTS[name], keep="all", **DENSE)


def fine() -> Iterator[Case]:
    """Every variant at two sizes, finer particles, more Rayleigh numbers."""
    for variant in VARIANTS.values():
        for ra in (5000.0, 10000.0):
            for rows in (25, 50):
                in_paper = variant.name == "printed-fixed-rows" and (ra, rows) == (10000.0, 50)
                if variant != PRINTED and not in_paper:
                    yield from spam(ra, rows, variant=variant)
    for ra in (5000.0, 10000.0):
        yield from spam(ra, 70, t_end=6300.0, mean_from=2800.0)
        yield from spam(ra, 100, t_end=9000.0, mean_from=4000.0)


STUDY = Study(name="rb", cases=cases, tables=tables.ALL, derive=derive, figures=figures, claims=RB_CLAIMS)

if __name__ == "__main__":
    main(STUDY)
