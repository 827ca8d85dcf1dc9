"""Which definitions a result depends on, found without running anything, and their hash.

A case reaches its class, the functions and classes among its parameters, and whatever the syntax of these names, on and on
through our own packages. A formula registered with ``f.of(K)`` is reached when both f and K are. So a definition that moves, a
new one that no old one names, and a docstring change no key.
"""
import ast
import hashlib
from collections.abc import Iterable, Iterator, Sequence
from copy import copy
from operator import attrgetter
from pathlib import Path
from typing import Any

from studies.kit.syntax import (
    ACTION,
    CASE,
    COMPOUND,
    EVERYTHING,
    FUNCTION,
    WHOLE,
    Module,
    Place,
    Reader,
    Reading,
    acts,
    chain,
    parameters_of,
    parse,
    registers,
    targets,
)

__all__ = ["CODE", "PACKAGES", "ROOT", "Code", "digest", "find", "parse"]

ROOT = Path(__file__).resolve().parents[2]
PACKAGES = ("continuum", "particles", "studies")
#: what only carries results about, but for the modules that compute some of their numbers
CARRIERS, NUMBERS = "studies.kit.", ("studies.kit.stats", "studies.kit.timing")
#: of a case: the order and the names of runs, not what they find
ASIDE = ("cost", "label")


def find(name: str, root: Path = ROOT) -> Path | None:
    """File of a module of our own packages; None for other names and for what only carries results about."""
    return file_of(name, root) if followed(name) else None


def file_of(name: str, root: Path) -> Path | None:
    """File of a module of our own packages, or of the script that a path names."""
    if name.endswith(".py"):
        return Path(name)
    if name.split(".")[0] not in PACKAGES:
        return None
    base = root.joinpath(*name.split("."))
    return next((path for path in (base.with_suffix(".py"), base / "__init__.py") if path.is_file()), None)


def followed(module: str) -> bool:
    """Does what a module defines make a result another one?"""
    return not f"{module}.".startswith(CARRIERS) or module in NUMBERS


def digest(*pieces: str) -> str:
    """One hash over texts."""
    return hashlib.sha256("\0".join(pieces).encode()).hexdigest()


