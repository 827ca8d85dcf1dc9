"""Rows that follow from other rows: grids extrapolated, means over seeds, errors against the reference."""
from collections.abc import Iterator
from typing import Any

import numpy as np
import pandas as pd

from continuum.richardson import richardson
from studies.convection.tables import POINT
from studies.kit.stats import combine
from studies.kit.table import Tables

GRIDS = ("compressible", "boussinesq", "pypde-boussinesq", "pypde-compressible")
MACHINE = ["method", "variant", "eos", "sides", "resolution"]
SERIES = [name for name in POINT if name != "resolution"]


def derive(tables: Tables) -> dict[str, list[dict[str, Any]]]:
    """All derived rows of the study."""
    if "kinetic_energy" not in tables:
        return {}
    runs = finite(tables["kinetic_energy"])
    limits = list(extrapolated(runs))
    everything = pd.concat([runs, pd.DataFrame(limits)], ignore_index=True) if limits else runs
    cost = tables.get("cost", pd.DataFrame(columns=[*MACHINE, "step_s"]))
    return {"kinetic_energy": limits, "means": list(over_seeds(everything)), "errors": list(errors(everything, cost))}


def finite(frame: pd.DataFrame) -> pd.DataFrame:
    """Rows of real runs, not extrapolated ones."""
    return frame[np.isfinite(frame["resolution"].astype(float))]


def extrapolated(rows: pd.DataFrame) -> Iterator[dict[str, Any]]:
    """One row `resolution = inf` of each grid series with three converged resolutions or more, one state in all."""
    rows = rows[rows["method"].isin(GRIDS) & rows["converged"].astype(str).eq("True")]
    for point, group in rows.groupby(SERIES, dropna=False):
        if len(group) < 3 or group["rolls"].nunique() > 1:
            continue
        finest = group.sort_values("resolution").iloc[-1].to_dict()
        sizes = group["resolution"].astype(int).to_numpy()
        ke, nu = (limit(group[name].to_numpy(), group[f"{name}_err"].to_numpy(), sizes) for name in ("ke", "nu"))
        kept = {name: finest[name] for name in ("seed", "particles", "rolls", "free_fall", "ke_fluctuation", "converged",
                                                "threads")}
        yield {**dict(zip(SERIES, point, strict=True)), **kept, "resolution": np.inf, "ke": ke[0], "ke_err": ke[1],
               "ke_field": ke[0], "ke_field_err": ke[1], "nu": nu[0], "nu_err": nu[1], "cpu_s": group["cpu_s"].sum(),
               "compile_s": group["compile_s"].sum()}


def limit(values: np.ndarray, errs: np.ndarray, sizes: np.ndarray) -> tuple[float, float]:
    """Extrapolated value; its error has a part of the grid and one of the values' own (in time)."""
    found = richardson(list(values), list(sizes))
    return float(found.limit), float(np.hypot(found.error, 2*errs.max()))


def over_seeds(kinetic: pd.DataFrame) -> Iterator[dict[str, Any]]:
    """Means over the seeds of each particle point; grid rows pass as they are."""
    for point, group in kinetic.groupby(POINT, dropna=False):
        row = dict(zip(POINT, point, strict=True))
        for name in ("ke", "ke_field", "nu"):
            row[name], row[f"{name}_err"] = combine(list(zip(group[name], group[f"{name}_err"], strict=True)))
        rolls = group["rolls"].mode().iloc[0]
        yield {**row, "particles": group["particles"].iloc[0], "seeds": len(group),
               "ke_fluctuation": group["ke_fluctuation"].mean(), "rolls": rolls}


def errors(kinetic: pd.DataFrame, cost: pd.DataFrame) -> Iterator[dict[str, Any]]:
    """Relative error of each gas point against the compressible limit of its scene, with what it cost.

    CPU seconds are steps times the seconds of one step measured alone on the machine, where there is such a row;
    else those of the run itself, which shared the machine.
    """
    step_s = {tuple(row[name] for name in MACHINE): row["step_s"] for _, row in cost.iterrows()}
    scene = ["eos", "transport", "sides", "ra", "pr"]
    gas = kinetic[kinetic["eos"] != ""]
    reference = gas[(gas["method"] == "compressible") & ~np.isfinite(gas["resolution"].astype(float))].set_index(scene)
    for row in over_seeds(finite(gas)):
        where = tuple(row[name] for name in scene)
        if where not in reference.index or reference.loc[where, "ke"] < 1e-6:
            continue
        ref = reference.loc[where]
        group = gas.loc[(gas[POINT] == pd.Series({name: row[name] for name in POINT})).all(axis=1)]
        machine = tuple(row[name] for name in MACHINE)
        relative = np.hypot(row["ke_err"], ref["ke_err"])/ref["ke"]
        yield {**{name: row[name] for name in (*POINT, "particles", "ke", "ke_err")}, "reference": ref["ke"],
               "reference_err": ref["ke_err"], "error": row["ke"]/ref["ke"] - 1, "error_err": relative, "energy": "Kp",
               "cpu_s": float(step_s[machine]*group["steps"].mean() if machine in step_s else group["cpu_s"].mean())}
