"""Syntax of our modules: statements that define names, meanings of names, and what statements register.

Docstrings, comments, annotations of functions and names of modules are left out: none changes a result.
"""
import ast
from collections.abc import Iterator, Sequence
from functools import cache
from pathlib import Path
from typing import NamedTuple

FUNCTION = ast.FunctionDef
COMPREHENSION = ast.ListComp | ast.SetComp | ast.DictComp | ast.GeneratorExp
COMPOUND = ast.If | ast.For | ast.While | ast.Try | ast.With
WHOLE, EVERYTHING, CASE, ACTION = "", "everything", "case", "action"
UNNAMED = "_"       # name of functions that are only registered
#: parts of a dotted name, the package or variable first
Dotted = tuple[str, ...]


class Place(NamedTuple):
    """Part of a module: a definition, an entry of a table, a class of cases, an action, or everything."""

    module: str
    name: str
    part: str = WHOLE


class Reading(NamedTuple):
    """A definition as it is read: its syntax, and the places that it uses."""

    text: str
    uses: tuple[Place, ...] = ()


class Module:
    """A file: names that its top-level statements define, meanings of names, and actions besides."""

    def __init__(self, name: str, path: Path):
        self.name = name
        self.definitions: dict[str, list[ast.stmt]] = {}
        self.meanings: dict[str, Dotted] = {}
        self.actions: list[ast.stmt] = []
        for node in filter(counts, parse(path).body):
            if isinstance(node, ast.Import | ast.ImportFrom | COMPOUND):
                self.meanings |= dict(imported(node, name))
            for bound in dict.fromkeys(stores(node)):
                if bound != UNNAMED:
                    self.definitions.setdefault(bound, []).append(node)
            if any(heads(node)):
                self.actions.append(node)
        self.meanings |= {bound: (name, bound) for bound in self.definitions}


@cache
def parse(path: Path) -> ast.Module:
    """Syntax tree of a file."""
    return ast.parse(path.read_text(), filename=str(path))


def counts(node: ast.stmt) -> bool:
    """Whether a top-level statement has an effect when its module is imported."""
    main = isinstance(node, ast.If) and "__name__" in ast.unparse(node.test)
    return not main and not isinstance(node, ast.Assert | ast.Pass)


def imported(tree: ast.AST, module: str) -> Iterator[tuple[str, Dotted]]:
    """(name, full dotted name) for all import statements in a tree.

    Raises ValueError: ``from x import *`` or ``from . import x``, which hide where a name is from.
    """
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            for alias in node.names:
                top = alias.name.split(".")[0]
                yield (alias.asname, (alias.name,)) if alias.asname else (top, (top,))
        elif isinstance(node, ast.ImportFrom):
            for alias in node.names:
                if alias.name == "*" or not node.module or node.level:
                    raise ValueError(f"{ast.unparse(node)} in {module}: import names one by one, from the "
                                     "full name of a module, so that keys can follow them")
                yield alias.asname or alias.name, (node.module, alias.name)


def stores(node: ast.AST) -> Iterator[str]:
    """Names that a statement or expression binds in its own scope, other than by imports."""
    if isinstance(node, FUNCTION | ast.ClassDef):
        yield node.name
    elif isinstance(node, ast.Name) and isinstance(node.ctx, ast.Store | ast.Del):
        yield node.id
    elif not isinstance(node, COMPREHENSION | ast.Lambda):
        if isinstance(node, ast.ExceptHandler) and node.name:
            yield node.name
        for child in ast.iter_child_nodes(node):
            yield from stores(child)


def registers(node: ast.expr) -> bool:
    """Whether a node is ``f.of(K)``, ``f.register`` or ``f.register(K)``."""
    names = chain(node.func if isinstance(node, ast.Call) else node)
    return len(names) == 2 and names[1] in ("of", "register")


def chain(node: ast.AST) -> Dotted:
    """(a, b, c) for ``a.b.c``, () for anything else."""
    if isinstance(node, ast.Name):
        return (node.id,)
    above = chain(node.value) if isinstance(node, ast.Attribute) else ()
    return (*above, node.attr) if above and isinstance(node, ast.Attribute) else ()


def parameters_of(arguments: ast.arguments) -> list[ast.arg]:
    """All parameters of a function."""
    some = [arguments.vararg, arguments.kwarg]
    return [*arguments.posonlyargs, *arguments.args, *arguments.kwonlyargs, *filter(None, some)]


# --- what statements register ----------------------------------------------------------------------


def heads(node: ast.AST) -> Iterator[Sequence[ast.AST]]:
    """For each action of a statement besides definitions: the object that it acts on, and the types given.

    An action registers a formula for types, fills a table, or sets an entry or attribute.
    """
    if isinstance(node, FUNCTION | ast.ClassDef):
        for decorator in node.decorator_list:
            if registers(decorator):
                yield [*head(decorator), *kinds(node, decorator)]
            elif isinstance(decorator, ast.Call) and node.name == UNNAMED:
                yield decorator.args
    elif isinstance(node, COMPOUND):
        for child in ast.iter_child_nodes(node):
            yield from heads(child)
    elif isinstance(node, ast.Assign):
        for target in node.targets:
            if isinstance(target, ast.Subscript | ast.Attribute):
                yield [target.value]
    elif isinstance(node, ast.Expr) and not isinstance(node.value, ast.Constant):
        yield head(node.value)


def kinds(node: ast.AST, decorator: ast.expr) -> list[ast.expr]:
    """Type of the first parameter of a function decorated by ``f.register`` without arguments."""
    if isinstance(decorator, ast.Call) or not isinstance(node, FUNCTION):
        return []
    return [one.annotation for one in parameters_of(node.args)[:1] if one.annotation]


def head(node: ast.expr) -> list[ast.expr]:
    """[f, K] of ``f.of(K)(formula)``, ``f.of(K)``, ``f.register(K, formula)``; [t] of ``t.update(...)``."""
    kinds: list[ast.expr] = []
    if isinstance(node, ast.Call) and isinstance(node.func, ast.Call):
        node = node.func
    if isinstance(node, ast.Call):
        kinds = node.args[:1] if registers(node) else []
        node = node.func
    return [node.value if isinstance(node, ast.Attribute) else node, *kinds]
