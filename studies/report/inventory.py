"""What results/ holds: studies with their tables and figures, found by name, and where each comes from."""
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import NamedTuple

import pandas as pd

from studies.kit.claim import COLUMNS
from studies.kit.csvfile import TEXT, content, read
from studies.kit.figure import Drawing
from studies.kit.study import Study, names, study_of
from studies.kit.table import STAMP

#: folders that are not shown
HIDDEN = ("raw", "quick", "films", "gallery", "own")
#: what the folder asks that no study fills
OF_BENCH = "Speed beside public codes, in one run"
#: the order of the page; studies that are not named follow by name
FIRST = ("rb", "cost", "streams", "hardcases", "onset", "cavity", "operators", "ordering", "conservation",
         "noise", "lattices")


class NoReport(ValueError):
    """What the page is made of is missing or is not what it should be; the message says the way out."""


@dataclass(frozen=True)
class Sheet:
    """A table on disk, and the columns that its study declares."""

    path: Path
    columns: Sequence[str] = ()

    @property
    def stem(self) -> str:
        """Its name in the study."""
        return self.path.name.partition(".")[0]

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
        """The rows."""
        return read(self.path, self.columns)

    @cached_property
    def commits(self) -> list[str]:
        """Commit of the head, or where the head names none, those of the rows."""
        of_head = [line.removeprefix("commit ") for line in self.head if line.startswith("commit ")]
        return of_head or sorted(set(self.frame.get("commit", ())))

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
    study = study_of(path.name) if path.name in names() else None
    declared = {table.file: [*table.columns, *STAMP] for table in (study.tables if study else ())}
    files = sorted([*path.glob("*.csv"), *path.glob("*.csv.gz")])
    sheets = [Sheet(file, declared.get(file.name, ())) for file in files]
    pictures = sorted(path.glob("*.png"), key=lambda png: (png.stem != "main", png.stem))
    return Folder(path.name, study.question if study else OF_BENCH, sheets, pictures, study)


def drawings(folder: Folder) -> dict[str, Drawing]:
    """Figure -> what draws it, of those that the study lists."""
    listed = folder.study.figures.drawings if folder.study else ()
    return {drawing.name: drawing for drawing in listed}


def claims_of(out: Path) -> pd.DataFrame:
    """All claims. Raises NoReport: there are none."""
    path = out/"claims.csv"
    if not path.exists():
        raise NoReport(f"{path} does not exist: studies write their verdicts there: make study-rb")
    return read(path, COLUMNS)
