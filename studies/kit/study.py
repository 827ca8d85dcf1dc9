"""A study and its command line: python -m studies NAME [run|figures|claims]."""
import argparse
import math
import os
import re
import signal
import sys
import textwrap
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, field
from difflib import get_close_matches
from importlib import import_module
from pathlib import Path
from typing import Any, NamedTuple

from studies.kit.case import Case
from studies.kit.claim import Claim, judge, put_claims
from studies.kit.csvfile import OtherTable, locked
from studies.kit.figure import Drawings, save
from studies.kit.key import ROOT
from studies.kit.store import RESULTS, CannotRun, results
from studies.kit.sweep import GO_ON, CasesFailed, NoSuchCase, Sweep, labelled, load
from studies.kit.table import SIZES, Row, Rows, Table, Tables, check_once

LEAST = 8       # rows of a trial run
COMMANDS = "run", "figures", "claims"


class Own(NamedTuple):
    """Trial runs of methods with few rows and seeds.

    cases : (text, rows, seeds) -> cases of the methods that the text names; raises NoSuchCase
    beside : (cases, their tables, tables of the study) -> lines that compare both
    """
    cases: Callable[[str, int, int], Sequence[Case]]
    beside: Callable[[Sequence[Case], Tables, Tables], Iterable[str]]


@dataclass(frozen=True, kw_only=True)
class Study:
    """One question: its name and sentence, cases by size, their tables, and figures and claims from these.

    Raises ValueError: two tables or two claims have one name.
    """

    name: str
    question: str = ""
    cases: Callable[[str], Iterable[Case]]
    tables: Sequence[Table]
    #: rows that follow from the tables (extrapolations, means over seeds), merged into them
    derive: Callable[[Tables], Rows] = lambda tables: {}
    figures: Drawings = field(default_factory=Drawings)
    claims: Sequence[Claim] = ()
    own: Own | None = None

    def __post_init__(self):
        check_once("tables", (table.name for table in self.tables))
        check_once("claims", (claim.id for claim in self.claims))

    def run(self, size: str, *, out: Path | None = None, cases: Sequence[Case] = (), **more: Any) -> Tables:
        """Run the cases; return the tables with derived rows. more : fields of `Sweep`, such as workers.

        cases : trial cases, which run instead of those of the study.

        Raises NoSuchCase: no label contains ``only``. CasesFailed: some cases failed; rows of the others,
        and rows derived from them, are written. CannotRun: the tables are unchanged. BlockingIOError: the
        study runs in this folder already.
        """
        sweep = Sweep(study=self.name, tables=self.tables, size=size, out=out or results(size), **more)
        chosen = cases or labelled(list(self.cases(size)), sweep.only, size)
        wanted = list({case.key: case for case in chosen}.values())
        busy = f"{self.name} runs in {shown(sweep.out)} already: let it end, or give another --out"
        with locked(sweep.folder, busy):
            failures = sweep.run(wanted)
            tables = sweep.put(sweep.rows(wanted))
            if tables:
                tables = sweep.put(self.derive(tables), derived=True)
        if failures:
            count = f"{len(failures)} of {len(wanted)} cases failed, the tables hold the others:"
            raise CasesFailed("\n".join([count, *map(str, failures)]))
        return tables

    def draw(self, out: Path = RESULTS) -> list[Path]:
        """Draw and save the figures from the tables on disk; return their files."""
        pages = self.figures(load(self.tables, self.name, out))
        paths = {name: out/self.name/f"{name}.png" for name in pages}
        for name, page in pages.items():
            save(page, paths[name])
        return list(paths.values())

    def judge(self, out: Path = RESULTS) -> list[Row]:
        """Verdicts from the tables on disk, also written to claims.csv."""
        rows = judge(self.claims, load(self.tables, self.name, out), self.name)
        if rows:
            put_claims(out/"claims.csv", rows)
        return rows

    def written(self, out: Path) -> list[Path]:
        """Files of the tables that exist."""
        paths = [out/self.name/table.file for table in self.tables]
        return [path for path in paths if path.exists()]


def names() -> list[str]:
    """Names of all studies: folders whose `__init__.py` defines STUDY."""
    files = sorted((ROOT/"studies").glob("*/__init__.py"))
    return [path.parent.name for path in files if "\nSTUDY = " in path.read_text()]


def study_of(name: str) -> Study:
    """The study of this name."""
    study: Study = import_module(f"studies.{name}").STUDY
    return study


def main(study: Study, arguments: Sequence[str] | None = None) -> None:
    """Command line of a study; exits with 0, 1 (failed), 2 (wrong arguments) or 130 (interrupted)."""
    words = parse(study, arguments)
    signal.signal(signal.SIGTERM, signal.default_int_handler)
    try:
        perform(study, words)
    except KeyboardInterrupt as stop:
        sys.exit(say(f"\n{str(stop) or f'interrupted: {GO_ON}'}", 130))
    except NoSuchCase as error:
        sys.exit(say(f"{study.name}: {error}", 2))
    except (CasesFailed, CannotRun, OtherTable, OSError) as error:      # a full disk, no permission to write
        sys.exit(say(f"{study.name}: {error}", 1))
    sys.exit(0)


