"""A definition as it reads without layout, names in place of what leads to them, and the places it uses."""
import ast
from copy import deepcopy
from typing import Any

from studies.kit.syntax import (
    UNNAMED,
    Module,
    Place,
    Reading,
    chain,
    imported,
    parameters_of,
    stores,
    undocumented,
)


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
        for node in body:
            scope |= dict.fromkeys(stores(node), "")
        for node in body:
            scope |= dict(imported(node, self.module.package))
        self.scopes.append(scope)
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
