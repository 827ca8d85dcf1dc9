"""A part of a study, and how parts become one: a study of many questions is a list of parts."""
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass

import pandas as pd

from studies.kit.case import Case
from studies.kit.claim import Claim
from studies.kit.figure import Drawings
from studies.kit.table import Row, Rows, Table, Tables, check_once

NO_FIGURES = Drawings()


@dataclass(frozen=True, kw_only=True)
class Part:
    """Cases by size, the tables these fill, and what reads the tables."""

    cases: Callable[[str], Iterable[Case]]
    tables: Sequence[Table]
    #: rows that follow from the tables (extrapolations, means over seeds), merged into them
    derive: Callable[[Tables], Rows] = lambda tables: {}
    figures: Drawings = NO_FIGURES
    claims: Sequence[Claim] = ()


def joined(parts: Sequence[Part]) -> Part:
    """One part of many. Rows are derived in order: each part finds what those before it derived."""
    return Part(cases=lambda size: [case for part in parts for case in part.cases(size)],
                tables=[table for part in parts for table in part.tables],
                derive=lambda tables: derived(parts, tables),
                figures=Drawings(*(drawing for part in parts for drawing in part.figures.drawings)),
                claims=[claim for part in parts for claim in part.claims])


def derived(parts: Iterable[Part], tables: Tables) -> Rows:
    """Rows of all parts, each of which finds the rows of those before it in place of the tables on disk."""
    rows: dict[str, list[Row]] = {}
    for part in parts:
        frames = {name: pd.DataFrame(new) for name, new in rows.items() if new}
        new = part.derive(Tables({**tables, **frames}))
        check_once("derived tables", [*rows, *new])
        rows.update(new)
    return rows
