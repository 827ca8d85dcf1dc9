"""Claims about weights, lattices of particles, and smooth particles as molecules    [KHP95, Secs II-IV]"""
from collections.abc import Callable
from functools import cache
from itertools import pairwise

import numpy as np

from studies.build.read import Value, exact, over_seeds
from studies.kit.claim import Claim
from studies.kit.stats import Measured
from studies.kit.table import Tables
from studies.rb.claims import sums
from studies.rb.claims.lattices import BOTH, KINDS, LUCY, MONAGHAN, RANGE, Printed, density, shear_moduli
from studies.rb.claims.printed import as_printed

SITES = (1, 2, 3, 4)
TIME = 4.8
STEPS = (8, 16, 32, 64)         # of that time: dt from 0.6, the largest stable one, down
SMALL = (64, 128, 256, 512)     # dt from 0.075 down
AS_RUN = 12                     # dt = 0.4, as in the study's runs
SEEDS = (1, 2, 3, 4, 5, 6)


def roughest(orders: tuple[int, ...]) -> float:
    """Largest jump of derivatives of these orders of both weights, over w(0)."""
    return max(abs(jump) for weight in BOTH for order in orders for jump in weight.jumps(order))


def at_cutoff() -> float:
    """Largest first or second derivative of both weights at the range, over w(0)."""
    return max(abs(weight.pieces[-1][1].deriv(order)(RANGE)) for weight in BOTH for order in (1, 2))/float(LUCY(0.0))


def stiffest(kind: str, h: float = RANGE) -> float:
    """Largest |G/B| of both weights and both shears on a lattice."""
    return max(float(np.abs(shear_moduli(weight, kind, h)).max()) for weight in BOTH)


def decay(kind: str) -> float:
    """Largest |G/B| at range 6 over that at range 3, the worse of both weights."""
    largest = [[np.abs(shear_moduli(weight, kind, h)).max() for h in (6.0, RANGE)] for weight in BOTH]
    return float(max(six/three for six, three in largest))


def best(weight: Printed, kind: str) -> tuple[float, int]:
    """Least density sum, and so least energy at any pressure, over particles a site."""
    return min((density(weight, kind, sites), sites) for sites in SITES)


def occupancy(weight: Printed) -> int:
    """Particles a site of the lattice with the least energy, square or hexagonal."""
    return min(best(weight, kind) for kind in KINDS)[1]


def crowded() -> float:
    """Density sum of the lattice whose sites are a whole range apart over the least one; the lesser of both weights."""
    per_site = RANGE**2*np.sqrt(3)/2
    return min(density(weight, "hexagonal", per_site)/best(weight, "hexagonal")[0] for weight in BOTH)


# --- particles as molecules ---------------------------------------------------------------------------------


def not_molecular() -> float:
    """Largest difference of SPAM accelerations, P = rho^2, from -grad of sum 2 w(r), relative."""
    state, step = sums.start(), 1e-5
    force = sums.rates(state, sums.quadratic)[2:4]
    slopes = np.zeros_like(force)
    for at in np.ndindex(force.shape):
        there, back = state.copy(), state.copy()
        there[at], back[at] = there[at] + step, back[at] - step
        slopes[at] = (sums.densities(there).sum() - sums.densities(back).sum())/(2*step)
    return float(np.abs(force + slopes).max()/np.abs(force).max())


def not_conserved(momentum: bool) -> float:
    """Sum of m dv/dt, or of m(de/dt + v.dv/dt), over the sum of moduli, with viscosity and conduction."""
    state = sums.start()
    rate = sums.rates(state, eta=0.3)
    terms = rate[2:4] if momentum else np.array([rate[4], state[2]*rate[2], state[3]*rate[3]])
    return float(np.abs(terms.sum(axis=1) if momentum else terms.sum()).max()/np.abs(terms).sum())


@cache
def end(seed: int, steps: int, **law) -> np.ndarray:
    """State at the end of TIME, by so many steps; kept, because several claims ask for the same."""
    return sums.march(sums.start(seed), TIME/steps, steps, **law)


def order(error: Callable[[np.ndarray, list[np.ndarray]], list[float]], steps: tuple[int, ...], **law) -> Value:
    """Slope of log error against log dt, mean over starts; `error` gets the start and the ends for all steps."""
    def value(tables: Tables) -> Measured:
        found = []
        for seed in SEEDS:
            errors = error(sums.start(seed), [end(seed, n, **law) for n in steps])
            found.append(-np.polyfit(np.log(steps[:len(errors)]), np.log(errors), 1)[0])
        return over_seeds(found)
    return value


def against_midpoint(tables: Tables) -> Measured:
    """Error of the state by Runge-Kutta of order 4, dt = 0.4, over that of order 2 with as many evaluations."""
    found = []
    for seed in SEEDS:
        true, fourth = end(seed, SMALL[-1], eta=0.3), end(seed, AS_RUN, eta=0.3)
        second = sums.march_midpoint(sums.start(seed), TIME/(2*AS_RUN), 2*AS_RUN, eta=0.3)
        found.append(distance(fourth, true)/distance(second, true))
    return over_seeds(found)


