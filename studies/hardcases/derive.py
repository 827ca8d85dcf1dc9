"""Rows derived from those of runs: growth of ripples, the highest Ra, and the map.

Rules of the map, written before the runs. diverges: the run did not reach its end. leaks: mass changed by
more than LEAK. freezes: less than FROZEN of the flow is left. right: the number differs from its expected
value by at most NEAR plus the uncertainty of the reference; without viscosity by at most the tolerance of
`columns`, in all starts and steps of a size. wrong: stable, and none of these. refused: the method
itself rejects the case. unjudged: there is no reference, since fewer than two other grids reached their end,
or it is near to one that is itself unsure by more than NEAR (set after a look at Pr 0.01).
With 32 rows K is judged in place of the flow, whose averaging cells are those of 16 rows: set after a look.
"""
from collections.abc import Callable, Iterator
from typing import Any

import numpy as np
import pandas as pd

from studies.hardcases.columns import COLUMNS, HELD, LEFT, PAIRS
from studies.hardcases.extremes import BOXES, CHESSBOARD, ROWS, SOUND, rarefied
from studies.hardcases.printed import impulse
from studies.kit.fits import line
from studies.kit.stats import Measured, combine
from studies.kit.table import Row, Rows, Tables, groups

SETTLED = 0.3           # part of the time from the shock to its return after which the ripple grows steadily
ENOUGH = 0.65           # part of that time that a run has to last: half of what SETTLED leaves
LEAK, FROZEN, NEAR = 1e-3, 0.1, 0.1
SPURIOUS = 1e-3         # over the speed of sound: a hundredth of the flows of KHP95
MIDDLE = 50.5/60        # mean time of the samples 41 to 60 of 60
PART_OF_TIME = "part of the time"
HELD_TOO = PAIRS | {HELD.removesuffix("-entropy-stable"): HELD}


def derive(tables: Tables) -> Rows:
    """Derived rows of the study."""
    rows: dict[str, list[Row]] = {"map": []}
    if "ripples" in tables:
        rows["ripple_growth"] = list(ripple_growth(tables["ripples"]))
    if "high_ra" in tables:
        rows["high_ra_summary"] = list(high_ra_summary(tables["high_ra"]))
    for name, make in OF_MAP.items():
        if name in tables:
            rows["map"] += make(tables[name])
    rows["needs"] = list(needs(pd.DataFrame(rows["map"]))) if rows["map"] else []
    return {name: new for name, new in rows.items() if new}


def ripple_growth(ripples: pd.DataFrame) -> Iterator[Row]:
    """Growth rates of ripples over that of theory, means over the runs that lasted beyond ENOUGH.

    A rate is the slope of a straight line through the amplitudes after SETTLED.
    """
    for (scale, steep), group in groups(ripples.dropna(subset=["height"]), ["scale", "steep"]):
        theory = impulse(scale, steep)
        group = group.assign(part=(group.time - theory.meets)/(theory.back - theory.meets))
        lasted = group[group.groupby("seed").part.transform("max") > ENOUGH]
        lines = [line(run.time, run.amplitude) for _, run in groups(lasted[lasted.part > SETTLED], "seed")]
        if lines:
            growth, err = combine([one.slope/theory.growth for one in lines])
            yield {"scale": scale, "steep": steep, "seeds": len(lines), "growth": growth, "growth_err": err}


def high_ra_summary(limits: pd.DataFrame) -> Iterator[Row]:
    """Geometric mean and range of the limits of Ra over starts that have one; most frequent outcome there."""
    for (method, step, kind), rows in groups(limits, ["method", "step", "kind"]):
        bad = rows.dropna(subset=["ra"])
        yield {
            "method": method, "step": step, "kind": kind, "seeds": len(bad),
            "ra": np.exp(np.log(bad.ra).mean()), "ra_low": bad.ra.min(), "ra_high": bad.ra.max(),
            "outcome": bad.outcome.mode().get(0, "none"),
        }


def entry(case: str, method: str, variant: str, outcome: str, number: str, measured: Any, err: Any = 0.0,
          predicted: float = 1.0) -> Row:
    """A row of the map."""
    return {"case": case, "method": method, "variant": variant, "number": number, "predicted": predicted,
            "measured": measured, "measured_err": err, "outcome": outcome}


