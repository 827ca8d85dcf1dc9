"""Rows that follow from whole tables: growth of ripples, the highest Ra, and the map.

Rules of the map, written before the runs. diverges: the run did not reach its end. leaks: mass changed by
more than LEAK. freezes: less than FROZEN of the flow is left. right: the number is within NEAR, and what the
reference is uncertain by, of what it should be. wrong: stable, and none of these. A shock tube is right if v
neither rings nor is off by more than NEAR, and diverges if a tube of any length did. The highest Ra is the
first one that is bad: it ends, or its K is wrong but stable. refused: the method says itself that it does not
take the case. unjudged: there is nothing to hold it against, since no two grids besides itself came to their
end, a search found no limit, or a rate is known to worse than NEAR.
"""
from collections.abc import Callable, Iterator
from math import log
from typing import Any

import numpy as np
import pandas as pd

from studies.hardcases.interface import Impulse, impulse
from studies.hardcases.scenes import BOXES, LAYERS, ROWS, SOUND, Strip
from studies.hardcases.tubes import CELL_NUMBER, FINE, STEPS
from studies.kit.fits import line
from studies.kit.stats import Measured, combine, over_seeds
from studies.kit.table import Tables, groups

Rows = Iterator[dict[str, Any]]
SETTLED = 0.3           # part of the time from the shock to its return that the ripple takes to grow steadily
ENOUGH = 0.65           # until which a run has to last: half of what is then left
FINEST = 48             # rows of the grid that cell numbers are of
LEAK, FROZEN, NEAR = 1e-3, 0.1, 0.1
SPURIOUS = 1e-3         # of the speed of sound: a hundredth of what flows of KHP95 have
MIDDLE = 50.5/60        # mean time of the samples 41 to 60 of 60
PART_OF_TIME = "part of the time"


def derive(tables: Tables) -> dict[str, list[dict[str, Any]]]:
    """Derived rows of the study."""
    rows = {name: list(make(*(tables[source] for source in sources)))
            for name, (make, sources) in MAKERS.items() if all(source in tables for source in sources)}
    with_summary = {**tables, **{name: pd.DataFrame(some) for name, some in rows.items()}}
    rows["map"] = [row for source, make in OF_MAP.items() if len(with_summary.get(source, ()))
                   for row in make(with_summary[source])]
    return {name: some for name, some in rows.items() if some}


# --- ripples --------------------------------------------------------------------------------------


def ripple_growth(ripples: pd.DataFrame) -> Rows:
    """Means over the runs that lasted; one that diverged late counts while it lasts."""
    for _, group in ripples.groupby(["scale", "steep"]):
        scale, steep = (float(group[name].iloc[0]) for name in ("scale", "steep"))
        theory = impulse(scale, steep)
        lasted = theory.meets + ENOUGH*(theory.back - theory.meets)
        runs = [one.sort_values("time") for _, one in group.dropna(subset=["height"]).groupby("seed")]
        numbers = [ripple(one, theory) for one in runs if one["time"].iloc[-1] > lasted]
        if numbers:
            kick, amplitude, growth = map(combine, zip(*numbers, strict=True))
            yield {"scale": scale, "steep": steep, "seeds": len(numbers), "kick": kick.value, "kick_err": kick.err,
                   "amplitude": amplitude.value, "amplitude_err": amplitude.err, "growth": growth.value,
                   "growth_err": growth.err}


def ripple(run: pd.DataFrame, theory: Impulse) -> tuple[Measured, Measured, Measured]:
    """Kick, amplitude behind the shock and growth rate over those of theory, of one run.

    Straight lines through heights before and behind the shock, and through amplitudes once growth is steady.
    """
    before = run[run["time"] < theory.meets]
    late = run[run["time"] > theory.meets + SETTLED*(theory.back - theory.meets)]
    up, down, growth = slope(late, "height"), slope(before, "height"), slope(late, "amplitude")
    since = float(late["time"].mean() - theory.meets)
    amplitude = Measured(float(late["amplitude"].mean()) - growth.value*since, growth.err*since)
    return (up - down)/theory.kick, amplitude/theory.amplitude, growth/theory.growth


