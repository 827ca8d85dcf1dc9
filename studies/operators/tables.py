"""Tables of the study operators. Lengths in spacings (`continuum`: in r0); `_err`: half of the 95 % interval.

`predicted` is what theory gives for the number beside it.
"""
from studies.kit.table import Table

# --- weights ------------------------------------------------------------------------------------------------

#: weights before discretisation; `value_err` is the quadrature's or that of halving k; counted: f over the
#: points of a fine lattice
CONTINUUM = Table("continuum", key=["weight", "d", "quantity"],
                  columns=["weight", "d", "quantity", "value", "value_err", "predicted"])
#: over k: of the smoothed field f^(k), and on the square lattice along an axis of gradient/k, nested and
#: pairwise Laplacian/k^2; nested is the gradient of the gradient
SYMBOLS = Table("symbols", key=["weight", "d", "r0", "k"],
                columns=["weight", "d", "r0", "k", "smoothed", "gradient", "nested", "pairwise"])
#: sum of w r^n/r0^(n-1) over the lattice, plain and printed w, or along one half line, printed w
LATTICE = Table("lattice", key=["how", "weight", "d", "r0", "n"],
                columns=["how", "weight", "d", "r0", "n", "value", "predicted"])
#: relative error of the gradient of a plane wave, exponential weight
EXPONENTIAL = Table("exponential", key=["d", "wavelength", "r0"],
                    columns=["d", "wavelength", "r0", "plain", "renormalised"])
#: single numbers of weights; Eqs 21, 26, 27, 33-37 read literally, over what they stand for; see `literal.py`
NUMBERS = Table("numbers", key=["quantity"], columns=["quantity", "value"])

# --- terms of the equations ---------------------------------------------------------------------------------

TERM = ["d", "weight", "h", "operator"]
#: terms on lattices against exact derivatives: relative rms error, and projection on the exact term
EQUATIONS = Table("equations", key=[*TERM, "cells"], columns=[*TERM, "cells", "error", "ratio"])
#: d ln error/d ln(spacing) at fixed h/a, and the projection extrapolated to no spacing
ORDERS = Table("orders", key=TERM, columns=[*TERM, "order", "order_err", "ratio", "ratio_err"])
#: viscosities from lattice sums of A(r) and B(r), and from M_A and M_B
FRICTION = Table("friction", key=["d", "form", "h"],
                 columns=["d", "form", "h", "eta", "zeta", "eta_predicted", "zeta_predicted"])

# --- what is kept and what grows ----------------------------------------------------------------------------

POINTS = ["maker", "points", "d"]
#: lost: of mass, momentum, energy by random states, relative
INVARIANCE = Table("invariance", key=[*POINTS, "transport"], columns=[*POINTS, "transport", "seed", "lost"])
#: momentum lost without the second kernel of Eq. 14, over the sum of sizes
ONE_KERNEL = Table("one_kernel", key=[*POINTS, "seed"], columns=[*POINTS, "seed", "lost"])
GROWN = [*POINTS, "viscosity"]
#: largest growth rate a/c of the linearised fluid at rest, viscosity in rho c a; closure: largest
#: |sum_j S_ij|/V_i
GROWTH = Table("growth", key=[*GROWN, "seed"], columns=[*GROWN, "seed", "rate", "closure"])
GROWTH_MEANS = Table("growth_means", key=GROWN, columns=[
    *GROWN, "seeds", "rate", "rate_err", "largest", "closure", "closure_err"])
#: largest stable step of forward Euler at one wave number, and (eta + zeta + kappa/2)/rho c^2
EULER = Table("euler", key=["eta", "zeta", "kappa", "mode"],
              columns=["eta", "zeta", "kappa", "mode", "k", "limit", "predicted"])
#: fastest growth of a disturbance of a motionless layer, c/a
NESTED_GROWTH = Table("nested_growth", key=["h", "rows", "ra", "share"],
                      columns=["h", "rows", "ra", "share", "growth"])

# --- transport in time --------------------------------------------------------------------------------------

SERIES = ["transport", "maker", "h", "points", "zeta", "quantity"]
WAVE = [*SERIES, "wavelength"]
#: each wave: measured, and of the continuum; Lucy's weight
WAVES = Table("waves", key=[*WAVE, "seed"], columns=[*WAVE, "seed", "measured", "measured_err", "continuum"])
#: means over seeds; error: measured less continuum, over the continuum's
COEFFICIENTS = Table("coefficients", key=WAVE, columns=[
    *WAVE, "continuum", "seeds", "measured", "measured_err", "error", "error_err"])
#: order: -d ln |error|/d ln wavelength, waves of 16 spacings and more; long: the error for endless waves
TRANSPORT_ORDERS = Table("transport_orders", key=SERIES,
                         columns=[*SERIES, "order", "order_err", "long", "long_err"])
FLOW = ["flow", "points", "rows"]
#: velocity less series, rms and largest over points, in units of the plate's speed or of the final speed in
#: the middle, at times in height^2/nu
SHEAR = Table("shear", key=[*FLOW, "seed", "time"], columns=[*FLOW, "seed", "time", "rms", "largest"])
SHEAR_MEANS = Table("shear_means", key=[*FLOW, "time"], columns=[
    *FLOW, "time", "seeds", "rms", "rms_err", "largest", "largest_err"])
SHEAR_ORDER = ["flow", "points", "time", "norm"]
#: order: -d ln error/d ln rows of all runs
SHEAR_ORDERS = Table("shear_orders", key=SHEAR_ORDER, columns=[*SHEAR_ORDER, "order", "order_err"])

ALL = (CONTINUUM, SYMBOLS, LATTICE, EXPONENTIAL, NUMBERS, EQUATIONS, ORDERS, FRICTION, INVARIANCE, ONE_KERNEL,
       GROWTH, GROWTH_MEANS, EULER, NESTED_GROWTH, WAVES, COEFFICIENTS, TRANSPORT_ORDERS, SHEAR, SHEAR_MEANS,
       SHEAR_ORDERS)