def of_runs(runs: pd.DataFrame) -> Iterator[Row]:
    """Rows of the map for `hard_runs`: particles, points and coarse grids against references."""
    judged = runs[(runs.method != "grid") | (runs.rows <= ROWS) | runs.case.isin(BOXES)]
    for _, run in judged.iterrows():
        number, ratio = decisive(runs, run)
        expected = 0.0 if number == "speed/c" else 1.0
        result = outcome(run, number, ratio)
        if result == "diverges":
            number, ratio, expected = PART_OF_TIME, Measured(run.reached), 1.0
        yield entry(run.case, run.method, f"L {run.rows:g}", result, number, *ratio, expected)


def decisive(runs: pd.DataFrame, run: pd.Series) -> tuple[str, Measured]:
    """Name and value of the number that decides a case; in layers it is compared with the grid's."""
    if run.case in ("wall corner", "long rest"):        # at rest but for errors
        return "speed/c", Measured(np.sqrt(2*run.k)/SOUND)
    if run.case == "vacuum":            # exact: two rarefactions
        return "K/exact", Measured(run.k/rarefied(MIDDLE*BOXES["vacuum"].time))
    if run.case in ("zero viscosity", "a million points"):      # nothing slows the flow down
        return "flow/start", Measured(run.flow/run.flow_start)
    if run.method != "grid" and run.rows != ROWS:       # averaging cells are another part of the height
        return "K/grid", over_grid(runs, run, "k")
    return "flow/grid", over_grid(runs, run, "flow")


def over_grid(runs: pd.DataFrame, run: pd.Series, name: str) -> Measured:
    """A column over that of the finest grid that reached its end; error: change from the next coarser one.

    A grid is not compared with itself: neither the reference nor its error use the rows that are judged.
    """
    grids = runs[(runs.case == run.case) & (runs.method == "grid")].dropna(subset=[name])
    if run.method == "grid":
        grids = grids[grids.rows != run.rows]
    if len(grids) < 2:
        return Measured(np.nan, np.nan)
    coarse, fine = grids.sort_values("rows")[name].iloc[-2:]
    ratio = run[name]/fine
    return Measured(ratio, abs(ratio*(coarse/fine - 1)))


def outcome(run: pd.Series, number: str, ratio: Measured) -> str:
    """The verdict on a run, by the rules at the head of this file."""
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
    if noisy or abs(ratio.value - 1) > NEAR + ratio.err:
        return "wrong"
    return "right" if ratio.err <= NEAR else "unjudged"


def of_probes(probes: pd.DataFrame) -> Iterator[Row]:
    """Rows of the map for densities that alternate, of which nothing should be left."""
    for _, run in probes.sort_values("method").iterrows():
        result = "diverges" if run.reached < 1 else "right" if run.measured <= NEAR else "wrong"
        yield entry(run.case, run.method, f"L {CHESSBOARD.L:g}", result, LEFT, run.measured, predicted=0.0)


def of_trials(trials: pd.DataFrame) -> Iterator[Row]:
    """Rows of the map for trials: of all starts and steps of a size the worst value, or an early end."""
    for (case, method, rows), runs in groups(trials, ["case", "method", "rows"]):
        column, place, reached = COLUMNS[case], (case, method, f"{rows} rows"), runs.reached.min()
        if runs.refused.any():
            yield entry(*place, "refused", column.number, np.nan, predicted=column.expected)
        elif reached < 1:
            yield entry(*place, "diverges", PART_OF_TIME, reached)
        else:
            values = runs.measured.to_numpy()
            value = values[np.argmax(np.abs(values - column.expected))]
            stops = column.number == LEFT and value < FROZEN
            result = "freezes" if stops else "right" if column.right(value) else "wrong"
            yield entry(*place, result, column.number, value, np.ptp(values)/2, column.expected)


def needs(rows: pd.DataFrame) -> Iterator[Row]:
    """Outcomes of the same edges in the same case without and with the entropy-stable flux."""
    outcomes: dict[Any, str] = rows.set_index(["case", "variant", "method"]).outcome.to_dict()
    for (case, variant, method), outcome in outcomes.items():
        if other := outcomes.get((case, variant, HELD_TOO.get(method, ""))):
            yield {"case": case, "method": method, "variant": variant, "without": outcome, "listed": other,
                   "needed": "yes" if outcome == "diverges" != other else "no"}


#: table -> what makes its rows of the map
OF_MAP: dict[str, Callable[[pd.DataFrame], Iterator[Row]]] = {
    "hard_runs": of_runs, "probes": of_probes, "trials": of_trials}
