"""Dissipative particles: which integrator knows its temperature, and are pressure, structure and transport those of print?

Groot & Warren's fluid (a = 25, rho = 3, gamma = 4.5, rc = 1, kT = 1) in a periodic cube, with RR98's Eqs 40, 41 and five other
steps; states of Allen & Tildesley; waves of density; shear between sliding sides; why a step puts kT of the positions off; a
cylinder of frozen particles in a stream. Paper size takes some forty minutes of one core.
Writes results/noise/*.csv and *.png and the rows of study noise in results/claims.csv.
"""
from collections.abc import Iterator
from typing import Any

from matplotlib.figure import Figure

from particles.dissipative.integrators import GrootWarren, GrootWarren65, Shardlow, VelocityVerlet
from particles.dissipative.pairs3d import Normal
from particles.integral.splitting import KickDriftFrictionDriftKick
from particles.integrators import TwoStep
from studies.kit.case import Case
from studies.kit.study import Part
from studies.kit.table import Tables
from studies.noise.dpd import claims as dpd_claims
from studies.noise.dpd import claims_more as dpd_claims_more
from studies.noise.dpd import claims_surfaces as dpd_claims_surfaces
from studies.noise.dpd import derive as dpd_derive
from studies.noise.dpd import derive_more as dpd_derive_more
from studies.noise.dpd import derive_surfaces as dpd_derive_surfaces
from studies.noise.dpd import figures as dpd_figures
from studies.noise.dpd import figures_more as dpd_figures_more
from studies.noise.dpd import figures_surfaces as dpd_figures_surfaces
from studies.noise.dpd import friction as dpd_friction
from studies.noise.dpd import long as dpd_long
from studies.noise.dpd import tables as dpd_tables
from studies.noise.dpd.cylinder import Cylinder, Inertia
from studies.noise.dpd.runs import Fluid, Rest, Shear, Structure
from studies.noise.dpd.surfaces import DENSER, FAST, Array, Slab
from studies.noise.dpd.verlet import Steps, Stiffness

INTEGRATORS = (TwoStep, GrootWarren, GrootWarren65, VelocityVerlet, Shardlow, KickDriftFrictionDriftKick)
STEPS = (0.01, 0.02, 0.03, 0.04, 0.06, 0.08)
GAS = (0.02, 0.04, 0.06, 0.08, 0.12)       # without repulsion friction alone limits the step
LONG = 12_000       # steps of a run: its error of kT over dt is what counts, which falls as dt grows


def cases(size: str) -> list[Case]:
    """`quick` has small boxes, short runs and three steps."""
    if size == "quick":
        return [*temperatures((0.02, 0.04, 0.06), side=5.0, steps=1000), *gas((0.04, 0.08, 0.12), side=5.0, steps=1000),
                *densities((2.5, 3.5), side=5.0, time=20.0),
                *waves_and_shear({0.2: 30.0}, side=5.0, time=30.0, long=30.0), *second_order((0.03, 0.045), side=4.0, time=60.0),
                *dpd_long.cases(side=4.0, time=20.0, longer=20.0), *dpd_friction.cases(side=4.0, time=20.0),
                *cylinders(((False, 1.0), (True, 1.0)), time=30.0, shear=30.0, rows=12),
                *surfaces(radius=1.2, larger=1.4, time=40.0, wall=40.0, shear=30.0, rows=12, height=4.0, others=(3.3,))]
    return [*temperatures(STEPS, side=8.0, steps=LONG), *gas(GAS, side=8.0, steps=LONG),
            Rest(integrator=Shardlow, dt=0.01, time=120.0), Rest(integrator=TwoStep, dt=0.01, time=300.0),
            *densities((2.6, 2.8, 3.2, 3.4, 4.0, 5.0, 6.0, 8.0), side=8.0, time=60.0), *table(),
            *waves_and_shear({0.1: 110.0, 0.2: 310.0, 0.4: 110.0}, side=10.0, time=110.0, long=1200.0),
            *second_order((0.03, 0.045), side=6.0, time=4000.0), *dpd_long.cases(side=8.0, time=500.0, longer=1500.0),
            *dpd_friction.cases(side=4.0, time=100.0),
            *cylinders(((False, 2.0), (False, 3.0), (True, 2.0)), time=1500.0, shear=500.0, rows=16),
            *surfaces(radius=2.0, larger=4.0, time=1000.0, wall=4000.0, shear=500.0, rows=16, height=8.0,
                      others=(2.7, 2.85, 3.15, 3.3))]


