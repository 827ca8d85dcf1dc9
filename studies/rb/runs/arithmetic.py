"""Numbers that need no flow: printed ones, equations of state, weights, a few particles    [KHP95]"""
from collections.abc import Callable, Iterator
from math import pi, sqrt
from typing import Any

import numpy as np

from continuum import fluid
from continuum.fluid import EQUATIONS_OF_STATE, DenseFluid, IdealGas, VanDerWaals, energy, pressure
from continuum.linear import critical_ra
from continuum.published import published
from continuum.scene import RayleighBenard, Walls
from studies.build.names import number as printed
from studies.kit.case import Case, Report
from studies.kit.stats import Measured, measured
from studies.rb.runs import few_particles as few
from studies.rb.runs.few_particles import AXES, BOTH, LUCY, MONAGHAN, RANGE, density, largest_modulus, least

Numbers = dict[str, Measured | float]
IDEAL, VDW, DENSE = IdealGas(), VanDerWaals(), DenseFluid()
BOXES = (2, 3, 4, 7, 9, 10, 12)     # figures whose captions print particles and box


class WithoutFlow(Case, table="arithmetic"):
    """The numbers that one function of this module gives by name."""
    numbers: Callable[[], Numbers]

    def measure(self, report: Report) -> Iterator[dict]:
        for name, number in self.numbers().items():
            value, err = measured(number)
            yield {"quantity": name, "value": float(value), "err": float(err)}


def density_of(figure: int) -> float:
    """Particles per area of a figure's box."""
    return printed(f"fig{figure}-particles")/(printed(f"fig{figure}-height")*printed(f"fig{figure}-width"))


def caption_ra(figure: int) -> float:
    """Ra = dT^2 L^2/eta^2 of an ideal gas with dT = 1 in a box 50 high, less the printed one."""
    return (50/printed(f"fig{figure}-eta"))**2 - printed(f"fig{figure}-ra")


def energy_error(ra: int) -> Measured:
    """1 - K_particles/K_grid of the printed energies."""
    particles, grid = (published(f"khp95-ke-{ra}{end}") for end in ("-spam", ""))
    ratio = particles.value/grid.value
    rounding = sum(one.uncertainty/one.value for one in (particles, grid))
    return Measured(1 - ratio, ratio*rounding)


def ra_by_expansivity() -> float:
    """Ra of Fig. 10 by the definition of Sec. I, alpha = 1/<T>."""
    scene = RayleighBenard(ra=1.0, L=printed("fig10-height"), T_hot=printed("fig10-temperature-hot"),
                           T_cold=printed("fig10-temperature-cold"), aspect=1.0, sides=Walls())
    return scene.g*scene.alpha*scene.L**3*scene.dT/printed("fig10-eta-ideal")**2


def printed_numbers() -> Numbers:
    """What the paper's own numbers say of each other."""
    L_fig10, eta_fig10 = printed("fig10-height"), printed("fig10-eta-ideal")
    return {
        "largest |density - 1| of captions": max(abs(density_of(figure) - 1) for figure in BOXES),
        "largest |Ra - 10 000| of captions": max(abs(caption_ra(figure)) for figure in (2, 3, 8, 9, 12)),
        "Ra of Fig. 10, dT^2 L^2/eta^2": (9.5*L_fig10/eta_fig10)**2,
        "Ra of Fig. 10, alpha = 1/<T>": ra_by_expansivity(),
        "Ra of Fig. 4 over onset": printed("fig4-ra")/critical_ra(pi),
        "1 - K/K printed, Ra 5000": energy_error(5000),
        "1 - K/K printed, Ra 10 000": energy_error(10000),
        "1 - sqrt(K/K) printed, Ra 5000": 1 - (1 - energy_error(5000))**0.5,
        "1 - sqrt(K/K) printed, Ra 10 000": 1 - (1 - energy_error(10000))**0.5,
        "4^(1/2)": printed("line-range")**-printed("line-exponent"),
        "initial over final kinetic energy": Measured(9.0, 0.5)/(5000*printed("ke-10000")),
        "5000 eta/L^2": printed("fig9-time")*0.5/50**2,
        "rows of 1800 points in a box 1 x 2": sqrt(printed("fig12-points")/2),
    }


def stiffness(eos: Any) -> float:
    """2 P/(rho c^2) at density and temperature 1."""
    e = energy(eos, 1.0, 1.0)
    return 2*float(pressure(eos, 1.0, e)/fluid.sound_speed(eos, 1.0, e)**2)


def imbalance(eos: Any) -> float:
    """Range of P(y) + rho g y over its mean, for the conduction profile at density 1."""
    scene = RayleighBenard(ra=1e4, eos=eos)
    y = np.linspace(-0.5, 0.5, 101)*scene.L
    total = pressure(eos, 1.0, energy(eos, 1.0, scene.T(y))) + scene.g*y
    return float(np.ptp(total)/total.mean())


