"""All cases of a study: those already finished are read, the others run, and tables get their rows."""
import shlex
import sys
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any

from studies.kit.case import Case
from studies.kit.cluster import ClusterError, check_scheduler, run_on
from studies.kit.keep import Failure, kept
from studies.kit.key import ROOT
from studies.kit.table import Table, Tables, changed, check_size, merge, read
from studies.kit.times import put_times
from studies.kit.workers import Bar, run_here, run_there

RESULTS = ROOT / "results"
LABELS = 5      # of those that exist, told to who asked for one that does not


class CasesFailed(Exception):
    """Some cases raised; the tables hold what the others found."""


class NoSuchCase(Exception):
    """No case of the study has the text that was asked for in its label."""


class Interrupted(KeyboardInterrupt):
    """The user stopped the study; finished cases are kept."""


def sweep(cases: Iterable[Case], *, tables: Sequence[Table], study: str, size: str, workers: int = 2,
          out: Path = RESULTS, scheduler: str = "", only: str = "") -> Tables:
    """Run the cases that are not finished yet, merge all rows into ``out/study/*.csv`` and read these back.

    ``workers=1`` runs in this process; ``scheduler``, an address, runs on the workers of its Dask cluster instead.
    ``only`` leaves out cases without this text in their label.

    Raises
    ------
    NoSuchCase
        There is none with the text, or no case at all.
    CasesFailed, Interrupted, ClusterError
        When everything that could be saved is saved.
    """
    check_size(size)
    check_workers(workers)
    check_scheduler(scheduler)
    folder = out / "raw" / study
    wanted = list({case.key: case for case in labelled(list(cases), only, size)}.values())
    failures = run(wanted, folder, study, workers, scheduler)
    if any(failure.disk_full for failure in failures):
        raise CasesFailed(f"the disk is full: make room where {folder} lies; {count(wanted, folder)}")
    result = put(collect(wanted, folder), tables, study, size, out, only, scheduler)
    if failures:
        raise CasesFailed(f"{len(failures)} of {len(wanted)} cases failed, the tables hold the others:\n"
                          + "\n".join(map(str, failures)))
    if not only:
        put_times(out, study, size, wanted)
    return result


def labelled(cases: Sequence[Case], only: str, size: str) -> Sequence[Case]:
    """The cases whose label contains a text, in capitals or not."""
    found = [case for case in cases if only.casefold() in case.label.casefold()]
    if only and not found:
        labels = list(dict.fromkeys(case.label for case in cases))
        some = labels[::max(1, len(labels)//LABELS)][:LABELS]
        raise NoSuchCase(f"no case of size {size} has {only!r} in its label; some of its {len(labels)} labels are: "
                         f"{'; '.join(some) or 'none'}")
    return found


def check_workers(workers: int) -> None:
    """Refuse what cannot work."""
    if workers < 1:
        raise ValueError(f"workers must be at least 1, got {workers}: 2 uses two cores")


def run(wanted: Sequence[Case], folder: Path, study: str, workers: int, scheduler: str) -> list[Failure]:
    """Run the cases that are not kept, the longest first; a full disk stops all of them."""
    todo = sorted((case for case in wanted if kept(case, folder) is None), key=lambda case: -case.cost)
    bar, failures = Bar(todo, study), []
    try:
        running = (run_on(scheduler, todo, folder, bar) if scheduler else run_here(todo, folder, bar) if workers == 1
                   else run_there(todo, folder, bar, workers))
        for failure in running:
            failures.append(failure)
            if failure.disk_full:
                break
    except KeyboardInterrupt:
        raise Interrupted(f"interrupted: {count(wanted, folder)}") from None
    except ClusterError as error:
        raise ClusterError(f"{error}; {count(wanted, folder)}") from error
    finally:
        bar.bar.close()
    return failures


def count(cases: Sequence[Case], folder: Path) -> str:
    """What is kept, and how to go on."""
    done = sum(kept(case, folder) is not None for case in cases)
    return f"{done} of {len(cases)} cases are finished and kept, the same command goes on from there"


def collect(cases: Sequence[Case], folder: Path) -> dict[str, list[dict[str, Any]]]:
    """Rows of all finished cases, by table."""
    rows: dict[str, list[dict[str, Any]]] = {}
    for case in cases:
        for name, new in (kept(case, folder) or {}).items():
            rows.setdefault(name, []).extend(new)
    return rows


def put(rows: Mapping[str, list[dict[str, Any]]], tables: Sequence[Table], study: str, size: str,
        out: Path, only: str = "", scheduler: str = "") -> Tables:
    """Merge rows into the tables of a study and read all of these that exist."""
    known = {table.name: table for table in tables}
    if unknown := sorted(set(rows) - set(known)):
        raise ValueError(f"no table {', '.join(unknown)} in study {study}: it has {', '.join(known)}")
    for name, new in rows.items():
        _, better = merge(out / study / f"{name}.csv", known[name], new, size=size,
                          command=command(study, size, only, scheduler))
        if better:
            print(f"{study}/{name}.csv: {better} rows of a better size than {size} stay", file=sys.stderr)
    return load(tables, study, out)


def put_derived(rows: Mapping[str, list[dict[str, Any]]], tables: Sequence[Table], study: str, size: str,
                out: Path, only: str = "") -> Tables:
    """The same for rows that follow from whole tables.

    When ``only`` some cases ran, rows that came out as they were keep size and commit: what they follow from has not run.
    """
    if only:
        known = {table.name: table for table in tables}
        rows = {name: changed(out / study / f"{name}.csv", known[name], new) if name in known else new
                for name, new in rows.items()}
    return put(rows, tables, study, size, out, only)


def command(study: str, size: str, only: str = "", scheduler: str = "") -> str:
    """What makes the tables; of a cluster, whose CPUs the head of a table does not name, that it is one."""
    there = " SCHEDULER=tcp://..." if scheduler else ""
    return (f"python -m studies.{study} --size {size} --only {shlex.quote(only)}" if only
            else f"make study-{study} SIZE={size}") + there


def load(tables: Sequence[Table], study: str, out: Path = RESULTS) -> Tables:
    """The tables of a study that have been written, from CSV."""
    paths = [(table, out / study / f"{table.name}.csv") for table in tables]
    return Tables({table.name: read(path, table.columns) for table, path in paths if path.exists()})
