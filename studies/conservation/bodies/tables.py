"""Tables of the study bodies. Lengths in spacings a, fluid of KHP95's units (rho = T = 1); `_err` 95 %.

No start and no set of points has chance in it: `shear`, `wave`, `walls` and `torque` have no error but that of time steps.
"""
from studies.kit.table import Table

DRAGS = ["variant", "fraction", "rows"]
#: F/(eta U) of a cylinder in a square array; drag_err: what still changed; published, error: against print, relative;
#: balance: force that edges carry to the body over that which drives the fluid, less 1; offset: how far the radius that the drag
#: tells lies outside of the true one
DRAG = Table("drag", key=[*DRAGS, "reynolds"],
             columns=[*DRAGS, "radius", "points", "drag", "drag_err", "published", "published_err", "error", "error_err",
                      "balance", "offset", "reynolds", "mach", "density_range", "dt", "steps"])
#: extrapolated to infinitely fine points by a line in rows^-2 (points on the surface) or 1/rows (staircases), error from the
#: scatter about it; error: against print; slope: d ln |error|/d ln rows; offset: mean over sizes
LIMITS = Table("drag_limits", key=["variant", "fraction"],
               columns=["variant", "fraction", "sizes", "limit", "limit_err", "error", "error_err", "slope", "slope_err",
                        "offset", "offset_err"])
#: points and velocities of one stream, in units of the mean velocity; held: 1 for points of the body
FIELD = Table("field", key=["variant", "fraction", "rows", "point"],
              columns=["variant", "fraction", "rows", "point", "x", "y", "u", "v", "held"])
#: homogeneous shear: between sliding sides, and between rows of fixed points that move. Errors: of stress and heating relative to
#: eta rate and eta rate^2, of the profile relative to the difference of speeds; drifts relative to mass, and to mass times speed
SHEAR = Table("shear", key=["kind", "rows"],
              columns=["kind", "rows", "stress", "heating", "profile", "mass_drift", "momentum_drift", "slid", "steps"])
#: a wave that the shear turns, between sliding sides: relative rms error of the velocity without divergence, and what has one
WAVE = Table("wave", key=["rows"], columns=["rows", "error", "divergent", "mach", "mass_drift", "slid", "steps"])
#: flow driven between fixed rows: where its parabola reaches zero, in spacings behind the plate, which is half a spacing before
#: the first row; error of the mean velocity against that between such plates, and against that between plates on the first rows
WALLS = Table("walls", key=["maker", "h", "rows"],
              columns=["maker", "h", "rows", "offset", "error_plate", "error_row", "bend", "steady"])
#: a cylinder that turns inside of one at rest: errors of the torques on both, relative to the exact one; balance: their sum over
#: it; profile: largest error of the velocity over that of the cylinder
TORQUE = Table("torque", key=["rows"], columns=["rows", "radius", "turned", "fixed", "balance", "profile", "steps"])
#: slopes of errors over sizes
ORDERS = Table("body_orders", key=["what"], columns=["what", "sizes", "order", "order_err"])

ALL = (DRAG, LIMITS, FIELD, SHEAR, WAVE, WALLS, TORQUE, ORDERS)
