"""Which of RR98's motions of points hold: literal (Eqs 39-41), convective (46-48), constant mass (49, 50)?

Waves, vortices and random fields in periodic boxes on lattices and jittered points, edges made again at every evaluation: how
fast patterns and sound travel, when forward Euler lets sound grow, how well points are placed, what is conserved over 1e4
steps, what a filter of the density removes and costs. Spacing a = 1, rho = T = 1, c^2 = 2. Paper size takes three minutes.
Writes results/conservation/*.csv and *.png and the rows of study conservation in results/claims.csv.
"""
from collections.abc import Iterator
from dataclasses import replace
from itertools import product
from math import inf

from particles.integral.brackets import Powers
from particles.integral.dih import Nested
from particles.integral.rr98_moving_plain import MOTIONS, ConstantMass
from particles.integrators import RK4, TwoStep
from particles.weights import WEIGHTS, Lucy, WendlandC2
from studies.conservation.motions import claims as motions_claims
from studies.conservation.motions import derive as motions_derive
from studies.conservation.motions import figures as motions_figures
from studies.conservation.motions import tables as motions_tables
from studies.conservation.motions.scene import ALONG
from studies.conservation.motions.steps import MOVED, Growth, Places, Share
from studies.conservation.motions.sums import Brackets, Conservation, FilterRun, Identity, Signs
from studies.conservation.motions.waves import Pattern, Sound
from studies.kit.case import Case
from studies.kit.study import Part

CONSTANTS = ((0.0, 0.0), (1.0, -1.0), (2.0, -2.0), (0.0, -1.0), (1.0, 0.0), (2.0, 0.0), (1.0, 1.0), (3.0, 0.0))
NAMES = {kind: name for name, kind in MOTIONS.items()}
NESTED = Nested()


def cases(size: str) -> list[Case]:
    """`quick` has one wavelength and short runs."""
    if size == "quick":
        return [*waves((8,), time=4.0), *steps((8,), coarser=8), *sums((16,), time=4.0), *conservation(40, [Lucy])]
    return [*waves((8, 16, 24, 32)), *steps((8, 16, 32, 64)), *sums((16, 32, 64)), *conservation(10000, list(WEIGHTS.values()))]


def waves(wavelengths: tuple[int, ...], time: float = 10.0) -> Iterator[Case]:
    """Patterns on a stream, and sound."""
    for (name, kind), wavelength in product(MOTIONS.items(), wavelengths):
        yield from (Pattern(motion=name, kind=kind, pattern=p, wavelength=wavelength, time=time) for p in ("density", "shear"))
        yield Sound(motion=name, kind=kind, wavelength=wavelength)
        if name != "carried" and len(wavelengths) > 1:
            yield Sound(motion=name, kind=kind, wavelength=wavelength, weight=WendlandC2, h=4.0)
    for a, b in ((1.0, -1.0), (1.0, 0.0)):
        yield Sound(motion="constant-mass", kind=ConstantMass, wavelength=middle(wavelengths), bracket=Powers(a, b))


def middle(wavelengths: tuple[int, ...]) -> int:
    """The one in the middle."""
    return wavelengths[(len(wavelengths) - 1)//2]


def steps(wavelengths: tuple[int, ...], coarser: int = 1) -> Iterator[Case]:
    """Forward Euler on fixed points, two steps on moving ones."""
    for wavelength, of_limit in product(wavelengths, (0.5, 1.0, 1.5)):
        yield Growth(name="nested", transport=NESTED, wavelength=wavelength, of_limit=of_limit,
                     history=wavelength == middle(wavelengths))
        if wavelength == middle(wavelengths):
            yield Growth(name="pairwise", transport=ALONG, wavelength=wavelength, of_limit=of_limit)
    some = (0.1, 0.05) if coarser == 1 else (0.1,)
    yield from (Share(integrator=name, dt=dt) for name, dt in product(("euler", "two-step"), some))
    yield from (Places(motion=NAMES[flow.kind], flow=replace(flow, steps=flow.steps//coarser)) for flow in MOVED)


def sums(wavelengths: tuple[int, ...], time: float = 20.0) -> Iterator[Case]:
    """Eqs 46-50 evaluated once, and filters."""
    yield from (Signs(wavelength=wavelength) for wavelength in wavelengths)
    yield from (Brackets(a=a, b=b) for a, b in CONSTANTS)
    for (name, transport), reynolds in product((("nested", NESTED), ("pairwise", ALONG)), (0.1, 10.0, 1000.0, inf)):
        yield Identity(name=name, transport=transport, reynolds=reynolds)
    for h in (2.0, 3.0, 4.0):
        yield FilterRun(h=h, wavelength=0, chi=0.0, time=time)
        yield from (FilterRun(h=h, wavelength=0, corrected=corrected, time=time) for corrected in (False, True))
    for wavelength, corrected in product(wavelengths, (False, True)):
        yield FilterRun(h=3.0, wavelength=wavelength, corrected=corrected, time=time)


def conservation(length: int, weights: list[type]) -> Iterator[Case]:
    """All motions on jittered points with RK4; on a lattice, with the paper's two steps, those it prints; all weights."""
    for name, kind in MOTIONS.items():
        yield Conservation(motion=name, kind=kind, weight=Lucy, points="jittered-0.1", integrator=RK4, steps=length, dt=0.2)
    for name, some in (("literal", weights), ("convective", weights[:1])):
        yield from (Conservation(motion=name, kind=MOTIONS[name], weight=weight, points="lattice", integrator=TwoStep,
                                 steps=length, dt=0.05) for weight in some)
    yield Conservation(motion="literal", kind=MOTIONS["literal"], weight=Lucy, points="jittered-0.1", integrator=TwoStep,
                       steps=length, dt=0.05, chi=0.14)


PART = Part(cases=cases, tables=motions_tables.ALL, derive=motions_derive.derive,
              figures=motions_figures.figures, claims=motions_claims.CLAIMS)
