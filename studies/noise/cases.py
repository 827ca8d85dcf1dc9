"""Cases and tables of the study noise: points [RR98 Eqs 20-25, 42-44], dissipative particles [Sec. III B]

Units of points: spacing 1, rho = T = 1, ideal gas, C_V = 1.
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
from particles.integral.edge_makers import MAKERS
from particles.integrators import TwoStep
from studies.build.setting import DISORDERS
from studies.kit.case import Case
from studies.kit.table import Table
from studies.noise import dissipative, partners
from studies.noise.covariance import BelowOnset, Steps
from studies.noise.dissipative import AtRest, LongRun
from studies.noise.partners import Formula, Partnership, PrintedWaves
from studies.noise.sampling import Capacity, Nonlinear

KINDS = ("lattice", "jittered-0.1", "jittered-0.3", "random")
DT = (0.01, 0.02, 0.05, 0.1, 0.2, 0.4, 0.8)
BELOW = (0.9, 0.5, 0.2, 0.1, 0.05, 0.02, 0.01, 0.005, 0.002, 0.001, 0.0005)
PRINTED = ((42, "eta"), (42, "zeta"), (23, "zeta"), (43, "kappa"), (25, "kappa"))
FORMULAS = {
    "partner of Eq. 42": partners.other_partner, "step of Eq. 42": partners.half_step,
    "spacing of Eq. 42": partners.half_spacing,
    "dissipative particles, form": dissipative.form,
    "dissipative particles, unmodified": dissipative.unmodified,
    "dissipative particles, viscosity doubled": partners.viscosity,
    "dissipative particles, viscosity single": partners.viscosity_single}

#: integrators of dissipative particles, and time steps
GOOD = (GrootWarren, GrootWarren65, VelocityVerlet, Shardlow, KickDriftFrictionDriftKick)
LIQUID = (0.01, 0.02, 0.03, 0.04, 0.06, 0.08)
HUNDRED = (100/3)**(1/3)    # side of a box of 100 particles, as in the example of Allen & Tildesley


def cases(size: str) -> list[Case]:
    """Cases of a size; `quick` has fewer point sets, shorter batches, small boxes and three time steps."""
    formulas = [Formula(name=name, value=value) for name, value in FORMULAS.items()]
    steps = [Steps(wavenumber=k, dt=DT) for k in (0.02, 0.1, 0.4)]      # waves of 15 to 300 spacings
    return [*formulas, *printed(), *steps, *(quick() if size == "quick" else paper())]


def quick() -> list[Case]:
    """Short cases of each other kind."""
    return [
        *algebra(("lattice", "jittered-0.3"), {2: (8, 8)}),
        BelowOnset(rows=6, parts=BELOW),
        Nonlinear(counts=(5, 5), share=0.1, k=1e-3, time=115.0),
        Capacity(C=20.0, steps=400),
        *temperatures((0.02, 0.04, 0.06), side=5.0, steps=1000),
        LongRun(integrator=Shardlow, side=4.0, time=20.0)]


def paper() -> list[Case]:
    """All others."""
    return [
        *algebra(KINDS, {1: (20,), 2: (10, 12), 3: (5, 5, 6)}),
        *(BelowOnset(rows=rows, parts=BELOW) for rows in (8, 12, 16)),
        Nonlinear(counts=(8, 8), share=0.1, k=1e-3, time=200.0),
        Capacity(C=20.0, steps=10000),
        # at any step the same number of them: the statistical error of kT over dt matters
        *temperatures(LIQUID, side=8.0, steps=12_000),
        AtRest(integrator=Shardlow, side=HUNDRED, time=4000.0),
        # 240 was too short to tell an error of 1 % in kT
        *(LongRun(integrator=one, time=500.0 if one is KickDriftFrictionDriftKick else 1500.0)
          for one in GOOD)]


def algebra(kinds: tuple[str, ...], counts: dict[int, tuple[int, ...]]) -> Iterator[Case]:
    """Exact partners on every edge maker, kind of points and dimension."""
    for (name, maker), kind, d in product(MAKERS.items(), kinds, counts):
        if not (name == "delaunay" and (d == 1 or (d == 3 and kind == "lattice"))):
            h = 2.7 if d < 3 else 2.4
            yield Partnership(maker=maker, points=DISORDERS[kind], counts=counts[d], h=h)


def printed() -> Iterator[Case]:
    """Variance of printed noise in waves."""
    places = ((1, 1.5), (2, 1.2), (2, 3.0))
    for (equation, term), reading, (d, h) in product(PRINTED, ("single", "doubled"), places):
        if not (term == "eta" and d == 1):      # there is no shear on a line
            yield PrintedWaves(equation=equation, term=term, reading=reading, d=d, h=h)


def temperatures(dts: tuple[float, ...], *, side: float, steps: int) -> Iterator[Case]:
    """Temperatures of dissipative particles with all integrators and time steps."""
    for integrator, dt in product((TwoStep, *GOOD), dts):
        yield AtRest(integrator=integrator, dt=dt, side=side, time=steps*dt)


# --- tables -------------------------------------------------------------------------------------

#: columns of dissipative particles, in units of mass, rc and kT
HOT = {"dt": ("time step", "rc (m/kT)^(1/2)"), "time": ("time of the run", "rc (m/kT)^(1/2)"),
       "n": ("number of particles", ""), "P": ("pressure", "kT/rc^3"),
       "kinetic": ("kT from velocities over that asked for", ""),
       "configurational": ("kT from forces over that asked for", "")}
MEANS = "n time kinetic kinetic_err configurational configurational_err P P_err"

TABLES = (
    Table.of("partners", "maker points d noise", "mismatch sums",
             about="A noise beside its dissipation on one set of points, coefficients random by factors of "
                   "five."),
    Table.of("printed", "equation term reading d h wavenumber", "ratio predicted",
             about="A wave of noise as a paper's equation prints it.",
             means={"ratio": ("variance over its due, 2 kT Gamma of Eq. 37 or 38", "")}),
    Table.of("onset", "rows below", "ra_c velocity",
             about="A motionless layer on the way to onset, linearised.",
             means={"velocity": ("variance of vertical velocities, 1 in equilibrium", "")}),
    Table.of("steps", "integrator fluid wavenumber dt", "velocity error",
             about="What an integrator makes of a wave with noise at one step.",
             means={"dt": ("time step", "eta/(rho c^2)"),
                    "velocity": ("variance of the velocity, 1 in equilibrium", ""),
                    "error": ("of this variance", "")}),
    Table.of("nonlinear", "share k field", "ratio ratio_err drift",
             about="A field of the full equations with current amplitudes, sampled.",
             means={"k": ("Boltzmann's constant", ""), "ratio": ("variance over that of equilibrium", "")}),
    Table.of("capacity", "C", "measured measured_err due",
             about="The variance of temperatures with current amplitudes.",
             means={"measured": ("variance of T over T^2", ""),
                    "due": ("the same by the entropy C ln T", "")}),
    Table.of("formulas", "name", "value", about="What a printed formula gives by arithmetic."),
    Table.of("states", "integrator side dt", MEANS, means=HOT,
             about="A steady state of dissipative particles at one step."),
    Table.of("long", "integrator side dt", MEANS,
             means=HOT | {"P": ("pressure, with rho kT as it is asked for", "kT/rc^3")},
             about="A long run of dissipative particles at the usual step."))
