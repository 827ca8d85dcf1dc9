"""Which cases, by size, and the tables that they fill. Lengths in spacings, masses of particles, T = 1."""
from collections.abc import Iterator
from dataclasses import replace
from itertools import product

from continuum.fluid import IdealGas, VanDerWaals
from particles.weights import Lucy, Monaghan, Weight, WendlandC2, WendlandC4
from studies.kit.case import Case
from studies.kit.table import Table
from studies.lattices.crystals import LATTICES, Crystal, LatticeGrowth, Onset, Speed
from studies.lattices.frozen_flow import Freezing
from studies.lattices.molecules import METHODS, Fate, Reversal, Twins

Numbers = tuple[float, ...]
Seeds = tuple[int, ...]

WEIGHTS: tuple[type[Weight], ...] = (Lucy, Monaghan, WendlandC2)
HEXAGONAL = Crystal(lattice=LATTICES["hexagonal"], cells=(14, 8), weight=Lucy, h=3.0, eos=IdealGas())
SQUARE = replace(HEXAGONAL, lattice=LATTICES["square"], cells=(15, 15))
#: a van der Waals fluid on a hexagonal lattice that an ideal gas would keep
COLD = replace(HEXAGONAL, h=2.5, eos=VanDerWaals())
COLD_STATES = ((0.1, 1.0), (0.15, 1.0), (0.2, 1.0), (0.15, 1.2), (0.2, 1.2))     # T, rho
COLD_WEIGHTS = ((Lucy, 2.5), (WendlandC2, 2.5), (WendlandC4, 3.0))      # and h
#: (crystal, weight, stable range, unstable range)
UNSTABLE_RANGES = (
    (HEXAGONAL, Monaghan, 2.2, 2.6),
    (HEXAGONAL, Lucy, 2.6, 2.8),
    (HEXAGONAL, WendlandC2, 2.8, 3.0),
    (SQUARE, Monaghan, 2.4, 2.6),
)
SEEDS = (1, 2, 3)


def cases(size: str) -> list[Case]:
    """All of them; `quick` is for trying the path out."""
    chosen = quick if size == "quick" else paper
    return list(chosen())


def quick() -> Iterator[Case]:
    """A few of each kind."""
    yield from list(growth())[::5]
    yield from list(onsets())[::9]
    yield from fates((3.0,), (1,))
    yield from molecules((5.0, 20.0), 5, (1,))
    yield from speeds()


def paper() -> Iterator[Case]:
    """All seeds."""
    yield from growth()
    yield from onsets()
    yield from fates((2.0, 2.4, 2.8, 3.0, 3.4, 4.0), (1, 2))
    yield from fates((3.0,), (3, 4, 5, 6))
    yield from freezing()
    yield from molecules((5.0, 10.0, 20.0, 40.0, 60.0, 80.0, 100.0), 15, (1, 2))
    yield from speeds()


def growth() -> Iterator[Case]:
    """The lattices that runs begin and freeze on; pairs; fluids under negative pressure."""
    for crystal, weight in product((HEXAGONAL, SQUARE), WEIGHTS):
        yield LatticeGrowth(crystal=replace(crystal, weight=weight))
    for h in (2.6, 2.8):
        yield LatticeGrowth(crystal=replace(HEXAGONAL, weight=Monaghan, h=h))
    for T, rho in COLD_STATES:
        yield LatticeGrowth(crystal=replace(COLD, T=T, rho=rho))


def onsets() -> Iterator[Case]:
    """In the range of the weight, and in the temperature of van der Waals fluids."""
    for crystal, weight, stable, unstable in UNSTABLE_RANGES:
        yield Onset(crystal=replace(crystal, weight=weight), parameter="h", stable=stable, unstable=unstable)
    for (kind, h), rho in product(COLD_WEIGHTS, (1.0, 1.2)):
        crystal = replace(COLD, weight=kind, h=h, rho=rho)
        yield Onset(crystal=crystal, parameter="T", stable=0.4, unstable=0.15)


def fates(ranges: Numbers, seeds: Seeds) -> Iterator[Case]:
    """One a site or two?"""
    for weight, h, seed in product(WEIGHTS, ranges, seeds):
        yield Fate(weight=weight, h=h, seed=seed)


def freezing() -> Iterator[Case]:
    """The gas of Fig. 4 with both weights; with shorter steps, too."""
    for weight, seed in product((Lucy, Monaghan), SEEDS):
        yield Freezing(weight=weight, seed=seed)
    yield Freezing(weight=Lucy, step=0.25)


def molecules(times: Numbers, samples: int, seeds: Seeds) -> Iterator[Case]:
    """Paths of molecules, and back."""
    yield Twins(weight=Lucy, samples=samples)
    for (name, integrator), seed in product(METHODS.items(), seeds):
        yield Reversal(name=name, integrator=integrator, weight=Lucy, times=times, seed=seed)


def speeds() -> Iterator[Case]:
    """Of sound."""
    for lattice, weight in product(LATTICES.values(), WEIGHTS):
        yield Speed(lattice=lattice, weight=weight)


CRYSTAL = "lattice weight h eos T rho"
RATES = "predicted measured measured_err"
RATE = ("growth rate", "1/t0")
GROWTH = Table.of("growth", CRYSTAL, RATES, means={"predicted": RATE, "measured": RATE},
                  about="The fastest growing motion of a lattice: by lattice sums, and in a run.")
ONSETS = Table.of("onsets", f"{CRYSTAL} parameter seed", RATES,
                  about="Where motions of a lattice begin to grow as `parameter` is changed.",
                  means={"measured": ("value of the parameter", "a or epsilon/kB")})
FATES = Table.of("fates", "weight h seed", "shared",
                 about="A gas at rest in the end: one particle a site or two?")
USUAL = {"step": ("step over that of other studies", "")}
FREEZING = Table.of("freezing", "weight seed step P", "flow flow_err lindemann",
                    means=USUAL | {"flow": ("K of the mean flow over that of the grid's smoothed field", "")},
                    about="The gas of Fig. 4 at one pressure; no numbers where the run diverged.")
FREEZING_LIMITS = Table.of("freezing_limits", "weight seed step", "measured measured_err K barrier melting",
                           means=USUAL | {"measured": ("P at which K of the mean flow falls below a tenth",
                                                       "epsilon/a^2")},
                           about="The pressure at which that gas freezes.")
TWINS = Table.of("twins", "weight seed time", "apart",
                 about="An instant of one path, by smooth particles and as molecules.",
                 means={"apart": ("rms distance of both", "a")})
REVERSAL = Table.of("reversal", "integrator weight seed time", "apart equal",
                    about="A run there and back again.",
                    means={"time": ("time there", "t0"), "apart": ("rms distance from the start", "a")})
SPEEDS = Table.of("sound_speeds", "lattice weight", "speed", about="The longest waves along x on a lattice.",
                  means={"speed": ("speed of sound over the fluid's", "")})
TABLES = (GROWTH, ONSETS, FATES, FREEZING, FREEZING_LIMITS, TWINS, REVERSAL, SPEEDS)
