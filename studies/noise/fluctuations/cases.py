"""What of RR98's fluctuating hydrodynamics holds on fixed points, and what must take its place?    [RR98 Eqs 20-25, 42-44]

Algebra first: is the covariance of the noise 2 kT times the dissipation, for one random stress a point, for noise along edges,
for the printed Eqs 42-44? Then Lyapunov solves: rest, a layer heated from below, steps in time. Then samples, with intervals
from 20 batches: modes in 2D and 3D and below onset, Brillouin peaks, the nonlinear fluid, heat with current amplitudes. Units:
spacing 1, rho = T = 1, ideal gas, C_V = 1.
Paper size takes some minutes of one core. Writes results/fluctuations/*.csv and *.png and the rows of study
fluctuations in results/claims.csv.
"""
from collections.abc import Iterator
from itertools import product

from particles.integral.covariance import STEPS
from particles.integral.edge_makers import MAKERS
from studies.build.disorder import DISORDERS
from studies.kit.case import Case
from studies.kit.study import Part
from studies.noise.fluctuations import claims as fluct_claims
from studies.noise.fluctuations import claims_noise as fluct_claims_noise
from studies.noise.fluctuations import figures as fluct_figures
from studies.noise.fluctuations import tables as fluct_tables
from studies.noise.fluctuations.algebra import MovingPartnership, Partnership, PrintedWaves
from studies.noise.fluctuations.arithmetic import Formulas
from studies.noise.fluctuations.flows import BelowOnset, Rest
from studies.noise.fluctuations.given_sampled import DECAYS, LayerSampled
from studies.noise.fluctuations.modes import Equipartition
from studies.noise.fluctuations.nonlinear import Capacity, Nonlinear
from studies.noise.fluctuations.peaks import Brillouin
from studies.noise.fluctuations.special import SpecialCase
from studies.noise.fluctuations.steps import Moving, Steps

DT = (0.01, 0.02, 0.05, 0.1, 0.2, 0.4, 0.8)
TURNS = ((1, 0), (0, 1), (1, 1), (1, -1), (2, 1), (3, 0), (0, 4), (3, 3), (5, 2), (5, 5))
TURNS_3D = ((1, 0, 0), (0, 1, 0), (0, 0, 1), (1, 1, 0), (1, 0, -1), (0, 1, 1), (1, 1, 1), (1, -1, 1), (2, 0, 0), (2, 1, 0))


def formulas() -> list[Case]:
    """What printed formulas give by arithmetic."""
    return [Formulas(), SpecialCase()]


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


def flows(counts: tuple[int, int], rows: tuple[int, ...]) -> Iterator[Case]:
    """Lyapunov solves; odd lattices have no corners of the zone, where nothing damps density and nested transport nothing."""
    for maker, kind in (("renormalised", "lattice"), ("delaunay", "jittered-0.3"), ("delaunay", "random"),
                        ("plain", "jittered-0.3"), ("closed", "jittered-0.1"), ("exact", "jittered-0.1")):
        for share in (0.0, 0.1, 1.0):
            yield Rest(maker=maker, disorder=DISORDERS[kind], counts=counts, share=share,
                       h=3.0 if maker in ("exact", "closed") else 2.0)
    yield Rest(maker="renormalised", disorder=DISORDERS["lattice"], counts=(21,), share=0.1)
    yield Rest(maker="renormalised", disorder=DISORDERS["lattice"], counts=(5, 5, 5), share=0.1)
    for n in rows:
        yield BelowOnset(rows=n, below=(0.9, 0.5, 0.2, 0.1, 0.05, 0.02, 0.01, 0.005))


def steps() -> Iterator[Case]:
    """All integrators, waves of 15 to 300 spacings."""
    for k in (0.02, 0.1, 0.4):
        for integrator in STEPS:
            yield Steps(integrator=integrator, k=k, dt=DT)
        for both in (True, False):
            yield Moving(k=k, dt=DT, both=both)


def about(rows: int, below: tuple[float, ...], decays: float) -> Iterator[Case]:
    """Samples of the linear equations about a layer below onset; random numbers of their own."""
    for number, part in enumerate(below):
        yield LayerSampled(rows=rows, below=part, seed=11 + number, decays=decays)


def cubes(steps: int) -> Iterator[Case]:
    """Samples in 3D: a lattice with odd sides, which has no corner of its zone; irregular points."""
    yield Equipartition(counts=(5, 5, 5), turns=TURNS_3D, share=0.1, steps=steps, dt=3.0, maker="renormalised",
                        disorder=DISORDERS["lattice"])
    yield Equipartition(counts=(5, 5, 6), turns=TURNS_3D, share=0.0, steps=steps, dt=3.0)


def cases(size: str) -> list[Case]:
    """`quick` has fewer point sets and batches a tenth as long."""
    if size == "quick":
        return [*formulas(), *algebra(("lattice", "jittered-0.3"), {2: (8, 8)}), *flows((7, 7), (6,)), *steps(),
                Equipartition(counts=(6, 6), turns=TURNS[:6], share=0.1, steps=200),
                Brillouin(points=13, turns=(1, 2), steps=1000), Nonlinear(counts=(5, 5), share=0.1, k=1e-3, time=115.0),
                *about(4, (0.5, 0.1), 10.0),
                *(Capacity(C=20.0, corrected=one, steps=400) for one in (True, False))]
    return [*formulas(),
            *algebra(("lattice", "jittered-0.1", "jittered-0.3", "random"), {1: (20,), 2: (10, 12), 3: (5, 5, 6)}),
            *flows((9, 9), (8, 12, 16)), *steps(),
            Equipartition(counts=(12, 12), turns=TURNS, share=0.1, steps=1500),
            Brillouin(points=33, turns=(2, 3, 4), steps=30000), *cubes(750), *about(8, (0.5, 0.1, 0.05, 0.02), DECAYS),
            Nonlinear(counts=(8, 8), share=0.1, k=1e-3, time=200.0),
            *(Capacity(C=C, corrected=one, steps=10000) for one in (True, False) for C in (20.0, 50.0))]


PART = Part(cases=cases, tables=fluct_tables.ALL, figures=fluct_figures.figures,
              claims=(*fluct_claims.CLAIMS, *fluct_claims_noise.NOISE))
