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
from studies.kit.cluster import ClusterError, check_scheduler
from studies.kit.csvfile import OtherTable
from studies.kit.figure import save
from studies.kit.sweep import RESULTS, CasesFailed, Interrupted, NoSuchCase, check_workers, command, load, put_derived, sweep
from studies.kit.table import SIZES, Table, Tables, check_size

Rows = Mapping[str, list[dict[str, Any]]]
#: number of the system's error -> what to do about it
DISK = {errno.ENOSPC: "the disk is full; make room where {out} lies; finished cases are kept, the same command goes on from "
                      "there",
        **dict.fromkeys((errno.EACCES, errno.EPERM, errno.EROFS), "{file} cannot be written: give --out another folder")}


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

    def run(self, size: str, *, workers: int = 2, out: Path | None = None, only: str = "", scheduler: str = "") -> Tables:
        """Cases to tables, derived rows among them; ``only`` those with this text in their label.

        ``scheduler`` is the address of a Dask cluster on which cases run, instead of ``workers`` processes here.

        Raises
        ------
        NoSuchCase
            No label contains ``only``.
        CasesFailed
            After all that the finished cases give has been derived and written: one that diverges costs its own row.
        ClusterError
            The cluster cannot run the cases; the tables are as they were.
        """
        failed, out = None, out or results(size)
        try:
            tables = sweep(self.cases(check_size(size)), tables=self.tables, study=self.name, size=size,
                           workers=workers, out=out, only=only, scheduler=scheduler)
        except CasesFailed as error:
            failed, tables = error, load(self.tables, self.name, out)
        if tables:
            tables = put_derived(self.derive(tables), self.tables, self.name, size, out, only)
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


def results(size: str) -> Path:
    """Where a size goes unless told otherwise: quick is for trying out and leaves the tables of the others alone."""
    return RESULTS / "quick" if size == "quick" else RESULTS


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
    except NoSuchCase as error:
        sys.exit(say(f"{study.name}: {error}", 2))
    except (CasesFailed, ClusterError, OtherTable, FileNotFoundError) as error:
        sys.exit(say(f"{study.name}: {error}", 1))
    except OSError as error:
        if error.errno not in DISK:
            raise
        sys.exit(say(f"{study.name}: {DISK[error.errno].format(out=words.out, file=error.filename)}", 1))


def parse(study: Study, arguments: Sequence[str] | None) -> argparse.Namespace:
    """Command, size (default: SIZE of the environment, else paper), workers or cluster, folder, which cases."""
    parser = argparse.ArgumentParser(prog=f"python -m studies.{study.name}")
    add, size = parser.add_argument, os.environ.get("SIZE") or "paper"
    add("command", nargs="?", default="run", choices=["run", "figures", "claims"])
    add("--size", default=size, help=f"{', '.join(SIZES)} (default: {size})")
    add("--workers", type=int, default=2, help="processes; 1 computes in this one (default: 2)")
    add("--scheduler", default=os.environ.get("SCHEDULER") or "", metavar="tcp://HOST:PORT",
        help="of a Dask cluster that runs the cases instead (default: SCHEDULER of the environment)")
    add("--out", type=Path, help="where tables and figures go (default: results; of size quick: results/quick)")
    add("--only", default="", metavar="TEXT", help="run only cases with this text in their label, such as a variant's name")
    words = parser.parse_args(arguments)
    try:
        check_size(words.size)
        check_workers(words.workers)
        check_scheduler(words.scheduler)
        if words.only and words.command != "run":
            raise ValueError(f"--only chooses what to run, {words.command} reads whole tables: leave it out")
        words.usual, words.out = words.out is None, words.out or results(words.size)
        check_out(words.out, make=words.command == "run")
    except ValueError as error:
        parser.error(str(error))
    return words


def check_out(out: Path, *, make: bool) -> None:
    """Refuse what is no folder; make it on wish."""
    if out.exists() and not out.is_dir():
        raise ValueError(f"--out {out} is a file: give a folder")
    try:
        if make:
            out.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise ValueError(f"--out {out} cannot be made ({error.strerror}): give another folder") from error


def perform(study: Study, words: argparse.Namespace) -> int:
    """Run what was asked for and say where it is."""
    failed = None
    if words.command == "run":
        try:
            study.run(words.size, workers=words.workers, out=words.out, only=words.only, scheduler=words.scheduler)
        except CasesFailed as error:
            failed = error
    elif not written(study, words.out):
        raise FileNotFoundError(f"no table in {shown(words.out / study.name)}: run {first(study, words)} first")
    if words.command in ("run", "figures"):
        for path in study.draw(words.out):
            say(f"figure  {shown(path)}")
    if words.command in ("run", "claims"):
        for row in study.judge(words.out):
            print(verdict_line(row))
    for path in written(study, words.out):
        say(f"table   {shown(path)}")
    if words.usual and words.out != RESULTS:
        say(f"size {words.size}: all of it is in {shown(words.out)}, what is in {shown(RESULTS)} stays as it is")
    if failed:
        raise failed
    return 0


def written(study: Study, out: Path) -> list[Path]:
    """The tables that exist."""
    paths = [out / study.name / f"{table.name}.csv" for table in study.tables]
    return [path for path in paths if path.exists()]


def first(study: Study, words: argparse.Namespace) -> str:
    """What makes the tables that are wanted."""
    if not words.usual:
        return f"python -m studies.{study.name} --size {words.size} --out {words.out}"
    return f"make study-{study.name}" if words.out == RESULTS else command(study.name, words.size)


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
