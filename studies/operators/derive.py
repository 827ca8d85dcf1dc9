"""Orders of errors, limits of fine spacings and long waves, means over seeds."""
from collections.abc import Callable, Iterator
from typing import Any

import numpy as np
import pandas as pd

from studies.kit.fits import power_law
from studies.kit.stats import Measured, seed_means
from studies.kit.table import Tables
from studies.operators.tables import FLOW, GROWN, SERIES, STREAMS, WAVE
from studies.operators.transport import ETA

LEAST = 3           # sizes of an order
SHORTEST = 16       # spacings of the waves that make an order: (h/lambda)^4 takes 2 % of the error there
NORMS = ("rms", "largest")

Rows = Iterator[dict[str, Any]]


def derive(tables: Tables) -> dict[str, list[dict[str, Any]]]:
    """Derived rows of the study."""
    rows = {name: list(made(tables[table])) for name, (table, made) in DERIVED.items() if table in tables}
    if "coefficients" in rows:
        rows["transport_orders"] = list(transport_orders(pd.DataFrame(rows["coefficients"])))
    return rows


def orders(rows: pd.DataFrame) -> Rows:
    """One row a term: the slope of its error, and its projection in the limit of no spacing."""
    key = ["d", "weight", "h", "operator"]
    for values, group in rows.groupby(key):
        if len(group) < LEAST:
            continue
        group = group.sort_values("cells")
        a = 1/group["cells"].to_numpy()
        order = power_law(a, group["error"]).slope
        limit = extrapolated(a, group["ratio"].to_numpy())
        yield {**dict(zip(key, values, strict=True)), "order": order.value, "order_err": order.err,
               "ratio": limit.value, "ratio_err": limit.err, "finest": group["error"].iloc[-1]}


def extrapolated(a: np.ndarray, values: np.ndarray) -> Measured:
    """Limit of values = limit + C a^2 from the two finest of three; error: its distance from that of the two coarser."""
    coarse, fine = ((a[n]**2*values[n + 1] - a[n + 1]**2*values[n])/(a[n]**2 - a[n + 1]**2) for n in (-3, -2))
    return Measured(float(fine), float(abs(fine - coarse)))


def stream_means(rows: pd.DataFrame) -> Rows:
    """Over sets of points."""
    return seed_means(rows, ["points", "inner"], STREAMS)


def growth_means(rows: pd.DataFrame) -> Rows:
    """Over sets of points that have such edges, and the largest of them."""
    rows = rows[rows["rate"].notna()]
    largest = rows.groupby(GROWN)["rate"].max()
    for mean in seed_means(rows, GROWN, ("rate", "closure")):
        yield mean | {"largest": largest[tuple(mean[name] for name in GROWN)]}


def coefficients(rows: pd.DataFrame) -> Rows:
    """One row a wave; errors from within the runs or from the scatter between point sets, whichever is larger."""
    rows = rows[rows["measured"].notna()]
    known = rows.groupby(WAVE)[["lattice", "continuum"]].first()
    for mean in seed_means(rows, WAVE, ["measured"]):
        lattice, continuum = known.loc[tuple(mean[name] for name in WAVE)].astype(float)
        scale, measured = continuum or ETA, mean["measured"]
        yield mean | {"lattice": lattice, "continuum": continuum, "error": (measured - continuum)/scale,
                      "error_err": mean["measured_err"]/scale, "from_lattice": (measured - lattice)/scale}


def transport_orders(rows: pd.DataFrame) -> Rows:
    """Over the wavelengths; a bulk viscosity that is zero and stays so has none."""
    for key, group in rows[rows["wavelength"] >= SHORTEST].groupby(SERIES):
        group = group.sort_values("wavelength")
        sure = group[group["error"].abs() > group["error_err"]]
        order = Measured(np.nan, np.nan)
        if len(sure) >= LEAST:
            order = power_law(1/sure["wavelength"], sure["error"]).slope
        limit = endless(*(group[name].to_numpy(float) for name in ("wavelength", "error", "error_err")))
        yield {**dict(zip(SERIES, key, strict=True)), "order": order.value, "order_err": order.err,
               "long": limit.value, "long_err": limit.err}


def endless(length: np.ndarray, error: np.ndarray, err: np.ndarray) -> Measured:
    """The error for endless waves, from error = long + c/length^2 + e/length^4 through the three longest.

    Its own error: its distance from what the two longest give without the last term, and the errors of all three.
    """
    if len(length) < LEAST:
        return Measured(np.nan, np.nan)
    three, two = (at_zero(length[-n:]**-2) for n in (3, 2))
    value = three@error[-3:]
    change = abs(value - two@error[-2:])
    return Measured(float(value), float(change + np.sqrt(np.sum((three*err[-3:])**2))))


def at_zero(x: np.ndarray) -> np.ndarray:
    """Weights of the values at x in the value at 0 of the polynomial through them."""
    return np.linalg.inv(np.vander(x))[-1]


def shear_means(rows: pd.DataFrame) -> Rows:
    """Over sets of points; on a lattice there is one and no scatter."""
    return seed_means(rows, [*FLOW, "time"], NORMS)


def shear_orders(rows: pd.DataFrame) -> Rows:
    """Over the numbers of rows, all runs in one fit: they show one scatter, which three runs of a size show badly."""
    for (flow, points, time), group in rows.groupby(["flow", "points", "time"]):
        for norm in NORMS if group["rows"].nunique() >= LEAST else ():
            order = power_law(1/group["rows"], group[norm]).slope
            yield {"flow": flow, "points": points, "time": time, "norm": norm, "order": order.value,
                   "order_err": order.err}


#: derived table -> the table it is made of, and how
DERIVED: dict[str, tuple[str, Callable[[pd.DataFrame], Rows]]] = {
    "orders": ("equations", orders), "stream_means": ("stream", stream_means),
    "growth_means": ("growth", growth_means),
    "coefficients": ("waves", coefficients), "shear_means": ("shear", shear_means),
    "shear_orders": ("shear", shear_orders)}
