"""Tables of the study operators, and tables derived from them: orders, limits, means over seeds.

Lengths in spacings (`continuum`: in r0); `_err`: half of the 95 % interval; `predicted`: value by theory of
the number beside it.
"""
from collections.abc import Callable, Iterable, Iterator
from functools import partial
from typing import Any

import numpy as np
import pandas as pd

from studies.kit.fits import power_law
from studies.kit.stats import Measured, combine, seed_means, with_errors
from studies.kit.table import Row, Rows, Table, Tables

CONTINUUM = Table.of("continuum", "weight d quantity", "value value_err predicted",
                     about="An integral of a weight of width r0 = 1 before it is discretised.",
                     means={"value": ("the integral; its error: the quadrature's or of halving k", "")})
LATTICE = Table.of("lattice", "how weight d r0 n", "value predicted",
                   about="A discrete moment of a weight: sum of w r^n/r0^(n-1) over a lattice.",
                   means={"n": ("power of r", ""), "value": ("the sum", "")})
EXPONENTIAL = Table.of("exponential", "d wavelength r0", "plain",
                       about="The gradient of a plane wave with the exponential weight [RR98 Eq. 31].")
NUMBERS = Table.of("numbers", "quantity", "value",
                   about="A number without parameters: of weights, and of Eqs 21, 26, 27, 33-37 as printed.")

TERM = "d weight h operator"
EQUATIONS = Table.of("equations", f"{TERM} cells", "error ratio",
                     about="A term on a lattice against the exact derivative.",
                     means={"ratio": ("projection on the exact term", "")})
ORDERS = Table.of("orders", TERM, "order order_err ratio ratio_err",
                  about="The order of such a term in the spacing at fixed h/a.",
                  means={"ratio": ("projection on the exact term, extrapolated to no spacing", "")})

POINTS = "maker points d"
ONE_KERNEL = Table.of("one_kernel", f"{POINTS} seed", "lost",
                      about="A random state without the second kernel of Eq. 14.",
                      means={"lost": ("momentum lost over the sum of its sizes", "")})
GROWTH = Table.of("growth", f"{POINTS} viscosity seed", "rate closure",
                  about="Sound in a fluid at rest on one set of points.")
GROWTH_MEANS = Table.of("growth_means", f"{POINTS} viscosity",
                        "seeds rate rate_err closure closure_err", about="The same, means over seeds.")
EULER = Table.of("euler", "eta zeta kappa mode", "k limit predicted",
                 about="The largest stable step of forward Euler [Eq. 40] for waves on a lattice.",
                 means={"mode": ("whole waves along 32 points", ""), "k": ("wave number", "1/a"),
                        "eta": ("viscosity", ""), "limit": ("largest stable step", "t0"),
                        "predicted": ("(eta + zeta + kappa/2)/rho c^2", "t0")})
NESTED_GROWTH = Table.of("nested_growth", "h rows ra share", "growth",
                         about="The fastest growing disturbance of a motionless layer between plates.",
                         means={"share": ("share of transport along edges; the rest is nested", "")})

SERIES = "transport maker h points zeta quantity"
WAVES = Table.of("waves", f"{SERIES} wavelength seed", "measured measured_err continuum",
                 about="A wave of the linearised gas on points, Lucy's weight.")
COEFFICIENTS = Table.of("coefficients", f"{SERIES} wavelength",
                        "continuum seeds measured measured_err error error_err",
                        about="The same, means over seeds.", means={"error": ("measured/continuum - 1", "")})
TRANSPORT_ORDERS = Table.of("transport_orders", SERIES, "order order_err long long_err",
                            about="How these errors fall with the wavelength, from 16 spacings on.")
TIME = {"time": ("time", "height^2/nu")}
SHEAR = Table.of("shear", "flow points rows seed time", "rms largest", means=TIME,
                 about="A profile of Couette or Poiseuille flow at one time.")
SHEAR_MEANS = Table.of("shear_means", "flow points rows time", "seeds rms rms_err largest largest_err",
                       means=TIME, about="The same, means over seeds.")
