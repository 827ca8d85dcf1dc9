"""Sweep over the cases of a study: finished ones are read, others run, and rows are merged into tables."""
import shlex
import sys
from collections.abc import Sequence
from dataclasses import dataclass
from difflib import get_close_matches
from pathlib import Path

from studies.kit.case import Case
from studies.kit.cluster import Cluster, check_scheduler
from studies.kit.dispatch import Bar, Here, Processes, Transport, dispatch
from studies.kit.store import RESULTS, CannotRun, Failure, kept
from studies.kit.table import SIZES, Row, Rows, Table, Tables, changed, merge, read

LABELS = 3      # number of labels in the message on a label that does not exist
GO_ON = "the same command goes on from there"


class CasesFailed(Exception):
    """Some cases failed; the tables hold the rows of the others."""


class NoSuchCase(Exception):
    """No case of the study has the requested text in its label."""


@dataclass(frozen=True, kw_only=True)
class Sweep:
    """Where the cases of a study run, which of them, and where their rows go.

    workers : number of processes; 1 is this one. scheduler : address of a Dask cluster to use instead.
    only : run only the cases with this text in their label, or those of the methods that it names.
    """

    study: str
    tables: Sequence[Table]
    size: str
    out: Path = RESULTS
    workers: int = 2
    scheduler: str = ""
    only: str = ""

    def __post_init__(self):
        if self.size not in SIZES:
            raise ValueError(f"unknown size {self.size!r}: choose one of {', '.join(SIZES)}")
        if self.workers < 1:
            raise ValueError(f"workers must be at least 1, got {self.workers}: 2 uses two cores")
        check_scheduler(self.scheduler)

    @property
    def folder(self) -> Path:
        """Folder of finished cases."""
        return self.out/"raw"/self.study

    def run(self, wanted: Sequence[Case]) -> list[Failure]:
        """Run the cases that are not stored, the longest first; return the failures.

        Raises KeyboardInterrupt, CannotRun: finished cases are kept.
        """
        missing = [case for case in wanted if kept(case, self.folder) is None]
        missing.sort(key=lambda case: -case.cost)
        try:
            return dispatch(missing, self.folder, self.study, self.transport)
        except KeyboardInterrupt:
            raise KeyboardInterrupt(f"interrupted: {self.count(wanted)}") from None
        except CannotRun as error:
            raise CannotRun(f"{error}; {self.count(wanted)}") from error

    def transport(self, bar: Bar) -> Transport:
        """Transport of the cases: to a cluster, to this process, or to workers."""
        if self.scheduler:
            return Cluster(self.scheduler, bar)
        if self.workers == 1:
            return Here(self.folder, bar)
        return Processes(self.workers, self.folder, bar)

    def count(self, cases: Sequence[Case]) -> str:
        """Message on how many cases are stored, and how to go on."""
        done = sum(kept(case, self.folder) is not None for case in cases)
        return f"{done} of {len(cases)} cases are finished and kept, {GO_ON}"

    def rows(self, cases: Sequence[Case]) -> Rows:
        """Rows of those cases that are finished, by table."""
        rows: dict[str, list[Row]] = {}
        for case in cases:
            for name, new in (kept(case, self.folder) or {}).items():
                rows.setdefault(name, []).extend(new)
        return rows

    def put(self, rows: Rows, derived: bool = False) -> Tables:
        """Merge rows into the tables; return all tables that exist.

        When ``only`` some cases ran, derived rows that did not change keep their size and commit, as the
        cases that they derive from have not run.
        """
        tables = {table.name: table for table in self.tables}
        if unknown := sorted(rows.keys() - tables):
            raise ValueError(f"study {self.study} has no table {', '.join(unknown)}: list it in its tables")
        for name, new in rows.items():
            table = tables[name]
            path = self.out/self.study/table.file
            if derived and self.only:
                new = changed(path, table, new)
            _, better = merge(path, table, new, size=self.size, command=self.command)
            if better:
                print(f"{self.study}/{path.name}: {better} rows of a better size than {self.size} stay",
                      file=sys.stderr)
        return load(self.tables, self.study, self.out)

    @property
    def command(self) -> str:
        """Command that makes the tables; names a cluster, as the head of a table does not have its CPUs."""
        there = " SCHEDULER=tcp://..."*bool(self.scheduler)
        if self.only:
            return f"python -m studies {self.study} --size {self.size} --only {shlex.quote(self.only)}{there}"
        return f"make study-{self.study} SIZE={self.size}{there}"


def labelled(cases: Sequence[Case], only: str, size: str) -> Sequence[Case]:
    """Cases whose label contains a text, in any case. Raises NoSuchCase: there is none."""
    chosen = [case for case in cases if only.casefold() in case.label.casefold()]
    if only and not chosen:
        labels = "; ".join(case.label for case in cases[:LABELS])
        words = {word.casefold(): word for case in cases for word in case.label.split()}
        alike = ", ".join(words[word] for word in get_close_matches(only.casefold(), words, LABELS))
        near = f"; near to it are {alike}"*bool(alike) + "; SIZE=fine has more"*(size != "fine")
        raise NoSuchCase(f"no case of size {size} has {only!r} in its label{near}; the first labels are: "
                         f"{labels}")
    return chosen


def load(tables: Sequence[Table], study: str, out: Path = RESULTS) -> Tables:
    """Tables of a study that exist, read from CSV."""
    frames = Tables()
    for table in tables:
        path = out/study/table.file
        if path.exists():
            frames[table.name] = read(path, table.columns)
    return frames
