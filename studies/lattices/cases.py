"""Cases of the study, by size, and the tables that they fill. Units: spacing, mass of a particle, T = 1."""
from collections.abc import Iterator
from dataclasses import replace
from itertools import product

from continuum.fluid import IdealGas, VanDerWaals
from particles.weights import Lucy, Monaghan, Weight, WendlandC2, WendlandC4
from studies.build.spam import TODAY, VARIANTS, Variant
from studies.kit.case import Case
from studies.kit.table import Table
from studies.lattices.crystals import LATTICES, Crystal, Debye, Onset
from studies.lattices.frozen_flow import Fastest, Freezing
from studies.lattices.loss import Thickened
from studies.lattices.stirred import MAKERS, PLATES, SHEARED, Stirred

WEIGHTS: tuple[type[Weight], ...] = (Lucy, Monaghan, WendlandC2)
HEXAGONAL = Crystal(lattice=LATTICES["hexagonal"], cells=(14, 8), weight=Lucy, h=3.0, eos=IdealGas())
SQUARE = replace(HEXAGONAL, lattice=LATTICES["square"], cells=(15, 15))
#: a van der Waals fluid on a hexagonal lattice that an ideal gas would keep
COLD = replace(HEXAGONAL, h=2.5, eos=VanDerWaals())
COLD_WEIGHTS = ((Lucy, 2.5), (WendlandC2, 2.5), (WendlandC4, 3.0))      # weight, h
#: (crystal, weight, stable range, unstable range)
UNSTABLE_RANGES = (
    (HEXAGONAL, Monaghan, 2.2, 2.6),
    (HEXAGONAL, Lucy, 2.6, 2.8),
    (HEXAGONAL, WendlandC2, 2.8, 3.0),
    (SQUARE, Monaghan, 2.4, 2.6),
)
SEEDS = (1, 2, 3)
PRESSURES = ("less-static-90", "less-static-50", "more-static-100", "more-static-400")
#: variants whose laws of the stress differ from that of the printed scheme
OTHERS = ("printed-monaghan", "wendland-c2", "wendland-c4", "wendland-c6", "direct", "range-4")
WALLS = ("printed", "walls-odd", "printed-fixed-rows")
RAYLEIGH = (2500.0, 3000.0, 3500.0, 5000.0, 10_000.0, 20_000.0, 50_000.0)


def cases(size: str) -> list[Case]:
    """All cases of a size; `quick` only tries out that everything runs."""
    return list(quick() if size == "quick" else paper())


def quick() -> Iterator[Case]:
    """A few cases of each kind."""
    yield from (*list(onsets())[::9], *spectra())
    for U, variant in product((0.05, 0.1, 0.2), ("printed", "less-static-50")):
        yield Stirred(variant=VARIANTS[variant], rows=25, U=U, time=3.0)
    yield Stirred(variant=VARIANTS["less-static-90"], mode=PLATES, rows=25, time=3.0)
    yield Thickened(ra=10_000.0)


def paper() -> Iterator[Case]:
    """All cases with all seeds."""
    yield from (*onsets(), *freezing(), *spectra())
    yield from (*stirred(), *aligned(), *ranges(), *(Thickened(ra=ra) for ra in RAYLEIGH), *makers())


def onsets() -> Iterator[Case]:
    """Onsets of growth in the range of the weight, and in the temperature of van der Waals fluids."""
    for crystal, weight, stable, unstable in UNSTABLE_RANGES:
        yield Onset(crystal=replace(crystal, weight=weight), parameter="h", stable=stable, unstable=unstable)
    for (kind, h), rho in product(COLD_WEIGHTS, (1.0, 1.2)):
        crystal = replace(COLD, weight=kind, h=h, rho=rho)
        yield Onset(crystal=crystal, parameter="T", stable=0.4, unstable=0.15)


def freezing() -> Iterator[Case]:
    """Freezing of the gas of Fig. 4 with both weights, and with shorter steps."""
    for (weight, step), seed in product(((Lucy, 1.0), (Monaghan, 1.0), (Lucy, 1/4), (Lucy, 1/16)), SEEDS):
        yield Freezing(weight=weight, step=step, seed=seed)
    yield Fastest()


def spectra() -> Iterator[Case]:
    """Numbers of long waves on lattices."""
    for crystal, kind, h in product((HEXAGONAL, SQUARE), WEIGHTS, (2.5, 3.0, 4.0, 5.0, 6.0)):
        yield Debye(crystal=replace(crystal, weight=kind, h=h))


def stirred() -> Iterator[Stirred]:
    """Stirred vortices: forces, rows, viscosities, pressures, weights."""
    printed = VARIANTS["printed"]
    forces, few = (0.02, 0.05, 0.1, 0.2, 0.4), (0.1, 0.2, 0.4)
    for rows, U, seed in (*product((25,), forces, SEEDS), *product((50,), forces, SEEDS[:2]),
                          (50, 0.2, 3), (100, 0.2, 1), (100, 0.2, 2)):
        yield Stirred(variant=printed, rows=rows, U=U, seed=seed)
    for name, U, seed in (*product(PRESSURES, (0.1, 0.2), SEEDS[:2]), *product(OTHERS, few, (1,))):
        yield Stirred(variant=VARIANTS[name], rows=50, U=U, seed=seed)
    for seed in SEEDS:
        for thick in (0.4, 2.0, 4.0):
            yield Stirred(variant=printed, rows=25, thick=thick, seed=seed)


