"""The tables, and rows that follow from whole ones: growth of ripples, the highest Ra, and the map.

Rules of the map, written before the runs. diverges: the run did not reach its end. leaks: mass changed by
more than LEAK. freezes: less than FROZEN of the flow is left. right: the number is within NEAR, and what the
reference is uncertain by, of what it should be. wrong: stable, and none of these. A shock tube is right if v
neither rings nor is off by more than NEAR, and diverges if a tube of any length did. refused: the method says
itself that it does not take the case. unjudged: there is nothing to hold it against, since no two grids
besides itself came to their end, or a rate is known to worse than NEAR.
"""
from collections.abc import Callable, Iterator
from typing import Any

import numpy as np
import pandas as pd

from studies.hardcases.extremes import BOXES, ROWS, SITUATIONS, SOUND, rarefied
from studies.hardcases.printed import impulse
from studies.hardcases.survival import PROBES
from studies.hardcases.tubes import STEPS
from studies.kit.fits import line
from studies.kit.stats import Measured, combine, over_seeds
from studies.kit.table import Rows, Table, Tables, groups

Row = dict[str, Any]
SETTLED = 0.3           # part of the time from the shock to its return that the ripple takes to grow steadily
ENOUGH = 0.65           # until which a run has to last: half of what is then left
LEAK, FROZEN, NEAR = 1e-3, 0.1, 0.1
SPURIOUS = 1e-3         # of the speed of sound: a hundredth of what flows of KHP95 have
MIDDLE = 50.5/60        # mean time of the samples 41 to 60 of 60
PART_OF_TIME = "part of the time"


def derive(tables: Tables) -> Rows:
    """Derived rows of the study."""
    rows: dict[str, list[Row]] = {"map": []}
    if "ripples" in tables:
        rows["ripple_growth"] = list(ripple_growth(tables["ripples"]))
    if "high_ra" in tables and "high_ra_grid" in tables:
        rows["high_ra_summary"] = list(high_ra_summary(tables["high_ra"], tables["high_ra_grid"]))
    for name, make in OF_MAP.items():
        if name in tables:
            rows["map"] += make(tables[name])
    return {name: new for name, new in rows.items() if new}


def ripple_growth(ripples: pd.DataFrame) -> Iterator[Row]:
    """Growth rates over that of theory: means over the runs that lasted, also of those that ended late.

    Straight lines through amplitudes once growth is steady.
    """
    for (scale, steep), group in groups(ripples.dropna(subset=["height"]), ["scale", "steep"]):
        theory = impulse(scale, steep)
        group = group.assign(part=(group.time - theory.meets)/(theory.back - theory.meets))
        lasted = group[group.groupby("seed").part.transform("max") > ENOUGH]
        lines = [line(run.time, run.amplitude) for _, run in groups(lasted[lasted.part > SETTLED], "seed")]
        if lines:
            growth, err = combine([one.slope/theory.growth for one in lines])
            yield {"scale": scale, "steep": steep, "seeds": len(lines), "growth": growth, "growth_err": err}


def high_ra_summary(limits: pd.DataFrame, grid: pd.DataFrame) -> Iterator[Row]:
    """Geometric means and extremes over starts that have a limit; what most of these do beyond it.

    Cell numbers of the fastest flow are a power of Ra, through the fine grid's.
    """
    fine = grid.dropna(subset=["cell_number"])
    slope, constant = np.polyfit(np.log(fine.ra), np.log(fine.cell_number), 1)
    for (method, step, kind), rows in groups(limits, ["method", "step", "kind"]):
        bad = rows.dropna(subset=["ra"])
        highest = np.log(rows.ra.fillna(rows.tried))
        cell = over_seeds(np.exp(constant + slope*highest))
        yield {
            "method": method, "step": step, "kind": kind, "seeds": len(bad),
            "ra": np.exp(np.log(bad.ra).mean()), "ra_low": bad.ra.min(), "ra_high": bad.ra.max(),
            "outcome": bad.outcome.mode().get(0, "none"),
            "cell_number": cell.value, "cell_number_err": cell.err,
        }


def entry(case: str, method: str, variant: str, outcome: str, number: str, measured: Any, err: Any = 0.0,
          predicted: float = 1.0) -> Row:
    """A row of the map."""
    return {"case": case, "method": method, "variant": variant, "number": number, "predicted": predicted,
            "measured": measured, "measured_err": err, "outcome": outcome}


