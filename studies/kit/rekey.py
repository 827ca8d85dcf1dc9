"""Give finished cases the keys of this code, once: they were found with the code of an older commit.

    python -m studies.kit.rekey [COMMIT]

A case is the same if its study, its class and its parameters are; what was renamed is in RENAMED. What has no
case any more stays where it is. May be interrupted and repeated: every file is renamed in one step.
"""
import json
import os
import subprocess
import sys
import tarfile
import tempfile
from collections.abc import Sequence
from io import BytesIO
from pathlib import Path
from typing import Any

from studies.kit.key import ROOT
from studies.kit.store import RESULTS

BEFORE = "27f2076"      # the last commit before registries became parameters
#: class or function of older commits -> what it is called now
RENAMED: dict[str, str] = {"Motion": "FacesMotion", "Form": "GridForm", "Variant": "Obstacle"}
#: study, class and parameters, key
Keyed = tuple[str, Any, str]
#: study, class and parameters as text -> key
Keys = dict[tuple[str, str], str]
#: prints `Keyed` of all cases of all sizes, a line each, by the code in the folder where it runs
PRINT_KEYS = """
import importlib, json, pkgutil, studies
from studies.kit.case import parameters
for module in pkgutil.iter_modules(studies.__path__):
    study = getattr(importlib.import_module(f"studies.{module.name}"), "STUDY", None)
    for size in ("quick", "paper", "fine") if study else ():
        for case in study.cases(size):
            print(json.dumps([module.name, parameters(case), case.key]))
"""


def keys_of(folder: Path) -> list[Keyed]:
    """All cases of the code in a folder. Raises subprocess.CalledProcessError: it does not run."""
    environment = os.environ | {"PYTHONPATH": str(folder)}
    done = subprocess.run([sys.executable, "-c", PRINT_KEYS], cwd=folder, env=environment, check=True,
                          stdout=subprocess.PIPE)
    return [tuple(json.loads(line)) for line in done.stdout.splitlines()]


def old_keys(commit: str) -> list[Keyed]:
    """All cases of the code of a commit. Raises subprocess.CalledProcessError: there is none, or as above."""
    command = ["git", "archive", commit]
    archive = subprocess.run(command, cwd=ROOT, check=True, stdout=subprocess.PIPE).stdout
    with tempfile.TemporaryDirectory() as folder:
        with tarfile.open(fileobj=BytesIO(archive)) as files:
            files.extractall(folder, filter="data")
        return keys_of(Path(folder))


def same(parameters: Any, plainly: bool = False) -> str:
    """Class and parameters as text, in the names of today.

    plainly : what is a parameter and has a name, a record or a function, stands as this name alone.
    """
    fields = {name: today(value, plainly) for name, value in parameters.items()}
    return json.dumps(fields, sort_keys=True)


def today(value: Any, plainly: bool) -> Any:
    """One parameter."""
    if isinstance(value, list):
        return [today(item, plainly) for item in value]
    if isinstance(value, str):
        return RENAMED.get(value, value)
    if not isinstance(value, dict):
        return value
    fields = {name: today(item, plainly) for name, item in value.items()}
    has_name = isinstance(fields.get("name"), str) or [*fields] == [""]
    return fields.get("name", fields[""]) if plainly and has_name else fields


def by_text(cases: Sequence[Keyed], plainly: bool) -> Keys:
    """The keys of cases, without texts that stand for several."""
    keys: dict[tuple[str, str], set[str]] = {}
    for study, parameters, key in cases:
        text = same(parameters, plainly)
        keys.setdefault((study, text), set()).add(key)
    return {place: some.pop() for place, some in keys.items() if len(some) == 1}


def new_names(old: Sequence[Keyed], new: Sequence[Keyed]) -> dict[str, str]:
    """Old key -> new key of the same case."""
    names = {}
    for plainly in (True, False):       # what is the same in every parameter comes last, and counts
        now = by_text(new, plainly)
        for place, key in by_text(old, plainly).items():
            if place in now:
                names[key] = now[place]
    return names


def rename(folder: Path, names: dict[str, str]) -> str:
    """Rename the finished cases in a folder; a line that counts them."""
    renamed = 0
    for path in sorted(folder.glob("*.json")):
        new = path.with_stem(names.get(path.stem, path.stem))
        if not new.exists():
            os.replace(path, new)
            renamed += 1
    return f"{folder}: {renamed} cases renamed"


def main(commit: str = BEFORE) -> None:
    """The command line: cases that were finished with the code of a commit."""
    names = new_names(old_keys(commit), keys_of(ROOT))
    for raw in (RESULTS/"raw", RESULTS/"quick/raw"):
        for folder in sorted(raw.glob("*")):
            print(rename(folder, names))


if __name__ == "__main__":
    main(*sys.argv[1:])
