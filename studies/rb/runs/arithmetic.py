"""Numbers that need no flow: printed ones beside each other, equations of state, weights, a few particles    [KHP95]"""
from collections.abc import Callable
from dataclasses import dataclass
from itertools import product
from math import pi, sqrt
from pathlib import Path
from typing import Any

import numpy as np

from continuum.fluid import (
    EQUATIONS_OF_STATE,
    DenseFluid,
    IdealGas,
    VanDerWaals,
    energy,
    expansivity,
    pressure,
    sound_speed,
    temperature,
    thermal_pressure,
)
from continuum.linear.layer import critical_ra
from continuum.published import published
from continuum.scene import RayleighBenard, Walls
from studies.build.names import number
from studies.kit.case import Case, Outcome, Report
from studies.kit.stats import Measured, measured
from studies.rb.runs import few_particles as few
from studies.rb.runs.lattices import (
    LUCY,
    MONAGHAN,
    RANGE,
    at_cutoff,
    crowded,
    decay,
    largest_modulus,
    occupancy,
    roughest,
    square_over_hexagonal,
    stiffest,
)

Number = Callable[[], Measured | float]
IDEAL, VDW, DENSE = IdealGas(), VanDerWaals(), DenseFluid()
BOXES = (2, 3, 4, 7, 9, 10, 12)     # figures whose captions print particles and box


# --- printed numbers ------------------------------------------------------------------------------


def density(figure: int) -> float:
    """Particles per area of a figure's box."""
    return number(f"fig{figure}-particles")/(number(f"fig{figure}-height")*number(f"fig{figure}-width"))


def caption_ra(figure: int) -> float:
    """Ra = dT^2 L^2/eta^2 of an ideal gas with dT = 1 in a box 50 high, less the printed one."""
    return (50/number(f"fig{figure}-eta"))**2 - number(f"fig{figure}-ra")


def energy_error(ra: int) -> Measured:
    """1 - K_particles/K_grid of the printed energies."""
    particles, grid = (published(f"khp95-ke-{ra}{end}") for end in ("-spam", ""))
    ratio = particles.value/grid.value
    rounding = sum(one.uncertainty/one.value for one in (particles, grid))
    return Measured(1 - ratio, ratio*rounding)


def velocity_error(ra: int) -> Measured:
    """The same of velocities, 1 - (K_particles/K_grid)^(1/2)."""
    error = energy_error(ra)
    return Measured(1 - sqrt(1 - error.value), error.err/2/sqrt(1 - error.value))


def zero_of_pair() -> Measured:
    """Ra where the line in Ra^-1/2 through both printed grid energies is zero; error from rounding of both."""
    (a, k), (b, q) = ((ra**-0.5, published(f"khp95-ke-{ra}")) for ra in (5000, 10000))

    def zero(low: float = 0.0, high: float = 0.0) -> float:
        one, other = k.value + low*k.uncertainty, q.value + high*q.uncertainty
        return ((one*b - other*a)/(one - other))**-2
    corners = product((-1.0, 1.0), repeat=2)
    return Measured(zero(), max(abs(zero(*corner) - zero()) for corner in corners))


def read_line() -> Measured:
    """K at Ra 10 000 on the line through zero at onset and the printed K at Ra 5000."""
    start, k = critical_ra(pi), published("khp95-ke-5000")
    factor = (1 - sqrt(start/10000))/(1 - sqrt(start/5000))
    return Measured(k.value*factor, k.uncertainty*factor)


def ra_by_expansivity() -> float:
    """Ra of Fig. 10 by the definition of Sec. I, alpha = 1/<T>."""
    scene = RayleighBenard(ra=1.0, L=number("fig10-height"), T_hot=number("fig10-temperature-hot"),
                           T_cold=number("fig10-temperature-cold"), aspect=1.0, sides=Walls())
    return scene.g*scene.alpha*scene.L**3*scene.dT/number("fig10-eta-ideal")**2


def initial_energy() -> Measured:
    """9 +- 0.5 of kinetic energy in 5000 particles over the printed final energy."""
    value, err = (x/5000/number("ke-10000") for x in (9.0, 0.5))
    return Measured(value, err)


