"""Questions that claims put to tables: which rows, a formula over their columns, one number out of many.

    one("nonlinear", "ratio", field="rho", k=1e-3)                  with ratio_err, where the table has it
    largest("printed", "abs(ratio/predicted - 1)", d=2)             over all rows where d is 2
    last("needed", "cpu_s", by="level", err="high - cpu_s", method="grid")
    power("steps", "error", "dt", "0.09 < dt < 0.41", fluid="moving")
                                                                    d ln(error)/d ln(dt)
    one("means", "ke", resolution=50)/one("means", "ke", resolution=inf)

Rows are chosen by the values of columns (a tuple lists several) and by a condition. Formulas and conditions
are those of pandas' `eval`, with cos, sqrt, log10, exp, abs ... and pi. The error of a column is its `_err`.
Of a formula it is another formula, `err`: "0" where it does not count. Questions are added, subtracted,
multiplied and divided as `Measured` are. `str` of a question is its formula.
"""
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
import pandas as pd

from studies.kit import fits, stats
from studies.kit.stats import Measured
from studies.kit.store import RESULTS
from studies.kit.table import Tables, read
from studies.kit.value import (
    NoRows,
    Selection,
    Value,
    WrongQuestion,
    check_columns,
    error_of,
    numbers,
    of,
    rows,
)

#: what studies find here, too
__all__ = ["NoRows", "Value", "WrongQuestion", "of", "rows"]

Array = np.ndarray
#: one number of values (n,) and errors (n,)
Pick = Callable[[Array, Array], Measured]


def question(pick: Pick) -> Callable[..., Value]:
    """A question from how it picks its number out of values (n,) and errors (n,), sorted ``by`` a formula."""
    def ask(table: str, value: str, such: str = "", *, err: str = "", by: str = "", need: int = 1,
            **where: Any) -> Value:
        chosen = Selection(table, such, need, where)

        def answer(tables: Tables) -> Measured:
            frame = ordered(chosen(tables), by, table)
            error = error_of(value, err, table, frame)
            number, half = pick(numbers(frame, value, table), numbers(frame, error, table))
            return Measured(float(number), float(half))
        order = f" by {by}" if by else ""
        return Value(answer, f"{ask.__name__}({value}){order} in {chosen}", (chosen,))
    ask.__doc__, ask.__name__ = pick.__doc__, pick.__name__
    return ask


def ordered(frame: pd.DataFrame, by: str, table: str) -> pd.DataFrame:
    """Rows sorted by a formula, if there is one."""
    return frame.iloc[np.argsort(numbers(frame, by, table), kind="stable")] if by else frame


def at(number: int | np.integer, x: Array, err: Array) -> Measured:
    """One of many values, with its own error."""
    return Measured(x[number], err[number])


@question
def one(x: Array, err: Array) -> Measured:
    """That of the only row there is."""
    if len(x) > 1:
        raise WrongQuestion(f"there are {len(x)} such rows: say which, or ask for first, last, largest ...")
    return at(0, x, err)


@question
def first(x: Array, err: Array) -> Measured:
    """That of the first row, by a formula."""
    return at(0, x, err)


@question
def last(x: Array, err: Array) -> Measured:
    """That of the last row, by a formula: by the value itself the largest, with its own error."""
    return at(-1, x, err)


def top(x: Array, err: Array) -> Measured:
    """The largest of all, with the largest error among them."""
    return Measured(x.max(), err.max())


top.__name__ = "largest"        # which stands in formulas
largest = question(top)


@question
def least(x: Array, err: Array) -> Measured:
    """Of all rows, with the largest error among them."""
    return Measured(x.min(), err.max())


def farthest_from(centre: float, end: str = "") -> Pick:
    """The one farthest from `centre`, with its own error."""
    def pick(x: Array, err: Array) -> Measured:
        return at(np.argmax(np.abs(x - centre)), x, err)
    pick.__name__ = f"farthest from {centre:g}{end}"
    return pick


def farthest(table: str, value: str, such: str = "", *, centre: float = 1.0, **more: Any) -> Value:
    """The one farthest from `centre`, with its own error."""
    return question(farthest_from(centre, " "))(table, value, such, **more)


@question
def total(x: Array, err: Array) -> Measured:
    """Sum over all rows, of a condition how many fulfil it; errors add in squares."""
    return Measured(x.sum(), np.sqrt((err**2).sum()))


