"""The code that a result depends on, found without running it, and its hash.

Docstrings, comments and layout do not count: they cannot change a result, and rewording one shall not
cost half an hour of computing.
"""
import ast
import hashlib
from collections.abc import Iterable, Iterator
from functools import cache
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
PACKAGES = ("continuum", "particles", "studies")
#: what only carries results about; a change there makes no result wrong
CARRIERS = "studies.kit"


def closure(modules: Iterable[str], root: Path = ROOT) -> dict[str, Path]:
    """Modules of our own packages that ``modules`` import, directly or through others: name -> file.

    Raises
    ------
    ValueError
        One of ``modules`` is not a module of ours.
    """
    found: dict[str, Path] = {}
    todo = list(modules)
    for name in todo:
        if find(name, root) is None:
            raise ValueError(f"{name} is not a module of {', '.join(PACKAGES)}: code= lists modules such as "
                             "'particles.run' whose change makes the result another one")
    while todo:
        name = todo.pop()
        path = find(name, root)
        if path and name not in found:
            found[name] = path
            todo += imports(parse(path), name, is_package=path.name == "__init__.py")
    return found


@cache
def code_hash(modules: frozenset[str], root: Path = ROOT) -> str:
    """Hash of ``modules`` and of all that they import from our own packages."""
    found = sorted(closure(modules, root).items())
    return digest(*(piece for name, path in found for piece in (name, parse(path))))


def find(name: str, root: Path = ROOT) -> Path | None:
    """File of a module of our own packages; None for other names and for studies.kit."""
    if name.split(".")[0] not in PACKAGES or f"{name}.".startswith(f"{CARRIERS}."):
        return None
    base = root.joinpath(*name.split("."))
    return next((path for path in (base.with_suffix(".py"), base / "__init__.py") if path.is_file()), None)


def imports(tree: ast.AST, module: str, is_package: bool = False) -> Iterator[str]:
    """Every name that import statements in ``tree`` may load, parent packages among them."""
    here = module.split(".") if is_package else module.split(".")[:-1]
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            names = [alias.name for alias in node.names]
        elif isinstance(node, ast.ImportFrom):
            above = here[:len(here) - node.level + 1] if node.level else []
            source = ".".join([*above, *([node.module] if node.module else [])])
            names = [f"{source}.{alias.name}" for alias in node.names]
        else:
            continue
        for parts in (name.split(".") for name in names):
            yield from (".".join(parts[:n]) for n in range(1, len(parts) + 1))


def part(path: Path, names: Iterable[str]) -> list[ast.stmt]:
    """The top-level statements of a file that define ``names`` and all that these use from the same file."""
    body = parse(path).body
    found: list[ast.stmt] = []
    todo = set(names)
    while todo:
        new = [node for node in body if node not in found and todo & set(defines(node))]
        found += new
        todo = {name.id for node in new for name in ast.walk(node) if isinstance(name, ast.Name)}
    return sorted(found, key=body.index)


def defines(node: ast.stmt) -> Iterator[str]:
    """Names that a top-level statement binds."""
    if isinstance(node, ast.FunctionDef | ast.ClassDef):
        yield node.name
    elif isinstance(node, ast.Import | ast.ImportFrom):
        yield from ((alias.asname or alias.name).split(".")[0] for alias in node.names)
    else:
        yield from (name.id for name in ast.walk(node)
                    if isinstance(name, ast.Name) and isinstance(name.ctx, ast.Store))


@cache
def parse(path: Path) -> ast.Module:
    """Syntax tree of a file without its docstrings."""
    tree = ast.parse(path.read_text(), filename=str(path))
    for node in ast.walk(tree):
        if isinstance(node, ast.Module | ast.ClassDef | ast.FunctionDef) and ast.get_docstring(node):
            node.body = node.body[1:] or [ast.Pass()]
    return tree


def digest(*pieces: str | ast.AST) -> str:
    """One hash over texts and syntax trees."""
    total = hashlib.sha256()
    for piece in pieces:
        total.update((ast.dump(piece) if isinstance(piece, ast.AST) else piece).encode() + b"\0")
    return total.hexdigest()
