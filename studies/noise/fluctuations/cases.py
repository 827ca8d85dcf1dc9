"""What of RR98's fluctuating hydrodynamics holds on fixed points, and what must take its place?    [RR98 Eqs 20-25, 42-44]

Algebra first: is the covariance of the noise 2 kT times the dissipation, for one random stress a point, for noise along edges,
for the printed Eqs 42-44? Then Lyapunov solves: rest, a stream, a shear flow, a temperature gradient, a layer heated from below,
steps in time; velocity autocorrelations. Then samples, with intervals from 20 batches: modes in 2D and 3D, about a gradient
and below onset, Brillouin peaks, the nonlinear fluid at rest and about given flows, heat with current amplitudes. Units:
spacing 1, rho = T = 1, ideal gas, C_V = 1.
Paper size takes about ten minutes of one core. Writes results/noise/*.csv and *.png and the rows of study
fluctuations in results/claims.csv.
"""
from collections.abc import Iterator
from itertools import product

from particles.integral.covariance import STEPS
from particles.integral.edge_makers import MAKERS
from studies.build.disorder import DISORDERS
from studies.kit.case import Case
from studies.kit.part import Part
from studies.noise.fluctuations import claims as fluct_claims
from studies.noise.fluctuations import claims_flows as fluct_claims_flows
from studies.noise.fluctuations import claims_noise as fluct_claims_noise
from studies.noise.fluctuations import figures as fluct_figures
from studies.noise.fluctuations import special as fluct_special
from studies.noise.fluctuations import tables as fluct_tables
from studies.noise.fluctuations.algebra import MovingPartnership, Partnership, PrintedWaves
from studies.noise.fluctuations.flows import BelowOnset, Gradient, Rest
from studies.noise.fluctuations.given import About, Shear, Sheared, Stream
from studies.noise.fluctuations.given_sampled import DECAYS, GradientSampled, LayerSampled
from studies.noise.fluctuations.modes import Equipartition
from studies.noise.fluctuations.nonlinear import Capacity, Nonlinear
from studies.noise.fluctuations.peaks import Brillouin
from studies.noise.fluctuations.steps import Moving, Steps
from studies.noise.fluctuations.tail import Tail, TailSampled

DT = (0.01, 0.02, 0.05, 0.1, 0.2, 0.4, 0.8)
TURNS = ((1, 0), (0, 1), (1, 1), (1, -1), (2, 1), (3, 0), (0, 4), (3, 3), (5, 2), (5, 5))
TURNS_3D = ((1, 0, 0), (0, 1, 0), (0, 0, 1), (1, 1, 0), (1, 0, -1), (0, 1, 1), (1, 1, 1), (1, -1, 1), (2, 0, 0), (2, 1, 0))
TURNS_FLOW = ((1, 0), (0, 1), (1, 1), (1, -1), (2, 1), (2, 0))
LAGS = (0, 2, 4, 10, 20, 40, 100)


def algebra(kinds: tuple[str, ...], counts: dict[int, tuple[int, ...]]) -> Iterator[Case]:
    """Partners on every maker, kind of points and dimension, and between moving points; printed noise wave by wave."""
    for maker, kind, d in product(MAKERS, kinds, counts):
        if not (maker == "delaunay" and (d == 1 or (d == 3 and kind == "lattice"))):
            yield Partnership(maker=maker, disorder=DISORDERS[kind], counts=counts[d], h=2.7 if d < 3 else 2.4)
    yield from (MovingPartnership(steps=steps) for steps in (0, 20))
    for (equation, term), doubled in product((("42", "eta"), ("42", "zeta"), ("23", "zeta"), ("43", "kappa"), ("25", "kappa")),
                                             (False, True)):
        for d, h in ((1, 1.5), (2, 1.2), (2, 2.0), (2, 3.0)):
            if not (term == "eta" and d == 1):      # there is no shear on a line
                yield PrintedWaves(equation=equation, term=term, doubled=doubled, d=d, h=h)


def flows(counts: tuple[int, int], period: int, rows: tuple[int, ...]) -> Iterator[Case]:
    """Lyapunov solves; odd lattices have no corners of the zone, where nothing damps density and nested transport nothing."""
    for maker, kind in (("renormalised", "lattice"), ("delaunay", "jittered-0.3"), ("delaunay", "random"),
                        ("plain", "jittered-0.3"), ("closed", "jittered-0.1"), ("exact", "jittered-0.1")):
        for share in (0.0, 0.1, 1.0):
            yield Rest(maker=maker, disorder=DISORDERS[kind], counts=counts, share=share,
                       h=3.0 if maker in ("exact", "closed") else 2.0)
    for (maker, kind), share in product((("renormalised", "lattice"), ("delaunay", "jittered-0.3"), ("delaunay", "random")),
                                        (0.0, 0.1, 1.0)):
        yield Rest(maker=maker, disorder=DISORDERS[kind], counts=(7, 7), share=share, speed=0.5)
    yield Rest(maker="renormalised", disorder=DISORDERS["lattice"], counts=(21,), share=0.1)
    yield Rest(maker="renormalised", disorder=DISORDERS["lattice"], counts=(5, 5, 5), share=0.1)
    yield Gradient(period=period, k=tuple(float(x) for x in (0.05, 0.07, 0.1, 0.14, 0.2, 0.28, 0.4)))
    for n in rows:
        yield BelowOnset(rows=n, below=(0.9, 0.5, 0.2, 0.1, 0.05, 0.02, 0.01, 0.005))


