"""Claims that arithmetic decides: weights, equations of state, printed numbers side by side    [KHP95]"""
from collections.abc import Iterator
from typing import Any

from studies.build.names import as_printed
from studies.kit.ask import Value, one
from studies.kit.claim import Claim
from studies.rb.claims.questions import said


def calculated(quantity: str) -> Value:
    """A number that needs no flow; `studies.rb.runs.arithmetic` says how it follows."""
    return one("arithmetic", "value", err="err", quantity=quantity)


A, B = calculated("a, vdw"), calculated("b, vdw")
FOURTH = ("0.2 below 4 for steps that are not small; third derivatives of both weights jump at the range, so "
          "each pair that crosses it leaves a velocity error of dt^3, and the order goes to 3 as dt falls on")
HEXAGONAL = "statement is about symmetric lattices: the hexagonal one, on which smooth particles freeze"
EXACT = (     # name, place, printed, the number, its value, statement
    ("lucy-normalised", "Sec. II", "1", 1, calculated("integral, Lucy"),
     "Lucy's weight as printed, factor 5/(9 pi), integrates to 1"),
    ("monaghan-normalised", "Sec. II", "1", 1, calculated("integral, Monaghan"),
     "Monaghan's weight as printed, factors 40/(63 pi) and 80/(63 pi), integrates to 1"),
    ("isentrope", "Sec. III", "P ~ rho^2", 2, calculated("rho c^2/P, ideal"),
     "P ~ rho^2 is the isentrope of the two-dimensional ideal gas: exponent rho c^2/P"),
    ("vdw-critical-density", "Sec. IV", "2/3", 2/3, 1/(3*B),
     "critical density of the van der Waals fluid, 1/(3 b)"),
    ("vdw-critical-temperature", "Sec. IV", "8/27", 8/27, 8*A/(27*B),
     "critical temperature of the van der Waals fluid, 8 a/(27 b)"),
    ("vdw-density-reference", "Fig. 7", "half", 0.5, B,
     "n sigma^2 = 1 is half the maximum density of the van der Waals fluid"),
    ("vdw-temperature-reference", "Fig. 7", "27/8", 27/8, 27*B/(8*A),
     "T = 1 is 27/8 of the critical temperature of the van der Waals fluid"),
    ("gravity-ideal", "Sec. IV", "kB dT/L", 1, calculated("g L/dT, ideal"),
     "(dP/dT)_rho dT/(rho L) is dT/L for the ideal gas: g L/dT"),
    ("dense-maxwell-energy", "Sec. IV", "-1.5", -1.5, calculated("(dE/dV)_T, dense"),
     "(dE/dV)_T of the dense fluid at its reference state"),
    ("dense-maxwell-pressure", "Sec. IV", "1.25", 1.25, calculated("d(beta P)/d(beta), dense"),
     "d(beta P)/d(beta) at constant V of the dense fluid at its reference state: P - T (dP/dT)_rho"),
    ("range-consistent", "Secs I, V", "2, 4", 2, calculated("4^(1/2)"),
     "a factor of 2 in Ra^-1/2 and four times the critical Ra are the same range"),
    ("fig9-diffusion-time", "Figs 9, 12", "5000", 1, calculated("5000 eta/L^2"),
     "t = 5000 is one diffusion time L^2/eta"),
    ("fig12-grid", "Fig. 12", "1800", 30, calculated("rows of 1800 points in a box 1 x 2"),
     "1800 points of a square grid over 50 x 100 are whole rows: 30 of 60"),
)


def exact() -> Iterator[Claim]:
    """Numbers that follow from the printed formulas and digits without rounding."""
    for name, place, printed, number, value, statement in EXACT:
        yield said(name, place, printed, value, statement, "round-off", expect=number, within=1e-12)


def fact(name: str, place: str, printed: str, quantity: str, statement: str, because: str,
         **more: Any) -> Claim:
    """A statement of KHP95 that a number without flow decides."""
    return said(name, place, printed, calculated(quantity), statement, because, **more)


