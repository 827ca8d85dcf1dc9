"""Values of claims: questions that are added, divided, compared, and their text."""
import operator
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from functools import partial
from typing import Any, NamedTuple

from studies.kit import stats
from studies.kit.formula import NoRows, Rows, WrongQuestion, check_columns, error_of, names, rows
from studies.kit.stats import Measured
from studies.kit.table import SPENT, STAMP, Table, Tables


class Asked(NamedTuple):
    """What a question is about: rows, a formula over them, that of its error, and that which sorts them."""

    rows: Rows
    value: str
    err: str = ""
    by: str = ""


@dataclass(frozen=True)
class Value:
    """A question: called with tables it gives a number with its error, `str` gives its formula.

    asks : what it is about.
    """

    answer: Callable[[Tables], Measured]
    text: str
    asks: tuple[Asked, ...] = ()

    def __call__(self, tables: Tables) -> Measured:
        return self.answer(tables)

    def __str__(self) -> str:
        return self.text

    def __add__(self, other: "Value | float") -> "Value":
        return both(self, other, "+", operator.add)

    def __radd__(self, other: float) -> "Value":
        return both(other, self, "+", operator.add)

    def __sub__(self, other: "Value | float") -> "Value":
        return both(self, other, "-", operator.sub)

    def __rsub__(self, other: float) -> "Value":
        return both(other, self, "-", operator.sub)

    def __mul__(self, other: "Value | float") -> "Value":
        return both(self, other, "*", operator.mul)

    def __rmul__(self, other: float) -> "Value":
        return both(other, self, "*", operator.mul)

    def __truediv__(self, other: "Value | float") -> "Value":
        return both(self, other, "/", operator.truediv)

    def __rtruediv__(self, other: float) -> "Value":
        return both(other, self, "/", operator.truediv)

    def __pow__(self, power: float) -> "Value":
        return Value(lambda tables: self(tables)**power, f"({self})^{power:g}", self.asks)

    def __neg__(self) -> "Value":
        return Value(lambda tables: -self(tables), f"-({self})", self.asks)

    def __abs__(self) -> "Value":
        return Value(lambda tables: abs(self(tables)), f"|{self}|", self.asks)


def both(a: Value | float, b: Value | float, sign: str,
         combined: Callable[[Measured, Measured], Measured]) -> Value:
    """Two questions, or a question and a number, in one."""
    one, other = lifted(a), lifted(b)
    texts = [f"({value})" if value.asks else str(value) for value in (one, other)]

    def answer(tables: Tables) -> Measured:
        return combined(one(tables), other(tables))
    return Value(answer, f" {sign} ".join(texts), one.asks + other.asks)


def lifted(number: Value | float) -> Value:
    """A number as a question."""
    if isinstance(number, Value):
        return number
    return Value(lambda tables: Measured(float(number)), f"{number:g}")


def log(value: Value) -> Value:
    """Natural logarithm."""
    return Value(lambda tables: stats.log(value(tables)), f"ln({value})", value.asks)


def of(function: Callable[[Tables], Measured]) -> Value:
    """A question that no formula puts; the first line of the function's docstring says what it computes."""
    text = function.__doc__ or function.__name__
    return Value(function, text.strip().splitlines()[0])


Choice = Callable[[Sequence[Measured]], Measured]


def largest_of(*values: Value) -> Value:
    """The largest of several, with the largest error among them."""
    return one_of("largest", largest_measured, values)


def farthest_of(*values: Value, centre: float = 1.0) -> Value:
    """The one of several that is farthest from `centre`, with its own error."""
    return one_of(f"farthest from {centre:g}", partial(farthest_measured, centre=centre), values)


def largest_per(columns: str | Sequence[str], value: Value) -> Value:
    """The largest of what a question gives for each value of some columns, with the largest error."""
    return one_per("largest", largest_measured, columns, value)


def farthest_per(columns: str | Sequence[str], value: Value, centre: float = 1.0) -> Value:
    """That farthest from `centre` of what a question gives for each value of some columns, with its error."""
    return one_per(f"farthest from {centre:g}", partial(farthest_measured, centre=centre), columns, value)


def one_of(words: str, choice: Choice, values: Sequence[Value]) -> Value:
    """The answer to one of several questions."""
    def answer(tables: Tables) -> Measured:
        return choice([value(tables) for value in values])
    asks = tuple(asked for value in values for asked in value.asks)
    return Value(answer, f"{words} of {'; '.join(map(str, values))}", asks)


def one_per(words: str, choice: Choice, columns: str | Sequence[str], value: Value) -> Value:
    """The answer to a question put for one value of some columns."""
    def answer(tables: Tables) -> Measured:
        return choice(list(each(columns, value, tables)))
    return Value(answer, f"{words}, for each {columns}, of {value}", value.asks)


def each(columns: str | Sequence[str], value: Value, tables: Tables) -> Iterator[Measured]:
    """What a question gives for each value of some columns of its first table, but where rows are missing.

    Raises CannotTell: None has all of its rows.
    """
    by = [columns] if isinstance(columns, str) else list(columns)
    if not value.asks:
        raise WrongQuestion(f"{value} puts no formula to rows: no other is put for each {columns}")
    first, answered = value.asks[0].rows, False
    frame = first(tables)
    check_columns(first.table, frame.columns, by)
    for key, _ in frame.groupby(by):
        try:
            yield value(narrowed(tables, value, dict(zip(by, key, strict=True))))
            answered = True
        except NoRows as error:
            missing = error
    if not answered:
        raise missing


def narrowed(tables: Tables, value: Value, where: dict[str, Any]) -> Tables:
    """Tables in which those of a question have only the rows that are meant."""
    names = {asked.rows.table for asked in value.asks} & set(tables)
    return Tables({**tables, **{name: rows(tables, name, need=0, **where) for name in names}})


def largest_measured(values: Sequence[Measured]) -> Measured:
    """The largest value with the largest error."""
    return Measured(max(one.value for one in values), max(one.err for one in values))


def farthest_measured(values: Sequence[Measured], centre: float) -> Measured:
    """The value farthest from a number, with its own error."""
    return max(values, key=lambda one: abs(one.value - centre))


def check(value: Value, tables: Sequence[Table]) -> None:
    """Refuse a question about a table that a study does not have, or columns that its tables do not have.

    Raises WrongQuestion: In one line: what is not there, and what is.
    """
    columns = {table.name: [*table.columns, *SPENT, *STAMP] for table in tables}
    for asked in value.asks:
        table = asked.rows.table
        if table not in columns:
            raise WrongQuestion(f"no table {table}: the study has {', '.join(columns)}")
        used = asked.rows.columns.union(names(asked.value), names(asked.err), names(asked.by))
        check_columns(table, columns[table], used)
        error_of(asked.value, asked.err, table, columns[table])
