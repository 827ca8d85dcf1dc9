"""Finished cases on disk: results/raw/<study>/<key>.json, written by the process of the study."""
import errno
import hashlib
import json
import math
import shutil
import sys
import time
import traceback
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from studies.kit.case import Case, Outcome, Report, parameters
from studies.kit.csvfile import commit, cpu, now, versions, write_atomic
from studies.kit.key import ROOT
from studies.kit.table import Rows

RESULTS = ROOT / "results"
SEAL = "sha256"     # of the rows of a kept case and their commit


def results(size: str) -> Path:
    """Where the results of a size go by default; what is tried out, ``quick`` or ``own``, has its folder."""
    return RESULTS / size if size in ("quick", "own") else RESULTS


class CannotRun(Exception):
    """The cases cannot run as they were asked to; what is finished is kept."""


@dataclass(frozen=True)
class Failure:
    """A case that did not finish: what it was, why, the traceback and the file that has it."""

    label: str
    message: str
    story: str = ""
    disk_full: bool = False
    path: Path | None = None

    def __str__(self) -> str:
        line = f"  {self.label}: {self.message}"
        return f"{line}\n    traceback: {self.path}" if self.path else line


def attempt(case: Case, scratch: Path, report: Report) -> str | Failure:
    """Run one case, wherever it is: its outcome as text, or a failure. Its checkpoints lie in ``scratch``."""
    try:
        scratch.mkdir(parents=True, exist_ok=True)
        report(0.0)
        begin = time.process_time()
        outcome = case.run(report, scratch)
        return as_text(case, outcome, time.process_time() - begin)
    except Exception as error:
        return failed(case, error)


def failed(case: Case, error: Exception) -> Failure:
    """The failure of a case that raised this error."""
    disk_full = isinstance(error, OSError) and error.errno == errno.ENOSPC
    story = f"{case!r}\n\n{traceback.format_exc()}"
    return Failure(case.label, f"{type(error).__name__}: {error}", story, disk_full)


def same_code(case: Case) -> bool:
    """Whether this process has the code that the case was made with in another one."""
    return replace(case).key == case.key


def keep(case: Case, result: str | Failure, folder: Path) -> Failure | None:
    """Write the outcome of a case and clear its scratch folder; of a failure write the traceback.

    Raises CannotRun: the disk is full.
    """
    story = folder / f"{case.key}.error.txt"
    if isinstance(result, Failure):
        if result.disk_full:
            raise CannotRun(f"the disk is full: make room where {folder} lies")
        if result.story:
            write_atomic(story, result.story)
        return replace(result, path=story) if result.story else result
    try:
        write_atomic(folder / f"{case.key}.json", result)
    except OSError as error:
        return keep(case, failed(case, error), folder)
    story.unlink(missing_ok=True)
    shutil.rmtree(folder / case.key, ignore_errors=True)    # a case of a cluster has none here
    return None


def as_text(case: Case, outcome: Outcome, cpu_s: float) -> str:
    """An outcome with its commit, versions, machine, date and CPU seconds, compiling among them."""
    content = {"case": parameters(case), "commit": commit(), "versions": versions(),
               "cpu": cpu(), "date": now(), "cpu_s": cpu_s, "rows": outcome.rows}
    plain = json.dumps(content, default=lambda value: value.tolist())       # numpy's numbers as Python's
    content = json.loads(plain)
    return json.dumps({**content, SEAL: seal(content)}, indent=1)


def seal(content: dict[str, Any]) -> str:
    """Hash of what tables get of a kept case: which columns its rows have is known to the case alone."""
    text = json.dumps([content["commit"], content["rows"]], sort_keys=True)
    return hashlib.sha256(text.encode()).hexdigest()


def kept(case: Case, folder: Path) -> Rows | None:
    """Rows of a finished case by table, each with the commit that computed it; None when it must be run."""
    path = folder / f"{case.key}.json"
    if not path.exists():
        return None
    try:
        content = json.loads(path.read_text())
        if content.pop(SEAL, None) not in (None, seal(content)):        # none: kept before there were seals
            raise ValueError("its rows are not as they were written: their hash is another one")
        stamp = {"commit": content["commit"]}
        return {table: [{**row, **stamp} for row in rows] for table, rows in content["rows"].items()}
    except (ValueError, KeyError, TypeError, AttributeError) as error:
        print(f"{path} cannot be read ({error}): {case.label} is run again", file=sys.stderr)
        path.unlink()
        return None


def seconds(case: Case, folder: Path) -> float:
    """CPU seconds that a finished case took; nan if it was finished before they were kept."""
    content = json.loads((folder/f"{case.key}.json").read_text())
    return float(content.get("cpu_s", math.nan))
