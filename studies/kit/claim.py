"""Claims: what a paper says and where, what was measured, and the verdict.

With measured value m, its 95 % interval [m - err, m + err] and the accepted range [low, high]:

- ``holds``        the whole interval lies in the range;
- ``fails``        the whole interval lies outside, on one side;
- ``undecidable``  a limit of the range lies in the interval, or nothing could be measured.

A point estimate inside the range is not enough for ``holds``: with a large error bar it would hold by
ignorance. With this rule either verdict is wrong in 2.5 % of cases, and more computing leads to a verdict,
if the range, the seeds and the time window were fixed before the first look at the data and the interval
expresses chance. For claims ``fixed`` after a look this rate is unknown: the data may have shaped the claim.
"""
import math
import re
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import NamedTuple

import pandas as pd

from studies.kit.csvfile import OtherTable, commit, locked, read, write
from studies.kit.stats import CannotTell, Measured
from studies.kit.table import Row, Tables
from studies.kit.value import Value, WrongQuestion

COLUMNS = ("id", "source", "statement", "whose", "printed", "fixed", "measured", "err", "low", "high",
           "verdict", "reason", "study", "formula", "equation", "headline", "evidence")
#: meaning of columns, written into the head of the file
MEANING = ("whose: a statement that the paper prints, or another author, or our own about the same equation "
           "or scene; the id begins so",
           "fixed: whether range, seeds and window were fixed before the first look or after one",
           "formula: the question that the claim puts to the tables of its study, as in studies/kit/ask.py",
           "equation: the equations, figures or tables that the source names, else its sections",
           "headline: those of them whose verdict, in equations.md, this claim decides, alone or with others",
           "evidence: figures and tables in this folder that show it",
           "err is the half width of the 95 % interval, low to high is accepted; studies/kit/claim.py has "
           "the rule of the verdicts")

#: beginning of a source: a paper, or an author and a year
PAPER = re.compile(r"(KHP95|RR98)\b|[A-Z].*?\b(1[89]|20)\d\d\b\)?", re.IGNORECASE)
COUNTED = r"\d+(-\d+)?"
#: kind of place -> pattern of its number, in the order in which places are listed
KINDS = {"Eq.": COUNTED, "Fig.": COUNTED, "Table": COUNTED, "abstract": "",
         "Sec.": "[IVX]+( [A-Z])?", "example": r"\w+"}
PART = re.compile(r"(?:after )?(?:(Eq|Fig|Table|Sec|abstract|example)s?\.?(?: |$))?(.*)")


class Cited(NamedTuple):
    """An equation, figure, table or section of a paper; without a kind, the whole paper."""

    paper: str
    kind: str = ""
    number: str = ""

    def __str__(self) -> str:
        return " ".join(filter(None, self))

    @property
    def order(self) -> tuple:
        """Sort key by paper, kind and number: Eq. 9 before Eq. 10, Sec. III before Sec. III B."""
        number = int(self.number) if self.number.isdecimal() else 0
        return self.paper, [*KINDS, ""].index(self.kind), number, self.number


def places(source: str) -> tuple[Cited, ...]:
    """Places that a source cites, ranges expanded: equations, figures and tables only, if there are any.

    Raises ValueError: the source does not begin with a paper, or a part after it is no place.
    """
    paper, kind = paper_of(source), ""
    named: list[Cited] = []
    for part in re.split(r",\s*", source.removeprefix(paper).lstrip(", ")):
        word, number = PART.fullmatch(part).groups()    # type: ignore[union-attr]  # it takes any text
        kind = next((known for known in KINDS if word and known.startswith(word)), kind)
        numbers = each(number) if re.fullmatch(KINDS.get(kind, "-"), number) else []
        if part and not numbers:
            raise ValueError(f"source {source!r}: {part!r} is no place: write Eq. 45, Eqs 34-36, 39, Fig. 9, "
                             "Table 1, Sec. III B, Secs I, IV or abstract")
        named += [Cited(paper, kind, one) for one in numbers]
    counted = [one for one in named if KINDS[one.kind] == COUNTED]
    return tuple(counted or named or [Cited(paper)])


def each(number: str) -> list[str]:
    """A number as a list, or all numbers of a range such as 34-36."""
    first, _, last = number.partition("-")
    return [str(one) for one in range(int(first), int(last) + 1)] if last else [number]


def paper_of(source: str) -> str:
    """The paper that a source begins with. Raises ValueError: it begins with none."""
    known = PAPER.match(source)
    if not known:
        raise ValueError(f"source {source!r} is not a citation: begin with KHP95, RR98 or an author and a "
                         "year")
    return known.group(0)


def listed(several: Iterable[Cited]) -> str:
    """Places as text of a column, sorted: "RR98 Eq. 34; RR98 Eq. 35"."""
    return "; ".join(str(one) for one in sorted(set(several), key=lambda one: one.order))