def slope(run: pd.DataFrame, name: str) -> Measured:
    """Of a column in time."""
    return line(run["time"].to_numpy(), run[name].to_numpy()).slope


# --- the highest Ra -------------------------------------------------------------------------------


def high_ra_summary(limits: pd.DataFrame, grid: pd.DataFrame) -> Rows:
    """Geometric means and extremes over starts that have a limit; what most of these do beyond it."""
    slope, constant = cell_numbers(grid)
    predicted = float(np.exp((log(CELL_NUMBER) - constant)/slope))
    for (method, step, kind), rows in limits.groupby(["method", "step", "kind"]):
        ra, outcomes = rows["ra"].dropna(), rows.loc[rows["ra"].notna(), "outcome"].mode()
        cell = over_seeds(np.exp(constant + slope*np.log(rows["ra"].fillna(rows["tried"]))))
        yield {"method": method, "step": step, "kind": kind, "predicted": predicted if kind == "wrong" else np.nan,
               "ra": float(np.exp(np.log(ra).mean())), "ra_low": ra.min(), "ra_high": ra.max(), "seeds": len(ra),
               "outcome": outcomes.iloc[0] if len(outcomes) else "none", "cell_number": cell.value,
               "cell_number_err": cell.err}


def cell_numbers(grid: pd.DataFrame) -> tuple[float, float]:
    """Slope and constant of ln(cell number of the fastest flow) over ln Ra, through the fine grid's."""
    rows = grid[grid["rows"] == FINEST].dropna(subset=["cell_number"])
    slope, constant = np.polyfit(np.log(rows["ra"]), np.log(rows["cell_number"]), 1)
    return float(slope), float(constant)


# --- the map --------------------------------------------------------------------------------------


def entry(case: str, method: str, variant: str, outcome: str, number: str, measured: Any, err: Any = 0.0,
          predicted: float = 1.0) -> dict[str, Any]:
    """A row of the map."""
    return {"case": case, "method": method, "variant": variant, "number": number, "predicted": predicted,
            "measured": measured, "measured_err": err, "outcome": outcome}


def of_runs(runs: pd.DataFrame) -> Rows:
    """Points and the coarse grid against what is known."""
    for _, run in runs[(runs["method"] != "grid") | (runs["rows"] <= ROWS)].iterrows():
        scene, _ = {**LAYERS, **BOXES}[run["case"]]
        number, predicted, ratio = decisive(runs, run)
        verdict = outcome(run, number, predicted, ratio)
        if verdict == "diverges":
            number, predicted, ratio = PART_OF_TIME, 1.0, Measured(run["reached"], 0.0)
        yield entry(run["case"], run["method"], f"L {scene.L:g}", verdict, number, *ratio, predicted)


def decisive(runs: pd.DataFrame, run: pd.Series) -> tuple[str, float, Measured]:
    """Name of the number that decides, what it should be, what it is with the error of what it should be."""
    if run["case"] == "wall corner":
        return "speed/c", 0.0, Measured(float(np.sqrt(2*run["k"])/SOUND))
    if run["case"] == "vacuum":
        exact = Strip().kinetic(MIDDLE*BOXES["vacuum"][1])
        return "K/exact", 1.0, Measured(float(run["k"]/exact))
    if run["case"] == "zero viscosity":
        return "flow/start", 1.0, Measured(float(run["flow"]/run["flow_start"]))
    return "flow/grid", 1.0, against_grid(runs, run)


def against_grid(runs: pd.DataFrame, run: pd.Series) -> Measured:
    """Flow over that of the finest grid that came to its end; error: what the next coarser one changes.

    A grid is no judge of itself: neither the reference nor its error come from the rows that are judged.
    """
    grid = finished_grids(runs, run["case"])
    if run["method"] == "grid":
        grid = grid.drop(run["rows"], errors="ignore")
    if len(grid) < 2:
        return Measured(np.nan, np.nan)
    ratio = float(run["flow"]/grid.iloc[-1])
    return Measured(ratio, float(abs(ratio*(grid.iloc[-2]/grid.iloc[-1] - 1))))


