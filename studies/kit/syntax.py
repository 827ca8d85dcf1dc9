"""Our own modules as syntax: what defines a name, what it means, how a statement reads without layout.

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
UNNAMED = "_"       # what functions are called that are only registered
#: a name, from the package or variable that it begins with
Dotted = tuple[str, ...]


class Place(NamedTuple):
    """A definition of a module: all of it, one entry of a table, a class as a case has it, or an action."""

    module: str
    name: str
    part: str = WHOLE


class Reading(NamedTuple):
    """What a definition says: its syntax, and the places that it uses."""

    text: str
    uses: tuple[Place, ...] = ()


class Module:
    """A file: what its top-level statements define, what names mean there, and what they do besides."""

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
    """Does a top-level statement run when its module is imported, and change anything?"""
    main = isinstance(node, ast.If) and "__name__" in ast.unparse(node.test)
    return not main and not isinstance(node, ast.Assert | ast.Pass)


def imported(tree: ast.AST, module: str) -> Iterator[tuple[str, Dotted]]:
    """(name, what it stands for) of all import statements in a tree.

    Raises ValueError: ``from x import *`` or ``from . import x``, which does not say where a name is from.
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
    """Is it ``f.of(K)``, ``f.register`` or ``f.register(K)``?"""
    names = chain(node.func if isinstance(node, ast.Call) else node)
    return len(names) == 2 and names[1] in ("of", "register")


def chain(node: ast.AST) -> Dotted:
    """(a, b, c) of ``a.b.c``, nothing of all else."""
    if isinstance(node, ast.Name):
        return (node.id,)
    above = chain(node.value) if isinstance(node, ast.Attribute) else ()
    return (*above, node.attr) if above and isinstance(node, ast.Attribute) else ()


def parameters_of(arguments: ast.arguments) -> list[ast.arg]:
    """All parameters of a function."""
    some = [arguments.vararg, arguments.kwarg]
    return [*arguments.posonlyargs, *arguments.args, *arguments.kwonlyargs, *filter(None, some)]


# --- what they register ----------------------------------------------------------------------------


def heads(node: ast.AST) -> Iterator[Sequence[ast.AST]]:
    """Of each thing that a statement does besides defining: what it does it to, and for which kinds.

    It registers a formula, fills a table, or sets something.
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
    """Types of the first parameter of a function below ``f.register``."""
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
