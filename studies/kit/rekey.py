"""Give finished cases the keys of this code, once: they were found with the code of an older commit.

    python -m studies.kit.rekey [--from COMMIT] [--out results]

A case is the same if its class and its parameters are. What has no case any more stays where it is. May be interrupted
and repeated: every file is renamed in one step.
"""
import argparse
import importlib
import json
import os
import subprocess
import sys
import tarfile
import tempfile
from collections.abc import Iterator
from io import BytesIO
from pathlib import Path
from pkgutil import iter_modules
from typing import Any

from studies.kit.key import PACKAGES, ROOT
from studies.kit.table import SIZES

BEFORE = "c150306"      # the last commit whose keys are hashes of whole modules
#: what old code prints: [study, class and parameters, key] of each case, a line each
ASK = """import json
from studies.kit.rekey import keys
for line in keys():
    print(json.dumps(line))
"""


def keys() -> Iterator[tuple[str, Any, str]]:
    """(study, class and parameters, key) of all cases of all sizes."""
    from studies.kit.case import parameters
    for name in sorted(module.name for module in iter_modules(importlib.import_module("studies").__path__)):
        study = getattr(importlib.import_module(f"studies.{name}"), "STUDY", None)
        for case in [case for size in SIZES for case in study.cases(size)] if study else ():
            yield name, parameters(case), case.key


def old_keys(commit: str) -> list[tuple[str, Any, str]]:
    """The same of the code of a commit.

    Raises
    ------
    subprocess.CalledProcessError
        There is no such commit, or its code does not run.
    """
    with tempfile.TemporaryDirectory() as folder:
        archive = subprocess.run(["git", "archive", commit], cwd=ROOT, check=True, capture_output=True).stdout
        with tarfile.open(fileobj=BytesIO(archive)) as files:
            files.extractall(folder, filter="data")
        mine = Path(__file__).read_text()
        (Path(folder)/"studies/kit/rekey.py").write_text(mine.replace("studies.kit.key ", "studies.kit.source "))
        done = subprocess.run([sys.executable, "-c", ASK], cwd=folder, check=True, stdout=subprocess.PIPE,
                              env=os.environ | {"PYTHONPATH": folder})
    return [tuple(json.loads(line)) for line in done.stdout.splitlines()]


def same(parameters: Any) -> str:
    """Class and parameters as text, without the modules in which functions and classes are defined."""
    def bare(value: Any) -> Any:
        if isinstance(value, dict):
            ours = str(value.get("module", "")).split(".")[0] in PACKAGES
            return {name: bare(item) for name, item in value.items() if not (name == "module" and ours)}
        return [bare(item) for item in value] if isinstance(value, list) else value
    return json.dumps(bare(parameters), sort_keys=True)


def rename(raw: Path, study: str, names: dict[str, Path]) -> str:
    """Rename the finished cases of an old study, by key; a line that counts them."""
    counts = {"renamed": 0, "already there": 0, "unknown": 0}
    there = {raw/name for name in names.values()}
    for path in sorted((raw/study).glob("*.json")):
        new = raw/names.get(path.stem, "")
        known = path.stem in names
        what = "already there" if path in there or (known and new.exists()) else "renamed" if known else "unknown"
        if what == "renamed":
            new.parent.mkdir(parents=True, exist_ok=True)
            os.replace(path, new)
        counts[what] += 1
    return f"{study}: " + ", ".join(f"{number} {what}" for what, number in counts.items())


def new_names(commit: str) -> dict[str, dict[str, Path]]:
    """Of each old study: old key -> file of the same case now, in the study of the same name if that has it."""
    now: dict[str, dict[str, Path]] = {}
    for study, parameters, key in keys():
        now.setdefault(same(parameters), {})[study] = Path(study)/f"{key}.json"
    names: dict[str, dict[str, Path]] = {}
    for study, parameters, old in old_keys(commit):
        if files := now.get(same(parameters)):
            names.setdefault(study, {})[old] = files.get(study, next(iter(files.values())))
    return names


def main() -> None:
    """The command line."""
    parser = argparse.ArgumentParser(prog="python -m studies.kit.rekey", description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--from", dest="commit", default=BEFORE, help=f"whose keys the files have (default: {BEFORE})")
    parser.add_argument("--out", type=Path, default=ROOT/"results", help="where tables lie (default: results)")
    words = parser.parse_args()
    names = new_names(words.commit)
    for raw in filter(Path.is_dir, (words.out/"raw", words.out/"quick/raw")):
        for study in sorted(path.name for path in raw.iterdir() if path.is_dir()):
            print(f"{raw.parent.name}/{rename(raw, study, names.get(study, {}))}")


if __name__ == "__main__":
    main()
