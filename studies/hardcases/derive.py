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
from typing import Any, NamedTuple

import numpy as np
import pandas as pd

from studies.hardcases.extremes import BOXES, ROWS, SITUATIONS, SOUND, rarefied
from studies.hardcases.interface import impulse
from studies.hardcases.tubes import CELL_NUMBER, STEPS
from studies.kit.fits import line
from studies.kit.stats import Measured, combine, over_seeds
from studies.kit.table import Rows, Tables, groups

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
    frames = tables | {name: pd.DataFrame(new) for name, new in rows.items()}
    for name, make in OF_MAP.items():
        if len(frames.get(name, ())):
            rows["map"] += make(frames[name])
    return {name: new for name, new in rows.items() if new}


def ripple_growth(ripples: pd.DataFrame) -> Iterator[Row]:
    """Growth rates over that of theory: means over the runs that lasted, also of those that ended late.

    Straight lines through amplitudes once growth is steady.
    """
    for (scale, steep), group in groups(ripples.dropna(subset=["height"]), ["scale", "steep"]):
        theory = impulse(scale, steep)
        returns = theory.back - theory.meets
        rates = []
        for _, run in groups(group, "seed"):
            late = run[run.time > theory.meets + SETTLED*returns]
            if run.time.max() > theory.meets + ENOUGH*returns:
                rates.append(line(late.time, late.amplitude).slope/theory.growth)
        if rates:
            growth, err = combine(rates)
            yield {"scale": scale, "steep": steep, "seeds": len(rates), "growth": growth, "growth_err": err}