@dataclass(frozen=True, kw_only=True)
class Claim:
    """One statement, testable or not, of a paper or another author (with the ``printed`` value), or our own.

    ``value(tables)`` returns (value, err), where err is the half width of the 95 % interval. The accepted
    range is ``expect`` +- ``within``, or has the limits ``at_least``, ``at_most``, or both; ``because`` is
    the reason for it. A statement that cannot be tested has ``undecidable="reason"`` instead.

    ``after`` : results that were seen before range, seeds or time window were fixed; empty if none were.
    ``headline`` : True if the claim decides the verdict on all places of its source, or which: "Eqs 34, 35".
    ``evidence`` : a figure, or a table that ``value`` does not read, in results/: "operators/growth.png".
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
    after: str = ""
    undecidable: str = ""
    headline: bool | str = False
    evidence: str = ""

    def __post_init__(self):
        try:
            self.check()
        except ValueError as error:
            raise ValueError(f"claim {self.id}: {error}") from error

    def check(self) -> None:
        """Raise ValueError if headline is no place of the source, or value, reason or limits are wrong."""
        if other := {*self.decides} - {*places(self.source)}:
            raise ValueError(f"headline {listed(other)} is not in source {self.source!r}: name it there too")
        if bool(self.undecidable.strip()) == bool(self.value):
            raise ValueError("it has no value, or one though it is declared undecidable: keep one of them")
        if not self.value:
            return
        if not self.because.strip():
            raise ValueError("it has no reason for its tolerance: because= says why this wide")
        pair = (self.expect is not None) + (self.within is not None)
        sided = self.at_least > -math.inf or self.at_most < math.inf
        if pair == 1 or (pair == 2) == sided or not self.low <= self.high:
            raise ValueError(f"it accepts [{self.low}, {self.high}]: give expect= with within= >= 0, or "
                             "at_least=, or at_most=, or both of these")

    @property
    def whose(self) -> str:
        """Origin of the statement, by the beginning of its id: "paper", "own" or "other"."""
        return {"khp95": "paper", "rr98": "paper", "own": "own"}.get(self.id.split("-")[0], "other")

    @property
    def decides(self) -> tuple[Cited, ...]:
        """Places whose verdict the claim decides."""
        if isinstance(self.headline, str) and self.headline:
            return places(f"{paper_of(self.source)} {self.headline}")
        return places(self.source) if self.headline else ()

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
    if claim.low <= value - err and value + err <= claim.high:
        return "holds"
    outside = value - err > claim.high or value + err < claim.low
    return "fails" if outside else "undecidable"


def judge(claims: Sequence[Claim], tables: Tables, study: str) -> list[Row]:
    """One row per claim, with the columns of results/claims.csv."""
    return [row(claim, Noting(tables), study) for claim in claims]


class Noting(Tables):
    """Tables that record which of them a value reads, so that evidence need not be listed by hand."""

    def __init__(self, tables: Tables):
        super().__init__(tables)
        self.read: list[str] = []

    def __getitem__(self, name: str) -> pd.DataFrame:
        self.read.append(name)
        return super().__getitem__(name)


def row(claim: Claim, tables: Noting, study: str) -> Row:
    """Row of a claim and its verdict; evidence: its figure, the tables of its formula, other tables read."""
    said = judged(claim, tables, study)
    asked = [one.table for one in getattr(claim.value, "asks", ()) if one.table in tables.read]
    files = [claim.evidence, *(f"{study}/{name}.csv" for name in dict.fromkeys([*asked, *tables.read]))]
    formula = str(claim.value) if isinstance(claim.value, Value) else ""
    tested = {"low": claim.low, "high": claim.high, "formula": formula} if claim.value else {}
    return {"id": claim.id, "source": claim.source, "statement": claim.statement, "printed": claim.printed,
            "whose": claim.whose, "fixed": "after" if claim.after else "before", "study": study, **tested,
            **said, "equation": listed(places(claim.source)), "headline": listed(claim.decides),
            "evidence": "; ".join(filter(None, files))}


def judged(claim: Claim, tables: Tables, study: str) -> Row:
    """Measured value, error, verdict and reason of one claim.

    Raises WrongQuestion: a column or a table that the claim asks for does not exist.
    """
    unknown = {"measured": math.nan, "err": math.nan, "verdict": "undecidable"}
    if claim.value is None:
        return {**unknown, "reason": claim.undecidable}
    try:
        value, err = map(float, claim.value(tables))
    except CannotTell as why:
        return {**unknown, "reason": str(why)}
    except (OtherTable, KeyError, AttributeError, NameError) as error:      # raised for a missing column
        words = f"study {study}, claim {claim.id}, {claim.value}: {error.args[0]}; correct the claim"
        raise WrongQuestion(words) from error
    except Exception as error:
        error.add_note(f"while judging claim {claim.id}")
        raise
    said = verdict(claim, value, err)
    limit = "a limit lies within the error: "*(said == "undecidable")
    looked = f"; asked after {claim.after}"*bool(claim.after)
    return {"measured": value, "err": err, "verdict": said,
            "reason": f"{limit}{claim.accepted}: {claim.because}{looked}"}


def put_claims(path: Path, rows: Sequence[Row]) -> None:
    """Replace the claims of one study in results/claims.csv; claims of other studies stay."""
    claims = pd.DataFrame(rows, columns=list(COLUMNS))
    with locked(path.parent/"raw"):     # several studies write into one file
        if path.exists():
            others = read(path, COLUMNS).query("study != @rows[0]['study']")
            claims = pd.concat([others, claims]) if len(others) else claims
        write(path, claims.sort_values(["study", "id"]), head=[f"commit {commit()}", *MEANING])
