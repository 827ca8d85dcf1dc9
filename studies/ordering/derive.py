"""Means over seeds, slopes of errors over spacing and range, what 1 % costs."""
from collections.abc import Iterator
from math import inf
from typing import Any

import numpy as np
import pandas as pd

from studies.kit import fits
from studies.kit.ask import one
from studies.kit.csvfile import read
from studies.kit.fits import power_law
from studies.kit.stats import CannotTell, Measured, combine, seed_means
from studies.kit.sweep import RESULTS
from studies.kit.table import Tables
from studies.ordering.convection import RA
from studies.ordering.gradients import FORMS
from studies.ordering.tables import BRACKET_POINT, POINT, SERIES

OPERATORS = ("gradient", "laplacian")
WIDE = 2.0          # spacings: ranges from which on errors are a power of the range
POINTS = 4          # of a slope over waves
RESOLUTIONS = 3     # of a slope over flows
MACH = 0.05         # of the vortices of the error surface
WANTED = 0.01       # the error at which costs are compared
#: the grid of the study rb, extrapolated
GRID = {"method": "compressible", "variant": "flux-form", "eos": "ideal", "transport": "const-eta",
        "sides": "periodic", "ra": RA, "pr": 1.0, "resolution": inf}

Rows = list[dict[str, Any]]


def derive(tables: Tables) -> dict[str, Rows]:
    """Derived rows of the study."""
    return of_operators(tables) | of_brackets(tables) | of_flows(tables)


def of_operators(tables: Tables) -> dict[str, Rows]:
    """Of gradients and Laplacians of waves."""
    if "operators" not in tables:
        return {}
    rows = tables["operators"]
    means = [wave | {"a_over_h": 1/wave["h"], "h_over_lambda": wave["h"]/wave["wavelength"]}
             for wave in seed_means(rows[rows["gradient"].notna()], POINT, OPERATORS)]
    return {"means": means, "slopes": list(wave_slopes(pd.DataFrame(means)))}


def wave_slopes(means: pd.DataFrame) -> Iterator[dict[str, Any]]:
    """At fixed h/a over the wavelengths, and at a fixed wavelength over ranges of 2 spacings and more."""
    wide = means[means["h"] >= WIDE]
    for fixed, by, rows in (("h/a", "h", means), ("a", "wavelength", wide)):
        for (maker, weight, points, at), group in rows.groupby(["maker", "weight", "points", by]):
            key = {"maker": maker, "weight": weight, "points": points, "fixed": fixed, "at": at}
            for operator in OPERATORS if len(group) >= POINTS else ():
                slope = power_law(group["h_over_lambda"], group[operator]).slope
                yield {**key, "operator": operator, "slope": slope.value, "slope_err": slope.err,
                       "floor": group[operator].min()}


def of_brackets(tables: Tables) -> dict[str, Rows]:
    """Of gradients in three forms."""
    if "brackets" not in tables:
        return {}
    rows = tables["brackets"].melt([*BRACKET_POINT, "seed"], FORMS, "form", "error")
    means = list(seed_means(rows, [*BRACKET_POINT, "form"], ["error"]))
    return {"bracket_means": means, "bracket_slopes": list(bracket_slopes(pd.DataFrame(means)))}


def bracket_slopes(means: pd.DataFrame) -> Iterator[dict[str, Any]]:
    """d ln error/d ln(h/lambda) at h = 3 a."""
    for (points, form), group in means[means["h"] == 3.0].groupby(["points", "form"]):
        if len(group) > 2:
            slope = power_law(1/group["wavelength"], group["error"]).slope
            yield {"points": points, "form": form, "slope": slope.value, "slope_err": slope.err}


# --- flows: runs in one form, with flow, quantity, resolution, error with its sign, exchanges ---------------


def of_flows(tables: Tables) -> dict[str, Rows]:
    """Of vortices and convection."""
    known = reference()
    runs = pd.concat([vortices(tables), convection(tables, known)], ignore_index=True)
    if runs.empty:
        return {}
    flows = list(flow_means(runs))
    means = pd.DataFrame(flows)
    return {"reference": known, "flows": flows, "flow_slopes": list(flow_slopes(runs, means)),
            "cheapest": list(cheapest(means))}


def reference() -> Rows:
    """K of the grid of the study rb, extrapolated; none where that study has not run."""
    path = RESULTS/"rb"/"means.csv"
    if not path.exists():
        return []
    try:
        ke = one("means", "ke", **GRID)(Tables({"means": read(path)}))
    except CannotTell:
        return []
    return [{"flow": "convection", "ke": ke.value, "ke_err": ke.err}]


