"""Values of claims: questions that are added, divided, compared, and their text."""
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
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
        return both(self, other, "+", lambda a, b: a + b)

    def __radd__(self, other: float) -> "Value":
        return both(other, self, "+", lambda a, b: a + b)

    def __sub__(self, other: "Value | float") -> "Value":
        return both(self, other, "-", lambda a, b: a - b)

    def __rsub__(self, other: float) -> "Value":
        return both(other, self, "-", lambda a, b: a - b)

    def __mul__(self, other: "Value | float") -> "Value":
        return both(self, other, "*", lambda a, b: a*b)

    def __rmul__(self, other: float) -> "Value":
        return both(other, self, "*", lambda a, b: a*b)

    def __truediv__(self, other: "Value | float") -> "Value":
        return both(self, other, "/", lambda a, b: a/b)

    def __rtruediv__(self, other: float) -> "Value":
        return both(other, self, "/", lambda a, b: a/b)

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
    texts = [f"({x})" if x.asks else str(x) for x in (one, other)]

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
    return Value(function, (function.__doc__ or function.__name__).strip().splitlines()[0])


# --- several questions in one -----------------------------------------------------------------


def largest_of(*values: Value) -> Value:
    """The largest of several, with the largest error among them."""
    def answer(tables: Tables) -> Measured:
        return largest_measured([value(tables) for value in values])
    return Value(answer, f"largest of {listed(values)}", joined(values))


def farthest_of(*values: Value, centre: float = 1.0) -> Value:
    """The one of several that is farthest from `centre`, with its own error."""
    def answer(tables: Tables) -> Measured:
        return farthest_measured([value(tables) for value in values], centre)
    return Value(answer, f"farthest from {centre:g} of {listed(values)}", joined(values))


def largest_per(columns: str | Sequence[str], value: Value) -> Value:
    """The largest of what a question gives for each value of some columns, with the largest error."""
    def answer(tables: Tables) -> Measured:
        return largest_measured(list(each(columns, value, tables)))
    return Value(answer, f"largest, for each {columns}, of {value}", value.asks)


def farthest_per(columns: str | Sequence[str], value: Value, centre: float = 1.0) -> Value:
    """That farthest from `centre` of what a question gives for each value of some columns, with its error."""
    def answer(tables: Tables) -> Measured:
        return farthest_measured(list(each(columns, value, tables)), centre)
    return Value(answer, f"farthest from {centre:g}, for each {columns}, of {value}", value.asks)


def each(columns: str | Sequence[str], value: Value, tables: Tables) -> Iterator[Measured]:
    """What a question gives for each value of some columns of its first table, but where rows are missing.

    Raises
    ------
    CannotTell
        None has all of its rows.
    """
    by = [columns] if isinstance(columns, str) else list(columns)
    if not value.asks:
        raise WrongQuestion(f"{value} puts no formula to rows: only questions that do are put for each {columns}")
    of_first, answered = value.asks[0].rows, False
    frame = of_first(tables)
    check_columns(of_first.table, frame.columns, by)
    for key, _ in frame.groupby(by):
        try:
            yield value(narrowed(tables, value, dict(zip(by, key, strict=True))))
            answered = True
        except NoRows as missing:
            last_missing = missing
    if not answered:
        raise last_missing


def narrowed(tables: Tables, value: Value, where: dict[str, Any]) -> Tables:
    """Tables in which those of a question have only the rows that are meant."""
    named = {asked.rows.table for asked in value.asks} & set(tables)
    return Tables({**tables, **{table: rows(tables, table, need=0, **where) for table in named}})


def largest_measured(values: Sequence[Measured]) -> Measured:
    """The largest value with the largest error."""
    return Measured(max(one.value for one in values), max(one.err for one in values))


def farthest_measured(values: Sequence[Measured], centre: float) -> Measured:
    """The value farthest from a number, with its own error."""
    return max(values, key=lambda one: abs(one.value - centre))


def listed(values: Sequence[Value]) -> str:
    """Questions, one after the other."""
    return "; ".join(map(str, values))


def joined(values: Sequence[Value]) -> tuple[Asked, ...]:
    """All rows that several questions are about."""
    return tuple(ask for value in values for ask in value.asks)


def check(value: Value, tables: Sequence[Table]) -> None:
    """Refuse a question about a table that a study does not have, or columns that its tables do not have.

    Raises
    ------
    WrongQuestion
        In one line: what is not there, and what is.
    """
    columns = {table.name: [*table.columns, *SPENT, *STAMP] for table in tables}
    for asked in value.asks:
        table = asked.rows.table
        if table not in columns:
            raise WrongQuestion(f"no table {table}: the study has {', '.join(columns)}")
        used = asked.rows.columns.union(*map(names, asked[1:]))
        check_columns(table, columns[table], used)
        error_of(asked.value, asked.err, table, columns[table])
