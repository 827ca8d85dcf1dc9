"""A study and its command line: python -m studies.NAME [run|figures|claims]."""
import argparse
import errno
import math
import os
import signal
import sys
import textwrap
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, NamedTuple

from studies.kit.case import Case
from studies.kit.claim import judge, put_claims
from studies.kit.csvfile import OtherTable
from studies.kit.figure import save
from studies.kit.part import Part, joined
from studies.kit.store import RESULTS, CannotRun, results
from studies.kit.sweep import CasesFailed, NoSuchCase, Sweep, labelled, load
from studies.kit.table import SIZES, Row, Tables, check_once

GO_ON = "finished cases are kept, the same command goes on from there"
FULL = "the disk is full; make room where {out} lies; " + GO_ON
REFUSED = "{file} cannot be written: give --out another folder"
LEAST = 8       # rows of what is tried out
#: number of the system's error -> what to do about it
DISK = {errno.ENOSPC: FULL, errno.EACCES: REFUSED, errno.EPERM: REFUSED, errno.EROFS: REFUSED}
#: what ends a study with one line
EXPECTED = (CasesFailed, CannotRun, OtherTable, FileNotFoundError)


class Own(NamedTuple):
    """Methods of one's own, tried out with few rows and seeds.

    cases : (text, rows, seeds) -> cases of the methods that the text names; raises NoSuchCase
    beside : (cases, tables with them, tables of the study) -> lines that compare
    """
    cases: Callable[[str, int, int], Sequence[Case]]
    beside: Callable[[Sequence[Case], Tables, Tables], Iterable[str]]


@dataclass(frozen=True, kw_only=True)
class Study(Part):
    """One question: a name, a sentence that asks it, and what answers it.

    Raises ValueError: Two tables, figures or claims have one name.
    """

    name: str
    question: str = ""
    own: Own | None = None

    def __post_init__(self):
        check_once("tables", (table.name for table in self.tables))
        check_once("claims", (claim.id for claim in self.claims))

    @classmethod
    def of(cls, name: str, question: str, parts: Sequence[Part], own: Own | None = None) -> "Study":
        """A study made of parts."""
        return cls(name=name, question=question.split("\n")[0], own=own, **vars(joined(parts)))

    def sweep(self, size: str, **more: Any) -> Sweep:
        """Its cases of a size: where they run, which of them, where their rows go."""
        return Sweep(study=self.name, tables=self.tables, size=size, **more)

    def run(self, size: str, *, out: Path | None = None, cases: Sequence[Case] = (), **more: Any) -> Tables:
        """Cases to tables, derived rows among them; more, such as ``workers``, are fields of `Sweep`.

        cases : those of one's own that run in place of the study's.

        Raises NoSuchCase: No label contains ``only``. CasesFailed: Some did; what follows from the
        others has been derived and written. CannotRun: The tables are as they were.
        """
        sweep = self.sweep(size, out=out or results(size), **more)
        tables, failed = sweep.run(cases or labelled(list(self.cases(size)), sweep.only, size))
        if tables:
            tables = sweep.put_derived(self.derive(tables))
        if failed:
            raise failed
        return tables

    def draw(self, out: Path = RESULTS) -> list[Path]:
        """Figures from the tables on disk."""
        pages = self.figures(load(self.tables, self.name, out))
        paths = {name: out/self.name/f"{name}.png" for name in pages}
        for name, page in pages.items():
            save(page, paths[name])
        return list(paths.values())

    def judge(self, out: Path = RESULTS) -> list[Row]:
        """Verdicts from the tables on disk, put into claims.csv."""
        rows = judge(self.claims, load(self.tables, self.name, out), self.name)
        if rows:
            put_claims(out/"claims.csv", rows)
        return rows

    def written(self, out: Path) -> list[Path]:
        """The tables that exist."""
        paths = [out/self.name/table.file for table in self.tables]
        return [path for path in paths if path.exists()]


def main(study: Study, arguments: Sequence[str] | None = None) -> None:
    """The command line of a study; ends with 0, or 1 (failed), 2 (not understood), 130 (interrupted)."""
    words = parse(study, arguments)
    signal.signal(signal.SIGTERM, signal.default_int_handler)
    try:
        sys.exit(perform(study, words))
    except KeyboardInterrupt as stop:
        sys.exit(say(f"\n{str(stop) or f'interrupted: {GO_ON}'}", 130))
    except NoSuchCase as error:
        sys.exit(say(f"{study.name}: {error}", 2))
    except EXPECTED as error:
        sys.exit(say(f"{study.name}: {error}", 1))
    except OSError as error:
        if error.errno not in DISK:
            raise
        text = DISK[error.errno].format(out=words.out, file=error.filename)
        sys.exit(say(f"{study.name}: {text}", 1))


