"""Tables of the study `onset`: growth rates, energies near onset, their straight lines, critical Rayleigh numbers.

Growth rates are of the velocity, per free-fall time; K in units of the scene as in `tables`. Every `err` is the half
width of a 95 % interval or, of a grid, the bound that its extrapolation gives. `dT` is over the mean temperature, 0 for
Boussinesq and for limits; `resolution` is rows per height, `inf` where extrapolated.
"""
from studies.kit.table import Table

POINT = ["method", "variant", "eos", "transport", "dT", "sides", "pr", "resolution"]
#: `way` is `operator` (from the linearised rates), `run` (a run in time from rolls of energy `ke_start`)
GROWTH = Table("growth_rates", key=[*POINT, "way", "ke_start", "seed", "ra"],
               columns=[*POINT, "way", "ke_start", "seed", "ra", "sigma", "err", "ke_end"])
#: steady K; `share` is 1 - sqrt(Ra_c/Ra) with the grid's own Ra_c; extrapolated rows have extrapolated ra and ke
ENERGIES = Table("energies", key=[*POINT, "share"], columns=[*POINT, "share", "ra", "ke", "rolls"])
#: K = slope Ra^-1/2 + intercept up to `reach` Ra_c; `residual` is the largest distance from it over the largest K
#: `lines` says how slope and intercept without a grid were found: from those of grids, or through extrapolated points ("")
LINES = Table("lines", key=[*POINT, "reach", "lines"],
              columns=[*POINT, "reach", "lines", "points", "slope", "intercept", "ra_c", "err", "residual"])
#: `quantity` alone tells rows of a method apart: the box, what differs from the ideal gas with constant eta and dT = 1,
#: and in brackets how it was found, extrapolated where no rows are named. The rest are the same in columns: `way` as in
#: growth_rates, or `eigenvalue` or `line`; `reach` is 0 but for lines, `ke_start` but for runs
CRITICAL = Table("critical_ra", key=["method", "quantity"],
                 columns=["method", "quantity", "value", "err", *POINT[1:], "way", "reach", "ke_start"])

ALL = (GROWTH, ENERGIES, LINES, CRITICAL)
