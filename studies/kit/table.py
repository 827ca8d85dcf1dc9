"""Tables: columns fixed, rows from cases merged into what is there.

A row of a better size (quick < paper < fine) is never replaced by one of a lesser size.
"""
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from numbers import Real
from pathlib import Path
from typing import Any

import pandas as pd

from studies.kit.csvfile import DIGITS, commit, cpu, now, read, versions, write

__all__ = ["SIZES", "Rows", "Table", "Tables", "changed", "check_size", "groups", "merge", "read"]

SIZES = ("quick", "paper", "fine")
#: columns that a row may have besides those of its table
SPENT = ("seed", "threads", "cpu_s", "compile_s")
#: columns that every row gets
STAMP = ("size", "commit")
#: rows by the name of their table
Rows = Mapping[str, list[dict[str, Any]]]


@dataclass(frozen=True)
class Table:
    """A table by name: its columns, and those (``key``) in which no two rows agree.

    Of large ones: which digits suffice (``digits``: column -> such as ".4f"), and in which columns a cell
    that repeats the one above is left out (``once``).
    """

    name: str
    key: Sequence[str]
    columns: Sequence[str]
    digits: Mapping[str, str] = field(default_factory=dict)
    once: Sequence[str] = ()

    @classmethod
    def of(cls, name: str, key: str, values: str, **more: Any) -> "Table":
        """A table from names of columns with spaces between them: those of the key, and the others."""
        return cls(name, key=key.split(), columns=[*key.split(), *values.split()], **more)

    def __post_init__(self):
        if not self.key or not {*self.key} <= {*self.columns}:
            raise ValueError(f"table {self.name} has key {list(self.key)}: a key is some of the columns, "
                             f"{', '.join(self.columns)}")


class Tables(dict[str, pd.DataFrame]):
    """Tables by name, as read from CSV."""

    def __missing__(self, name: str) -> pd.DataFrame:
        raise KeyError(f"no table {name!r} among {', '.join(self) or 'none'}: list it in the study's tables")


def groups(frame: pd.DataFrame, by: str | list[str]) -> list[tuple[Any, pd.DataFrame]]:
    """(value, its rows), values ascending."""
    return list(frame.groupby(by))


def check_size(size: str) -> str:
    """``size`` itself. Raises ValueError: it is none of the three."""
    if size not in SIZES:
        raise ValueError(f"unknown size {size!r}: choose one of {', '.join(SIZES)}, as in SIZE=quick")
    return size


def merge(path: Path, table: Table, rows: Sequence[dict[str, Any]], *, size: str,
          command: str = "") -> tuple[pd.DataFrame, int]:
    """Put ``rows`` into the CSV at ``path``; the table as it then is, and how many better rows stayed.

    No rows leave the table as it is; where there is none yet they make an empty one.
    Raises ValueError: rows lack key columns, have unknown columns, or two of them have the same key.
    """
    check_size(size)
    columns = [*table.columns, *STAMP]
    if not rows:
        if not path.exists():
            write(path, pd.DataFrame(columns=columns), head=head(command))
        return read(path, columns), 0
    new = rounded(table, pd.DataFrame([{"commit": commit(), **row, "size": size} for row in rows]))
    check_rows(table, new)
    old = read(path, columns) if path.exists() else pd.DataFrame()
    parts = [part for part in (old, new) if len(part)]
    chosen = best(pd.concat(parts, ignore_index=True), table.key)
    spent = [column for column in SPENT if column in chosen and column not in table.columns]
    frame = chosen.reindex(columns=[*table.columns, *spent, *STAMP])
    write(path, frame.sort_values(list(table.key), kind="stable"), head=head(command), once=table.once)
    return read(path), len(new) - int((chosen.index >= len(old)).sum())


def changed(path: Path, table: Table, rows: Sequence[dict[str, Any]]) -> list[dict[str, Any]]:
    """Those of ``rows`` that do not stand in the CSV at ``path`` as they are."""
    if not path.exists():
        return list(rows)
    old = set(lines(table, read(path, table.columns)))
    new = lines(table, rounded(table, pd.DataFrame(rows)))
    return [row for row, line in zip(rows, new) if line not in old]


def lines(table: Table, frame: pd.DataFrame) -> list[str]:
    """Rows as they are written, without what was spent on them."""
    columns = frame.reindex(columns=list(table.columns))
    return columns.to_csv(index=False, header=False, float_format=DIGITS).splitlines()


def rounded(table: Table, frame: pd.DataFrame) -> pd.DataFrame:
    """Rows with as many digits as the table keeps: before they are compared with what stands there."""
    kept = {name: [float(format(value, digits)) + 0.0 for value in frame[name]]     # no -0
            for name, digits in table.digits.items() if name in frame}
    return frame.assign(**kept)


def best(frame: pd.DataFrame, key: Sequence[str]) -> pd.DataFrame:
    """One row a key: the best size, the last of equals."""
    order = frame["size"].map(SIZES.index).sort_values(kind="stable").index
    return frame.loc[order[~identity(frame, key)[order].duplicated(keep="last")]]


def check_rows(table: Table, new: pd.DataFrame) -> None:
    """Refuse rows that would make the table ambiguous."""
    if unknown := sorted({*new.columns} - {*table.columns, *SPENT, *STAMP}):
        raise ValueError(f"table {table.name} has no column {', '.join(unknown)}: "
                         f"it has {', '.join(table.columns)}")
    if missing := [name for name in table.key if name not in new.columns or new[name].isna().any()]:
        raise ValueError(f"rows of table {table.name} lack {', '.join(missing)}: "
                         "every row needs its whole key")
    names = identity(new, table.key)
    if names.duplicated().any():
        raise ValueError(f"two rows of table {table.name} have the key {names[names.duplicated()].iloc[0]}: "
                         f"({', '.join(table.key)}) must tell them apart")


def identity(frame: pd.DataFrame, key: Sequence[str]) -> pd.Series:
    """The key of each row as one text, numbers as they are written, so that old and new rows compare."""
    return frame[list(key)].map(as_text).agg(", ".join, axis=1)


def as_text(value: Any) -> str:
    """A number as it stands in the CSV (9 digits; whole numbers in full), anything else as it is."""
    if not isinstance(value, Real):
        return str(value)
    return f"{value:.0f}" if float(value).is_integer() else DIGITS % value


def head(command: str) -> list[str]:
    """Lines on where a table comes from."""
    return [f"commit {commit()}", versions(), cpu(),
            f"{now()}, {command}"]
