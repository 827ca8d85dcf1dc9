"""Rows that follow from other rows: grids extrapolated, means over seeds, errors against the reference."""
from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np
import pandas as pd
from scipy.special import stdtrit

from continuum.richardson import richardson
from studies.build.names import one_energy
from studies.build.spam import VARIANTS
from studies.kit.stats import combine
from studies.kit.table import Tables
from studies.rb.snapshots import field_errors, snapshots
from studies.rb.tables import POINT

GRIDS = ("compressible", "boussinesq", "pypde-boussinesq", "pypde-compressible")
MACHINE = ["method", "variant", "eos", "sides", "resolution"]
SERIES = [name for name in POINT if name != "resolution"]
SCENE = ["eos", "transport", "sides", "ra", "pr"]
ENERGIES = ("ke", "ke_field", "ke_mean", "nu")
HALF = "printed-half-step"
STILL = 1e-6        # K of a grid that does not convect


def derive(tables: Tables) -> dict[str, list[dict[str, Any]]]:
    """All derived rows of the study."""
    if "kinetic_energy" not in tables:
        return {}
    runs = finite(tables["kinetic_energy"])
    limits = [*extrapolated(runs), *extrapolated_points(runs)]
    everything = pd.concat([runs, pd.DataFrame(limits)], ignore_index=True) if limits else runs
    means = list(over_seeds(everything))
    frame = pd.DataFrame(means)
    return {"kinetic_energy": limits, "means": means, "errors": list(errors(runs, frame, tables)),
            "snapshots": list(snapshots(tables)), "field_errors": list(field_errors(tables, frame))}


def finite(frame: pd.DataFrame) -> pd.DataFrame:
    """Rows of real runs that did not diverge, not extrapolated ones."""
    return frame[np.isfinite(frame["resolution"].astype(float)) & frame["ke"].notna()]


def extrapolated(rows: pd.DataFrame) -> Iterator[dict[str, Any]]:
    """One row `resolution = inf` of each grid series with three converged resolutions or more, one state in all."""
    rows = rows[rows["method"].isin(GRIDS) & rows["converged"].astype(str).eq("True")]
    for point, group in rows.groupby(SERIES, dropna=False):
        if len(group) < 3 or group["rolls"].nunique() > 1:
            continue
        finest = group.sort_values("resolution").iloc[-1].to_dict()
        sizes = group["resolution"].astype(int).to_numpy()
        ke, nu = (limit(group[name].to_numpy(), group[f"{name}_err"].to_numpy(), sizes) for name in ("ke", "nu"))
        kept = {name: finest[name] for name in ("seed", "particles", "rolls", "free_fall", "converged", "threads")}
        yield {**dict(zip(SERIES, point, strict=True)), **kept, "resolution": np.inf, **one_energy(*ke), "nu": nu[0],
               "nu_err": nu[1], "cpu_s": group["cpu_s"].sum(), "compile_s": group["compile_s"].sum()}


def extrapolated_points(rows: pd.DataFrame) -> Iterator[dict[str, Any]]:
    """One row `resolution = inf` of each scheme on points with three sizes or more that settled, in one state.

    Lattices have no chance in them and are extrapolated as grids are; of sets of points that differ each run counts by itself.
    """
    rows = rows[(rows["method"] == "dih") & rows["converged"].astype(str).eq("True")]
    for point, group in rows.groupby(SERIES, dropna=False):
        group = group.sort_values("resolution")
        sizes = group["resolution"].to_numpy()
        if len(set(sizes)) < 3 or group["rolls"].nunique() > 1:
            continue
        alone = len(set(sizes)) == len(sizes)
        ke, nu = (limit(group[name].to_numpy(), group[f"{name}_err"].to_numpy(), sizes) if alone
                  else line(group[name].to_numpy(), sizes) for name in ("ke", "nu"))
        kept = {name: group.iloc[-1][name] for name in ("rolls", "free_fall", "converged", "threads")}
        yield {**dict(zip(SERIES, point, strict=True)), **kept, "seed": 0, "particles": 0, "resolution": np.inf,
               **one_energy(*ke), "nu": nu[0], "nu_err": nu[1], "cpu_s": group["cpu_s"].sum(),
               "compile_s": group["compile_s"].sum()}