def parse(study: Study, arguments: Sequence[str] | None) -> argparse.Namespace:
    """Command, size (default: SIZE of the environment, else paper), where it runs, folder, which cases."""
    parser = argparse.ArgumentParser(prog=f"python -m studies.{study.name}", description=study.question)
    add = parser.add_argument
    size = os.environ.get("SIZE") or "paper"
    scheduler = os.environ.get("SCHEDULER") or ""
    add("command", nargs="?", default="run", choices=["run", "figures", "claims"])
    add("--size", default=size, help=f"{', '.join(SIZES)} (default: {size})")
    add("--workers", type=int, default=2, help="processes; 1 computes in this one (default: 2)")
    add("--scheduler", default=scheduler, metavar="tcp://HOST:PORT",
        help="of a Dask cluster that runs the cases instead (default: SCHEDULER of the environment)")
    add("--out", type=Path, help="where tables and figures go (default: results, or results/quick)")
    add("--only", default="", metavar="TEXT",
        help="run only cases with this text in their label, such as a variant's name")
    add("--rows", type=int, metavar="N", help="try out the methods that --only names, with N rows")
    add("--seeds", type=int, metavar="N", help="seeds 1 to N of these (default: 1)")
    add("--keep", action="store_true", help="put these into tables, figures and verdicts of the study, too")
    words = parser.parse_args(arguments)
    words.tried = words.rows is not None and not words.keep
    words.usual = words.out is None
    words.out = words.out or results("own" if words.tried else words.size)
    words.cases = dict(workers=words.workers, scheduler=words.scheduler, out=words.out, only=words.only)
    try:
        check_own(study, words)
        check_words(study, words)
    except ValueError as error:
        parser.error(str(error))
    return words


def check_own(study: Study, words: argparse.Namespace) -> None:
    """Refuse numbers of rows and seeds that nothing can run with; without --rows nothing is one's own."""
    if words.rows is None:
        if words.seeds is not None or words.keep:
            raise ValueError("--seeds and --keep are for methods that are tried out: give --rows, too")
        return
    words.seeds = 1 if words.seeds is None else words.seeds
    if study.own is None:
        raise ValueError(f"{study.name} has rows of its own: leave --rows out, --size chooses among them")
    if not words.only:
        raise ValueError(f"--rows {words.rows} is for the methods that --only names: give --only TEXT, too")
    if words.rows < LEAST:
        raise ValueError(f"--rows must be at least {LEAST}, got {words.rows}: fewer do not resolve a roll")
    if words.seeds < 1:
        raise ValueError(f"--seeds must be at least 1, got {words.seeds}: leave it out for one run")
    words.cases["typed"] = f"--rows {words.rows} --seeds {words.seeds}" + " --keep"*words.keep


def check_words(study: Study, words: argparse.Namespace) -> None:
    """Refuse what cannot be done, before anything is; make the folder that is written to."""
    study.sweep(words.size, **words.cases)
    out, runs = words.out, words.command == "run"
    if words.only and not runs:
        raise ValueError(f"--only chooses what to run, {words.command} reads whole tables: leave it out")
    if out.exists() and not out.is_dir():
        raise ValueError(f"--out {out} is a file: give a folder")
    try:
        if runs:
            out.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise ValueError(f"--out {out} cannot be made ({error.strerror}): give another folder") from error


def perform(study: Study, words: argparse.Namespace) -> int:
    """Run what was asked for and say where it is."""
    out, failed = words.out, None
    own = study.own.cases(words.only, words.rows, words.seeds) if study.own and words.rows else ()
    if words.command == "run":
        try:
            study.run(words.size, cases=own, **words.cases)
        except CasesFailed as error:
            failed = error
    elif not study.written(out):
        raise FileNotFoundError(f"no table in {shown(out/study.name)}: run {first(study, words)} first")
    if study.own and own:
        both = (load(study.tables, study.name, folder) for folder in (out, results("paper")))
        print(*study.own.beside(own, *both), sep="\n")
    if words.command in ("run", "figures") and not words.tried:
        for path in study.draw(out):
            say(f"figure  {shown(path)}")
    if words.command in ("run", "claims") and not words.tried:
        for row in study.judge(out):
            print(verdict_line(row))
    for path in study.written(out):
        say(f"table   {shown(path)}")
    usual = results("paper")
    if words.usual and out != usual:
        what = "tried out" if words.tried else f"size {words.size}"
        say(f"{what}: all of it is in {shown(out)}, what is in {shown(usual)} stays as it is")
    if failed:
        raise failed
    return 0


def first(study: Study, words: argparse.Namespace) -> str:
    """What makes the tables that are wanted."""
    if not words.usual:
        return f"python -m studies.{study.name} --size {words.size} --out {words.out}"
    if words.out == results("paper"):
        return f"make study-{study.name}"
    return study.sweep(words.size).command


def verdict_line(row: Row) -> str:
    """A claim and its verdict in two lines."""
    value = row["reason"]
    if math.isfinite(row["measured"]):
        printed = f"printed {row['printed']}, " if row["printed"] else ""
        value = f"{printed}measured {row['measured']:.5g} +- {row['err']:.2g}"
    claim = textwrap.fill(f"{row['source']}: {row['statement']}", 87)
    return f"{row['verdict']:<12} {row['id']}: {value}\n" + textwrap.indent(claim, " "*13)


def shown(path: Path) -> Path:
    """A path as short as it gets."""
    return path.relative_to(Path.cwd()) if path.is_relative_to(Path.cwd()) else path


def say(text: str, code: int = 0) -> int:
    """A message for the user."""
    print(text, file=sys.stderr, flush=True)
    return code
