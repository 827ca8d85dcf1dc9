"""Give finished cases the keys of this code, once: they were found with the code of an older commit.

    python -m studies.kit.rekey [--from COMMIT] [--out results]

A case is the same if its class and its parameters are; what was renamed is in RENAMED. What has no case any
more stays where it is. May be interrupted and repeated: every file is renamed in one step.
"""
import argparse
import importlib
import json
import os
import subprocess
import sys
import tarfile
import tempfile
from collections.abc import Iterable, Iterator
from io import BytesIO
from pathlib import Path
from pkgutil import iter_modules
from typing import Any

from studies.kit.key import PACKAGES, ROOT
from studies.kit.table import SIZES

BEFORE = "27f2076"      # the last commit before registries became parameters
#: class or function of older commits -> what it is called now
RENAMED: dict[str, str] = {"Motion": "FacesMotion", "Form": "GridForm", "Variant": "Obstacle"}
#: what old code prints: [study, class and parameters, key] of each case, a line each
ASK = """import json
from studies.kit.rekey import keys
for line in keys():
    print(json.dumps(line))
"""


def keys() -> Iterator[tuple[str, Any, str]]:
    """(study, class and parameters, key) of all cases of all sizes."""
    from studies.kit.case import parameters
    folder = importlib.import_module("studies").__path__
    for name in sorted(module.name for module in iter_modules(folder)):
        study: Any = getattr(importlib.import_module(f"studies.{name}"), "STUDY", None)
        for size in SIZES if study else ():
            for case in study.cases(size):
                yield name, parameters(case), case.key


def old_keys(commit: str) -> list[tuple[str, Any, str]]:
    """The same of the code of a commit.

    Raises subprocess.CalledProcessError: There is no such commit, or its code does not run.
    """
    with tempfile.TemporaryDirectory() as folder:
        archive = subprocess.run(["git", "archive", commit], cwd=ROOT, check=True, capture_output=True).stdout
        with tarfile.open(fileobj=BytesIO(archive)) as files:
            files.extractall(folder, filter="data")
        kit = Path(folder)/"studies/kit"
        former = "source" if (kit/"source.py").exists() else "key"
        mine = Path(__file__).read_text().replace("studies.kit.key ", f"studies.kit.{former} ")
        (kit/"rekey.py").write_text(mine)
        done = subprocess.run([sys.executable, "-c", ASK], cwd=folder, check=True, stdout=subprocess.PIPE,
                              env=os.environ | {"PYTHONPATH": folder})
    return [tuple(json.loads(line)) for line in done.stdout.splitlines()]


def same(parameters: Any, plainly: bool = False) -> str:
    """Class and parameters as text, in the names of today, without the modules of ours.

    plainly : what is a parameter and has a name, a record or a function, stands as this name alone.
    """
    fields = {name: bare(value, plainly) for name, value in parameters.items()}
    return json.dumps(fields, sort_keys=True)


def bare(value: Any, plainly: bool) -> Any:
    """One parameter."""
    if isinstance(value, list):
        return [bare(item, plainly) for item in value]
    if isinstance(value, str):
        return RENAMED.get(value, value)
    if not isinstance(value, dict):
        return value
    ours = str(value.get("module", "")).split(".")[0] in PACKAGES
    fields = {name: bare(item, plainly) for name, item in value.items() if not (name == "module" and ours)}
    if plainly and (isinstance(fields.get("name"), str) or [*fields] == [""]):
        return fields.get("name", fields[""])
    return fields


def rename(raw: Path, study: str, names: dict[str, Path]) -> str:
    """Rename the finished cases of an old study, by key; a line that counts them."""
    counts = {"renamed": 0, "already there": 0, "unknown": 0}
    there = {raw/name for name in names.values()}
    for path in sorted((raw/study).glob("*.json")):
        name = names.get(path.stem)
        if path in there or (name and (raw/name).exists()):
            counts["already there"] += 1
        elif name:
            (raw/name).parent.mkdir(parents=True, exist_ok=True)
            os.replace(path, raw/name)
            counts["renamed"] += 1
        else:
            counts["unknown"] += 1
    return f"{study}: " + ", ".join(f"{number} {what}" for what, number in counts.items())


def new_names(commit: str) -> dict[str, dict[str, Path]]:
    """Of each old study: old key -> file of the same case now, in that study if it has it."""
    new, old = list(keys()), old_keys(commit)
    names: dict[str, dict[str, Path]] = {}
    for plainly in (True, False):       # what is the same in every parameter comes last, and counts
        files: dict[str, dict[str, Path]] = {}
        for (text, study), key in by_text(new, plainly).items():
            files.setdefault(text, {})[study] = Path(study)/f"{key}.json"
        for (text, study), key in by_text(old, plainly).items():
            if text in files:
                first = next(iter(files[text].values()))
                names.setdefault(study, {})[key] = files[text].get(study, first)
    return names


def by_text(cases: Iterable[tuple[str, Any, str]], plainly: bool) -> dict[tuple[str, str], str]:
    """(text, study) -> key, without texts that stand for several cases."""
    found: dict[tuple[str, str], set[str]] = {}
    for study, parameters, key in cases:
        found.setdefault((same(parameters, plainly), study), set()).add(key)
    return {place: keys.pop() for place, keys in found.items() if len(keys) == 1}


def main() -> None:
    """The command line."""
    about = (__doc__ or "").splitlines()[0]
    parser = argparse.ArgumentParser(prog="python -m studies.kit.rekey", description=about)
    add = parser.add_argument
    add("--from", dest="commit", default=BEFORE, help=f"whose keys they have (default: {BEFORE})")
    add("--out", type=Path, default=ROOT/"results", help="where tables lie (default: results)")
    words = parser.parse_args()
    names = new_names(words.commit)
    for raw in filter(Path.is_dir, (words.out/"raw", words.out/"quick/raw")):
        for study in sorted(path.name for path in raw.iterdir() if path.is_dir()):
            print(f"{raw.parent.name}/{rename(raw, study, names.get(study, {}))}")


if __name__ == "__main__":
    main()
