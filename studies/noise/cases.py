"""Which cases are run: noise on points [RR98 Eqs 20-25, 42-44], dissipative particles [Sec. III B]

Algebra first: is the covariance of the noise 2 kT times the dissipation, for one random stress a point, for
noise along edges, for the printed Eqs 42-44? Then Lyapunov solves: rest, a layer heated from below, steps in
time. Then samples, with intervals from 20 batches: modes in 2D and 3D and below onset, Brillouin peaks, the
nonlinear fluid, heat with current amplitudes. At last dissipative particles in time. Units: spacing 1, rho =
T = 1, ideal gas, C_V = 1.
"""
from collections.abc import Iterator
from itertools import product

from particles.dissipative.integrators import GrootWarren, GrootWarren65, Shardlow, VelocityVerlet
from particles.integral.covariance import STEPS as INTEGRATORS
from particles.integral.edge_makers import MAKERS
from particles.integral.splitting import KickDriftFrictionDriftKick
from particles.integrators import TwoStep
from studies.build.disorder import DISORDERS
from studies.kit.case import Case
from studies.noise.dissipative import AtRest, Cylinder, Fluid, LongRun, Shear
from studies.noise.flows import DECAYS, BelowOnset, LayerSampled, Rest
from studies.noise.formulas import Formulas, SpecialCase
from studies.noise.modes import Brillouin, Equipartition
from studies.noise.nonlinear import Capacity, Nonlinear
from studies.noise.partners import MovingPartnership, Partnership
from studies.noise.printed import MovingSteps, PrintedWaves, Steps

KINDS = ("lattice", "jittered-0.1", "jittered-0.3", "random")
DT = (0.01, 0.02, 0.05, 0.1, 0.2, 0.4, 0.8)
TURNS = ((1, 0), (0, 1), (1, 1), (1, -1), (2, 1), (3, 0), (0, 4), (3, 3), (5, 2), (5, 5))
TURNS_3D = ((1, 0, 0), (0, 1, 0), (0, 0, 1), (1, 1, 0), (1, 0, -1), (0, 1, 1), (1, 1, 1), (1, -1, 1),
            (2, 0, 0), (2, 1, 0))
BELOW = (0.9, 0.5, 0.2, 0.1, 0.05, 0.02, 0.01, 0.005)
PRINTED = (("42", "eta"), ("42", "zeta"), ("23", "zeta"), ("43", "kappa"), ("25", "kappa"))

#: of dissipative particles
GOOD = (GrootWarren, GrootWarren65, VelocityVerlet, Shardlow, KickDriftFrictionDriftKick)
LIQUID = (0.01, 0.02, 0.03, 0.04, 0.06, 0.08)
GAS = (0.02, 0.04, 0.06, 0.08, 0.12)       # without repulsion friction alone limits the step
HUNDRED = (100/3)**(1/3)                   # side of a box of the 100 particles that print has
LONG = 12_000       # steps of a run: its error of kT over dt is what counts, which falls as dt grows


def cases(size: str) -> list[Case]:
    """`quick` has fewer point sets, batches a tenth as long, small boxes and three steps."""
    return quick() if size == "quick" else paper()


def quick() -> list[Case]:
    """Some of each kind."""
    return [
        Formulas(), SpecialCase(),
        *algebra(("lattice", "jittered-0.3"), {2: (8, 8)}), *flows((7, 7), (6,)), *steps(),
        Equipartition(counts=(6, 6), turns=TURNS[:6], share=0.1, steps=200),
        Brillouin(points=13, turns=(1, 2), steps=1000),
        Nonlinear(counts=(5, 5), share=0.1, k=1e-3, time=115.0),
        *about(4, (0.5, 0.1), 10.0),
        *(Capacity(C=20.0, corrected=one, steps=400) for one in (True, False)),
        *temperatures((0.02, 0.04, 0.06), (0.04, 0.08, 0.12), side=5.0, steps=1000),
        LongRun(integrator=Shardlow, side=4.0, time=20.0),
        *cylinder(time=30.0, side=5.0)]


def paper() -> list[Case]:
    """All; what was run longer because a shorter run left it open says so."""
    return [
        Formulas(), SpecialCase(),
        *algebra(KINDS, {1: (20,), 2: (10, 12), 3: (5, 5, 6)}),
        *flows((9, 9), (8, 12, 16)), *steps(),
        Equipartition(counts=(12, 12), turns=TURNS, share=0.1, steps=1500),
        Brillouin(points=33, turns=(2, 3, 4), steps=30000), *cubes(750),
        *about(8, (0.5, 0.1, 0.05, 0.02), DECAYS),
        Nonlinear(counts=(8, 8), share=0.1, k=1e-3, time=200.0),
        *(Capacity(C=C, corrected=one, steps=10000) for one in (True, False) for C in (20.0, 50.0)),
        *temperatures(LIQUID, GAS, side=8.0, steps=LONG),
        AtRest(integrator=Shardlow, dt=0.01, side=10.0, time=120.0),
        AtRest(integrator=TwoStep, dt=0.01, side=10.0, time=300.0),
        AtRest(integrator=Shardlow, side=HUNDRED, time=4000.0),
        *long_runs(), *cylinder(time=1500.0, side=8.0)]