class Code:
    """The definitions in our packages below a folder, read once."""

    def __init__(self, root: Path = ROOT):
        self.root = root
        self.modules: dict[str, Module | None] = {}
        self.readings: dict[Place, Reading] = {}
        self.closures: dict[tuple[Any, ...], str] = {}
        #: place -> (all that must be reached, action)
        self.actions: dict[Place, list[tuple[frozenset[Place], Place]]] = {}
        #: table -> entry -> statement that is not in the table's own file, or below it
        self.added: dict[Place, dict[str, tuple[Module, ast.Assign]]] = {}
        self.complete = False

    def hash(self, starts: Iterable[Place], case: Any) -> str:
        """Hash of all definitions reached from some places; fields of the case choose entries of tables."""
        places = frozenset(starts)
        known = (places, tuple(map(repr, self.chosen(places, case).values())))
        if known not in self.closures:
            self.closures[known] = digest(*sorted(set(map(self.text, self.reached(places, case)))))
        return self.closures[known]

    def chosen(self, starts: Iterable[Place], case: Any) -> dict[str, Any]:
        """The fields of a case that choose entries of tables, with their values; none without a case."""
        self.index()
        choices = (choice for place in starts if place.part == CASE for choice in self.reading(place).choices)
        fields = sorted({field for _, field in choices} if case else ())
        return {field: attrgetter(field)(case) for field in fields}

    def text(self, place: Place) -> str:
        """A definition, with marks of those that it uses: two of one name are two."""
        reading = self.reading(place)
        return digest(reading.text, *(self.reading(use).text for use in reading.uses if followed(use.module)))

    def reached(self, starts: Iterable[Place], case: Any = None) -> set[Place]:
        """Places whose change makes the result another one; without a case all entries that its fields may choose."""
        starts = list(starts)
        values = self.chosen(starts, case)
        places: set[Place] = set()
        todo = starts
        while todo:
            place = todo.pop()
            if place in places or not followed(place.module):
                continue
            reading, marks = self.reading(place), (place, Place(place.module, "", WHOLE))
            places |= set(marks)
            todo += reading.uses
            todo += (self.entry(table, values[field]) if field in values else table for table, field in reading.choices)
            todo += (action for mark in marks for owners, action in self.actions.get(mark, ()) if owners <= places)
        return places

    # --- where things are --------------------------------------------------------------------------------------

    def index(self) -> None:
        """Know all that statements anywhere in our packages register."""
        if not self.complete:
            for package in PACKAGES:
                for path in sorted((self.root/package).rglob("*.py")):
                    name = ".".join(path.relative_to(self.root).with_suffix("").parts).removesuffix(".__init__")
                    if followed(name):
                        self.module(name)
            self.complete = True

    def module(self, name: str) -> Module | None:
        """A module of ours by its name, a script by its path."""
        if name not in self.modules:
            path = file_of(name, self.root)
            self.modules[name] = module = Module(name, path) if path else None
            if module and followed(name):
                for number, node in enumerate(module.actions):
                    self.note(module, node, Place(name, str(number), ACTION))
        return self.modules[name]

    def note(self, module: Module, node: ast.stmt, action: Place) -> None:
        """Remember what must be reached for a statement to count."""
        table = self.filled(module, node)
        if table and isinstance(node, ast.Assign):
            self.added.setdefault(table, {})[key_of(node)] = module, node
            return
        for owners in self.owners(module, node):
            for owner in owners:
                self.actions.setdefault(owner, []).append((owners, action))

    def filled(self, module: Module, node: ast.stmt) -> Place | None:
        """The table of ``TABLE["name"] = ...``."""
        if not isinstance(node, ast.Assign) or not key_of(node):
            return None
        return self.named(module, node.targets[0].value)  # type: ignore[attr-defined]

    def named(self, module: Module, node: ast.AST) -> Place | None:
        """The definition that an expression names, or that the object it names belongs to."""
        parts = Reader(self, module).meaning(chain(node)) if chain(node) else ()
        return self.locate(parts)[0] if parts else None

    def owners(self, module: Module, node: ast.stmt) -> Iterator[frozenset[Place]]:
        """All of what must be reached for a statement to count; several where it does several things."""
        here = frozenset([Place(module.name, "", WHOLE)])
        own = {place for name in module.definitions if node in module.definitions[name]
               for place in [Place(module.name, name)]}
        for parts in heads(node):
            yield frozenset(place for part in parts if (place := self.named(module, part))) - own or here

    def locate(self, parts: tuple[str, ...]) -> tuple[Place | None, tuple[str, ...]]:
        """The place that a full name leads to, through whatever imports it, and what is left of the name; None: not ours."""
        for length in range(len(parts), 0, -1):
            if module := self.module(".".join(parts[:length])):
                break
        else:
            return self.script(parts)
        if length == len(parts):
            return Place(module.name, "", EVERYTHING), ()
        return self.member(module, parts[length], parts[length + 1:])

    def script(self, parts: tuple[str, ...]) -> tuple[Place | None, tuple[str, ...]]:
        """The same for a script, whose name is a path."""
        module = self.modules.get(parts[0])
        return self.member(module, parts[1], parts[2:]) if module else (None, ())

    def member(self, module: Module, name: str, rest: tuple[str, ...]) -> tuple[Place | None, tuple[str, ...]]:
        """The place of a name in a module."""
        if name in module.definitions:
            return Place(module.name, name), rest
        origin = module.imports.get(name)
        return self.locate((*origin.split("."), *rest)) if origin else (None, ())

    # --- what they say -----------------------------------------------------------------------------------------

    def reading(self, place: Place) -> Reading:
        """Syntax of a place, and what it uses."""
        if place not in self.readings:
            module = self.module(place.module)
            assert module, f"{place.module} was found when its name was"
            self.readings[place] = self.read(module, place)
        return self.readings[place]

    def read(self, module: Module, place: Place) -> Reading:
        reader = Reader(self, module)
        if place.part == EVERYTHING:
            return Reading("", tuple(Place(module.name, name) for name in module.definitions))
        if place.part == ACTION:
            return reader.read(module.actions[int(place.name)])
        if place.part == CASE:
            reader.case = "self"
            return reader.read(*(bare(node) for node in module.definitions[place.name]))
        if place.part:
            return self.read_entry(reader, place)
        if not place.name:
            return Reading("")
        text, uses, choices = reader.read(*module.definitions[place.name])
        return Reading(text, (*uses, *(place._replace(part=key) for key in sorted(self.added.get(place, {})))), choices)

    def read_entry(self, reader: Reader, place: Place) -> Reading:
        """One entry of a table."""
        table = Place(place.module, place.name)
        if place.part in self.added.get(table, {}):
            module, node = self.added[table][place.part]
            return Reader(self, module).read(node.value)
        return reader.read(self.entries(table)[place.part])

    def entry(self, table: Place, key: Any) -> Place:
        """The entry of a table, or all of the table where it is made in another way than by listing."""
        known = {**self.entries(table), **self.added.get(table, {})}
        return table._replace(part=repr(key)) if repr(key) in known else table

    def entries(self, table: Place) -> dict[str, ast.expr]:
        """The entries of ``{"name": value, ...}`` and of ``{x.name: x for x in (Kind("name", ...), ...)}``."""
        module = self.module(table.module)
        nodes = module.definitions.get(table.name, []) if module else []
        value = getattr(nodes[0], "value", None) if len(nodes) == 1 else None
        if isinstance(value, ast.Dict):
            pairs = [(repr(key.value) if isinstance(key, ast.Constant) else "", item)
                     for key, item in zip(value.keys, value.values, strict=True)]
        elif isinstance(value, ast.DictComp):
            pairs = list(listed(value))
        else:
            return {}
        return dict(pairs) if all(key for key, _ in pairs) else {}


