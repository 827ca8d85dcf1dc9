"""Questions that claims put to tables: which rows, a formula over their columns, one number out of many.

    one("nonlinear", "ratio", field="rho", k=1e-3)                  with ratio_err, where the table has it
    largest("printed", "abs(ratio/predicted - 1)", d=2)             over all rows where d is 2
    last("peaks", "measured/symbol", by="turns", err="measured_err/symbol", peak="position")
    power("steps", "error", "dt", "0.09 < dt < 0.41", fluid="gas")  d ln(error)/d ln(dt)
    one("means", "ke", resolution=50)/one("means", "ke", resolution=inf)

Rows are chosen by the values of columns (a tuple lists several) and by a condition. Formulas and conditions
are those of pandas' `eval`, with cos, sqrt, log10, exp, abs ... and pi. The error of a column is its `_err`.
Of a formula it is another formula, `err`: "0" where it does not count. Questions are added, subtracted,
multiplied and divided as `Measured` are. `str` of a question is its formula.
"""
from collections.abc import Callable
from typing import Any

import numpy as np
import pandas as pd

from studies.kit import fits, stats
from studies.kit.formula import NoRows, Selection, WrongQuestion, error_of, numbers, rows
from studies.kit.stats import Measured
from studies.kit.table import Tables
from studies.kit.value import Asked, Value, check, farthest_of, farthest_per, largest_of, largest_per, log, of

__all__ = [
    "NoRows", "Value", "WrongQuestion", "check", "curve", "farthest", "farthest_of", "farthest_per", "first",
    "largest", "largest_of", "largest_per", "last", "least", "log", "mean", "of", "one", "over_seeds",
    "power", "question", "rows", "share", "spread", "total",
]

Pick = Callable[[np.ndarray, np.ndarray], Measured]
Curve = Callable[[np.ndarray, np.ndarray, np.ndarray], Measured]


def question(pick: Pick) -> Callable[..., Value]:
    """A question from how it picks its number out of values (n,) and errors (n,), sorted ``by`` a formula."""
    def ask(table: str, value: str, such: str = "", *, err: str = "", by: str = "", need: int = 1,
            **where: Any) -> Value:
        chosen = Selection(table, such, need, where)

        def answer(tables: Tables) -> Measured:
            frame = ordered(chosen(tables), by, table) if by else chosen(tables)
            error = error_of(value, err, table, frame.columns)
            number, half = pick(numbers(frame, value, table), numbers(frame, error, table))
            return Measured(float(number), float(half))
        asked = Asked(chosen, value, err, by)
        order = f" by {by}" if by else ""
        return Value(answer, f"{ask.__name__}({value}){order} in {chosen}", (asked,))
    ask.__doc__, ask.__name__ = pick.__doc__, pick.__name__
    return ask


def ordered(frame: pd.DataFrame, by: str, table: str) -> pd.DataFrame:
    """Rows sorted by a formula."""
    return frame.iloc[np.argsort(numbers(frame, by, table), kind="stable")]


def at(number: int, x: np.ndarray, err: np.ndarray) -> Measured:
    """One of many values, with its own error."""
    return Measured(x[number], err[number])


@question
def one(x: np.ndarray, err: np.ndarray) -> Measured:
    """That of the only row there is."""
    if len(x) > 1:
        raise WrongQuestion(f"there are {len(x)} such rows: say which, or ask for first, last, mean ...")
    return at(0, x, err)


@question
def first(x: np.ndarray, err: np.ndarray) -> Measured:
    """That of the first row, by a formula."""
    return at(0, x, err)


@question
def last(x: np.ndarray, err: np.ndarray) -> Measured:
    """That of the last row, by a formula: by the value itself the largest, with its own error."""
    return at(-1, x, err)


@question
def largest(x: np.ndarray, err: np.ndarray) -> Measured:
    """Of all rows, with the largest error among them."""
    return Measured(x.max(), err.max())


@question
def least(x: np.ndarray, err: np.ndarray) -> Measured:
    """Of all rows, with the largest error among them."""
    return Measured(x.min(), err.max())


def farthest(table: str, value: str, such: str = "", *, centre: float = 1.0, **more: Any) -> Value:
    """The one farthest from `centre`, with its own error."""
    def pick(x: np.ndarray, err: np.ndarray) -> Measured:
        return at(int(np.argmax(np.abs(x - centre))), x, err)
    pick.__name__ = f"farthest from {centre:g} "
    return question(pick)(table, value, such, **more)


@question
def mean(x: np.ndarray, err: np.ndarray) -> Measured:
    """Of all rows; errors are independent and add in squares."""
    return Measured(x.mean(), np.sqrt((err**2).sum())/len(x))


@question
def total(x: np.ndarray, err: np.ndarray) -> Measured:
    """Sum over all rows, of a condition how many fulfil it; errors add in squares."""
    return Measured(x.sum(), np.sqrt((err**2).sum()))


@question
def share(x: np.ndarray, err: np.ndarray) -> Measured:
    """Part of the rows that fulfil a condition."""
    return Measured((x != 0).mean())


@question
def over_seeds(x: np.ndarray, err: np.ndarray) -> Measured:
    """Mean over seeds; its error is that of each run or that of the scatter, whichever is larger."""
    return stats.combine(list(zip(x, err))) if err.any() else stats.over_seeds(x)


@question
def spread(x: np.ndarray, err: np.ndarray) -> Measured:
    """Largest over smallest."""
    return at(int(np.argmax(x)), x, err)/at(int(np.argmin(x)), x, err)


def curve(fit: Curve) -> Callable[..., Value]:
    """A question from a fit of y to x, both formulas; rows sorted by x, three at least."""
    def ask(table: str, y: str, x: str, such: str = "", *, err: str = "0", need: int = 3,
            **where: Any) -> Value:
        chosen = Selection(table, such, need, where)

        def answer(tables: Tables) -> Measured:
            frame = ordered(chosen(tables), x, table)
            columns = [numbers(frame, formula, table) for formula in (x, y, err)]
            return fit(*columns)
        asked = Asked(chosen, y, err, by=x)
        return Value(answer, f"{ask.__name__}({y} over {x}) in {chosen}", (asked,))
    ask.__doc__, ask.__name__ = fit.__doc__, fit.__name__
    return ask


@curve
def power(x: np.ndarray, y: np.ndarray, err: np.ndarray) -> Measured:
    """d ln|y|/d ln x by least squares: of an error over a spacing the order of convergence."""
    return fits.power_law(x, y, err=err).slope
