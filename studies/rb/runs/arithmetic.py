"""Numbers that need no flow: printed ones, equations of state, weights, a few particles    [KHP95]"""
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
from studies.rb.runs.lattices import AXES, BOTH, LUCY, MONAGHAN, RANGE, decay, density, largest_modulus, least

Numbers = dict[str, Measured | float]
IDEAL, VDW, DENSE = IdealGas(), VanDerWaals(), DenseFluid()
BOXES = (2, 3, 4, 7, 9, 10, 12)     # figures whose captions print particles and box


@dataclass(frozen=True, kw_only=True)
class WithoutFlow(Case):
    """The numbers that one function of this module gives by name."""
    numbers: Callable[[], Numbers]

    @property
    def cost(self) -> float:
        return 15.0

    def run(self, report: Report, folder: Path) -> Outcome:
        rows = [row(name, measured(one)) for name, one in self.numbers().items()]
        return Outcome({"arithmetic": rows})


def row(name: str, one: Measured) -> dict[str, Any]:
    """A row of the table `arithmetic`."""
    return {"quantity": name, "value": float(one.value), "err": float(one.err)}


def density_of(figure: int) -> float:
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
    """Ra where the line in Ra^-1/2 through both printed grid energies is zero; error from rounding."""
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


def printed_numbers() -> Numbers:
    """What the paper's own numbers say of each other."""
    L_fig10, eta_fig10 = number("fig10-height"), number("fig10-eta-ideal")
    return {
        "largest |density - 1| of captions": max(abs(density_of(figure) - 1) for figure in BOXES),
        "largest |Ra - 10 000| of captions": max(abs(caption_ra(figure)) for figure in (2, 3, 8, 9, 12)),
        "Ra of Fig. 10, dT^2 L^2/eta^2": (9.5*L_fig10/eta_fig10)**2,
        "Ra of Fig. 10, alpha = 1/<T>": ra_by_expansivity(),
        "Ra of Fig. 4 over onset": number("fig4-ra")/critical_ra(pi),
        "1 - K/K printed, Ra 5000": energy_error(5000),
        "1 - K/K printed, Ra 10 000": energy_error(10000),
        "1 - sqrt(K/K) printed, Ra 5000": velocity_error(5000),
        "1 - sqrt(K/K) printed, Ra 10 000": velocity_error(10000),
        "zero of the line through both printed K": zero_of_pair(),
        "K at Ra 10 000 on the line from onset through K at Ra 5000": read_line(),
        "4^(1/2)": number("line-range")**-number("line-exponent"),
        "initial over final kinetic energy": Measured(9.0, 0.5)/(5000*number("ke-10000")),
        "5000 eta/L^2": number("fig9-time")*0.5/50**2,
        "rows of 1800 points in a box 1 x 2": sqrt(number("fig12-points")/2),
    }


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
    """(dE/dV)_T = -rho^2 (de/drho)_T of the dense fluid; e is quadratic: wide differences are exact."""
    return -float(energy(DENSE, 1.5, 1.0) - energy(DENSE, 0.5, 1.0))


def pressure_by_temperature() -> float:
    """d(beta P)/d(beta) = P - T (dP/dT)_rho of the dense fluid."""
    return at_reference(DENSE)[0] - thermal_pressure(DENSE, 1.0, 1.0)


def wall_mismatch() -> float:
    """Largest |T(1, u(1, T)) - T| between the plates."""
    T = np.linspace(0.5, 1.5, 11)
    return float(np.max(np.abs(temperature(DENSE, 1.0, energy(DENSE, 1.0, T)) - T)))


def critical_slopes(step: float = 1e-4) -> float:
    """Largest of dP/drho and d2P/drho2 along the critical isotherm at the critical density, as printed."""
    rho, T = number("vdw-critical-density"), number("vdw-critical-temperature")
    P = [pressure(VDW, r, energy(VDW, r, T)) for r in (rho - step, rho, rho + step)]
    first, second = (P[2] - P[0])/(2*step), (P[2] - 2*P[1] + P[0])/step**2
    return float(max(abs(first), abs(second)))


