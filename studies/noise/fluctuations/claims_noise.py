"""What RR98 says of noise for a computation and of its steps, judged: Eqs 42-44, their partner Eq. 37, Eqs 40, 41"""
from studies.build.read import exact
from studies.kit.claim import Claim
from studies.kit.stats import Measured
from studies.noise.fluctuations.arithmetic import bulk, finer, half_step, other_partner, smallest_of_44, tail
from studies.noise.fluctuations.claims import RIGHT, ROUND_OFF
from studies.noise.fluctuations.read import (
    better,
    by_hand,
    capacity,
    euler_law,
    from_cosine,
    from_sums,
    least,
    longest,
    nulls,
    order,
    spread,
    stepped,
    worst,
)

NOISE = (
    Claim(id="rr98-fluct-eq40-euler", source="RR98 Eq. 40", expect=1, within=0.01,
          because="1 %",
          value=stepped("forward-euler", 0.1, fluid="isothermal", wavenumber=0.02),
          statement="forward Euler keeps the temperature: kinetic over given, c^2 dt/nu = 0.1, isothermal gas, long waves"),
    Claim(id="rr98-fluct-eq40-law", source="RR98 Eq. 40", at_most=1e-3, value=euler_law,
          because="(nu k^2 dt)/2 of waves of 300 spacings, times 1/(1 - c^2 dt/nu) = 5",
          statement="forward Euler heats long waves by 1/(1 - c^2 dt/nu): largest relative distance, steps 0.01 to 0.8, waves of "
                    "300 spacings"),
    Claim(id="own-fluct-eq40-hand", source="RR98 Eq. 40", at_most=1e-8, value=by_hand,
          because="Lyapunov solves near their limit",
          statement="its variance is 1/(1 - s^2 dt/l - l dt/2 + 3 s^2 dt^2/4 - s^4 dt^3/4 l): largest relative distance, all "
                    "waves"),
    Claim(id="rr98-fluct-eq41-better", source="RR98 Eq. 41", printed="more accurate", at_most=1, value=better,
          because="more accurate is an error below that of Eq. 40 for both",
          statement="moving positions with Eq. 41 is more accurate than with Eq. 40: error of the kinetic temperature over "
                    "that, points that move as printed, largest of all steps and waves"),
    Claim(id="rr98-fluct-eq41-error", source="RR98 Eqs 40, 41", at_most=0.01, value=stepped("eq40-eq41", 0.1, "error",
                                                                                           wavenumber=0.02),
          because="1 %",
          statement="Eqs 40, 41 keep the temperature: kinetic over given less 1, c_T^2 dt/nu = 0.1, points that move as "
                    "printed"),
    Claim(id="own-fluct-crank-nicolson", source="RR98 Eq. 40", at_most=1e-10,
          value=stepped("crank-nicolson", 0.8, "error", fluid="gas"),
          because="Lyapunov solves",
          statement="Crank-Nicolson keeps all variances at any step: largest error at c^2 dt/nu = 0.8"),
    Claim(id="own-fluct-three-stage", source="RR98 Eq. 40", expect=3, within=0.1, value=order,
          because="next order at steps of 0.4",
          statement="three stages with two sets of noise keep variances to third order: power of dt in the largest error"),
    Claim(id="rr98-fluct-eq42-eta", source="RR98 Eq. 42", **RIGHT, value=longest("42", "eta", "single", 2, 1.2),
          statement="the eta term of Eq. 42, added once, with the volume and time it lacks, gives long shear waves the right "
                    "temperature: variance over its due, square lattice of nearest neighbours"),
    Claim(id="rr98-fluct-eq42-eta-doubled", source="RR98 Eq. 42", **RIGHT, value=longest("42", "eta", "doubled", 2, 1.2),
          statement="the eta term of Eq. 42, added as pi_ij + pi_ji, with the volume and time it lacks, gives long shear waves "
                    "the right temperature: variance over its due, square lattice of nearest neighbours"),
    Claim(id="rr98-fluct-eq42-zeta", source="RR98 Eqs 23, 42", expect=1, within=1e-9,
          value=lambda t: Measured(longest("42", "zeta", "single")(t).value/longest("23", "zeta", "single")(t).value, 0.0),
          because="algebra",
          statement="the zeta term of Eq. 42 has the variance of Eq. 23: their ratio; a factor sqrt 2 is missing"),
    *(Claim(id=f"rr98-fluct-eq42-zeta-{name}", source="RR98 Eq. 42", **RIGHT, value=longest("42", "zeta", reading, d, h),
            statement=f"the zeta term of Eq. 42, added {words}, with the volume and time it lacks, gives long waves the right "
                      f"temperature: variance over its due, {lattice}")
      for name, reading, words, d, h, lattice in (
          ("single", "single", "once", 1, 1.5, "a line of nearest neighbours"),
          ("doubled", "doubled", "as pi_ij + pi_ji", 1, 1.5, "a line of nearest neighbours"),
          ("wide", "doubled", "as pi_ij + pi_ji", 2, 3.0, "square lattice, h = 3 a"))),
    Claim(id="rr98-fluct-eq42-shape", source="RR98 Eq. 42", at_most=1.01, value=spread("42", "eta", 2, 1.2),
          because="1 %: of one factor for all waves",
          statement="with some factor Eq. 42 is the partner of Eq. 37: largest over smallest ratio of its variance to its due, "
                    "waves along an axis of the square lattice, nearest neighbours"),
    Claim(id="rr98-fluct-eq42-shape-h3", source="RR98 Eq. 42", at_most=1.01, value=spread("42", "eta", 2, 3.0),
          because="1 %: of one factor for all waves",
          statement="with some factor Eq. 42 is the partner of Eq. 37: largest over smallest ratio of its variance to its due, "
                    "waves along an axis of the square lattice, h = 3 a"),
    Claim(id="own-fluct-eq42-cosine", source="RR98 Eq. 42", at_most=1e-7, value=from_cosine("42", "zeta", 1.0, 1, 1.5),
          because="nine digits of wave numbers near the corner of the zone",
          statement="doubled, with nearest neighbours on a line, waves get the temperature T/cos^2(ka/2): largest relative "
                    "distance"),
    Claim(id="own-fluct-eq42-sums", source="RR98 Eqs 23, 25, 42, 43", at_most=1e-8, value=from_sums,
          because="nine digits in the table",
          statement="all printed noise has the variance that lattice sums give: largest relative distance, 1D, 2D, h = 1.2 to "
                    "3 a"),
    Claim(id="own-fluct-eq42-partner", source="RR98 Eqs 42, 51", at_most=1e-12, value=exact(other_partner), because=ROUND_OFF,
          statement="Eq. 42 is the exact partner of a friction along edges, as of Eq. 51, not of Eq. 37: |Q - 2 kT Gamma|, "
                    "random points, trace factor 2/d"),
    Claim(id="rr98-fluct-eq42-time", source="RR98 Eqs 42, 44", expect=1, within=0.01, value=exact(half_step),
          because="1 %",
          statement="increments of unit variance give a temperature that does not depend on the step: at dt/2 over at dt; "
                    "1/sqrt(dt) is missing"),
    Claim(id="rr98-fluct-eq42-volume", source="RR98 Eqs 27, 42", expect=1, within=0.01, value=exact(finer),
          because="1 %",
          statement="Eq. 42 as it stands gives a temperature that does not depend on the spacing: at a/2 over at a in 2D; a "
                    "volume is missing"),
    Claim(id="rr98-fluct-eq37-positive", source="RR98 Eq. 37", at_least=-1e-9, because=ROUND_OFF,
          value=least("negative", "eq42", maker="renormalised", points="lattice"),
          statement="Eq. 37 with viscosities that vary from point to point by factors of five dissipates on a lattice: smallest "
                    "eigenvalue of its symmetric part over its largest element; eta of one point times the slope of the other "
                    "may amplify"),
    Claim(id="rr98-fluct-eq37-symmetric", source="RR98 Eqs 37, 42", at_most=1e-9, because=ROUND_OFF,
          value=worst("asymmetry", ("eq42",), maker="renormalised", points="lattice"),
          statement="Eq. 37 with viscosities that vary is symmetric on a lattice, as what has a partner must be: |Gamma - "
                    "Gamma^T|"),
    Claim(id="rr98-fluct-eq37-constant", source="RR98 Eqs 37, 42", at_most=1e-12, because=ROUND_OFF,
          value=worst("asymmetry", ("eq42 constant",), maker="renormalised", points="lattice"),
          statement="Eq. 37 with constant viscosities is symmetric on a lattice: |Gamma - Gamma^T|"),
    Claim(id="rr98-fluct-eq37-off-lattice", source="RR98 Eqs 37, 42", at_most=1e-9, because=ROUND_OFF,
          value=worst("asymmetry", ("eq42 constant",), maker="renormalised", points="jittered-0.3"),
          statement="Eq. 37 as printed with constant viscosities is symmetric off a lattice: |Gamma - Gamma^T|, points jittered "
                    "by 0.3 a, edges of a weight"),
    Claim(id="rr98-fluct-eq37-uniform", source="RR98 Eqs 37, 42", at_most=1e-9, because=ROUND_OFF,
          value=worst("uniform", ("eq42 constant",), maker="renormalised", points="jittered-0.3"),
          statement="Eq. 37 as printed with constant viscosities does not see uniform motion off a lattice: force over the "
                    "largest element, points jittered by 0.3 a, edges of a weight"),
    Claim(id="rr98-fluct-eq42-current", source="RR98 Eqs 42, 43", printed="a minor approximation", expect=1, within=0.01,
          value=capacity("current", "corrected"),
          because="a minor approximation is worth a per cent at most",
          statement="amplitudes at current temperatures are a minor approximation: variance of temperature of points with C = "
                    "20 k over that of the entropy C ln T"),
    Claim(id="own-fluct-eq43-ito", source="RR98 Eq. 43", expect=1, within=0.01, value=capacity("corrected", "corrected"),
          because="1 %: what samples reach",
          statement="with the flux times 1 + k/C they are right: variance of temperature of points with C = 20 k over that of "
                    "the entropy C ln T"),
    Claim(id="own-fluct-eq43-bias", source="RR98 Eq. 43", expect=1, within=0.01, value=capacity("current", "current"),
          because="1 %: what samples reach",
          statement="without it energies are distributed as if C were less by k: variance of temperature of points with C = 20 "
                    "k over that of the entropy (C - k) ln T"),
    Claim(id="rr98-fluct-eq43-single", source="RR98 Eq. 43", **RIGHT, value=longest("43", "kappa", "single"),
          statement="Eq. 43, added once, with volume and time, gives long waves the right fluctuation of energy at T = 0.7: "
                    "variance over its due, a line of nearest neighbours"),
    Claim(id="rr98-fluct-eq43-doubled", source="RR98 Eq. 43", **RIGHT, value=longest("43", "kappa", "doubled"),
          statement="Eq. 43, added as J_ij + J_ji, with volume and time, gives long waves the right fluctuation of energy at T "
                    "= 0.7: variance over its due, a line of nearest neighbours; a factor T is missing"),
    Claim(id="own-fluct-eq43-cosine", source="RR98 Eq. 43", at_most=1e-7, value=from_cosine("43", "kappa", 1/0.7, 1, 1.5),
          because="nine digits of wave numbers near the corner of the zone",
          statement="doubled, with nearest neighbours on a line, energies get 1/(T cos^2(ka/2)) times their variance: largest "
                    "relative distance, T = 0.7"),
    Claim(id="rr98-fluct-eq44-exists", source="RR98 Eq. 44", at_least=-1e-12, value=exact(smallest_of_44),
          because="arithmetic",
          statement="there are increments with the covariance of X: its smallest eigenvalue in 1, 2 and 3 dimensions"),
    Claim(id="rr98-fluct-eq44-trace-2d", source="RR98 Eq. 44", expect=0, within=1e-9, value=exact(lambda: bulk(2)),
          because="arithmetic",
          statement="X has no trace in 2D: variance of its trace over d^2; 2/3 must be 2/d"),
    Claim(id="rr98-fluct-eq44-trace-3d", source="RR98 Eq. 44", expect=0, within=1e-9, value=exact(lambda: bulk(3)),
          because="arithmetic",
          statement="X has no trace in 3D: variance of its trace over d^2"),
    Claim(id="own-fluct-nulls", source="RR98 Eq. 37", expect=8, within=0, value=nulls("stress"),
          because="counted",
          statement="nested viscosity on a square lattice with even sides leaves d 2^d velocity modes alone: null modes in 2D"),
    Claim(id="own-fluct-no-nulls", source="RR98 Eqs 37, 51", expect=2, within=0, value=nulls("stress+friction"),
          because="counted",
          statement="a tenth of friction along edges leaves only uniform motion: null modes in 2D"),
    Claim(id="own-fluct-tail", source="RR98 Eq. 37", expect=4, within=0.1, value=exact(lambda: tail(1.2)),
          because="next order, 1/(nu t) = 3 %",
          statement="null modes and their surroundings multiply the tail of the velocity autocorrelation of a point by 2^d: "
                    "over 1/(4 pi nu t) in 2D, nearest neighbours, nu t = 30 a^2"),
    Claim(id="own-fluct-tail-h2", source="RR98 Eq. 37", expect=4, within=0.1, value=exact(lambda: tail(2.0)),
          because="next order, 1/(nu t) = 3 %",
          statement="wider weights make no difference to that: tail over 1/(4 pi nu t) in 2D, h = 2 a, nu t = 30 a^2"),
)
