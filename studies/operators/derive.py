"""Orders of errors, limits of fine spacings and long waves, means over seeds."""
from collections.abc import Iterator
from typing import Any

import numpy as np
import pandas as pd

from studies.kit.fits import power_law
from studies.kit.stats import Measured, seed_means
from studies.kit.table import Table, Tables
from studies.operators.tables import (
    COEFFICIENTS,
    GROWTH_MEANS,
    ORDERS,
    SHEAR_MEANS,
    SHEAR_ORDERS,
    TRANSPORT_ORDERS,
)

LEAST = 3           # sizes of an order
SHORTEST = 16       # spacings of the waves that make an order: (h/lambda)^4 takes 2 % of the error there
NORMS = ("rms", "largest")
NOTHING = Measured(np.nan, np.nan)

Rows = Iterator[dict[str, Any]]


def derive(tables: Tables) -> dict[str, list[dict[str, Any]]]:
    """Derived rows of the study."""
    rows: dict[str, list[dict[str, Any]]] = {}
    if "equations" in tables:
        rows["orders"] = list(orders(tables["equations"]))
    if "growth" in tables:
        rows["growth_means"] = list(growth_means(tables["growth"]))
    if "waves" in tables:
        rows["coefficients"] = list(coefficients(tables["waves"]))
        rows["transport_orders"] = list(transport_orders(pd.DataFrame(rows["coefficients"])))
    if "shear" in tables:
        rows["shear_means"] = list(seed_means(tables["shear"], SHEAR_MEANS.key, NORMS))
        rows["shear_orders"] = list(shear_orders(tables["shear"]))
    return rows


def groups(rows: pd.DataFrame, table: Table, by: str) -> Iterator[tuple[dict[str, Any], pd.DataFrame]]:
    """The key of each row of a table, and the rows that it comes from, sorted."""
    key = list(table.key)
    for values, group in rows.sort_values(by, kind="stable").groupby(key):
        yield dict(zip(key, values, strict=True)), group


def orders(rows: pd.DataFrame) -> Rows:
    """One row a term: the slope of its error, and its projection in the limit of no spacing."""
    for key, group in groups(rows, ORDERS, "cells"):
        if len(group) >= LEAST:
            a = 1/group["cells"].to_numpy()
            order = power_law(a, group["error"]).slope
            ratio = extrapolated(a, group["ratio"].to_numpy())
            yield key | {"order": order.value, "order_err": order.err,
                         "ratio": ratio.value, "ratio_err": ratio.err}


def extrapolated(a: np.ndarray, values: np.ndarray) -> Measured:
    """Limit of values = limit + C a^2 from the two finest; error: the distance to that of the two before."""
    coarse = at_zero(a[-3:-1]**2)@values[-3:-1]
    fine = at_zero(a[-2:]**2)@values[-2:]
    return Measured(float(fine), float(abs(fine - coarse)))


def at_zero(x: np.ndarray) -> np.ndarray:
    """Weights of the values at x in the value at 0 of the polynomial through them."""
    return np.linalg.inv(np.vander(x))[-1]


def growth_means(rows: pd.DataFrame) -> Rows:
    """Over sets of points, and the largest of them."""
    key = list(GROWTH_MEANS.key)
    largest = rows.groupby(key)["rate"].max()
    for mean in seed_means(rows, key, ("rate", "closure")):
        yield mean | {"largest": largest[tuple(mean[name] for name in key)]}


def coefficients(rows: pd.DataFrame) -> Rows:
    """One row a wave; errors from within the runs or from the scatter between point sets: the larger."""
    for mean in seed_means(rows, [*COEFFICIENTS.key, "continuum"], ["measured"]):
        measured, exact = mean["measured"], mean["continuum"]
        yield mean | {"error": (measured - exact)/exact, "error_err": mean["measured_err"]/exact}


def transport_orders(rows: pd.DataFrame) -> Rows:
    """Over the wavelengths where the error is told from zero."""
    rows = rows[rows["wavelength"] >= SHORTEST]
    for key, group in groups(rows, TRANSPORT_ORDERS, "wavelength"):
        sure = group[group["error"].abs() > group["error_err"]]
        order = power_law(1/sure["wavelength"], sure["error"]).slope if len(sure) >= LEAST else NOTHING
        length, error, err = group[["wavelength", "error", "error_err"]].to_numpy(float).T
        limit = endless(length, error, err)
        yield key | {"order": order.value, "order_err": order.err, "long": limit.value, "long_err": limit.err}


def endless(length: np.ndarray, error: np.ndarray, err: np.ndarray) -> Measured:
    """The error for endless waves, from error = long + c/length^2 + e/length^4 through the three longest.

    Its error: the distance to what the two longest give without the last term, and the errors of all three.
    """
    if len(length) < LEAST:
        return NOTHING
    three, two = at_zero(length[-3:]**-2), at_zero(length[-2:]**-2)
    value = three@error[-3:]
    change = abs(value - two@error[-2:])
    known = np.sqrt(np.sum((three*err[-3:])**2))
    return Measured(float(value), float(change + known))


def shear_orders(rows: pd.DataFrame) -> Rows:
    """Over the numbers of rows, all runs in one fit: three runs of a size show their scatter badly."""
    errors = rows.melt(["flow", "points", "time", "rows"], NORMS, "norm", "error")
    for key, group in groups(errors, SHEAR_ORDERS, "rows"):
        if group["rows"].nunique() >= LEAST:
            order = power_law(1/group["rows"], group["error"]).slope
            yield key | {"order": order.value, "order_err": order.err}
