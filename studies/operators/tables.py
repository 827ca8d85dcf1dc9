"""Tables of the study operators. Lengths in spacings a (in `continuum` in r0), `_err` half width of the 95 % interval.

`predicted` is what theory gives for the number beside it, right or wrong: a defect of the printed equations has its own.
"""
from studies.kit.table import Table

# --- weights ------------------------------------------------------------------------------------------------

#: weights before discretisation; `value_err` is the quadrature's or the extrapolation's
CONTINUUM = Table("continuum", key=["weight", "d", "quantity"],
                  columns=["weight", "d", "quantity", "value", "value_err", "predicted"])
#: over k: of the smoothed field f^(k), and on the lattice along an axis of gradient/k, nested and pairwise
#: Laplacian/k^2; nested is the gradient taken of the gradient, point by point
SYMBOLS = Table("symbols", key=["weight", "d", "r0", "k"],
                columns=["weight", "d", "r0", "k", "smoothed", "gradient", "nested", "pairwise"])
#: sum of w r^n/r0^(n-1) over the lattice with plain and printed w, or along one half line with the printed
#: one
LATTICE = Table("lattice", key=["how", "weight", "d", "r0", "n"],
                columns=["how", "weight", "d", "r0", "n", "value", "predicted"])
#: sums over the points of a fine lattice of f (n = 0) and of W r (n = 1), of weights of width r0 spacings
COUNTED = Table("counted", key=["weight", "d", "r0", "n"],
                columns=["weight", "d", "r0", "n", "value", "predicted"])
#: relative error of the gradient of a plane wave, exponential weight
EXPONENTIAL = Table("exponential", key=["d", "wavelength", "r0"],
                    columns=["d", "wavelength", "r0", "plain", "renormalised"])
#: largest |M_1/d - 1| of all weights; factor before the third derivatives of Eq. 5; largest relative error of
#: both viscosities of forces along edges, endless waves along an axis of a lattice
NUMBERS = Table("numbers", key=["quantity"], columns=["quantity", "value"])

# --- terms of the equations ---------------------------------------------------------------------------------

#: terms of the equations on lattices against exact derivatives: relative rms error, and projection on the
#: exact term
EQUATIONS = Table("equations", key=["d", "weight", "h", "operator", "cells"],
                  columns=["d", "weight", "h", "operator", "cells", "error", "ratio"])
#: d ln error/d ln(spacing) at fixed h/a, and the projection extrapolated to no spacing
ORDERS = Table("orders", key=["d", "weight", "h", "operator"],
               columns=["d", "weight", "h", "operator", "order", "order_err", "ratio", "ratio_err", "finest"])
#: Eqs 21, 26, 27, 34-38 read literally, over what they stand for, where dV is not 1
VOLUMES = Table("volumes", key=["quantity"], columns=["quantity", "dV", "ratio", "predicted"])
#: mean normal stress of a uniform dilation over its rate, less zeta, over eta
DILATION = Table("dilation", key=["d", "trace"], columns=["d", "trace", "bulk", "predicted"])
STREAMS = ("force", "heat", "asymmetry", "growth")
#: nested transport off a lattice: rms force on a uniform stream a^2/(eta U), rms heating of uniform
#: temperature a^2/(kappa T), |K - K^T|/|K| of the operator, its largest growth rate a^2/diffusivity
STREAM = Table("stream", key=["points", "inner", "seed"], columns=["points", "inner", "seed", *STREAMS])
STREAM_MEANS = Table("stream_means", key=["points", "inner"], columns=[
    "points", "inner", "seeds", *(name + err for name in STREAMS for err in ("", "_err"))])
#: at the 2^d - 1 Nyquist corners: largest |gradient| of the wave times a (nested), least Laplacian times a^2
#: (pairwise)
NULLS = Table("nulls", key=["weight", "d", "h"], columns=["weight", "d", "h", "corners", "nested",
                                                          "pairwise"])
#: viscosities from lattice sums of A(r) and B(r), and from M_A and M_B
FRICTION = Table("friction", key=["d", "form", "h"],
                 columns=["d", "form", "h", "eta", "zeta", "eta_predicted", "zeta_predicted"])
#: heating of a rigid rotation over eta omega^2
ROTATION = Table("rotation", key=["d", "zeta", "mended"],
                 columns=["d", "zeta", "mended", "heating", "predicted"])

