"""Seconds anew, at the steps that are known and with the errors as they are; joins the tables of the study `speed`.

    python -m studies.cost.again [--only TEXT] [--out FOLDER]

On another machine, or once something is faster: to find the step of each method takes longer than to time it. A case whose step
the table `steps` does not have is run whole. Rows are written as they come.
"""
import argparse
from collections.abc import Iterable
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path
from tempfile import TemporaryDirectory
from time import perf_counter
from typing import Any

import pandas as pd

from studies.cost import tables as speed_tables
from studies.cost.others import Direct
from studies.cost.problem import Race
from studies.kit.case import Case
from studies.kit.processes import SPAWN, one_thread
from studies.kit.study import Rows, Study, say, verdict_line
from studies.kit.sweep import RESULTS, labelled, load
from studies.kit.table import changed, merge

#: tables of seconds; errors and steps stay
TIMES = ("runs", "repeats", "growth", "starts")


def fraction_of(case: Race, steps: pd.DataFrame) -> float | None:
    """Of the stability limit: the longest step of a case that is good enough, else its shortest; none where it has not run."""
    mine = pd.Series(True, index=steps.index)
    for name, value in case.key_columns.items():
        mine &= steps[name] == value
    tried, good = steps.loc[mine, "of_limit"], steps.loc[mine & (steps["accepted"] == 1), "of_limit"]
    return float(good.max() if len(good) else tried.min()) if mine.any() else None


def again(case: Case, steps: pd.DataFrame) -> dict[str, list[dict[str, Any]]]:
    """Rows of the tables of seconds; where the step is not known, of all; none where a known step diverges."""
    fraction = fraction_of(case, steps) if isinstance(case, Race) else None
    if isinstance(case, Race) and fraction is not None:
        return case.again(fraction)
    with TemporaryDirectory() as folder:
        rows = case.run(lambda done: None, Path(folder)).rows
    return {name: rows[name] for name in TIMES if name in rows} if isinstance(case, Direct) else rows


def put(rows: Rows, out: Path, size: str, command: str) -> None:
    """Into the tables on disk."""
    for table in speed_tables.ALL:
        if rows.get(table.name):
            merge(out/"speed"/f"{table.name}.csv", table, rows[table.name], size=size, command=command)


def renew(study: Study, cases: Iterable[Case], out: Path, size: str, command: str) -> None:
    """Time the cases, one after the other, and derive what follows."""
    known = load(speed_tables.ALL, study.name, out)
    steps = known["steps"] if "steps" in known else pd.DataFrame(columns=list(speed_tables.STEPS.columns))
    # as the study does: in a process that loads its libraries with one thread
    with one_thread(), ProcessPoolExecutor(1, SPAWN) as alone:
        for case in cases:
            began = perf_counter()
            rows = alone.submit(again, case, steps).result()
            put(rows, out, size, command)
            say(f"{perf_counter() - began:7.1f} s  {case.label}{'' if rows else ': diverged'}")
    derived = study.derive(load(speed_tables.ALL, study.name, out))
    tables = {table.name: table for table in speed_tables.ALL}
    put({name: changed(out/study.name/f"{name}.csv", tables[name], new) for name, new in derived.items()}, out, size, command)


def main() -> None:
    """All cases of size `paper` with a text in their label, figures, verdicts."""
    from studies.cost import STUDY
    parser = argparse.ArgumentParser(prog="python -m studies.cost.again", description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--only", default="", metavar="TEXT", help="only cases with this text in their label")
    parser.add_argument("--out", type=Path, default=RESULTS, help="where the tables are (default: results)")
    words = parser.parse_args()
    chosen = labelled(list(STUDY.cases("paper")), words.only, "paper")
    renew(STUDY, chosen, words.out, "paper", f"{parser.prog} --only {words.only!r}" if words.only else parser.prog)
    STUDY.draw(words.out)
    for row in STUDY.judge(words.out):
        print(verdict_line(row))


if __name__ == "__main__":
    main()
