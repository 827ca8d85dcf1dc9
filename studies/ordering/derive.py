"""Means over seeds, slopes of errors over spacing and range, what 1 % costs."""
from collections.abc import Iterator, Sequence
from math import inf
from typing import Any

import numpy as np
import pandas as pd

from studies.kit.ask import one
from studies.kit.csvfile import read
from studies.kit.fits import power_law
from studies.kit.stats import CannotTell, seed_means
from studies.kit.sweep import RESULTS
from studies.kit.table import Tables
from studies.ordering.runs import FORMS, RA
from studies.ordering.tables import BRACKET_MEANS, BRACKETS, CHEAPEST, FLOWS, MEANS

OPERATORS = ("gradient", "laplacian")
WIDE = 2.0          # spacings: ranges from which on errors are a power of the range
POINTS = 4          # of a slope over waves
RESOLUTIONS = 3     # of a slope over flows, and over forms of the gradient
WANTED = 0.01       # the error at which costs are compared
#: the grid of the study rb, extrapolated
GRID = {"method": "compressible", "variant": "flux-form", "eos": "ideal", "transport": "const-eta",
        "sides": "periodic", "ra": RA, "pr": 1.0, "resolution": inf}
FLOW_POINT = list(FLOWS.key)

Rows = list[dict[str, Any]]


def derive(tables: Tables) -> dict[str, Rows]:
    """Derived rows of the study."""
    rows = of_flows(tables)
    if "operators" in tables:
        rows |= of_operators(tables["operators"])
    if "brackets" in tables:
        rows |= of_brackets(tables["brackets"])
    return rows


def slopes(rows: pd.DataFrame, key: Sequence[str], x: str, least: int) -> Iterator[dict[str, Any]]:
    """d ln error/d ln x of each group with so many x."""
    for values, group in rows.groupby(list(key)):
        if group[x].nunique() >= least:
            slope = power_law(group[x], group["error"]).slope
            common = dict(zip(key, values, strict=True))
            yield common | {"slope": slope.value, "slope_err": slope.err}


def of_operators(rows: pd.DataFrame) -> dict[str, Rows]:
    """Of gradients and Laplacians of waves: slopes over wavelengths, and over ranges from 2 spacings on."""
    means = list(seed_means(rows[rows["gradient"].notna()], MEANS.key, OPERATORS))
    errors = pd.DataFrame(means).melt(MEANS.key, OPERATORS, "operator", "error")
    errors = errors.assign(ratio=errors["h"]/errors["wavelength"])
    finer = wave_slopes(errors, "h/a", "h")
    wider = wave_slopes(errors[errors["h"] >= WIDE], "a", "wavelength")
    return {"means": means, "slopes": [*finer, *wider]}


def wave_slopes(errors: pd.DataFrame, fixed: str, at: str) -> Iterator[dict[str, Any]]:
    """Slopes in h/lambda with the least error of each."""
    errors = errors.assign(fixed=fixed, at=errors[at])
    key = ["maker", "points", "operator", "fixed", "at"]
    floors = errors.groupby(key)["error"].min()
    for row in slopes(errors, key, "ratio", POINTS):
        yield row | {"floor": floors[tuple(row[name] for name in key)]}


def of_brackets(rows: pd.DataFrame) -> dict[str, Rows]:
    """Of gradients in three forms; slopes at h = 3 a."""
    errors = rows.melt(BRACKETS.key, FORMS, "form", "error")
    means = list(seed_means(errors, BRACKET_MEANS.key, ["error"]))
    frame = pd.DataFrame(means)
    frame = frame[frame["h"] == 3.0].assign(ratio=1/frame["wavelength"])
    orders = slopes(frame, ["points", "form"], "ratio", RESOLUTIONS)
    return {"bracket_means": means, "bracket_slopes": list(orders)}


