"""Values of claims: questions that are added, divided, compared, and their text."""
import operator
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple

from studies.kit import stats
from studies.kit.formula import NoRows, Selection, WrongQuestion, check_columns, error_of, names, rows
from studies.kit.stats import Measured
from studies.kit.table import SPENT, STAMP, Table, Tables

Answer = Callable[[Tables], Measured]


class Asked(NamedTuple):
    """What a question is about: rows, a formula over them, that of its error, and that which sorts them."""

    rows: Selection
    value: str
    err: str = ""
    by: str = ""


@dataclass(frozen=True)
class Value:
    """A question: called with tables it gives a number with its error, `str` gives its formula.

    asks : what it is about.
    """

    answer: Answer
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
    return value.then(stats.log, f"ln({value})")


def of(function: Answer) -> Value:
    """A question that no formula puts; the first line of the function's docstring says what it computes."""
    text = function.__doc__ or function.__name__
    return Value(function, text.strip().splitlines()[0])


#: which of several numbers counts; its name is part of the formula
Choice = Callable[[Sequence[Measured]], Measured]


def largest(values: Sequence[Measured]) -> Measured:
    """The largest value with the largest error."""
    return Measured(max(one.value for one in values), max(one.err for one in values))


def farthest_from(centre: float) -> Choice:
    """The value farthest from a number, with its own error."""
    def farthest(values: Sequence[Measured]) -> Measured:
        return max(values, key=lambda one: abs(one.value - centre))
    farthest.__name__ = f"farthest from {centre:g}"
    return farthest


def largest_of(*values: Value) -> Value:
    """The largest of several, with the largest error among them."""
    return one_of(largest, values)


def farthest_of(*values: Value, centre: float = 1.0) -> Value:
    """The one of several that is farthest from `centre`, with its own error."""
    return one_of(farthest_from(centre), values)


def largest_per(columns: str | Sequence[str], value: Value) -> Value:
    """The largest of what a question gives for each value of some columns, with the largest error."""
    return one_per(largest, columns, value)


def farthest_per(columns: str | Sequence[str], value: Value, centre: float = 1.0) -> Value:
    """That farthest from `centre` of what a question gives for each value of some columns, with its error."""
    return one_per(farthest_from(centre), columns, value)


def one_of(choice: Choice, values: Sequence[Value]) -> Value:
    """The answer to one of several questions."""
    def answer(tables: Tables) -> Measured:
        return choice([value(tables) for value in values])
    texts = "; ".join(map(str, values))
    asks = tuple(asked for value in values for asked in value.asks)
    return Value(answer, f"{choice.__name__} of {texts}", asks)


def one_per(choice: Choice, columns: str | Sequence[str], value: Value) -> Value:
    """The answer to a question put for one value of some columns."""
    def answer(tables: Tables) -> Measured:
        return choice(each(columns, value, tables))
    return Value(answer, f"{choice.__name__}, for each {columns}, of {value}", value.asks)


def each(columns: str | Sequence[str], value: Value, tables: Tables) -> list[Measured]:
    """What a question gives for each value of some columns of its first table, but where rows are missing.

    Raises CannotTell: None has all of its rows.
    """
    by = [columns] if isinstance(columns, str) else list(columns)
    first = value.asks[0].rows
    frame = first(tables)
    check_columns(first.table, frame.columns, by)
    answers, missing = [], None
    for key, _ in frame.groupby(by):
        where = dict(zip(by, key))
        try:
            answers.append(value(narrowed(tables, value, where)))
        except NoRows as error:
            missing = error
    if missing and not answers:
        raise missing
    return answers


def narrowed(tables: Tables, value: Value, where: dict[str, Any]) -> Tables:
    """Tables in which those of a question have only the rows that are meant."""
    names = {asked.rows.table for asked in value.asks}
    chosen = {name: rows(tables, name, need=0, **where) for name in names & set(tables)}
    return Tables({**tables, **chosen})


def check(value: Value, tables: Sequence[Table]) -> None:
    """Refuse a question about a table that a study does not have, or columns that its tables do not have.

    Raises WrongQuestion: In one line: what is not there, and what is.
    """
    columns = {table.name: [*table.columns, *SPENT, *STAMP] for table in tables}
    for asked in value.asks:
        table = asked.rows.table
        if table not in columns:
            raise WrongQuestion(f"no table {table}: the study has {', '.join(columns)}")
        there, formulas = columns[table], (asked.value, asked.err, asked.by)
        check_columns(table, there, asked.rows.columns.union(*map(names, formulas)))
        error_of(asked.value, asked.err, table, there)
