"""Tables of the study operators. Lengths in spacings a (in `continuum` in r0), `_err` half width of the 95 % interval.

`predicted` is what theory gives for the number beside it, right or wrong: a defect of the printed equations has its own.
"""
from studies.kit.table import Table

#: weights before discretisation; `value_err` is the quadrature's or the extrapolation's
CONTINUUM = Table("continuum", key=["weight", "d", "quantity"],
                  columns=["weight", "d", "quantity", "value", "value_err", "predicted"])
#: over k: of the smoothed field f^(k), and on the lattice along an axis of gradient/k, nested and pairwise Laplacian/k^2; nested
#: is the gradient taken of the gradient, point by point
SYMBOLS = Table("symbols", key=["weight", "d", "r0", "k"],
                columns=["weight", "d", "r0", "k", "smoothed", "gradient", "nested", "pairwise"])
#: sum of w r^n/r0^(n-1) over the lattice with plain and printed w, or along one half line with the printed one
LATTICE = Table("lattice", key=["how", "weight", "d", "r0", "n"],
                columns=["how", "weight", "d", "r0", "n", "value", "predicted"])
#: sums over the points of a fine lattice of f (n = 0) and of W r (n = 1), of weights of width r0 spacings
COUNTED = Table("counted", key=["weight", "d", "r0", "n"], columns=["weight", "d", "r0", "n", "value", "predicted"])
#: on square lattices of so many rows: largest frequency of sound over c/a, D_max; step: the longest of RK4, in a/c, by
#: eigenvalues (of the smaller lattice only)
FASTEST = Table("fastest", key=["weight", "h", "rows"], columns=["weight", "h", "rows", "fastest", "step"])
#: relative error of the gradient of a plane wave, exponential weight
EXPONENTIAL = Table("exponential", key=["d", "wavelength", "r0"],
                    columns=["d", "wavelength", "r0", "plain", "renormalised"])
#: terms of the equations on lattices against exact derivatives: relative rms error, and projection on the exact term
EQUATIONS = Table("equations", key=["d", "weight", "h", "operator", "cells"],
                  columns=["d", "weight", "h", "operator", "cells", "error", "ratio"])
#: d ln error/d ln(spacing) at fixed h/a, and the projection extrapolated to no spacing
ORDERS = Table("orders", key=["d", "weight", "h", "operator"],
               columns=["d", "weight", "h", "operator", "order", "order_err", "ratio", "ratio_err", "finest"])
#: Eqs 21, 26, 27, 34-38 read literally, over what they stand for, where dV is not 1
VOLUMES = Table("volumes", key=["quantity"], columns=["quantity", "dV", "ratio", "predicted"])
#: mean normal stress of a uniform dilation over its rate, less zeta, over eta
DILATION = Table("dilation", key=["d", "trace"], columns=["d", "trace", "bulk", "predicted"])
#: nested transport off a lattice: rms force on a uniform stream a^2/(eta U), rms heating of uniform temperature a^2/(kappa T),
#: |K - K^T|/|K| of the operator, its largest growth rate a^2/diffusivity
STREAM = Table("stream", key=["points", "inner", "seed"],
               columns=["points", "inner", "seed", "force", "heat", "asymmetry", "growth"])
STREAM_MEANS = Table("stream_means", key=["points", "inner"],
                     columns=["points", "inner", "seeds", *(name + err for name in ("force", "heat", "asymmetry", "growth")
                                                            for err in ("", "_err"))])
#: at the 2^d - 1 Nyquist corners: largest |gradient| of the wave times a (nested), least Laplacian times a^2 (pairwise)
NULLS = Table("nulls", key=["weight", "d", "h"], columns=["weight", "d", "h", "corners", "nested", "pairwise"])
#: largest growth rate a/c of the linearised fluid at rest, viscosity in rho c a; closure: largest |sum_j S_ij|/V_i
GROWTH = Table("growth", key=["maker", "points", "d", "viscosity", "seed"],
               columns=["maker", "points", "d", "viscosity", "seed", "rate", "closure"])
GROWTH_MEANS = Table("growth_means", key=["maker", "points", "d", "viscosity"],
                     columns=["maker", "points", "d", "viscosity", "seeds", "rate", "rate_err", "largest", "closure",
                              "closure_err"])
#: lost: by random states, relative; uniform: largest rate of a uniform fluid in a wind; wind: what a wind changes in random
#: states besides carrying them with D, relative; skew: |D + D^T|/|D|, matrix norms, growth of sound over its largest frequency
INVARIANCE = Table("invariance", key=["maker", "points", "d", "transport"],
                   columns=["maker", "points", "d", "transport", "lost", "uniform", "wind", "skew"])
#: in a uniform stream U of random rho, T: heating by the pressure of Eq. 36 and of brackets P_i v_i + P_j v_j, over P U/a;
#: rate of the mass where rho is uniform; momentum lost without the second kernel of Eq. 14, over the sum of sizes
WORK = Table("work", key=["points", "d", "seed"],
             columns=["points", "d", "seed", "work", "own", "mass", "one_kernel"])
#: largest stable step of forward Euler by wave number, in a/c; predicted (eta + zeta + kappa/2)/(rho c^2)
EULER = Table("euler", key=["transport", "eta", "zeta", "kappa", "mode"],
              columns=["transport", "eta", "zeta", "kappa", "mode", "k", "limit", "predicted"])
#: viscosities from lattice sums of A(r) and B(r), for shear along axes and diagonals, and from M_A and M_B
FRICTION = Table("friction", key=["d", "form", "h"],
                 columns=["d", "form", "h", "eta", "eta_diagonal", "zeta", "eta_predicted", "zeta_predicted"])
#: heating of a rigid rotation over eta omega^2
ROTATION = Table("rotation", key=["d", "zeta", "mended"], columns=["d", "zeta", "mended", "heating", "predicted"])

#: sets of `length` x 16 points in 2D. off_lattice: 1 - |mean of exp(4 i angle)| over the bonds of each point to its four
#: nearest, 0 on a square lattice whatever its direction, 1 without such order; uneven: largest a |sum_j W V_j e_ij|, 0 where
#: every point is surrounded evenly, as on a lattice
DISTANCES = Table("distances", key=["points", "length", "seed"], columns=["points", "length", "seed", "off_lattice", "uneven"])
DISTANCE_MEANS = Table("distance_means", key=["points", "length"], columns=[
    "points", "length", "seeds", "off_lattice", "off_lattice_err", "uneven", "uneven_err"])

ALL = (CONTINUUM, SYMBOLS, LATTICE, COUNTED, FASTEST, EXPONENTIAL, EQUATIONS, ORDERS, VOLUMES, DILATION, STREAM, STREAM_MEANS,
       NULLS, GROWTH, GROWTH_MEANS, INVARIANCE, WORK, EULER, FRICTION, ROTATION, DISTANCES,
       DISTANCE_MEANS)
