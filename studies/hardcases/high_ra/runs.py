"""Up to which Rayleigh number do 16 rows last? KHP95's layer, followed for 50 free-fall times, Ra halved in upon.

A run is wrong if K of its last third is off by a factor of more than OFF from the grid's of 48 rows at the same Ra, or if it
ended before. The map calls a tenth wrong, of flow at Ra 1e5 and 1e6; grids of 16 and of 96 rows differ by a tenth in K at Ra 1e5,
so that OFF leaves room for as much again. Ra is raised by half decades until a run is wrong, and beyond until one ends; then the
interval is halved, on the scale of v a/nu of the free-fall velocity, (Ra/Pr)^(1/2)/16. Whether K is off is asked up to 1e6 only,
as far as the fine grid has been seen to come. All is done again in shorter steps, since v grows after these are chosen.

Expected: central differences keep order while v a/nu of the fastest flow, that of the fine grid, is below 2. This is no limit of
stability: no formula is known that says where a run ends.
"""
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import cache
from math import log
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd

from studies.build.unguarded import bisected
from studies.hardcases.high_ra.methods import METHODS, Trial, grid_run
from studies.hardcases.map.scenes import ROWS
from studies.kit.case import Case, Outcome, Report
from studies.kit.table import Table, Tables

OFF = 1.25              # factor in K
STEPS = (1.0, 0.25)     # over those of other studies
FINE, FINER = 32, 48    # rows of grids that tell what K should be: the second, from which the first tells how far off it may be
RUNGS = tuple(float(f"{10.0**(n/2):.9g}") for n in range(8, 17))        # 1e4 .. 1e8
TOLD = 1e6              # up to which K is held against the fine grid
CELL_NUMBER = 2.0       # of the fastest flow, beyond which central differences are expected to ring

#: K of the last third and cell number v a/nu of the fastest flow at the end, a of 16 rows; reached: part of the time
REFERENCE = Table("high_ra_grid", key=["ra", "rows"], columns=["ra", "rows", "k", "cell_number", "reached"])
#: every run of a search: K of its last third, over that of the fine grid where this is known
TRIALS = Table("high_ra_trials", key=["method", "step", "seed", "ra"],
               columns=["method", "step", "seed", "ra", "k", "over", "reached"])
#: Ra from which on runs are wrong (K, or they ended), and end; half of the interval between two trials; none is up to `tried` if
#: nothing is told
#: again: trials beyond it that are not bad, as where islands end; outcome: of the first bad one
LIMITS = Table("high_ra", key=["method", "step", "seed", "kind"],
               columns=["method", "step", "seed", "kind", "ra", "ra_err", "tried", "again", "outcome"])
#: means over seeds, of logarithms; predicted: where the cell number of the fastest flow is 2; outcome: wrong but stable, or ends
SUMMARY = Table("high_ra_summary", key=["method", "step", "kind"],
                columns=["method", "step", "kind", "predicted", "ra", "ra_low", "ra_high", "seeds", "outcome"])
TABLES = (REFERENCE, TRIALS, LIMITS, SUMMARY)


# --- what K should be -------------------------------------------------------------------------------------------------


@cache
def reference(rows: int) -> list[dict[str, float]]:
    """Rows of the table: the fine grid on the rungs up to TOLD."""
    found = []
    for ra in RUNGS:
        if ra <= TOLD:
            trial, cell_number = grid_run(ra, 1, 1.0, rows)
            found.append({"ra": ra, "rows": rows, "k": trial.k, "cell_number": cell_number, "reached": trial.reached})
    return found


def should_be(ra: float) -> float:
    """K of the fine grid, linear between rungs in Ra^(-1/2)    [KHP95, Sec. VI]; nothing beyond TOLD."""
    x, k = np.array([(row["ra"]**-0.5, row["k"]) for row in reference(FINER)])[::-1].T
    return float(np.interp(ra**-0.5, x, k)) if ra <= TOLD*(1 + 1e-9) else np.nan


@dataclass(frozen=True, kw_only=True)
class FineGrid(Case):
    """What K should be."""
    rows: int

    @property
    def cost(self) -> float:
        return 1.5e-4*self.rows**3

    @property
    def label(self) -> str:
        return f"high Ra, grid of {self.rows} rows"

    def run(self, report: Report, folder: Path) -> Outcome:
        return Outcome({"high_ra_grid": reference(self.rows)})


# --- the search -------------------------------------------------------------------------------------------------------


