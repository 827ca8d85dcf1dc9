"""What became of each method in each case, by rules that were written before the runs.

diverges: the run did not reach its end. leaks: mass changed by more than LEAK. freezes: less than FROZEN of the flow is left.
right: the number is within NEAR, and what the reference is uncertain by, of what it should be. wrong: stable, and none of these.
A shock tube is right if v neither rings nor is off by more than NEAR, and diverges if a tube of any length did. The highest Ra is
the first one that is bad: it ends, or its K is wrong but stable. refused: the method says itself that it does not take the case.
unjudged: there is nothing to hold it against, since no two grids besides itself came to their end, a search found no limit, or a
rate is known to worse than NEAR. Of lattices: pairs or clumps beyond a limit, whose prediction is told beside it. Of steps: right
within NEAR of the formula, safe if the formula is smaller, wrong if it is larger.
"""
from collections.abc import Iterator
from typing import Any

import numpy as np
import pandas as pd

from studies.hardcases.map.scenes import BOXES, LAYERS, ROWS, SOUND, Strip
from studies.hardcases.tube.runs import FINE, STEPS
from studies.kit.table import Tables

LEAK, FROZEN, NEAR = 1e-3, 0.1, 0.1
SPURIOUS = 1e-3         # of the speed of sound: a hundredth of what flows of KHP95 have
#: mean time of the samples 41 to 60 of 60
MIDDLE = 50.5/60
OTHER_FORMULAS = ("fixed jittered, edges alone", "fixed Euler, strip")      # of methods that have their own
PAIRED = 0.5            # of all particles share a site
PART_OF_TIME = "part of the time"


def derive(tables: Tables) -> dict[str, list[dict[str, Any]]]:
    """Rows of the map, from all tables that there are."""
    found = [row for rows in (of_runs, of_shear, of_limits, of_lattices, of_tubes, of_high_ra, of_interfaces)
             for row in rows(tables)]
    return {"map": found} if found else {}


def entry(case: str, method: str, variant: str, number: str, predicted: float, measured: float, err: float,
          outcome: str) -> dict[str, Any]:
    """A row of the map."""
    return {"case": case, "method": method, "variant": variant, "number": number, "predicted": predicted, "measured": measured,
            "measured_err": err, "outcome": outcome}


# --- runs -------------------------------------------------------------------------------------------------------------


def of_runs(tables: Tables) -> Iterator[dict[str, Any]]:
    """Points and the coarse grid against what is known."""
    runs = tables.get("hard_runs", pd.DataFrame())
    for _, run in runs.iterrows():
        if run["method"] == "grid" and run["rows"] > ROWS:
            continue
        scene, _ = {**LAYERS, **BOXES}[run["case"]]
        number, predicted, measured, err = told(runs, run)
        said = outcome(run, number, predicted, measured, err)
        if said == "diverges":
            number, predicted, measured, err = PART_OF_TIME, 1.0, run["reached"], 0.0
        yield entry(run["case"], run["method"], f"L {scene.L:g}", number, predicted, measured, err, said)


def told(runs: pd.DataFrame, run: pd.Series) -> tuple[str, float, float, float]:
    """Name of the number that decides, what it should be, what it is, and the error of what it should be."""
    if run["case"] == "wall corner":
        return "speed/c", 0.0, float(np.sqrt(2*run["k"])/SOUND), 0.0
    if run["case"] == "vacuum":
        return "K/exact", 1.0, float(run["k"]/Strip().kinetic(MIDDLE*BOXES["vacuum"][1])), 0.0
    if run["case"] == "zero viscosity":
        return "flow/start", 1.0, float(run["flow"]/run["flow_start"]), 0.0
    return ("flow/grid", 1.0, *against_grid(runs, run))


def against_grid(runs: pd.DataFrame, run: pd.Series) -> tuple[float, float]:
    """Flow over that of the finest grid that came to its end, and its error: that flow is off by what the next coarser one is.

    A grid is no judge of itself: neither the reference nor its error come from the rows that are judged.
    """
    grid = finished_grids(runs, run["case"])
    if run["method"] == "grid":
        grid = grid.drop(run["rows"], errors="ignore")
    if len(grid) < 2:
        return np.nan, np.nan
    ratio = float(run["flow"]/grid.iloc[-1])
    return ratio, float(abs(ratio*(grid.iloc[-2]/grid.iloc[-1] - 1)))


def finished_grids(runs: pd.DataFrame, case: str) -> pd.Series:
    """Flow by rows, from coarse to fine, of grids that came to their end."""
    grid = runs[(runs["case"] == case) & (runs["method"] == "grid")].dropna(subset=["flow"])
    return grid.sort_values("rows").set_index("rows")["flow"]


def outcome(run: pd.Series, number: str, predicted: float, measured: float, err: float) -> str:
    """By the rules at the head of this file."""
    if isinstance(run["refused"], str) and run["refused"]:
        return "refused"
    if not run["reached"] >= 1:
        return "diverges"
    if abs(run["mass_drift"]) > LEAK:
        return "leaks"
    if not np.isfinite(measured):
        return "unjudged"
    if number == "speed/c":
        return "right" if measured < SPURIOUS else "wrong"
    if measured < FROZEN:
        return "freezes"
    noisy = number == "flow/start" and abs(run["k"]/run["k_start"] - 1) > NEAR
    return "right" if abs(measured - predicted) <= NEAR + err and not noisy else "wrong"


