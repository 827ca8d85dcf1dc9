"""Claims that arithmetic decides: weights, equations of state, printed numbers side by side    [KHP95]"""
from collections.abc import Iterator

from studies.build.names import as_printed
from studies.kit.ask import Value, one
from studies.kit.claim import Claim


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
PRINTED = (     # name, place, printed, the published number, the quantity, statement, reason of its width
    ("frozen-occupancy-lucy", "Sec. IV", "one", "frozen-lucy", "particles a site, Lucy",
     "Lucy's weight freezes with one particle a site: lattice of least energy, 1 to 4 a site",
     "a whole number"),
    ("frozen-occupancy-monaghan", "Sec. IV", "two", "frozen-monaghan", "particles a site, Monaghan",
     "Monaghan's weight freezes with two particles a site: lattice of least energy, 1 to 4 a site",
     "a whole number"),
    ("dense-stiffness", "Sec. IV", "2P/n = m c^2", "dense-pressure-ratio", "2 P/(rho c^2), dense",
     "the dense fluid has 2 P/n about equal to m c^2: ratio at n = T = 1",
     '"about equal", no digit: half; the ideal gas has exactly 1'),
    ("ra-fig10", "Fig. 10", "350 000", "fig10-ra", "Ra of Fig. 10, dT^2 L^2/eta^2",
     "temperatures 10 and 0.5, eta = 0.8, L = 50 are Ra 350 000 by dT^2 L^2/eta^2",
     "two digits are printed; this takes alpha = 1"),
    ("ra-fig10-expansivity", "Sec. I, Fig. 10", "350 000", "fig10-ra", "Ra of Fig. 10, alpha = 1/<T>",
     "temperatures 10 and 0.5, eta = 0.8, L = 50 are Ra 350 000 by the definition of Sec. I, with the gas's "
     "own alpha = 1/<T>", "two digits are printed"),
    ("ra-fig4", "Fig. 4", "about twice", "fig4-supercritical", "Ra of Fig. 4 over onset",
     "Ra 3000 is about twice the critical value (of the box, wavenumber pi)", '"about" and one digit'),
    ("initial-energy", "Figs 8, 9", "9, one half", "fig8-initial", "initial over final kinetic energy",
     "9 epsilon of initial kinetic energy in 5000 particles are about half of the printed final value",
     '"about one half": 10 %; "about 9" is 8.5 to 9.5; if Figs 8 and 9 show the same run, which is not said'),
)


def exact() -> Iterator[Claim]:
    """Numbers that follow from the printed formulas and digits: without rounding, or as near as printed."""
    for name, place, printed, number, value, statement in EXACT:
        yield Claim(id=f"khp95-{name}", source=f"KHP95 {place}", printed=printed, statement=statement,
                    value=value, expect=number, within=1e-12, because="round-off")
    for name, place, printed, key, quantity, statement, reason in PRINTED:
        yield Claim(id=f"khp95-{name}", source=f"KHP95 {place}",
                    printed=printed, statement=statement, value=calculated(quantity),
                    **as_printed(key), because=reason)


def decays() -> Iterator[Claim]:
    """Spurious shear moduli as the range of the weight grows."""
    for end, kind in (("", "hexagonal"), ("-square", "square")):
        yield Claim(id=f"khp95-spurious-decay{end}", source="KHP95 Secs II, III", printed="rapid convergence",
                    at_most=0.1, value=calculated(f"|G/B| at h = 6 over h = 3, {kind}"),
                    statement="spurious shear moduli vanish rapidly as the range grows: at 6 sigma over at 3 "
                              f"sigma, {kind} lattice",
                    because='"rapid" has no number: ten times for twice the range')


