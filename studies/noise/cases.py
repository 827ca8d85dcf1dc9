"""Which cases are run: noise on points [RR98 Eqs 20-25, 42-44], dissipative particles [Sec. III B]

Units: spacing 1, rho = T = 1, ideal gas, C_V = 1.
"""
from collections.abc import Iterator
from itertools import product

from particles.dissipative.integrators import (
    GrootWarren,
    GrootWarren65,
    KickDriftFrictionDriftKick,
    Shardlow,
    VelocityVerlet,
)
from particles.integral.covariance import STEPS as INTEGRATORS
from particles.integral.edge_makers import MAKERS, delaunay, renormalised
from particles.integrators import TwoStep
from studies.build.setting import DISORDERS
from studies.kit.case import Case
from studies.noise import dissipative, partners
from studies.noise.below_onset import DECAYS, BelowOnset, LayerSampled
from studies.noise.dissipative import AtRest, Cylinder, Fluid, LongRun, Shear
from studies.noise.modes import Brillouin, Equipartition
from studies.noise.partners import Formula, Partnership
from studies.noise.printed_noise import MovingSteps, PrintedWaves, Steps
from studies.noise.sampling import Capacity, Nonlinear

KINDS = ("lattice", "jittered-0.1", "jittered-0.3", "random")
DT = (0.01, 0.02, 0.05, 0.1, 0.2, 0.4, 0.8)
TURNS = ((1, 0), (0, 1), (1, 1), (1, -1), (2, 1), (3, 0), (0, 4), (3, 3), (5, 2), (5, 5))
TURNS_3D = ((1, 0, 0), (0, 1, 0), (0, 0, 1), (1, 1, 0), (1, 0, -1), (0, 1, 1), (1, 1, 1), (1, -1, 1),
            (2, 0, 0), (2, 1, 0))
BELOW = (0.9, 0.5, 0.2, 0.1, 0.05, 0.02, 0.01, 0.005)
PRINTED = ((42, "eta"), (42, "zeta"), (23, "zeta"), (43, "kappa"), (25, "kappa"))
FORMULAS = {
    "partner of Eq. 42": partners.other_partner, "step of Eq. 42": partners.half_step,
    "spacing of Eq. 42": partners.half_spacing, "trace of Eq. 44": partners.trace_2d,
    "dissipative particles, form": dissipative.form,
    "dissipative particles, unmodified": dissipative.unmodified,
    "dissipative particles, viscosity doubled": partners.viscosity,
    "dissipative particles, viscosity single": partners.viscosity_single}

#: of dissipative particles
GOOD = (GrootWarren, GrootWarren65, VelocityVerlet, Shardlow, KickDriftFrictionDriftKick)
LIQUID = (0.01, 0.02, 0.03, 0.04, 0.06, 0.08)
HUNDRED = (100/3)**(1/3)                   # side of a box of the 100 particles that print has
LONG = 12_000       # steps of a run: its error of kT over dt is what counts, which falls as dt grows


def cases(size: str) -> list[Case]:
    """`quick` has fewer point sets, batches a tenth as long, small boxes and three steps."""
    return quick() if size == "quick" else paper()


def quick() -> list[Case]:
    """Some of each kind."""
    return [
        *formulas(), *algebra(("lattice", "jittered-0.3"), {2: (8, 8)}), *printed(), *steps(),
        BelowOnset(rows=6, below=BELOW),
        Equipartition(counts=(6, 6), turns=TURNS[:6], share=0.1, steps=200),
        Brillouin(points=13, turns=(1, 2), steps=1000),
        Nonlinear(counts=(5, 5), share=0.1, k=1e-3, time=115.0),
        *about(4, (0.5, 0.1), 10.0),
        *(Capacity(C=20.0, corrected=one, steps=400) for one in (True, False)),
        *temperatures((0.02, 0.04, 0.06), side=5.0, steps=1000),
        LongRun(integrator=Shardlow, side=4.0, time=20.0), *cylinder(time=30.0, side=5.0)]


