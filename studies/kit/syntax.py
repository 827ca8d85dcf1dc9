"""Our own modules as syntax: what defines a name, what it means, how a statement reads without layout.

Docstrings, comments, annotations of functions and names of modules are left out: none changes a result.
"""
import ast
from collections.abc import Iterator
from copy import deepcopy
from functools import cache
from pathlib import Path
from typing import Any, NamedTuple

FUNCTION = ast.FunctionDef | ast.AsyncFunctionDef
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
        if isinstance(node, ast.ExceptHandler | ast.MatchAs | ast.MatchStar) and node.name:
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


# --- how they read ---------------------------------------------------------------------------------


class Reader(ast.NodeTransformer):
    """Rewrites statements so that a name reads the same wherever it is defined; notes the places they use."""

    def __init__(self, code: Any, module: Module):
        self.code, self.module = code, module
        self.uses: dict[Place, None] = {}
        self.scopes: list[dict[str, str]] = []      # name -> origin of an import, nothing of a variable
        self.fields = False     # is it the body of a class, whose annotations make fields?

    def read(self, *nodes: ast.AST) -> Reading:
        """Syntax and uses of statements, in an order of their own."""
        texts = sorted(ast.dump(self.visit(deepcopy(node))) for node in nodes)
        return Reading("\n".join(texts), tuple(self.uses))

    def visit_Name(self, node: ast.Name) -> ast.expr:
        return self.renamed(node) if isinstance(node.ctx, ast.Load) else node

    def visit_Attribute(self, node: ast.Attribute) -> ast.expr:
        whole = chain(node) and isinstance(node.ctx, ast.Load)
        return self.renamed(node) if whole else self.generic_visit(node)  # type: ignore[return-value]

    def renamed(self, node: ast.expr) -> ast.expr:
        """A chain of names with the definition's own name in place of what leads to it."""
        dotted = self.meaning(chain(node))
        if not dotted:
            return node
        place, rest = self.code.locate(dotted)
        if not place:
            return ast.Name(".".join(dotted), ast.Load())
        self.uses[place] = None
        result: ast.expr = ast.Name(place.name, ast.Load())
        for name in rest:
            result = ast.Attribute(result, name, ast.Load())
        return result

    def meaning(self, parts: tuple[str, ...]) -> tuple[str, ...]:
        """Full dotted name, nothing for variables and for names that Python itself knows."""
        if not parts:
            return ()
        first, *rest = parts
        for scope in reversed(self.scopes):
            if first in scope:
                return (*scope[first].split("."), *rest) if scope[first] else ()
        if first in self.module.definitions:
            return (self.module.name, *parts)
        origin = self.module.imports.get(first)
        return (*origin.split("."), *rest) if origin else ()

    def visit_Subscript(self, node: ast.Subscript) -> ast.expr:
        """``TABLE["name"]`` uses one entry."""
        place, rest = self.code.locate(self.meaning(chain(node.value)))
        key = node.slice
        if not place or rest or not isinstance(key, ast.Constant) or not isinstance(node.ctx, ast.Load):
            return self.generic_visit(node)  # type: ignore[return-value]
        self.uses[self.code.entry(place, key.value)] = None
        return ast.Subscript(ast.Name(place.name, ast.Load()), key, node.ctx)

    # --- scopes ------------------------------------------------------------------------------------

    def visit_FunctionDef(self, node: ast.FunctionDef) -> ast.FunctionDef:
        node.decorator_list = [self.visit(decorator) for decorator in node.decorator_list]
        node.returns = None
        self.visit_signature(node.args, types=node.name == UNNAMED)
        node.body = self.inner(undocumented(node.body), node.args) or [ast.Pass()]
        return node

    visit_AsyncFunctionDef = visit_FunctionDef  # type: ignore[assignment]

    def visit_ClassDef(self, node: ast.ClassDef) -> ast.AST:
        before, self.fields = self.fields, True
        node.body = undocumented(node.body)
        result = self.generic_visit(node)
        self.fields = before
        return result

    def visit_Lambda(self, node: ast.Lambda) -> ast.Lambda:
        self.visit_signature(node.args)
        node.body, = self.inner([node.body], node.args)
        return node

    def visit_signature(self, arguments: ast.arguments, types: bool = False) -> None:
        """Defaults belong to the scope around; ``types`` choose the formula that a function registers."""
        arguments.defaults = [self.visit(value) for value in arguments.defaults]
        arguments.kw_defaults = [value and self.visit(value) for value in arguments.kw_defaults]
        for one in parameters_of(arguments):
            one.annotation = self.visit(one.annotation) if types and one.annotation else None

    def inner(self, body: list[Any], arguments: ast.arguments) -> list[Any]:
        """A function's body, read with its variables."""
        scope = dict.fromkeys((one.arg for one in parameters_of(arguments)), "")
        public: set[str] = set()
        for node in body:
            scope |= dict.fromkeys(stores(node), "")
            public |= {name for one in ast.walk(node) if isinstance(one, ast.Global) for name in one.names}
        for node in body:
            scope |= dict(imported(node, self.module.package))
        self.scopes.append({name: origin for name, origin in scope.items() if origin or name not in public})
        before, self.fields = self.fields, False
        nodes = [self.visit(node) for node in body]
        self.fields = before
        self.scopes.pop()
        return [node for node in nodes if node is not None]

    def visit_comprehension_of(self, node: Any) -> Any:
        first, *others = node.generators
        first.iter = self.visit(first.iter)
        names = (name for one in node.generators for name in stores(one.target))
        self.scopes.append(dict.fromkeys(names, ""))
        first.target, first.ifs = self.visit(first.target), [self.visit(test) for test in first.ifs]
        node.generators = [first, *map(self.visit, others)]
        for field in ("elt", "key", "value"):
            if hasattr(node, field):
                setattr(node, field, self.visit(getattr(node, field)))
        self.scopes.pop()
        return node

    visit_ListComp = visit_SetComp = visit_DictComp = visit_GeneratorExp = visit_comprehension_of

    # --- what does not count -----------------------------------------------------------------------

    def visit_Import(self, node: Any) -> None:
        """What is imported shows where it is used."""

    visit_ImportFrom = visit_Import

    def visit_AnnAssign(self, node: ast.AnnAssign) -> Any:
        """A type stays where it makes a field of a class, but what it names is not used."""
        value = node.value and self.visit(node.value)
        if not self.fields:
            return ast.Assign([self.visit(node.target)], value) if value else None
        uses, self.uses = self.uses, {}
        node.annotation, node.value = self.visit(node.annotation), value
        self.uses = uses
        return node

    def generic_visit(self, node: ast.AST) -> ast.AST:
        super().generic_visit(node)
        if getattr(node, "body", None) == []:
            setattr(node, "body", [ast.Pass()])  # noqa: B010  (mypy allows it so)
        return node
