"""Tables of the study operators. Lengths in spacings (`continuum`: in r0); `_err`: half of the 95 % interval.

`predicted` is what theory gives for the number beside it.
"""
from studies.kit.table import Table

CONTINUUM = Table.of("continuum", "weight d quantity", "value value_err predicted",
                     about="An integral of a weight of width r0 = 1 before it is discretised.",
                     means={"value": ("the integral; its error is the quadrature's or that of halving k",
                                      "")})
SYMBOLS = Table.of("symbols", "weight d r0 k", "smoothed gradient nested pairwise",
                   about="What operators on the square lattice make of a wave along an axis.",
                   means={"k": ("wave number", "1/a"), "gradient": ("gradient of a plane wave over k", "")})
LATTICE = Table.of("lattice", "how weight d r0 n", "value predicted",
                   about="A discrete moment of a weight: sum of w r^n/r0^(n-1) over a lattice.",
                   means={"n": ("power of r", ""), "value": ("the sum", "")})
EXPONENTIAL = Table.of("exponential", "d wavelength r0", "plain renormalised",
                       about="The gradient of a plane wave with the exponential weight [RR98 Eq. 31].")
NUMBERS = Table.of("numbers", "quantity", "value",
                   about="A number without parameters: of weights, and of Eqs 21, 26, 27, 33-37 read "
                         "literally, "
                         "over what they stand for.")

TERM = "d weight h operator"
EQUATIONS = Table.of("equations", f"{TERM} cells", "error ratio",
                     about="A term on a lattice against the exact derivative.",
                     means={"error": ("relative rms error", ""), "ratio": ("projection on the exact term",
                                                                           "")})
ORDERS = Table.of("orders", TERM, "order order_err ratio ratio_err",
                  about="The order of such a term in the spacing at fixed h/a.",
                  means={"order": ("d ln error/d ln spacing", ""),
                         "ratio": ("projection on the exact term, extrapolated to no spacing", "")})
FRICTION = Table.of("friction", "d form h", "eta zeta eta_predicted zeta_predicted",
                    about="Viscosities that forces A(r) e (e.v_ij) + B(r) v_ij of Eq. 51 give, by lattice "
                          "sums.",
                    means={"form": ("A and B as functions of r", ""), "eta": ("viscosity", "")})

POINTS = "maker points d"
INVARIANCE = Table.of("invariance", f"{POINTS} transport", "seed lost",
                      about="A random state: what its sums of mass, momentum and energy lose.",
                      means={"lost": ("largest change of a sum over the sum of its sizes", "")})
ONE_KERNEL = Table.of("one_kernel", f"{POINTS} seed", "lost",
                      about="A random state without the second kernel of Eq. 14.",
                      means={"lost": ("momentum lost over the sum of its sizes", "")})
VISCOSITY, RATE = ("viscosity over rho c a", ""), ("largest growth rate of the linearised fluid at rest",
                                                   "c/a")
GROWTH = Table.of("growth", f"{POINTS} viscosity seed", "rate closure",
                  about="Sound in a fluid at rest on one set of points.",
                  means={"viscosity": VISCOSITY, "rate": RATE})
GROWTH_MEANS = Table.of("growth_means", f"{POINTS} viscosity",
                        "seeds rate rate_err largest closure closure_err",
                        about="The same, means over seeds.",
                        means={"viscosity": VISCOSITY, "rate": RATE, "largest": ("largest rate of a seed",
                                                                                 "c/a")})
EULER = Table.of("euler", "eta zeta kappa mode", "k limit predicted",
                 about="The largest stable step of forward Euler [Eq. 40] for waves along an axis of a "
                       "lattice.",
                 means={"mode": ("whole waves along 32 points", ""), "k": ("wave number", "1/a"),
                        "eta": ("viscosity", ""), "limit": ("largest stable step", "t0"),
                        "predicted": ("(eta + zeta + kappa/2)/rho c^2", "t0"), "kappa": ("conductivity", "")})
NESTED_GROWTH = Table.of("nested_growth", "h rows ra share", "growth",
                         about="The fastest growing disturbance of a motionless layer between plates.",
                         means={"share": ("share of transport along edges; the rest is nested", ""),
                                "growth": ("growth rate", "c/a")})

SERIES = "transport maker h points zeta quantity"
WAVES = Table.of("waves", f"{SERIES} wavelength seed", "measured measured_err continuum",
                 about="A wave of the linearised gas on points, Lucy's weight.")
COEFFICIENTS = Table.of("coefficients", f"{SERIES} wavelength",
                        "continuum seeds measured measured_err error error_err",
                        about="The same, means over seeds.",
                        means={"error": ("measured/continuum - 1", "")})
TRANSPORT_ORDERS = Table.of("transport_orders", SERIES, "order order_err long long_err",
                            about="How these errors fall with the wavelength, from 16 spacings on.",
                            means={"order": ("-d ln |error|/d ln wavelength", "")})
PROFILE = "velocity less the exact series, over the plate's speed or the final speed in the middle"
NORMS = {"time": ("time", "height^2/nu"), "rms": (f"rms over points of the {PROFILE}", ""),
         "largest": (f"largest of the same: {PROFILE}", "")}
SHEAR = Table.of("shear", "flow points rows seed time", "rms largest", means=NORMS,
                 about="A profile of Couette or Poiseuille flow at one time.")
SHEAR_MEANS = Table.of("shear_means", "flow points rows time", "seeds rms rms_err largest largest_err",
                       means=NORMS, about="The same, means over seeds.")
SHEAR_ORDERS = Table.of("shear_orders", "flow points time norm", "order order_err",
                        about="How these errors fall with the rows, all runs in one fit.",
                        means={"time": NORMS["time"], "order": ("-d ln error/d ln rows", "")})

ALL = (CONTINUUM, SYMBOLS, LATTICE, EXPONENTIAL, NUMBERS, EQUATIONS, ORDERS, FRICTION, INVARIANCE, ONE_KERNEL,
       GROWTH, GROWTH_MEANS, EULER, NESTED_GROWTH, WAVES, COEFFICIENTS, TRANSPORT_ORDERS, SHEAR, SHEAR_MEANS,
       SHEAR_ORDERS)
