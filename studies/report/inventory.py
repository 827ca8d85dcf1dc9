"""Inventory of results/: studies with their tables and figures, found by name, and the origin of each."""
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import NamedTuple

import pandas as pd

from studies.kit.claim import COLUMNS
from studies.kit.csvfile import TEXT, content, read
from studies.kit.figure import Drawing
from studies.kit.study import names, study_of
from studies.kit.table import STAMP

#: folders that are not shown
HIDDEN = ("raw", "quick", "films", "gallery", "own")
#: question of the folder that no study fills
OF_BENCH = "Speed beside public codes, in one run"
#: order of studies in the page; others follow by name
FIRST = ("rb", "cost", "streams", "hardcases", "onset", "cavity", "operators", "ordering", "conservation",
         "noise", "lattices")


class NoReport(ValueError):
    """A source of the report is missing or wrong; the message says how to repair it."""


@dataclass(frozen=True)
class Sheet:
    """A table on disk, and the columns that its study declares."""

    path: Path
    columns: Sequence[str] = ()

    @property
    def stem(self) -> str:
        """Name of the table in its study."""
        return self.path.name.partition(".")[0]

    @property
    def file(self) -> str:
        """Path in the results: study/table.csv or study/table.csv.gz."""
        return f"{self.path.parent.name}/{self.path.name}"

    @property
    def anchor(self) -> str:
        """Anchor of the table in the page."""
        return f"table-{self.path.parent.name}-{self.stem}"

    @cached_property
    def head(self) -> list[str]:
        """Comments above the columns, without those for programs."""
        lines = content(self.path).splitlines()
        comments = [line for line in lines if line.startswith("#")]
        return [line[1:].strip() for line in comments if not line.startswith(TEXT)]

    @cached_property
    def frame(self) -> pd.DataFrame:
        """The rows."""
        return read(self.path, self.columns)

    @cached_property
    def commits(self) -> list[str]:
        """Commit of the head, or if the head names none, commits of the rows."""
        of_head = [line.removeprefix("commit ") for line in self.head if line.startswith("commit ")]
        return of_head or sorted(set(self.frame.get("commit", ())))

    @property
    def made(self) -> str:
        """Commit of the head, and the number of commits of the rows if there are several."""
        number = len(set(self.frame.get("commit", ())))
        if number > 1 and len(self.commits) == 1:
            return f"{self.commits[0]}, rows of {number} commits"
        return " ".join(self.commits)


class Folder(NamedTuple):
    """A folder of results: its question, its tables, and files of its figures with what draws them."""
    name: str
    question: str
    sheets: list[Sheet]
    pictures: dict[Path, Drawing]


def folders(out: Path) -> list[Folder]:
    """All folders with tables or figures. Raises NoReport: there are none."""
    paths = [path for path in out.glob("*/") if path.name not in HIDDEN]
    known = [folder for folder in map(folder_of, paths) if folder.sheets or folder.pictures]
    if not known:
        raise NoReport(f"no tables in {out}: run a study first, make study-rb writes the main ones")
    order = {name: number for number, name in enumerate(FIRST)}
    return sorted(known, key=lambda folder: (order.get(folder.name, len(FIRST)), folder.name))


def folder_of(path: Path) -> Folder:
    """Contents of a folder, with the figure `main` first."""
    study = study_of(path.name) if path.name in names() else None
    declared = {table.file: [*table.columns, *STAMP] for table in (study.tables if study else ())}
    files = sorted([*path.glob("*.csv"), *path.glob("*.csv.gz")])
    sheets = [Sheet(file, declared.get(file.name, ())) for file in files]
    drawn = {path/f"{one.name}.png": one for one in (study.figures.drawings if study else ())}
    order = sorted(drawn, key=lambda png: (png.stem != "main", png.stem))
    pictures = {png: drawn[png] for png in order if png.exists()}
    return Folder(path.name, study.question if study else OF_BENCH, sheets, pictures)


def claims_of(out: Path) -> pd.DataFrame:
    """All claims. Raises NoReport: claims.csv does not exist."""
    path = out/"claims.csv"
    if not path.exists():
        raise NoReport(f"{path} does not exist: studies write their verdicts there: make study-rb")
    return read(path, COLUMNS)
