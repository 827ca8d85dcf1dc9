"""Tables of the studies of discretized integral hydrodynamics. Lengths in spacings a; errors relative; `_err` 95 %."""
from studies.kit.table import Table

POINT = ["maker", "weight", "h", "points", "wavelength"]
#: rms errors of gradient and Laplacian of a plane wave; closure and linear: how far edges are from closed and from linearly exact
OPERATORS = Table("operators", key=[*POINT, "seed"], columns=[*POINT, "seed", "a_over_h", "h_over_lambda", "gradient",
                                                              "laplacian", "closure", "linear"])
#: the same over seeds
MEANS = Table("means", key=POINT, columns=[*POINT, "seeds", "a_over_h", "h_over_lambda", "gradient", "gradient_err",
                                           "laplacian", "laplacian_err"])
#: d ln error/d ln(h/lambda): `fixed` says what stays as it is, h/a (finer points for a wave) or a (a wider weight)
SLOPES = Table("slopes", key=["maker", "weight", "points", "fixed", "at", "operator"],
               columns=["maker", "weight", "points", "fixed", "at", "operator", "slope", "slope_err", "floor"])

ALL = (OPERATORS, MEANS, SLOPES)