PRINTED: dict[str, Number] = {
    "largest |density - 1| of captions": lambda: max(abs(density(figure) - 1) for figure in BOXES),
    "largest |Ra - 10 000| of captions": lambda: max(abs(caption_ra(figure)) for figure in (2, 3, 8, 9, 12)),
    "Ra of Fig. 10, dT^2 L^2/eta^2": lambda: (9.5*number("fig10-height")/number("fig10-eta-ideal"))**2,
    "Ra of Fig. 10, alpha = 1/<T>": ra_by_expansivity,
    "Ra of Fig. 4 over onset": lambda: number("fig4-ra")/critical_ra(pi),
    "1 - K/K printed, Ra 5000": lambda: energy_error(5000),
    "1 - K/K printed, Ra 10 000": lambda: energy_error(10000),
    "1 - sqrt(K/K) printed, Ra 5000": lambda: velocity_error(5000),
    "1 - sqrt(K/K) printed, Ra 10 000": lambda: velocity_error(10000),
    "zero of the line through both printed K": zero_of_pair,
    "K at Ra 10 000 on the line from onset through K at Ra 5000": read_line,
    "4^(1/2)": lambda: number("line-range")**-number("line-exponent"),
    "initial over final kinetic energy": initial_energy,
    "5000 eta/L^2": lambda: number("fig9-time")*0.5/50**2,
    "rows of 1800 points in a box 1 x 2": lambda: sqrt(number("fig12-points")/2),
}


# --- equations of state ---------------------------------------------------------------------------


def at_reference(eos: Any) -> tuple[float, float]:
    """(P, rho c^2) at density and temperature 1."""
    e = energy(eos, 1.0, 1.0)
    return float(pressure(eos, 1.0, e)), float(sound_speed(eos, 1.0, e)**2)


def stiffness(eos: Any) -> float:
    """2 P/(rho c^2) at density and temperature 1."""
    P, rho_c2 = at_reference(eos)
    return 2*P/rho_c2


def heat_capacity(eos: Any) -> float:
    """C_P = C_V + T alpha (dP/dT)_rho/rho at density and temperature 1."""
    return eos.cv + expansivity(eos, 1.0, 1.0)*float(thermal_pressure(eos, 1.0, 1.0))


def imbalance(eos: Any) -> float:
    """Largest |P(y) + rho g y - P(0)| over P(0) in the motionless state."""
    scene = RayleighBenard(ra=1e4, eos=eos)
    y = np.linspace(-0.5, 0.5, 101)*scene.L
    total = pressure(eos, 1.0, scene.e(y)) + scene.g*y
    return float(np.ptp(total)/total.mean())


def energy_by_volume() -> float:
    """(dE/dV)_T = -rho^2 (de/drho)_T of the dense fluid; e is quadratic, so that wide differences are exact."""
    return -float(energy(DENSE, 1.5, 1.0) - energy(DENSE, 0.5, 1.0))


def pressure_by_temperature() -> float:
    """d(beta P)/d(beta) = P - T (dP/dT)_rho of the dense fluid."""
    return at_reference(DENSE)[0] - thermal_pressure(DENSE, 1.0, 1.0)


def wall_mismatch() -> float:
    """Largest |T(1, u(1, T)) - T| between the plates."""
    T = np.linspace(0.5, 1.5, 11)
    return float(np.max(np.abs(temperature(DENSE, 1.0, energy(DENSE, 1.0, T)) - T)))


def critical_slopes(step: float = 1e-4) -> float:
    """Largest of dP/drho and d2P/drho2 along the printed critical isotherm at the printed critical density."""
    rho, T = number("vdw-critical-density"), number("vdw-critical-temperature")
    P = [pressure(VDW, r, energy(VDW, r, T)) for r in (rho - step, rho, rho + step)]
    first, second = (P[2] - P[0])/(2*step), (P[2] - 2*P[1] + P[0])/step**2
    return float(max(abs(first), abs(second)))


