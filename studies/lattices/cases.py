"""Which cases, by size."""
from collections.abc import Iterator
from dataclasses import replace
from itertools import product

import numpy as np

from continuum.fluid import DenseFluid, IdealGas, VanDerWaals
from particles.weights import Lucy, Monaghan, Weight, WendlandC2, WendlandC4
from studies.kit.case import Case
from studies.lattices.crystals import Crystal, Growth, Moduli, Onset
from studies.lattices.freezing import Fate, Freezing
from studies.lattices.molecules import METHODS, Reversal, Twins
from studies.lattices.sound import Ringing, Speed
from studies.lattices.waves import CELLS

WEIGHTS: tuple[type[Weight], ...] = (Lucy, Monaghan, WendlandC2)
WIDEST = 24.0           # range whose modulus is summed
HEXAGONAL = Crystal(lattice="hexagonal", cells=(14, 8), weight=Lucy, h=3.0, eos=IdealGas())
SQUARE = replace(HEXAGONAL, lattice="square", cells=(15, 15))
#: a van der Waals fluid on a hexagonal lattice that an ideal gas would keep
COLD = replace(HEXAGONAL, h=2.5, eos=VanDerWaals())
#: (crystal, weight, stable range, unstable range)
UNSTABLE_RANGES = ((HEXAGONAL, Monaghan, 2.2, 2.6), (HEXAGONAL, Lucy, 2.6, 2.8),
                   (HEXAGONAL, WendlandC2, 2.8, 3.0), (SQUARE, Monaghan, 2.4, 2.6))
WAVE = Ringing(lattice="square", weight=Lucy, length=64)
#: waves of many lengths on lattices that melt
LENGTHS = ((WAVE, (48, 56, 64, 72, 80)), (replace(WAVE, weight=Monaghan), (36, 40, 44, 48, 52)),
           (replace(WAVE, lattice="hexagonal"), (192, 224, 256, 288)))
#: lattices that keep a wave
KEPT = (replace(WAVE, h=2.5, length=128), replace(WAVE, weight=WendlandC2, length=128))


def cases(size: str) -> list[Case]:
    """All of them; `quick` is for trying the path out."""
    if size == "quick":
        return [*moduli(1.0), *list(growth())[::5], *list(onsets())[::9], *fates((3.0,), (1,)),
                *newton((5.0, 20.0), 5, (1,)), *speeds(), *(replace(LENGTHS[1][0], length=L) for L in (40, 44, 48))]
    return [*moduli(0.1), *growth(), *onsets(),
            *fates((2.0, 2.4, 2.8, 3.0, 3.4, 4.0), (1, 2)), *fates((3.0,), (3, 4, 5, 6)), *freezing(),
            *newton((5.0, 10.0, 20.0, 40.0, 60.0, 80.0, 100.0), 15, (1, 2)), *speeds(), *ringing()]


def moduli(step: float) -> Iterator[Case]:
    """Ranges from 2 to 24 spacings, by so much."""
    ranges = tuple(round(float(h), 3) for h in np.arange(2, WIDEST + step/2, step))
    yield from (Moduli(lattice=kind, weight=weight, h=ranges) for kind, weight in product(CELLS, WEIGHTS))


def growth() -> Iterator[Case]:
    """The lattices that runs begin and freeze on; pairs; fluids under negative pressure."""
    for crystal, weight in product((HEXAGONAL, SQUARE), WEIGHTS):
        yield Growth(crystal=replace(crystal, weight=weight))
    for h in (2.6, 2.8):
        yield Growth(crystal=replace(HEXAGONAL, weight=Monaghan, h=h))
    for T, rho in ((0.1, 1.0), (0.15, 1.0), (0.2, 1.0), (0.15, 1.2), (0.2, 1.2)):
        yield Growth(crystal=replace(COLD, T=T, rho=rho))


def onsets() -> Iterator[Case]:
    """In the range of the weight, and in the temperature of van der Waals fluids."""
    for crystal, weight, stable, unstable in UNSTABLE_RANGES:
        yield Onset(crystal=replace(crystal, weight=weight), parameter="h", stable=stable, unstable=unstable)
    for (kind, h), rho in product(((Lucy, 2.5), (WendlandC2, 2.5), (WendlandC4, 3.0)), (1.0, 1.2)):
        crystal = replace(COLD, weight=kind, h=h, rho=rho)
        yield Onset(crystal=crystal, parameter="T", stable=0.4, unstable=0.15)


def fates(ranges: tuple[float, ...], seeds: tuple[int, ...]) -> Iterator[Case]:
    """One a site or two?"""
    yield from (Fate(weight=weight, h=h, seed=seed) for weight, h, seed in product(WEIGHTS, ranges, seeds))


def freezing() -> Iterator[Case]:
    """The gas of Fig. 4 with both weights, at another Ra, the dense fluid; with shorter steps, too."""
    for weight, seed in product((Lucy, Monaghan), (1, 2, 3)):
        yield Freezing(eos=IdealGas(), weight=weight, seed=seed)
    for step in (1.0, 0.25):
        yield Freezing(eos=IdealGas(), weight=Lucy, ra=1e4, step=step)
        yield Freezing(eos=DenseFluid(), weight=Lucy, step=step)
    yield Freezing(eos=IdealGas(), weight=Lucy, step=0.25)


def newton(times: tuple[float, ...], samples: int, seeds: tuple[int, ...]) -> Iterator[Case]:
    """Paths of molecules, and back."""
    yield Twins(weight=Lucy, samples=samples)
    yield from (Reversal(integrator=name, weight=Lucy, times=times, seed=seed) for name, seed in product(METHODS, seeds))


def speeds() -> Iterator[Case]:
    """Of sound."""
    yield from (Speed(lattice=kind, weight=weight) for kind, weight in product(("square",
                                                                                "hexagonal"), WEIGHTS))


def ringing() -> Iterator[Case]:
    """Waves of many lengths, each rounded off in three ways."""
    for wave, lengths in LENGTHS:
        yield from (replace(wave, length=L, seed=seed) for L, seed in product(lengths, (1, 2, 3)))
    yield from KEPT
