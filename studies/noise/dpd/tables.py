"""Tables of the study dpd. Units: mass, rc and kT of one; `_err` 95 % half widths of what chance leaves."""
from studies.kit.table import Table
from studies.noise.dpd import cylinder as dpd_cylinder
from studies.noise.dpd import derive_surfaces as dpd_derive_surfaces
from studies.noise.dpd import friction as dpd_friction
from studies.noise.dpd import long as dpd_long
from studies.noise.dpd import surfaces as dpd_surfaces
from studies.noise.dpd import verlet as dpd_verlet

STATE = ["integrator", "noise", "d", "a", "kT", "rho", "side", "dt"]
#: steady states: kinetic and configurational kT, pressure, self-diffusion from the mean square displacement; drift: of the mean
#: velocity
STATES = Table("states", key=STATE, columns=[*STATE, "n", "time", "kinetic", "kinetic_err", "configurational",
                                             "configurational_err", "P", "P_err", "D", "D_err", "drift"])
#: shear between sliding sides: stress over rate
SHEAR = Table("dpd_shear", key=["integrator", "a", "rho", "side", "dt", "rate"],
              columns=["integrator", "a", "rho", "side", "dt", "rate", "n", "time", "stress", "stress_err", "viscosity",
                       "viscosity_err", "kinetic", "kinetic_err"])
#: structure factor over |n|^2, k = 2 pi |n|/side; errors from batches
STRUCTURE = Table("structure", key=["a", "rho", "side", "n2"], columns=["a", "rho", "side", "n2", "k", "S", "S_err", "batches"])
#: pair distribution in shells about r
PAIRS = Table("pairs", key=["a", "rho", "r"], columns=["a", "rho", "r", "g"])
#: kT/kT_0 - 1 = linear dt + quadratic dt^2 + cubic dt^3, least squares; order: d ln |error|/d ln dt of all steps whose error is
#: no chance, short_order of the three shortest of these; still, mixed: linear coefficients of forward friction, see `dpd_derive`
ERRORS = Table("errors", key=["integrator", "a", "temperature"],
               columns=["integrator", "a", "temperature", "still", "mixed", "steps", "linear", "linear_err", "quadratic",
                        "quadratic_err", "cubic", "cubic_err", "used", "order", "order_err", "short_order", "short_order_err"])
#: dP/drho at rho = 3 from a parabola through neighbours, S(0) by S = S(0) + c k^2 + e k^4, their product over kT
COMPRESSION = Table("compression", key=["a"], columns=["a", "slope", "slope_err", "S0", "S0_err", "product", "product_err"])
#: alpha = (P - rho kT)/(a rho^2)
EXCESS = Table("excess", key=["a", "kT", "rho"], columns=["a", "kT", "rho", "P", "P_err", "alpha", "alpha_err"])

ALL = (STATES, SHEAR, STRUCTURE, PAIRS, ERRORS, COMPRESSION, EXCESS, *dpd_verlet.ALL, *dpd_long.ALL, *dpd_friction.ALL,
       *dpd_cylinder.ALL, *dpd_surfaces.ALL, *dpd_derive_surfaces.ALL)
