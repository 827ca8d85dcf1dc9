"""Hash of the definitions that a result depends on, which are found from syntax without running anything.

A case reaches its class, the functions and classes among its parameters, and all definitions that these name,
recursively through our packages. A formula registered with ``f.of(K)`` is reached when both f and K are, an
entry of a table when it is named. So no key changes when a definition moves, when a new one is added that no
old one names, or when a docstring changes.
"""
import ast
import hashlib
from collections import defaultdict
from collections.abc import Iterable, Iterator
from copy import copy
from functools import cached_property
from pathlib import Path
from typing import Any

from studies.kit.reader import Reader
from studies.kit.syntax import ACTION, CASE, EVERYTHING, Dotted, Module, Place, Reading, chain, heads, stores

ROOT = Path(__file__).resolve().parents[2]
PACKAGES = ("continuum", "particles", "studies")
#: modules that only handle results, and those among them that compute numbers of results
CARRIERS, NUMBERS = "studies.kit.", ("studies.kit.stats", "studies.kit.timing")
#: members of a case that set order and names of runs, not their results
ASIDE = ("cost", "label")
#: places that must all be reached for an action to count
Owners = frozenset[Place]


def is_ours(module: str) -> bool:
    """Whether a module is in our packages."""
    return module.partition(".")[0] in PACKAGES


def followed(module: str) -> bool:
    """Whether definitions of a module may affect results."""
    return module in NUMBERS or not f"{module}.".startswith(CARRIERS)


def digest(*pieces: str) -> str:
    """One hash of several texts."""
    return hashlib.sha256("\0".join(pieces).encode()).hexdigest()


class Code:
    """Definitions in our packages below a folder, each read once."""

    def __init__(self, root: Path = ROOT):
        self.root = root
        self.modules: dict[str, Module | None] = {}
        self.readings: dict[Place, Reading] = {}
        self.hashes: dict[frozenset[Place], str] = {}

    def hash(self, starts: Iterable[Place]) -> str:
        """Hash of all definitions reached from some places."""
        places = frozenset(starts)
        if places not in self.hashes:
            texts = {self.text(place) for place in self.reached(places)}
            self.hashes[places] = digest(*sorted(texts))
        return self.hashes[places]

    def text(self, place: Place) -> str:
        """Hash of a definition and of those that it uses, as names alone may stand for different ones."""
        reading = self.reading(place)
        used = [self.reading(use).text for use in reading.uses if followed(use.module)]
        return digest(reading.text, *used)

    def reached(self, starts: Iterable[Place]) -> set[Place]:
        """All places that a result depends on, found recursively from some places."""
        places: set[Place] = set()
        todo = list(starts)
        while todo:
            place = todo.pop()
            if place in places or not followed(place.module):
                continue
            marks = (place, Place(place.module, ""))
            places.update(marks)
            todo += self.reading(place).uses
            for mark in marks:
                todo += (action for owners, action in self.actions.get(mark, ()) if owners <= places)
        return places

    # --- finding definitions -----------------------------------------------------------------------

    @cached_property
    def files(self) -> dict[str, Path]:
        """Files of our packages by the names of their modules."""
        paths = [path for package in PACKAGES for path in (self.root/package).rglob("*.py")]
        names = [".".join(path.relative_to(self.root).with_suffix("").parts) for path in paths]
        return {name.removesuffix(".__init__"): path for name, path in zip(names, paths)}

    def module(self, name: str) -> Module | None:
        """A module of our packages by its name, a script by its path; None for others."""
        if name not in self.modules:
            path = Path(name) if name.endswith(".py") else self.files.get(name)
            self.modules[name] = Module(name, path) if path else None
        return self.modules[name]

    @cached_property
    def actions(self) -> dict[Place, list[tuple[Owners, Place]]]:
        """Statements of our packages that do more than define names, by each of their owners."""
        actions = defaultdict(list)
        for module in filter(None, map(self.module, filter(followed, self.files))):
            for number, node in enumerate(module.actions):
                action = Place(module.name, str(number), ACTION)
                for owners in self.owners(module, node):
                    for owner in owners:
                        actions[owner].append((owners, action))
        return actions

    def owners(self, module: Module, node: ast.stmt) -> Iterator[Owners]:
        """For each thing that a statement does, the places that must all be reached for it to count."""
        reader = Reader(self, module)
        own = {Place(module.name, name) for name in stores(node)}
        for parts in heads(node):
            names = [reader.meaning(chain(part)) for part in parts]
            places = {place for place, _ in map(self.locate, names) if place}
            yield frozenset(places - own or {Place(module.name, "")})

    def locate(self, parts: Dotted) -> tuple[Place | None, Dotted]:
        """Place of a full dotted name, None outside our packages, and the rest of the name after it."""
        for length in range(len(parts), 0, -1):
            module, rest = self.module(".".join(parts[:length])), parts[length:]
            if module and not rest:
                return Place(module.name, "", EVERYTHING), ()
            if module:
                return self.member(module, *rest)
        return None, ()

    def member(self, module: Module, name: str, *rest: str) -> tuple[Place | None, Dotted]:
        """Place of a name in a module, imports followed, and the rest of the name after it."""
        if name in module.definitions:
            return Place(module.name, name), rest
        origin = module.meanings.get(name)
        return self.locate((*origin, *rest)) if origin else (None, ())

    # --- reading definitions -----------------------------------------------------------------------

    def reading(self, place: Place) -> Reading:
        """Syntax of a place, and the places that it uses."""
        if place not in self.readings:
            self.readings[place] = self.read(place)
        return self.readings[place]

    def read(self, place: Place) -> Reading:
        module = self.module(place.module)
        assert module, f"{place.module} was found when its name was"
        reader = Reader(self, module)
        if place.part == EVERYTHING:
            return Reading("", tuple(Place(module.name, name) for name in module.definitions))
        if place.part == ACTION:
            return reader.read(module.actions[int(place.name)])
        if not place.name:
            return Reading("")
        nodes = module.definitions[place.name]
        if place.part == CASE:
            return reader.read(*map(bare, nodes))
        if place.part:
            return reader.read(entries(nodes)[place.part])
        return reader.read(*nodes)

    def entry(self, table: Place, key: object) -> Place:
        """Place of one entry of a table, or of the whole table if its entries are not listed literally."""
        module = self.module(table.module)
        nodes = module.definitions.get(table.name, []) if module else []
        return table._replace(part=repr(key)) if repr(key) in entries(nodes) else table


