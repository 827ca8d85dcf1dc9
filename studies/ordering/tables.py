"""Tables of the study ordering. Lengths in spacings; errors relative; `_err`: half of the 95 % interval."""
import numpy as np

from particles.integral.interpolants import moment
from particles.weights import Lucy
from studies.kit.table import Table

#: rms width of Lucy's weight in 2D, RR98's r0, over its range
WIDTH = float(np.sqrt(moment(Lucy.of(h=1.0, d=2), 3, 2)/4))

POINT = "maker h points wavelength"
#: rms errors of gradient and Laplacian of a plane wave; closure and linear: how far edges are from closed and
#: from linearly exact
OPERATORS = Table.of("operators", f"{POINT} seed", "gradient laplacian closure linear")
#: the same over seeds
MEANS = Table.of("means", POINT, "seeds gradient gradient_err laplacian laplacian_err")
#: d ln error/d ln(h/lambda); `fixed` says what stays as it is: h/a (finer points for a wave) or a (a wider
#: weight)
SLOPES = Table.of("slopes", "maker points operator fixed at", "slope slope_err floor")

#: rms errors of the gradient of a plane wave by plain quadrature: with f_j alone [Eq. 1], f_i + f_j [Eqs 14,
#: 34-36], f_j - f_i
BRACKETS = Table.of("brackets", "h points wavelength seed", "single sum difference")
#: the same over seeds
BRACKET_MEANS = Table.of("bracket_means", "h points wavelength form", "seeds error error_err")
#: d ln error/d ln(h/lambda) at h = 3 a
BRACKET_SLOPES = Table.of("bracket_slopes", "points form", "slope slope_err")

#: a Taylor-Green vortex that has decayed by e: relative rms error of the velocity against the gas of its Mach
#: number, none where the run diverged; exchanges: over edges, of the whole run; h = 0: edges of no weight
VORTICES = Table.of("vortices", f"{POINT} seed", "velocity exchanges")
#: Rayleigh-Benard at Ra 10 000, `rows` spacings high: K per mass and Nusselt number in the end
CONVECTION = Table.of("convection", "maker h points rows seed",
                      "ke ke_err nu nu_err rolls converged exchanges")
#: K of the grid of study rb, extrapolated
REFERENCE = Table.of("reference", "flow", "ke ke_err")
SERIES = "flow maker h points"
#: means over seeds of relative errors, with sign, of the velocity of vortices and of K of convection;
#: resolution: spacings to the wavelength or to the height; lost: seeds without a number
FLOWS = Table.of("flows", f"{SERIES} resolution", "seeds lost error error_err exchanges")
#: d ln |error|/d ln(a/lambda) at fixed h/a and d ln |error|/d ln h at fixed a, over all runs; `at`: that h or
#: resolution
FLOW_SLOPES = Table.of("flow_slopes", "flow maker points fixed at", "slope slope_err")
#: least resolution from which on the error stays below 1 %, and exchanges there; bound = 1: the least that
#: was run; finest: the error at the highest one
CHEAPEST = Table.of("cheapest", SERIES, "needed needed_err exchanges bound finest")

ALL = (OPERATORS, MEANS, SLOPES, BRACKETS, BRACKET_MEANS, BRACKET_SLOPES, VORTICES, CONVECTION, REFERENCE,
       FLOWS, FLOW_SLOPES, CHEAPEST)
