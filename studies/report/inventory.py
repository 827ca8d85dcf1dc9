"""What results/ holds: studies with their tables and figures, found by name, and where each comes from."""
import ast
import importlib
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import Any

import pandas as pd

from studies.kit.csvfile import ABOVE, AGAIN, TEXT, read
from studies.kit.figure import Drawing, Overview
from studies.kit.key import ROOT
from studies.kit.study import Study
from studies.kit.table import STAMP

#: folders that are no study
OTHERS = {"raw": "", "quick": "", "films": "", "bench": "Speed beside public codes, in one run"}
#: the order of the page; studies that are not named follow by name
FIRST = ("rb", "cost", "hardcases", "onset", "operators", "ordering", "conservation", "noise", "lattices")


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
        lines = self.path.read_text().splitlines()
        comments = [line[1:].strip() for line in lines if line.startswith("#")]
        return [line for line in comments if not line.startswith((TEXT[2:], ABOVE[2:]))]

    @cached_property
    def frame(self) -> pd.DataFrame:
        """The rows; NoReport where the file is no table."""
        return rows_of(self.path)

    @cached_property
    def commits(self) -> list[str]:
        """Commit of the head, or where the head names none, those of the rows."""
        of_head = [line.removeprefix("commit ") for line in self.head if line.startswith("commit ")]
        return of_head or sorted({str(one) for one in self.frame.get("commit", ())})

    @property
    def made(self) -> str:
        """Commit, and of how many commits the rows are when they are of several."""
        number = self.frame["commit"].nunique() if "commit" in self.frame else 1
        more = f", rows of {number} commits" if number > 1 and len(self.commits) == 1 else ""
        return " ".join(self.commits) + more


@dataclass(frozen=True)
class Folder:
    """A study: what it asks, its tables and figures."""

    name: str
    question: str
    sheets: list[Sheet] = field(default_factory=list)
    pictures: list[Path] = field(default_factory=list)


def folders(out: Path) -> list[Folder]:
    """All studies that have tables or figures; NoReport where there are none."""
    paths = [path for path in out.glob("*/") if OTHERS.get(path.name, "a study")]
    known = [folder for folder in map(folder_of, paths) if folder.sheets or folder.pictures]
    if not known:
        raise NoReport(f"no tables in {out}: run a study first, make study-rb writes the main ones")
    order = {name: number for number, name in enumerate(FIRST)}
    return sorted(known, key=lambda folder: (order.get(folder.name, len(FIRST)), folder.name))


def folder_of(path: Path) -> Folder:
    """The study of a folder."""
    sheets = [Sheet(table) for table in sorted(path.glob("*.csv"))]
    return Folder(path.name, question(path.name), sheets, sorted(path.glob("*.png")))


def question(name: str) -> str:
    """The first sentence of the study's package, which is its question."""
    file = ROOT/"studies"/name/"__init__.py"
    if name in OTHERS or not file.exists():
        return OTHERS.get(name, name)
    text = ast.get_docstring(ast.parse(file.read_text())) or name
    return " ".join(text.split("\n\n")[0].split())


def study_of(folder: Folder) -> Study | None:
    """The study with these tables; none of a folder that has other tables.

    Raises NoReport: its code cannot be loaded.
    """
    name = folder.name
    if not (folder.sheets and (ROOT/"studies"/name/"__init__.py").exists()):
        return None
    try:
        study: Study = importlib.import_module(f"studies.{name}").STUDY
    except Exception as error:      # whatever its modules raise
        raise NoReport(f"studies/{name} cannot be loaded ({type(error).__name__}: {error}): mend it, "
                       f"python -m studies.{name} --help has the whole story") from error
    return study


def check_columns(folder: Folder) -> None:
    """Refuse a table that lacks a column which its study declares: the page would leave things out."""
    study = study_of(folder)
    declared = {table.name: (*table.columns, *STAMP) for table in study.tables} if study else {}
    for sheet in folder.sheets:
        columns = declared.get(sheet.path.stem, ())
        if missing := [name for name in columns if name not in sheet.frame]:
            names = ", ".join(missing)
            raise NoReport(f"{sheet.path} has no column {names}: it was written by other code; {AGAIN}")


def drawings(folder: Folder) -> dict[str, Drawing | Overview]:
    """Figure -> what draws it, of those that the study lists."""
    study = study_of(folder)
    return {drawing.name: drawing for drawing in getattr(study.figures, "drawings", ())} if study else {}


def rows_of(path: Path, columns: tuple[str, ...] = (), **where: Any) -> pd.DataFrame:
    """Rows of a table with these values; of a file that is missing none.

    Raises NoReport: the file is no table, or lacks some of ``columns``.
    """
    if not path.exists():
        return pd.DataFrame(columns=[*columns, *where])
    try:
        frame = read(path, [*columns, *where])
    except ValueError as error:
        raise NoReport(str(error)) from error
    for column, value in where.items():
        frame = frame[frame[column] == value]
    return frame
