"""What follows from the runs: error against cost, its exponent, what a level of error costs, what leaving out saves."""
from collections.abc import Iterator
from typing import Any

import numpy as np
import pandas as pd

from studies.cost.names import GRID, LUCY, MAC_IMEX, NEAREST
from studies.cost.tables import RUN, SERIES
from studies.kit.fits import power_law
from studies.kit.stats import Measured, combine
from studies.kit.table import Tables, groups

#: quantities of the scenes that are fields
FIELD = {"convection": "K", "taylor-green": "velocity", "sound": "velocity", "conduction": "temperature",
         "couette": "velocity"}
LEVELS = (0.1, 0.03, 0.01, 0.001)
LEAST = 3           # resolutions of an exponent
NO_NUMBER = Measured(np.nan, np.nan)
MATTERS = 0.01      # of the answer: the error at which methods are compared
Rows = list[dict[str, Any]]
COST = ("step_s", "step_s_err", "time_s", "time_s_err")
OF_TERM = ("scene", "base", "left_out", "quantity", "step_s", "step_s_err", "bytes", "loops", "error", "changed")


def errors(tables: Tables) -> dict[str, Rows]:
    """What errors cost."""
    rows: dict[str, Rows] = {"growth_laws": list(growth_laws(tables.get("growth", pd.DataFrame())))}
    means = list(over_seeds(tables))
    points = pd.DataFrame(means)
    if points.empty:
        return rows
    needed = list(over_levels(points))
    return {**rows, "points": means, "exponents": list(exponents(points)), "needed": needed,
            "cheapest": list(cheapest(pd.DataFrame(needed))), "rivals": list(rivals(points)),
            "memory": list(memory(tables["runs"]))}


# --- error against cost -----------------------------------------------------------------------------------------


def over_seeds(tables: Tables) -> Iterator[dict[str, Any]]:
    """Means; a resolution at which a seed diverged has no error. Its interval holds the error of time."""
    errors, runs = (tables.get(name, pd.DataFrame()) for name in ("errors", "runs"))
    if errors.empty or runs.empty:
        return
    both = with_steps(errors, tables.get("steps", pd.DataFrame())).merge(runs, on=RUN, suffixes=("", "_run"))
    rung = ["scene", "method", "resolution"]
    diverged = errors[errors["quantity"] == "diverged"][rung].drop_duplicates()
    both = both.merge(diverged, on=rung, how="left", indicator=True)
    for key, group in both[both["_merge"] == "left_only"].groupby([*SERIES, "resolution"]):
        error = mean(group["error"].abs(), group["error_err"])
        err = np.hypot(group["share"]*group["run_s_err"], group["setup_s_err"])
        seconds = mean(group["share"]*group["run_s"] + group["setup_s"], pd.Series(err))
        yield {**dict(zip([*SERIES, "resolution"], key, strict=True)),
               "points": group["points"].iloc[0], "seeds": len(group),
               "error": error.value, "error_err": error.err, "cpu_s": seconds.value, "cpu_s_err": seconds.err,
               "setup_s": group["setup_s"].mean(), "bytes": group["bytes"].mean()}


def mean(values: pd.Series, errs: pd.Series) -> Measured:
    """Over seeds."""
    return combine(list(zip(values, errs, strict=True)))


def with_steps(errors: pd.DataFrame, steps: pd.DataFrame) -> pd.DataFrame:
    """Errors whose intervals hold what halving the chosen step changes: of runs without chance they have no other."""
    if steps.empty:
        return errors
    key = [*RUN, "quantity"]
    good = steps[steps["accepted"] == 1].sort_values("of_limit")
    chosen = good.drop_duplicates(key, keep="last")[[*key, "time_error"]]
    both = errors.merge(chosen, on=key, how="left")
    err = np.hypot(both["error_err"], both["time_error"].fillna(0))
    return both.assign(error_err=err).drop(columns="time_error")


def series(points: pd.DataFrame) -> Iterator[tuple[dict[str, Any], pd.DataFrame]]:
    """Key columns and rows of each series, resolutions ascending."""
    for key, group in points.groupby(SERIES):
        yield dict(zip(SERIES, key, strict=True)), group.sort_values("resolution")


