"""Finished cases on disk: results/raw/<study>/<key>.json, written by whoever ran the case; of a cluster, by the study."""
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

from studies.kit import provenance
from studies.kit.case import Case, Outcome, Report, parameters
from studies.kit.csvfile import write_atomic

SEAL = "sha256"     # of the rows of a kept case and their commit


@dataclass(frozen=True)
class Failure:
    """A case that did not finish: what it was, why, the whole story and the file that has it."""

    label: str
    message: str
    path: Path | None = None
    disk_full: bool = False
    story: str = ""

    def __str__(self) -> str:
        return f"  {self.label}: {self.message}" + (f"\n    traceback: {self.path}" if self.path else "")


def run_and_keep(case: Case, folder: Path, report: Report) -> Failure | None:
    """Run one case, keep its outcome, clear its scratch folder; a failure is handed back, not raised."""
    scratch = folder / case.key
    failure = keep(case, attempt(case, scratch, report), folder)
    if failure is None:
        shutil.rmtree(scratch)
    return failure


def attempt(case: Case, scratch: Path, report: Report) -> str | Failure:
    """Run one case: its outcome as text, or a failure."""
    try:
        scratch.mkdir(parents=True, exist_ok=True)
        begin = time.process_time()
        outcome = case.run(report, scratch)
        return as_text(case, outcome, time.process_time() - begin)
    except Exception as error:
        return failed(case, error)


def failed(case: Case, error: Exception) -> Failure:
    """Why it did not finish."""
    return Failure(case.label, f"{type(error).__name__}: {error}", story=f"{case!r}\n\n{traceback.format_exc()}",
                   disk_full=isinstance(error, OSError) and error.errno == errno.ENOSPC)


def keep(case: Case, result: str | Failure, folder: Path) -> Failure | None:
    """Write the outcome of a case, wherever it ran, or the story of its failure, unless the disk is full."""
    story = folder / f"{case.key}.error.txt"
    if isinstance(result, Failure):
        if result.disk_full:
            return result
        write_atomic(story, result.story)
        return replace(result, path=story)
    try:
        write_atomic(folder / f"{case.key}.json", result)
        story.unlink(missing_ok=True)
        return None
    except OSError as error:
        return keep(case, failed(case, error), folder)


def as_text(case: Case, outcome: Outcome, cpu_s: float) -> str:
    """An outcome with the commit it was computed by, where, and in how many CPU seconds, compiling among them."""
    content = {"case": parameters(case), "commit": provenance.commit(), "versions": provenance.versions(),
               "cpu": provenance.cpu(), "date": provenance.now(), "cpu_s": cpu_s, "rows": outcome.rows}
    content = json.loads(json.dumps(content, default=plain))
    return json.dumps({**content, SEAL: seal(content)}, indent=1)


def seal(content: dict[str, Any]) -> str:
    """Hash of what tables get of a kept case: which columns its rows have is known to the case alone."""
    return hashlib.sha256(json.dumps([content["commit"], content["rows"]], sort_keys=True).encode()).hexdigest()


def same_code(case: Case) -> bool:
    """Whether this process has the code that the case was made with in another one."""
    return replace(case).key == case.key


def plain(value: Any) -> Any:
    """numpy's numbers and arrays as Python's."""
    if hasattr(value, "tolist"):
        return value.tolist()
    raise TypeError(f"a row holds {value!r}: rows are made of numbers and texts")


def kept(case: Case, folder: Path) -> dict[str, list[dict[str, Any]]] | None:
    """Rows of a finished case, each with the commit that computed it; None when it must be run."""
    path = folder / f"{case.key}.json"
    if not path.exists():
        return None
    try:
        content = json.loads(path.read_text())
        if content.pop(SEAL, None) not in (None, seal(content)):        # none: kept before there were seals
            raise ValueError("its rows are not as they were written: their hash is another one")
        return {table: [{**row, "commit": content["commit"]} for row in rows]
                for table, rows in content["rows"].items()}
    except (ValueError, KeyError, TypeError, AttributeError) as error:
        print(f"{path} cannot be read ({error}): {case.label} is run again", file=sys.stderr)
        path.unlink()
        return None


def seconds(case: Case, folder: Path) -> float:
    """CPU seconds that a case took; nan if it is not finished, or was before they were kept."""
    path = folder / f"{case.key}.json"
    return float(json.loads(path.read_text()).get("cpu_s", math.nan)) if path.exists() else math.nan
