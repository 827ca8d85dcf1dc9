"""Tables of the study conservation.

Lengths in spacings a, gas at rho = T = 1, gamma = 2, so that c^2 = 2; `_err` 95 % half widths.
"""
from studies.kit.table import Table

RUN = ["scheme", "mode", "d", "maker", "weight", "h", "points", "wall", "zeta", "seed"]
SUMS = ["mass", "momentum", "energy", "volume"]
#: largest change of each sum: of mass, energy and volume over what they were, of momentum over the sum of its
#: sizes; err: round-off of the sums themselves; claimed: those that should stay; reached: steps until it
#: diverged or heated so much that sound outran its step, or all; motion: kinetic energy (of velocities less
#: their mean), end over start
DRIFT = Table("drift", key=RUN, columns=[*RUN, "n", "steps", "reached", "claimed", *SUMS, "err", "motion"])
#: lost: change of momentum over the sum of its sizes in so many steps, or when it was looked at last
#: (`reached`)
LOSSES = Table("losses", key=["maker", "points", "seed"],
               columns=["maker", "points", "seed", "steps", "reached", "lost"])

FRAME = ["mode", "maker", "points"]
#: rates in a wind less rates at rest, transformed and carried along: largest over points, over the largest
#: rate
FRAMES = Table("frames", key=[*FRAME, "seed"], columns=[*FRAME, "seed", *SUMS[:3]])
FRAME_MEANS = Table("frame_means", key=FRAME, columns=[
    *FRAME, "seeds", "mass", "mass_err", "momentum", "momentum_err", "energy", "energy_err"])
#: sound without friction, linear, in a box of one wavelength: growth is the fastest per period of that wave,
#: from eigenvalues; ln_energy is ln of the energy after so many periods over that at the start
SOUND_KEY = ["bracket", "maker", "points"]
SOUND = Table("sound", key=[*SOUND_KEY, "seed"],
              columns=[*SOUND_KEY, "seed", "periods", "growth", "growth_err", "ln_energy"])
SOUND_MEANS = Table("sound_means", key=SOUND_KEY, columns=[
    *SOUND_KEY, "seeds", "growth", "growth_err", "ln_energy", "ln_energy_err"])

#: speed of a density pattern on a stream, over the stream's; predicted: by sums over the lattice
PATTERN = ["motion", "h", "wavelength"]
PATTERNS = Table("patterns", key=PATTERN, columns=[*PATTERN, "speed", "speed_err", "predicted"])
#: sound over c; predicted: from the wave number seen on the lattice and the stiffness of a lattice moved
MOVED = ["motion", "weight", "h", "wavelength"]
MOVING_SOUND = Table("moving_sound", key=MOVED, columns=[*MOVED, "speed", "speed_err", "predicted"])
#: the same of long waves, extrapolated
LONG_SOUND = Table("long_sound", key=["motion", "weight"], columns=["motion", "weight", "speed", "speed_err"])
#: growth rate of sound on fixed points with forward Euler, nested friction
EULER = Table("euler", key=["wavelength", "dt_over_limit"],
              columns=["wavelength", "dt_over_limit", "growth", "growth_err", "predicted"])
#: the step at which sound neither grows nor decays, over (eta + zeta + kappa/2)/(rho c^2)
EULER_LIMITS = Table("euler_limits", key=["wavelength"], columns=["wavelength", "limit", "limit_err"])
#: rms error of positions after a fixed time over the rms displacement
PLACES = ["motion", "flow", "integrator", "steps"]
STEPS = Table("steps", key=PLACES, columns=[*PLACES, "dt", "error", "error_err"])
#: error with new velocities [Eq. 41] over that with old ones [Eq. 40], at the shortest step
ACCURACY = Table("accuracy", key=["motion", "flow"], columns=["motion", "flow", "ratio", "ratio_err"])
#: largest difference of accelerations of Eqs 46-48 from those of Eq. 49, over the largest, one set of random
#: fields
IDENTITY = Table("identity", key=["transport", "reynolds"], columns=["transport", "reynolds", "convective"])
#: v.grad as Eqs 46-48 add it, over the exact one; sums over a lattice, without chance
SIGNS = Table("signs", key=["equation", "wavelength"],
              columns=["equation", "wavelength", "factor", "predicted"])
#: force of Eq. 50 in a wave without entropy, over -grad P, without chance
BRACKETS = Table("brackets", key=["a", "b"], columns=["a", "b", "force", "predicted"])

DRAGS = ["variant", "fraction", "rows"]
#: F/(eta U) of a cylinder in a square array; drag_err: what still changed; published, error: against print,
#: relative; balance: force that edges carry to the body over that which drives the fluid, less 1
DRAG = Table("drag", key=[*DRAGS, "reynolds"], columns=[
    *DRAGS, "radius", "points", "drag", "drag_err", "published", "published_err", "error", "error_err",
    "balance", "reynolds", "mach", "density_range", "dt", "steps"])
#: extrapolated to infinitely fine points by a line in rows^-2 (points on the surface) or 1/rows (staircases),
#: error from the scatter about it; error: against print; slope: d ln |error|/d ln rows
DRAG_LIMITS = Table("drag_limits", key=["variant", "fraction"], columns=[
    "variant", "fraction", "sizes", "limit", "limit_err", "error", "error_err", "slope", "slope_err"])
#: homogeneous shear between sliding sides, errors: of stress and heating relative to eta rate and eta rate^2,
#: of the profile relative to the difference of speeds; drifts relative to mass, and to mass times speed
SHEAR = Table("shear", key=["rows"], columns=[
    "rows", "stress", "heating", "profile", "mass_drift", "momentum_drift", "slid", "steps"])
#: a wave that the shear turns: relative rms error of the velocity without divergence
WAVE = Table("wave", key=["rows"], columns=["rows", "error", "mach", "mass_drift", "slid", "steps"])
#: a cylinder that turns inside of one at rest: errors of the torques on both, relative to the exact one;
#: balance: their sum over it; profile: largest error of the velocity over that of the cylinder
TORQUE = Table("torque", key=["rows"],
               columns=["rows", "radius", "turned", "fixed", "balance", "profile", "steps"])

ALL = (DRIFT, LOSSES, FRAMES, FRAME_MEANS, SOUND, SOUND_MEANS, PATTERNS, MOVING_SOUND, LONG_SOUND, EULER,
       EULER_LIMITS, STEPS, ACCURACY, IDENTITY, SIGNS, BRACKETS, DRAG, DRAG_LIMITS, SHEAR, WAVE, TORQUE)