def high_ra_summary(limits: pd.DataFrame, grid: pd.DataFrame) -> Iterator[Row]:
    """Geometric means and extremes over starts that have a limit; what most of these do beyond it.

    Cell numbers of the fastest flow are a power of Ra, through the fine grid's.
    """
    fine = grid.dropna(subset=["cell_number"])
    slope, constant = np.polyfit(np.log(fine.ra), np.log(fine.cell_number), 1)
    predicted = float(np.exp((np.log(CELL_NUMBER) - constant)/slope))
    for (method, step, kind), rows in groups(limits, ["method", "step", "kind"]):
        bad = rows.dropna(subset=["ra"])
        highest = rows.ra.fillna(rows.tried)
        cell = over_seeds(np.exp(constant + slope*np.log(highest)))
        yield {
            "method": method, "step": step, "kind": kind, "seeds": len(bad),
            "predicted": predicted if kind == "wrong" else np.nan,
            "ra": np.exp(np.log(bad.ra).mean()),
            "ra_low": bad.ra.min(),
            "ra_high": bad.ra.max(),
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
    judged = runs[(runs.method != "grid") | (runs.rows <= ROWS)]
    for _, run in judged.iterrows():
        known = DECISIVE.get(run.case, LIKE_GRID)
        ratio = known.ratio(runs, run)
        result = outcome(run, known, ratio)
        variant = f"L {SITUATIONS[run.case].scene.L:g}"
        if result == "diverges":
            yield entry(run.case, run.method, variant, result, PART_OF_TIME, run.reached)
        else:
            yield entry(run.case, run.method, variant, result, known.number, *ratio, known.predicted)


def speed(runs: pd.DataFrame, run: pd.Series) -> Measured:
    """Of what should be at rest, over that of sound."""
    return Measured(float(np.sqrt(2*run.k)/SOUND))


def energy_over_exact(runs: pd.DataFrame, run: pd.Series) -> Measured:
    """K of two rarefactions."""
    exact = rarefied(MIDDLE*BOXES["vacuum"].time)
    return Measured(float(run.k/exact))


def flow_over_start(runs: pd.DataFrame, run: pd.Series) -> Measured:
    """What is left of a flow that nothing slows down."""
    return Measured(float(run.flow/run.flow_start))


def flow_over_grid(runs: pd.DataFrame, run: pd.Series) -> Measured:
    """Flow over that of the finest grid that came to its end; error: what the next coarser one changes.

    A grid is no judge of itself: neither the reference nor its error come from the rows that are judged.
    """
    grid = finished_grids(runs, run.case)
    if run.method == "grid":
        grid = grid.drop(run.rows, errors="ignore")
    if len(grid) < 2:
        return Measured(np.nan, np.nan)
    coarse, fine = grid.iloc[-2:]
    ratio = float(run.flow/fine)
    return Measured(ratio, float(abs(ratio*(coarse/fine - 1))))


def finished_grids(runs: pd.DataFrame, case: str) -> pd.Series:
    """Flow by rows, from coarse to fine, of grids that came to their end."""
    grid = runs[(runs.case == case) & (runs.method == "grid")].dropna(subset=["flow"])
    return grid.set_index("rows").flow.sort_index()


class Decisive(NamedTuple):
    """What decides a case: the name of the number, how it follows from a run, what it should be."""
    number: str
    ratio: Callable[[pd.DataFrame, pd.Series], Measured]
    predicted: float = 1.0


LIKE_GRID = Decisive("flow/grid", flow_over_grid)
#: all other cases are like the grid
DECISIVE = {
    "wall corner": Decisive("speed/c", speed, 0.0),
    "vacuum": Decisive("K/exact", energy_over_exact),
    "zero viscosity": Decisive("flow/start", flow_over_start),
}


def outcome(run: pd.Series, known: Decisive, ratio: Measured) -> str:
    """By the rules at the head of this file."""
    if isinstance(run.refused, str) and run.refused:
        return "refused"
    if not run.reached >= 1:
        return "diverges"
    if abs(run.mass_drift) > LEAK:
        return "leaks"
    if not np.isfinite(ratio.value):
        return "unjudged"
    if known.number == "speed/c":
        return "right" if ratio.value < SPURIOUS else "wrong"
    if ratio.value < FROZEN:
        return "freezes"
    noisy = known.number == "flow/start" and abs(run.k/run.k_start - 1) > NEAR
    near = abs(ratio.value - known.predicted) <= NEAR + ratio.err
    return "right" if near and not noisy else "wrong"


def of_shear(shear: pd.DataFrame) -> Iterator[Row]:
    """Growth of the wave on a shear flow over linear theory: right or wrong if the whole interval is."""
    for _, run in shear.sort_values("method").iterrows():
        ratio = Measured(run.measured, run.measured_err)/run.predicted
        difference = abs(ratio.value - 1)
        result = "unjudged"
        if run.reached < 1:
            result = "diverges"
        elif difference + ratio.err <= NEAR:
            result = "right"
        elif difference - ratio.err > NEAR:
            result = "wrong"
        yield entry("shear layer", run.method, "L 16", result, "growth/linear", *ratio)


def of_tubes(tubes: pd.DataFrame) -> Iterator[Row]:
    """Shock tubes by viscosity, usual step: how much v rings in the longest, or that one ended."""
    tubes = tubes[tubes.step != min(STEPS)]
    for (method, eta), rows in groups(tubes, ["method", "eta"]):
        variant = f"eta {eta:g}"
        reached = rows.reached.min()
        if reached < 1:
            yield entry("shock tube", method, variant, "diverges", PART_OF_TIME, reached)
            continue
        longest = rows.query("L == L.max()")
        error = longest["v_grid" if eta else "v_exact"].mean()
        ring = longest.wiggles
        mean = ring.mean()
        result = "right" if max(mean, error) <= NEAR else "wrong"
        yield entry("shock tube", method, variant, result, "ringing of v", mean, np.ptp(ring)/2, 0.0)


def of_high_ra(summary: pd.DataFrame) -> Iterator[Row]:
    """From which Ra on a layer is bad, and ends; predicted from the cell number."""
    results = {"none": "unjudged", "ends": "diverges"}
    for _, row in summary.query("step == 1").iterrows():
        variant = "first bad" if row.kind == "wrong" else "ends"
        result = results.get(row.outcome, "wrong")
        err = (row.ra_high - row.ra_low)/2
        yield entry("highest Ra", row.method, variant, result, "Ra", row.ra, err, row.predicted)


#: table -> rows of the map
OF_MAP: dict[str, Callable[[pd.DataFrame], Iterator[Row]]] = {
    "hard_runs": of_runs, "shear": of_shear, "method_tubes": of_tubes,
    "high_ra_summary": of_high_ra}
