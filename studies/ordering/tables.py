"""Tables of the study ordering. Lengths in spacings; errors relative; `_err`: half of the 95 % interval."""
import numpy as np

from particles.integral.interpolants import moment
from particles.weights import Lucy
from studies.kit.table import Table

#: rms width of Lucy's weight in 2D, RR98's r0, over its range
WIDTH = float(np.sqrt(moment(Lucy.of(h=1.0, d=2), 3, 2)/4))

POINT = ["maker", "h", "points", "wavelength"]
#: rms errors of gradient and Laplacian of a plane wave; closure and linear: how far edges are from closed and
#: from linearly exact
OPERATORS = Table("operators", key=[*POINT, "seed"],
                  columns=[*POINT, "seed", "gradient", "laplacian", "closure", "linear"])
#: the same over seeds
MEANS = Table("means", key=POINT, columns=[
    *POINT, "seeds", "gradient", "gradient_err", "laplacian", "laplacian_err"])
SLOPE = ["maker", "points", "operator", "fixed", "at"]
#: d ln error/d ln(h/lambda); `fixed` says what stays as it is: h/a (finer points for a wave) or a (a wider
#: weight)
SLOPES = Table("slopes", key=SLOPE, columns=[*SLOPE, "slope", "slope_err", "floor"])

BRACKET_POINT = ["h", "points", "wavelength"]
#: rms errors of the gradient of a plane wave by plain quadrature: with f_j alone [Eq. 1], f_i + f_j [Eqs 14,
#: 34-36], f_j - f_i
BRACKETS = Table("brackets", key=[*BRACKET_POINT, "seed"], columns=[
    *BRACKET_POINT, "seed", "single", "sum", "difference"])
#: the same over seeds
BRACKET_MEANS = Table("bracket_means", key=[*BRACKET_POINT, "form"], columns=[
    *BRACKET_POINT, "form", "seeds", "error", "error_err"])
#: d ln error/d ln(h/lambda) at h = 3 a
BRACKET_SLOPES = Table("bracket_slopes", key=["points", "form"],
                       columns=["points", "form", "slope", "slope_err"])

#: a Taylor-Green vortex that has decayed by e: relative rms error of the velocity against the gas of its Mach
#: number, none where the run diverged; exchanges: over edges, of the whole run; h = 0: edges of no weight
VORTICES = Table("vortices", key=[*POINT, "seed"], columns=[*POINT, "seed", "velocity", "exchanges"])
LAYER = ["maker", "h", "points", "rows", "seed"]
#: Rayleigh-Benard at Ra 10 000, `rows` spacings high: K per mass and Nusselt number in the end
CONVECTION = Table("convection", key=LAYER, columns=[
    *LAYER, "ke", "ke_err", "nu", "nu_err", "rolls", "converged", "exchanges"])
#: K of the grid of study rb, extrapolated
REFERENCE = Table("reference", key=["flow"], columns=["flow", "ke", "ke_err"])
SERIES = ["flow", "maker", "h", "points"]
#: means over seeds of relative errors, with sign, of the velocity of vortices and of K of convection;
#: resolution: spacings to the wavelength or to the height; lost: seeds without a number
FLOWS = Table("flows", key=[*SERIES, "resolution"], columns=[
    *SERIES, "resolution", "seeds", "lost", "error", "error_err", "exchanges"])
FLOW_SLOPE = ["flow", "maker", "points", "fixed", "at"]
#: d ln |error|/d ln(a/lambda) at fixed h/a and d ln |error|/d ln h at fixed a, over all runs; `at`: that h or
#: resolution
FLOW_SLOPES = Table("flow_slopes", key=FLOW_SLOPE, columns=[*FLOW_SLOPE, "slope", "slope_err"])
#: least resolution from which on the error stays below 1 %, and exchanges there; bound = 1: the least that
#: was run; finest: the error at the highest one
CHEAPEST = Table("cheapest", key=SERIES, columns=[*SERIES, "needed", "needed_err", "exchanges", "bound",
                                                  "finest"])

ALL = (OPERATORS, MEANS, SLOPES, BRACKETS, BRACKET_MEANS, BRACKET_SLOPES, VORTICES, CONVECTION, REFERENCE,
       FLOWS, FLOW_SLOPES, CHEAPEST)
