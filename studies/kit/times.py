"""CPU seconds of whole studies, measured as they run: times.csv beside claims.csv."""
import math
from collections.abc import Sequence
from pathlib import Path

import pandas as pd

from studies.kit import provenance
from studies.kit.case import Case
from studies.kit.csvfile import read, write
from studies.kit.keep import seconds

#: estimate_s: the cases' own, which need not be right; cpu_s: of all threads, compiling with it
COLUMNS = ("study", "size", "cases", "estimate_s", "cpu_s", "commit")


def put_times(out: Path, study: str, size: str, cases: Sequence[Case]) -> None:
    """Replace the row of a study and size, if each of its cases is finished and was measured."""
    took = [seconds(case, out / "raw" / study) for case in cases]
    if not took or any(map(math.isnan, took)):
        return
    values = (study, size, len(cases), sum(case.cost for case in cases), sum(took), provenance.commit())
    old = times(out)
    others = old[(old["study"] != study) | (old["size"] != size)]
    new = pd.DataFrame([values], columns=list(COLUMNS))
    frame = pd.concat([others, new]) if len(others) else new
    write(out / "times.csv", frame.sort_values(["study", "size"]), head=[provenance.versions(), provenance.cpu()])


def times(out: Path) -> pd.DataFrame:
    """What was measured; no rows where nothing was."""
    path = out / "times.csv"
    return read(path, COLUMNS) if path.exists() else pd.DataFrame(columns=list(COLUMNS))
