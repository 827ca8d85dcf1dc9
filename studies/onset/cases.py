"""Cases of the study onset: linear theory, growth rates, rolls in time, steady energies near onset.

No result depends on L. Size `quick` takes a minute, `paper` six on two cores. `fine` has more numbers of
particles and takes twelve.
"""
from collections.abc import Iterator, Sequence
from dataclasses import replace
from itertools import chain, product

from continuum.fluid import ConstNu, VanDerWaals
from continuum.scene import RayleighBenard, Walls
from studies.build.spam import PRINTED, VARIANTS
from studies.kit.case import Case
from studies.onset.rates import Branch, GridGrowth, LinearTheory
from studies.onset.runs import LINES, GrowthRun, OnsetEnergies, SpamGrowth

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
#: with the other transport law, and with a small difference of temperature
OTHERS = (replace(LAYER, transport=ConstNu), replace(LAYER, T_hot=1.05, T_cold=0.95))
#: along branches, from rest: the first tell the law of the amplitude
ARCS = (0.002, 0.002, 0.004, 0.008, 0.016, 0.032, 0.064, *8*(0.1,))


def growth(sizes: tuple[int, ...]) -> Iterator[GridGrowth]:
    """Growth rates of the gas in the square and in layers."""
    yield GridGrowth(scene=SQUARE, sizes=sizes, ras=NEAR_SQUARE)
    for layer in (LAYER, *OTHERS, replace(LAYER, eos=VanDerWaals())):
        yield GridGrowth(scene=layer, sizes=sizes, ras=NEAR)


def particles(rows: int, seeds: Sequence[int] = (1, 2, 3), every: int = 1) -> Iterator[SpamGrowth]:
    """Growth rates of rolls among particles."""
    for variant, ras in PARTICLES.items():
        for ra, seed in product(ras[::every], seeds):
            yield SpamGrowth(scene=replace(LAYER, ra=ra, L=float(rows)), variant=variant, seed=seed, ke=KE)


def cases(size: str) -> list[Case]:
    """`quick` has coarse grids and one seed; `fine` other numbers of particles besides."""
    quick = size == "quick"
    lines, shares = ((12, 16, 24), LINES[0.5][1::2]) if quick else ((30, 40, 50, 60), SHARES)
    energies = (OnsetEnergies(scene=box, rows=rows, shares=shares)
                for rows, box in product(lines, (LAYER, SQUARE)))
    others = (OnsetEnergies(scene=box, rows=rows, shares=LINES[0.5])        # lines as the paper draws them
              for rows, box in product(lines[:3], () if quick else OTHERS))
    strong = (GrowthRun(scene=replace(LAYER, ra=ra), rows=16 if quick else 32, ke=KE)
              for ra in STRONG[::2 if quick else 1])
    rolls = [particles(16, seeds=(1,), every=2)] if quick else [particles(25)]
    if size == "fine":
        rolls += [particles(rows) for rows in (16, 35, 50)]
    boxes = product((0.71, 1.0), (1.0, 2.0))      # Pr, width
    branches = ([Branch(pr=1.0, width=2.0, functions=8, steps=ARCS[:3])] if quick else
                [Branch(pr=pr, width=width, functions=16, steps=ARCS) for pr, width in boxes])
    return [LinearTheory(), *growth((12, 16, 24) if quick else GRIDS), *energies, *others, *strong,
            *chain(*rolls), *branches]