class Search:
    """Trials of one method, each run once."""

    def __init__(self, method: str, seed: int, step: float):
        self.method, self.seed, self.step, self.found = method, seed, step, dict[float, Trial]()

    def at(self, ra: float) -> Trial:
        """The run at a Rayleigh number, of which nine digits count: a rung is met again as the square of a root."""
        ra = float(f"{ra:.9g}")
        if ra not in self.found:
            self.found[ra] = METHODS[self.method](ra, self.seed, self.step)
        return self.found[ra]

    def ends(self, ra: float) -> bool:
        """Before its time."""
        return self.at(ra).reached < 1

    def wrong(self, ra: float) -> bool:
        """Ends, or K is off."""
        return self.ends(ra) or abs(log(self.at(ra).k/should_be(ra))) > log(OFF)

    def seek(self, bad: Callable[[float], bool], rungs: tuple[float, ...]) -> None:
        """Try up to the first rung at which a run is bad, and halve the interval."""
        for ra in rungs:
            if bad(ra):
                bisected(lambda cell: bad((ROWS*cell)**2), ra**0.5/ROWS)
                return

    def limit(self, bad: Callable[[float], bool], most: float) -> dict[str, Any]:
        """Of all trials up to `most` the first that is bad, and the last before it: a search may have passed over an island."""
        tried = sorted(ra for ra in self.found if ra <= most)
        judged = [bad(ra) for ra in tried]
        if not any(judged):
            return {"ra": np.nan, "ra_err": np.nan, "tried": tried[-1], "again": 0, "outcome": "none"}
        first = judged.index(True)
        low, high = tried[max(first - 1, 0)], tried[first]
        return {"ra": (low*high)**0.5, "ra_err": (high - low)/2, "tried": tried[-1], "again": judged[first:].count(False),
                "outcome": "ends" if self.ends(high) else "wrong but stable"}


@dataclass(frozen=True, kw_only=True)
class HighRa(Case):
    """One method's limits from one start. step : over that of other studies."""
    method: str
    seed: int
    step: float = STEPS[0]

    @property
    def cost(self) -> float:
        return (60.0 if self.method == "moving" else 10.0)/self.step

    @property
    def label(self) -> str:
        return f"high Ra, {self.method}, seed {self.seed}, step {self.step:g}"

    def run(self, report: Report, folder: Path) -> Outcome:
        search = Search(self.method, self.seed, self.step)
        key = {"method": self.method, "step": self.step, "seed": self.seed}
        search.seek(search.wrong, tuple(ra for ra in RUNGS if ra <= TOLD))
        search.seek(search.ends, RUNGS)
        rows = [{**key, "kind": kind, **search.limit(bad, most)}
                for kind, bad, most in (("wrong", search.wrong, TOLD), ("ends", search.ends, RUNGS[-1]))]
        trials = [{**key, "ra": ra, "k": trial.k, "over": trial.k/should_be(ra), "reached": trial.reached}
                  for ra, trial in search.found.items()]
        return Outcome({"high_ra": rows, "high_ra_trials": trials})


def cases(size: str) -> Iterator[Case]:
    """Five starts each, three of the moving points, which cost most."""
    if size != "quick":
        yield from (FineGrid(rows=rows) for rows in (FINE, FINER))
        yield from (HighRa(method=method, seed=seed, step=step) for method in METHODS for step in STEPS
                    for seed in range(1, 4 if method == "moving" else 6))


# --- what follows -----------------------------------------------------------------------------------------------------


def derive(tables: Tables) -> dict[str, list[dict[str, Any]]]:
    """Means over starts, and what is expected."""
    if "high_ra" not in tables or "high_ra_grid" not in tables:
        return {}
    slope, constant = cell_numbers(tables["high_ra_grid"])
    return {"high_ra_summary": list(summary(tables["high_ra"], float(np.exp((log(CELL_NUMBER) - constant)/slope))))}


def cell_numbers(grid: pd.DataFrame) -> tuple[float, float]:
    """Slope and constant of ln(cell number of the fastest flow) over ln Ra, through the fine grid's; goes on beyond its ends."""
    rows = grid[grid["rows"] == FINER].dropna(subset=["cell_number"])
    slope, constant = np.polyfit(np.log(rows["ra"]), np.log(rows["cell_number"]), 1)
    return float(slope), float(constant)


def summary(limits: pd.DataFrame, predicted: float) -> Iterator[dict[str, Any]]:
    """Geometric means, the lowest and the highest, over starts that have a limit; what most of these do beyond it."""
    for (method, step, kind), rows in limits.groupby(["method", "step", "kind"]):
        ra, said = rows["ra"].dropna(), rows.loc[rows["ra"].notna(), "outcome"].mode()
        yield {"method": method, "step": step, "kind": kind, "predicted": predicted if kind == "wrong" else np.nan,
               "ra": float(np.exp(np.log(ra).mean())), "ra_low": ra.min(), "ra_high": ra.max(), "seeds": len(ra),
               "outcome": said.iloc[0] if len(said) else "none"}
