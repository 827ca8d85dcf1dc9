"""What RR98 says of fluctuations, judged    [RR98 Eqs 20-25, 40-44]"""
from typing import Any

from studies.convection.claims.read import exact
from studies.fluctuating.fluct_arithmetic import (
    bulk,
    finer,
    half_step,
    inner_k,
    integral,
    other_partner,
    smallest_of_44,
    tail,
    wrong_sign,
)
from studies.fluctuating.fluct_read import (
    ENERGIES,
    EXACT,
    MOMENTA,
    at_rest,
    better,
    by_hand,
    capacity,
    drift,
    euler_law,
    from_cosine,
    from_sums,
    gradient_ratio,
    gradient_slope,
    growth,
    largest_z,
    least,
    longest,
    nonlinear,
    nulls,
    onset_nearest,
    onset_power,
    order,
    peak,
    rms_z,
    spread,
    stepped,
    structure,
    total,
    worst,
)
from studies.fluctuating.fluct_read_flows import spectrum
from studies.kit.claim import Claim
from studies.kit.stats import Measured

RIGHT: dict[str, Any] = {"expect": 1, "within": 0.05, "because": "5 %: waves of 32 spacings on a line are 1/cos^2(0.1) = 1.01"}
ROUND_OFF = "round-off of sums of some ten terms, solves with condition 1e3 in some makers"
CLAIMS = (
    *(Claim(id=f"rr98-fluct-eq20-rest{short}", source="RR98 Eqs 20-25", at_most=1e-10, value=at_rest(*makers),
            because="Lyapunov's equation, solved twice, with differences good to 1e-12",
            statement="fluctuations linear about a gas at rest are those of equilibrium when each point has its own stress and "
                      f"heat current: largest |C - C_eq|, {words}")
      for short, makers, words in (
          ("", ("renormalised", "delaunay"), "lattices, jittered and random points with Delaunay edges"),
          ("-weight", ("closed", "exact"), "jittered points with edges of a weight that close, where hardly damped modes are"))),
    Claim(id="rr98-fluct-eq20-small", source="RR98 Eq. 20", printed="small fluctuations", expect=1, within=0.03,
          value=nonlinear("rho"),
          because="3 %: what the samples reach; next orders are k/C = 1e-3",
          statement="in the full equations, current amplitudes, densities fluctuate as linearised: variance over kT rho/(c_T^2 "
                    "V), C = 1000 k a point"),
    Claim(id="rr98-fluct-eq20-small-v", source="RR98 Eqs 20, 22", expect=1, within=0.03, value=nonlinear("v"),
          because="3 %: what the samples reach; next orders are k/C = 1e-3",
          statement="in the full equations velocities fluctuate as in equilibrium: variance over kT/(rho V), C = 1000 k a "
                    "point"),
    Claim(id="rr98-fluct-eq20-small-T", source="RR98 Eqs 20, 24", expect=1, within=0.03, value=nonlinear("T"),
          because="3 %: what the samples reach; next orders are k/C = 1e-3",
          statement="in the full equations temperatures fluctuate as in equilibrium: variance over kT^2/(rho C_V V), C = 1000 "
                    "k"),
    Claim(id="rr98-fluct-eq21-growth", source="RR98 Eq. 21", at_most=1e-9, value=exact(wrong_sign),
          because="a gas at rest is stable: no wave grows, to round-off",
          statement="fluctuations that obey Eq. 21 as printed stay small: growth rate of a wave of 16 spacings in c/a; its "
                    "sign is wrong, and all sound grows"),
    Claim(id="rr98-fluct-eq21-bracket", source="RR98 Eqs 10, 21", at_most=1e-9, value=growth,
          because="a gas at rest is stable: no wave grows, to round-off",
          statement="with the right sign fluctuations about rest stay small on any points: largest growth rate in c/a, plain "
                    "quadrature on points jittered by 0.3 a"),
    Claim(id="rr98-fluct-eq22-momentum", source="RR98 Eq. 22", printed="symmetric", at_most=1e-12, value=worst("sums", MOMENTA),
          because=ROUND_OFF,
          statement="random stresses change no total momentum: largest sum over points, all makers and point sets, 1 to 3 "
                    "dimensions"),
    Claim(id="rr98-fluct-eq22-uniform", source="RR98 Eq. 22", at_most=1e-12, value=worst("uniform", EXACT), because=ROUND_OFF,
          statement="the dissipation beside them does not see uniform motion or temperature: largest force, all makers and "
                    "points"),
    Claim(id="own-fluct-partners", source="RR98 Eqs 22-25", at_most=1e-12, value=worst("mismatch", EXACT), because=ROUND_OFF,
          statement="one random stress and heat current a point, or noise along edges, or a mixture: largest |Q - 2 kT Gamma|, "
                    "all makers, points and dimensions, coefficients that vary by factors of five"),
    Claim(id="own-fluct-partners-moving", source="RR98 Eqs 22-25, 45-48", at_most=1e-12, because=ROUND_OFF,
          value=worst("mismatch", EXACT, maker="moving"),
          statement="these are partners on the faces between moving points, too, at any moment: largest |Q - 2 kT Gamma|, "
                    "coefficients that vary by factors of five, before and after 20 steps"),
    Claim(id="own-fluct-symmetric", source="RR98 Eqs 22-25", at_most=1e-12, value=worst("asymmetry", EXACT), because=ROUND_OFF,
          statement="the dissipations that have such partners are symmetric: largest |Gamma - Gamma^T|, all makers and points"),
    Claim(id="rr98-fluct-eq23-single", source="RR98 Eq. 23", printed="usual fluctuation-dissipation", **RIGHT,
          value=longest("23", "zeta", "single"),
          statement="Eq. 23, added once (Eq. 22), with the volume it lacks, gives long waves the right temperature: variance "
                    "over its due, zeta term, a line of nearest neighbours"),
    Claim(id="rr98-fluct-eq23-doubled", source="RR98 Eq. 23", printed="usual fluctuation-dissipation", **RIGHT,
          value=longest("23", "zeta", "doubled"),
          statement="Eq. 23, added as pi_ij + pi_ji, with the volume it lacks, gives long waves the right temperature: "
                    "variance over its due, zeta term, a line of nearest neighbours"),
    Claim(id="rr98-fluct-eq23-neighbours", source="RR98 Eq. 23", printed="usual fluctuation-dissipation", **RIGHT,
          value=longest("23", "zeta", "doubled", 2, 3.0),
          statement="Eq. 23 does so whatever the reach of the weight, added as pi_ij + pi_ji: variance over its due, 2D, h = 3 "
                    "a"),
    Claim(id="rr98-fluct-eq23-integral-2d", source="RR98 Eqs 23, 31", at_most=1.01, value=exact(lambda: integral(2)),
          because="a convergent integral has lost 1 % at most below a hundredth of r0",
          statement="the force's variance, int W^2 r^2 dr for long waves, exists for the weight of Eq. 31 in 2D: cut at 1e-4 "
                    "r0 over cut at 1e-2 r0"),
    Claim(id="rr98-fluct-eq23-integral-3d", source="RR98 Eqs 23, 31", at_most=1.01, value=exact(lambda: integral(3)),
          because="a convergent integral has lost 1 % at most below a hundredth of r0",
          statement="the force's variance, int W^2 r^2 dr for long waves, exists for the weight of Eq. 31 in 3D: cut at 1e-4 "
                    "r0 over cut at 1e-2 r0"),
    Claim(id="rr98-fluct-eq23-inner-k", source="RR98 Eq. 23", expect=0, within=1e-9, value=exact(inner_k),
          because="arithmetic",
          statement="without bulk viscosity Eq. 23's tensor has no trace: variance of the trace over that of a shear stress in "
                    "units where k = 1/2, 3D; an inner k is left over"),
    Claim(id="rr98-fluct-eq24-energy", source="RR98 Eq. 24", printed="symmetric", at_most=1e-12, value=worst("sums", ENERGIES),
          because=ROUND_OFF,
          statement="random heat currents change no total energy: largest sum over points, all makers and point sets"),
    Claim(id="rr98-fluct-eq24-drift", source="RR98 Eqs 22, 24", at_most=1e-11, value=drift,
          because="1e5 steps, each with the round-off of its sums, 1e-16, all of one sign",
          statement="mass, momentum and energy stay in the full equations with noise: largest change over the energy"),
    Claim(id="rr98-fluct-eq25-single", source="RR98 Eq. 25", **RIGHT, value=longest("25", "kappa", "single"),
          statement="Eq. 25, added once (Eq. 24), with the volume it lacks, gives long waves the right fluctuation of energy: "
                    "variance over its due, a line of nearest neighbours"),
    Claim(id="rr98-fluct-eq25-doubled", source="RR98 Eq. 25", **RIGHT, value=longest("25", "kappa", "doubled"),
          statement="Eq. 25, added as J_ij + J_ji, with the volume it lacks, gives long waves the right fluctuation of energy: "
                    "variance over its due, a line of nearest neighbours"),
    Claim(id="rr98-fluct-eq25-gradient", source="RR98 Eqs 20-25", expect=1, within=0.01, value=gradient_ratio(strong=False),
          because="1 %: sound, which the closed form leaves out, is faster than diffusion by c/(nu k) = 70 and more",
          statement="temperature waves across a gradient are enhanced by what transverse velocities carry, (grad T)^2 <v v>/(D "
                    "(nu + D) k^4): Lyapunov over closed form, waves of 30 to 90 spacings, profile of one period"),
    Claim(id="own-fluct-gradient-strong", source="RR98 Eqs 20-25", expect=1, within=0.01, value=gradient_ratio(strong=True),
          because="1 %, as for all waves; chosen after those: other effects seem to add some contrast^2",
          statement="the same of waves that are enhanced by 500 contrast^2 and more"),
    Claim(id="rr98-fluct-eq25-fourth-power", source="RR98 Eqs 20-25", expect=-4, within=0.05, value=gradient_slope(strong=False),
          because="0.05: of two per cent over a factor of two in k",
          statement="the enhancement falls as k^-4: power from waves of 30 to 60 spacings, what the period takes from it divided "
                    "out"),
    Claim(id="own-fluct-fourth-power-strong", source="RR98 Eqs 20-25", expect=-4, within=0.05, value=gradient_slope(strong=True),
          because="0.05, as for all waves; chosen after those",
          statement="the same of waves that are enhanced by 500 contrast^2 and more, shorter than the period"),
    Claim(id="rr98-fluct-eq25-onset", source="RR98 Eqs 20-25", printed="the flow is stable", expect=-1, within=0.02,
          value=onset_power, because="0.02: other modes add a constant, of 1 % at 0.05 below onset",
          statement="fluctuations of a layer heated from below grow as 1/(Ra_c - Ra) on the way to onset, Ra_c by eigenvalues: "
                    "power of 1 - Ra/Ra_c in <w w> less equilibrium, 0.005 to 0.05"),
    Claim(id="own-fluct-onset-nearest", source="RR98 Eqs 20-25", expect=-1, within=0.02, value=onset_nearest,
          because="0.02, as for all; chosen after these: the next term of the slow mode's rate is worth 1 % at 0.01 below",
          statement="the same from the two values nearest to onset"),
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
    Claim(id="rr98-fluct-equipartition", source="RR98 Eqs 22, 24", expect=1, within=0.005, value=total,
          because="half a per cent: the size that an experiment resolves",
          statement="sampled, all degrees of freedom of a gas at rest together have their variance: mean ratio, jittered "
                    "points"),
    Claim(id="rr98-fluct-equipartition-rms", source="RR98 Eqs 22, 24", expect=1.057, within=0.35, value=rms_z,
          because="sqrt(19/17), the rms of t with 19 degrees of freedom; 0.35 is three standard deviations of 80 modes and "
                  "their error",
          statement="single modes scatter about their variance as their error bars say: rms of deviations over standard errors"),
    Claim(id="rr98-fluct-equipartition-worst", source="RR98 Eqs 22, 24", at_most=1, value=largest_z,
          because="Bonferroni: all modes keep the bound in 95 % of all cases",
          statement="no single mode is off: largest deviation over the bound for that many modes"),
    Claim(id="rr98-fluct-structure", source="RR98 Eqs 20-25", expect=1, within=0.03, value=structure,
          because="3 %: what samples reach",
          statement="the static structure factor is flat, S(k) = kT/(m c_T^2): mean over sampled density waves on jittered "
                    "points"),
    Claim(id="rr98-fluct-brillouin-position", source="RR98 Eqs 20-25", expect=1, within=0.005, value=peak("position"),
          because="half a per cent: the size that an experiment resolves",
          statement="the Brillouin peak of sampled density waves lies where the lattice symbol has sound: ratio, waves of 8 "
                    "spacings"),
    Claim(id="rr98-fluct-brillouin-width", source="RR98 Eqs 20-25", expect=1, within=0.03, value=peak("half width"),
          because="3 %: the size that an experiment resolves",
          statement="its half width is the symbol's damping of sound: ratio, waves of 8 spacings"),
    Claim(id="rr98-fluct-spectrum", source="RR98 Eqs 20-25", expect=1, within=0.02, value=spectrum,
          because="2 %: what samples reach; positions and widths of peaks do not depend on the size of the noise, this does; a "
                  "reading of a table that was there",
          statement="the whole spectrum of sampled density waves, heights of the Rayleigh and Brillouin peaks included, is that "
                    "of the lattice symbols: mean ratio over bins of frequency up to twice the peak, farthest from 1 of three "
                    "waves"),
    Claim(id="rr98-fluct-rayleigh-width", source="RR98 Eqs 20-25", expect=1, within=0.05, value=peak("Rayleigh half width"),
          because="5 %: what samples reach",
          statement="the half width of the Rayleigh peak of sampled density waves is the symbol's decay of heat: ratio, waves "
                    "of 8 spacings"),
)
