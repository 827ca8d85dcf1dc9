"""A part of a study, and how parts become one: a study of many questions is a list of parts."""
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import pandas as pd
from matplotlib.figure import Figure

from studies.kit.case import Case
from studies.kit.claim import Claim
from studies.kit.figure import Drawing, Overview
from studies.kit.table import Rows, Table, Tables


def nothing(tables: Tables) -> dict[str, Any]:
    """Default of ``derive`` and ``figures``."""
    return {}


@dataclass(frozen=True, kw_only=True)
class Part:
    """Cases by size, the tables these fill, and what reads the tables."""

    cases: Callable[[str], Iterable[Case]]
    tables: Sequence[Table]
    #: rows that follow from the tables (extrapolations, means over seeds), merged into them
    derive: Callable[[Tables], Rows] = nothing
    #: file name without .png -> figure
    figures: Callable[[Tables], Mapping[str, Figure]] = nothing
    claims: Sequence[Claim] = ()


def joined(parts: Sequence[Part]) -> Part:
    """One part of many. Rows are derived in order: each part finds what those before it derived.

    Raises ValueError: Two tables or two claims have one name; of figures and of derived rows when they
    are made.
    """
    tables = [table for part in parts for table in part.tables]
    claims = [claim for part in parts for claim in part.claims]
    check_once("tables", (table.name for table in tables))
    check_once("claims", (claim.id for claim in claims))
    return Part(cases=lambda size: [case for part in parts for case in part.cases(size)],
                tables=tables, derive=lambda tables: derived(parts, tables),
                figures=Joined(part.figures for part in parts), claims=claims)


def check_once(what: str, names: Iterable[str]) -> None:
    """Refuse a name that comes twice."""
    known: set[str] = set()
    for name in names:
        if name in known:
            raise ValueError(f"two {what} of one study are called {name!r}: give one of them another name")
        known.add(name)


def derived(parts: Iterable[Part], tables: Tables) -> Rows:
    """Rows of all parts, each of which finds the rows of those before it in place of the tables on disk."""
    rows: dict[str, list[dict[str, Any]]] = {}
    for part in parts:
        frames = {name: pd.DataFrame(new) for name, new in rows.items() if new}
        new = part.derive(Tables({**tables, **frames}))
        check_once("derived tables", [*rows, *new])
        rows.update(new)
    return rows


class Joined:
    """The figures of parts. drawings : of those parts that list them, with their tables."""

    def __init__(self, figures: Iterable[Callable[[Tables], Mapping[str, Figure]]]):
        self.figures = tuple(figures)

    @property
    def drawings(self) -> tuple[Drawing | Overview, ...]:
        """Each figure with the tables that it is drawn from."""
        return tuple(drawing for one in self.figures for drawing in getattr(one, "drawings", ()))

    def __call__(self, tables: Tables) -> dict[str, Figure]:
        """The figures for which there are rows."""
        pages = [one(tables) for one in self.figures]
        check_once("figures", (name for page in pages for name in page))
        return {name: figure for page in pages for name, figure in page.items()}
