"""Tables of the study operators. Lengths in spacings (`continuum`: in r0); `_err`: half of the 95 % interval.

`predicted` is what theory gives for the number beside it.
"""
from studies.kit.table import Table

#: weights before discretisation; `value_err` is the quadrature's or that of halving k; counted: f over the
#: points of a fine lattice
CONTINUUM = Table.of("continuum", "weight d quantity", "value value_err predicted")
#: over k: of the smoothed field f^(k), and on the square lattice along an axis of gradient/k, nested and
#: pairwise Laplacian/k^2; nested is the gradient of the gradient
SYMBOLS = Table.of("symbols", "weight d r0 k", "smoothed gradient nested pairwise")
#: sum of w r^n/r0^(n-1) over the lattice, plain and printed w, or along one half line, printed w
LATTICE = Table.of("lattice", "how weight d r0 n", "value predicted")
#: relative error of the gradient of a plane wave, exponential weight
EXPONENTIAL = Table.of("exponential", "d wavelength r0", "plain renormalised")
#: of weights; of Eqs 21, 26, 27, 33-37 read literally, over what they stand for
NUMBERS = Table.of("numbers", "quantity", "value")

TERM = "d weight h operator"
#: terms on lattices against exact derivatives: relative rms error, and projection on the exact term
EQUATIONS = Table.of("equations", f"{TERM} cells", "error ratio")
#: d ln error/d ln(spacing) at fixed h/a, and the projection extrapolated to no spacing
ORDERS = Table.of("orders", TERM, "order order_err ratio ratio_err")
#: viscosities from lattice sums of A(r) and B(r), and from M_A and M_B
FRICTION = Table.of("friction", "d form h", "eta zeta eta_predicted zeta_predicted")

POINTS = "maker points d"
#: lost: of mass, momentum, energy by random states, relative
INVARIANCE = Table.of("invariance", f"{POINTS} transport", "seed lost")
#: momentum lost without the second kernel of Eq. 14, over the sum of sizes
ONE_KERNEL = Table.of("one_kernel", f"{POINTS} seed", "lost")
#: largest growth rate a/c of the linearised fluid at rest, viscosity in rho c a; closure: largest
#: |sum_j S_ij|/V_i
GROWTH = Table.of("growth", f"{POINTS} viscosity seed", "rate closure")
GROWTH_MEANS = Table.of("growth_means", f"{POINTS} viscosity",
                        "seeds rate rate_err largest closure closure_err")
#: largest stable step of forward Euler at one wave number, and (eta + zeta + kappa/2)/rho c^2
EULER = Table.of("euler", "eta zeta kappa mode", "k limit predicted")
#: fastest growth of a disturbance of a motionless layer, c/a
NESTED_GROWTH = Table.of("nested_growth", "h rows ra share", "growth")

SERIES = "transport maker h points zeta quantity"
#: each wave: measured, and of the continuum; Lucy's weight
WAVES = Table.of("waves", f"{SERIES} wavelength seed", "measured measured_err continuum")
#: means over seeds; error: measured less continuum, over the continuum's
COEFFICIENTS = Table.of("coefficients", f"{SERIES} wavelength",
                        "continuum seeds measured measured_err error error_err")
#: order: -d ln |error|/d ln wavelength, waves of 16 spacings and more; long: the error for endless waves
TRANSPORT_ORDERS = Table.of("transport_orders", SERIES, "order order_err long long_err")
#: velocity less series, rms and largest over points, in units of the plate's speed or of the final speed in
#: the middle, at times in height^2/nu
SHEAR = Table.of("shear", "flow points rows seed time", "rms largest")
SHEAR_MEANS = Table.of("shear_means", "flow points rows time", "seeds rms rms_err largest largest_err")
#: order: -d ln error/d ln rows of all runs
SHEAR_ORDERS = Table.of("shear_orders", "flow points time norm", "order order_err")

ALL = (CONTINUUM, SYMBOLS, LATTICE, EXPONENTIAL, NUMBERS, EQUATIONS, ORDERS, FRICTION, INVARIANCE, ONE_KERNEL,
       GROWTH, GROWTH_MEANS, EULER, NESTED_GROWTH, WAVES, COEFFICIENTS, TRANSPORT_ORDERS, SHEAR, SHEAR_MEANS,
       SHEAR_ORDERS)
