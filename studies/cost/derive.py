"""Derived rows of the study `speed`: error against cost, its exponent, what a level of error costs, who is the cheapest."""
from collections.abc import Iterator
from typing import Any

import numpy as np
import pandas as pd

from studies.build.read import ratio
from studies.cost.tables import RUN, SERIES
from studies.kit.stats import Measured, combine
from studies.kit.table import Tables
from studies.ordering.derive import line
from studies.rb.looks import groups

LEVELS = (0.1, 0.03, 0.01, 0.001)
LEAST = 3           # resolutions of an exponent
PARTS = ("early", "late")               # of the repeats


def derive(tables: Tables) -> dict[str, list[dict[str, Any]]]:
    """All of them."""
    mean = list(over_seeds(tables))
    points = pd.DataFrame(mean)
    found: dict[str, list[dict[str, Any]]] = {"growth_laws": list(growth_laws(tables.get("growth", pd.DataFrame())))}
    if points.empty:
        return found
    needed = list(over_levels(points))
    return {**found, "points": mean, "exponents": list(exponents(points)), "needed": needed,
            "cheapest": list(cheapest(pd.DataFrame(needed))), "memory": list(memory(tables["runs"]))}


def of_part(tables: Tables, part: str) -> Tables:
    """The tables as they were if the first, `early`, or the last, `late`, of the repeats of all seconds were all there are."""
    found = {name: tables[name] for name in ("errors", "runs", "steps", "growth") if name in tables}
    if "runs" in found:
        both = found["runs"].merge(tables.get("repeats", pd.DataFrame(columns=RUN)), on=RUN, suffixes=("", "_part"))
        found["runs"] = both.assign(run_s=both[f"{part}_s"])
    if "growth" in found:
        found["growth"] = found["growth"].assign(step_s=found["growth"][f"{part}_s"])
    return Tables(found | {name: pd.DataFrame(rows) for name, rows in derive(Tables(found)).items() if rows})


def over_seeds(tables: Tables) -> Iterator[dict[str, Any]]:
    """Means; a resolution at which a seed diverged has no error. Its interval holds the error of time."""
    errors, runs = (tables.get(name, pd.DataFrame()) for name in ("errors", "runs"))
    if errors.empty or runs.empty:
        return
    both = with_steps(errors, tables.get("steps", pd.DataFrame())).merge(runs, on=RUN, suffixes=("", "_run"))
    lost = {tuple(row) for row in errors.loc[errors["quantity"] == "diverged", ["scene", "method", "resolution"]].to_numpy()}
    for key, group in both.groupby([*SERIES, "resolution"]):
        scene, _, method, resolution = key
        if (scene, method, resolution) in lost:
            continue
        error = combine(list(zip(group["error"].abs(), group["error_err"], strict=True)))
        run_s, err = group["share"]*group["run_s"], np.hypot(group["share"]*group["run_s_err"], group["setup_s_err"])
        seconds = combine(list(zip(run_s + group["setup_s"], err, strict=True)))
        yield {**dict(zip([*SERIES, "resolution"], key, strict=True)), "points": group["points"].iloc[0], "seeds": len(group),
               "error": error.value, "error_err": error.err, "cpu_s": seconds.value, "cpu_s_err": seconds.err,
               "setup_s": group["setup_s"].mean(), "bytes": group["bytes"].mean()}


def with_steps(errors: pd.DataFrame, steps: pd.DataFrame) -> pd.DataFrame:
    """Errors with what the step chosen changes (`steps`) in their intervals: runs that nothing random enters have no other."""
    if steps.empty:
        return errors
    key = [*RUN, "quantity"]
    chosen = steps[steps["accepted"] == 1].sort_values("of_limit").drop_duplicates(key, keep="last")[[*key, "time_error"]]
    both = errors.merge(chosen, on=key, how="left")
    return both.assign(error_err=np.hypot(both["error_err"], both["time_error"].fillna(0))).drop(columns="time_error")


def exponents(points: pd.DataFrame) -> Iterator[dict[str, Any]]:
    """d ln(seconds)/d ln(1/error); of methods whose error falls from each resolution to the next."""
    for key, group in points.groupby(SERIES):
        group = group.sort_values("resolution")
        error = group["error"].to_numpy(float)
        if len(group) >= LEAST and (np.diff(error) < 0).all():
            slope, err = line(-np.log(error), np.log(group["cpu_s"].to_numpy(float)))
            yield {**dict(zip(SERIES, key, strict=True)), "number": len(group), "exponent": slope, "exponent_err": err}


def over_levels(points: pd.DataFrame) -> Iterator[dict[str, Any]]:
    """Every method at every level."""
    for key, group in points.groupby(SERIES):
        group = group.sort_values("resolution")
        for level in LEVELS:
            yield {**dict(zip(SERIES, key, strict=True)), "level": level, **reached(group, level)}


