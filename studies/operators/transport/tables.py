"""Tables of the study transport. Lengths in spacings a, gas at rho = T = 1 with C_V = 1; `_err` 95 % half widths."""
from studies.kit.table import Table

SERIES = ["transport", "maker", "weight", "h", "points", "direction", "zeta"]
WAVE = [*SERIES, "quantity", "wavelength"]
#: each wave: measured, by the lattice symbol (nothing off a lattice), and of the continuum
WAVES = Table("waves", key=[*WAVE, "seed"], columns=[*WAVE, "seed", "measured", "measured_err", "lattice", "continuum"])
#: means over seeds; error: measured less continuum, over the continuum's (a bulk viscosity that is zero: over the shear
#: viscosity); from_lattice: measured less symbol, over the same
COEFFICIENTS = Table("coefficients", key=WAVE, columns=[*WAVE, "seeds", "measured", "measured_err", "lattice", "continuum",
                                                        "error", "error_err", "from_lattice"])
#: order: -d ln |error|/d ln wavelength, waves of 16 spacings and more; long: the error for endless waves, from error = long +
#: c/wavelength^2 + e/wavelength^4 through the three longest; its error, what the two longest without e say otherwise
ORDERS = Table("transport_orders", key=[*SERIES, "quantity"], columns=[*SERIES, "quantity", "order", "order_err", "long", "long_err"])

FLOW = ["flow", "points", "rows"]
#: velocity less series, rms and largest over points, in units of the plate's speed or of the final speed in the middle, at times
#: in height^2/nu; heating, compression, velocity across the plates: what the series neglect
SHEAR = Table("shear", key=[*FLOW, "seed", "time"], columns=[*FLOW, "seed", "time", "rms", "largest", "heating", "compression",
                                                             "across"])
SHEAR_MEANS = Table("shear_means", key=[*FLOW, "time"], columns=[*FLOW, "time", "seeds", "rms", "rms_err", "largest",
                                                                 "largest_err"])
#: order: -d ln error/d ln rows of all runs
SHEAR_ORDERS = Table("shear_orders", key=["flow", "points", "time", "norm"], columns=["flow", "points", "time", "norm", "order",
                                                                                      "order_err"])

ALL = (WAVES, COEFFICIENTS, ORDERS, SHEAR, SHEAR_MEANS, SHEAR_ORDERS)
