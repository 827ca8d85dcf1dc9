"""A study and its command line: python -m studies.NAME [run|figures|claims]."""
import argparse
import errno
import math
import os
import signal
import sys
import textwrap
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from matplotlib.figure import Figure

from studies.kit.case import Case
from studies.kit.claim import Claim, judge, put_claims
from studies.kit.figure import save
from studies.kit.sweep import RESULTS, CasesFailed, Interrupted, check_workers, load, put, sweep
from studies.kit.table import SIZES, Table, Tables, check_size

Rows = Mapping[str, list[dict[str, Any]]]


def nothing(tables: Tables) -> dict[str, Any]:
    """Default of ``derive`` and ``figures``."""
    return {}


@dataclass(frozen=True, kw_only=True)
class Study:
    """One question: its cases by size, the tables these fill, figures and claims that read the tables."""

    name: str
    cases: Callable[[str], Iterable[Case]]
    tables: Sequence[Table]
    #: rows that follow from the tables (extrapolations, means over seeds), merged into them
    derive: Callable[[Tables], Rows] = nothing
    #: file name without .png -> figure
    figures: Callable[[Tables], Mapping[str, Figure]] = nothing
    claims: Sequence[Claim] = ()

    def run(self, size: str, *, workers: int = 2, out: Path = RESULTS) -> Tables:
        """Cases to tables, derived rows among them.

        Raises
        ------
        CasesFailed
            After all that the finished cases give has been derived and written: one that diverges costs its own row.
        """
        failed = None
        try:
            tables = sweep(self.cases(check_size(size)), tables=self.tables, study=self.name, size=size,
                           workers=workers, out=out)
        except CasesFailed as error:
            failed, tables = error, load(self.tables, self.name, out)
        if tables:
            tables = put(dict(self.derive(tables)), self.tables, self.name, size, out)
        if failed:
            raise failed
        return tables

    def draw(self, out: Path = RESULTS) -> list[Path]:
        """Figures from the tables on disk."""
        paths = []
        for name, page in self.figures(load(self.tables, self.name, out)).items():
            paths.append(out / self.name / f"{name}.png")
            save(page, paths[-1])
        return paths

    def judge(self, out: Path = RESULTS) -> list[dict[str, Any]]:
        """Verdicts from the tables on disk, put into claims.csv."""
        rows = judge(self.claims, load(self.tables, self.name, out), self.name)
        if rows:
            put_claims(out / "claims.csv", rows, self.name)
        return rows


def main(study: Study, arguments: Sequence[str] | None = None) -> None:
    """The command line of a study; ends with 0, or 1 (failed), 2 (not understood), 130 (interrupted)."""
    words = parse(study, arguments)
    signal.signal(signal.SIGTERM, signal.default_int_handler)
    try:
        sys.exit(perform(study, words))
    except Interrupted as stop:
        sys.exit(say(f"\n{stop}", 130))
    except KeyboardInterrupt:
        sys.exit(say("\ninterrupted: finished cases are kept, the same command goes on from there", 130))
    except (CasesFailed, FileNotFoundError) as error:
        sys.exit(say(f"{study.name}: {error}", 1))
    except OSError as error:
        if error.errno != errno.ENOSPC:
            raise
        sys.exit(say(f"{study.name}: the disk is full; make room where {words.out} lies; finished cases are "
                     "kept, the same command goes on from there", 1))


def parse(study: Study, arguments: Sequence[str] | None) -> argparse.Namespace:
    """Command, size (default: SIZE of the environment, else paper) and workers."""
    parser = argparse.ArgumentParser(prog=f"python -m studies.{study.name}")
    add, size = parser.add_argument, os.environ.get("SIZE") or "paper"
    add("command", nargs="?", default="run", choices=["run", "figures", "claims"])
    add("--size", default=size, help=f"{', '.join(SIZES)} (default: {size})")
    add("--workers", type=int, default=2, help="processes; 1 computes in this one (default: 2)")
    add("--out", type=Path, default=RESULTS, help="where tables and figures go (default: results)")
    words = parser.parse_args(arguments)
    try:
        check_size(words.size)
        check_workers(words.workers)
    except ValueError as error:
        parser.error(str(error))
    return words


def perform(study: Study, words: argparse.Namespace) -> int:
    """Run what was asked for and say where it is."""
    failed = None
    if words.command == "run":
        try:
            study.run(words.size, workers=words.workers, out=words.out)
        except CasesFailed as error:
            failed = error
    if words.command in ("run", "figures"):
        for path in study.draw(words.out):
            say(f"figure  {shown(path)}")
    if words.command in ("run", "claims"):
        for row in study.judge(words.out):
            print(verdict_line(row))
    for table in study.tables:
        say(f"table   {shown(words.out / study.name / f'{table.name}.csv')}")
    if failed:
        raise failed
    return 0


def verdict_line(row: Mapping[str, Any]) -> str:
    """A claim and its verdict in two lines."""
    printed = f"printed {row['printed']}, " if row["printed"] else ""
    told = math.isfinite(row["measured"])
    found = f"{printed}measured {row['measured']:.5g} +- {row['err']:.2g}" if told else row["reason"]
    indent = " "*13
    return f"{row['verdict']:<12} {row['id']}: {found}\n" + textwrap.fill(
        f"{row['source']}: {row['statement']}", 100, initial_indent=indent, subsequent_indent=indent)


def shown(path: Path) -> Path:
    """A path as short as it gets."""
    return path.relative_to(Path.cwd()) if path.is_relative_to(Path.cwd()) else path


def say(text: str, code: int = 0) -> int:
    """A message for the user."""
    print(text, file=sys.stderr, flush=True)
    return code
