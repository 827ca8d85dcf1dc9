"""Errors of whole flows: means over seeds, slopes over the spacing and the range of the weight, what 1 % costs."""
from collections.abc import Iterator
from typing import Any

import numpy as np
import pandas as pd

from studies.build.read import limit
from studies.kit.claim import CannotTell
from studies.kit.stats import combine
from studies.kit.sweep import load
from studies.kit.table import Tables
from studies.ordering.convection import RA
from studies.ordering.derive import line
from studies.ordering.tables import SERIES
from studies.rb.tables import KINETIC, MEANS

MACH = 0.05         # of the vortices of the surface
LEAST = 3           # resolutions, or ranges, of a slope
WIDE = 2.0          # spacings: narrower weights reach the nearest neighbours only, whatever their range
WANTED = 0.01       # the error at which costs are compared


def derive(tables: Tables) -> dict[str, list[dict[str, Any]]]:
    """Derived rows of the flows."""
    known = reference()
    runs = pd.concat([vortices(tables), convection(tables, known)], ignore_index=True)
    if runs.empty:
        return {}
    means = pd.DataFrame(list(over_seeds(runs)))
    return {"reference": known, "flows": list(over_seeds(runs)), "flow_slopes": list(slopes(runs, means)),
            "cheapest": list(cheapest(means))}


def reference() -> list[dict[str, Any]]:
    """K of the grid of study rb, extrapolated; none where that study has not run."""
    try:
        ke = limit(load([MEANS, KINETIC], "rb"), RA)
    except CannotTell:
        return []
    return [{"flow": "convection", "ke": ke.value, "ke_err": ke.err}]


# --- runs in one form: flow, quantity, .., resolution, error with its sign, exchanges ---------------------------------------


def vortices(tables: Tables) -> pd.DataFrame:
    """Velocity and decay of the vortices of one Mach number."""
    rows = tables.get("vortices", pd.DataFrame(columns=["mach"]))
    rows = rows[rows["mach"] == MACH].assign(flow="taylor-green", within=0.0).rename(columns={"wavelength": "resolution"})
    return pd.concat([rows.assign(quantity=name, error=rows[name]) for name in ("velocity", "decay")]) if len(rows) else rows


def convection(tables: Tables, known: list[dict[str, Any]]) -> pd.DataFrame:
    """K, with what the last tenth of a run changed; a run that ends in other rolls than two has none."""
    rows = tables.get("convection", pd.DataFrame())
    if not known or rows.empty:
        return pd.DataFrame()
    error = (rows["ke"]/known[0]["ke"] - 1).where(rows["rolls"] == 2)
    told = rows["exchanges"].where(rows["ke"].notna())      # none where there are no edges
    return rows.assign(flow="convection", quantity="K", error=error, exchanges=told,
                       within=rows["ke_err"]/known[0]["ke"]).rename(columns={"rows": "resolution"})


# --- what follows -----------------------------------------------------------------------------------------------------


def over_seeds(runs: pd.DataFrame) -> Iterator[dict[str, Any]]:
    """One row a point of the surface."""
    for key, group in runs.groupby([*SERIES, "resolution"]):
        told, h = group[["error", "within"]].dropna(), group["h"].iloc[0]
        error, err = combine(list(zip(told["error"], told["within"], strict=True))) if len(told) else (np.nan, np.nan)
        yield {**dict(zip([*SERIES, "resolution"], key, strict=True)), "seeds": len(group), "lost": len(group) - len(told),
               "a_over_h": 1/h if h else np.nan, "h_over_lambda": h/group["resolution"].iloc[0], "error": error,
               "error_err": err, "exchanges": group["exchanges"].mean()}


def slopes(runs: pd.DataFrame, means: pd.DataFrame) -> Iterator[dict[str, Any]]:
    """Over resolutions and over ranges; of points where no seed was lost and the error is told from zero."""
    sure = means[(means["lost"] == 0) & (means["error"].abs() > means["error_err"])]
    runs = runs.merge(sure[[*SERIES, "resolution"]], on=[*SERIES, "resolution"])
    named = [name for name in SERIES if name != "h"]
    for fixed, by, x, some in (("h/a", "h", "resolution", runs), ("a", "resolution", "h", runs[runs["h"] >= WIDE])):
        for key, group in some.groupby([*named, by]):
            if group[x].nunique() < LEAST:
                continue
            slope, err = line(np.log(group[x].to_numpy(float)), np.log(group["error"].abs().to_numpy()))
            yield {**dict(zip([*named, "at"], key, strict=True)), "fixed": fixed, "number": group[x].nunique(),
                   "slope": -slope if fixed == "h/a" else slope, "slope_err": err}


def cheapest(means: pd.DataFrame) -> Iterator[dict[str, Any]]:
    """Where the error comes below 1 % and stays there, between resolutions by a power law."""
    for key, group in means.groupby(SERIES):
        group = group.sort_values("resolution")
        error, err = (group[name].abs().to_numpy() for name in ("error", "error_err"))
        above = np.flatnonzero(~(error <= WANTED) | (group["lost"].to_numpy() > 0))
        found = {"needed": np.nan, "needed_err": np.nan, "exchanges": np.nan, "bound": 0, "finest": error[-1]}
        if len(above) == 0:
            found |= {"needed": float(group["resolution"].iloc[0]), "exchanges": float(group["exchanges"].iloc[0]), "bound": 1}
        elif above[-1] < len(group) - 1 and np.isfinite(error[above[-1]]):
            found |= crossing(group.iloc[above[-1]:above[-1] + 2], error[above[-1]:above[-1] + 2], err[above[-1]:above[-1] + 2])
        yield {**dict(zip(SERIES, key, strict=True)), **found}


def crossing(pair: pd.DataFrame, error: np.ndarray, err: np.ndarray) -> dict[str, float]:
    """Resolution and exchanges between two, whose errors are above and below 1 %."""
    share = np.log(error[0]/WANTED)/np.log(error[0]/error[1])
    size, exchanges = (np.log(pair[name].to_numpy(float)) for name in ("resolution", "exchanges"))
    steep = np.log(error[0]/error[1])/(size[1] - size[0])
    needed = float(np.exp(size[0] + share*(size[1] - size[0])))
    unsure = np.hypot((1 - share)*err[0]/error[0], share*err[1]/error[1])/steep
    return {"needed": needed, "needed_err": float(needed*unsure),
            "exchanges": float(np.exp(exchanges[0] + share*(exchanges[1] - exchanges[0])))}
