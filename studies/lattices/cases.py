"""KHP95's own hard cases, by size."""
from collections.abc import Iterator
from dataclasses import replace
from itertools import product

import numpy as np

from continuum.fluid import DenseFluid, IdealGas, VanDerWaals
from particles.weights import Lucy, Monaghan, WendlandC2, WendlandC4
from studies.hardcases.interface.runs import Interface
from studies.hardcases.square.runs import Square
from studies.hardcases.tube.spam import ShockTube
from studies.kit.case import Case
from studies.kit.study import Part
from studies.lattices import claims as hard_claims
from studies.lattices import derive as hard_derive
from studies.lattices import figures as hard_figures
from studies.lattices import tables as hard_tables
from studies.lattices.freezing import Freezing
from studies.lattices.growth import Crystal, Growth, Onset
from studies.lattices.moduli import Moduli
from studies.lattices.molecules import METHODS, Reversal, Twins
from studies.lattices.occupancy import Fate
from studies.lattices.waves import CELLS

WEIGHTS = (Lucy, Monaghan, WendlandC2)
WIDEST = 24.0           # range whose modulus is summed
MORE_SEEDS = 16         # of the longest viscous tube, whose ringing is near to what is asked
HEXAGONAL = Crystal(lattice="hexagonal", cells=(14, 8), weight=Lucy, h=3.0, eos=IdealGas())
SQUARE = replace(HEXAGONAL, lattice="square", cells=(15, 15))
#: a van der Waals fluid on a hexagonal lattice that an ideal gas would keep
COLD = replace(HEXAGONAL, h=2.5, eos=VanDerWaals())


def moduli(step: float) -> Iterator[Case]:
    """Ranges from 2 to 24 spacings, by so much."""
    ranges = tuple(round(float(h), 3) for h in np.arange(2, WIDEST + step/2, step))
    yield from (Moduli(lattice=kind, weight=weight, h=ranges) for kind, weight in product(CELLS, WEIGHTS))


def growth() -> Iterator[Case]:
    """The lattices that runs begin and freeze on; pairs; fluids under negative pressure."""
    yield from (Growth(crystal=replace(at, weight=weight)) for at, weight in product((HEXAGONAL, SQUARE), WEIGHTS))
    yield from (Growth(crystal=replace(HEXAGONAL, weight=Monaghan, h=h)) for h in (2.6, 2.8))
    for T, rho in ((0.1, 1.0), (0.15, 1.0), (0.2, 1.0), (0.15, 1.2), (0.2, 1.2)):
        yield Growth(crystal=replace(COLD, T=T, rho=rho))


def onsets(seeds: tuple[int, ...]) -> Iterator[Case]:
    """In the range of the weight, and in the temperature of van der Waals fluids."""
    for (start, weight, stable, unstable), seed in product((
            (HEXAGONAL, Monaghan, 2.2, 2.6), (HEXAGONAL, Lucy, 2.6, 2.8), (HEXAGONAL, WendlandC2, 2.8, 3.0),
            (SQUARE, Monaghan, 2.4, 2.6)), seeds):
        yield Onset(crystal=replace(start, weight=weight), parameter="h", stable=stable, unstable=unstable, seed=seed)
    for (weight, h), rho, seed in product(((Lucy, 2.5), (WendlandC2, 2.5), (WendlandC4, 3.0)), (1.0, 1.2), seeds):
        yield Onset(crystal=replace(COLD, weight=weight, h=h, rho=rho), parameter="T", stable=0.4, unstable=0.15, seed=seed)


def fates(ranges: tuple[float, ...], seeds: tuple[int, ...]) -> Iterator[Case]:
    """One a site or two?"""
    yield from (Fate(weight=weight, h=h, seed=seed) for weight, h, seed in product(WEIGHTS, ranges, seeds))


def squares() -> Iterator[Case]:
    """Both weights and fluids with the printed viscosities, what pairs in the gas also nearer to onset, which is at 5012."""
    for (eos, ra), weight in product(((IdealGas(), 67150.0), (DenseFluid(), 511200.0)), (Monaghan, Lucy)):
        yield Square(eos=eos, weight=weight, ra=ra, t_end=25.0, mean_from=15.0)
    yield Square(weight=Monaghan, ra=1e4, t_end=40.0, mean_from=30.0)


def freezing() -> Iterator[Case]:
    """The gas of Fig. 4's scene with both weights, at another Ra, and the dense fluid; with a quarter of the step, too."""
    yield from (Freezing(eos=IdealGas(), weight=weight, seed=seed) for weight, seed in product((Lucy, Monaghan), (1, 2, 3)))
    for step in (1.0, 0.25):
        yield Freezing(eos=IdealGas(), weight=Lucy, ra=1e4, step=step)
        yield Freezing(eos=DenseFluid(), weight=Lucy, step=step)
    yield Freezing(eos=IdealGas(), weight=Lucy, step=0.25)


def newton(times: tuple[float, ...], samples: int, seeds: tuple[int, ...]) -> Iterator[Case]:
    """Paths of molecules, and back."""
    yield Twins(weight=Lucy, samples=samples)
    yield from (Reversal(integrator=name, weight=Lucy, times=times, seed=seed) for name, seed in product(METHODS, seeds))


def shocks(lengths: tuple[float, ...], scales: tuple[tuple[float, float, int], ...],
           seeds: tuple[int, ...]) -> Iterator[Case]:
    """Tubes without and with viscosity, profiles of the longest; interfaces, (scale, k a, number of seeds)."""
    for L, eta, seed in product(lengths, (0.0, 0.5), seeds):
        yield ShockTube(L=L, eta=eta, seed=seed, keep=L == max(lengths) and seed == min(seeds))
    yield from (Interface(scale=scale, steep=steep, seed=seed) for scale, steep, last in scales for seed in range(1, last + 1))


def cases(size: str) -> list[Case]:
    """All of them; `quick` is for trying the path out."""
    if size == "quick":
        return [*moduli(1.0), *list(growth())[::5], *list(onsets((1,)))[::9], *fates((3.0,), (1,)), *newton((5.0, 20.0), 5, (1,)),
                *shocks((12.0, 15.0, 18.0), ((0.5, 0.25, 1),), (1,))]
    return [*moduli(0.1), *growth(), *onsets((1,)), *fates((2.0, 2.4, 2.8, 3.0, 3.4, 4.0), (1, 2)),
            *fates((3.0,), (3, 4, 5, 6)), *squares(), *freezing(),
            *newton((5.0, 10.0, 20.0, 40.0, 60.0, 80.0, 100.0), 15, (1, 2)),
            *shocks((24.0, 36.0, 48.0, 72.0, 96.0, 144.0, 192.0),
                    ((1.0, 0.25, 3), (1.0, 0.75, 3), (2.0, 0.25, 8), (4.0, 0.25, 7)), (1, 2, 3)),
            *(ShockTube(L=192.0, eta=0.5, seed=seed) for seed in range(4, MORE_SEEDS + 1))]


PART = Part(cases=cases, tables=hard_tables.ALL, derive=hard_derive.derive, claims=hard_claims.CLAIMS,
            figures=hard_figures.figures)
