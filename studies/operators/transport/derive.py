"""Means over seeds, and orders of errors, of the study transport."""
from collections.abc import Iterator
from typing import Any

import numpy as np
import pandas as pd

from studies.kit.stats import Measured, combine
from studies.kit.table import Tables
from studies.operators.transport.tables import FLOW, SERIES, WAVE
from studies.operators.transport.waves import ETA
from studies.ordering.derive import line

SHORTEST = 16       # spacings of the waves that make an order: (h/lambda)^4 takes 2 % of the error there
LEAST = 3           # points of an order
NORMS = ("rms", "largest")


def derive(tables: Tables) -> dict[str, list[dict[str, Any]]]:
    """Derived rows of the study."""
    found: dict[str, list[dict[str, Any]]] = {}
    if "waves" in tables:
        rows = tables["waves"]
        found["coefficients"] = list(coefficients(rows[rows["measured"].notna()]))
        found["transport_orders"] = list(orders(pd.DataFrame(found["coefficients"])))
    if "shear" in tables:
        found["shear_means"] = list(shear_means(tables["shear"]))
        found["shear_orders"] = list(shear_orders(tables["shear"]))
    return found


def coefficients(rows: pd.DataFrame) -> Iterator[dict[str, Any]]:
    """One row a wave; errors from within the runs or from the scatter between point sets, whichever is larger."""
    for key, group in rows.groupby(WAVE):
        value, err = combine(list(zip(group["measured"], group["measured_err"], strict=True)))
        first = group.iloc[0]
        scale = first["continuum"] or ETA
        yield {**dict(zip(WAVE, key, strict=True)), "seeds": len(group), "measured": value, "measured_err": err,
               "lattice": first["lattice"], "continuum": first["continuum"], "error": (value - first["continuum"])/scale,
               "error_err": err/scale, "from_lattice": (value - first["lattice"])/scale}


def orders(rows: pd.DataFrame) -> Iterator[dict[str, Any]]:
    """Over the wavelengths; a bulk viscosity that is zero and stays so has none."""
    for key, group in rows[rows["wavelength"] >= SHORTEST].groupby([*SERIES, "quantity"]):
        group = group.sort_values("wavelength")
        told = group[np.abs(group["error"]) > group["error_err"]]
        length, error = (told[name].to_numpy() for name in ("wavelength", "error"))
        order, err = line(-np.log(length), np.log(np.abs(error))) if len(told) >= LEAST else (np.nan, np.nan)
        limit = endless(*(group[name].to_numpy(float) for name in ("wavelength", "error", "error_err")))
        yield {**dict(zip([*SERIES, "quantity"], key, strict=True)), "order": order, "order_err": err, "long": limit.value,
               "long_err": limit.err}


def endless(length: np.ndarray, error: np.ndarray, err: np.ndarray) -> Measured:
    """The error for endless waves, from error = long + c/length^2 + e/length^4 through the three longest.

    Its own error: what the two longest alone, without the last term, say otherwise, and the errors of all three.
    """
    if len(length) < LEAST:
        return Measured(np.nan, np.nan)
    three, two = (through(length[-n:]**-2) for n in (3, 2))
    value = three@error[-3:]
    return Measured(float(value), float(abs(value - two@error[-2:]) + np.sqrt(np.sum((three*err[-3:])**2))))


def through(x: np.ndarray) -> np.ndarray:
    """What the values at x weigh in the value at 0 of the polynomial through them."""
    return np.linalg.inv(np.vander(x))[-1]


def shear_means(rows: pd.DataFrame) -> Iterator[dict[str, Any]]:
    """Over seeds; on a lattice there is one and no scatter."""
    for key, group in rows.groupby([*FLOW, "time"]):
        found = {norm: combine([(value, 0.0) for value in group[norm]]) for norm in NORMS}
        yield {**dict(zip([*FLOW, "time"], key, strict=True)), "seeds": len(group), **{n: found[n].value for n in NORMS},
               **{f"{n}_err": found[n].err for n in NORMS}}


def shear_orders(rows: pd.DataFrame) -> Iterator[dict[str, Any]]:
    """Over the numbers of rows, all runs in one fit: they tell one scatter, which three runs of a size tell badly."""
    for key, group in rows.groupby(["flow", "points", "time"]):
        for norm in NORMS if group["rows"].nunique() >= LEAST else ():
            order, err = line(-np.log(group["rows"].to_numpy()), np.log(group[norm].to_numpy()))
            yield {**dict(zip(("flow", "points", "time"), key, strict=True)), "norm": norm, "order": order, "order_err": err}