def vortices(tables: Tables) -> pd.DataFrame:
    """Velocity and decay of the vortices of one Mach number."""
    rows = tables.get("vortices", pd.DataFrame(columns=["mach"]))
    rows = rows[rows["mach"] == MACH].rename(columns={"wavelength": "resolution"})
    rows = rows.assign(flow="taylor-green", within=0.0)
    if rows.empty:
        return rows
    return pd.concat([rows.assign(quantity=name, error=rows[name]) for name in ("velocity", "decay")])


def convection(tables: Tables, known: Rows) -> pd.DataFrame:
    """K, with what the last tenth of a run changed; a run that ends in other rolls than two has none."""
    rows = tables.get("convection", pd.DataFrame())
    if not known or rows.empty:
        return pd.DataFrame()
    ke = known[0]["ke"]
    error = (rows["ke"]/ke - 1).where(rows["rolls"] == 2)
    exchanges = rows["exchanges"].where(rows["ke"].notna())      # none where there are no edges
    runs = rows.assign(flow="convection", quantity="K", error=error, exchanges=exchanges,
                       within=rows["ke_err"]/ke)
    return runs.rename(columns={"rows": "resolution"})


def flow_means(runs: pd.DataFrame) -> Iterator[dict[str, Any]]:
    """One row a point of the error surface."""
    key = [*SERIES, "resolution"]
    for values, group in runs.groupby(key):
        point: dict[str, Any] = dict(zip(key, values, strict=True))
        known = group[["error", "within"]].dropna()
        pairs = list(zip(known["error"], known["within"], strict=True))
        error, err = combine(pairs) if pairs else (np.nan, np.nan)
        h = point["h"]
        yield {**point, "seeds": len(group), "lost": len(group) - len(known),
               "a_over_h": 1/h if h else np.nan, "h_over_lambda": h/point["resolution"],
               "error": error, "error_err": err, "exchanges": group["exchanges"].mean()}


def flow_slopes(runs: pd.DataFrame, means: pd.DataFrame) -> Iterator[dict[str, Any]]:
    """Over resolutions and over ranges; of points where no seed is lost and the error differs from zero."""
    sure = means[(means["lost"] == 0) & (means["error"].abs() > means["error_err"])]
    runs = runs.merge(sure[[*SERIES, "resolution"]], on=[*SERIES, "resolution"])
    names = [name for name in SERIES if name != "h"]
    wide = runs[runs["h"] >= WIDE]
    for fixed, by, x, sign, rows in (("h/a", "h", "resolution", -1, runs), ("a", "resolution", "h", 1, wide)):
        for key, group in rows.groupby([*names, by]):
            number = group[x].nunique()
            if number >= RESOLUTIONS:
                slope = power_law(group[x], group["error"]).slope
                yield {**dict(zip([*names, "at"], key, strict=True)), "fixed": fixed, "number": number,
                       "slope": sign*slope.value, "slope_err": slope.err}


def cheapest(means: pd.DataFrame) -> Iterator[dict[str, Any]]:
    """Where the error comes below 1 % and stays there."""
    for key, group in means.groupby(SERIES):
        group = group.sort_values("resolution").reset_index(drop=True)
        group = group.assign(error=group["error"].abs())
        yield {**dict(zip(SERIES, key, strict=True)), **needed(group), "finest": group["error"].iloc[-1]}


def needed(group: pd.DataFrame) -> dict[str, float]:
    """Resolution and exchanges for 1 % in one series, errors without sign; none where 1 % was not reached."""
    first, number = group.iloc[0], len(group)
    above = np.flatnonzero(~(group["error"] <= WANTED) | (group["lost"] > 0))
    if not len(above):
        return {"needed": first["resolution"], "needed_err": np.nan, "exchanges": first["exchanges"],
                "bound": 1}
    last = above[-1]
    if last == number - 1 or not np.isfinite(group["error"][last]):
        return {"needed": np.nan, "needed_err": np.nan, "exchanges": np.nan, "bound": 0}
    return crossing(group.iloc[last:last + 2]) | {"bound": 0}


def crossing(pair: pd.DataFrame) -> dict[str, float]:
    """Between two resolutions with errors above and below 1 %, by a power law."""
    (coarse, fine), errs = pair["error"], pair["error_err"]/pair["error"]
    share = np.log(coarse/WANTED)/np.log(coarse/fine)
    weights = np.array([1 - share, share])
    size, exchanges = np.log(pair["resolution"].astype(float)), np.log(pair["exchanges"])
    order = np.log(coarse/fine)/np.diff(size)[0]
    resolution = float(np.exp(weights@size))
    unsure = np.hypot(*(weights*errs))/order
    return {"needed": resolution, "needed_err": float(resolution*unsure),
            "exchanges": float(np.exp(weights@exchanges))}


def line(x: np.ndarray, y: np.ndarray) -> Measured:
    """Slope of least squares; for studies that do not yet take it from kit/fits.py."""
    return fits.line(x, y).slope