def entries(nodes: list[ast.stmt]) -> dict[str, ast.expr]:
    """Entries of ``{"name": value, ...}`` or ``{x.name: x for x in (Kind("name", ...), ...)}``, else none."""
    value = getattr(nodes[0], "value", None) if len(nodes) == 1 else None
    if isinstance(value, ast.Dict):
        keys, items = value.keys, value.values
    elif isinstance(value, ast.DictComp):
        items = listed(value)
        keys = [item.args[0] for item in items if isinstance(item, ast.Call) and item.args]
    else:
        return {}
    names = [repr(key.value) for key in keys if isinstance(key, ast.Constant)]
    return dict(zip(names, items)) if len(names) == len(items) else {}


def listed(node: ast.DictComp) -> list[ast.expr]:
    """Values listed in ``{x.name: x for x in (value, ...)}``; none for other comprehensions."""
    values = node.generators[0].iter
    x, all_values = ast.unparse(node.value), ast.unparse(values)
    by_name = ast.unparse(node) == f"{{{x}.name: {x} for {x} in {all_values}}}"
    return values.elts if by_name and isinstance(values, ast.Tuple | ast.List) else []


def bare(node: Any) -> ast.stmt:
    """A class of cases without fields, cost, label, and bases, which `starts` of case.py lists themselves."""
    case = copy(node)
    case.bases = []
    case.body = [one for one in node.body if not is_aside(one)] or [ast.Pass()]
    return case


def is_aside(node: ast.stmt) -> bool:
    """Whether a statement is a field of a dataclass, whose value is a parameter, or one of ASIDE."""
    if isinstance(node, ast.AnnAssign):
        return "ClassVar" not in ast.unparse(node.annotation)
    return isinstance(node, ast.FunctionDef) and node.name in ASIDE


CODE = Code()