def of_shear(tables: Tables) -> Iterator[dict[str, Any]]:
    """Growth of the wave on a shear flow over linear theory."""
    for (method,), rows in groups(tables, "shear", ["method"]):
        row = rows.iloc[0]
        ratio, err = row["measured"]/row["predicted"], row["measured_err"]/row["predicted"]
        off = abs(ratio - 1)
        said = ("diverges" if row["reached"] < 1 else "right" if off + err <= NEAR else "wrong" if off - err > NEAR
                else "unjudged")
        yield entry("shear layer", method, "L 16", "growth/linear", 1.0, ratio, err, said)


# --- limits, lattices, shocks, high Ra -----------------------------------------------------------------------------------


def of_limits(tables: Tables) -> Iterator[dict[str, Any]]:
    """Largest steps by methods' own formulas, what these leave for disorder given back."""
    for _, row in tables.get("limits", pd.DataFrame()).iterrows():
        if row["method"] in OTHER_FORMULAS:
            continue
        formula, measured, err = row["predicted"]*row["margin"], row["measured"], row["measured_err"]
        ratio = measured/formula if formula else np.inf
        said = "right" if abs(ratio - 1) <= NEAR else "safe" if ratio > 1 else "wrong"
        yield entry("time step", row["method"], row["scene"], "largest step", formula, measured, err, said)


def groups(tables: Tables, name: str, by: list[str]) -> Iterator[tuple[tuple, pd.DataFrame]]:
    """(values, rows) of a table by columns; none where the table is not there yet."""
    frame = tables.get(name)
    if frame is not None and len(frame):
        yield from ((tuple(values), rows) for values, rows in frame.groupby(by))


def of_lattices(tables: Tables) -> Iterator[dict[str, Any]]:
    """Where lattices pair and clump, what becomes of particles at rest, at which pressure they freeze."""
    for (parameter, lattice, weight, h, rho), rows in groups(tables, "onsets", ["parameter", "lattice", "weight", "h", "rho"]):
        case, said = {"h": ("pairs of a lattice", "pairs"), "T": ("negative pressure", "clumps")}[parameter]
        variant = lattice if parameter == "h" else f"{lattice}, h {h:g}, rho {rho:g}"
        yield entry(case, f"spam {weight}", variant, f"limit in {parameter}", rows["predicted"].mean(), rows["measured"].mean(),
                    rows["measured_err"].max(), said)
    for (weight, h), rows in groups(tables, "fates", ["weight", "h"]):
        shared = rows["shared"].mean()
        yield entry("left alone", f"spam {weight}", f"h {h:g}", "part that shares a site", float(rows["predicted"].iloc[0] > 1),
                    shared, float(np.ptp(rows["shared"])), "pairs" if shared > PAIRED else "right")
    for (eos, weight, ra, step), rows in groups(tables, "freezing_limits", ["eos", "weight", "ra", "step"]):
        said = "freezes" if np.isfinite(rows["measured"]).all() else "unjudged"
        variant = f"{eos}, Ra {ra:g}" + (f", step x {step:g}" if step != 1 else "")
        yield entry("background pressure", f"spam {weight}", variant, "P that freezes", rows["melting"].mean(),
                    rows["measured"].mean(), rows["measured_err"].max(), said)


def of_tubes(tables: Tables) -> Iterator[dict[str, Any]]:
    """Shock tubes by viscosity: how much v rings in the longest, or that one ended."""
    tubes, others = tables.get("tubes", pd.DataFrame()), tables.get("method_tubes", pd.DataFrame())
    if len(tubes):
        tubes = tubes.assign(method="spam printed", reached=tubes["diverged"].isna().astype(float))
    if len(others):
        others = others[(others["step"] == STEPS[0]) & (others["method"] != FINE)]
    both = pd.concat([one for one in (tubes, others) if len(one)] or [pd.DataFrame(columns=["method", "eta"])])
    for (method, eta), rows in both.groupby(["method", "eta"]):
        longest = rows[rows["L"] == rows["L"].max()]
        ring, error = longest["wiggles"], longest["v_grid" if eta else "v_exact"].mean()
        said = "right" if max(ring.mean(), error) <= NEAR else "wrong"
        number, predicted, measured, err = "ringing of v", 0.0, ring.mean(), float(np.ptp(ring))/2
        if rows["reached"].min() < 1:
            said, number, predicted, measured, err = "diverges", PART_OF_TIME, 1.0, rows["reached"].min(), 0.0
        yield entry("shock tube", str(method), f"eta {eta:g}", number, predicted, measured, err, said)


def of_high_ra(tables: Tables) -> Iterator[dict[str, Any]]:
    """From which Ra on a layer is bad, and ends; predicted from the cell number."""
    table = tables.get("high_ra_summary", pd.DataFrame(columns=["step"]))
    for _, row in table[table["step"] == 1].iterrows():
        said = "unjudged" if row["outcome"] == "none" else "diverges" if row["outcome"] == "ends" else "wrong"
        yield entry("highest Ra", row["method"], "first bad" if row["kind"] == "wrong" else "ends", "Ra", row["predicted"],
                    row["ra"], (row["ra_high"] - row["ra_low"])/2, said)


def of_interfaces(tables: Tables) -> Iterator[dict[str, Any]]:
    """The largest shocked interface."""
    ripples = tables.get("ripple_growth")
    if ripples is not None and len(ripples):
        row = ripples.sort_values("scale").iloc[-1]
        said = "right" if abs(row["growth"] - 1) <= NEAR + row["growth_err"] else "wrong"
        yield entry("shocked interface", "spam printed", f"scale {row['scale']:g}", "growth/linear", 1.0, row["growth"],
                    row["growth_err"], said)
