"""What RR98 says of noise for a computation and of its steps, judged    [RR98 Eqs 40-44, Sec. III B]"""
from studies.kit.ask import Value, largest, largest_per, one, spread
from studies.kit.claim import Claim
from studies.noise.claims import RIGHT, ROUND_OFF, longest
from studies.noise.derive import MIXED, STILL

GOOD = {"GrootWarren": "Groot-Warren with lambda = 1/2", "GrootWarren65": "Groot-Warren with lambda = 0.65",
        "VelocityVerlet": "velocity-Verlet with friction evaluated again", "Shardlow": "Shardlow's splitting",
        "KickDriftFrictionDriftKick": "kick, drift, friction, drift, kick"}
PERCENT = "1 % is what the paper wants of a step of good integrators"


def formula(name: str) -> Value:
    """What a printed formula gives by arithmetic."""
    return one("formulas", "value", name=name)


def stepped(integrator: str, column: str, fluid: str) -> Value:
    """Of a step of 0.1 nu/c^2, longest wave."""
    return one("steps", column, integrator=integrator, fluid=fluid, dt=0.1, wavenumber=0.02)


def error_of(integrator: str) -> Value:
    """Of the kinetic temperature after steps of some length, of one wave."""
    return one("steps", "error", integrator=integrator)


def printed_step(column: str, a: float) -> Value:
    """Of the error of kT of dissipative particles with Eqs 40, 41 over dt."""
    return one("errors", column, integrator="TwoStep", a=a, temperature="kinetic")


def error_at(integrator: str, dt: float, temperature: str) -> Value:
    """kT - 1 of dissipative particles with repulsion, in the usual box."""
    formula = f"{temperature} - 1"
    return one("states", formula, err=f"{temperature}_err", integrator=integrator, dt=dt, a=25.0, side=8.0)


