"""Finished cases on disk: results/raw/<study>/<key>.json, written by whoever ran the case."""
import errno
import json
import shutil
import sys
import traceback
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from studies.kit import provenance
from studies.kit.case import Case, Outcome, Report, parameters
from studies.kit.csvfile import write_atomic


@dataclass(frozen=True)
class Failure:
    """A case that did not finish: what it was, why, the file with the whole story."""

    label: str
    message: str
    path: Path | None = None
    disk_full: bool = False

    def __str__(self) -> str:
        return f"  {self.label}: {self.message}" + (f"\n    traceback: {self.path}" if self.path else "")


def run_and_keep(case: Case, folder: Path, report: Report) -> Failure | None:
    """Run one case, keep its outcome, clear its scratch folder; a failure is handed back, not raised."""
    scratch, story = folder / case.key, folder / f"{case.key}.error.txt"
    try:
        scratch.mkdir(parents=True, exist_ok=True)
        keep(case, case.run(report, scratch), folder)
        shutil.rmtree(scratch)
        story.unlink(missing_ok=True)
        return None
    except Exception as error:
        full = isinstance(error, OSError) and error.errno == errno.ENOSPC
        if not full:
            write_atomic(story, f"{case!r}\n\n{traceback.format_exc()}")
        return Failure(case.label, f"{type(error).__name__}: {error}", story, full)


def keep(case: Case, outcome: Outcome, folder: Path) -> None:
    """Write an outcome with the commit it was computed by."""
    content = {"case": parameters(case), "commit": provenance.commit(), "versions": provenance.versions(),
               "date": provenance.now(), "rows": outcome.rows}
    write_atomic(folder / f"{case.key}.json", json.dumps(content, default=plain, indent=1))


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
        return {table: [{**row, "commit": content["commit"]} for row in rows]
                for table, rows in content["rows"].items()}
    except (ValueError, KeyError, TypeError, AttributeError) as error:
        print(f"{path} cannot be read ({error}): {case.label} is run again", file=sys.stderr)
        path.unlink()
        return None