FLUIDS: dict[str, Number] = {
    "rho c^2/P, ideal": lambda: 2/stiffness(IDEAL),
    "slope and curvature at the critical point, vdw": critical_slopes,
    "a, vdw": lambda: VDW.a,
    "b, vdw": lambda: VDW.b,
    "imbalance of forces at rest": lambda: max(imbalance(eos) for eos in EQUATIONS_OF_STATE.values()),
    "g L/dT, ideal": lambda: 50*RayleighBenard(ra=1e4).g,
    "|C_V - 1|, ideal and vdw": lambda: max(abs(eos.cv - 1) for eos in (IDEAL, VDW)),
    "C_V, dense": lambda: DENSE.cv,
    "C_P, ideal": lambda: heat_capacity(IDEAL),
    "(dE/dV)_T, dense": energy_by_volume,
    "d(beta P)/d(beta), dense": pressure_by_temperature,
    "(dE/dV)_T over -d(beta P)/d(beta), dense": lambda: energy_by_volume()/-pressure_by_temperature(),
    "largest |T(u(T)) - T|, dense": wall_mismatch,
    "2 P/(rho c^2), dense": lambda: stiffness(DENSE),
    "2 P/(rho c^2), vdw over dense": lambda: stiffness(VDW)/stiffness(DENSE),
    "P/(rho c^2), dense": lambda: stiffness(DENSE)/2,
}


# --- weights and a few particles ------------------------------------------------------------------

WEIGHTS: dict[str, Number] = {
    "integral, Lucy": lambda: LUCY.integral,
    "integral, Monaghan": lambda: MONAGHAN.integral,
    "largest jump of w, w', w''": roughest,
    "w' and w'' at the range": at_cutoff,
    "range": lambda: RANGE,
    "w(0.9) - w(1), Lucy": lambda: LUCY(0.9) - LUCY(1.0),
    "|G/B|, hexagonal": lambda: stiffest("hexagonal"),
    "|G/B|, square": lambda: stiffest("square"),
    "|G/B|, hexagonal, Lucy": lambda: largest_modulus(LUCY, "hexagonal"),
    "|G/B| at h = 6 over h = 3, hexagonal": lambda: decay("hexagonal"),
    "|G/B| at h = 6 over h = 3, square": lambda: decay("square"),
    "energy of sites h apart over the least": crowded,
    "particles a site, Lucy": lambda: occupancy(LUCY),
    "particles a site, Monaghan": lambda: occupancy(MONAGHAN),
    "least energy, square over hexagonal": square_over_hexagonal,
}
PARTICLES: dict[str, Number] = {
    "accelerations against -grad of sum 2 w": few.not_molecular,
    "drift of kinetic energy and sum of w": few.energy_drift,
    "order of the way back": lambda: few.order(few.return_errors, few.STEPS[:3], pressure=few.quadratic),
    "sum of forces over moduli": few.momentum_left,
    "sum of energy rates over moduli": few.energy_left,
    "error of RK4 over midpoint": few.against_midpoint,
    "order of RK4, dt 0.6 to 0.15": lambda: few.order(few.step_errors, few.STEPS, eta=0.3),
    "order of RK4, dt 0.075 to 0.019": lambda: few.order(few.step_errors, few.SMALL, eta=0.3),
}
SUBJECTS = {"printed numbers": PRINTED, "equations of state": FLUIDS, "weights": WEIGHTS, "few particles": PARTICLES}


@dataclass(frozen=True, kw_only=True)
class Arithmetic(Case):
    """All numbers of one subject."""
    subject: str

    @property
    def label(self) -> str:
        return f"arithmetic of {self.subject}"

    @property
    def cost(self) -> float:
        return 15.0

    def run(self, report: Report, folder: Path) -> Outcome:
        return Outcome({"arithmetic": [row(name, number()) for name, number in SUBJECTS[self.subject].items()]})


def row(name: str, found: Measured | float) -> dict[str, Any]:
    """A row of the table `arithmetic`."""
    value, err = measured(found)
    return {"quantity": name, "value": float(value), "err": float(err)}
