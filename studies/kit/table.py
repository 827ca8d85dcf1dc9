"""Tables with fixed columns; rows of cases are merged into existing rows.

A row of a better size (quick < paper < fine) is never replaced by one of a lesser size.
"""
from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import KW_ONLY, dataclass, field
from pathlib import Path
from typing import Any

import pandas as pd

from studies.kit.csvfile import DIGITS, EMPTY, MISSING, commit, cpu, is_number, now, read, versions, write

SIZES = ("quick", "paper", "fine")
#: further columns that a row may have
SPENT = ("seed", "threads", "cpu_s", "compile_s")
#: columns that every row gets
STAMP = ("size", "commit")
#: column -> value
Row = dict[str, Any]
#: rows by the name of their table
Rows = Mapping[str, list[Row]]


@dataclass(frozen=True)
class Table:
    """A table: name, columns, those columns that identify a row (``key``), and what a row is (``about``).

    ``means``: column -> (meaning, unit) where they differ from `report/columns.csv`. For tables above 400 kB:
    ``large`` gzips the file, ``digits`` has the format of columns that need fewer digits (such as ".4f").
    """

    name: str
    key: Sequence[str]
    columns: Sequence[str]
    _: KW_ONLY
    about: str
    means: Mapping[str, tuple[str, str]] = field(default_factory=dict)
    digits: Mapping[str, str] = field(default_factory=dict)
    large: bool = False

    @property
    def file(self) -> str:
        """Name of its file in the folder of the study."""
        return f"{self.name}.csv.gz" if self.large else f"{self.name}.csv"

    @classmethod
    def of(cls, name: str, key: str, values: str, **more: Any) -> "Table":
        """A table from names of columns, separated by spaces: those of the key, and the others."""
        return cls(name, key=key.split(), columns=[*key.split(), *values.split()], **more)


class Tables(dict[str, pd.DataFrame]):
    """Tables by name, as read from CSV."""

    def __missing__(self, name: str) -> pd.DataFrame:
        raise KeyError(f"no table {name!r} among {', '.join(self) or 'none'}: list it in the study's tables")


def check_once(what: str, names: Iterable[str]) -> None:
    """Raise ValueError if a name occurs twice."""
    for name, number in Counter(names).items():
        if number > 1:
            raise ValueError(f"two {what} of one study are called {name!r}: give one of them another name")


def groups(frame: pd.DataFrame, by: str | list[str]) -> list[tuple[Any, pd.DataFrame]]:
    """Pairs (value, rows with this value), values ascending."""
    return list(frame.groupby(by))


def merge(path: Path, table: Table, rows: Sequence[Row], *, size: str,
          command: str = "") -> tuple[pd.DataFrame, int]:
    """Merge ``rows`` into the CSV at ``path``; return the table and the number of better rows kept.

    Without rows an existing table stays as it is, and a missing one is written empty.
    Raises ValueError: rows lack key columns, have unknown columns, or two of them have the same key.
    """
    columns = [*table.columns, *STAMP]
    old = read(path, columns) if path.exists() else pd.DataFrame(columns=columns)
    if not rows:
        if not path.exists():
            write(path, old, head=head(command))
        return old, 0
    stamped = [{"commit": commit(), **row, "size": size} for row in rows]
    new = rounded(table, pd.DataFrame(stamped))
    check_rows(table, new)
    parts = [part for part in (old, new) if len(part)]
    chosen = best(pd.concat(parts, ignore_index=True), table.key)
    are_new = int((chosen.index >= len(old)).sum())
    spent = [column for column in SPENT if column in chosen and column not in table.columns]
    frame = chosen.reindex(columns=[*table.columns, *spent, *STAMP])
    write(path, frame.sort_values(list(table.key), kind="stable"), head=head(command))
    return read(path), len(new) - are_new


def changed(path: Path, table: Table, rows: Sequence[Row]) -> list[Row]:
    """Those of ``rows`` that are not in the CSV at ``path`` with the same values."""
    if not path.exists():
        return list(rows)
    old = lines(read(path, table.columns), table.columns)
    new = lines(rounded(table, pd.DataFrame(rows)), table.columns)
    return [row for row, line in zip(rows, new) if line not in old]


def lines(frame: pd.DataFrame, columns: Sequence[str]) -> list[str]:
    """Rows as lines of CSV, with these columns alone."""
    text = frame.reindex(columns=list(columns)).to_csv(index=False, header=False, float_format=DIGITS)
    return text.splitlines()


def rounded(table: Table, frame: pd.DataFrame) -> pd.DataFrame:
    """Rows rounded to the digits of the table, so that they can be compared with rows on disk."""
    columns = {}
    for name, digits in table.digits.items():
        if name in frame:
            columns[name] = [float(format(value, digits)) + 0.0 for value in frame[name]]       # no -0
    return frame.assign(**columns)


def best(frame: pd.DataFrame, key: Sequence[str]) -> pd.DataFrame:
    """One row per key: that of the best size, the last among equals."""
    rank = frame["size"].map(SIZES.index).sort_values(kind="stable")
    ascending = frame.loc[rank.index]
    repeated = pd.Series(lines(ascending, key)).duplicated(keep="last")
    return ascending[~repeated.to_numpy()]


def check_rows(table: Table, new: pd.DataFrame) -> None:
    """Raise ValueError for unknown columns, keys that are incomplete or occur twice, and ambiguous texts."""
    unknown = new.columns.difference([*table.columns, *SPENT, *STAMP])
    if len(unknown):
        raise ValueError(f"table {table.name} has no column {', '.join(unknown)}: list it there")
    keys = new.reindex(columns=list(table.key))
    missing = keys.columns[keys.isna().any()]
    if len(missing):
        raise ValueError(f"rows of table {table.name} lack {', '.join(missing)}: each needs its whole key")
    check_texts(table, new[new.columns.intersection(list(table.columns))])
    name, count = Counter(lines(new, table.key)).most_common(1)[0]
    if count > 1:
        raise ValueError(f"two rows of table {table.name} have the key {name}: a longer key tells them apart")


def check_texts(table: Table, frame: pd.DataFrame) -> None:
    """Raise ValueError for a text that a plain read_csv reads as a number or as missing."""
    for text in {value for value in frame.to_numpy().flat if isinstance(value, str)} - {""}:
        if is_number(text) or text in (*MISSING, EMPTY):
            raise ValueError(f"table {table.name} would hold the text {text!r}, which reads back as a number "
                             "or nothing: write numbers as such, nothing as None, or another word")


def head(command: str) -> list[str]:
    """Lines on the origin of a table: commit, versions, processor, time and command."""
    return [f"commit {commit()}", versions(), cpu(), f"{now()}, {command}"]