def paper() -> list[Case]:
    """All; what was run longer because a shorter run left it open says so."""
    return [
        *formulas(), *algebra(KINDS, {1: (20,), 2: (10, 12), 3: (5, 5, 6)}), *printed(), *steps(),
        *(BelowOnset(rows=rows, below=BELOW) for rows in (8, 12, 16)),
        Equipartition(counts=(12, 12), turns=TURNS, share=0.1, steps=1500),
        Brillouin(points=33, turns=(2, 3, 4), steps=30000), *cubes(750),
        *about(8, (0.5, 0.1, 0.05, 0.02), DECAYS),
        Nonlinear(counts=(8, 8), share=0.1, k=1e-3, time=200.0),
        *(Capacity(C=C, corrected=one, steps=10000) for one in (True, False) for C in (20.0, 50.0)),
        *temperatures(LIQUID, side=8.0, steps=LONG),
        AtRest(integrator=Shardlow, dt=0.01, side=10.0, time=120.0),
        AtRest(integrator=TwoStep, dt=0.01, side=10.0, time=300.0),
        AtRest(integrator=Shardlow, side=HUNDRED, time=4000.0),
        *long_runs(), *cylinder(time=1500.0, side=8.0)]


def formulas() -> Iterator[Case]:
    """Arithmetic."""
    return (Formula(name=name, value=value) for name, value in FORMULAS.items())


def algebra(kinds: tuple[str, ...], counts: dict[int, tuple[int, ...]]) -> Iterator[Case]:
    """Partners on every maker, kind of points and dimension."""
    for (name, maker), kind, d in product(MAKERS.items(), kinds, counts):
        if not (name == "delaunay" and (d == 1 or (d == 3 and kind == "lattice"))):
            h = 2.7 if d < 3 else 2.4
            yield Partnership(maker=maker, disorder=DISORDERS[kind], counts=counts[d], h=h)


def printed() -> Iterator[Case]:
    """Printed noise by waves."""
    places = ((1, 1.5), (2, 1.2), (2, 2.0), (2, 3.0))
    for (equation, term), doubled, (d, h) in product(PRINTED, (False, True), places):
        if not (term == "eta" and d == 1):      # there is no shear on a line
            yield PrintedWaves(equation=equation, term=term, doubled=doubled, d=d, h=h)


def steps() -> Iterator[Case]:
    """All integrators, waves of 15 to 300 spacings."""
    for k in (0.02, 0.1, 0.4):
        yield from (Steps(integrator=integrator, k=k, dt=DT) for integrator in INTEGRATORS.values())
        yield from (MovingSteps(k=k, dt=DT, both=both) for both in (True, False))


def about(rows: int, below: tuple[float, ...], decays: float) -> Iterator[Case]:
    """Samples of the linear equations about a layer below onset; random numbers of their own."""
    for number, part in enumerate(below):
        yield LayerSampled(rows=rows, below=part, seed=11 + number, decays=decays)


def cubes(steps: int) -> Iterator[Case]:
    """Samples in 3D: a lattice with odd sides, which has no corner of its zone; irregular points."""
    yield Equipartition(counts=(5, 5, 5), turns=TURNS_3D, share=0.1, steps=steps, dt=3.0, maker=renormalised,
                        disorder=DISORDERS["lattice"])
    yield Equipartition(counts=(5, 5, 6), turns=TURNS_3D, share=0.0, steps=steps, dt=3.0, maker=delaunay)


def temperatures(dts: tuple[float, ...], *, side: float, steps: int) -> Iterator[Fluid]:
    """All integrators and steps."""
    for integrator, dt in product((TwoStep, *GOOD), dts):
        yield AtRest(integrator=integrator, dt=dt, side=side, time=steps*dt)


def long_runs() -> Iterator[Fluid]:
    """The usual step, for the time that decided whether kT is off by 1 %: 500 did for one, 240 for none."""
    for integrator in GOOD:
        time = 500.0 if integrator is KickDriftFrictionDriftKick else 1500.0
        yield LongRun(integrator=integrator, time=time)


def cylinder(*, time: float, side: float) -> Iterator[Fluid]:
    """A stream past a cylinder, the viscosity at its step."""
    yield Cylinder(time=time)
    yield Shear(integrator=VelocityVerlet, dt=0.04, side=side, time=max(time/3, 30.0), rate=0.3)