def algebra(kinds: tuple[str, ...], counts: dict[int, tuple[int, ...]]) -> Iterator[Case]:
    """Partners on every maker, kind of points and dimension, moving points; printed noise by waves."""
    for maker, kind, d in product(MAKERS, kinds, counts):
        if not (maker == "delaunay" and (d == 1 or (d == 3 and kind == "lattice"))):
            h = 2.7 if d < 3 else 2.4
            yield Partnership(maker=maker, disorder=DISORDERS[kind], counts=counts[d], h=h)
    yield from (MovingPartnership(steps=steps) for steps in (0, 20))
    for (equation, term), doubled in product(PRINTED, (False, True)):
        for d, h in ((1, 1.5), (2, 1.2), (2, 2.0), (2, 3.0)):
            if not (term == "eta" and d == 1):      # there is no shear on a line
                yield PrintedWaves(equation=equation, term=term, doubled=doubled, d=d, h=h)


def flows(counts: tuple[int, int], rows: tuple[int, ...]) -> Iterator[Case]:
    """Lyapunov solves; odd lattices have no corners of the zone, which nested transport does not damp."""
    lattice = DISORDERS["lattice"]
    for maker, kind in (("renormalised", "lattice"), ("delaunay", "jittered-0.3"), ("delaunay", "random"),
                        ("plain", "jittered-0.3"), ("closed", "jittered-0.1"), ("exact", "jittered-0.1")):
        h = 3.0 if maker in ("exact", "closed") else 2.0
        for share in (0.0, 0.1, 1.0):
            yield Rest(maker=maker, disorder=DISORDERS[kind], counts=counts, share=share, h=h)
    yield Rest(maker="renormalised", disorder=lattice, counts=(21,), share=0.1)
    yield Rest(maker="renormalised", disorder=lattice, counts=(5, 5, 5), share=0.1)
    yield from (BelowOnset(rows=n, below=BELOW) for n in rows)


def steps() -> Iterator[Case]:
    """All integrators, waves of 15 to 300 spacings."""
    for k in (0.02, 0.1, 0.4):
        yield from (Steps(integrator=integrator, k=k, dt=DT) for integrator in INTEGRATORS)
        yield from (MovingSteps(k=k, dt=DT, both=both) for both in (True, False))


def about(rows: int, below: tuple[float, ...], decays: float) -> Iterator[Case]:
    """Samples of the linear equations about a layer below onset; random numbers of their own."""
    for number, part in enumerate(below):
        yield LayerSampled(rows=rows, below=part, seed=11 + number, decays=decays)


def cubes(steps: int) -> Iterator[Case]:
    """Samples in 3D: a lattice with odd sides, which has no corner of its zone; irregular points."""
    yield Equipartition(counts=(5, 5, 5), turns=TURNS_3D, share=0.1, steps=steps, dt=3.0,
                        maker="renormalised", disorder=DISORDERS["lattice"])
    yield Equipartition(counts=(5, 5, 6), turns=TURNS_3D, share=0.0, steps=steps, dt=3.0)


def temperatures(liquid: tuple[float, ...], gas: tuple[float, ...], *, side: float,
                 steps: int) -> Iterator[Fluid]:
    """All integrators and steps; RR98's without repulsion: what friction and noise alone do to kT."""
    for integrator in (TwoStep, *GOOD):
        yield from (AtRest(integrator=integrator, dt=dt, side=side, time=steps*dt) for dt in liquid)
    yield from (AtRest(integrator=TwoStep, a=0.0, dt=dt, side=side, time=steps*dt) for dt in gas)


def long_runs() -> Iterator[Fluid]:
    """The usual step, for the time that decided whether kT is off by 1 %: 500 did for one, 240 for none."""
    for integrator in GOOD:
        time = 500.0 if integrator is KickDriftFrictionDriftKick else 1500.0
        yield LongRun(integrator=integrator, time=time)


def cylinder(*, time: float, side: float) -> Iterator[Fluid]:
    """A stream past a cylinder, the viscosity at its step."""
    yield Cylinder(time=time)
    yield Shear(integrator=VelocityVerlet, dt=0.04, side=side, time=max(time/3, 30.0), rate=0.3)
