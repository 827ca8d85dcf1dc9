"""Numbers printed in papers: ``published("khp95-ke-5000")`` is 0.00340 with uncertainty, units and source.

Each paper has a file, published/<paper>.csv; its head says how the numbers were read and lists misprints.
An id begins with the name of its file. A new paper is a new file; nothing else changes.
"""
from dataclasses import dataclass
from difflib import get_close_matches
from functools import cache
from pathlib import Path

import pandas as pd

FOLDER = Path(__file__).with_suffix("")     # has no __init__.py: as a package it would hide this module


@dataclass(frozen=True)
class PrintedNumber:
    """One printed number; ``uncertainty`` is 0 for a definition or a choice."""
    value: float
    uncertainty: float
    units: str
    source: str
    note: str


def names() -> list[str]:
    """Names of the papers, which are those of their files."""
    return sorted(path.stem for path in FOLDER.glob("*.csv"))


def table(name: str) -> pd.DataFrame:
    """All numbers of a paper, with id, symbol, units, source, reading. ValueError: no such file."""
    if name not in names():
        raise ValueError(f"no published numbers of {name!r}: there are {', '.join(names())}")
    return pd.read_csv(FOLDER/f"{name}.csv", comment="#", keep_default_na=False,
                       dtype={"value": float, "uncertainty": float, "symbol": str, "units": str, "note": str})


@cache
def numbers() -> dict[str, PrintedNumber]:
    """All numbers, by id."""
    fields = list(PrintedNumber.__dataclass_fields__)
    return {row["id"]: PrintedNumber(**{name: row[name] for name in fields})
            for paper in names() for row in table(paper).to_dict("records")}


def published(key: str) -> PrintedNumber:
    """The number with this id. Raises ValueError: unknown id; the message gives similar ones."""
    if key not in numbers():
        close = get_close_matches(key, numbers(), n=5) or names()
        raise ValueError(f"no published number {key!r}: did you mean {', '.join(close)}?")
    return numbers()[key]