def steps() -> Iterator[Case]:
    """All integrators, waves of 15 to 300 spacings."""
    for k in (0.02, 0.1, 0.4):
        for integrator in STEPS:
            yield Steps(integrator=integrator, k=k, dt=DT)
        for both in (True, False):
            yield Moving(k=k, dt=DT, both=both)


def shears(period: int, k: tuple[float, ...]) -> Iterator[Case]:
    """Weak, to second order, and strong; k beyond 2 pi/period, where no strong shear is unstable, and one below for the weak."""
    yield Sheared(period=period, U=3e-5, k=(0.7*k[0], *k))
    for U in (0.01, 0.05):
        yield Sheared(period=period, U=U, k=k)


def moving(about: tuple[int, int], time: float) -> Iterator[Case]:
    """Samples about given flows."""
    yield About(flow=Shear(0.5), counts=about, turns=TURNS_FLOW, time=3*time)
    yield About(flow=Stream(0.6), counts=about, turns=TURNS_FLOW, time=time)


def about(period: int, rows: int, below: tuple[float, ...], k: tuple[float, ...], decays: float) -> Iterator[Case]:
    """Samples of the linear equations about a temperature gradient and a layer below onset; random numbers of their own."""
    for number, wave in enumerate(k):
        yield GradientSampled(period=period, contrast=0.1, k=wave, seed=1 + number, decays=decays)
    for number, part in enumerate(below):
        yield LayerSampled(rows=rows, below=part, seed=11 + number, decays=decays)


def tails(side: int, small: int, steps: int) -> Iterator[Case]:
    """With null modes (share 0) and without."""
    for share in (0.0, 0.1, 1.0):
        yield Tail(side=side, share=share, nu_t=(3.0, 10.0, 30.0))
        yield Tail(side=24, share=share, nu_t=(100.0, 300.0, 1000.0, 3000.0))
        # less viscous, and sound has not gone round
        yield Tail(side=3*side, share=share, nu_t=(1.0, 2.0, 5.0, 10.0, 20.0, 30.0), eta=0.3)
    for share in (0.0, 0.1):
        yield TailSampled(side=small, share=share, lags=LAGS, steps=steps)


def cubes(steps: int) -> Iterator[Case]:
    """Samples in 3D: a lattice with odd sides, which has no corner of its zone; irregular points."""
    yield Equipartition(counts=(5, 5, 5), turns=TURNS_3D, share=0.1, steps=steps, dt=3.0, maker="renormalised",
                        disorder=DISORDERS["lattice"])
    yield Equipartition(counts=(5, 5, 6), turns=TURNS_3D, share=0.0, steps=steps, dt=3.0)


def cases(size: str) -> list[Case]:
    """`quick` has fewer point sets and batches a tenth as long."""
    if size == "quick":
        return [*algebra(("lattice", "jittered-0.3"), {2: (8, 8)}), *flows((7, 7), 16, (6,)), *steps(),
                Equipartition(counts=(6, 6), turns=TURNS[:6], share=0.1, steps=200),
                Brillouin(points=13, turns=(1, 2), steps=1000), Nonlinear(counts=(5, 5), share=0.1, k=1e-3, time=115.0),
                Brillouin(points=13, turns=(1, 2), steps=1000, speed=1.0), *shears(16, (0.4, 0.5, 0.6)), *moving((5, 5), 150.0),
                *about(12, 4, (0.5, 0.1), (0.4,), 10.0),
                *tails(48, 6, 400),
                *(Capacity(C=20.0, corrected=one, steps=400) for one in (True, False))]
    return [*algebra(("lattice", "jittered-0.1", "jittered-0.3", "random"), {1: (20,), 2: (10, 12), 3: (5, 5, 6)}),
            *flows((9, 9), 96, (8, 12, 16)), *steps(),
            Equipartition(counts=(12, 12), turns=TURNS, share=0.1, steps=1500),
            Brillouin(points=33, turns=(2, 3, 4), steps=30000), Brillouin(points=33, turns=(2, 3, 4), steps=20000, speed=1.0),
            *cubes(750), *shears(64, (0.1, 0.14, 0.2, 0.28, 0.4)), *moving((6, 6), 150.0), *tails(64, 6, 1200),
            *about(24, 8, (0.5, 0.1, 0.05, 0.02), (0.1, 0.2, 0.4), DECAYS),
            Nonlinear(counts=(8, 8), share=0.1, k=1e-3, time=200.0),
            *(Capacity(C=C, corrected=one, steps=10000) for one in (True, False) for C in (20.0, 50.0))]


PART = Part(cases=cases, tables=fluct_tables.ALL, figures=fluct_figures.figures,
              claims=(*fluct_claims.CLAIMS, *fluct_claims_noise.NOISE, *fluct_claims_flows.FLOWS, *fluct_special.CLAIMS))
