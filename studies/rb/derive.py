"""Rows that follow from other rows: grids extrapolated, means over seeds, errors against the reference."""
from collections.abc import Iterator
from typing import Any

import numpy as np
import pandas as pd

from studies.build.names import one_energy
from studies.build.spam import VARIANTS
from studies.kit import fits
from studies.kit.stats import combine
from studies.kit.table import Rows, Tables
from studies.rb.snapshots import field_errors, snapshots
from studies.rb.tables import POINT, SCENE, STEP, STILL

GRIDS = ("compressible", "boussinesq", "pypde-boussinesq", "pypde-compressible")
SERIES = [name for name in POINT if name != "resolution"]
ENERGIES = ["ke", "ke_field", "ke_mean", "nu"]
HALF = "printed-half-step"


def derive(tables: Tables) -> Rows:
    """All derived rows of the study."""
    if "kinetic_energy" not in tables:
        return {}
    runs = finite(tables["kinetic_energy"])
    runs = runs[runs["ke"].notna()]
    limits = list(extrapolated(runs))
    means = pd.DataFrame(over_seeds(pd.concat([runs, pd.DataFrame(limits)], ignore_index=True)))
    return {"kinetic_energy": limits, "means": records(means), "errors": records(errors(runs, means, tables)),
            "snapshots": list(snapshots(tables)), "field_errors": list(field_errors(tables, means))}


def finite(frame: pd.DataFrame) -> pd.DataFrame:
    """Rows that are not extrapolated."""
    return frame[np.isfinite(frame["resolution"].astype(float))] if len(frame) else frame


def records(frame: pd.DataFrame) -> list[dict[str, Any]]:
    """Rows of a table."""
    return [{str(name): value for name, value in row.items()} for row in frame.to_dict("records")]


# --- infinitely fine ------------------------------------------------------------------------------


def extrapolated(runs: pd.DataFrame) -> Iterator[dict[str, Any]]:
    """One row `resolution = inf` of each series of grids or points with three settled sizes or more, one
    state in all.

    Grids and lattices have no chance in them; of sets of points that differ each run counts by itself.
    """
    steady = runs["converged"].astype(str).eq("True") & runs["method"].isin([*GRIDS, "dih"])
    for point, group in runs[steady].sort_values("resolution").groupby(SERIES, dropna=False):
        sizes = group["resolution"].to_numpy(float)
        if len(set(sizes)) < 3 or group["rolls"].nunique() > 1:
            continue
        limit = grid_limit if len(set(sizes)) == len(sizes) else line_limit
        ke, nu = (limit(group[name], group[f"{name}_err"], sizes) for name in ("ke", "nu"))
        kept = {name: group[name].iloc[-1] for name in ("rolls", "free_fall", "converged", "threads")}
        seconds = {name: group[name].sum() for name in ("cpu_s", "compile_s")}
        yield {**dict(zip(SERIES, point, strict=True)), **kept, **seconds, "seed": 0, "particles": 0,
               "resolution": np.inf, **one_energy(*ke), "nu": nu[0], "nu_err": nu[1]}


def grid_limit(values: pd.Series, errs: pd.Series, sizes: np.ndarray) -> tuple[float, float]:
    """Extrapolated value; its error has a part of the grid and one of the values' own (in time)."""
    limit = fits.grid_limit(sizes, values)
    return limit.value, float(np.hypot(limit.err, 2*errs.max()))


def line_limit(values: pd.Series, errs: pd.Series, sizes: np.ndarray) -> tuple[float, float]:
    """Value at 1/rows^2 = 0 of a line through all runs; its error: of the fit, and twice what the coarsest
    change.

    K of sets of points scatters as 1/rows^2 or faster, 0.6 % to 0.04 % from 25 to 50 rows: hence weights of
    rows^2. One scatter stands for all that is left over, which three runs of one size tell badly.
    """
    x, weight, finer = 1/sizes**2, sizes**2, sizes > sizes.min()
    limit = fits.line(x, values, weight=weight).intercept
    without = np.polyfit(x[finer], values[finer], 1, w=weight[finer])[1]
    return limit.value, float(np.hypot(limit.err, 2*(limit.value - without)))


# --- means over seeds -----------------------------------------------------------------------------


def over_seeds(runs: pd.DataFrame) -> Iterator[dict[str, Any]]:
    """Means over the seeds of each point that settled in its commonest number of rolls; grid rows pass as
    they are.

    To the error of particles belongs twice what half of the time step changes: its error is of first order,
    from the walls.
    """
    changes = step_changes(runs)
    for point, group in runs.groupby(POINT, dropna=False):
        row = dict(zip(POINT, point, strict=True))
        same = group[group["rolls"] == group["rolls"].mode().iloc[0]]
        change = step_change(changes, row)
        for name in ENERGIES:
            value, err = combine(list(zip(same[name], same[f"{name}_err"], strict=True)))
            row |= {name: value, f"{name}_err": float(np.hypot(err, 2*value*change[name]))}
        first = same[["particles", "rolls"]].iloc[0].to_dict()
        yield {**row, **first, "seeds": len(same), "mixed": len(group) - len(same),
               "ke_fluctuation": same["ke_fluctuation"].mean()}


