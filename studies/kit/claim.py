"""Claims: what a paper says, what was measured, and the verdict.

With measured value m, its 95 % interval [m - err, m + err] and the accepted range [low, high]:

- ``holds``        the whole interval lies in the range;
- ``fails``        the whole interval lies outside, on one side;
- ``undecidable``  a limit of the range lies in the interval, or nothing could be measured.

A point estimate inside the range is not enough for ``holds``: with a large error bar it would hold by
ignorance, and a better measurement could turn the verdict round. This way either verdict is wrong in 2.5 % of
cases at most, and more computing moves an undecidable claim one way or the other.
"""
import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import pandas as pd

from studies.kit.csvfile import OtherTable, commit, put
from studies.kit.formula import WrongQuestion
from studies.kit.source import Cited, listed, paper_of, places
from studies.kit.stats import CannotTell, Measured
from studies.kit.table import Row, Tables
from studies.kit.value import Value

COLUMNS = ("id", "source", "statement", "whose", "printed", "measured", "err", "low", "high", "verdict",
           "reason", "study", "formula", "equation", "headline", "evidence")
#: of columns, in the head of the file
MEANING = ("whose: a statement that the paper prints, or our own about the same equation",
           "formula: the question that the claim puts to the tables of its study, as in studies/kit/ask.py",
           "equation: the equations, figures or tables that the source names, else its sections",
           "headline: those of them whose verdict, in equations.md, this claim decides, alone or with others",
           "evidence: figures and tables in this folder that show it",
           "err is the half width of the 95 % interval, low to high is accepted; studies/kit/claim.py has "
           "the rule of the verdicts")


@dataclass(frozen=True, kw_only=True)
class Claim:
    """One statement, testable or not: a paper's, with what is ``printed``, or our own.

    ``value(tables)`` gives (value, err), err the half width of the 95 % interval. Accepted is ``expect`` +-
    ``within``, or ``at_least``, or ``at_most``, or both of these; ``because`` says where these limits come
    from. What cannot be tested has ``undecidable="reason"`` in their place.

    ``headline`` : True if it decides the verdict of all that its source names, or of which: "Eqs 34, 35".
    ``evidence`` : a figure, or a table that ``value`` does not ask, in results/: "operators/growth.png".
    """

    id: str
    source: str
    statement: str
    printed: str = ""
    value: Callable[[Tables], Measured | tuple[float, float]] | None = None
    expect: float | None = None
    within: float | None = None
    at_least: float = -math.inf
    at_most: float = math.inf
    because: str = ""
    undecidable: str = ""
    headline: bool | str = False
    evidence: str = ""

    def __post_init__(self):
        try:
            self.check_decides()
        except ValueError as error:
            raise ValueError(f"claim {self.id}: {error}") from error
        if not self.undecidable.strip():
            self.check_testable()
        elif self.value:
            raise ValueError(f"claim {self.id} has a value and is declared undecidable: keep one of them")

    def check_decides(self) -> None:
        """A headline is among the places of the source."""
        if other := {*self.decides} - {*self.places}:
            raise ValueError(f"headline {listed(other)} is not in source {self.source!r}: name it there too")

    @property
    def places(self) -> tuple[Cited, ...]:
        """Equations, figures, tables or else sections of the source."""
        return places(self.source)

    @property
    def decides(self) -> tuple[Cited, ...]:
        """Those of them whose verdict it decides."""
        if isinstance(self.headline, str) and self.headline:
            return places(f"{paper_of(self.source)} {self.headline}")
        return self.places if self.headline else ()

    def check_testable(self) -> None:
        """A claim that is tested has a value, limits and a reason for these."""
        if not self.because.strip():
            raise ValueError(f"claim {self.id} has no reason for its tolerance: because= says why this wide")
        if self.value is None:
            raise ValueError(f"claim {self.id} has no value: give value=, or undecidable= with the reason")
        pair = (self.expect is not None) + (self.within is not None)
        sided = self.at_least > -math.inf or self.at_most < math.inf
        if pair == 1 or (pair == 2) == sided or not self.low <= self.high:
            raise ValueError(f"claim {self.id} accepts [{self.low}, {self.high}]: give expect= with within= "
                             ">= 0, or at_least=, or at_most=, or both of these")

    @property
    def low(self) -> float:
        """Least accepted value."""
        return self.at_least if self.expect is None or self.within is None else self.expect - self.within

    @property
    def high(self) -> float:
        """Largest accepted value."""
        return self.at_most if self.expect is None or self.within is None else self.expect + self.within

    @property
    def accepted(self) -> str:
        """The accepted range in words."""
        if self.expect is not None:
            return f"accepted {self.expect:.6g} +- {self.within:.3g}"
        words = [f"at least {self.at_least:.6g}"]*math.isfinite(self.at_least)
        return "accepted " + " and ".join(words + [f"at most {self.at_most:.6g}"]*math.isfinite(self.at_most))


