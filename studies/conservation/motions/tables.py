"""Tables of the study motions. Spacing a = 1, rho = T = 1 at rest, ideal gas with gamma = 2: c^2 = 2; `_err` see each case."""
from studies.kit.table import Table

#: speed of a pattern on a uniform stream, over the stream's; predicted: by sums over the lattice; smoothed: f^(k) of the weight
PATTERNS = Table("patterns", key=["motion", "pattern", "h", "wavelength"],
                 columns=["motion", "pattern", "h", "wavelength", "speed", "speed_err", "predicted", "smoothed"])
#: sound over c; gradient: wave number seen on the lattice, over k; stiffness: of a lattice moved
SOUND = Table("moving_sound", key=["motion", "bracket", "weight", "h", "wavelength"],
              columns=["motion", "bracket", "weight", "h", "wavelength", "speed", "speed_err", "predicted", "gradient",
                       "stiffness"])
#: growth rate of sound on fixed points with forward Euler
EULER = Table("euler", key=["transport", "wavelength", "dt_over_limit"],
              columns=["transport", "wavelength", "dt_over_limit", "growth", "growth_err", "predicted"])
#: the step at which sound neither grows nor decays, over (eta + zeta + kappa/2)/(rho c^2)
LIMITS = Table("euler_limits", key=["transport", "wavelength"], columns=["transport", "wavelength", "limit", "limit_err"])
#: amplitude of sound in time, of fixed points with forward Euler
HISTORY = Table("history", key=["dt_over_limit", "time"], columns=["dt_over_limit", "time", "amplitude", "predicted"])
#: rms error of positions after a fixed time over the rms displacement
STEPS = Table("steps", key=["motion", "flow", "integrator", "steps"],
              columns=["motion", "flow", "integrator", "steps", "dt", "error", "error_err"])
#: order in dt between the two finest steps, and error over that of the integrator "euler"
ORDERS = Table("motion_orders", key=["motion", "flow", "integrator"],
               columns=["motion", "flow", "integrator", "order", "order_err", "over_euler", "over_euler_err"])
#: growth of sound without viscosity over dt omega^2/2, literal motion
SHARES = Table("shares", key=["integrator", "dt"], columns=["integrator", "dt", "share", "share_err", "predicted"])
#: largest difference of accelerations from Eq. 49, over the largest acceleration; one set of random fields: `convective` is
#: round-off whatever they are, `literal` is a number of this set
IDENTITY = Table("identity", key=["transport", "reynolds"], columns=["transport", "reynolds", "convective", "literal"])
#: v.grad as Eqs 46-48 add it, over the exact one; sums over a lattice, without chance
SIGNS = Table("signs", key=["equation", "wavelength"], columns=["equation", "wavelength", "factor", "predicted"])
#: force of Eq. 50 in a wave without entropy, over -grad P, without chance; what a unit of mass a third as large multiplies
#: accelerations by, and what of them this leaves: round-off, whatever the random fields are
BRACKETS = Table("brackets", key=["a", "b"],
                 columns=["a", "b", "force", "predicted", "unit", "unit_left", "unit_predicted"])
#: largest drift over the run: of mass and energy over the total, of momentum over sum |p_i|; one run each, no fields at random,
#: points jittered once: round-off where sums are kept
CONSERVATION = Table("conservation", key=["motion", "edges", "weight", "points", "integrator", "filter", "quantity"],
                     columns=["motion", "edges", "weight", "points", "integrator", "filter", "steps", "dt", "quantity", "drift"])
#: decay rate of a density wave, or of density that alternates from point to point, over chi
FILTER = Table("filter", key=["filter", "h", "mode"],
               columns=["filter", "h", "mode", "k", "rate", "rate_err", "predicted", "lost"])

ALL = (PATTERNS, SOUND, EULER, LIMITS, HISTORY, STEPS, ORDERS, SHARES, IDENTITY, SIGNS, BRACKETS, CONSERVATION, FILTER)
