"""Values of claims from the tables of the study operators."""
from collections.abc import Callable
from typing import Any

import numpy as np
import pandas as pd

from particles.weights import WEIGHTS
from studies.build.read import Value, select
from studies.kit.claim import CannotTell
from studies.kit.stats import Measured
from studies.kit.table import Tables

COMPACT = tuple(kind.__name__ for kind in WEIGHTS.values())
Number = Callable[[pd.DataFrame], Any]


def cell(name: str, column: str, **where: Any) -> Value:
    """One number of one row, with its error where the table has one."""
    def value(tables: Tables) -> Measured:
        row = select(tables, name, **where).iloc[0]
        return Measured(float(row[column]), float(row.get(f"{column}_err", 0.0)))
    return value


def most(name: str, number: Number, err: Number | None = None, **where: Any) -> Value:
    """Largest of a number over the rows, with the largest error."""
    def value(tables: Tables) -> Measured:
        rows = chosen(tables, name, **where)
        return Measured(float(np.max(number(rows))), float(np.max(err(rows))) if err else 0.0)
    return value


def least(name: str, number: Number, **where: Any) -> Value:
    """Smallest of a number over the rows."""
    def value(tables: Tables) -> Measured:
        return Measured(float(np.min(number(chosen(tables, name, **where)))), 0.0)
    return value


def worst(*values: Value) -> Value:
    """Largest of several numbers, with the largest error."""
    def value(tables: Tables) -> Measured:
        found = [each(tables) for each in values]
        return Measured(max(m.value for m in found), max(m.err for m in found))
    return value


def chosen(tables: Tables, name: str, **where: Any) -> pd.DataFrame:
    """Rows by columns, of which a tuple lists several values; those without numbers (where no edges exist) left out.

    Raises
    ------
    CannotTell
        There are none.
    """
    several = {column: value for column, value in where.items() if isinstance(value, tuple)}
    rows = select(tables, name, **{column: value for column, value in where.items() if column not in several})
    for column, values in several.items():
        rows = rows[rows[column].isin(values)]
    rows = rows.dropna(axis=1, how="all").dropna()
    if rows.empty:
        raise CannotTell(f"not run yet: table {name} has no row of {where}; a larger SIZE of the study may run it")
    return rows


def column(name: str) -> Number:
    """A column as it is."""
    return lambda rows: rows[name]


def size(name: str) -> Number:
    """Its absolute value."""
    return lambda rows: rows[name].abs()


def off(name: str, centre: float | str = 1.0) -> Number:
    """Distance of a column from a number, or from another column."""
    return lambda rows: (rows[name] - (rows[centre] if isinstance(centre, str) else centre)).abs()


def relative(name: str, to: str) -> Number:
    """|column/other - 1|."""
    return lambda rows: (rows[name]/rows[to] - 1).abs()


def by_width(tables: Tables, d: int, how: str, n: int, **where: Any) -> pd.DataFrame:
    """Rows of `lattice` of the exponential weight, the widest two or three last.

    Raises
    ------
    CannotTell
        There are fewer than three.
    """
    rows = chosen(tables, "lattice", weight="Exponential", d=d, how=how, n=n, **where).sort_values("r0")
    if len(rows) < 3:
        raise CannotTell(f"not run yet: three ranges of the exponential weight in {d}D")
    return rows


def finest_order(d: int) -> Value:
    """Order in a/r0 of the first moment's error, exponential weight: of the two widest, the error from the two before."""
    def value(tables: Tables) -> Measured:
        rows = by_width(tables, d, "plain", 1)
        found = np.diff(np.log(np.abs(rows["value"]/d - 1)))/np.diff(np.log(1/rows["r0"]))
        return Measured(float(found[-1]), float(abs(found[-1] - found[-2])))
    return value


def coefficient(d: int) -> Value:
    """(1 - M_1/d) r0/a of the exponential weight for r0/a -> infinity, over what is predicted; extrapolated in a/r0."""
    def value(tables: Tables) -> Measured:
        rows = by_width(tables, d, "plain", 1)
        C = ((1 - rows["value"]/d)*rows["r0"]).to_numpy()
        fine, coarse = 2*C[-1] - C[-2], 2*C[-2] - C[-3]
        predicted = float(((1 - rows["predicted"]/d)*rows["r0"]).iloc[-1])
        return Measured(float(fine/predicted), float(abs((fine - coarse)/predicted)))
    return value


def doubling(tables: Tables) -> Measured:
    """Growth of the zeroth moment along a line when a is halved, over 2 ln 2/r0; the error from the halving before."""
    M = by_width(tables, 3, "line", 0)["value"].to_numpy()
    found = np.diff(M)/(2*np.log(2))
    return Measured(float(found[-1]), float(abs(found[-1] - found[-2])))


def error_ratio(tables: Tables) -> Measured:
    """Error of nested over pairwise Laplacians at the longest wave, of compact weights: that which is farthest from 4."""
    rows = chosen(tables, "symbols", weight=COMPACT, r0=3.0)
    rows = rows[rows["k"] == rows["k"].min()]
    found = (1 - rows["nested"])/(1 - rows["pairwise"])
    return Measured(float(found.iloc[int((found - 4).abs().argmax())]), 0.0)


def step_of_fastest(tables: Tables) -> Measured:
    """Longest step of RK4 times the largest frequency of sound: that which is farthest from 2.828."""
    rows = chosen(tables, "fastest").dropna()
    found = rows["step"]*rows["fastest"]
    return Measured(float(found.iloc[int((found - 8**0.5).abs().argmax())]), 0.0)


def line_moments(tables: Tables) -> Measured:
    """Largest |M_n - predicted|/predicted along a line for n = 1 to 4, extrapolated in a/r0 from the two widest."""
    worst = 0.0
    for n in (1, 2, 3, 4):
        rows = by_width(tables, 3, "line", n)
        M = (rows["value"]/rows["predicted"]).to_numpy()
        worst = max(worst, abs(2*M[-1] - M[-2] - 1))
    return Measured(worst, 0.0)
