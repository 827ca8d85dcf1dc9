"""Tables of the study onset.

Growth rates are of the velocity, per free-fall time; K in units of the scene. Every `err` is the half width
of a 95 % interval or, of a grid, the bound that its extrapolation gives. `dT` is over the mean temperature, 0
for Boussinesq and for limits; `resolution` is rows per height, `inf` where extrapolated.
"""
from studies.kit.table import Table

SERIES = "method variant eos transport dT sides pr"
POINT = f"{SERIES} resolution"
GROWTH = Table.of("growth_rates", f"{POINT} way ke_start seed ra", "sigma err",
                  about="The growth rate of rolls at one Ra.",
                  means={"err": ("half width of the 95 % interval of sigma; of an extrapolated grid a "
                                 "bound", "")})
ENERGIES = Table.of("energies", f"{POINT} share", "ra ke rolls",
                    about="A steady state of the grid; rows with resolution inf have Ra and K extrapolated.",
                    means={"share": ("1 - (Ra_c/Ra)^(1/2), Ra_c of the same grid", "")})
LINE_TABLE = Table.of("lines", f"{POINT} reach lines", "points slope intercept ra_c err residual",
                      about="A line K = slope Ra^-1/2 + intercept through energies up to `reach` Ra_c.",
                      means={"points": ("number of points in the fit", ""), "ra_c": ("Ra where the line is "
                                                                                     "0", ""),
                             "slope": ("slope of K over Ra^-1/2", "epsilon/m"),
                             "err": ("half width of the 95 % interval of ra_c", "")})
CRITICAL = Table.of("critical_ra", "method quantity",
                    "value err variant eos transport dT sides pr resolution way reach ke_start",
                    about="A critical Rayleigh number.",
                    means={"quantity": ("box, what differs from the ideal gas with constant eta and dT = 1, "
                                        "and in "
                                        "brackets how Ra_c was found: extrapolated where no rows are "
                                        "named", ""),
                           "value": ("critical Rayleigh number", "")})

ALL = (GROWTH, ENERGIES, LINE_TABLE, CRITICAL)