def reached(group: pd.DataFrame, level: float) -> dict[str, Any]:
    """Where the errors of rising resolutions come below a level and stay there, between two by a power law.

    An error that is not told from zero counts with its uncertainty: where its sign changes the error itself is no measure.
    """
    error = group[["error", "error_err"]].max(axis=1).to_numpy(float)
    above = np.flatnonzero(~(error <= level))
    at = {name: group[name].to_numpy(float) for name in ("cpu_s", "cpu_s_err", "points")}
    if len(above) == 0:
        first, err = at["cpu_s"][0], at["cpu_s_err"][0]
        return {"reached": "at most", "cpu_s": first, "low": 0.0, "high": first + err, "points": at["points"][0],
                "error": error[0]}
    if above[-1] == len(error) - 1:
        return {"reached": "no", "cpu_s": np.nan, "low": np.nan, "high": np.nan, "points": np.nan, "error": error.min()}
    pair = slice(above[-1], above[-1] + 2)
    err = group["error_err"].to_numpy(float)[pair]
    cpu = crossing(error[pair], err, at["cpu_s"][pair], at["cpu_s_err"][pair], level)
    number = crossing(error[pair], err, at["points"][pair], np.zeros(2), level)
    return {"reached": "yes", "cpu_s": cpu[0], "low": cpu[0]*np.exp(-cpu[1]), "high": cpu[0]*np.exp(cpu[1]), "points": number[0],
            "error": level}


def crossing(error: np.ndarray, error_err: np.ndarray, cost: np.ndarray, cost_err: np.ndarray,
             level: float) -> tuple[float, float]:
    """Cost at a level between two errors, and the half width of the interval of its logarithm.

    ln cost = ln cost_0 + s (ln cost_1 - ln cost_0), s = ln(error_0/level)/ln(error_0/error_1); errors of all four numbers count.
    """
    fall = np.log(error[0]/error[1])
    share, rise = np.log(error[0]/level)/fall, np.log(cost[1]/cost[0])
    off = np.array([(1 - share)*rise/fall*error_err[0]/error[0], share*rise/fall*error_err[1]/error[1],
                    (1 - share)*cost_err[0]/cost[0], share*cost_err[1]/cost[1]])
    return float(cost[0]*np.exp(share*rise)), float(np.sqrt((off**2).sum()))


def cheapest(needed: pd.DataFrame) -> Iterator[dict[str, Any]]:
    """The least seconds of each scene, quantity and level."""
    for key, group in needed.groupby(["scene", "quantity", "level"]):
        told = group[group["reached"] != "no"]
        row = dict(zip(("scene", "quantity", "level"), key, strict=True))
        if told.empty:
            nothing = dict.fromkeys(("cpu_s", "low", "high", "points"), np.nan)
            yield {**row, "method": "not reached", "reached": "no", **nothing}
        else:
            best = told.sort_values("cpu_s").iloc[0]
            yield {**row, **{name: best[name] for name in ("method", "reached", "cpu_s", "low", "high", "points")}}


def memory(runs: pd.DataFrame) -> Iterator[dict[str, Any]]:
    """Bytes a point at the highest resolution of each method in each scene, means over seeds."""
    finest = runs[runs["resolution"] == runs.groupby(["scene", "method"])["resolution"].transform("max")]
    for (scene, method), group in groups(finest, ["scene", "method"]):
        size, points = group["bytes"].mean(), group["points"].mean()
        yield {"scene": scene, "method": method, "resolution": group["resolution"].iloc[0], "points": points, "bytes": size,
               "bytes_a_point": size/points}


def growth_laws(growth: pd.DataFrame) -> Iterator[dict[str, Any]]:
    """Exponents over the number of particles, and speed-ups by two threads."""
    if growth.empty:
        return
    for method, group in groups(growth[growth["clock"] == "cpu"], "method"):
        if len(group) >= LEAST:
            slope, err = line(*(np.log(group[name].to_numpy(float)) for name in ("points", "step_s")))
            yield {"method": method, "what": "exponent", "least": group["points"].min(), "most": group["points"].max(),
                   "value": slope, "value_err": err}
    for (method, points), group in groups(growth[growth["clock"] == "wall"], ["method", "points"]):
        if set(group["threads"]) == {1, 2}:
            one, two = (Measured(*row) for row in group.sort_values("threads")[["step_s", "step_s_err"]].to_numpy(float))
            faster = ratio(one, two)
            yield {"method": method, "what": "two threads", "least": points, "most": points, "value": faster.value,
                   "value_err": faster.err}
