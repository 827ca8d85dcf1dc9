"""Tables of the study ordering. Lengths in spacings; errors relative; `_err`: half of the 95 % interval."""
import numpy as np

from particles.integral.interpolants import moment
from particles.weights import Lucy
from studies.kit.table import Table

#: rms width of Lucy's weight in 2D, RR98's r0, over its range
WIDTH = float(np.sqrt(moment(Lucy.of(h=1.0, d=2), 3, 2)/4))

POINT = "maker h points wavelength"
OPERATORS = Table.of("operators", f"{POINT} seed", "gradient laplacian closure linear",
                     about="A plane wave on one set of points.")
MEANS = Table.of("means", POINT, "seeds gradient gradient_err laplacian laplacian_err",
                 about="The same, means over seeds.")
SLOPES = Table.of("slopes", "maker points operator fixed at", "slope slope_err floor",
                  about="How these errors change with h over the wavelength.",
                  means={"operator": ("gradient or laplacian", ""), "slope": ("d ln error/d "
                                                                              "ln(h/wavelength)", "")})

FORM = {"form": ("which gradient: single, sum or difference", "")}
BRACKETS = Table.of("brackets", "h points wavelength seed", "single sum difference",
                    about="The gradient of a plane wave by plain quadrature in three forms.")
BRACKET_MEANS = Table.of("bracket_means", "h points wavelength form", "seeds error error_err",
                         about="The same, means over seeds.",
                         means=FORM | {"error": ("relative rms error of the gradient", "")})
BRACKET_SLOPES = Table.of("bracket_slopes", "points form", "slope slope_err",
                          about="How these errors change with h over the wavelength at h = 3 a.",
                          means=FORM | {"slope": ("d ln error/d ln(h/wavelength)", "")})

VORTICES = Table.of("vortices", f"{POINT} seed", "velocity exchanges",
                    about="A Taylor-Green vortex that has decayed by e, against the gas of its Mach number; "
                          "no "
                          "numbers where the run diverged.")
CONVECTION = Table.of("convection", "maker h points rows seed",
                      "ke ke_err nu nu_err rolls converged exchanges",
                      about="Rayleigh-Benard convection at Ra 10 000: its end; no numbers where it diverged.")
REFERENCE = Table.of("reference", "flow", "ke ke_err",
                     about="K of the grid of the study rb, extrapolated.")
SERIES = "flow maker h points"
SPACINGS = ("spacings to the wavelength (taylor-green) or to the height (convection)", "")
FLOWS = Table.of("flows", f"{SERIES} resolution", "seeds lost error error_err exchanges",
                 about="Means over seeds: a point of the error surface.",
                 means={"resolution": SPACINGS, "lost": ("seeds without a number", ""),
                        "error": ("error of the velocity of vortices, of K of convection with sign", "")})
FLOW_SLOPES = Table.of("flow_slopes", "flow maker points fixed at", "slope slope_err",
                       about="How these errors change with the spacing or the range, all runs in one fit.",
                       means={"slope": ("d ln |error|/d ln a at fixed h/a, d ln |error|/d ln h at fixed a",
                                        "")})
CHEAPEST = Table.of("cheapest", SERIES, "needed needed_err exchanges bound finest",
                    about="What an error of 1 % costs; no numbers where no run is that good.",
                    means={"needed": (f"least number of {SPACINGS[0]} from which on the error stays below 1 "
                                      f"%", ""),
                           "exchanges": ("exchanges over edges at that resolution", "")})

ALL = (OPERATORS, MEANS, SLOPES, BRACKETS, BRACKET_MEANS, BRACKET_SLOPES, VORTICES, CONVECTION, REFERENCE,
       FLOWS, FLOW_SLOPES, CHEAPEST)
