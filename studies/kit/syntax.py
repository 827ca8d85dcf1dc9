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
    """A file: what its top-level statements define, what they import, and what they do besides."""

    def __init__(self, name: str, path: Path):
        self.name, self.path = name, path
        self.definitions: dict[str, list[ast.stmt]] = {}
        self.imports: dict[str, str] = {}
        self.actions: list[ast.stmt] = []
        self.package = name if path.name == "__init__.py" else name.rpartition(".")[0]
        for node in filter(counts, parse(path).body):
            if isinstance(node, ast.Import | ast.ImportFrom | COMPOUND):
                self.imports |= dict(imported(node, self.package))
            for bound in defines(node):
                self.definitions.setdefault(bound, []).append(node)
            if acts(node):
                self.actions.append(node)


@cache
def parse(path: Path) -> ast.Module:
    """Syntax tree of a file."""
    return ast.parse(path.read_text(), filename=str(path))


# --- statements ------------------------------------------------------------------------------------


def counts(node: ast.stmt) -> bool:
    """Does a top-level statement run when its module is imported, and change anything?"""
    main = isinstance(node, ast.If) and "__name__" in ast.unparse(node.test)
    return not main and not isinstance(node, ast.Assert | ast.Pass)


def imported(tree: ast.AST, package: str) -> Iterator[tuple[str, str]]:
    """(name, what it stands for) of all import statements in a tree.

    Raises ValueError: ``from x import *``, after which nobody could tell what a name means.
    """
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            for alias in node.names:
                top = alias.name.split(".")[0]
                yield (alias.asname, alias.name) if alias.asname else (top, top)
        elif isinstance(node, ast.ImportFrom):
            origin = origin_of(node, package)
            for alias in node.names:
                if alias.name == "*":
                    raise ValueError(f"from {origin} import * in {package or 'a script'}: import names one "
                                     "by one, so that keys can follow them")
                yield alias.asname or alias.name, f"{origin}.{alias.name}"


def origin_of(node: ast.ImportFrom, package: str) -> str:
    """Full name of the module that an import takes names from."""
    above = package.split(".")
    base = above[:len(above) - node.level + 1] if node.level else []
    return ".".join([*base, *filter(None, [node.module])])


def defines(node: ast.stmt) -> Iterator[str]:
    """Names that a top-level statement binds, other than by an import; ``_`` is no name."""
    names = dict.fromkeys(stores(node))
    if isinstance(node, FUNCTION):
        names.pop(UNNAMED, None)
    yield from names


def stores(node: ast.AST) -> Iterator[str]:
    """Names that a statement or expression binds in its own scope, other than by imports."""
    if isinstance(node, FUNCTION | ast.ClassDef):
        yield node.name
    elif isinstance(node, ast.Name) and isinstance(node.ctx, ast.Store | ast.Del):
        yield node.id
    elif isinstance(node, COMPREHENSION | ast.Lambda):
        for inner in ast.walk(node):
            if isinstance(inner, ast.NamedExpr):
                yield from stores(inner.target)
    else:
        if isinstance(node, ast.ExceptHandler) and node.name:
            yield node.name
        for child in ast.iter_child_nodes(node):
            yield from stores(child)


def acts(node: ast.stmt) -> bool:
    """Does a top-level statement do more than to define: register a formula, fill a table, set something?"""
    if isinstance(node, FUNCTION | ast.ClassDef):
        return node.name == UNNAMED or any(map(registers, node.decorator_list))
    if isinstance(node, COMPOUND):
        return any(acts(child) for child in ast.iter_child_nodes(node) if isinstance(child, ast.stmt))
    if isinstance(node, ast.Assign | ast.AugAssign):
        return not all(isinstance(target, ast.Name | ast.Tuple | ast.List) for target in targets(node))
    documents = isinstance(getattr(node, "value", None), ast.Constant)
    return isinstance(node, ast.Expr | ast.Delete) and not documents


def targets(node: ast.Assign | ast.AugAssign) -> list[ast.expr]:
    """What an assignment is made to."""
    return node.targets if isinstance(node, ast.Assign) else [node.target]


def registers(node: ast.expr) -> bool:
    """Is it ``f.of(K)``, ``f.register`` or ``f.register(K)``?"""
    head = node.func if isinstance(node, ast.Call) else node
    if not (isinstance(head, ast.Attribute) and isinstance(head.value, ast.Name)):
        return False
    return head.attr in ("of", "register")


def chain(node: ast.AST) -> tuple[str, ...]:
    """(a, b, c) of ``a.b.c``, nothing of all else."""
    if isinstance(node, ast.Name):
        return (node.id,)
    above = chain(node.value) if isinstance(node, ast.Attribute) else ()
    return (*above, node.attr) if above and isinstance(node, ast.Attribute) else ()


def parameters_of(arguments: ast.arguments) -> list[ast.arg]:
    """All parameters of a function."""
    some = [arguments.vararg, arguments.kwarg]
    return [*arguments.posonlyargs, *arguments.args, *arguments.kwonlyargs, *filter(None, some)]


def undocumented(body: list[ast.stmt]) -> list[ast.stmt]:
    """Statements without the docstring."""
    first = body[0]
    documents = isinstance(first, ast.Expr) and isinstance(first.value, ast.Constant)
    return body[1:] or [ast.Pass()] if documents else body


# --- what they register ----------------------------------------------------------------------------


def heads(node: ast.AST) -> Iterator[Sequence[ast.AST]]:
    """Of each thing that a statement does besides defining: what it does it to, and for which kinds."""
    if isinstance(node, FUNCTION | ast.ClassDef):
        for decorator in node.decorator_list:
            if registers(decorator):
                yield [*head(decorator), *kinds(node, decorator)]
            elif isinstance(decorator, ast.Call):
                yield list(decorator.args)
    elif isinstance(node, COMPOUND):
        for child in ast.iter_child_nodes(node):
            if isinstance(child, ast.stmt) and acts(child):
                yield from heads(child)
    elif isinstance(node, ast.Assign | ast.AugAssign):
        for target in targets(node):
            if isinstance(target, ast.Subscript | ast.Attribute):
                yield [target.value]
    else:
        yield head(getattr(node, "value", node))


def kinds(node: ast.AST, decorator: ast.expr) -> list[ast.expr]:
    """Types of the first parameter of a function below ``f.register``."""
    if isinstance(decorator, ast.Call) or not isinstance(node, FUNCTION):
        return []
    return [one.annotation for one in parameters_of(node.args)[:1] if one.annotation]


def head(node: ast.AST) -> list[ast.AST]:
    """[f, K] of ``f.of(K)(formula)``, ``f.of(K)``, ``f.register(K, formula)``; [t] of ``t.update(...)``."""
    kinds: list[ast.AST] = []
    if isinstance(node, ast.Call) and isinstance(node.func, ast.Call):
        node = node.func
    if isinstance(node, ast.Call):
        kinds, node = list(node.args[:1] if registers(node) else []), node.func
    return [node.value if isinstance(node, ast.Attribute) else node, *kinds]