def line(values: np.ndarray, sizes: np.ndarray) -> tuple[float, float]:
    """Value at 1/rows^2 = 0 of a line through all runs; its error: of the fit, and twice what leaving out the coarsest changes.

    K of sets of points scatters as 1/rows^2 or faster, 0.6 % to 0.04 % from 25 to 50 rows: hence weights of rows^2, and one
    scatter for all that is left over, which three runs of one size tell badly.
    """
    x, weight, finer = 1/sizes**2, sizes**2, sizes > sizes.min()
    fit, cov = np.polyfit(x, values, 1, w=weight, cov=True)
    without = np.polyfit(x[finer], values[finer], 1, w=weight[finer])[1]
    return float(fit[1]), float(np.hypot(stdtrit(len(x) - 2, 0.975)*np.sqrt(cov[1, 1]), 2*(fit[1] - without)))


def limit(values: np.ndarray, errs: np.ndarray, sizes: np.ndarray) -> tuple[float, float]:
    """Extrapolated value; its error has a part of the grid and one of the values' own (in time)."""
    found = richardson(list(values), list(sizes))
    return float(found.limit), float(np.hypot(found.error, 2*errs.max()))


def over_seeds(kinetic: pd.DataFrame) -> Iterator[dict[str, Any]]:
    """Means over the seeds of each particle point that settled in its commonest number of rolls; grid rows pass as they are.

    To the error of particles belongs twice what half of the time step changes: its error is of first order, from the walls.
    """
    shifts = step_shifts(kinetic)
    for point, group in kinetic.groupby(POINT, dropna=False):
        row = dict(zip(POINT, point, strict=True))
        same = group[group["rolls"] == group["rolls"].mode().iloc[0]]
        for name in ENERGIES:
            value, err = combine(list(zip(same[name], same[f"{name}_err"], strict=True)))
            row[name], row[f"{name}_err"] = value, float(np.hypot(err, 2*value*shift(shifts, row, name)))
        yield {**row, "particles": same["particles"].iloc[0], "seeds": len(same), "mixed": len(group) - len(same),
               "ke_fluctuation": same["ke_fluctuation"].mean(), "rolls": same["rolls"].iloc[0]}


def step_shifts(kinetic: pd.DataFrame) -> list[tuple[dict[str, Any], dict[str, float]]]:
    """(point, how much of K and Nu half of the time step changes there, relative)."""
    found = []
    for _, half in kinetic[kinetic["variant"] == HALF].groupby(POINT, dropna=False):
        first = half.iloc[0]
        whole = kinetic[(kinetic["variant"] == "printed") & (kinetic[SCENE] == first[SCENE]).all(axis=1)
                        & (kinetic["resolution"] == first["resolution"])]
        if len(whole):
            change = {name: float(abs(half[name].mean()/whole[name].mean() - 1)) for name in ENERGIES}
            found.append(({str(column): value for column, value in first.items()}, change))
    return found


def shift(shifts: list[tuple[dict[str, Any], dict[str, float]]], row: dict[str, Any], name: str) -> float:
    """The one of the next coarser resolution of the same fluid and box, or else of any; none for grids and fixed points.

    Steady states of grids do not depend on the step.
    """
    if row["method"] != "spam":
        return 0.0
    coarser = [(at, change[name]) for at, change in shifts if at["resolution"] <= float(row["resolution"])]
    alike = [one for one in coarser if all(one[0][column] == row[column] for column in ("eos", "sides"))] or coarser
    return max(alike, key=lambda one: one[0]["resolution"])[1] if alike else 0.0


