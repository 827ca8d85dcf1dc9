"""What results/ holds: studies with their tables and figures, found by name, and where each comes from."""
import ast
import importlib
import re
from collections.abc import Iterator
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import Any

import pandas as pd

from studies.kit.csvfile import ABOVE, AGAIN, TEXT, read
from studies.kit.key import ROOT
from studies.kit.study import Study
from studies.kit.table import STAMP

#: folders that are no study
OTHERS = {"raw": "", "quick": "", "films": "", "bench": "Speed beside public codes, in one run"}
#: the order of the page; studies that are not named follow by name
FIRST = ("rb", "cost", "hardcases", "onset", "operators", "ordering", "conservation", "noise", "lattices")

#: letters of a question from which on its first sentence will do
LONG = 160


class NoReport(Exception):
    """What the page is made of is missing or is not what it should be; the message says the way out."""


@dataclass(frozen=True)
class Sheet:
    """A table on disk."""

    path: Path

    @property
    def name(self) -> str:
        """study/table"""
        return f"{self.path.parent.name}/{self.path.stem}"

    @property
    def anchor(self) -> str:
        """Its place in the page."""
        return f"table-{self.path.parent.name}-{self.path.stem}"

    @cached_property
    def head(self) -> list[str]:
        """The comments above the columns, without those that are there for programs."""
        with self.path.open() as lines:
            found = [line[1:].strip() for line in lines if line.startswith("#")]
        return [line for line in found if not line.startswith((TEXT[2:], ABOVE[2:]))]

    @cached_property
    def frame(self) -> pd.DataFrame:
        """The rows.

        Raises
        ------
        NoReport
            The file is no table.
        """
        return rows_of(self.path)

    @cached_property
    def commits(self) -> list[str]:
        """Commit of the head, or where the head names none, those of the rows."""
        named = [line.removeprefix("commit ") for line in self.head if line.startswith("commit ")]
        return named or sorted({str(one) for one in self.frame.get("commit", ())})

    @cached_property
    def made(self) -> str:
        """Commit, and of how many commits the rows are when they are of several."""
        several = self.frame["commit"].nunique() if "commit" in self.frame else 1
        return " ".join(self.commits) + (f", rows of {several} commits" if several > 1 and len(self.commits) == 1 else "")


@dataclass(frozen=True)
class Part:
    """A study: what it asks, its tables and figures."""

    name: str
    question: str
    sheets: list[Sheet] = field(default_factory=list)
    pictures: list[Path] = field(default_factory=list)


def parts(out: Path) -> list[Part]:
    """All studies that have tables or figures.

    Raises
    ------
    NoReport
        There are none.
    """
    folders = sorted(folder for folder in out.glob("*/") if OTHERS.get(folder.name, "a study"))
    found = [Part(folder.name, question(folder.name), [Sheet(path) for path in sorted(folder.glob("*.csv"))],
                  sorted(folder.glob("*.png"))) for folder in folders]
    found = [part for part in found if part.sheets or part.pictures]
    if not found:
        raise NoReport(f"no tables in {out}: run a study first, make study-rb writes the main ones")
    return sorted(found, key=lambda part: (FIRST.index(part.name) if part.name in FIRST else len(FIRST), part.name))


def study_of(name: str) -> Study | None:
    """The study of this name; none of a folder that has other tables.

    Raises
    ------
    NoReport
        Its code cannot be loaded.
    """
    if not (ROOT/"studies"/name/"__init__.py").exists():
        return None
    try:
        study: Study = importlib.import_module(f"studies.{name}").STUDY
    except Exception as error:      # whatever its modules raise
        raise NoReport(f"studies/{name} cannot be loaded ({type(error).__name__}: {error}): mend it, its tables and figures "
                       f"cannot be told without it; python -m studies.{name} --help has the whole story") from error
    return study


def check_columns(found: list[Part]) -> None:
    """All columns that the studies declare are there: what reads a table would leave out, or say wrongly, what lacks some.

    Raises
    ------
    NoReport
        A table lacks some.
    """
    for part in found:
        study = study_of(part.name) if part.sheets else None
        declared = {table.name: (*table.columns, *STAMP) for table in study.tables} if study else {}
        for sheet in part.sheets:
            if lost := [name for name in declared.get(sheet.path.stem, ()) if name not in sheet.frame]:
                raise NoReport(f"{sheet.path} has no column {', '.join(lost)}: it was written by other code; {AGAIN}")


def question(name: str) -> str:
    """First sentence of the study's own docstring."""
    if OTHERS.get(name):
        return OTHERS[name]
    file = ROOT/"studies"/name/"__init__.py"
    text = ast.get_docstring(ast.parse(file.read_text())) if file.exists() else ""
    first = " ".join((text or name).split("\n\n")[0].split())
    return re.split(r"(?<=[.?])(?<!Sec\.)(?<!Eq\.)\s(?=[A-Z`])", first)[0] if len(first) > LONG else first


def rows_of(path: Path, columns: tuple[str, ...] = (), **where: Any) -> pd.DataFrame:
    """Rows of a table with these values; of a file that is missing none.

    Raises
    ------
    NoReport
        The file is no table, or lacks some of ``columns``.
    """
    if not path.exists():
        return pd.DataFrame(columns=[*columns, *where])
    try:
        frame = read(path, [*columns, *where])
    except (ValueError, UnicodeDecodeError) as error:      # pandas' errors of parsing are ValueErrors
        told = str(error) if str(path) in str(error) else f"{path} is no table ({error}): remove it and run the study again"
        raise NoReport(told) from error
    for column, value in where.items():
        frame = frame[frame[column] == value]
    return frame


def sheets_of(found: list[Part]) -> Iterator[Sheet]:
    """All tables."""
    for part in found:
        yield from part.sheets