@question
def share(x: Array, err: Array) -> Measured:
    """Part of the rows that fulfil a condition."""
    return Measured((x != 0).mean())


@question
def over_seeds(x: Array, err: Array) -> Measured:
    """Mean over seeds; its error is that of each run or that of the scatter, whichever is larger."""
    return stats.combine(list(zip(x, err))) if err.any() else stats.over_seeds(x)


@question
def spread(x: Array, err: Array) -> Measured:
    """Largest over smallest."""
    return at(np.argmax(x), x, err)/at(np.argmin(x), x, err)


def curve(fit: Callable[[Array, Array, Array], Measured]) -> Callable[..., Value]:
    """A question from a fit of y to x, both formulas; rows sorted by x, three at least."""
    def ask(table: str, y: str, x: str, such: str = "", *, err: str = "0", need: int = 3,
            **where: Any) -> Value:
        chosen = Selection(table, such, need, where)

        def answer(tables: Tables) -> Measured:
            frame = ordered(chosen(tables), x, table)
            return fit(*(numbers(frame, formula, table) for formula in (x, y, err)))
        return Value(answer, f"{ask.__name__}({y} over {x}) in {chosen}", (chosen,))
    ask.__doc__, ask.__name__ = fit.__doc__, fit.__name__
    return ask


@curve
def power(x: Array, y: Array, err: Array) -> Measured:
    """d ln|y|/d ln x by least squares: of an error over a spacing the order of convergence."""
    return fits.power_law(x, y, err=err).slope


# --- of several questions --------------------------------------------------------------------------


def largest_of(*values: Value) -> Value:
    """The largest of several, with the largest error among them."""
    asks = tuple(chosen for value in values for chosen in value.asks)
    return Value(lambda tables: picked(top, [value(tables) for value in values]),
                 f"largest of {'; '.join(map(str, values))}", asks)


def largest_per(columns: str | Sequence[str], value: Value) -> Value:
    """The largest of what a question gives for each value of some columns, with the largest error."""
    return one_per(top, columns, value)


def farthest_per(columns: str | Sequence[str], value: Value, centre: float = 1.0) -> Value:
    """That farthest from `centre` of what a question gives for each value of some columns, with its error."""
    return one_per(farthest_from(centre), columns, value)


def per_seed(value: Value) -> Value:
    """Mean of what a question gives for each seed; its error is that of their scatter."""
    def answer(tables: Tables) -> Measured:
        return stats.over_seeds([seed.value for seed in each("seed", value, tables)])
    return Value(answer, f"mean over seeds of {value}", value.asks)


def bench(asked: Value) -> Value:
    """A question to a table of `bench`, which belongs to no study."""
    name = asked.asks[0].table

    def answer(tables: Tables) -> Measured:
        path = RESULTS/"bench"/f"{name}.csv"
        return asked(Tables({name: read(path)}) if path.exists() else Tables())
    return Value(answer, str(asked))


def one_per(pick: Pick, columns: str | Sequence[str], value: Value) -> Value:
    """The answer to a question put for one value of some columns."""
    return Value(lambda tables: picked(pick, each(columns, value, tables)),
                 f"{pick.__name__}, for each {columns}, of {value}", value.asks)


def picked(pick: Pick, answers: Sequence[Measured]) -> Measured:
    """One of several numbers."""
    return Measured(*map(float, pick(*np.array(answers).T)))


def each(columns: str | Sequence[str], value: Value, tables: Tables) -> list[Measured]:
    """What a question gives for each value of some columns of its first table, but where rows are missing.

    Raises CannotTell: None has all of its rows.
    """
    by = [columns] if isinstance(columns, str) else list(columns)
    chosen = value.asks[0]
    frame = chosen(tables)
    check_columns(chosen.table, frame, by)
    asked = {chosen.table for chosen in value.asks} & {*tables}
    answers, missing = [], None
    for key, _ in frame.groupby(by):
        where: dict[str, Any] = dict(zip(by, key))
        fewer = {name: rows(tables, name, need=0, **where) for name in asked}
        try:
            answers.append(value(Tables({**tables, **fewer})))
        except NoRows as error:
            missing = error
    if missing and not answers:
        raise missing
    return answers