def critical_slopes(step: float = 1e-4) -> float:
    """Largest of dP/drho and d2P/drho2 along the critical isotherm at the critical density, as printed."""
    rho = printed("vdw-critical-density") + step*np.array([-1, 0, 1])
    P = pressure(VDW, rho, energy(VDW, rho, printed("vdw-critical-temperature")))
    return float(max(abs(P[2] - P[0])/(2*step), abs(np.diff(P, 2)[0])/step**2))


def equations_of_state() -> Numbers:
    """What Eqs 1 to 3 say at density and temperature 1, and whether gravity balances them.

    (dE/dV)_T = -rho^2 (de/drho)_T; e of the dense fluid is quadratic: wide differences are exact.
    d(beta P)/d(beta) = P - T (dP/dT)_rho; C_P = C_V + T alpha (dP/dT)_rho/rho.
    """
    by_volume = -float(energy(DENSE, 1.5, 1.0) - energy(DENSE, 0.5, 1.0))
    by_heat = {eos: float(fluid.thermal_pressure(eos, 1.0, 1.0)) for eos in (IDEAL, DENSE)}
    by_temperature = float(pressure(DENSE, 1.0, energy(DENSE, 1.0, 1.0))) - by_heat[DENSE]
    T = np.linspace(0.5, 1.5, 11)
    apart = fluid.temperature(DENSE, 1.0, energy(DENSE, 1.0, T)) - T
    return {
        "rho c^2/P, ideal": 2/stiffness(IDEAL),
        "slope and curvature at the critical point, vdw": critical_slopes(),
        "a, vdw": VDW.a,
        "b, vdw": VDW.b,
        "imbalance of forces at rest": max(map(imbalance, EQUATIONS_OF_STATE.values())),
        "g L/dT, ideal": 50*RayleighBenard(ra=1e4).g,
        "|C_V - 1|, ideal and vdw": max(abs(eos.cv - 1) for eos in (IDEAL, VDW)),
        "C_V, dense": DENSE.cv,
        "C_P, ideal": IDEAL.cv + fluid.expansivity(IDEAL, 1.0, 1.0)*by_heat[IDEAL],
        "(dE/dV)_T, dense": by_volume,
        "d(beta P)/d(beta), dense": by_temperature,
        "(dE/dV)_T over -d(beta P)/d(beta), dense": by_volume/-by_temperature,
        "largest |T(u(T)) - T|, dense": float(np.abs(apart).max()),
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
    near, far = ({kind: [largest_modulus(weight, kind, h) for weight in BOTH] for kind in AXES}
                 for h in (RANGE, 6.0))
    decay = {kind: max(np.divide(far[kind], near[kind])) for kind in AXES}
    return {
        "integral, Lucy": LUCY.integral,
        "integral, Monaghan": MONAGHAN.integral,
        "largest jump of w, w', w''": max(map(abs, jumps)),
        "w' and w'' at the range": max(map(abs, at_range))/float(LUCY(0.0)),
        "range": RANGE,
        "w(0.9) - w(1), Lucy": LUCY(0.9) - LUCY(1.0),
        "|G/B|, hexagonal": max(near["hexagonal"]),
        "|G/B|, square": max(near["square"]),
        "|G/B|, hexagonal, Lucy": near["hexagonal"][0],
        "|G/B| at h = 6 over h = 3, hexagonal": decay["hexagonal"],
        "|G/B| at h = 6 over h = 3, square": decay["square"],
        "energy of sites h apart over the least": min(crowded),
        "particles a site, Lucy": min(least(LUCY, kind) for kind in AXES)[1],
        "particles a site, Monaghan": min(least(MONAGHAN, kind) for kind in AXES)[1],
        "least energy, square over hexagonal": min(square),
    }


def few_particles() -> Numbers:
    """Conservation and orders in time of 36 particles."""
    momentum, energy_left = few.left_over()
    return {
        "accelerations against -grad of sum 2 w": few.not_molecular(),
        "drift of kinetic energy and sum of w": few.energy_drift(),
        "part that comes back bit by bit": few.returned(),
        "order of the way back": few.order(few.return_errors, few.MOLECULES, few.STEPS[:3]),
        "sum of forces over moduli": momentum,
        "sum of energy rates over moduli": energy_left,
        "error of RK4 over midpoint": few.against_midpoint(),
        "order of RK4, dt 0.6 to 0.15": few.order(few.step_errors, few.GAS, few.STEPS, few.MORE),
        "order of RK4, dt 0.075 to 0.019": few.order(few.step_errors, few.GAS, few.SMALL),
    }


SUBJECTS = (printed_numbers, equations_of_state, weights, few_particles)
