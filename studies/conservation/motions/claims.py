"""What RR98 says of points that move, judged    [RR98 Eqs 39-41, 46-50]"""
from math import sqrt

from studies.build.read import exact
from studies.conservation.motions.read import (
    against_damping,
    any_drift,
    cell,
    drift,
    fourth,
    inconsistent,
    largest,
    long_sound,
    off_law,
    off_unit,
    over,
    pattern_over_prediction,
    sound_of_bracket,
    spread_of_limits,
)
from studies.conservation.motions.still import not_moved
from studies.kit.claim import Claim

HALVES = "its error is what the two halves of the run differ by"
ALONE = "computed once, by sums in a fixed order: no statistics"
JITTERED = {"points": "jittered-0.1", "integrator": "RK4"}
PATTERN = {"pattern": "density", "wavelength": 32}
CLAIMS = (
    Claim(id="rr98-eq39-pattern", source="RR98 Secs I, III", printed="fully consistent; a bold assumption", expect=1, within=0.02,
          value=cell("patterns", "speed", motion="literal", **PATTERN),
          statement="points that move with v under Eqs 34-36 show the fluid: speed of a density pattern over that of the "
                    "stream that carries it, wavelength 32 a",
          because=f"2 %: what a weight of h = 3 a does to such a wave; {HALVES}"),
    Claim(id="rr98-eq39-twice", source="RR98 Eqs 34-36, 39", expect=1, within=1e-3, value=pattern_over_prediction,
          statement="literal motion counts convection twice: speed of the pattern over (1 + f^) times the stream's, wavelength "
                    "16 a", because=f"sums over a lattice are integrals to 2e-4 of f^ at h = 3 a; {HALVES}"),
    Claim(id="rr98-eq39-sound", source="RR98 Eq. 39", printed="fully consistent", expect=1, within=0.02,
          value=long_sound("literal"),
          statement="points that move with v under Eqs 34-36: speed of long sound over c, Wendland C2, h = 4 a",
          because="2 %: extrapolated from wavelengths of 24 and 32 a; the error is the difference from 16 and 24 a"),
    Claim(id="rr98-eq39-sound-factor", source="RR98 Eqs 34-36, 39", expect=sqrt(2), within=0.01, value=long_sound("literal"),
          statement="volumes dV that stay while points move add 2 P grad(n dV) to the force: long sound of the literal motion "
                    "is sqrt(1 + 2/gamma) c, Wendland C2, h = 4 a",
          because="1 %: 0.3 % from sums over the lattice, and the next order in h/lambda; the error is the difference of two "
                  "extrapolations"),
    Claim(id="rr98-eq39-sound-factor-lucy", source="RR98 Eqs 34-36, 39", expect=sqrt(2), within=0.01,
          value=long_sound("literal", "Lucy"),
          statement="the factor of long sound in literal motion, sqrt(1 + 2/gamma), with Lucy's weight, h = 3 a",
          because="1 %, as for Wendland's; what the lattice sums of w'' miss stays however long the wave is"),
    Claim(id="rr98-eq39-sound-lattice", source="RR98 Eqs 34-36, 39", expect=1, within=1e-4,
          value=over("moving_sound", "speed", "predicted", motion="literal", bracket="none", weight="Lucy", wavelength=32),
          statement="the same factor from sums over the lattice: speed over sqrt(f^2 + 2 g/gamma), f of the gradient, g of "
                    "moved points, wavelength 32 a",
          because=f"neighbours at r = h, where w has a jump in its third derivative, leave 1e-5; {HALVES}"),
    Claim(id="rr98-eq39-convective", source="RR98 Eqs 39, 46", expect=1, within=1e-6,
          value=cell("patterns", "speed", motion="convective", **PATTERN),
          statement="dr/dt = v with Eqs 46-48: speed of a density pattern over that of the stream that carries it, wavelength "
                    "32 a", because=f"the square of the amplitude is 1e-8; {HALVES}"),
    Claim(id="rr98-eq39-conserves", source="RR98 Eqs 34-36, 39", printed="conserved", at_most=1e-13,
          value=any_drift(motion="literal"),
          statement="mass, momentum and energy stay while points move literally: largest relative drift over 1e4 steps, all "
                    "weights, both integrators", because="round-off: 1e4 steps of some 1e-17 each, in a random walk"),
    Claim(id="rr98-eq40-stability", source="RR98 Eq. 40", at_most=0,
          value=against_damping,
          statement="steps of Eq. 40 grow only where the flow is unstable: growth of sound in a gas at rest over its damping, "
                    "dt 1.5 (eta + zeta + kappa/2)/(rho c^2), wavelength 32 a", because=f"a gas at rest is stable; {HALVES}"),
    Claim(id="rr98-eq40-limit", source="RR98 Eq. 40", expect=1, within=0.01,
          value=cell("euler_limits", "limit", transport="nested", wavelength=32),
          statement="forward Euler is stable below dt = (eta + zeta + kappa/2)/(rho c^2), 2D gas: measured limit over that, "
                    "nested transport, wavelength 32 a",
          because="1 %: (D k/c)^2, left out of the formula, is 8e-4; the error is that of the growth rates"),
    Claim(id="rr98-eq40-limit-k", source="RR98 Eq. 40", at_most=0.01, value=spread_of_limits,
          statement="the limit does not depend on k: spread over wavelengths of 16 to 64 a, nested transport",
          because="1 %: (D k/c)^2 is 3e-3 at a wavelength of 16 a"),
    Claim(id="rr98-eq40-order", source="RR98 Eq. 40", expect=1, within=0.02,
          value=cell("motion_orders", "order", motion="constant-mass", flow="vortices", integrator="euler"),
          statement="differences of Eq. 40 are of first order in dt: order of the error of positions, vortices at constant "
                    "mass", because="the next term is 0.5 % of the first at these steps; the reference is RK4"),
    Claim(id="rr98-eq41-accuracy", source="RR98 Eq. 41", printed="more accurate", at_most=1,
          value=cell("motion_orders", "over_euler", motion="literal", flow="sound", integrator="two-step"),
          statement="positions with new velocities are more accurate: their error over that with old ones, sound in literal "
                    "motion", because="smaller than one is more accurate; the reference is RK4"),
    Claim(id="rr98-eq41-accuracy-mass", source="RR98 Eq. 41", printed="more accurate", at_most=1,
          value=cell("motion_orders", "over_euler", motion="constant-mass", flow="sound", integrator="two-step"),
          statement="positions with new velocities are more accurate: their error over that with old ones, sound at constant "
                    "mass", because="smaller than one is more accurate; the reference is RK4"),
    Claim(id="rr98-eq41-accuracy-vortices", source="RR98 Eq. 41", printed="more accurate", at_most=1,
          value=cell("motion_orders", "over_euler", motion="constant-mass", flow="vortices", integrator="two-step"),
          statement="positions with new velocities are more accurate: their error over that with old ones, decaying vortices "
                    "at constant mass", because="smaller than one is more accurate; the reference is RK4"),
    Claim(id="rr98-eq41-order", source="RR98 Eq. 41", at_least=1.5,
          value=cell("motion_orders", "order", motion="constant-mass", flow="vortices", integrator="two-step"),
          statement="new velocities make positions more accurate by an order in dt: their order, vortices at constant mass",
          because="between first and second order; the next term is 0.5 % of the first; the reference is RK4"),
    Claim(id="rr98-eq41-share", source="RR98 Eq. 41", expect=1, within=0.01,
          value=over("shares", "share", "predicted", integrator="two-step", dt=0.05),
          statement="Eq. 41 takes from the growth of sound by Eq. 40 what positions carry of omega^2: growth over that "
                    "prediction, literal motion", because=f"1 %: (omega dt)^2 is 1e-3; {HALVES}"),
    Claim(id="rr98-eq41-fixed", source="RR98 Eq. 41", at_most=1e-13, value=exact(not_moved),
          statement="Eq. 41 concerns points that move only: largest difference of fields after 20 steps of Eqs 40 and 41, by "
                    "the scheme of moving points with velocities of positions set to zero, and of Eq. 40 alone on fixed points",
          because="round-off of 20 steps; edges are made twenty times, and once"),
    Claim(id="rr98-eq46-sign", source="RR98 Eq. 46", printed="-", expect=1, within=0.02,
          value=cell("signs", "factor", equation="46", wavelength=32),
          statement="what is added to the change of mass is v.grad of it: over the exact one, lattice, wavelength 32 a",
          because=f"2 %: a weight of h = 3 a takes 1.5 % off the gradient of such a wave; {ALONE}"),
    Claim(id="rr98-eq47-sign", source="RR98 Eq. 47", printed="-", expect=1, within=0.02,
          value=cell("signs", "factor", equation="47", wavelength=32),
          statement="what is added to the change of momentum is v.grad of it: over the exact one, lattice, wavelength 32 a",
          because=f"2 %: a weight of h = 3 a takes 1.5 % off the gradient of such a wave; {ALONE}"),
    Claim(id="rr98-eq48-sign", source="RR98 Eq. 48", printed="-", expect=1, within=0.02,
          value=cell("signs", "factor", equation="48", wavelength=32),
          statement="what is added to the change of energy is v.grad of it: over the exact one, lattice, wavelength 32 a",
          because=f"2 %: a weight of h = 3 a takes 1.5 % off the gradient of such a wave; {ALONE}"),
    Claim(id="rr98-eq47-speed", source="RR98 Eqs 39, 47", expect=1, within=1e-5,
          value=cell("patterns", "speed", motion="convective", pattern="shear", wavelength=32),
          statement="with Eq. 47 a pattern of velocity across the stream goes with it: speed over the stream's, wavelength 32 "
                    "a", because=f"the square of the amplitude is 1e-8; {HALVES}"),
    Claim(id="rr98-eq46-conserves", source="RR98 Eq. 46", at_most=1e-12,
          value=drift("mass", motion="convective", **JITTERED),
          statement="mass is conserved with Eq. 46: largest relative drift in 1e4 steps, stirred gas, jittered points",
          because=f"what is exchanged is not symmetric in i and j, so that more than round-off is lost; {ALONE}"),
    Claim(id="rr98-eq47-conserves", source="RR98 Eq. 47", at_most=1e-12,
          value=drift("momentum", motion="convective", **JITTERED),
          statement="momentum is conserved with Eq. 47: largest drift in 1e4 steps over sum |p_i|, stirred gas, jittered "
                    "points",
          because=f"what is exchanged is not symmetric in i and j, so that more than round-off is lost; {ALONE}"),
    Claim(id="rr98-eq48-conserves", source="RR98 Eq. 48", at_most=1e-12,
          value=drift("energy", motion="convective", **JITTERED),
          statement="energy is conserved with Eq. 48: largest relative drift in 1e4 steps, stirred gas, jittered points",
          because=f"what is exchanged is not symmetric in i and j, so that more than round-off is lost; {ALONE}"),
    Claim(id="rr98-eq46-carried", source="RR98 Eqs 46-48", at_most=1e-6, value=any_drift(motion="carried", **JITTERED),
          statement="Eqs 46-48 on volumes that grow with div v lose nothing but the error of time steps: largest relative "
                    "drift of mass, momentum, energy in 1e4 steps",
          because=f"RK4 at omega dt = 0.3: (omega dt)^5 times the amplitudes squared, some 100 steps long; {ALONE}"),
    Claim(id="rr98-eq46-sound", source="RR98 Eqs 46-48", printed="fully consistent", expect=1, within=0.02,
          value=long_sound("convective"),
          statement="Eqs 39, 46-48 on volumes dV that stay: speed of long sound over c, Wendland C2, h = 4 a",
          because="2 %: extrapolated from wavelengths of 24 and 32 a; the error is the difference from 16 and 24 a"),
    Claim(id="rr98-eq49-identity", source="RR98 Eq. 49", printed="can be written", at_most=1e-12,
          value=largest("identity", "convective"),
          statement="Eqs 34, 35, 46, 47 with p = m v are Eq. 49: largest difference of accelerations over the largest, random "
                    "fields on jittered points, all Reynolds numbers", because=f"round-off of some 30 terms; {ALONE}"),
    Claim(id="rr98-eq49-reynolds", source="RR98 after Eq. 48", printed="not too large Reynolds numbers", at_least=0.01,
          value=largest("identity", "convective", reynolds=float("inf")),
          statement="Eq. 49 leaves out what Eqs 46-48 bring at large Reynolds numbers: difference of accelerations over the "
                    "largest, without viscosity", because=f"a per cent would limit its use; {ALONE}"),
    Claim(id="rr98-eq49-sound", source="RR98 Eq. 49", expect=1, within=0.01, value=long_sound("constant-mass"),
          statement="constant mass, volumes that follow the flow: speed of long sound over c, Wendland C2, h = 4 a",
          because="1 %: 0.5 % from sums over the lattice, and the next order in h/lambda; the error is the difference of two "
                  "extrapolations"),
    Claim(id="rr98-eq49-sound-lucy", source="RR98 Eq. 49", expect=1, within=0.01, value=long_sound("constant-mass", "Lucy"),
          statement="constant mass, volumes that follow the flow: speed of long sound over c, Lucy's weight, h = 3 a",
          because="1 %, as for Wendland's; what the lattice sums of w'' miss stays however long the wave is; the error is the "
                  "difference of two extrapolations"),
    Claim(id="rr98-eq49-conserves", source="RR98 Eq. 49", at_most=1e-13, value=any_drift(motion="constant-mass"),
          statement="constant mass: largest relative drift of mass, momentum, energy over 1e4 steps",
          because="round-off: 1e4 steps of some 1e-17 each, in a random walk"),
    Claim(id="rr98-eq50-sum-zero", source="RR98 Eq. 50", expect=1, within=0.02, value=cell("brackets", "force", a=1.0, b=-1.0),
          statement="a = 1, b = -1, smoothed particles with their own masses: force over -grad P, wave without entropy of 32 a",
          because=f"2 %: a weight of h = 3 a takes 1.5 % off the gradient of such a wave; {ALONE}"),
    Claim(id="rr98-eq50-any", source="RR98 Eq. 50", at_most=0.02, value=inconsistent,
          statement="any constants a and b make Eq. 49 the momentum equation where volumes follow the flow: largest error of the "
                    "force over -grad P for a + b other than 0",
          because=f"2 %: a weight of h = 3 a takes 1.5 % off the gradient of such a wave; {ALONE}"),
    Claim(id="rr98-eq50-law", source="RR98 Eq. 50", at_most=1e-6, value=off_law,
          statement="the force of Eq. 50 is -grad(P/rho^(a+b)), so f^ (1 - (a + b)/gamma) of -grad P without entropy: largest "
                    "difference", because=f"the square of the amplitude is 1e-8; {ALONE}"),
    Claim(id="rr98-eq50-unit", source="RR98 Eq. 50", at_most=1e-12, value=off_unit,
          statement="a unit of mass a third as large multiplies accelerations by 3^-(a + b), so that they depend on it unless a "
                    "+ b = 0: largest relative difference from that, eight pairs (a, b), random fields on jittered points, and "
                    "what a factor leaves of them", because="round-off of sums of 30 terms"),
    Claim(id="rr98-eq50-sound", source="RR98 Eq. 50", expect=1, within=0.02, value=sound_of_bracket,
          statement="the speed of sound does not depend on a and b: c^2 with a + b = 1 over c^2 with a + b = 0, wavelength 16 "
                    "a", because=f"2 %; (gamma - 1)/gamma = 1/2 follows from the force; {HALVES}"),
    Claim(id="rr98-eq34-null", source="RR98 Eq. 34", at_least=1,
          value=cell("filter", "rate", filter="none", mode="corner", h=3.0),
          statement="density that alternates from point to point decays: rate over 0.1 a c without a filter, h = 3 a",
          because=f"1/a^2 would do; no gradient sees such a wave; {HALVES}"),
    Claim(id="rr98-eq34-filter", source="RR98 Eq. 34", at_least=1,
          value=cell("filter", "rate", filter="plain", mode="corner", h=3.0),
          statement="a conservative filter removes density that alternates from point to point: decay rate over chi, h = 3 a",
          because=f"1/a^2 would do: gone in 10 crossings of a spacing by sound; {HALVES}"),
    Claim(id="rr98-eq34-filter-wide", source="RR98 Eq. 34", at_least=1,
          value=cell("filter", "rate", filter="corrected", mode="corner", h=4.0),
          statement="the corrected filter removes density that alternates from point to point: decay rate over chi, h = 4 a",
          because=f"1/a^2 would do: gone in 10 crossings of a spacing by sound; {HALVES}"),
    Claim(id="rr98-eq34-filter-cost", source="RR98 Eq. 34", at_most=0.01,
          value=cell("filter", "lost", filter="plain", mode="wave 32", h=3.0),
          statement="the plain filter, chi = 0.1 a c, spares waves: share of a density wave of 32 a that is gone when sound "
                    "has crossed it", because="1 %: h = 3 a itself takes 1.5 % off the gradient of such a wave"),
    Claim(id="rr98-eq34-filter-corrected", source="RR98 Eq. 34", at_most=0.01,
          value=cell("filter", "lost", filter="corrected", mode="wave 32", h=3.0),
          statement="the corrected filter, chi = 0.1 a c, spares waves: share of a density wave of 32 a that is gone when "
                    "sound has crossed it", because="1 %: h = 3 a itself takes 1.5 % off the gradient of such a wave"),
    Claim(id="rr98-eq34-filter-order", source="RR98 Eq. 34", expect=4, within=0.1, value=fourth,
          statement="the corrected filter damps as k^4: slope between wavelengths of 32 and 64 a",
          because=f"0.1: the next order takes 0.03; {HALVES}"),
    Claim(id="rr98-eq34-filter-conserves", source="RR98 Eqs 34-36", at_most=1e-13, value=any_drift(filter=0.14),
          statement="the filter conserves: largest relative drift of mass, momentum, energy over 1e4 steps, literal motion",
          because="round-off: 1e4 steps of some 1e-17 each, in a random walk"),
)