def verdict(claim: Claim, value: float, err: float) -> str:
    """``holds``, ``fails`` or ``undecidable`` by the rule at the head of this file."""
    if err < 0:
        raise ValueError(f"claim {claim.id}: err is {err}, but half the width of an interval is not negative")
    low, high = value - err, value + err
    if claim.low <= low and high <= claim.high:
        return "holds"
    if low > claim.high or high < claim.low:
        return "fails"
    return "undecidable"


def judge(claims: Sequence[Claim], tables: Tables, study: str) -> list[Row]:
    """One row a claim, with the columns of results/claims.csv."""
    return [row(claim, Noting(tables), study) for claim in claims]


class Noting(Tables):
    """Tables that note which of them a value reads: evidence is not listed by hand."""

    def __init__(self, tables: Tables):
        super().__init__(tables)
        self.read: dict[str, None] = {}

    def __getitem__(self, name: str) -> pd.DataFrame:
        self.read[name] = None
        return super().__getitem__(name)

    def get(self, name: str, default: Any = None) -> Any:
        """As of a dict."""
        return self[name] if name in self else default


def row(claim: Claim, tables: Noting, study: str) -> Row:
    """A claim and its verdict. Evidence: its own figure, the tables of its formula, others that it read."""
    said = judged(claim, tables, study)
    asked = [one.rows.table for one in getattr(claim.value, "asks", ()) if one.rows.table in tables.read]
    files = [claim.evidence, *(f"{study}/{name}.csv" for name in dict.fromkeys([*asked, *tables.read]))]
    return {**stated(claim), "study": study, **said, "evidence": "; ".join(filter(None, files))}


def stated(claim: Claim) -> Row:
    """What a claim says: of one that is tested the accepted range, and the formula where it has one."""
    row = {"id": claim.id, "source": claim.source, "statement": claim.statement, "printed": claim.printed,
           "whose": "paper" if claim.printed else "own",
           "equation": listed(claim.places), "headline": listed(claim.decides)}
    if claim.value is None:
        return row
    formula = str(claim.value) if isinstance(claim.value, Value) else ""
    return {**row, "low": claim.low, "high": claim.high, "formula": formula}


def judged(claim: Claim, tables: Tables, study: str = "") -> Row:
    """Measured value, error, verdict and reason of one claim.

    Raises WrongQuestion: a column or a table that the claim asks for is not there.
    """
    unknown = {"measured": math.nan, "err": math.nan, "verdict": "undecidable"}
    if claim.value is None:
        return {**unknown, "reason": claim.undecidable}
    try:
        value, err = map(float, claim.value(tables))
    except CannotTell as why:
        return {**unknown, "reason": str(why)}
    except (OtherTable, KeyError, AttributeError, NameError) as error:      # pandas names a column by any
        words = f"study {study}, claim {claim.id}, {claim.value}: {error.args[0]}; correct the claim"
        raise WrongQuestion(words) from error
    except Exception as error:
        error.add_note(f"while judging claim {claim.id}")
        raise
    said = verdict(claim, value, err)
    limit = "a limit lies within the error: " if said == "undecidable" else ""
    reason = f"{limit}{claim.accepted}: {claim.because}"
    return {"measured": value, "err": err, "verdict": said, "reason": reason}


def put_claims(path: Path, rows: Sequence[Row]) -> None:
    """Replace the claims of one study in results/claims.csv; those of others stay."""
    new = pd.DataFrame(rows, columns=list(COLUMNS))
    put(path, new, by=["study"], order=["study", "id"], head=[f"commit {commit()}", *MEANING])
