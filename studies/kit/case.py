"""A case: one computation with all its parameters, and what it hands back."""
import dataclasses
import json
import sys
from collections.abc import Callable, Iterable, Iterator
from enum import Enum
from functools import cache, cached_property
from pathlib import Path
from typing import Any, ClassVar, dataclass_transform

from studies.kit.key import CODE, PACKAGES, ROOT, Code, digest, followed, name_of
from studies.kit.syntax import CASE, WHOLE, Place
from studies.kit.table import Row, Rows

#: called with the fraction done, in [0, 1]
Report = Callable[[float], None]


@dataclasses.dataclass(frozen=True)
class Outcome:
    """What a case found: rows for each table by name."""

    rows: Rows


@dataclass_transform(frozen_default=True, kw_only_default=True)
@dataclasses.dataclass(frozen=True, kw_only=True)
class Case:
    """Base of all cases; a subclass is a frozen keyword-only dataclass whose fields are the parameters.

    Fields may be numbers, strings, tuples, dicts, enums, NamedTuples, dataclasses, and functions or classes
    of a module. The result must depend on nothing else than these and the code.
    """

    #: True for timings: the case then has the machine to itself
    alone: ClassVar[bool] = False
    table: ClassVar[str] = ""   # of all rows
    same: ClassVar[str] = ""    # fields and properties that are columns of each

    def __init_subclass__(cls, table: str = "", same: str = "") -> None:
        """``class Wave(Case, table="waves", same="k seed")`` needs no decorator and no columns k, seed."""
        if table or same:
            cls.table, cls.same = table or cls.table, same or cls.same
            dataclasses.dataclass(frozen=True, kw_only=True)(cls)

    @property
    def cost(self) -> float:
        """Estimated CPU seconds: longest cases start first, and the time left is reckoned from it."""
        return 1.0

    @property
    def label(self) -> str:
        """A few words for the progress line and for messages."""
        values = [getattr(self, field.name) for field in dataclasses.fields(self)]
        return " ".join([type(self).__name__, *map(word, values)])

    @property
    def columns(self) -> Row:
        """What all rows have in common: fields that are columns, functions and records by their names."""
        return {name: called(getattr(self, name)) for name in self.same.split()}

    def run(self, report: Report, folder: Path) -> Outcome:
        """Compute. ``folder`` is for checkpoints: it is kept until the case is finished."""
        return Outcome({self.table: [self.columns | row for row in self.measure(report)]})

    def measure(self, report: Report) -> Iterable[Row]:
        """What is measured; a case of several tables, or with checkpoints, has a `run` of its own."""
        raise NotImplementedError

    @cached_property
    def key(self) -> str:
        """Hash of the parameters and of all definitions that the result depends on."""
        return key_of(self, CODE)


def word(value: Any) -> str:
    """A parameter as people write it: of a record what differs from its defaults, of a function its name."""
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
    """A parameter as a column has it: a record or a function by its name."""
    return getattr(value, "name", getattr(value, "__name__", value))


def defaults(kind: Any) -> dict[str, Any] | None:
    """Field -> default of a class of records, None of another class."""
    if dataclasses.is_dataclass(kind):
        return {field.name: field.default for field in dataclasses.fields(kind)}
    if hasattr(kind, "_field_defaults"):
        return {name: kind._field_defaults.get(name, dataclasses.MISSING) for name in kind._fields}
    return None


def fields_of(value: Any) -> dict[str, Any] | None:
    """Field -> value of a record or a dict, None of another object."""
    if isinstance(value, dict):
        return value
    names = None if isinstance(value, type) else defaults(type(value))
    return None if names is None else {name: getattr(value, name) for name in names}


def parameters(value: Any) -> Any:
    """Parameters as JSON: exact (floats by repr), the type of every record with it."""
    if value is None or isinstance(value, bool | int | float | str):
        return value
    kind = {"": type(value).__qualname__}
    if isinstance(value, Enum):
        return {**kind, "name": value.name}
    fields = fields_of(value)
    if fields is not None:
        return kind | {str(name): parameters(item) for name, item in fields.items()}
    if isinstance(value, tuple | list):
        return [parameters(item) for item in value]
    if hasattr(value, "__qualname__") and "<" not in value.__qualname__:
        package = value.__module__.partition(".")[0]
        ours = package in (*PACKAGES, "__main__", "__mp_main__")    # what it says is in the key
        return {"": value.__qualname__} | ({} if ours else {"module": value.__module__})
    raise TypeError(f"a case cannot hold {value!r}: use numbers, texts, tuples, NamedTuples, dataclasses, "
                    "enums, or functions and classes of a module")


def key_of(case: Case, code: Code) -> str:
    """Key of a case with the definitions of another copy of our packages, or of these."""
    values = json.dumps(parameters(case), sort_keys=True)
    return digest(values, code.hash(starts(case)))


def starts(case: Case) -> Iterator[Place]:
    """Where the classes of a case are defined, and all that takes part in its parameters."""
    own = file_of(type(case).__module__)
    classes = [place_of(kind, own, CASE if issubclass(kind, Case) else WHOLE) for kind in type(case).__mro__]
    values = [place_of(kind, own) for value in vars(case).values() for kind in kinds(value)]
    yield from filter(None, classes + values)


def place_of(kind: Any, own: Path | None, part: str = WHOLE) -> Place | None:
    """Where a class or function is defined, None if neither in our packages nor in the file of the case."""
    path = file_of(kind.__module__)
    if path is None:
        return None
    script = str(path) if path == own else ""
    module = module_of(path) or script
    name = kind.__qualname__.split(".")[0]
    return Place(module, name, part) if module and followed(module) else None


def kinds(value: Any) -> Iterator[Any]:
    """Types of all parameters, nested ones too, and parameters that are functions or classes themselves."""
    yield value if hasattr(value, "__qualname__") else type(value)
    fields = fields_of(value)
    items = value if fields is None else list(fields.values())
    if isinstance(items, tuple | list):
        for item in items:
            yield from kinds(item)


@cache
def file_of(module: str | None) -> Path | None:
    """File of a module by its name, None for those that are built in."""
    file = getattr(sys.modules.get(module or ""), "__file__", None)
    return Path(file).resolve() if file else None


@cache
def module_of(path: Path) -> str | None:
    """Dotted name of a file of our packages: ``python -m studies.front`` calls itself __main__."""
    ours = any(path.is_relative_to(ROOT/package) for package in PACKAGES)
    return name_of(path) if ours else None