def of_runs(runs: pd.DataFrame) -> Iterator[Row]:
    """Points and the coarse grid against what is known."""
    judged = runs[(runs.method != "grid") | (runs.rows <= ROWS) | runs.case.isin(BOXES)]
    for _, run in judged.iterrows():
        number, ratio = decisive(runs, run)
        expected = 0.0 if number == "speed/c" else 1.0
        result = outcome(run, number, ratio)
        if result == "diverges":
            number, ratio, expected = PART_OF_TIME, Measured(run.reached), 1.0
        variant = f"L {SITUATIONS[run.case].scene.L:g}"
        yield entry(run.case, run.method, variant, result, number, *ratio, expected)


def decisive(runs: pd.DataFrame, run: pd.Series) -> tuple[str, Measured]:
    """The number that decides a case, by its name: layers are held against the grid."""
    if run.case in ("wall corner", "long rest"):        # of what should be at rest
        return "speed/c", Measured(np.sqrt(2*run.k)/SOUND)
    if run.case == "vacuum":            # of two rarefactions
        return "K/exact", Measured(run.k/rarefied(MIDDLE*BOXES["vacuum"].time))
    if run.case in ("zero viscosity", "a million points"):      # nothing slows the flow down
        return "flow/start", Measured(run.flow/run.flow_start)
    return "flow/grid", flow_over_grid(runs, run)


def flow_over_grid(runs: pd.DataFrame, run: pd.Series) -> Measured:
    """Flow over that of the finest grid that came to its end; error: what the next coarser one changes.

    A grid is no judge of itself: neither the reference nor its error come from the rows that are judged.
    """
    grids = runs[(runs.case == run.case) & (runs.method == "grid")].dropna(subset=["flow"])
    if run.method == "grid":
        grids = grids[grids.rows != run.rows]
    if len(grids) < 2:
        return Measured(np.nan, np.nan)
    coarse, fine = grids.sort_values("rows").flow.iloc[-2:]
    ratio = run.flow/fine
    return Measured(ratio, abs(ratio*(coarse/fine - 1)))


def outcome(run: pd.Series, number: str, ratio: Measured) -> str:
    """By the rules at the head of this file."""
    if isinstance(run.refused, str) and run.refused:
        return "refused"
    if not run.reached >= 1:
        return "diverges"
    if abs(run.mass_drift) > LEAK:
        return "leaks"
    if not np.isfinite(ratio.value):
        return "unjudged"
    if number == "speed/c":
        return "right" if ratio.value < SPURIOUS else "wrong"
    if ratio.value < FROZEN:
        return "freezes"
    noisy = number == "flow/start" and abs(run.k/run.k_start - 1) > NEAR
    return "right" if abs(ratio.value - 1) <= NEAR + ratio.err and not noisy else "wrong"


def of_probes(probes: pd.DataFrame) -> Iterator[Row]:
    """Numbers over what is known, or next to nothing: right or wrong if the whole interval is."""
    for _, run in probes.sort_values(["case", "method"]).iterrows():
        ratio = Measured(run.measured, run.measured_err)/(run.predicted or 1.0)
        wanted, (scene, _, number) = float(run.predicted != 0), PROBES[run.case]
        difference = abs(ratio.value - wanted)
        result = "unjudged"
        if run.reached < 1:
            result = "diverges"
        elif difference + ratio.err <= NEAR:
            result = "right"
        elif difference - ratio.err > NEAR:
            result = "wrong"
        yield entry(run.case, run.method, f"L {scene.L:g}", result, number, *ratio, wanted)


def of_tubes(tubes: pd.DataFrame) -> Iterator[Row]:
    """Shock tubes by viscosity, usual step: how much v rings in the longest, or that one ended."""
    usual = tubes[tubes.step != min(STEPS)]
    for (method, eta), rows in groups(usual, ["method", "eta"]):
        place, reached = ("shock tube", method, f"eta {eta:g}"), rows.reached.min()
        if reached < 1:
            yield entry(*place, "diverges", PART_OF_TIME, reached)
            continue
        longest = rows.query("L == L.max()")
        error, ring = longest["v_grid" if eta else "v_exact"].mean(), longest.wiggles
        result = "right" if max(ring.mean(), error) <= NEAR else "wrong"
        yield entry(*place, result, "ringing of v", ring.mean(), np.ptp(ring)/2, 0.0)