SHEAR_ORDERS = Table.of("shear_orders", "flow points time norm", "order order_err", means=TIME,
                        about="How these errors fall with the rows, all runs in one fit.")

ENTROPY = Table.of("entropy", "transport maker points d state cells seed", "total least negative",
                   about="Entropy that stress and heat current, or a flow, produce in one state, or in 200 "
                         "random ones.",
                   means={"state": ("smooth; random; sought: where a descent ends", ""),
                          "total": ("production of the smooth state over that of the continuum", ""),
                          "least": ("production over the sum of what cancels in it, least of the states", ""),
                          "negative": ("share of the edges that destroy entropy", "")})

MAKERS = Table.of("makers", "maker points cells seed",
                  "closure linear divergence gradient laplacian",
                  about="Areas of one method on one set of points, range 3 a; waves as long as the box.",
                  means={"closure": ("rms of sum_j S_ij/V_i", "1/a"),
                         "linear": ("rms error of the gradients of linear fields", ""),
                         "divergence": ("rms error of a wave of pressure over its rms slope", ""),
                         "laplacian": ("the same of its Laplacian, by conduction", "")})
ORDER: dict[str, Any] = {"about": "How these errors fall with the spacing; their mean at the finest.",
                         "means": {"finest": ("mean over seeds at the finest spacing", "")}}
MAKER_ORDERS = Table.of("maker_orders", "maker points quantity", "order order_err finest finest_err", **ORDER)
WALL_HEAT = Table.of("wall_heat", "maker points cells seed", "wall",
                     about="Heat through plates with images, from a profile with Nu = 2, range 3 a.",
                     means={"cells": ("rows between the plates", ""),
                            "wall": ("rms over both plates of Nu over the exact one, less 1", "")})
WALL_ORDERS = Table.of("wall_orders", "maker points", "order order_err finest finest_err", **ORDER)

ALL = (CONTINUUM, LATTICE, EXPONENTIAL, NUMBERS, EQUATIONS, ORDERS, ONE_KERNEL, GROWTH,
       GROWTH_MEANS, EULER, NESTED_GROWTH, WAVES, COEFFICIENTS, TRANSPORT_ORDERS, SHEAR, SHEAR_MEANS,
       SHEAR_ORDERS, ENTROPY, MAKERS, MAKER_ORDERS, WALL_HEAT, WALL_ORDERS)

# --- derived tables -----------------------------------------------------------------------------------------

LEAST = 3           # least number of sizes for an order
SHORTEST = 16       # least wavelength for an order, in spacings: (h/lambda)^4 is 2 % of the error there
NORMS = ["rms", "largest"]
ROUND_OFF = 1e-10   # of sums
ERRORS = ["closure", "linear", "divergence", "gradient", "laplacian"]
NOTHING = Measured(np.nan, np.nan)


def derive(tables: Tables) -> Rows:
    """Derived rows of the study."""
    return {name: list(follows(tables[source])) for name, (source, follows) in DERIVED.items()
            if source in tables}


def groups(rows: pd.DataFrame, table: Table, by: str) -> Iterator[tuple[Row, pd.DataFrame]]:
    """The key of each row of a derived table, and the rows that it is derived from, sorted."""
    key = list(table.key)
    for values, group in rows.sort_values(by, kind="stable").groupby(key):
        yield dict(zip(key, values, strict=True)), group


def order(group: pd.DataFrame, size: str) -> Measured:
    """Order of errors in 1/size; none from too few sizes or round-off.

    All runs are in one fit, as three runs of a size estimate scatter badly.
    """
    told = group[size].nunique() >= LEAST and (group["error"].abs() > ROUND_OFF).all()
    return power_law(1/group[size], group["error"]).slope if told else NOTHING


def orders(rows: pd.DataFrame) -> Iterator[Row]:
    """One row per term: the order of its error, and its projection in the limit of zero spacing."""
    for key, group in groups(rows, ORDERS, "cells"):
        if len(group) >= LEAST:
            limit = extrapolated(1/group["cells"].to_numpy(), group["ratio"].to_numpy())
            yield key | with_errors(order=order(group, "cells"), ratio=limit)