CLAIMS = (
    fact("lucy-bracket", "Sec. IV", "0.01", "w(0.9) - w(1), Lucy",
         "w(0.9 sigma) - w(sigma) of Lucy's weight is about 0.01 n", "one digit is printed",
         **as_printed("lucy-bracket"), headline=True),
    *exact(),
    fact("frozen-occupancy-lucy", "Sec. IV", "one", "particles a site, Lucy",
         "Lucy's weight freezes with one particle a site: lattice of least energy, 1 to 4 a site",
         "a whole number", **as_printed("frozen-lucy")),
    fact("frozen-occupancy-monaghan", "Sec. IV", "two", "particles a site, Monaghan",
         "Monaghan's weight freezes with two particles a site: lattice of least energy, 1 to 4 a site",
         "a whole number", **as_printed("frozen-monaghan")),
    fact("dense-stiffness", "Sec. IV", "2P/n = m c^2", "2 P/(rho c^2), dense",
         "the dense fluid has 2 P/n about equal to m c^2: ratio at n = T = 1",
         '"about equal", no digit: half; the ideal gas has exactly 1', **as_printed("dense-pressure-ratio")),
    fact("ra-fig10", "Fig. 10", "350 000", "Ra of Fig. 10, dT^2 L^2/eta^2",
         "temperatures 10 and 0.5, eta = 0.8, L = 50 are Ra 350 000 by dT^2 L^2/eta^2",
         "two digits are printed; this takes alpha = 1", **as_printed("fig10-ra")),
    fact("ra-fig10-expansivity", "Sec. I, Fig. 10", "350 000", "Ra of Fig. 10, alpha = 1/<T>",
         "temperatures 10 and 0.5, eta = 0.8, L = 50 are Ra 350 000 by the definition of Sec. I, with the "
         "gas's own alpha = 1/<T>", "two digits are printed", **as_printed("fig10-ra")),
    fact("ra-fig4", "Fig. 4", "about twice", "Ra of Fig. 4 over onset",
         "Ra 3000 is about twice the critical value (of the box, wavenumber pi)", '"about" and one digit',
         **as_printed("fig4-supercritical")),
    fact("initial-energy", "Figs 8, 9", "9, one half", "initial over final kinetic energy",
         "9 epsilon of initial kinetic energy in 5000 particles are about half of the printed final value",
         '"about one half": 10 %; "about 9" is 8.5 to 9.5; if Figs 8 and 9 show the same run, which is not '
         "said", **as_printed("fig8-initial")),
    *(fact(f"spurious-decay{end}", "Secs II, III", "rapid convergence", f"|G/B| at h = 6 over h = 3, {kind}",
           "spurious shear moduli vanish rapidly as the range grows: at 6 sigma over at 3 sigma, "
           f"{kind} lattice", '"rapid" has no number: ten times for twice the range', at_most=0.1)
      for end, kind in (("", "hexagonal"), ("-square", "square"))),
    *(fact(f"kinetic-errors{end}", "Sec. VI", "10%", f"1 - K/K printed, Ra {ra}",
           f"the printed energies of particles and grid at Ra {ra} differ by 10 % at most",
           f"two digits are printed{more}", at_most=0.105)
      for end, ra, more in (
          ("", "5000", "; 0.0030 and 0.003 40 differ by 10.3 % to 13.2 %, by rounding alone"),
          ("-10000", "10 000", ""))),
    *(fact(f"velocity-errors-printed{end}", "Sec. VI", "5%", f"1 - sqrt(K/K) printed, Ra {ra}",
           f"the printed energies at Ra {ra} mean velocity errors of the order of 5 %",
           '"of the order of", one digit: half as much again; less is no contradiction', at_most=0.075)
      for end, ra in (("", "5000"), ("-10000", "10 000"))),
    fact("weights-smooth", "Sec. II", "continuous first and second derivatives",
         "largest jump of w, w', w''",
         "both weights have continuous first and second derivatives for all r: largest jump over w(0)",
         "round-off", at_most=1e-12),
    fact("weights-cutoff", "Sec. II", "two vanishing derivatives", "w' and w'' at the range",
         "first and second derivative of both weights vanish at 3 sigma", "round-off", headline=True,
         at_most=1e-12),
    fact("images-range", "Fig. 3", "3", "range",
         "particles within 3 sigma of a wall need images, no others: a particle at the wall reaches the "
         "image of one as far from the wall as the range", "exact numbers", **as_printed("fig3-image-range"),
         headline=True),
    fact("spurious-shear", "Sec. II", "1%", "|G/B|, hexagonal",
         "spurious shear modulus over bulk modulus, hexagonal lattice, ideal gas, the stiffer of both "
         "weights", f'"of the order of", one digit: twice as much; {HEXAGONAL}', at_most=0.02),
    fact("spurious-shear-square", "Sec. II", "1%", "|G/B|, square",
         "spurious shear modulus over bulk modulus, square lattice (on which runs begin), ideal gas, the "
         "stiffer of both weights and two shears",
         '"of the order of", one digit: twice as much; the modulus is negative there, the lattice unstable',
         at_most=0.02),
    fact("viscoelastic", "Sec. III", "spurious elastic constants", "|G/B|, hexagonal, Lucy",
         "smooth particles bring an artificial elasticity: spurious shear modulus over bulk modulus of "
         "Lucy's weight, hexagonal lattice, ideal gas",
         "a fluid has none; differences over strains of 1e-3 leave 1e-9", at_least=1e-6),
    fact("high-pressure-lattice", "Sec. III", "0 or h", "energy of sites h apart over the least",
         "as P grows without bound no two particles stay between 0 and h apart: energy of the lattice with "
         "sites h apart over the least one of those with 1 to 4 particles a site",
         "the state that is taken has the least energy; for P ~ rho^2 it does not depend on P", at_most=1,
         headline=True),
    fact("frozen-hexagonal", "Sec. IV", "hexagonal", "least energy, square over hexagonal",
         "frozen states are hexagonal: least energy of the square over that of the hexagonal lattice, the "
         "lesser of both weights", "the state that is taken has the lesser energy", at_least=1,
         headline=True),
    fact("md-isomorphism", "Sec. III", "identical", "accelerations against -grad of sum 2 w",
         "with P ~ rho^2 and no viscosity the accelerations are those of molecules with w as pair potential",
         "round-off of the potential's differences over 1e-5: 4e-9", headline=True, at_most=1e-8),
    fact("md-energy", "Sec. III", "Newton's equations", "drift of kinetic energy and sum of w",
         "for P ~ rho^2 trajectories conserve kinetic energy and sum of w: drift until t = 4.8 over "
         "kinetic energy", "t dt^4 of the fourth-order integrator with dt = 0.075", at_most=1.5e-4),
    fact("md-reversible", "Sec. III", "exact reversibility", "order of the way back",
         "for P ~ rho^2 trajectories run back when velocities turn: order in dt of the distance from the "
         "start", "what is left is the integrator's, of fourth order", at_least=4),
    fact("hard-reversal", "Sec. III", "exact reversibility", "part that comes back bit by bit",
         "paths run back exactly when velocities turn: part of the coordinates that come back to the last "
         "bit, in whole numbers, after a time of 100", "exact is all of them", expect=1, within=0,
         headline=True),
    fact("conservation-momentum", "Sec. II", "exact", "sum of forces over moduli",
         "the sums conserve momentum exactly: sum of m dv/dt over the sum of moduli, periodic box",
         "round-off of some 1000 terms", headline=True, at_most=1e-13),
    fact("conservation-energy", "Sec. II", "exact", "sum of energy rates over moduli",
         "the sums conserve energy exactly, viscosity and conduction included, periodic box",
         "round-off of some 1000 terms", headline=True, at_most=1e-13),
    fact("rk4-efficient", "Sec. II", "efficient", "error of RK4 over midpoint",
         "fourth-order Runge-Kutta is efficient: error after t = 4.8 with dt = 0.4 over that of second "
         "order (midpoint) with as many evaluations", "less error for the same work", at_most=1),
    fact("rk4-order", "Sec. II", "fourth-order", "order of RK4, dt 0.6 to 0.15",
         "smooth weights let fourth-order Runge-Kutta be so at steps as in runs: order in dt of the state "
         "after t = 4.8, dt 0.6 to 0.15", FOURTH, at_least=3.8,
         after="six starts had left it open, and eighteen more were run"),
    Claim(id="own-rk4-order-small", source="KHP95 Sec. II", at_least=3.8,
          statement="smooth weights let fourth-order Runge-Kutta be so as dt vanishes: order in dt of the "
                    "state after t = 4.8, dt 0.075 to 0.019",
          value=calculated("order of RK4, dt 0.075 to 0.019"), because=FOURTH),
    fact("vdw-critical-point", "Sec. IV, Eq. 2", "2/3, 8/27",
         "slope and curvature at the critical point, vdw",
         "slope and curvature of Eq. 2 along its isotherm vanish there",
         "differences over 1e-4: truncation and round-off are 1e-8", headline="Eq. 2", at_most=1e-6),
    fact("static-density", "Sec. IV", "g = kB dT/L", "imbalance of forces at rest",
         "the printed gravity keeps the motionless density exactly constant, for all three equations of "
         "state; largest imbalance of forces", "round-off", at_most=1e-12),
    fact("prandtl", "Sec. IV", "unity", "|C_V - 1|, ideal and vdw",
         "equal coefficients eta = k mean Pr = 1, with C_V: ideal gas and van der Waals",
         "exact: Pr = eta C_V/k = C_V", at_most=1e-12),
    fact("prandtl-dense", "Sec. IV", "unity", "C_V, dense",
         '"in every case": eta = k means Pr = 1 with C_V for the dense fluid, too',
         "one digit is printed, in words; C_V = 1.5 by Eq. 3", expect=1, within=0.05),
    fact("prandtl-isobaric", "Sec. IV", "unity", "C_P, ideal",
         "eta = k means Pr = 1 for the ideal gas by the usual definition, with C_P",
         "one digit is printed, in words; the paper takes C_V, in which flow at constant pressure has no "
         "part", expect=1, within=0.05),
    fact("dense-inconsistent", "Sec. IV", "-1.5, 1.25", "(dE/dV)_T over -d(beta P)/d(beta), dense",
         "the dense fluid violates the Maxwell relation: (dE/dV)_T over -d(beta P)/d(beta), which should "
         "be 1", "1.5/1.25; 1 would be consistent", expect=1.2, within=1e-12),
    fact("dense-inverse", "Eq. 3", "0.7, 1.5", "largest |T(u(T)) - T|, dense",
         "T(n, u) and u(n, T) of the dense fluid belong together: error of temperature between the plates",
         "0.7 is 2/3 rounded, 0.05 of its last digit times du = 0.75; a solver that keeps u has walls at "
         "0.475 and 1.525 for 0.5 and 1.5", headline=True, at_most=0.0375),
    fact("vdw-stiffness", "Sec. IV", "considerably lower", "2 P/(rho c^2), vdw over dense",
         "van der Waals has a considerably lower pressure relative to its sound speed than the dense "
         "fluid: ratio of both 2P/(n m c^2)",
         '"considerably" is a fifth at least; what differs is P itself, 1.5 against 5', at_most=0.8),
    fact("pressure-sound", "Sec. IV", "P V/N approximates m c^2", "P/(rho c^2), dense",
         "at high pressure P/n is about m c^2: ratio for the dense fluid, P = 5",
         '"approximates", no digit: half', expect=1, within=0.5),
    fact("boxes", "Figs 2, 3, 4, 7, 9, 10, 12", "n sigma^2 = 1", "largest |density - 1| of captions",
         "particles and boxes of the captions have unit density; largest deviation", "exact numbers",
         headline="Figs 2, 3", at_most=1e-12),
    fact("ra-captions", "Figs 2, 3, 8, 9, 12", "10 000", "largest |Ra - 10 000| of captions",
         "eta = 0.5 at L = 50 is Ra 10 000, here by dT^2 L^2/eta^2; largest deviation",
         "exact numbers; alpha = 1, kappa = k/(rho C_V)", headline="Figs 2, 3", at_most=1e-9),
)
