"""Rows of a table and formulas over their columns, for questions (`ask.py`).

Formulas and conditions are those of pandas' `eval`, with cos, sqrt, log, log10, exp, abs ... and pi.
"""
import ast
import re
from collections.abc import Iterable
from dataclasses import dataclass, field
from difflib import get_close_matches
from typing import Any

import numpy as np
import pandas as pd

from studies.kit.case import word
from studies.kit.csvfile import OtherTable
from studies.kit.stats import CannotTell
from studies.kit.table import Tables

#: names that a formula may use besides columns
CONSTANTS = {"pi": np.pi, "inf": np.inf}


class NoRows(CannotTell):
    """The rows that a question is about have not been run yet."""


class WrongQuestion(OtherTable):
    """A question that no run can answer: about a column that its table does not have, say."""


@dataclass(frozen=True)
class Selection:
    """Rows of a table: columns as in ``where``, the condition ``such`` holds; ``need`` of them or more."""

    table: str
    such: str = ""
    need: int = 1
    where: dict[str, Any] = field(default_factory=dict)

    def __call__(self, tables: Tables) -> pd.DataFrame:
        frame = tables.get(self.table)
        if frame is None:
            raise NoRows(f"not run yet: table {self.table} is not there; make its study, which fills it")
        check_columns(self.table, frame.columns, self.columns)
        for column, value in self.where.items():
            values = value if isinstance(value, tuple) else (value,)
            frame = frame[frame[column].isin(values)]
        if self.such:
            holds = evaluated(frame, self.such, self.table)
            frame = frame[holds.astype(bool)]
        if len(frame) < self.need:
            raise NoRows(f"not run yet: {self} has {len(frame)} rows of {self.need} or more; "
                         "a larger SIZE of the study may run them")
        return frame

    @property
    def columns(self) -> set[str]:
        """Those by which rows are chosen."""
        return {*self.where, *names(self.such)}

    def __str__(self) -> str:
        words = [f"{column} {is_in(value)}" for column, value in self.where.items()]
        if self.such:
            words.append(self.such)
        return f"{self.table} where {' and '.join(words)}" if words else self.table


def rows(tables: Tables, table: str, such: str = "", need: int = 1, **where: Any) -> pd.DataFrame:
    """The rows in which columns are as said (a tuple lists several values) and the condition ``such`` holds.

    Raises CannotTell: there are fewer than ``need``: they have not been run. WrongQuestion: The table has
    no such column.
    """
    return Selection(table, such, need, where)(tables)


def is_in(value: Any) -> str:
    """A condition in words."""
    if isinstance(value, tuple):
        return f"in ({', '.join(map(word, value))})"
    return f"= {word(value)}"


def names(formula: str) -> set[str]:
    """The columns that a formula uses. Raises WrongQuestion: it is no formula."""
    try:
        nodes = list(ast.walk(ast.parse(formula or "0", mode="eval")))
    except SyntaxError as error:
        words = f"{formula!r} is no formula ({error.msg}): write one as pandas' eval takes it"
        raise WrongQuestion(words) from error
    used = {node.id for node in nodes if isinstance(node, ast.Name)}
    called = {ast.unparse(node.func) for node in nodes if isinstance(node, ast.Call)}
    return used - called - {*CONSTANTS}


def check_columns(table: str, there: Iterable[str], wanted: Iterable[str]) -> None:
    """Refuse columns that a table does not have."""
    columns = [str(column) for column in there]
    for column in sorted({*wanted} - {*columns}):
        close = get_close_matches(column, columns, n=1)
        hint = f"did you mean {close[0]}? " if close else ""
        raise WrongQuestion(f"table {table} has no column {column}: {hint}it has {', '.join(columns)}")


def evaluated(frame: pd.DataFrame, formula: str, table: str) -> np.ndarray:
    """A formula over rows, (n,)."""
    check_columns(table, frame.columns, names(formula))
    try:
        values = frame.eval(formula, engine="python", resolvers=[CONSTANTS])
    except (ValueError, NotImplementedError) as error:
        raise WrongQuestion(f"formula {formula!r} over table {table} cannot be computed: {error}") from error
    return np.broadcast_to(np.asarray(values, float), len(frame))


def numbers(frame: pd.DataFrame, formula: str, table: str) -> np.ndarray:
    """The same where each row has to have a number. Raises CannotTell: One has none."""
    values = evaluated(frame, formula, table)
    if missing := np.isnan(values).sum():
        raise CannotTell(f"{formula} is not a number in {missing} of {len(values)} rows of table {table}")
    return values


def error_of(formula: str, err: str, table: str, columns: Iterable[str]) -> str:
    """The formula of an error: as given, else the `_err` of a column, else 0 if no column in it has one.

    Raises WrongQuestion: None is given, but one of the columns in the formula has an error.
    """
    own, known = f"{formula}_err", set(columns)
    if err or own in known:
        return err or own
    for name in sorted(names(formula)):
        if f"{name}_err" in known:
            hint = re.sub(rf"\b{name}\b", f"{name}_err", formula)
            raise WrongQuestion(f"{formula} uses {name}, of which table {table} has {name}_err: say what the "
                                f"error is, as in err={hint!r}, or err='0' where it does not count")
    return "0"