def distance(one: np.ndarray, other: np.ndarray) -> float:
    """Root mean square of the difference of two states."""
    return float(np.sqrt(np.mean((one - other)**2)))


def energy_drift() -> float:
    """Change of kinetic energy and sum of w over kinetic energy, after t = 4.8 with dt = 0.075; P = rho^2."""
    def kinetic(state: np.ndarray) -> float:
        return float((state[2:4]**2).sum()/2)
    start = sums.start()
    end = sums.march(start, TIME/64, 64, pressure=sums.quadratic)
    total = [kinetic(state) + sums.densities(state).sum() for state in (start, end)]
    return float(abs(total[1] - total[0])/kinetic(start))


def return_error(start: np.ndarray, ends: list[np.ndarray]) -> list[float]:
    """Distance from the start after as many steps with all velocities turned; P = rho^2."""
    turned = [end*np.array([1, 1, -1, -1, 1])[:, None] for end in ends]
    back = [sums.march(end, TIME/n, n, pressure=sums.quadratic) for end, n in zip(turned, STEPS, strict=False)]
    return [float(np.abs(b[:2] - start[:2]).max()) for b in back]


def step_error(start: np.ndarray, ends: list[np.ndarray]) -> list[float]:
    """Distance between the ends of one step size and of half of it."""
    return [distance(a, b) for a, b in pairwise(ends)]


FOURTH = ("0.2 below 4 for steps that are not small; third derivatives of both weights jump at the range, so each pair that "
          "crosses it leaves a velocity error of dt^3, of either sign, and the order goes to 3 as dt falls on")
