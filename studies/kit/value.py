"""Rows of tables, formulas over their columns, and values: questions that are added, divided, compared.

Formulas and conditions are those of pandas' `eval`, with cos, sqrt, log, log10, exp, abs ... and pi.
"""
import ast
import operator
import re
from collections.abc import Callable, Iterable
from dataclasses import dataclass, field
from typing import Any

import numpy as np
import pandas as pd

from studies.kit.case import word
from studies.kit.csvfile import OtherTable
from studies.kit.stats import CannotTell, Measured
from studies.kit.table import Tables

#: names that a formula may use besides columns
CONSTANTS = {"pi": np.pi, "inf": np.inf}
Answer = Callable[[Tables], Measured]


class NoRows(CannotTell):
    """The rows that a question is about have not been run yet."""


class WrongQuestion(OtherTable):
    """A question that no run can answer: about a column that its table does not have, say."""


# --- rows and formulas -----------------------------------------------------------------------------


@dataclass(frozen=True)
class Selection:
    """Rows of a table: columns as in ``where``, the condition ``such`` holds; ``need`` of them or more."""

    table: str
    such: str = ""
    need: int = 1
    where: dict[str, Any] = field(default_factory=dict)

    def __call__(self, tables: Tables) -> pd.DataFrame:
        if self.table not in tables:
            raise NoRows(f"not run yet: table {self.table} is not there; make its study, which fills it")
        frame = tables[self.table]
        check_columns(self.table, frame, self.where)
        for column, value in self.where.items():
            values = value if isinstance(value, tuple) else (value,)
            frame = frame[frame[column].isin(values)]
        if self.such:
            frame = frame[evaluated(frame, self.such, self.table).astype(bool)]
        if len(frame) < self.need:
            raise NoRows(f"not run yet: {self} has {len(frame)} rows of {self.need} or more; "
                         "a larger SIZE of the study may run them")
        return frame

    def __str__(self) -> str:
        words = [f"{column} {is_in(value)}" for column, value in self.where.items()]
        conditions = " and ".join(filter(None, [*words, self.such]))
        return f"{self.table} where {conditions}" if conditions else self.table


def rows(tables: Tables, table: str, such: str = "", need: int = 1, **where: Any) -> pd.DataFrame:
    """The rows in which columns are as said (a tuple lists several values) and the condition ``such`` holds.

    Raises CannotTell: there are fewer than ``need``: they have not been run. WrongQuestion: The table has
    no such column.
    """
    return Selection(table, such, need, where)(tables)


def is_in(value: Any) -> str:
    """A condition in words."""
    return f"in ({', '.join(map(word, value))})" if isinstance(value, tuple) else f"= {word(value)}"


def names(formula: str) -> set[str]:
    """The columns that a formula uses. Raises WrongQuestion: it is no formula."""
    try:
        nodes = list(ast.walk(ast.parse(formula, mode="eval")))
    except SyntaxError as error:
        words = f"{formula!r} is no formula ({error.msg}): write one as pandas' eval takes it"
        raise WrongQuestion(words) from error
    used = {node.id for node in nodes if isinstance(node, ast.Name)}
    called = {ast.unparse(node.func) for node in nodes if isinstance(node, ast.Call)}
    return used - called - {*CONSTANTS}


def check_columns(table: str, frame: pd.DataFrame, wanted: Iterable[str]) -> None:
    """Refuse columns that a table does not have."""
    for column in sorted({*wanted} - {*frame}):
        raise WrongQuestion(f"table {table} has no column {column}: it has {', '.join(map(str, frame))}")


def evaluated(frame: pd.DataFrame, formula: str, table: str) -> np.ndarray:
    """A formula over rows, (n,)."""
    check_columns(table, frame, names(formula))
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


def error_of(formula: str, err: str, table: str, frame: pd.DataFrame) -> str:
    """The formula of an error: as given, else the `_err` of a column, else 0 if no column in it has one.

    Raises WrongQuestion: None is given, but one of the columns in the formula has an error.
    """
    own = f"{formula}_err"
    if err or own in frame:
        return err or own
    for name in sorted(names(formula)):
        if f"{name}_err" in frame:
            hint = re.sub(rf"\b{name}\b", f"{name}_err", formula)
            raise WrongQuestion(f"{formula} uses {name}, of which table {table} has {name}_err: say what the "
                                f"error is, as in err={hint!r}, or err='0' where it does not count")
    return "0"


# --- values ----------------------------------------------------------------------------------------

Operation = Callable[["Value", Any], "Value"]


def sided(sign: str, combined: Callable[..., Measured]) -> tuple[Operation, Operation]:
    """An operator with the question on its left, and on its right."""
    return (lambda a, b: both(a, b, sign, combined)), (lambda a, b: both(b, a, sign, combined))


@dataclass(frozen=True)
class Value:
    """A question: called with tables it gives a number with its error, `str` gives its formula.

    asks : the rows that it is about.
    """

    answer: Answer
    text: str
    asks: tuple[Selection, ...] = ()

    def __call__(self, tables: Tables) -> Measured:
        return self.answer(tables)

    def __str__(self) -> str:
        return self.text

    __add__, __radd__ = sided("+", operator.add)
    __sub__, __rsub__ = sided("-", operator.sub)
    __mul__, __rmul__ = sided("*", operator.mul)
    __truediv__, __rtruediv__ = sided("/", operator.truediv)

    def __pow__(self, power: float) -> "Value":
        return self.then(lambda number: number**power, f"({self})^{power:g}")

    def __neg__(self) -> "Value":
        return self.then(operator.neg, f"-({self})")

    def __abs__(self) -> "Value":
        return self.then(abs, f"|{self}|")

    def then(self, function: Callable[[Measured], Measured], text: str) -> "Value":
        """A function of the answer."""
        return Value(lambda tables: function(self(tables)), text, self.asks)


def both(a: Value | float, b: Value | float, sign: str,
         combined: Callable[[Measured, Measured], Measured]) -> Value:
    """Two questions, or a question and a number, in one."""
    one, other = lifted(a), lifted(b)
    texts = [f"({value})" if value.asks else str(value) for value in (one, other)]
    return Value(lambda tables: combined(one(tables), other(tables)),
                 f" {sign} ".join(texts), one.asks + other.asks)


def lifted(number: Value | float) -> Value:
    """A number as a question."""
    if isinstance(number, Value):
        return number
    return Value(lambda tables: Measured(float(number)), f"{number:g}")


def of(function: Answer) -> Value:
    """A question that no formula puts; the first line of the function's docstring says what it computes."""
    text = function.__doc__ or function.__name__
    return Value(function, text.strip().splitlines()[0])