CLAIMS = (
    Claim(id="rr98-fluct-eq40-euler", source="RR98 Eq. 40", expect=1, within=0.01, because="1 %",
          value=stepped("forward-euler", "velocity", "isothermal"),
          statement="forward Euler keeps the temperature: kinetic over given, c^2 dt/nu = 0.1, isothermal "
                    "gas, long waves"),
    Claim(id="rr98-fluct-eq41-better", source="RR98 Eq. 41", printed="more accurate", at_most=1,
          value=largest_per(("wavenumber", "dt"), error_of("eq40-eq41")/error_of("eq40-eq40")),
          because="more accurate is an error below that of Eq. 40 for both",
          statement="moving positions with Eq. 41 is more accurate than with Eq. 40: error of the kinetic "
                    "temperature over that, points that move as printed, largest of all steps and waves"),
    Claim(id="rr98-fluct-eq41-error", source="RR98 Eqs 40, 41", at_most=0.01, because="1 %",
          value=stepped("eq40-eq41", "error", "moving"),
          statement="Eqs 40, 41 keep the temperature: kinetic over given less 1, c_T^2 dt/nu = 0.1, points "
                    "that move as printed"),
    Claim(id="rr98-fluct-eq42-eta", source="RR98 Eq. 42", **RIGHT,
          value=longest("42", "eta", "single", 2, 1.2),
          statement="the eta term of Eq. 42, added once, with the volume and time it lacks, gives long "
                    "shear waves the right temperature: variance over its due, square lattice of nearest "
                    "neighbours"),
    Claim(id="rr98-fluct-eq42-eta-doubled", source="RR98 Eq. 42", **RIGHT,
          value=longest("42", "eta", "doubled", 2, 1.2),
          statement="the eta term of Eq. 42, added as pi_ij + pi_ji, with the volume and time it lacks, "
                    "gives long shear waves the right temperature: variance over its due, square lattice of "
                    "nearest neighbours"),
    Claim(id="rr98-fluct-eq42-zeta", source="RR98 Eqs 23, 42", expect=1, within=1e-9, because="algebra",
          value=longest("42", "zeta", "single")/longest("23", "zeta", "single"),
          statement="the zeta term of Eq. 42 has the variance of Eq. 23: their ratio; a factor sqrt 2 is "
                    "missing"),
    Claim(id="rr98-fluct-eq42-shape", source="RR98 Eq. 42", at_most=1.01, because="1 %: of one factor for "
                                                                                  "all waves",
          value=spread("printed", "ratio", equation="42", term="eta", reading="doubled", d=2, h=1.2),
          statement="with some factor Eq. 42 is the partner of Eq. 37: largest over smallest ratio of its "
                    "variance to its due, waves along an axis of the square lattice, nearest neighbours"),
    Claim(id="own-fluct-eq42-cosine", source="RR98 Eq. 42", at_most=1e-7,
          value=largest("printed", "abs(ratio*cos(wavenumber/2)**2/1.0 - 1)", equation="42", term="zeta",
                        reading="doubled",
                        d=1, h=1.5),
          because="nine digits of wave numbers near the corner of the zone",
          statement="doubled, with nearest neighbours on a line, waves get the temperature T/cos^2(ka/2): "
                    "largest relative distance"),
    Claim(id="own-fluct-eq42-partner", source="RR98 Eqs 42, 51", at_most=1e-12, because=ROUND_OFF,
          value=formula("partner of Eq. 42"),
          statement="Eq. 42 is the exact partner of a friction along edges, as of Eq. 51, not of Eq. 37: |Q "
                    "- 2 kT Gamma|, random points, trace factor 2/d"),
    Claim(id="rr98-fluct-eq42-time", source="RR98 Eqs 42, 44", expect=1, within=0.01, because="1 %",
          value=formula("step of Eq. 42"),
          statement="increments of unit variance give a temperature that does not depend on the step: at "
                    "dt/2 over at dt; 1/sqrt(dt) is missing"),
    Claim(id="rr98-fluct-eq42-volume", source="RR98 Eqs 27, 42", expect=1, within=0.01, because="1 %",
          value=formula("spacing of Eq. 42"),
          statement="Eq. 42 as it stands gives a temperature that does not depend on the spacing: at a/2 "
                    "over at a in 2D; a volume is missing"),
    Claim(id="rr98-fluct-eq37-symmetric", source="RR98 Eqs 37, 42", at_most=1e-9, because=ROUND_OFF,
          value=largest("partners", "abs(asymmetry)", noise="eq42", maker="renormalised", points="lattice"),
          statement="Eq. 37 with viscosities that vary is symmetric on a lattice, as what has a partner "
                    "must be: |Gamma - Gamma^T|"),
    Claim(id="rr98-fluct-eq42-current", source="RR98 Eqs 42, 43", printed="a minor approximation",
          expect=1, within=0.01,
          value=one("capacity", "measured", C=20.0, noise="current")
                /one("capacity", "predicted", C=20.0, noise="corrected"),
          because="a minor approximation is worth a per cent at most",
          statement="amplitudes at current temperatures are a minor approximation: variance of temperature "
                    "of points with C = 20 k over that of the entropy C ln T"),
    Claim(id="rr98-fluct-eq43-doubled", source="RR98 Eq. 43", **RIGHT,
          value=longest("43", "kappa", "doubled"),
          statement="Eq. 43, added as J_ij + J_ji, with volume and time, gives long waves the right "
                    "fluctuation of energy at T = 0.7: variance over its due, a line of nearest neighbours; "
                    "a factor T is missing"),
    Claim(id="own-fluct-eq43-cosine", source="RR98 Eq. 43", at_most=1e-7,
          value=largest("printed", "abs(ratio*cos(wavenumber/2)**2/(1/0.7) - 1)", equation="43", term="kappa",
                        reading="doubled", d=1, h=1.5),
          because="nine digits of wave numbers near the corner of the zone",
          statement="doubled, with nearest neighbours on a line, energies get 1/(T cos^2(ka/2)) times their "
                    "variance: largest relative distance, T = 0.7"),
    Claim(id="rr98-fluct-eq44-trace-2d", source="RR98 Eq. 44", expect=0, within=1e-9, because="arithmetic",
          value=formula("trace of Eq. 44"),
          statement="X has no trace in 2D: variance of its trace over d^2; 2/3 must be 2/d"),
    Claim(id="rr98-fluct-sec3b-special", source="RR98 Sec. III B, Eqs 42, 49, 51", printed="special cases",
          at_most=1e-12,
          value=formula("dissipative particles, form"), because="round-off of sums of some ten forces",
          statement="dissipative particles are a special case in form: forces that run, noise included, "
                    "against Eq. 49 with A of Eq. 51 and the zeta term of Eq. 42, largest difference over "
                    "the largest force, 2D and 3D"),
    Claim(id="rr98-fluct-sec3b-partner", source="RR98 Sec. III B, Eqs 42, 51", at_most=1e-12,
          value=formula("dissipative particles, partner"),
          because="round-off of sums of forces of 100, of which friction is one",
          statement="and exact partners where A is as the weight, so that friction has its square [as "
                    "Espanol & Warren 1995 want]: |Q - 2 kT Gamma|, Gamma of the forces that run, random "
                    "points"),
    Claim(id="rr98-fluct-sec3b-unmodified", source="RR98 Sec. III B, Eqs 42, 51", at_most=0.01,
          value=formula("dissipative particles, unmodified"), because="1 %",
          printed="the random contributions already refer to hydrodynamic fluctuations",
          statement="noise need not be modified for the friction beside it: |Q - 2 kT Gamma|, friction with "
                    "the weight of the noise, not its square, that takes as much energy in all, random "
                    "points"),
    *(Claim(id=f"rr98-fluct-sec3b-viscosity{short}", source="RR98 Sec. III B, Eqs 42, 51",
            expect=1, within=0.05,
            value=formula(f"dissipative particles, viscosity {reading}"),
            printed="with particular temperature and viscosity as given by Eq. (42)", because="5 %: more "
                                                                                              "than "
                                                                                              "arithmetic "
                                                                                              "has",
            statement="the viscosity that Eq. 42, with the volume it lacks, gives to their noise is that of "
                      f"their friction: bulk viscosity of the noise over that of Eq. 51, brackets {words}, "
                      "3D, rho = 3, whatever gamma; it goes as rho")
      for short, reading, words in (("", "doubled", "doubled"), ("-single", "single", "as in Eq. 22"))),
    *(Claim(id=f"rr98-two-step-dpd-order{short}", source="RR98 Eqs 40, 41", expect=1, within=0.1,
            value=printed_step("order", a),
            statement="the step of Eqs 40, 41 includes the fluctuations: order in dt of the error of kT, "
                      + words,
            because="0.1 parts first from second order; the quadratic part is a tenth of the linear one here")
      for short, a, words in (("", 25.0, "a = 25"), ("-gas", 0.0, "without repulsion"))),
    *(Claim(id=f"rr98-two-step-dpd-{name}", source="RR98 Eqs 40, 41", expect=STILL, within=0.05*STILL,
            value=printed_step("linear", a),
            statement=f"relative error of kT over dt, for small steps {words}, is half of a particle's rate "
                      "of friction, (rho gamma/2d) int w^2 dV, as for points that stand still",
            because="5 %: the integral is over points without order")
      for name, a, words in (("fluid", 25.0, "at a = 25"), ("still", 0.0, "without repulsion"))),
    Claim(id="rr98-two-step-dpd-mixed", source="RR98 Eqs 40, 41", at_least=STILL, at_most=MIXED,
          value=printed_step("linear", 0.0),
          statement="relative error of kT over dt, for small steps without repulsion, lies between that of "
                    "points that stand still and that of points that mix at once, <Lambda^2>/(2 <Lambda>)",
          because="both limits of forward friction with points without order, 0.94 and 2.23"),
    Claim(id="rr98-two-step-dpd-percent", source="RR98 Eqs 40, 41", at_most=0.01, because=PERCENT,
          value=abs(error_at("TwoStep", 0.02, "kinetic")),
          statement="Eqs 40, 41 keep kT of dissipative particles at a = 25 within 1 % at dt = 0.02"),
    *(Claim(id=f"own-dpd-long-{temperature}-{integrator.lower()}", source="Groot & Warren 1997", at_most=0.01,
            printed="dt = 0.04 to 0.06", because=PERCENT,
            value=one("long", f"abs({temperature} - 1)", err=f"{temperature}_err", integrator=integrator),
            statement=f"{words} keeps the {temperature} kT within 1 % at dt = 0.02: |error|, runs made "
                      "longer until that was decided")
      for integrator, words in GOOD.items() for temperature in ("kinetic", "configurational")),
    Claim(id="own-dpd-middle", source="Leimkuhler & Matthews 2013", at_most=0.5,
          value=abs(error_at("KickDriftFrictionDriftKick", 0.06, "configurational")
                    /error_at("Shardlow", 0.06, "configurational")),
          statement="with friction and noise in the middle of the step positions know their kT better than "
                    "with Verlet's rule after friction: error of the configurational kT over that of "
                    "Shardlow's splitting, dt = 0.06",
          because="a half: of one harmonic frequency nothing is left, and repulsion is harmonic but for its "
                  "end at rc and for the turning of pairs"),
    Claim(id="own-dpd-pressure-asked", source="Allen & Tildesley 2017, example dpd", printed="23.635 to "
                                                                                             "23.637",
          expect=23.64, within=0.02, value=one("long", "P", integrator="KickDriftFrictionDriftKick"),
          statement="pressure of dissipative particles at a = 25, rho = 3, kT = 1, with rho kT as it is "
                    "asked for, which print has, friction in the middle of the step, dt = 0.02; the same "
                    "pressure with the velocities' kT had been left open", because="0.1 %"),
    Claim(id="own-dpd-pressure-100", source="Allen & Tildesley 2017, example dpd", printed="23.635 to 23.637",
          expect=23.636, within=0.02, value=one("states", "P", n=100), because="0.1 %",
          statement="pressure of the 100 particles that print has, a = 25, rho = 3, kT = 1, dt = 0.02"),
    Claim(id="rr98-dpd-momentum", source="RR98 Sec. III B", at_most=1e-12, value=largest("states", "drift"),
          statement="with ij-symmetrised forms the conservation laws are guaranteed: largest mean velocity "
                    "of dissipative particles in any run",
          because="round-off of up to 30 000 steps of forces of 100"),
)
