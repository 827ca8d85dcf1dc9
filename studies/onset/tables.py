"""Tables of the study onset.

Growth rates are of the velocity, per free-fall time; K in units of the scene. Every `err` is the half width
of a 95 % interval or, of a grid, the bound that its extrapolation gives. `dT` is over the mean temperature, 0
for Boussinesq and for limits; `resolution` is rows per height, `inf` where extrapolated.
"""
from studies.kit.table import Table

SERIES = "method variant eos transport dT sides pr"
POINT = f"{SERIES} resolution"
#: `way` is `operator` (from the linearised rates), `run` (a run in time from rolls of energy `ke_start`)
GROWTH = Table.of("growth_rates", f"{POINT} way ke_start seed ra", "sigma err")
#: steady K; `share` is 1 - sqrt(Ra_c/Ra) with the grid's own Ra_c; extrapolated rows have both extrapolated
ENERGIES = Table.of("energies", f"{POINT} share", "ra ke rolls")
#: K = slope Ra^-1/2 + intercept up to `reach` Ra_c; `residual`: largest distance from it over the largest K
#: `lines`: where a line without a grid is from, the lines of grids or ("") extrapolated points
LINE_TABLE = Table.of("lines", f"{POINT} reach lines", "points slope intercept ra_c err residual")
#: `quantity` tells rows of a method apart: the box, what differs from the ideal gas with constant eta and
#: dT = 1, and in brackets how it was found, extrapolated where no rows are named. Other columns say the same:
#: `way` as in growth_rates, or `eigenvalue` or `line`; `reach` is 0 but for lines, `ke_start` but for runs
CRITICAL = Table.of("critical_ra", "method quantity",
                    "value err variant eos transport dT sides pr resolution way reach ke_start")

ALL = (GROWTH, ENERGIES, LINE_TABLE, CRITICAL)