def exponents(points: pd.DataFrame) -> Iterator[dict[str, Any]]:
    """d ln(seconds)/d ln(1/error); of methods whose error falls from each resolution to the next."""
    for key, group in series(points):
        if len(group) >= LEAST and (np.diff(group["error"]) < 0).all():
            slope = power_law(1/group["error"].to_numpy(float), group["cpu_s"].to_numpy(float)).slope
            yield {**key, "number": len(group), "exponent": slope.value, "exponent_err": slope.err}


def over_levels(points: pd.DataFrame) -> Iterator[dict[str, Any]]:
    """Every method at every level."""
    for key, group in series(points):
        for level in LEVELS:
            yield {**key, "level": level, **reached(group, level)}


def reached(group: pd.DataFrame, level: float) -> dict[str, Any]:
    """Where the errors of rising resolutions come below a level and stay there, between two by a power law.

    An error that is not told from zero counts with its uncertainty: where its sign changes it is no measure itself.
    """
    error = group[["error", "error_err"]].max(axis=1).to_numpy(float)
    above = np.flatnonzero(~(error <= level))
    if len(above) == 0:
        first = group.iloc[0]
        return {"reached": "at most", "cpu_s": first["cpu_s"], "low": 0.0, "high": first["cpu_s"] + first["cpu_s_err"],
                "points": first["points"], "error": error[0]}
    if above[-1] == len(error) - 1:
        return {"reached": "no", **dict.fromkeys(("cpu_s", "low", "high", "points"), np.nan), "error": error.min()}
    pair = slice(above[-1], above[-1] + 2)
    err, cpu, cpu_err, points = (group[name].to_numpy(float)[pair]
                                 for name in ("error_err", "cpu_s", "cpu_s_err", "points"))
    seconds, half = crossing(error[pair], err, cpu, cpu_err, level)
    number, _ = crossing(error[pair], err, points, np.zeros(2), level)
    return {"reached": "yes", "cpu_s": seconds, "low": seconds*np.exp(-half), "high": seconds*np.exp(half),
            "points": number, "error": level}


def crossing(error: np.ndarray, error_err: np.ndarray, cost: np.ndarray, cost_err: np.ndarray,
             level: float) -> tuple[float, float]:
    """Cost at a level between two errors, and the half width of the interval of its logarithm.

    ln cost = ln cost_0 + s (ln cost_1 - ln cost_0), s = ln(error_0/level)/ln(error_0/error_1); all four have errors.
    """
    fall = np.log(error[0]/error[1])
    share, rise = np.log(error[0]/level)/fall, np.log(cost[1]/cost[0])
    slopes = np.array([(1 - share)*rise/fall, share*rise/fall, 1 - share, share])
    errs = np.array([*error_err/error, *cost_err/cost])
    return float(cost[0]*np.exp(share*rise)), float(np.sqrt(((slopes*errs)**2).sum()))


def cheapest(needed: pd.DataFrame) -> Iterator[dict[str, Any]]:
    """The least seconds of each scene, quantity and level."""
    columns = ["reached", "cpu_s", "low", "high", "points"]
    for key, group in needed.groupby(["scene", "quantity", "level"]):
        row = dict(zip(("scene", "quantity", "level"), key, strict=True))
        best = group[group["reached"] != "no"].sort_values("cpu_s").head(1)
        for one in (best if len(best) else group.head(1).assign(method="not reached")).to_dict("records"):
            yield {**row, **{name: one[name] for name in ("method", *columns)}}


def rivals(points: pd.DataFrame) -> Iterator[dict[str, Any]]:
    """Printed particles over the grid of each scene, or the lattice that is one where no grid takes it."""
    for scene, quantity in FIELD.items():
        here = points[(points["scene"] == scene) & (points["quantity"] == quantity)]
        grid = next((name for name in (GRID, MAC_IMEX, NEAREST) if name in set(here["method"])), "")
        best = here[here["method"] == LUCY].nsmallest(1, "error")
        known = here[here["method"] == grid].sort_values("error")
        for row in best[best["error"] >= known["error"].min()].to_dict("records"):
            yield {"scene": scene, "quantity": quantity, "rival": grid, "error": row["error"],
                   **over_rival(row, known, "points", "points"), **over_rival(row, known, "cpu_s", "seconds")}


