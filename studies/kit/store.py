"""Finished cases on disk: results/raw/<study>/<key>.json, written by the process of the study."""
import json
import shutil
import sys
import time
import traceback
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from studies.kit.case import Case, Outcome, Report, parameters
from studies.kit.csvfile import commit, cpu, now, versions, write_atomic
from studies.kit.key import ROOT, digest
from studies.kit.table import Rows

RESULTS = ROOT / "results"


def results(size: str) -> Path:
    """Default folder for the results of a size; ``quick`` and ``own`` have folders of their own."""
    return RESULTS / size if size in ("quick", "own") else RESULTS


class CannotRun(Exception):
    """Cases cannot run as requested; finished cases are kept."""


@dataclass(frozen=True)
class Failure:
    """A case that did not finish: its label, the reason, the traceback and the file of the traceback."""

    label: str
    message: str
    story: str = ""
    path: Path | None = None

    def __str__(self) -> str:
        line = f"  {self.label}: {self.message}"
        return f"{line}\n    traceback: {self.path}" if self.path else line


def attempt(case: Case, scratch: Path, report: Report) -> str | Failure:
    """Run one case: its outcome as text, or a failure. Its checkpoints are in the folder ``scratch``."""
    try:
        scratch.mkdir(parents=True, exist_ok=True)
        report(0.0)
        begin = time.process_time()
        outcome = case.run(report, scratch)
        return as_text(case, outcome, time.process_time() - begin)
    except Exception as error:
        story = f"{case!r}\n\n{traceback.format_exc()}"
        return Failure(case.label, f"{type(error).__name__}: {error}", story)


def same_code(case: Case) -> bool:
    """Whether a case has the same key here as in the process that made it, that is, the same code."""
    return replace(case).key == case.key


def keep(case: Case, result: str | Failure, folder: Path) -> Failure | None:
    """Write the outcome of a case and delete its scratch folder, or write the traceback of a failure."""
    story = folder / f"{case.key}.error.txt"
    if isinstance(result, Failure):
        if not result.story:
            return result
        write_atomic(story, result.story)
        return replace(result, path=story)
    content = json.loads(result)
    sealed = {**content, "seal": seal(case, content)}
    write_atomic(folder / f"{case.key}.json", json.dumps(sealed, indent=1))
    story.unlink(missing_ok=True)
    shutil.rmtree(folder / case.key, ignore_errors=True)    # on a cluster it is elsewhere
    return None


def as_text(case: Case, outcome: Outcome, cpu_s: float) -> str:
    """An outcome as JSON with commit, versions, machine, date and CPU seconds, compile time included."""
    content = {"case": parameters(case), "commit": commit(), "versions": versions(),
               "cpu": cpu(), "date": now(), "cpu_s": cpu_s, "rows": outcome.rows}
    return json.dumps(content, default=lambda value: value.item(), indent=1)        # for numpy's numbers


def seal(case: Case, content: dict[str, Any]) -> str:
    """Hash of all stored content and of the case's key, which reveals a changed file."""
    return digest(case.key, json.dumps(content, sort_keys=True))


def content_of(case: Case, folder: Path) -> dict[str, Any]:
    """Stored content of a finished case. Raises FileNotFoundError; ValueError: it is not as written."""
    content = json.loads((folder/f"{case.key}.json").read_text())
    if not isinstance(content, dict) or content.pop("seal", "") != seal(case, content):
        raise ValueError("it is not as it was written")
    return content


def kept(case: Case, folder: Path) -> Rows | None:
    """Rows of a finished case by table, each with the commit that computed it; None if it must be run."""
    try:
        content = content_of(case, folder)
    except FileNotFoundError:
        return None
    except ValueError as error:
        print(f"{folder/case.key}.json cannot be read ({error}): {case.label} is run again", file=sys.stderr)
        (folder/f"{case.key}.json").unlink(missing_ok=True)
        return None
    return {table: [{**row, "commit": content["commit"]} for row in rows]
            for table, rows in content["rows"].items()}
