"""Energies of flows as questions, and what refuses to compare two that differ."""
from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pandas as pd

from studies.kit import stats
from studies.kit.ask import NoRows, Value, one, rows
from studies.kit.stats import CannotTell, Measured
from studies.kit.table import Tables
from studies.kit.value import each
from studies.rb.tables import SCENE, STILL, Point, grid

#: which K of the grid a claim takes, for its reason: two yardsticks are in use
PLAIN = "against the grid's K as it is, as the paper compares"
ALIKE = "against K of the grid's field smoothed by the same weight"


def guarded(value: Value, check: Callable[[Tables], object]) -> Value:
    """A question that is put only to tables that a check does not refuse."""
    def answer(tables: Tables) -> Measured:
        check(tables)
        return value(tables)
    return replace(value, answer=answer)


def mean(point: Point, column: str = "ke") -> Value:
    """A column of `means`, refused where runs diverged or seeds ended in different flows."""
    return guarded(one("means", column, **point), lambda tables: one_flow(tables, point))


def limit(ra: float, column: str = "ke", **where) -> Value:
    """The same of the compressible grid, extrapolated."""
    return mean(grid(ra, **where), column)


def alike(point: Point) -> Value:
    """K of the grid's field smoothed as the particles smooth theirs: that of Kg if the flow is right."""
    return one("errors", "reference", energy="Kg", **point)


def against_grid(point: Point, column: str = "ke_field") -> Value:
    """K of particles over that of the grid, extrapolated, in the same flow."""
    beside = grid(1.0) | {name: point[name] for name in SCENE}
    return same_flow(mean(point, column)/mean(beside), point, beside)


def against_alike(point: Point) -> Value:
    """Kg over K of the grid's field smoothed alike, in the same flow: 1 if it is right."""
    beside = grid(1.0) | {name: point[name] for name in SCENE}
    return same_flow(mean(point, "ke_field")/alike(point), point, beside)


def over_seeds(value: Value) -> Value:
    """Mean of what a question gives for each seed; its error is that of their scatter."""
    def answer(tables: Tables) -> Measured:
        return stats.over_seeds([seed.value for seed in each("seed", value, tables)])
    return Value(answer, f"mean over seeds of {value}", value.asks)


def over_runs(point: Point, energy: str = "ke_field") -> Value:
    """Mean of the runs of a point that have its rolls; its error is statistics alone, not of the step."""
    asked = one("kinetic_energy", energy, **point)

    def answer(tables: Tables) -> Measured:
        runs = rows(tables, "kinetic_energy", "ke == ke", **point)
        runs = runs[runs["rolls"] == one_flow(tables, point)["rolls"]]
        return stats.combine(list(zip(runs[energy], runs[f"{energy}_err"], strict=True)))
    return Value(answer, str(asked).replace("one", "mean over runs of one flow", 1), asked.asks)


def diverged(tables: Tables, point: Point) -> np.ndarray:
    """Which runs of a point diverged, (n,): their rows have no energy."""
    try:
        return rows(tables, "kinetic_energy", **point)["ke"].isna().to_numpy()
    except NoRows:
        return np.zeros(1, bool)


def refuse_diverged(point: Point) -> Callable[[Tables], None]:
    """A check that refuses a point of which any run diverged."""
    def check(tables: Tables) -> None:
        if diverged(tables, point).any():
            raise CannotTell(f"runs of {point['variant']} with {point['resolution']:g} rows diverged: no K")
    return check


def one_flow(tables: Tables, point: Point) -> pd.Series:
    """The row of `means` of one point.

    Raises
    ------
    CannotTell
        All runs diverged, or seeds ended in different flows: which one the point has is a matter of chance.
    """
    if diverged(tables, point).all():
        raise CannotTell(f"all runs of {point['method']}, {point['variant']} at Ra {point['ra']:g} diverged")
    row = rows(tables, "means", **point).iloc[0]
    if row["mixed"] > 0:
        seeds = row["mixed"] + row["seeds"]
        raise CannotTell(f"{row['mixed']:.0f} of {seeds:.0f} seeds of {point['variant']}, "
                         f"{point['resolution']:g} rows, ended with another number of rolls than the "
                         f"{row['rolls']:.0f} of the others at Ra {point['ra']:g}: the flow is not decided")
    return row


def same_flow(value: Value, point: Point, other: Point) -> Value:
    """A question that is refused where two points have different numbers of rolls.

    No rolls are no other flow: where motion has died, the energies tell.
    """
    def check(tables: Tables) -> None:
        a, b = rolls_in(tables, point), rolls_in(tables, other)
        if a != b and min(a, b) > 0:
            raise CannotTell(f"{a} rolls against {b} at Ra {point['ra']:g}: another flow, whose energy and "
                             "velocities say nothing on errors")
    return guarded(value, check)


def rolls_in(tables: Tables, point: Point) -> int:
    """Rolls of the seeds of which the mean is made; none where motion has died."""
    row = one_flow(tables, point)
    return int(row["rolls"]) if row["ke"] > STILL else 0


def rolls(point: Point) -> Value:
    """The same as a question that refuses what has died."""
    return guarded(mean(point, "rolls"), lambda tables: refuse_dead(one_flow(tables, point)))


def refuse_dead(row: pd.Series) -> None:
    """Refuse a row of `means` or `kinetic_energy` where nothing moves."""
    if not row["ke"] > STILL:
        raise CannotTell(f"K is {row['ke']:.1g} at the end: the flow has died, its rolls are of round-off")