def parse(study: Study, arguments: Sequence[str] | None) -> argparse.Namespace:
    """Checked arguments: command, size (default: SIZE of the environment, else paper), folder, cases."""
    parser = argparse.ArgumentParser(prog=f"python -m studies {study.name}", description=study.question)
    add = parser.add_argument
    size = os.environ.get("SIZE") or "paper"
    scheduler = os.environ.get("SCHEDULER") or ""
    add("command", nargs="?", default="run", metavar="{run,figures,claims}")
    add("--size", default=size, help=f"{', '.join(SIZES)} (default: {size})")
    add("--workers", type=int, default=2, help="processes; 1 computes in this one (default: 2)")
    add("--scheduler", default=scheduler, metavar="tcp://HOST:PORT",
        help="of a Dask cluster that runs the cases instead (default: SCHEDULER of the environment)")
    add("--out", type=Path, help="where tables and figures go (default: results, or results/quick)")
    add("--only", default="", metavar="TEXT",
        help="run only cases with this text in their label, such as a variant's name")
    add("--rows", type=int, metavar="N", help="try out the methods that --only names, with N rows")
    add("--seeds", type=int, default=1, metavar="N", help="seeds 1 to N of these (default: 1)")
    words = parsed(parser, arguments)
    words.tried = words.rows is not None
    words.out = words.out or results("own" if words.tried else words.size)
    words.cases = dict(workers=words.workers, scheduler=words.scheduler, out=words.out, only=words.only)
    try:
        check(study, words)
    except (ValueError, OSError) as error:
        parser.error(str(error))
    return words


def parsed(parser: argparse.ArgumentParser, arguments: Sequence[str] | None) -> argparse.Namespace:
    """Parsed arguments; exits with 2 at an unknown option, before its value is taken for an argument."""
    words, rest = parser.parse_known_args(arguments)
    if rest:
        known = re.findall("--[a-z]+", parser.format_usage())
        near = ", ".join(get_close_matches(rest[0], known, 2, 0.5) or known)
        parser.error(f"no option is called {rest[0]}; near to it are {near}")
    return words


def check(study: Study, words: argparse.Namespace) -> None:
    """Check the arguments before anything runs, and make the output folder. Raises ValueError, OSError."""
    if words.command not in COMMANDS:
        raise ValueError(f"no command is called {words.command!r}: there are {', '.join(COMMANDS)}")
    Sweep(study=study.name, tables=study.tables, size=words.size, **words.cases)
    if words.tried and study.own is None:
        raise ValueError(f"{study.name} has rows of its own: leave --rows out, --size chooses among them")
    if words.tried and not words.only:
        raise ValueError("--rows is for the methods that --only names: give --only TEXT, too")
    if words.tried and words.rows < LEAST:
        raise ValueError(f"--rows must be at least {LEAST}, got {words.rows}: fewer do not resolve a roll")
    if words.seeds < 1 or (words.seeds > 1 and not words.tried):
        raise ValueError(f"--seeds {words.seeds}: give 1 or more, and --rows, too")
    if words.command == "run":
        words.out.mkdir(parents=True, exist_ok=True)
    elif words.only:
        raise ValueError(f"--only chooses what to run, {words.command} reads whole tables: leave it out")


def perform(study: Study, words: argparse.Namespace) -> None:
    """Carry out the command and print where results are. Raises CasesFailed: some did, others are shown."""
    out, failed, run = words.out, None, words.command == "run"
    own = study.own.cases(words.only, words.rows, words.seeds) if study.own and words.tried else ()
    if run:
        try:
            study.run(words.size, cases=own, **words.cases)
        except CasesFailed as error:
            failed = error
    elif not study.written(out):
        raise FileNotFoundError(f"no table in {shown(out/study.name)}: run the study first")
    if study.own and own:
        both = (load(study.tables, study.name, folder) for folder in (out, results("paper")))
        print(*study.own.beside(own, *both), sep="\n")
    elif run or words.command == "figures":
        for path in study.draw(out):
            say(f"figure  {shown(path)}")
    if not own and words.command != "figures":
        for row in study.judge(out):
            print(verdict_line(row))
    for path in study.written(out):
        say(f"table   {shown(path)}")
    usual = results("paper")
    if out != usual:
        say(f"all of it is in {shown(out)}, what is in {shown(usual)} stays as it is")
    if failed:
        raise failed


def verdict_line(row: Row) -> str:
    """A claim and its verdict in two lines."""
    value = row["reason"]
    if math.isfinite(row["measured"]):
        printed = f"printed {row['printed']}, " if row["printed"] else ""
        value = f"{printed}measured {row['measured']:.5g} +- {row['err']:.2g}"
    claim = textwrap.fill(f"{row['source']}: {row['statement']}", 87)
    return f"{row['verdict']:<12} {row['id']}: {value}\n" + textwrap.indent(claim, " "*13)


def shown(path: Path) -> Path:
    """A path, relative to the current folder if it is in there."""
    return path.relative_to(Path.cwd()) if path.is_relative_to(Path.cwd()) else path


def say(text: str, code: int = 0) -> int:
    """Print a message for the user to stderr; return the exit status ``code``."""
    print(text, file=sys.stderr, flush=True)
    return code