def of_flows(tables: Tables) -> dict[str, Rows]:
    """Of vortices and convection."""
    known = reference()
    runs = pd.concat([vortices(tables), convection(tables, known)], ignore_index=True)
    if runs.empty:
        return {}
    means = flow_means(runs)
    rows: Any = means.to_dict("records")
    return {"reference": known, "flows": rows, "flow_slopes": list(flow_slopes(runs, means)),
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
    """Errors of the velocity."""
    rows = tables.get("vortices", pd.DataFrame())
    rows = rows.rename(columns={"wavelength": "resolution", "velocity": "error"})
    return rows.assign(flow="taylor-green", error_err=0.0)


def convection(tables: Tables, known: Rows) -> pd.DataFrame:
    """Errors of K, with what the last tenth of a run changed; none of a run that ends in other rolls."""
    rows = tables.get("convection", pd.DataFrame())
    if not known or rows.empty:
        return pd.DataFrame()
    ke = known[0]["ke"]
    error = (rows["ke"]/ke - 1).where(rows["rolls"] == 2)
    exchanges = rows["exchanges"].where(rows["ke"].notna())      # none where there are no edges
    rows = rows.assign(flow="convection", error=error, error_err=rows["ke_err"]/ke, exchanges=exchanges)
    return rows.rename(columns={"rows": "resolution"})


def flow_means(runs: pd.DataFrame) -> pd.DataFrame:
    """One row a point of the error surface."""
    there = seed_means(runs.dropna(subset="error"), FLOW_POINT, ["error"])
    errors = pd.DataFrame(there, columns=[*FLOW_POINT, "seeds", "error", "error_err"])
    all_runs = runs.groupby(FLOW_POINT, as_index=False)
    means = all_runs.agg(number=("seed", "size"), exchanges=("exchanges", "mean"))
    means = means.merge(errors, on=FLOW_POINT, how="left")
    lost = means["number"] - means["seeds"].fillna(0).astype(int)
    return means.assign(seeds=means["number"], lost=lost).drop(columns="number")


def flow_slopes(runs: pd.DataFrame, means: pd.DataFrame) -> Iterator[dict[str, Any]]:
    """Over resolutions and over ranges; of points where no seed is lost and the error differs from zero."""
    sure = means[(means["lost"] == 0) & (means["error"].abs() > means["error_err"])]
    runs = runs.merge(sure[FLOW_POINT], on=FLOW_POINT)
    runs = runs.assign(spacing=1/runs["resolution"])
    key = ["flow", "maker", "points", "fixed", "at"]
    yield from slopes(runs.assign(fixed="h/a", at=runs["h"]), key, "spacing", RESOLUTIONS)
    wide = runs[runs["h"] >= WIDE]
    yield from slopes(wide.assign(fixed="a", at=wide["resolution"]), key, "h", RESOLUTIONS)


def cheapest(means: pd.DataFrame) -> Iterator[dict[str, Any]]:
    """Where the error comes below 1 % and stays there."""
    means = means.assign(error=means["error"].abs()).sort_values("resolution")
    for values, group in means.groupby(list(CHEAPEST.key)):
        key = dict(zip(CHEAPEST.key, values, strict=True))
        yield key | needed(group) | {"finest": group["error"].iloc[-1]}


def needed(group: pd.DataFrame) -> dict[str, float]:
    """Resolution and exchanges for 1 % in one series, errors without sign; none where 1 % was not reached."""
    above = np.flatnonzero(~(group["error"] <= WANTED) | (group["lost"] > 0))
    if not len(above):
        first = group.iloc[0]
        return {"needed": first["resolution"], "needed_err": np.nan,
                "exchanges": first["exchanges"], "bound": 1}
    pair = group.iloc[above[-1]:above[-1] + 2]
    if len(pair) < 2 or not np.isfinite(pair["error"].iloc[0]):
        return {"needed": np.nan, "needed_err": np.nan, "exchanges": np.nan, "bound": 0}
    return crossing(pair) | {"bound": 0}


def crossing(pair: pd.DataFrame) -> dict[str, float]:
    """Between two resolutions with errors above and below 1 %, by a power law."""
    coarse, fine = pair["error"]
    size = np.log(pair["resolution"].astype(float))
    exchanges = np.log(pair["exchanges"])
    share = np.log(coarse/WANTED)/np.log(coarse/fine)
    weights = np.array([1 - share, share])
    order = np.log(coarse/fine)/np.diff(size)[0]
    unsure = np.hypot(*(weights*pair["error_err"]/pair["error"]))/order
    resolution = float(np.exp(weights@size))
    return {"needed": resolution, "needed_err": float(resolution*unsure),
            "exchanges": float(np.exp(weights@exchanges))}