def over_rival(best: dict, known: pd.DataFrame, column: str, name: str) -> dict[str, float]:
    """`column` of a run over that of a grid with the same error, by a power law between its resolutions.

    Where the coarsest grid is better already, over that of the coarsest grid: the ratio is then at least this.
    """
    x, y = np.log(known["error"].to_numpy(float)), np.log(known[column].to_numpy(float))
    ratio = float(best[column])/float(np.exp(np.interp(np.log(best["error"]), x, y)))
    slope = np.gradient(y, x).min() if len(known) > 1 else 0.0
    return {name: ratio, f"{name}_err": float(abs(ratio*slope*best["error_err"]/best["error"]))}


def memory(runs: pd.DataFrame) -> Iterator[dict[str, Any]]:
    """Bytes a point at the highest resolution of each method in each scene, means over seeds."""
    finest = runs[runs["resolution"] == runs.groupby(["scene", "method"])["resolution"].transform("max")]
    for (scene, method), group in finest.groupby(["scene", "method"]):
        size, points = group["bytes"].mean(), group["points"].mean()
        yield {"scene": scene, "method": method, "resolution": group["resolution"].iloc[0], "points": points,
               "bytes": size, "bytes_a_point": size/points}


def growth_laws(growth: pd.DataFrame) -> Iterator[dict[str, Any]]:
    """Exponents over the number of particles, and speed-ups by two threads."""
    if growth.empty:
        return
    for method, group in groups(growth[growth["clock"] == "cpu"], "method"):
        if len(group) >= LEAST:
            law = power_law(group["points"].to_numpy(float), group["step_s"].to_numpy(float)).slope
            yield {"method": method, "what": "exponent", "least": group["points"].min(),
                   "most": group["points"].max(), "value": law.value, "value_err": law.err}
    for (method, points), group in groups(growth[growth["clock"] == "wall"], ["method", "points"]):
        if set(group["threads"]) == {1, 2}:
            one, two = (Measured(*row) for row in group.sort_values("threads")[["step_s", "step_s_err"]].to_numpy(float))
            faster = one/two
            yield {"method": method, "what": "two threads", "least": points, "most": points, "value": faster.value,
                   "value_err": faster.err}


# --- terms ------------------------------------------------------------------------------------------------------


def terms(tables: Tables) -> dict[str, Rows]:
    """What leaving out saves and costs: ratios to the whole of each base."""
    measured: pd.DataFrame = tables.get("measured", pd.DataFrame())
    return {"scenes": list(ratios(measured))} if len(measured) else {}


def ratios(measured: pd.DataFrame) -> Iterator[dict[str, Any]]:
    """One row a variant; a base whose whole is not there has none."""
    for _, group in measured.groupby(["scene", "base"]):
        whole = group[group["left_out"] == "nothing"].to_dict("records")
        for row in group.to_dict("records") if whole else ():
            yield compared(row, whole[0])


def compared(row: dict, whole: dict) -> dict[str, Any]:
    """Ratios, and whether what is changed matters; a run that diverges does, and what it took to do so is no cost."""
    if np.isnan(row["changed"]):
        row = {**row, **dict.fromkeys(COST, np.nan)}
    step, time = (over(*(Measured(of[name], of[f"{name}_err"]) for of in (row, whole))) for name in ("step_s", "time_s"))
    return {**{name: row[name] for name in OF_TERM}, "step_ratio": step.value, "step_ratio_err": step.err,
            "time_ratio": time.value, "time_ratio_err": time.err, "bytes_ratio": row["bytes"]/whole["bytes"],
            "needed": "no" if row["changed"] <= MATTERS else "yes"}


def over(part: Measured, whole: Measured) -> Measured:
    """A ratio of times; none where they scatter as much as they last, on a busy machine."""
    return part/whole if abs(whole.value) > whole.err else NO_NUMBER