# --- what is kept and what grows ----------------------------------------------------------------------------

GROWN = ["maker", "points", "d", "viscosity"]
#: largest growth rate a/c of the linearised fluid at rest, viscosity in rho c a; closure: largest |sum_j
#: S_ij|/V_i
GROWTH = Table("growth", key=[*GROWN, "seed"], columns=[*GROWN, "seed", "rate", "closure"])
GROWTH_MEANS = Table("growth_means", key=GROWN, columns=[
    *GROWN, "seeds", "rate", "rate_err", "largest", "closure", "closure_err"])
#: lost: of mass, momentum, energy by random states, relative; uniform: largest rate of a uniform fluid in a
#: wind
INVARIANCE = Table("invariance", key=["maker", "points", "d", "transport"],
                   columns=["maker", "points", "d", "transport", "lost", "uniform"])
#: momentum lost without the second kernel of Eq. 14, over the sum of sizes
ONE_KERNEL = Table("one_kernel", key=["points", "d", "seed"], columns=["points", "d", "seed", "lost"])
#: largest stable step of forward Euler by wave number, in a/c; predicted (eta + zeta + kappa/2)/(rho c^2)
EULER = Table("euler", key=["transport", "eta", "zeta", "kappa", "mode"],
              columns=["transport", "eta", "zeta", "kappa", "mode", "k", "limit", "predicted"])
LAYER = ["h", "rows", "ra", "share"]
#: a motionless layer between plates: largest growth rate and its frequency in c/a, share of its square in
#: waves shorter than three spacings, rate of conduction over the height; by eigenvalues, without chance
NESTED_GROWTH = Table("nested_growth", key=LAYER,
                      columns=[*LAYER, "growth", "frequency", "nyquist", "diffusion"])

# --- transport in time: a gas at rho = T = 1 with C_V = 1 ---------------------------------------------------

SERIES = ["transport", "maker", "weight", "h", "points", "direction", "zeta", "quantity"]
WAVE = [*SERIES, "wavelength"]
#: each wave: measured, by the lattice symbol (nothing off a lattice), and of the continuum
WAVES = Table("waves", key=[*WAVE, "seed"], columns=[*WAVE, "seed", "measured", "measured_err", "lattice",
                                                     "continuum"])
#: means over seeds; error: measured less continuum, over the continuum's (a bulk viscosity that is zero: over
#: the shear viscosity); from_lattice: measured less symbol, over the same
COEFFICIENTS = Table("coefficients", key=WAVE, columns=[
    *WAVE, "seeds", "measured", "measured_err", "lattice", "continuum", "error", "error_err", "from_lattice"])
#: order: -d ln |error|/d ln wavelength, waves of 16 spacings and more; long: the error for endless waves
TRANSPORT_ORDERS = Table("transport_orders", key=SERIES,
                         columns=[*SERIES, "order", "order_err", "long", "long_err"])
FLOW = ["flow", "points", "rows"]
#: velocity less series, rms and largest over points, in units of the plate's speed or of the final speed in
#: the middle, at times in height^2/nu; heating, compression, velocity across the plates: what the series
#: neglect
SHEAR = Table("shear", key=[*FLOW, "seed", "time"], columns=[
    *FLOW, "seed", "time", "rms", "largest", "heating", "compression", "across"])
SHEAR_MEANS = Table("shear_means", key=[*FLOW, "time"], columns=[
    *FLOW, "time", "seeds", "rms", "rms_err", "largest", "largest_err"])
SHEAR_ORDER = ["flow", "points", "time", "norm"]
#: order: -d ln error/d ln rows of all runs
SHEAR_ORDERS = Table("shear_orders", key=SHEAR_ORDER, columns=[*SHEAR_ORDER, "order", "order_err"])

ALL = (CONTINUUM, SYMBOLS, LATTICE, COUNTED, EXPONENTIAL, NUMBERS, EQUATIONS, ORDERS, VOLUMES, DILATION,
       STREAM, STREAM_MEANS,
       NULLS, FRICTION, ROTATION, GROWTH, GROWTH_MEANS, INVARIANCE, ONE_KERNEL, EULER, NESTED_GROWTH,
       WAVES, COEFFICIENTS, TRANSPORT_ORDERS, SHEAR, SHEAR_MEANS, SHEAR_ORDERS)