def extrapolated(a: np.ndarray, values: np.ndarray) -> Measured:
    """Limit of values = limit + C a^2 from the two finest; error: distance from that of the two before."""
    coarse = at_zero(a[-3:-1]**2)@values[-3:-1]
    fine = at_zero(a[-2:]**2)@values[-2:]
    return Measured(fine, abs(fine - coarse))


def at_zero(x: np.ndarray) -> np.ndarray:
    """Weights of the values at x in the value at 0 of the polynomial through them."""
    return np.linalg.inv(np.vander(x))[-1]


def coefficients(waves: pd.DataFrame) -> Iterator[Row]:
    """One row per wave, means over sets of points; errors of the runs or scatter of the sets: the larger."""
    for mean in seed_means(waves, [*COEFFICIENTS.key, "continuum"], ["measured"]):
        error = Measured(mean["measured"], mean["measured_err"])/mean["continuum"] - 1
        yield mean | with_errors(error=error)


def transport_orders(waves: pd.DataFrame) -> Iterator[Row]:
    """Orders of errors in 1/wavelength, from errors that differ from zero; errors for infinite waves."""
    rows = pd.DataFrame(coefficients(waves)).query("wavelength >= @SHORTEST")
    for key, group in groups(rows, TRANSPORT_ORDERS, "wavelength"):
        sure = group[group["error"].abs() > group["error_err"]]
        limit = endless(*group[["wavelength", "error", "error_err"]].to_numpy(float).T)
        yield key | with_errors(order=order(sure, "wavelength"), long=limit)


def endless(length: np.ndarray, error: np.ndarray, err: np.ndarray) -> Measured:
    """The error for infinite waves, from error = long + c/length^2 + e/length^4 through the three longest.

    Its error: the distance from the limit of the two longest without the last term, and errors of all three.
    """
    if len(length) < LEAST:
        return NOTHING
    three, two = at_zero(length[-3:]**-2), at_zero(length[-2:]**-2)
    value = three@error[-3:]
    change = abs(value - two@error[-2:])
    return Measured(value, change + np.linalg.norm(three*err[-3:]))


def shear_orders(rows: pd.DataFrame) -> Iterator[Row]:
    """Orders of errors of shear flows in 1/rows."""
    errors = rows.melt(["flow", "points", "time", "rows"], NORMS, "norm", "error")
    for key, group in groups(errors, SHEAR_ORDERS, "rows"):
        yield key | with_errors(order=order(group, "rows"))


def maker_orders(rows: pd.DataFrame, table: Table, columns: list[str]) -> Iterator[Row]:
    """Orders of makers' errors, some columns, in 1/cells, and means over seeds at the finest spacing."""
    errors = rows.melt(["maker", "points", "cells"], columns, "quantity", "error")
    for key, group in groups(errors, table, "cells"):
        finest = group[group["cells"] == group["cells"].max()]
        mean = combine([(error, 0.0) for error in finest["error"]])
        yield key | with_errors(order=order(group, "cells"), finest=mean)


#: derived table -> its source, and the function that derives it
DERIVED: dict[str, tuple[str, Callable[[pd.DataFrame], Iterable[Row]]]] = {
    "orders": ("equations", orders),
    "growth_means": ("growth", partial(seed_means, by=GROWTH_MEANS.key, columns=["rate", "closure"])),
    "coefficients": ("waves", coefficients), "transport_orders": ("waves", transport_orders),
    "shear_means": ("shear", partial(seed_means, by=SHEAR_MEANS.key, columns=NORMS)),
    "shear_orders": ("shear", shear_orders),
    "maker_orders": ("makers", partial(maker_orders, table=MAKER_ORDERS, columns=ERRORS)),
    "wall_orders": ("wall_heat", partial(maker_orders, table=WALL_ORDERS, columns=["wall"]))}