def errors(runs: pd.DataFrame, means: pd.DataFrame, tables: Tables) -> Iterator[dict[str, Any]]:
    """Relative errors of K against the compressible limit of the scene, with what they cost.

    Kp, of all particles, is compared with the grid's K; Kg, of the smoothed field, with K of the grid's field smoothed by the
    same weight: smoothing alone is no error of the flow.
    """
    if means.empty:
        return
    limits = means[(means["method"] == "compressible") & (means["variant"] == "flux-form")
                   & ~np.isfinite(means["resolution"].astype(float)) & (means["ke"] > STILL)].set_index(SCENE)
    seen, seconds = smoothing_factors(tables), step_seconds(tables)
    for row in means[(means["eos"] != "") & np.isfinite(means["resolution"].astype(float))].to_dict("records"):
        where = tuple(row[name] for name in SCENE)
        if where not in limits.index:
            continue
        limit = limits.loc[where]
        if row["method"] != "spam" and row["rolls"] != limit["rolls"]:
            continue        # another flow
        cpu_s = cost(runs, row, seconds)
        yield error(row, "Nu", row["nu"], row["nu_err"], limit[["nu", "nu_err"]].set_axis(["ke", "ke_err"]),
                    1.0, cpu_s)
        yield error(row, "Kp", row["ke"], row["ke_err"], limit, 1.0, cpu_s)
        if row["method"] == "spam" and (*where, *view(row)) in seen:
            yield error(row, "Kg", row["ke_field"], row["ke_field_err"], limit, seen[(*where, *view(row))], cpu_s)


def error(row: Mapping[Any, Any], energy: str, ke: float, ke_err: float, limit: pd.Series, factor: float,
          cpu_s: float) -> dict[str, Any]:
    """A row of the table `errors`; the reference is the grid's limit times `factor`."""
    reference, reference_err = limit["ke"]*factor, limit["ke_err"]*factor
    return {**{name: row[name] for name in (*POINT, "particles")}, "energy": energy, "ke": ke, "ke_err": ke_err,
            "reference": reference, "reference_err": reference_err, "error": ke/reference - 1,
            "error_err": float(np.hypot(ke_err, ke/reference*reference_err)/reference), "cpu_s": cpu_s}


def smoothing_factors(tables: Tables) -> dict[tuple, float]:
    """(scene, weight, h, rows) -> K of the smoothed field over K."""
    if "smoothed" not in tables:
        return {}
    return {(*(row[name] for name in SCENE), row["weight"], float(row["h"]), int(row["rows"])): row["ke_smoothed"]/row["ke"]
            for row in tables["smoothed"].to_dict("records")}


def view(row: Mapping[Any, Any]) -> tuple[str, float, int]:
    """(weight, h, rows) of a particle point."""
    variant = VARIANTS[row["variant"]]
    return variant.weight.__name__, variant.h, int(row["resolution"])


def step_seconds(tables: Tables) -> dict[tuple, float]:
    """Seconds of a step, measured alone on the machine."""
    if "cost" not in tables:
        return {}
    return {tuple(row[name] for name in MACHINE): row["step_s"] for row in tables["cost"].to_dict("records")}


def cost(runs: pd.DataFrame, row: Mapping[Any, Any], seconds: dict[tuple, float]) -> float:
    """CPU seconds of what a mean is made of: all seeds of particles and points; a grid with the coarser ones it starts from.

    Steps times the seconds of one step measured alone where there is such a row, else what the run took beside others.
    """
    same = [name for name in POINT if name != "resolution"]
    group = runs[(runs[same] == pd.Series({name: row[name] for name in same})).all(axis=1)]
    if row["method"] not in GRIDS:
        group = group[group["resolution"] == row["resolution"]]
    group = group[group["resolution"] <= row["resolution"]]
    machine = [tuple(run[name] for name in MACHINE) for run in group.to_dict("records")]
    return float(sum(steps*seconds[m] if m in seconds else cpu_s
                     for m, steps, cpu_s in zip(machine, group["steps"], group["cpu_s"], strict=True)))
