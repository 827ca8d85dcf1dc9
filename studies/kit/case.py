"""A case: one computation with all its parameters, its outcome, and its key."""
import dataclasses
import json
import sys
from collections.abc import Callable, Iterable, Iterator
from functools import cached_property
from pathlib import Path
from typing import Any, ClassVar, dataclass_transform

from studies.kit.key import CODE, Code, digest, followed, is_ours
from studies.kit.syntax import CASE, WHOLE, Place
from studies.kit.table import Row, Rows

#: called with the fraction done, in [0, 1]
Report = Callable[[float], None]


@dataclasses.dataclass(frozen=True)
class Outcome:
    """Result of a case: rows by the name of their table."""

    rows: Rows


@dataclass_transform(frozen_default=True, kw_only_default=True)
@dataclasses.dataclass(frozen=True, kw_only=True)
class Case:
    """Base of all cases; a subclass is a frozen keyword-only dataclass whose fields are the parameters.

    Fields may be numbers, strings, tuples, dicts, NamedTuples, dataclasses, and functions or classes
    of a module. The result must depend only on the fields and the code.
    """

    #: True for a case that measures times: it then runs alone on the machine
    alone: ClassVar[bool] = False
    table: ClassVar[str] = ""   # name of the table of all rows
    same: ClassVar[str] = ""    # names of the fields and properties that are columns of every row

    def __init_subclass__(cls, table: str = "", same: str = "") -> None:
        """Make ``class Wave(Case, table="waves", same="k seed")`` a dataclass; its rows get k and seed."""
        if table or same:
            cls.table, cls.same = table or cls.table, same or cls.same
            dataclasses.dataclass(frozen=True, kw_only=True)(cls)

    @property
    def cost(self) -> float:
        """Estimated CPU seconds: the longest cases start first; the progress bar estimates the time left."""
        return 1.0

    @property
    def label(self) -> str:
        """A few words for the progress line and for messages."""
        values = [getattr(self, field.name) for field in dataclasses.fields(self)]
        return " ".join([type(self).__name__, *map(word, values)])

    @property
    def columns(self) -> Row:
        """Columns that all rows share: the values of ``same``, functions and records by name."""
        return {name: called(getattr(self, name)) for name in self.same.split()}

    def run(self, report: Report, folder: Path) -> Outcome:
        """Compute the outcome. ``folder`` is for checkpoints: it is kept until the case is finished."""
        return Outcome({self.table: [self.columns | row for row in self.measure(report)]})

    def measure(self, report: Report) -> Iterable[Row]:
        """Rows of the table; a case with several tables or with checkpoints overrides `run` instead."""
        raise NotImplementedError

    @cached_property
    def key(self) -> str:
        """Hash of the parameters and of all definitions that the result depends on."""
        return key_of(self, CODE)


def word(value: Any) -> str:
    """A parameter as text: a record with its non-default fields, a function by its name."""
    if isinstance(value, float):
        return f"{value:g}"
    if hasattr(value, "__qualname__"):
        return str(value.__qualname__)
    usual = defaults(type(value))
    if usual is None:
        return str(value)
    own = [f"{name}={word(getattr(value, name))}" for name, default in usual.items()
           if getattr(value, name) != default]
    return f"{type(value).__name__}({', '.join(own)})"


def called(value: Any) -> Any:
    """A parameter as the value of a column: a record or a function by its name."""
    return getattr(value, "name", getattr(value, "__name__", value))


def defaults(kind: Any) -> dict[str, Any] | None:
    """Field -> default for a dataclass or NamedTuple class, None for other classes."""
    if dataclasses.is_dataclass(kind):
        return {field.name: field.default for field in dataclasses.fields(kind)}
    if hasattr(kind, "_field_defaults"):
        return {name: kind._field_defaults.get(name, dataclasses.MISSING) for name in kind._fields}
    return None


def fields_of(value: Any) -> dict[str, Any] | None:
    """Field -> value for a record or a dict, None for other objects."""
    if isinstance(value, dict):
        return value
    names = None if isinstance(value, type) else defaults(type(value))
    return None if names is None else {name: getattr(value, name) for name in names}


def parameters(value: Any) -> Any:
    """Parameters as JSON: floats exact (by repr), every record with its type."""
    if value is None or isinstance(value, bool | int | float | str):
        return value
    kind = {"": type(value).__qualname__}
    fields = fields_of(value)
    if fields is not None:
        return kind | {str(name): parameters(item) for name, item in fields.items()}
    if isinstance(value, tuple | list):
        return [parameters(item) for item in value]
    if hasattr(value, "__qualname__") and "<" not in value.__qualname__:
        module = {} if is_ours(value.__module__) else {"module": value.__module__}     # the key has our code
        return {"": value.__qualname__} | module
    raise TypeError(f"a case cannot hold {value!r}: use numbers, texts, tuples, NamedTuples, dataclasses, "
                    "or functions and classes of a module")


def key_of(case: Case, code: Code) -> str:
    """Key of a case: hash of its parameters and of the definitions in ``code``, some copy of our packages."""
    values = json.dumps(parameters(case), sort_keys=True)
    return digest(values, code.hash(starts(case)))


def starts(case: Case) -> Iterator[Place]:
    """Places where the classes of a case and the types and functions among its parameters are defined."""
    own = type(case).__module__
    classes = [place_of(kind, own, CASE if issubclass(kind, Case) else WHOLE) for kind in type(case).__mro__]
    values = [place_of(kind, own) for value in vars(case).values() for kind in kinds(value)]
    yield from filter(None, classes + values)


def place_of(kind: Any, own: str, part: str = WHOLE) -> Place | None:
    """Place where a class or function is defined; None outside our packages and the module of the case."""
    module = kind.__module__
    if not is_ours(module):
        module = sys.modules[own].__file__ if module == own else None       # a script
    return Place(module, kind.__qualname__.split(".")[0], part) if module and followed(module) else None


def kinds(value: Any) -> Iterator[Any]:
    """Types of all parameters, nested ones included; a function or class stands for itself."""
    yield value if hasattr(value, "__qualname__") else type(value)
    fields = fields_of(value)
    items = value if fields is None else list(fields.values())
    if isinstance(items, tuple | list):
        for item in items:
            yield from kinds(item)