def aligned() -> Iterator[Stirred]:
    """Flows along x: in a periodic box, and between plates."""
    for name, seed in product(("printed", *PRESSURES[:2]), SEEDS[:2]):
        for rows in (25, 50, 100) if name == "printed" else (25, 50):
            yield Stirred(variant=VARIANTS[name], mode=SHEARED, rows=rows, seed=seed)
    for name, rows, seed in product(WALLS, (25, 50), SEEDS[:2]):
        variant = VARIANTS[name]._replace(fraction=0.9)
        yield Stirred(variant=variant, mode=PLATES, rows=rows, seed=seed, time=4.0)


def ranges() -> Iterator[Stirred]:
    """Flows with Wendland's weight: fixed range, range like rows^(1/2)    [Zhu, Hernquist & Li 2015]"""
    for rows, seed in product((25, 50, 100), SEEDS[:2]):
        fixed = VARIANTS["wendland-c2"]
        time = 8.0 if rows < 100 else 4.0
        yield Stirred(variant=fixed, rows=rows, seed=seed, time=time)
        if rows > 25:
            yield Stirred(variant=growing(rows), rows=rows, seed=seed, time=time)
            thin = growing(rows)._replace(fraction=0.9)
            yield Stirred(variant=thin, mode=PLATES, rows=rows, seed=seed, time=4.0)
    yield Stirred(variant=growing(200), rows=200, time=2.5)


def makers() -> Iterator[Stirred]:
    """Stirred vortices of today's smooth particles, at three forces each."""
    for name, U in product(MAKERS, (0.1, 0.2, 0.4)):
        yield Stirred(variant=TODAY[name], rows=25, U=U)


def growing(rows: int) -> Variant:
    """The variant whose range grows as rows^(1/2)."""
    return VARIANTS["wendland-c2"]._replace(h=3.0*(rows/25)**0.5)


CRYSTAL = "lattice weight h eos T rho"
RATES = "predicted measured measured_err"
ONSETS = Table.of("onsets", f"{CRYSTAL} parameter seed", RATES,
                  about="Where motions of a lattice begin to grow as `parameter` is changed.",
                  means={"measured": ("value of the parameter", "a or epsilon/kB")})
USUAL = {"step": ("step over that of other studies", "")}
FREEZING = Table.of("freezing", "weight seed step P", "flow flow_err lindemann",
                    means=USUAL | {"flow": ("K of the mean flow over that of the grid's smoothed field", "")},
                    about="The gas of Fig. 4 at one pressure; no numbers where the run diverged.")
FREEZING_LIMITS = Table.of("freezing_limits", "weight seed step", "measured measured_err K barrier melting",
                           means=USUAL | {"measured": ("P at which K of the mean flow falls below a tenth",
                                                       "epsilon/a^2")},
                           about="The pressure at which that gas freezes.")
FREEZING_FLOW = Table.of("freezing_flow", "ra rows", "fastest",
                         means={"fastest": ("largest v^2 over 2 K", "")},
                         about="How uneven the grid's flow of that gas is.")
DEBYE = Table.of("debye", CRYSTAL, "sound shear",
                 about="Long waves on a lattice: their number below a frequency over that of the fluid's.",
                 means={"sound": ("that of the faster waves", ""),
                        "shear": ("that of the slower ones, if none grows", "")})
OVER = "over that of the exact flow"
DRIVEN = Table.of(
    "driven", "variant h rows seed mode walls U thick P",
    "flow flow_err excess excess_err stress stress_err kinetic kinetic_err friction symbol slip",
    about="A flow that a force holds, without gravity or heat: who bears the force. Stresses are amplitudes.",
    means={"mode": ("stirred: vortices; sheared: along x; plates: along x between plates", ""),
           "walls": ("what is behind plates, in the mode plates", ""),
           "U": ("amplitude of the exact flow", "a/t0"), "thick": ("viscosity over rows/100", ""),
           "P": ("part of the static pressure that the sums hold", "epsilon/a^2"),
           "flow": (f"amplitude {OVER}", ""), "excess": ("stress that viscosity leaves over", "epsilon/a^2"),
           "stress": ("of the pressure sum, a deviator", "epsilon/a^2"),
           "kinetic": ("stress of the noise", "epsilon/a^2"),
           "friction": ("stress of viscosity", "epsilon/a^2"),
           "symbol": ("friction of the scheme on a lattice over the exact one", ""),
           "slip": ("slip length at the plates", "a")})
THICKENED = Table.of(
    "thickened", "ra thick q", "ke share", about="The grid's layer, so many times as viscous as at its Ra.",
    means={"thick": ("viscosity over that of the layer of this Ra", ""), "q": ("power of the law", ""),
           "share": ("<P^(1-q) (eta gamma)^q gamma>/<eta gamma^2>, of its own viscosity", "")})
LAWS = Table.of(
    "laws", "variant", "C C_err q q_err scatter runs",
    about="tau = C P^(1-q) (eta gamma)^q of stirred particles; one law for all parts of static pressure.",
    means={"C": ("stress over P where eta gamma = P", ""), "q": ("its power", ""), "runs": ("fitted", ""),
           "scatter": ("rms of ln(measured/law)", "")})
FORETOLD = Table.of(
    "foretold", "variant ra rows", "x slip bulk predicted predicted_err measured measured_err",
    about="K of smooth particles over that of the grid, seen alike: by the law and as measured.",
    means={"x": ("viscosity that the law makes, over the given one; none: all rests", ""),
           "slip": ("slip length of the plates", "a"), "bulk": ("K by the law, without slip", ""),
           "predicted": ("K by law and slip", ""), "measured": ("Kg of results/rb/errors.csv", "")})
TABLES = (ONSETS, FREEZING, FREEZING_LIMITS, FREEZING_FLOW, DEBYE, DRIVEN, THICKENED, LAWS, FORETOLD)
