"""What results/ holds: studies with their tables and figures, found by name, and where each comes from."""
import importlib
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any, NamedTuple

import pandas as pd

from studies.kit.claim import COLUMNS
from studies.kit.csvfile import AGAIN, TEXT, content, read
from studies.kit.figure import Drawing, Overview
from studies.kit.key import ROOT
from studies.kit.study import Study
from studies.kit.table import STAMP

#: folders that are not shown
HIDDEN = ("raw", "quick", "films", "gallery", "own")
#: what a folder asks that no study fills
QUESTIONS = {"bench": "Speed beside public codes, in one run"}
#: the order of the page; studies that are not named follow by name
FIRST = ("rb", "cost", "hardcases", "onset", "operators", "ordering", "conservation", "noise", "lattices")


class NoReport(Exception):
    """What the page is made of is missing or is not what it should be; the message says the way out."""


@dataclass(frozen=True)
class Sheet:
    """A table on disk."""

    path: Path

    @property
    def stem(self) -> str:
        """Its name in the study."""
        return self.path.name.partition(".")[0]

    @property
    def name(self) -> str:
        """study/table"""
        return f"{self.path.parent.name}/{self.stem}"

    @property
    def file(self) -> str:
        """study/table.csv, packed or not"""
        return f"{self.path.parent.name}/{self.path.name}"

    @property
    def anchor(self) -> str:
        """Its place in the page."""
        return f"table-{self.path.parent.name}-{self.stem}"

    @cached_property
    def head(self) -> list[str]:
        """The comments above the columns, without those that are there for programs."""
        lines = content(self.path).splitlines()
        comments = [line for line in lines if line.startswith("#")]
        return [line[1:].strip() for line in comments if not line.startswith(TEXT)]

    @cached_property
    def frame(self) -> pd.DataFrame:
        """The rows; NoReport where the file is no table."""
        return rows_of(self.path)

    @cached_property
    def commits(self) -> list[str]:
        """Commit of the head, or where the head names none, those of the rows."""
        of_head = [line.removeprefix("commit ") for line in self.head if line.startswith("commit ")]
        if of_head:
            return of_head
        return sorted(set(self.frame.get("commit", ())))

    @property
    def made(self) -> str:
        """Commit, and of how many commits the rows are when they are of several."""
        number = len(set(self.frame.get("commit", ())))
        if number > 1 and len(self.commits) == 1:
            return f"{self.commits[0]}, rows of {number} commits"
        return " ".join(self.commits)


class Folder(NamedTuple):
    """What a folder asks, its tables and figures, and the study that makes them, if one does."""
    name: str
    question: str
    sheets: list[Sheet]
    pictures: list[Path]
    study: Study | None


def folders(out: Path) -> list[Folder]:
    """All that have tables or figures; NoReport where there are none."""
    paths = [path for path in out.glob("*/") if path.name not in HIDDEN]
    known = [folder for folder in map(folder_of, paths) if folder.sheets or folder.pictures]
    if not known:
        raise NoReport(f"no tables in {out}: run a study first, make study-rb writes the main ones")
    return sorted(known, key=lambda folder: (place(folder.name, FIRST), folder.name))


def place(name: str, order: Sequence[str]) -> int:
    """Which one of an order it is; what the order does not name comes after it."""
    return order.index(name) if name in order else len(order)


def folder_of(path: Path) -> Folder:
    """A folder, its figure `main` first."""
    sheets = [Sheet(table) for table in sorted([*path.glob("*.csv"), *path.glob("*.csv.gz")])]
    pictures = sorted(path.glob("*.png"), key=lambda png: (png.stem != "main", png.stem))
    study = study_of(path.name)
    question = study.question if study else QUESTIONS.get(path.name, path.name)
    return Folder(path.name, question, sheets, pictures, study)


def study_of(name: str) -> Study | None:
    """The study of this name, if there is one.

    Raises NoReport: its code cannot be loaded.
    """
    if not (ROOT/"studies"/name/"__main__.py").exists():
        return None
    try:
        study: Study = importlib.import_module(f"studies.{name}").STUDY
    except Exception as error:      # whatever its modules raise
        raise NoReport(f"studies/{name} cannot be loaded ({type(error).__name__}: {error}): mend it, "
                       f"python -m studies.{name} --help has the whole story") from error
    return study


def check_columns(folder: Folder) -> None:
    """Refuse a table that lacks a column which its study declares: the page would leave things out."""
    tables = folder.study.tables if folder.study else []
    declared = {table.name: [*table.columns, *STAMP] for table in tables}
    for sheet in folder.sheets:
        columns = declared.get(sheet.stem, [])
        missing = [name for name in columns if name not in sheet.frame]
        if missing:
            names = ", ".join(missing)
            raise NoReport(f"{sheet.path} has no column {names}: it was written by other code; {AGAIN}")


def drawings(folder: Folder) -> dict[str, Drawing | Overview]:
    """Figure -> what draws it, of those that the study lists."""
    if folder.study is None:
        return {}
    listed = getattr(folder.study.figures, "drawings", ())
    return {drawing.name: drawing for drawing in listed}


def claims_of(out: Path) -> pd.DataFrame:
    """All claims; NoReport where there are none, or the table lacks columns."""
    path = out/"claims.csv"
    if not path.exists():
        raise NoReport(f"{path} does not exist: studies write their verdicts there: make study-rb")
    return rows_of(path, COLUMNS)


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
    return having(frame, where)


def having(frame: pd.DataFrame, values: dict[str, Any]) -> pd.DataFrame:
    """Rows that have these values, in those of the columns that there are."""
    for column, value in values.items():
        if column in frame:
            frame = frame[frame[column] == value]
    return frame
