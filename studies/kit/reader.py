"""Reader of definitions: their syntax, independent of layout and imports, and the places that they use."""
import ast
from collections import ChainMap
from collections.abc import Iterator
from contextlib import contextmanager
from copy import deepcopy
from typing import Any

from studies.kit.syntax import UNNAMED, Dotted, Module, Place, Reading, chain, imported, parameters_of, stores


class Reader(ast.NodeTransformer):
    """Rewrites statements so that a name reads the same wherever it is defined; notes the places used."""

    def __init__(self, code: Any, module: Module):
        self.code, self.module = code, module
        self.uses: dict[Place, None] = {}
        self.meanings: ChainMap[str, Dotted] = ChainMap(module.meanings)    # () for variables
        self.fields = False     # True in the body of a class, where annotations make fields

    def read(self, *nodes: ast.AST) -> Reading:
        """Syntax of statements, independent of their order, and the places that they use."""
        texts = sorted(ast.dump(self.visit(deepcopy(node))) for node in nodes)
        return Reading("\n".join(texts), tuple(self.uses))

    def visit_Name(self, node: Any) -> ast.AST:
        whole = chain(node) and isinstance(node.ctx, ast.Load)
        return self.renamed(node) if whole else self.generic_visit(node)

    visit_Attribute = visit_Name

    def renamed(self, node: ast.expr) -> ast.expr:
        """A dotted name in which the definition's own name replaces the part that leads to it."""
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

    def meaning(self, parts: Dotted) -> Dotted:
        """Full dotted name, () for variables and for names of Python itself."""
        if not parts:
            return ()
        first, *rest = parts
        origin = self.meanings.get(first, ())
        return (*origin, *rest) if origin else ()

    def visit_Subscript(self, node: ast.Subscript) -> ast.AST:
        """Note that ``TABLE["name"]`` uses only this entry of the table."""
        table, rest = self.code.locate(self.meaning(chain(node.value)))
        key, is_read = node.slice, isinstance(node.ctx, ast.Load)
        if not table or rest or not is_read or not isinstance(key, ast.Constant):
            return self.generic_visit(node)
        self.uses[self.code.entry(table, key.value)] = None
        return ast.Subscript(ast.Name(table.name, ast.Load()), key, node.ctx)

    # --- scopes ------------------------------------------------------------------------------------

    @contextmanager
    def inside(self, meanings: dict[str, Dotted], fields: bool = False) -> Iterator[None]:
        """Read with the names of an inner scope."""
        before = self.meanings, self.fields
        self.meanings, self.fields = self.meanings.new_child(meanings), fields
        yield
        self.meanings, self.fields = before

    def visit_FunctionDef(self, node: ast.FunctionDef) -> ast.AST:
        node.decorator_list = list(map(self.visit, node.decorator_list))
        node.returns = None
        self.visit_signature(node.args, types=node.name == UNNAMED)
        node.body = self.inner(undocumented(node.body), node.args)
        return node

    def visit_ClassDef(self, node: ast.ClassDef) -> ast.AST:
        node.body = undocumented(node.body)
        with self.inside({}, fields=True):
            return self.generic_visit(node)

    def visit_Lambda(self, node: ast.Lambda) -> ast.AST:
        self.visit_signature(node.args)
        node.body, = self.inner([node.body], node.args)
        return node

    def visit_signature(self, arguments: ast.arguments, types: bool = False) -> None:
        """Read defaults in the outer scope; drop annotations, unless as ``types`` they pick a formula."""
        arguments.defaults = list(map(self.visit, arguments.defaults))
        arguments.kw_defaults = [value and self.visit(value) for value in arguments.kw_defaults]
        for one in parameters_of(arguments):
            one.annotation = self.visit(one.annotation) if types and one.annotation else None

    def inner(self, body: list[Any], arguments: ast.arguments) -> list[Any]:
        """Body of a function, read with its parameters, variables and imports."""
        parameters = [one.arg for one in parameters_of(arguments)]
        variables = [name for node in body for name in stores(node)]
        imports = [pair for node in body for pair in imported(node, self.module.name)]
        with self.inside(dict.fromkeys([*parameters, *variables], ()) | dict(imports)):
            nodes = list(map(self.visit, body))
        return list(filter(None, nodes))

    def visit_comprehension_of(self, node: Any) -> ast.AST:
        first, *others = node.generators
        first.iter = self.visit(first.iter)
        variables = [name for one in node.generators for name in stores(one.target)]
        with self.inside(dict.fromkeys(variables, ())):
            first.target = self.visit(first.target)
            first.ifs = list(map(self.visit, first.ifs))
            node.generators = [first, *map(self.visit, others)]
            for field in ("elt", "key", "value"):
                if hasattr(node, field):
                    setattr(node, field, self.visit(getattr(node, field)))
        return node

    visit_ListComp = visit_SetComp = visit_DictComp = visit_GeneratorExp = visit_comprehension_of

    # --- syntax that is left out -------------------------------------------------------------------

    def visit_Import(self, node: Any) -> None:
        """Drop imports: an imported name counts where it is used."""

    visit_ImportFrom = visit_Import

    def visit_AnnAssign(self, node: ast.AnnAssign) -> ast.AST | None:
        """Keep an annotation that makes a class field, but not as a use of names in it; drop others."""
        value = node.value and self.visit(node.value)
        if not self.fields:
            return ast.Assign([self.visit(node.target)], value) if value else None
        uses = dict(self.uses)
        node.annotation, node.value = self.visit(node.annotation), value
        self.uses = uses
        return node


def undocumented(body: list[ast.stmt]) -> list[ast.stmt]:
    """Body of a definition without its docstring."""
    first = body[0]
    documents = isinstance(first, ast.Expr) and isinstance(first.value, ast.Constant)
    rest = body[1:] if documents else body
    return rest or [ast.Pass()]