#: table -> rows of the map
OF_MAP: dict[str, Callable[[pd.DataFrame], Iterator[Row]]] = {
    "hard_runs": of_runs, "probes": of_probes, "method_tubes": of_tubes}


# --- tables: lengths in spacings, masses of particles or points; `_err` 95 % half widths --------------------

TUBE = "method eta step L seed"

MEAN_FLOW = ("K of the flow of the last third: velocities averaged over 4 x 4 spacings", "epsilon/m")
STEP = {"step": ("step over that at the limit of stability", "")}

TABLES = (
    Table.of("squares", "eos weight ra seed", "alpha rolls begun flow ratio ratio_err shared",
             about="Particles in the square box of KHP95's Fig. 10 at the end.",
             means={"flow": ("K of the mean flow", "epsilon/m"),
                    "ratio": ("median of second over first neighbour distance", "")}),
    Table.of("method_tubes", TUBE, "rho_exact v_exact P_exact rho_grid v_grid P_grid wiggles reached",
             means=STEP, about="Sod's shock tube by one method, at the end."),
    Table.of("method_tube_profiles", f"{TUBE} x", "rho v P", large=True,
             digits=dict.fromkeys(("x", "rho", "v", "P"), ".5g"), about="A place of such a tube.",
             means=STEP | {"x": ("distance from the diaphragm", "L")}),
    Table.of("ripples", "scale steep seed time", "height amplitude",
             about="An instant of an interface that a shock runs over [KHP95, Fig. 11]."),
    Table.of("ripple_growth", "scale steep", "seeds growth growth_err",
             about="The growth of such ripples, means over seeds.",
             means={"growth": ("growth rate over that of theory", "")}),
    Table.of("high_ra_grid", "ra rows", "k cell_number reached",
             about="A run of the fine grid at high Ra.",
             means={"cell_number": ("cell number v a/nu of the fastest flow at the end, a of 16 rows", "")}),
    Table.of("high_ra_trials", "method step seed ra", "k over reached",
             about="A run of the search for the highest Ra."),
    Table.of("high_ra", "method step seed kind", "ra ra_err tried outcome",
             about="What a search found.",
             means={"kind": ("wrong: K is, or the run ended; ends: the run ended", ""),
                    "ra": ("Ra from which on runs are so; none if they are nowhere. Its error is half of the "
                           "interval between two trials", ""),
                    "outcome": ("of the first bad run", "")}),
    Table.of("high_ra_summary", "method step kind",
             "ra ra_low ra_high seeds outcome cell_number cell_number_err",
             about="The same over seeds, means of logarithms.",
             means={"kind": ("wrong or ends", ""), "ra": ("Ra from which on runs are so", ""),
                    "outcome": ("what most runs do there", ""),
                    "cell_number": ("cell number at that Ra, or at the highest Ra tried", "")}),
    Table.of("hard_runs", "case method rows", "k flow mass_drift k_start flow_start reached refused",
             about="A hard case by one method.", means={"flow": MEAN_FLOW}),
    Table.of("probes", "case method", "predicted measured measured_err reached",
             about="A number that is known, by one method.",
             means={"measured": ("shear layer: rate in 1/t0; other: over the start", "")}),
    Table.of("riemann", "method problem cells seed",
             "rho_exact v_exact P_exact wiggles reached switched halved limited",
             about="A Riemann problem without viscosity, in the half of it that no wave has left.",
             means={"cells": ("spacings of Toro's unit of length", ""), "problem": ("which", ""),
                    "switched": ("share of edges that dissipate, mean over steps", ""),
                    "halved": ("parts of steps that were halved", ""),
                    "limited": ("Euler steps with limits", "")}),
    Table.of("smooth_flows", "scene method rows", "value",
             about="A smooth flow by the same edges with and without a flux that survives.",
             means={"value": ("K of convection; rms error of velocities over the fastest of the start", "")}),
    Table.of("map", "case method variant", "number predicted measured measured_err outcome",
             about="The verdict on a method in a hard case.",
             means={"variant": ("which runs of the case", ""),
                    "outcome": ("by the rules at the head of studies/hardcases/derive.py", "")}),
)
