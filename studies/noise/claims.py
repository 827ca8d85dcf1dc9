"""What RR98 says of noise and of its steps, judged    [RR98 Eqs 20-25, 40-44, Sec. III B]"""
from typing import Any

from studies.kit.ask import Value, farthest_per, first, largest, largest_per, one, power, spread
from studies.kit.claim import Claim

MOMENTA = ("stress", "friction", "stress+friction")
ENERGIES = ("heat", "conduction", "heat+conduction")
OBEY = "must obey discretized versions of the fluctuation-dissipation expressions"
USUAL = "usual fluctuation-dissipation"
INCLUDES = "useful to include the fluctuations"
ROUND_OFF = "round-off of sums of some ten terms, solves with condition 1e3 in some makers"
PERCENT = "1 % is what the paper wants of a step of good integrators"
RIGHT: dict[str, Any] = {"expect": 1, "within": 0.05,
                         "because": "5 %: waves of 32 spacings on a line are 1/cos^2(0.1) = 1.01"}
TEMPERATURES = ("kinetic", "configurational")
#: integrators of dissipative particles that Groot & Warren do not have
OTHERS = ("VelocityVerlet", "Shardlow", "KickDriftFrictionDriftKick")
LONGER = "shorter runs had left it open, and runs were made longer until it was decided"


def longest(equation: int, term: str, reading: str, d: int = 1, h: float = 1.5) -> Value:
    """Variance of printed noise over its due, longest wave."""
    return first("printed", "ratio", by="wavenumber", equation=equation, term=term, reading=reading, d=d, h=h)


def formula(name: str) -> Value:
    """What a printed formula gives by arithmetic."""
    return one("formulas", "value", name=name)


def stepped(integrator: str, column: str, fluid: str) -> Value:
    """Of a step of 0.1 nu/c^2, longest wave."""
    return one("steps", column, integrator=integrator, fluid=fluid, dt=0.1, wavenumber=0.02)


def error_of(integrator: str) -> Value:
    """Of the kinetic temperature after steps of some length, of one wave."""
    return one("steps", "error", integrator=integrator)


def due(name: str, printed: str, value: Value, statement: str, headline: bool = True) -> Claim:
    """Printed noise gives long waves what is due beside Eqs 37, 38; its name begins with the equation."""
    return Claim(id=f"rr98-fluct-eq{name}", source=f"RR98 Eq. {name[:2]}", printed=printed, **RIGHT,
                 value=value, statement=statement, headline=headline, evidence="noise/printed.png"*headline)