HEXAGONAL = "statement is about symmetric lattices: the hexagonal one, on which smooth particles freeze"
CLAIMS = (
    Claim(id="khp95-lucy-normalised", source="KHP95 Sec. II", printed="1",
          statement="Lucy's weight as printed, factor 5/(9 pi), integrates to 1", value=exact(lambda: LUCY.integral),
          expect=1, within=1e-12, because="round-off"),
    Claim(id="khp95-monaghan-normalised", source="KHP95 Sec. II", printed="1",
          statement="Monaghan's weight as printed, factors 40/(63 pi) and 80/(63 pi), integrates to 1",
          value=exact(lambda: MONAGHAN.integral), expect=1, within=1e-12, because="round-off"),
    Claim(id="khp95-weights-smooth", source="KHP95 Sec. II",
          statement="both weights have continuous first and second derivatives for all r: largest jump over w(0)",
          value=exact(lambda: roughest((0, 1, 2))), at_most=1e-12, because="round-off"),
    Claim(id="khp95-weights-cutoff", source="KHP95 Sec. II", printed="two vanishing derivatives",
          statement="first and second derivative of both weights vanish at 3 sigma", value=exact(at_cutoff),
          at_most=1e-12, because="round-off"),
    Claim(id="khp95-images-range", source="KHP95 Fig. 3", printed="3",
          statement="particles within 3 sigma of a wall need images, no others: a particle at the wall reaches the "
                    "image of one as far from the wall as the range", value=exact(lambda: RANGE),
          **as_printed("fig3-image-range"), because="exact numbers"),
    Claim(id="khp95-lucy-bracket", source="KHP95 Sec. IV", printed="0.01",
          statement="w(0.9 sigma) - w(sigma) of Lucy's weight is about 0.01 n",
          value=exact(lambda: LUCY(0.9) - LUCY(1.0)), **as_printed("lucy-bracket"), because="one digit is printed"),
    Claim(id="khp95-spurious-shear", source="KHP95 Sec. II", printed="1%", at_most=0.02,
          statement="spurious shear modulus over bulk modulus, hexagonal lattice, ideal gas, the stiffer of both "
                    "weights", value=exact(lambda: stiffest("hexagonal")),
          because=f'"of the order of", one digit: twice as much; {HEXAGONAL}'),
    Claim(id="khp95-spurious-shear-square", source="KHP95 Sec. II", printed="1%", at_most=0.02,
          statement="spurious shear modulus over bulk modulus, square lattice (on which runs begin), ideal gas, the "
                    "stiffer of both weights and two shears", value=exact(lambda: stiffest("square")),
          because='"of the order of", one digit: twice as much; the modulus is negative there, the lattice unstable'),
    Claim(id="khp95-viscoelastic", source="KHP95 Sec. III", printed="spurious elastic constants", at_least=1e-6,
          statement="smooth particles bring an artificial elasticity: spurious shear modulus over bulk modulus of Lucy's "
                    "weight, hexagonal lattice, ideal gas",
          value=exact(lambda: np.abs(shear_moduli(LUCY, "hexagonal")).max()),
          because="a fluid has none; differences over strains of 1e-3 leave 1e-9"),
    Claim(id="khp95-spurious-decay", source="KHP95 Secs II, III", printed="rapid convergence", at_most=0.1,
          statement="spurious shear moduli vanish rapidly as the range grows: at 6 sigma over at 3 sigma, hexagonal "
                    "lattice", value=exact(lambda: decay("hexagonal")),
          because='"rapid" has no number: ten times for twice the range'),
    Claim(id="khp95-spurious-decay-square", source="KHP95 Secs II, III", printed="rapid convergence", at_most=0.1,
          statement="spurious shear moduli vanish rapidly as the range grows: at 6 sigma over at 3 sigma, square "
                    "lattice", value=exact(lambda: decay("square")),
          because='"rapid" has no number: ten times for twice the range'),
    Claim(id="khp95-high-pressure-lattice", source="KHP95 Sec. III", printed="0 or h", at_most=1,
          statement="as P grows without bound no two particles stay between 0 and h apart: energy of the lattice with "
                    "sites h apart over the least one of those with 1 to 4 particles a site", value=exact(crowded),
          because="the state that is taken has the least energy; for P ~ rho^2 it does not depend on P"),
    Claim(id="khp95-frozen-occupancy-lucy", source="KHP95 Sec. IV", printed="one",
          statement="Lucy's weight freezes with one particle a site: lattice of least energy, 1 to 4 a site",
          value=exact(lambda: occupancy(LUCY)), **as_printed("frozen-lucy"), because="a whole number"),
    Claim(id="khp95-frozen-occupancy-monaghan", source="KHP95 Sec. IV", printed="two",
          statement="Monaghan's weight freezes with two particles a site: lattice of least energy, 1 to 4 a site",
          value=exact(lambda: occupancy(MONAGHAN)), **as_printed("frozen-monaghan"), because="a whole number"),
    Claim(id="khp95-frozen-hexagonal", source="KHP95 Sec. IV", printed="hexagonal", at_least=1,
          statement="frozen states are hexagonal: least energy of the square over that of the hexagonal lattice, the "
                    "lesser of both weights",
          value=exact(lambda: min(best(w, "square")[0]/best(w, "hexagonal")[0] for w in BOTH)),
          because="the state that is taken has the lesser energy"),
    Claim(id="khp95-md-isomorphism", source="KHP95 Sec. III", printed="identical",
          statement="with P ~ rho^2 and no viscosity the accelerations are those of molecules with w as pair potential",
          value=exact(not_molecular), at_most=1e-8, because="round-off of the potential's differences over 1e-5: 4e-9"),
    Claim(id="khp95-md-energy", source="KHP95 Sec. III", printed="Newton's equations", at_most=1.5e-4,
          statement="for P ~ rho^2 trajectories conserve kinetic energy and sum of w: drift until t = 4.8 over "
                    "kinetic energy", value=exact(energy_drift),
          because="t dt^4 of the fourth-order integrator with dt = 0.075"),
    Claim(id="khp95-md-reversible", source="KHP95 Sec. III", printed="exact reversibility", at_least=4,
          statement="for P ~ rho^2 trajectories run back when velocities turn: order in dt of the distance from the "
                    "start", value=order(return_error, STEPS[:3], pressure=sums.quadratic),
          because="what is left is the integrator's, of fourth order"),
    Claim(id="khp95-conservation-momentum", source="KHP95 Sec. II", printed="exact",
          statement="the sums conserve momentum exactly: sum of m dv/dt over the sum of moduli, periodic box",
          value=exact(lambda: not_conserved(momentum=True)), at_most=1e-13, because="round-off of some 1000 terms"),
    Claim(id="khp95-conservation-energy", source="KHP95 Sec. II", printed="exact",
          statement="the sums conserve energy exactly, viscosity and conduction included, periodic box",
          value=exact(lambda: not_conserved(momentum=False)), at_most=1e-13, because="round-off of some 1000 terms"),
    Claim(id="khp95-rk4-efficient", source="KHP95 Sec. II", printed="efficient", at_most=1, value=against_midpoint,
          statement="fourth-order Runge-Kutta is efficient: error after t = 4.8 with dt = 0.4 over that of second order "
                    "(midpoint) with as many evaluations", because="less error for the same work"),
    Claim(id="khp95-rk4-order", source="KHP95 Sec. II", printed="fourth-order", at_least=3.8,
          statement="smooth weights let fourth-order Runge-Kutta be so at steps as in runs: order in dt of the state "
                    "after t = 4.8, dt 0.6 to 0.15", value=order(step_error, STEPS, eta=0.3), because=FOURTH),
    Claim(id="khp95-rk4-order-small", source="KHP95 Sec. II", at_least=3.8,
          statement="smooth weights let fourth-order Runge-Kutta be so as dt vanishes: order in dt of the state after t "
                    "= 4.8, dt 0.075 to 0.019", value=order(step_error, SMALL, eta=0.3), because=FOURTH),
)
