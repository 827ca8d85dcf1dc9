"""What a group of cases brings to its study: it is listed there by one line."""
from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import Any, NamedTuple

import pandas as pd

from studies.kit.case import Case
from studies.kit.claim import Claim
from studies.kit.drawing import Joined
from studies.kit.study import Study, nothing
from studies.kit.table import Table, Tables


class Part(NamedTuple):
    """The fields of a `Study`, of one group."""
    cases: Callable[[str], Iterable[Case]]
    tables: Sequence[Table]
    claims: Sequence[Claim] = ()
    derive: Callable[[Tables], Mapping[str, Any]] = nothing
    figures: Callable[[Tables], Mapping[str, Any]] = nothing


def chained(functions: Iterable[Callable[[Tables], Mapping[str, Any]]]) -> Callable[[Tables], dict[str, Any]]:
    """One function of the tables for many that derive rows: each finds what those before it made."""
    wanted = list(functions)

    def derive(tables: Tables) -> dict[str, Any]:
        found: dict[str, Any] = {}
        for function in wanted:
            found.update(function(Tables({**tables, **{name: pd.DataFrame(rows) for name, rows in found.items() if rows}})))
        return found
    return derive


def study(name: str, *parts: Part) -> Study:
    """The study that its parts make together, in this order: each derives from what those before it derived."""
    return Study(name=name, cases=lambda size: [case for part in parts for case in part.cases(size)],
                 tables=[table for part in parts for table in part.tables],
                 derive=chained(part.derive for part in parts), figures=Joined(part.figures for part in parts),
                 claims=[claim for part in parts for claim in part.claims])