def temperatures(found: tuple[float, ...], *, side: float, steps: int) -> Iterator[Fluid]:
    """All integrators and steps; normal noise once; once in the plane."""
    for integrator in INTEGRATORS:
        yield from (Rest(integrator=integrator, dt=dt, side=side, time=steps*dt) for dt in found)
    yield Rest(integrator=GrootWarren65, dt=0.04, noise=Normal, side=side, time=steps*0.04)
    yield Rest(integrator=Shardlow, d=2, side=4*side, time=steps*0.02/4)


def gas(found: tuple[float, ...], *, side: float, steps: int) -> Iterator[Fluid]:
    """RR98's step without repulsion: what friction and noise alone do to kT."""
    yield from (Rest(integrator=TwoStep, a=0.0, dt=dt, side=side, time=steps*dt) for dt in found)


def densities(found: tuple[float, ...], *, side: float, time: float) -> Iterator[Fluid]:
    """a = 25 at other densities."""
    yield from (Rest(integrator=Shardlow, rho=rho, side=side, time=time) for rho in found)


def table() -> Iterator[Fluid]:
    """States of Allen & Tildesley: a = 75 kT/rho; one with their 100 particles."""
    yield Rest(integrator=Shardlow, side=(100/3)**(1/3), time=4000.0)
    for kT, rho in ((1.0, 2.0), (1.0, 4.0), (1.0, 5.0), (0.5, 3.0)):
        yield Rest(integrator=Shardlow, dt=0.01, a=75*kT/rho, kT=kT, rho=rho, side=8.0, time=240.0)


def waves_and_shear(times: dict[float, float], *, side: float, time: float, long: float) -> Iterator[Fluid]:
    """Long waves; shear with repulsion, at each rate for its time, and without; diffusion without."""
    yield Structure(integrator=Shardlow, side=side, time=long)
    yield from (Shear(integrator=VelocityVerlet, side=side, time=of_rate, rate=rate) for rate, of_rate in times.items())
    yield Shear(integrator=VelocityVerlet, a=0.0, side=side, time=time, rate=0.2)
    yield Rest(integrator=Shardlow, a=0.0, side=side, time=time)
    yield Rest(integrator=Shardlow, dt=0.025, side=0.8*side, time=20.0, pairs=True)


def second_order(found: tuple[float, ...], *, side: float, time: float) -> Iterator[Fluid]:
    """Averages that say what a step does; what it does."""
    yield Stiffness(integrator=Shardlow, dt=0.01, side=side/2 + 1, time=time/8)
    yield from (Steps(integrator=Shardlow, dt=dt, side=side, time=time) for dt in found)


def cylinders(bodies: tuple[tuple[bool, float], ...], *, time: float, shear: float, rows: int) -> Iterator[Case]:
    """Streams past cylinders; the viscosity at their step; what inertia adds."""
    yield from (Cylinder(turns=turns, radius=radius, time=time*(2/radius)**1.5) for turns, radius in bodies)
    yield Shear(integrator=VelocityVerlet, dt=0.04, side=8.0, time=shear, rate=0.3)
    yield Inertia(rows=rows)


def surfaces(*, radius: float, larger: float, time: float, wall: float, shear: float, rows: int, height: float,
             others: tuple[float, ...]) -> Iterator[Case]:
    """Surfaces of frozen bodies, one thing changed at a time: turned back, denser, flat; more force, a larger cylinder."""
    yield Array(radius=radius, time=2*time)
    yield Slab(height=height, time=wall)
    for turns, denser in ((True, 1.0), (False, DENSER)):
        yield Array(turns=turns, denser=denser, radius=radius, reynolds=FAST, time=time)
        yield Slab(turns=turns, denser=denser, height=height, time=1.5*time)
    yield Array(radius=radius, reynolds=FAST, time=time)
    yield Array(radius=larger, reynolds=FAST, time=time)
    yield from (Shear(integrator=VelocityVerlet, dt=0.04, side=8.0, time=shear, rate=0.3, rho=rho) for rho in others)
    # the stream of about 5 that a force for `FAST` makes
    yield Inertia(rows=rows, reynolds=5.0, eta=0.1)


def derived(tables: Tables) -> dict[str, list[dict[str, Any]]]:
    """Derived rows."""
    return {**dpd_derive.derive(tables), **dpd_derive_more.derive(tables), **dpd_derive_surfaces.derive(tables)}


def drawn(tables: Tables) -> dict[str, Figure]:
    """Figures."""
    return {**dpd_figures.figures(tables), **dpd_figures_more.figures(tables), **dpd_figures_surfaces.figures(tables)}


PART = Part(cases=cases, tables=dpd_tables.ALL, derive=derived, figures=drawn,
              claims=(*dpd_claims.CLAIMS, *dpd_claims_more.CLAIMS, *dpd_claims_surfaces.CLAIMS, *dpd_long.CLAIMS,
                      *dpd_friction.CLAIMS))
