"""What RR98 says of fluctuations about a given flow, judged    [RR98 Eqs 20-25]"""
from typing import Any

from studies.build.read import exact
from studies.kit.claim import Claim
from studies.noise.fluctuations.arithmetic import inner_k, integral, wrong_sign
from studies.noise.fluctuations.read import (
    ENERGIES,
    EXACT,
    MOMENTA,
    at_rest,
    drift,
    gradient_ratio,
    gradient_slope,
    growth,
    largest_z,
    longest,
    nonlinear,
    onset_nearest,
    onset_power,
    peak,
    rms_z,
    structure,
    total,
    worst,
)
from studies.noise.fluctuations.read_flows import spectrum

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