def listed(node: ast.DictComp) -> Iterator[tuple[str, ast.expr]]:
    """Entries of ``{x.name: x for x in (Kind("name", ...), ...)}``, without a name where it is another comprehension."""
    one = node.generators[0]
    name = chain(node.value)
    plain = len(node.generators) == 1 and not one.ifs and len(name) == 1 and chain(node.key) == (*name, "name")
    for item in one.iter.elts if isinstance(one.iter, ast.Tuple | ast.List) else [one.iter]:
        first = item.args[0] if isinstance(item, ast.Call) and item.args else None
        yield repr(first.value) if plain and isinstance(first, ast.Constant) else "", item


def key_of(node: ast.Assign) -> str:
    """The key of ``TABLE["name"] = ...``, nothing of other assignments."""
    target = node.targets[0]
    if len(node.targets) > 1 or not isinstance(target, ast.Subscript) or not isinstance(target.value, ast.Name):
        return ""
    return repr(target.slice.value) if isinstance(target.slice, ast.Constant) else ""


def heads(node: ast.AST) -> Iterator[Sequence[ast.AST]]:
    """Of each thing that a statement does besides defining: what it does it to, and for which kinds."""
    if isinstance(node, FUNCTION | ast.ClassDef):
        for decorator in node.decorator_list:
            if registers(decorator):
                first = parameters_of(node.args)[:1] if isinstance(node, FUNCTION) and not isinstance(decorator, ast.Call) else []
                kinds = [one.annotation for one in first if one.annotation]
                yield [*head(decorator), *kinds]
            elif isinstance(decorator, ast.Call):
                yield list(decorator.args)
    elif isinstance(node, COMPOUND):
        for child in ast.iter_child_nodes(node):
            if isinstance(child, ast.stmt) and acts(child):
                yield from heads(child)
    elif isinstance(node, ast.Assign | ast.AugAssign):
        yield from ([target.value] for target in targets(node) if isinstance(target, ast.Subscript | ast.Attribute))
    else:
        yield head(getattr(node, "value", node))


def head(node: ast.AST) -> list[ast.AST]:
    """[f, K] of ``f.of(K)(formula)``, ``f.of(K)`` and ``f.register(K, formula)``; [table] of ``table.update(...)``."""
    kinds: list[ast.AST] = []
    if isinstance(node, ast.Call) and isinstance(node.func, ast.Call):
        node = node.func
    if isinstance(node, ast.Call):
        kinds, node = list(node.args[:1] if registers(node) else []), node.func
    return [node.value if isinstance(node, ast.Attribute) else node, *kinds]


def bare(node: ast.stmt) -> ast.stmt:
    """A class of cases without the types and defaults of its fields, whose values are parameters, and without cost and label."""
    if not isinstance(node, ast.ClassDef):
        return node
    case = copy(node)
    case.bases = []     # they are classes of the case themselves
    body = [one for one in node.body if not (isinstance(one, FUNCTION) and one.name in ASIDE) and not is_field(one)]
    case.body = body or [ast.Pass()]
    return case


def is_field(node: ast.stmt) -> bool:
    """A field of a dataclass."""
    return isinstance(node, ast.AnnAssign) and "ClassVar" not in ast.dump(node.annotation)


CODE = Code()