def finished_grids(runs: pd.DataFrame, case: str) -> pd.Series:
    """Flow by rows, from coarse to fine, of grids that came to their end."""
    grid = runs[(runs["case"] == case) & (runs["method"] == "grid")].dropna(subset=["flow"])
    return grid.sort_values("rows").set_index("rows")["flow"]


def outcome(run: pd.Series, number: str, predicted: float, ratio: Measured) -> str:
    """By the rules at the head of this file."""
    if isinstance(run["refused"], str) and run["refused"]:
        return "refused"
    if not run["reached"] >= 1:
        return "diverges"
    if abs(run["mass_drift"]) > LEAK:
        return "leaks"
    if not np.isfinite(ratio.value):
        return "unjudged"
    if number == "speed/c":
        return "right" if ratio.value < SPURIOUS else "wrong"
    if ratio.value < FROZEN:
        return "freezes"
    noisy = number == "flow/start" and abs(run["k"]/run["k_start"] - 1) > NEAR
    return "right" if abs(ratio.value - predicted) <= NEAR + ratio.err and not noisy else "wrong"


def of_shear(shear: pd.DataFrame) -> Rows:
    """Growth of the wave on a shear flow over linear theory."""
    for _, run in shear.sort_values("method").iterrows():
        ratio = Measured(run["measured"], run["measured_err"])/run["predicted"]
        yield entry("shear layer", run["method"], "L 16", "diverges" if run["reached"] < 1 else known(ratio),
                    "growth/linear", *ratio)


def known(ratio: Measured) -> str:
    """Right or wrong, if the whole interval is."""
    difference = abs(ratio.value - 1)
    if difference + ratio.err <= NEAR:
        return "right"
    return "wrong" if difference - ratio.err > NEAR else "unjudged"


def of_tubes(tubes: pd.DataFrame) -> Rows:
    """Shock tubes by viscosity, usual step: how much v rings in the longest, or that one ended."""
    tubes = tubes[(tubes["step"] == STEPS[0]) & (tubes["method"] != FINE)]
    for (method, eta), rows in groups(tubes, ["method", "eta"]):
        variant, longest = f"eta {eta:g}", rows[rows["L"] == rows["L"].max()]
        ring, error = longest["wiggles"], longest["v_grid" if eta else "v_exact"].mean()
        if rows["reached"].min() < 1:
            yield entry("shock tube", str(method), variant, "diverges", PART_OF_TIME, rows["reached"].min())
        else:
            verdict = "right" if max(ring.mean(), error) <= NEAR else "wrong"
            yield entry("shock tube", str(method),
                        variant, verdict, "ringing of v", ring.mean(), float(np.ptp(ring))/2, 0.0)


def of_smooth_tubes(tubes: pd.DataFrame) -> Rows:
    """The same of smooth particles."""
    reached = tubes["diverged"].isna().astype(float)
    return of_tubes(tubes.assign(method="spam printed", step=STEPS[0], reached=reached))


def of_high_ra(summary: pd.DataFrame) -> Rows:
    """From which Ra on a layer is bad, and ends; predicted from the cell number."""
    verdicts = {"none": "unjudged", "ends": "diverges"}
    for _, row in summary[summary["step"] == 1].iterrows():
        yield entry("highest Ra", row["method"], "first bad" if row["kind"] == "wrong" else "ends",
                    verdicts.get(row["outcome"], "wrong"), "Ra",
                                 row["ra"], (row["ra_high"] - row["ra_low"])/2,
                    row["predicted"])


#: derived table -> what makes its rows, of which tables
MAKERS: dict[str, tuple[Callable, tuple[str, ...]]] = {
    "ripple_growth": (ripple_growth, ("ripples",)),
    "high_ra_summary": (high_ra_summary, ("high_ra", "high_ra_grid")),
}
#: table -> rows of the map
OF_MAP: dict[str, Callable[[pd.DataFrame], Rows]] = {
    "hard_runs": of_runs, "shear": of_shear, "tubes": of_smooth_tubes, "method_tubes": of_tubes,
    "high_ra_summary": of_high_ra}