LONG_WAVES = (
    due("23-single", USUAL, longest(23, "zeta", "single"),
        "Eq. 23, added once (Eq. 22), with the volume it lacks, gives long waves the right temperature: "
        "variance over its due, zeta term, a line of nearest neighbours"),
    due("23-doubled", USUAL, longest(23, "zeta", "doubled"),
        "Eq. 23, added as pi_ij + pi_ji, with the volume it lacks, gives long waves the right temperature: "
        "variance over its due, zeta term, a line of nearest neighbours"),
    due("23-neighbours", USUAL, longest(23, "zeta", "doubled", 2, 3.0),
        "Eq. 23 does so whatever the reach of the weight, added as pi_ij + pi_ji: variance over its due, 2D, "
        "h = 3 a", headline=False),
    due("25-doubled", OBEY, longest(25, "kappa", "doubled"),
        "Eq. 25, added as J_ij + J_ji, with the volume it lacks, gives long waves the right fluctuation of "
        "energy: variance over its due, a line of nearest neighbours"),
    due("42-eta", OBEY, longest(42, "eta", "single", 2, 1.2),
        "the eta term of Eq. 42, added once, with the volume and time it lacks, gives long shear waves the "
        "right temperature: variance over its due, square lattice of nearest neighbours", headline=False),
    due("42-eta-doubled", OBEY, longest(42, "eta", "doubled", 2, 1.2),
        "the eta term of Eq. 42, added as pi_ij + pi_ji, with the volume and time it lacks, gives long shear "
        "waves the right temperature: variance over its due, square lattice of nearest neighbours"),
    due("43-doubled", OBEY, longest(43, "kappa", "doubled"),
        "Eq. 43, added as J_ij + J_ji, with volume and time, gives long waves the right fluctuation of "
        "energy at T = 0.7: variance over its due, a line of nearest neighbours; a factor 2 T of the "
        "variance of Eq. 25 is missing"),
)
CLAIMS = (
    *LONG_WAVES,
    Claim(id="rr98-fluct-eq20-small", source="RR98 Eq. 20", printed="small fluctuations", headline=True,
          expect=1, within=0.03,
          value=one("nonlinear", "ratio", field="rho", k=1e-3),
          because="3 %: what the samples reach; next orders are k/C = 1e-3",
          statement="in the full equations, current amplitudes, densities fluctuate as linearised: variance "
                    "over kT rho/(c_T^2 V), C = 1000 k a point"),
    Claim(id="rr98-fluct-eq22-momentum", source="RR98 Eq. 22", printed="symmetric", at_most=1e-12,
          headline=True,
          because=ROUND_OFF,
          value=largest("partners", "abs(sums)", noise=MOMENTA),
          statement="random stresses change no total momentum: largest sum over points, all makers and "
                    "point sets, 1 to 3 dimensions"),
    Claim(id="own-fluct-partners", source="RR98 Eqs 22-25", at_most=1e-12, because=ROUND_OFF,
          value=largest("partners", "abs(mismatch)", noise=(*MOMENTA, *ENERGIES)),
          statement="one random stress and heat current a point, or noise along edges, or a mixture: "
                    "largest |Q - 2 kT Gamma|, all makers, points and dimensions, coefficients that vary by "
                    "factors of five"),
    Claim(id="rr98-fluct-eq24-energy", source="RR98 Eq. 24", printed="symmetric", at_most=1e-12,
          headline=True,
          because=ROUND_OFF,
          value=largest("partners", "abs(sums)", noise=ENERGIES),
          statement="random heat currents change no total energy: largest sum over points, all makers and "
                    "point sets"),
    Claim(id="own-fluct-eq25-onset", source="RR98 Eqs 20-25",
          expect=-1, within=0.02,
          value=farthest_per("rows", power("onset", "velocity - 1", "below", "below < 0.06"), centre=-1),
          because="0.02: other modes add a constant, of 1 % at 0.05 below onset",
          after="layers from 0.005 below onset on had left it open",
          statement="fluctuations of a layer heated from below grow as 1/(Ra_c - Ra) on the way to onset, "
                    "Ra_c by eigenvalues: power of 1 - Ra/Ra_c in <w w> less equilibrium, 0.0005 to 0.05"),
    Claim(id="rr98-fluct-eq40-euler", source="RR98 Eq. 40", printed=INCLUDES, expect=1, within=0.01,
          because="1 %",
          headline=True,
          value=stepped("forward-euler", "velocity", "isothermal"),
          statement="forward Euler keeps the temperature: kinetic over given, c^2 dt/nu = 0.1, isothermal "
                    "gas, long waves"),
    Claim(id="rr98-fluct-eq41-better", source="RR98 Eq. 41", printed="more accurate", at_most=1,
          headline=True,
          value=largest_per(("wavenumber", "dt"), error_of("eq40-eq41")/error_of("eq40-eq40")),
          because="more accurate is an error below that of Eq. 40 for both",
          statement="moving positions with Eq. 41 is more accurate than with Eq. 40: error of the kinetic "
                    "temperature over that, points that move as printed, largest of all steps and waves"),
    Claim(id="rr98-fluct-eq41-error", source="RR98 Eqs 40, 41", printed=INCLUDES, at_most=0.01, because="1 %",
          value=stepped("eq40-eq41", "error", "moving"),
          statement="Eqs 40, 41 keep the temperature: kinetic over given less 1, c_T^2 dt/nu = 0.1, points "
                    "that move as printed"),
    Claim(id="rr98-fluct-eq42-zeta", source="RR98 Eqs 23, 42", printed=OBEY, expect=1, within=1e-9,
          because="algebra",
          value=longest(42, "zeta", "single")/longest(23, "zeta", "single"),
          statement="the zeta term of Eq. 42 has the variance of Eq. 23: their ratio; a factor sqrt 2 is "
                    "missing"),
    Claim(id="rr98-fluct-eq42-shape", source="RR98 Eq. 42", printed=OBEY, at_most=1.01,
          because="1 %: of one factor for all waves",
          value=spread("printed", "ratio", equation=42, term="eta", reading="doubled", d=2, h=1.2),
          statement="with some factor Eq. 42 is the partner of Eq. 37: largest over smallest ratio of its "
                    "variance to its due, waves along an axis of the square lattice, nearest neighbours"),
    Claim(id="own-fluct-eq42-partner", source="RR98 Eqs 42, 51", at_most=1e-12, because=ROUND_OFF,
          value=formula("partner of Eq. 42"),
          statement="Eq. 42 is the exact partner of a friction along edges, as of Eq. 51, not of Eq. 37: |Q "
                    "- 2 kT Gamma|, random points, trace factor 2/d"),
    Claim(id="rr98-fluct-eq42-time", source="RR98 Eqs 42, 44", expect=1, within=0.01, because="1 %",
          printed="Wiener processes",
          headline=True,
          value=formula("step of Eq. 42"),
          statement="increments of unit variance give a temperature that does not depend on the step: at "
                    "dt/2 over at dt; 1/sqrt(dt) is missing"),
    Claim(id="rr98-fluct-eq42-volume", source="RR98 Eqs 27, 42", printed=OBEY, expect=1, within=0.01,
          because="1 %", value=formula("spacing of Eq. 42"),
          statement="Eq. 42 as it stands gives a temperature that does not depend on the spacing: at a/2 "
                    "over at a in 2D; a volume is missing"),
    Claim(id="rr98-fluct-eq42-current", source="RR98 Eqs 42, 43", printed="a minor approximation",
          headline=True,
          expect=1, within=0.01,
          value=one("capacity", "measured", C=20.0)/one("capacity", "due", C=20.0),
          because="a minor approximation is worth a per cent at most",
          statement="amplitudes at current temperatures are a minor approximation: variance of temperature "
                    "of points with C = 20 k over that of the entropy C ln T"),
    Claim(id="rr98-fluct-sec3b-special", source="RR98 Sec. III B, Eqs 42, 49, 51", printed="special cases",
          at_most=1e-12,
          value=formula("dissipative particles, form"), because="round-off of sums of some ten forces",
          statement="dissipative particles are a special case in form: forces that run, noise included, "
                    "against Eq. 49 with A of Eq. 51 and the zeta term of Eq. 42, largest difference over "
                    "the largest force, 2D and 3D"),
    Claim(id="rr98-fluct-sec3b-unmodified", source="RR98 Sec. III B, Eqs 42, 51", at_most=0.01,
          value=formula("dissipative particles, unmodified"), because="1 %",
          printed="the random contributions already refer to hydrodynamic fluctuations",
          statement="noise need not be modified for the friction beside it: |Q - 2 kT Gamma|, friction with "
                    "the weight of the noise, not its square, that takes as much energy in all, random "
                    "points"),
    *(Claim(id=f"rr98-fluct-sec3b-viscosity{short}", source="RR98 Sec. III B, Eqs 42, 51",
            expect=1, within=0.05,
            value=formula(f"dissipative particles, viscosity {reading}"),
            printed="with particular temperature and viscosity as given by Eq. (42)",
            because="5 %: more than arithmetic has",
            statement="the viscosity that Eq. 42, with the volume it lacks, gives to their noise is that of "
                      f"their friction: bulk viscosity of the noise over that of Eq. 51, brackets {words}, "
                      "3D, rho = 3, whatever gamma; it goes as rho")
      for short, reading, words in (("", "doubled", "doubled"), ("-single", "single", "as in Eq. 22"))),
    Claim(id="own-two-step-dpd-percent", source="RR98 Eqs 40, 41", at_most=0.01, because=PERCENT,
          value=abs(one("states", "kinetic - 1", err="kinetic_err", integrator="TwoStep", dt=0.02, side=8.0)),
          statement="Eqs 40, 41 keep kT of dissipative particles at a = 25 within 1 % at dt = 0.02"),
    *(Claim(id=f"groot-warren-dpd-long-{temperature}-{integrator.lower()}", source="Groot & Warren 1997",
            at_most=0.01, printed="dt = 0.04 to 0.06", because=PERCENT, after=LONGER,
            value=one("long", f"abs({temperature} - 1)", err=f"{temperature}_err", integrator=integrator),
            statement=f"Groot-Warren with lambda = {words} keeps the {temperature} kT within 1 % at dt = "
                      "0.02: |error|")
      for integrator, words in (("GrootWarren", "1/2"), ("GrootWarren65", "0.65"))
      for temperature in TEMPERATURES),
    *(Claim(id=f"own-dpd-long-{temperature}", source="Groot & Warren 1997", at_most=0.01, because=PERCENT,
            value=largest("long", f"abs({temperature} - 1)", err=f"{temperature}_err", integrator=OTHERS),
            statement=f"the {temperature} kT is kept within 1 % at dt = 0.02 by velocity-Verlet with "
                      "friction evaluated again, by Shardlow's splitting and by kick, drift, friction, "
                      "drift, kick: largest |error|", after=LONGER)
      for temperature in TEMPERATURES),
    Claim(id="allen-tildesley-dpd-pressure-asked", source="Allen & Tildesley 2017, example dpd",
          printed="23.635 to 23.637", expect=23.64, within=0.02,
          value=one("long", "P", integrator="KickDriftFrictionDriftKick"),
          statement="pressure of dissipative particles at a = 25, rho = 3, kT = 1, with rho kT as it is "
                    "asked for, which print has, friction in the middle of the step, dt = 0.02",
          because="0.1 %", after="the pressure with the velocities' kT had been left open"),
    Claim(id="allen-tildesley-dpd-pressure-100", source="Allen & Tildesley 2017, example dpd",
          printed="23.635 to 23.637", expect=23.636, within=0.02, because="0.1 %",
          value=one("states", "P", n=100),
          statement="pressure of the 100 particles that print has, a = 25, rho = 3, kT = 1, dt = 0.02"),
)