def equations_of_state() -> Numbers:
    """What Eqs 1 to 3 say at the reference state, and whether gravity balances them."""
    by_volume, by_temperature = energy_by_volume(), pressure_by_temperature()
    return {
        "rho c^2/P, ideal": 2/stiffness(IDEAL),
        "slope and curvature at the critical point, vdw": critical_slopes(),
        "a, vdw": VDW.a,
        "b, vdw": VDW.b,
        "imbalance of forces at rest": max(map(imbalance, EQUATIONS_OF_STATE.values())),
        "g L/dT, ideal": 50*RayleighBenard(ra=1e4).g,
        "|C_V - 1|, ideal and vdw": max(abs(eos.cv - 1) for eos in (IDEAL, VDW)),
        "C_V, dense": DENSE.cv,
        "C_P, ideal": heat_capacity(IDEAL),
        "(dE/dV)_T, dense": by_volume,
        "d(beta P)/d(beta), dense": by_temperature,
        "(dE/dV)_T over -d(beta P)/d(beta), dense": by_volume/-by_temperature,
        "largest |T(u(T)) - T|, dense": wall_mismatch(),
        "2 P/(rho c^2), dense": stiffness(DENSE),
        "2 P/(rho c^2), vdw over dense": stiffness(VDW)/stiffness(DENSE),
        "P/(rho c^2), dense": stiffness(DENSE)/2,
    }


def weights() -> Numbers:
    """The two weights as printed, and lattices summed with them: of both the worse, or the lesser energy."""
    jumps = [jump for weight in BOTH for order in (0, 1, 2) for jump in weight.jumps(order)]
    at_range = [weight.pieces[-1][1].deriv(order)(RANGE) for weight in BOTH for order in (1, 2)]
    apart = RANGE**2*sqrt(3)/2      # particles a site of a hexagonal lattice with sites a range apart
    crowded = [density(weight, "hexagonal", apart)/least(weight, "hexagonal")[0] for weight in BOTH]
    square = [least(weight, "square")[0]/least(weight, "hexagonal")[0] for weight in BOTH]
    return {
        "integral, Lucy": LUCY.integral,
        "integral, Monaghan": MONAGHAN.integral,
        "largest jump of w, w', w''": max(map(abs, jumps)),
        "w' and w'' at the range": max(map(abs, at_range))/float(LUCY(0.0)),
        "range": RANGE,
        "w(0.9) - w(1), Lucy": LUCY(0.9) - LUCY(1.0),
        "|G/B|, hexagonal": max(largest_modulus(weight, "hexagonal") for weight in BOTH),
        "|G/B|, square": max(largest_modulus(weight, "square") for weight in BOTH),
        "|G/B|, hexagonal, Lucy": largest_modulus(LUCY, "hexagonal"),
        "|G/B| at h = 6 over h = 3, hexagonal": decay("hexagonal"),
        "|G/B| at h = 6 over h = 3, square": decay("square"),
        "energy of sites h apart over the least": min(crowded),
        "particles a site, Lucy": min(least(LUCY, kind) for kind in AXES)[1],
        "particles a site, Monaghan": min(least(MONAGHAN, kind) for kind in AXES)[1],
        "least energy, square over hexagonal": min(square),
    }


def few_particles() -> Numbers:
    """Conservation and orders in time of 36 particles."""
    return {
        "accelerations against -grad of sum 2 w": few.not_molecular(),
        "drift of kinetic energy and sum of w": few.energy_drift(),
        "order of the way back": few.order(few.return_errors, few.STEPS[:3], pressure=few.quadratic),
        "sum of forces over moduli": few.momentum_left(),
        "sum of energy rates over moduli": few.energy_left(),
        "error of RK4 over midpoint": few.against_midpoint(),
        "order of RK4, dt 0.6 to 0.15": few.order(few.step_errors, few.STEPS, eta=0.3),
        "order of RK4, dt 0.075 to 0.019": few.order(few.step_errors, few.SMALL, eta=0.3),
    }


SUBJECTS = (printed_numbers, equations_of_state, weights, few_particles)
