"""Imports point down, without circle: a study imports build, kit, particles, continuum, no study."""
import ast
from functools import cache
from graphlib import TopologicalSorter

import pytest

from studies.kit.key import CODE, PACKAGES

#: rooms at the bottom -> all that they import besides: what a fluid is, and how code is compiled
BOTTOM = {"continuum": (), "particles": ("continuum", "continuum.fluid", "continuum.jit"),
          "studies.kit": ("continuum", "continuum.jit")}
#: rooms of studies that are no study: what every study uses, one call for all methods, and the page
BELOW, PAGE = ("studies.kit", "studies.build", "studies.front", "studies.judge"), "studies.report"


@cache
def imports(module: str) -> frozenset[str]:
    """Modules of the project that a module imports, within functions and for types, too."""
    found = set()
    for node in ast.walk(ast.parse(CODE.files[module].read_text())):
        if isinstance(node, ast.Import):
            found |= {alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom):
            assert not node.level, f"{module} imports relative to itself: name the package"
            found |= {f"{node.module}.{alias.name}" for alias in node.names}
    known = set(map(longest_known, found)) - {""}
    packages = {each for name in known for each in with_packages(name)}
    return frozenset(each for each in packages if not f"{module}.".startswith(f"{each}."))


def with_packages(module: str) -> list[str]:
    """A module and the packages above it, which Python imports first."""
    parts = module.split(".")
    return [".".join(parts[:n]) for n in range(1, len(parts) + 1)]


def longest_known(name: str) -> str:
    """The module that a dotted name is in or is; empty for one of no package here."""
    while name and name not in CODE.files:
        name = name.rpartition(".")[0]
    return name


def room(module: str) -> str:
    """Of studies, the folder: that of a study, kit, build; else the package."""
    parts = module.split(".")
    return ".".join(parts[:2]) if parts[0] == "studies" else parts[0]


def allowed(module: str, other: str) -> bool:
    own, its = room(module), room(other)
    if its in (own, "studies") or own == PAGE:
        return True
    if own in BOTTOM:
        return other in BOTTOM[own]
    rooms = BELOW[:1] if own == "studies.build" else BELOW
    return its in ("continuum", "particles", *rooms)


@pytest.mark.parametrize("package", PACKAGES)
def test_imports_point_down(package):
    wrong = [f"{module} -> {other}" for module in sorted(CODE.files) if module.split(".")[0] == package
             for other in sorted(imports(module)) if not allowed(module, other)]
    assert not wrong, "\n".join(wrong)


def test_imports_have_no_circle():
    graph = {module: imports(module) for module in CODE.files}
    TopologicalSorter(graph).prepare()      # CycleError names one
