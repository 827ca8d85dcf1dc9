"""results/equations.md: which equations, figures and sections of both papers hold, and what repairs them.

Sentences in sentences/*.toml say what an equation states, why it fails and what repairs it. Verdicts, numbers
and evidence come from claims: in a sentence {id} is the measured value of a claim with its error, {id:%} the
same in per cent; {id:.2f} and {id:%.0f} have the digits of the format, and no error. If one statement of an
equation holds and another fails, `condition` says when it holds; `untested` says why there is no claim.
"""
import math
import re
import tomllib
from collections import Counter
from collections.abc import Sequence
from itertools import groupby
from pathlib import Path
from typing import Any, NamedTuple

import pandas as pd

from studies.kit.claim import Cited, places
from studies.kit.stats import Measured
from studies.report.inventory import NoReport, claims_of

SENTENCES = Path(__file__).with_name("sentences")
COLUMNS = ("", "what is printed", "verdict", "why", "what repairs it", "evidence")
TITLES = {"Eq.": "numbered equations", "Fig.": "figures", "abstract": "sections", "Sec.": "sections"}
NUMBER = re.compile(r"\{([\w.-]+)(?::([^}]*))?\}")


class Account(NamedTuple):
    """An entry of sentences/*.toml: sentences on one or several places of a paper."""

    at: str
    says: str
    why: str = ""
    repair: str = ""
    condition: str = ""
    untested: str = ""

    @property
    def places(self) -> tuple[Cited, ...]:
        """Equations, figures or sections that the entry is about."""
        return places(self.at)


def lines() -> list[Account]:
    """All entries, sorted by paper, kind and number."""
    tables = [tomllib.loads(path.read_text()) for path in SENTENCES.glob("*.toml")]
    known = [Account(**{name: " ".join(words.split()) for name, words in line.items()})
             for table in tables for line in table["line"]]
    return sorted(known, key=lambda line: line.places[0].order)


def text(out: Path) -> str:
    """Text of the file, from claims.csv.

    Raises NoReport: an entry cites a missing claim or file, or its words do not fit its verdicts.
    """
    claims, parts = claims_of(out), [(SENTENCES/"head.md").read_text()]
    for (paper, title), group in groupby(lines(), key=heading):
        rows = [COLUMNS, ["---"]*len(COLUMNS), *(cells(line, claims, out) for line in group)]
        parts += [f"## {paper}: {title}\n", *("| " + " | ".join(row) + " |" for row in rows), ""]
    return "\n".join(parts)


def heading(line: Account) -> tuple[str, str]:
    """Paper and title of the section of an entry."""
    return line.places[0].paper, TITLES[line.places[0].kind]


def cells(line: Account, claims: pd.DataFrame, out: Path) -> list[str]:
    """Cells of an entry's row in the table."""
    names = ", ".join(" ".join(place[1:]).strip() for place in line.places)
    judging = naming(claims, "headline", line.places)
    sentences = [filled(words, claims) for words in (line.why, line.repair)]
    said = filled(verdict(line, judging), claims)
    return [names, line.says, f"**{said}**", *sentences, evidence(line, claims, judging, out)]


def naming(claims: pd.DataFrame, column: str, wanted: Sequence[Cited]) -> pd.DataFrame:
    """Claims that name one or more of the places in a column."""
    names = {str(place) for place in wanted}
    chosen = [not names.isdisjoint(text.split("; ")) for text in claims[column]]
    return claims[chosen]


def verdict(line: Account, judging: pd.DataFrame) -> str:
    """Verdict of an entry from those of the deciding claims. Raises NoReport: its words do not fit these."""
    verdicts = {*judging["verdict"]}
    mixed = {"holds", "fails"} <= verdicts
    if bool(line.untested) == bool(verdicts):
        raise NoReport(f"{line.at} has {len(judging)} claims that decide: give one headline=, or the line "
                       "untested=, and not both")
    if bool(line.condition) != mixed:
        raise NoReport(f"{line.at}: condition {line.condition!r} does not fit {', '.join(sorted(verdicts))}: "
                       "it is for what holds in one statement and fails in another; write the line anew")
    if line.untested:
        return f"not testable: {line.untested}"
    if mixed:
        return f"holds if {line.condition}"
    return "undecidable" if "undecidable" in verdicts else verdicts.pop()


def filled(sentence: str, claims: pd.DataFrame) -> str:
    """A sentence with numbers of claims filled in. Raises NoReport: it cites a claim that is missing."""
    rows = claims.set_index("id")
    for name in re.findall("`((?:rr98|khp95|own)-[^`]*)`", sentence):
        found(name, rows)
    return NUMBER.sub(lambda match: number(found(match[1], rows), match[2] or ""), sentence)


def found(name: str, rows: pd.DataFrame) -> Any:
    """Row of a claim. Raises NoReport: there is none."""
    if name not in rows.index:
        raise NoReport(f"claims.csv has no claim {name}, which a sentence cites: run its study, or correct "
                       f"the sentence in {SENTENCES.name}/")
    return rows.loc[name]


def number(claim: Any, form: str) -> str:
    """Measured value of a claim in the form that a sentence asks for. Raises NoReport: it has none."""
    if math.isnan(claim.measured):
        raise NoReport(f"claim {claim.name} has no number, for which a sentence asks: correct the sentence "
                       f"in {SENTENCES.name}/")
    scale, unit = (100, " %") if form.startswith("%") else (1, "")
    digits = form.removeprefix("%")
    value, err = scale*claim.measured, scale*claim.err
    said = signed(f"{value:{digits}}") if digits else with_error(value, err)
    return re.sub(r"e(−?)\+?0*(\d)", r"e\1\2", said) + unit


def evidence(line: Account, claims: pd.DataFrame, judging: pd.DataFrame, out: Path) -> str:
    """Text: claims that decide, others that sentences cite, counts of all by verdict, figures and tables."""
    numbers = dict.fromkeys(name for name, _ in NUMBER.findall(line.condition + line.why + line.repair))
    deciding = [f"`{name}` {said}" for name, said in zip(judging["id"], judging["verdict"])]
    others = [f"`{name}`" for name in numbers if name not in {*judging["id"]}]
    counts = Counter(naming(claims, "equation", line.places)["verdict"])
    count = ", ".join(f"{word} {counts[word]}" for word in ("holds", "fails", "undecidable") if counts[word])
    files = dict.fromkeys("; ".join(judging["evidence"]).split("; "))
    links = [link(name, out) for name in files if name]
    return "; ".join(filter(None, [", ".join(deciding), ", ".join(others),
                                   f"in all {count}"*bool(counts), ", ".join(links)]))


def link(name: str, out: Path) -> str:
    """Link to a figure or table, gzipped or not. Raises NoReport: it does not exist."""
    there = sorted(out.glob(f"{name}*"))
    if not there:
        raise NoReport(f"{out/name} is not there, which claims.csv has as evidence: run its study again")
    return f"[{name}]({there[0].relative_to(out)})"


# --- numbers as text ---------------------------------------------------------------------------------


def with_error(value: float, err: float) -> str:
    """17.5(15) for 17.5 +- 1.5; without an error, the value with four digits."""
    if not math.isfinite(value):
        return "none"
    return signed(str(Measured(value, err)) if 0 < err < math.inf else f"{value:.4g}")


def signed(text: str) -> str:
    """Text with typographic minus signs."""
    return text.replace("-", "−")


def short(value: object) -> str:
    """A value as text of a table cell."""
    if isinstance(value, bool) or not isinstance(value, float | int):
        return str(value)
    if math.isnan(value):
        return ""
    return signed(f"{value:.5g}").replace("inf", "∞")