def printed_errors() -> Iterator[Claim]:
    """What the printed energies of particles and grid say of each other."""
    for end, ra, more in (("", "5000", "; 0.0030 and 0.003 40 differ by 10.3 % to 13.2 %, by rounding alone"),
                          ("-10000", "10 000", "")):
        yield Claim(id=f"khp95-kinetic-errors{end}", source="KHP95 Sec. VI", printed="10%", at_most=0.105,
                    value=calculated(f"1 - K/K printed, Ra {ra}"), because=f"two digits are printed{more}",
                    statement=f"the printed energies of particles and grid at Ra {ra} differ by 10 % at most")
        yield Claim(id=f"khp95-velocity-errors-printed{end}", source="KHP95 Sec. VI", printed="5%",
                    at_most=0.075, value=calculated(f"1 - sqrt(K/K) printed, Ra {ra}"),
                    statement=f"the printed energies at Ra {ra} mean velocity errors of the order of 5 %",
                    because='"of the order of", one digit: half as much again; less is no contradiction')


CLAIMS = (
    Claim(id="khp95-lucy-bracket", source="KHP95 Sec. IV", printed="0.01", headline=True,
          statement="w(0.9 sigma) - w(sigma) of Lucy's weight is about 0.01 n",
          value=calculated("w(0.9) - w(1), Lucy"), **as_printed("lucy-bracket"),
          because="one digit is printed"),
    *exact(),
    *decays(),
    *printed_errors(),
    Claim(id="khp95-weights-smooth", source="KHP95 Sec. II",
          printed="continuous first and second derivatives",
          statement="both weights have continuous first and second derivatives for all r: largest jump over "
                    "w(0)", value=calculated("largest jump of w, w', w''"), at_most=1e-12,
          because="round-off"),
    Claim(id="khp95-weights-cutoff", source="KHP95 Sec. II", printed="two vanishing derivatives",
          headline=True,
          statement="first and second derivative of both weights vanish at 3 sigma",
          value=calculated("w' and w'' at the range"), at_most=1e-12, because="round-off"),
    Claim(id="khp95-images-range", source="KHP95 Fig. 3", printed="3",
          headline=True,
          statement="particles within 3 sigma of a wall need images, no others: a particle at the wall "
                    "reaches the image of one as far from the wall as the range", value=calculated("range"),
          **as_printed("fig3-image-range"), because="exact numbers"),
    Claim(id="khp95-spurious-shear", source="KHP95 Sec. II", printed="1%", at_most=0.02,
          statement="spurious shear modulus over bulk modulus, hexagonal lattice, ideal gas, the stiffer of "
                    "both weights", value=calculated("|G/B|, hexagonal"),
          because=f'"of the order of", one digit: twice as much; {HEXAGONAL}'),
    Claim(id="khp95-spurious-shear-square", source="KHP95 Sec. II", printed="1%", at_most=0.02,
          statement="spurious shear modulus over bulk modulus, square lattice (on which runs begin), ideal "
                    "gas, the stiffer of both weights and two shears", value=calculated("|G/B|, square"),
          because='"of the order of", one digit: twice as much; the modulus is negative there, the lattice '
                  "unstable"),
    Claim(id="khp95-viscoelastic", source="KHP95 Sec. III", printed="spurious elastic constants",
          at_least=1e-6,
          statement="smooth particles bring an artificial elasticity: spurious shear modulus over bulk "
                    "modulus of Lucy's weight, hexagonal lattice, ideal gas",
          value=calculated("|G/B|, hexagonal, Lucy"),
          because="a fluid has none; differences over strains of 1e-3 leave 1e-9"),
    Claim(id="khp95-high-pressure-lattice", source="KHP95 Sec. III", printed="0 or h", at_most=1,
          headline=True,
          statement="as P grows without bound no two particles stay between 0 and h apart: energy of the "
                    "lattice with sites h apart over the least one of those with 1 to 4 particles a site",
          value=calculated("energy of sites h apart over the least"),
          because="the state that is taken has the least energy; for P ~ rho^2 it does not depend on P"),
    Claim(id="khp95-frozen-hexagonal", source="KHP95 Sec. IV", printed="hexagonal", at_least=1, headline=True,
          statement="frozen states are hexagonal: least energy of the square over that of the hexagonal "
                    "lattice, the lesser of both weights",
          value=calculated("least energy, square over hexagonal"),
          because="the state that is taken has the lesser energy"),
    Claim(id="khp95-md-isomorphism", source="KHP95 Sec. III", printed="identical", headline=True,
          statement="with P ~ rho^2 and no viscosity the accelerations are those of molecules with w as "
                    "pair potential", value=calculated("accelerations against -grad of sum 2 w"),
          at_most=1e-8, because="round-off of the potential's differences over 1e-5: 4e-9"),
    Claim(id="khp95-md-energy", source="KHP95 Sec. III", printed="Newton's equations", at_most=1.5e-4,
          statement="for P ~ rho^2 trajectories conserve kinetic energy and sum of w: drift until t = 4.8 "
                    "over kinetic energy", value=calculated("drift of kinetic energy and sum of w"),
          because="t dt^4 of the fourth-order integrator with dt = 0.075"),
    Claim(id="khp95-md-reversible", source="KHP95 Sec. III", printed="exact reversibility", at_least=4,
          statement="for P ~ rho^2 trajectories run back when velocities turn: order in dt of the distance "
                    "from the start", value=calculated("order of the way back"),
          because="what is left is the integrator's, of fourth order"),
    Claim(id="khp95-hard-reversal", source="KHP95 Sec. III", printed="exact reversibility", expect=1,
          within=0, value=calculated("part that comes back bit by bit"), because="exact is all of them",
          headline=True,
          statement="paths run back exactly when velocities turn: part of the coordinates that come back to "
                    "the last bit, in whole numbers, after a time of 100"),
    Claim(id="khp95-conservation-momentum", source="KHP95 Sec. II", printed="exact", headline=True,
          statement="the sums conserve momentum exactly: sum of m dv/dt over the sum of moduli, periodic box",
          value=calculated("sum of forces over moduli"), at_most=1e-13,
          because="round-off of some 1000 terms"),
    Claim(id="khp95-conservation-energy", source="KHP95 Sec. II", printed="exact", headline=True,
          statement="the sums conserve energy exactly, viscosity and conduction included, periodic box",
          value=calculated("sum of energy rates over moduli"), at_most=1e-13,
          because="round-off of some 1000 terms"),
    Claim(id="khp95-rk4-efficient", source="KHP95 Sec. II", printed="efficient", at_most=1,
          value=calculated("error of RK4 over midpoint"),
          statement="fourth-order Runge-Kutta is efficient: error after t = 4.8 with dt = 0.4 over that of "
                    "second order (midpoint) with as many evaluations",
          because="less error for the same work"),
    Claim(id="khp95-rk4-order", source="KHP95 Sec. II", printed="fourth-order", at_least=3.8,
          statement="smooth weights let fourth-order Runge-Kutta be so at steps as in runs: order in dt of "
                    "the state after t = 4.8, dt 0.6 to 0.15",
          value=calculated("order of RK4, dt 0.6 to 0.15"), because=FOURTH,
          after="six starts had left it open, and eighteen more were run"),
    Claim(id="own-rk4-order-small", source="KHP95 Sec. II", at_least=3.8,
          statement="smooth weights let fourth-order Runge-Kutta be so as dt vanishes: order in dt of the "
                    "state after t = 4.8, dt 0.075 to 0.019",
          value=calculated("order of RK4, dt 0.075 to 0.019"), because=FOURTH),
    Claim(id="khp95-vdw-critical-point", source="KHP95 Sec. IV, Eq. 2", printed="2/3, 8/27", headline="Eq. 2",
          statement="slope and curvature of Eq. 2 along its isotherm vanish there",
          value=calculated("slope and curvature at the critical point, vdw"), at_most=1e-6,
          because="differences over 1e-4: truncation and round-off are 1e-8"),
    Claim(id="khp95-static-density", source="KHP95 Sec. IV", printed="g = kB dT/L",
          statement="the printed gravity keeps the motionless density exactly constant, for all three "
                    "equations of state; largest imbalance of forces", at_most=1e-12, because="round-off",
          value=calculated("imbalance of forces at rest")),
    Claim(id="khp95-prandtl", source="KHP95 Sec. IV", printed="unity",
          statement="equal coefficients eta = k mean Pr = 1, with C_V: ideal gas and van der Waals",
          value=calculated("|C_V - 1|, ideal and vdw"), at_most=1e-12, because="exact: Pr = eta C_V/k = C_V"),
    Claim(id="khp95-prandtl-dense", source="KHP95 Sec. IV", printed="unity", expect=1, within=0.05,
          statement='"in every case": eta = k means Pr = 1 with C_V for the dense fluid, too',
          value=calculated("C_V, dense"), because="one digit is printed, in words; C_V = 1.5 by Eq. 3"),
    Claim(id="khp95-prandtl-isobaric", source="KHP95 Sec. IV", printed="unity", expect=1, within=0.05,
          statement="eta = k means Pr = 1 for the ideal gas by the usual definition, with C_P",
          value=calculated("C_P, ideal"),
          because="one digit is printed, in words; the paper takes C_V, in which flow at constant pressure "
                  "has no part"),
    Claim(id="khp95-dense-inconsistent", source="KHP95 Sec. IV", printed="-1.5, 1.25",
          statement="the dense fluid violates the Maxwell relation: (dE/dV)_T over -d(beta P)/d(beta), "
                    "which should be 1", value=calculated("(dE/dV)_T over -d(beta P)/d(beta), dense"),
          expect=1.2, within=1e-12, because="1.5/1.25; 1 would be consistent"),
    Claim(id="khp95-dense-inverse", source="KHP95 Eq. 3", printed="0.7, 1.5", headline=True,
          statement="T(n, u) and u(n, T) of the dense fluid belong together: error of temperature between "
                    "the plates", value=calculated("largest |T(u(T)) - T|, dense"), at_most=0.0375,
          because="0.7 is 2/3 rounded, 0.05 of its last digit times du = 0.75; a solver that keeps u has "
                  "walls at 0.475 and 1.525 for 0.5 and 1.5"),
    Claim(id="khp95-vdw-stiffness", source="KHP95 Sec. IV", printed="considerably lower", at_most=0.8,
          statement="van der Waals has a considerably lower pressure relative to its sound speed than the "
                    "dense fluid: ratio of both 2P/(n m c^2)",
          value=calculated("2 P/(rho c^2), vdw over dense"),
          because='"considerably" is a fifth at least; what differs is P itself, 1.5 against 5'),
    Claim(id="khp95-pressure-sound", source="KHP95 Sec. IV", printed="P V/N approximates m c^2", expect=1,
          within=0.5, statement="at high pressure P/n is about m c^2: ratio for the dense fluid, P = 5",
          value=calculated("P/(rho c^2), dense"), because='"approximates", no digit: half'),
    Claim(id="khp95-boxes", source="KHP95 Figs 2, 3, 4, 7, 9, 10, 12", printed="n sigma^2 = 1",
          headline="Figs 2, 3",
          statement="particles and boxes of the captions have unit density; largest deviation",
          value=calculated("largest |density - 1| of captions"), at_most=1e-12, because="exact numbers"),
    Claim(id="khp95-ra-captions", source="KHP95 Figs 2, 3, 8, 9, 12", printed="10 000",
          headline="Figs 2, 3",
          statement="eta = 0.5 at L = 50 is Ra 10 000, here by dT^2 L^2/eta^2; largest deviation",
          value=calculated("largest |Ra - 10 000| of captions"), at_most=1e-9,
          because="exact numbers; alpha = 1, kappa = k/(rho C_V)"),
)