def step_changes(runs: pd.DataFrame) -> pd.DataFrame:
    """How much of each energy half of the time step changes, relative, by scene and resolution."""
    by_point = [*SCENE, "resolution"]
    half, whole = (runs[runs["variant"] == name].groupby(by_point, dropna=False)[ENERGIES].mean()
                   for name in (HALF, "printed"))
    return (half/whole - 1).abs().dropna().reset_index()


def step_change(changes: pd.DataFrame, row: dict[str, Any]) -> pd.Series:
    """That of the next coarser resolution of the same fluid and box, or else of any; none for grids and points."""
    coarser = changes[changes["resolution"] <= float(row["resolution"])]
    alike = coarser[(coarser["eos"] == row["eos"]) & (coarser["sides"] == row["sides"])]
    chosen = alike if len(alike) else coarser
    if row["method"] != "spam" or chosen.empty:
        return pd.Series(0.0, ENERGIES)
    finest_first = chosen.sort_values("resolution", ascending=False, kind="stable")
    return finest_first[ENERGIES].iloc[0]


# --- errors and costs -----------------------------------------------------------------------------


def errors(runs: pd.DataFrame, means: pd.DataFrame, tables: Tables) -> pd.DataFrame:
    """Relative errors of K and Nu against the compressible limit of the scene, with what they cost.

    Kp, of all particles, is compared with the grid's K; Kg, of the smoothed field, with K of the grid's field
    smoothed by the same weight: smoothing alone is no error of the flow.
    """
    grid = (means["method"] == "compressible") & (means["variant"] == "flux-form") & (means["ke"] > STILL)
    limits = means[grid & np.isinf(means["resolution"].astype(float))]
    limits = limits[[*SCENE, "ke", "ke_err", "nu", "nu_err", "rolls"]]
    rows = finite(means[means["eos"] != ""]).merge(limits, on=SCENE, suffixes=("", "_limit"))
    same_flow = rows["rolls"] == rows["rolls_limit"]
    rows = rows[(rows["method"] == "spam") | same_flow]
    rows = rows.merge(spent(runs, tables), on=POINT)
    field = with_smoothing(rows, tables)
    return pd.concat([compared(rows, "Nu", "nu", "nu"), compared(rows, "Kp", "ke", "ke"),
                      compared(field, "Kg", "ke_field", "ke", field["left"])])


def compared(rows: pd.DataFrame, energy: str, column: str, limit: str, left: Any = 1.0) -> pd.DataFrame:
    """Rows of the table `errors`: a column against the grid's limit, of which smoothing has `left` a part."""
    ke, ke_err = rows[column], rows[f"{column}_err"]
    reference, reference_err = rows[f"{limit}_limit"]*left, rows[f"{limit}_err_limit"]*left
    error_err = np.hypot(ke_err, ke/reference*reference_err)/reference
    return rows[[*POINT, "particles", "cpu_s"]].assign(
        energy=energy, ke=ke, ke_err=ke_err, reference=reference, reference_err=reference_err,
        error=ke/reference - 1, error_err=error_err)


def with_smoothing(rows: pd.DataFrame, tables: Tables) -> pd.DataFrame:
    """Rows of particles with what their weight leaves of the K of the grid's field."""
    spam = rows[rows["method"] == "spam"]
    if "smoothed" not in tables:
        return spam[:0].assign(left=1.0)
    views = [VARIANTS[name] for name in spam["variant"]]
    spam = spam.assign(weight=[view.weight.__name__ for view in views], h=[view.h for view in views])
    seen = tables["smoothed"]
    seen = seen.assign(left=seen["ke_smoothed"]/seen["ke"], resolution=seen["rows"])
    key = [*SCENE, "weight", "h", "resolution"]
    return spam.merge(seen[[*key, "left"]].drop_duplicates(key, keep="last"), on=key)


def spent(runs: pd.DataFrame, tables: Tables) -> pd.DataFrame:
    """CPU seconds of what a mean is made of: all seeds of particles and points; of grids with the coarser
    ones.

    Steps times the seconds of one step measured alone where there is such a row, else what the run took
    beside others.
    """
    alone = tables.get("cost", pd.DataFrame(columns=[*STEP, "step_s"]))
    runs = runs.merge(alone[[*STEP, "step_s"]].astype({"resolution": float}), how="left", on=STEP)
    runs["cpu_s"] = (runs["steps"]*runs["step_s"].astype(float)).fillna(runs["cpu_s"])
    seconds = runs.groupby(POINT, dropna=False)["cpu_s"].sum().reset_index()
    grids = seconds["method"].isin(GRIDS)
    seconds.loc[grids, "cpu_s"] = seconds[grids].groupby(SERIES, dropna=False)["cpu_s"].cumsum()
    return seconds
