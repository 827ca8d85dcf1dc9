"""results/equations.md: what of each equation, figure and section of both papers holds, and what repairs it.

What an equation says, why it fails and what repairs it are sentences in sentences/*.toml. Verdicts, numbers
and evidence come from claims: in a sentence {id} is what a claim measured with its error, {id:%} the same in
per cent; {id:.2f} and {id:%.0f} have as many digits as they say, and no error. A `condition` says when an
equation holds of which one statement holds and another fails; one without claims says why in `untested`.
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
from studies.kit.csvfile import write_atomic
from studies.report.inventory import NoReport, claims_of

SENTENCES = Path(__file__).with_name("sentences")
COLUMNS = ("", "what is printed", "verdict", "why", "what repairs it", "evidence")
TITLES = {"Eq.": "numbered equations", "Fig.": "figures", "abstract": "sections", "Sec.": "sections"}
NUMBER = re.compile(r"\{([\w.-]+)(?::([^}]*))?\}")


class Account(NamedTuple):
    """What is said of some places of a paper, as in sentences/*.toml."""

    at: str
    says: str
    why: str = ""
    repair: str = ""
    condition: str = ""
    untested: str = ""

    @property
    def places(self) -> tuple[Cited, ...]:
        """The equations, figures or sections."""
        return places(self.at)


def write_equations(out: Path) -> Path:
    """Write equations.md from claims.csv, all or nothing; its path. Raises NoReport: as `text`."""
    path = out/"equations.md"
    write_atomic(path, text(claims_of(out), lines(), out))
    return path


def lines() -> list[Account]:
    """All lines, by paper, kind and number."""
    tables = [tomllib.loads(path.read_text()) for path in SENTENCES.glob("*.toml")]
    known = [Account(**{name: " ".join(words.split()) for name, words in line.items()})
             for table in tables for line in table["line"]]
    return sorted(known, key=lambda line: line.places[0].order)


def text(claims: pd.DataFrame, known: Sequence[Account], out: Path) -> str:
    """The file.

    Raises NoReport: a line cites a claim or a file that is not there, or its words do not fit its verdicts.
    """
    parts = [(SENTENCES/"head.md").read_text()]
    for (paper, title), group in groupby(known, key=heading):
        rows = [COLUMNS, ["---"]*len(COLUMNS), *(cells(line, claims, out) for line in group)]
        parts += [f"## {paper}: {title}\n", *("| " + " | ".join(row) + " |" for row in rows), ""]
    return "\n".join(parts)


def heading(line: Account) -> tuple[str, str]:
    """Paper and kind of a line."""
    return line.places[0].paper, TITLES[line.places[0].kind]


def cells(line: Account, claims: pd.DataFrame, out: Path) -> list[str]:
    """One row of a table."""
    names = ", ".join(" ".join(place[1:]).strip() for place in line.places)
    judging = naming(claims, "headline", line.places)
    sentences = [filled(words, claims) for words in (line.why, line.repair)]
    said = filled(verdict(line, judging), claims)
    return [names, line.says, f"**{said}**", *sentences, evidence(line, claims, judging, out)]


def naming(claims: pd.DataFrame, column: str, wanted: Sequence[Cited]) -> pd.DataFrame:
    """The claims that name one of some places in a column."""
    names = {str(place) for place in wanted}
    chosen = [not names.isdisjoint(text.split("; ")) for text in claims[column]]
    return claims[chosen]


def verdict(line: Account, judging: pd.DataFrame) -> str:
    """What follows from the verdicts of the claims that decide."""
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
    """A sentence with the numbers of its claims."""
    rows = claims.set_index("id")
    for name in re.findall("`((?:rr98|khp95|own)-[^`]*)`", sentence):
        found(name, rows)
    return NUMBER.sub(lambda match: number(found(match[1], rows), match[2] or ""), sentence)


def found(name: str, rows: pd.DataFrame) -> Any:
    """The row of a claim."""
    if name not in rows.index:
        raise NoReport(f"claims.csv has no claim {name}, which a sentence cites: run its study, or correct "
                       f"the sentence in {SENTENCES.name}/")
    return rows.loc[name]


def number(claim: Any, form: str) -> str:
    """What a claim measured, as a sentence asks for it."""
    if math.isnan(claim.measured):
        raise NoReport(f"claim {claim.name} has no number, for which a sentence asks: correct the sentence "
                       f"in {SENTENCES.name}/")
    scale, unit = (100, " %") if form.startswith("%") else (1, "")
    digits = form.removeprefix("%")
    value, err = scale*claim.measured, scale*claim.err
    said = signed(f"{value:{digits}}") if digits else with_error(value, err)
    return re.sub(r"e(−?)\+?0*(\d)", r"e\1\2", said) + unit


def evidence(line: Account, claims: pd.DataFrame, judging: pd.DataFrame, out: Path) -> str:
    """The claims that decide, others with numbers in the line, the count of all, figures and tables."""
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
    """A link to a figure or table, packed or not."""
    there = sorted(out.glob(f"{name}*"))
    if not there:
        raise NoReport(f"{out/name} is not there, which claims.csv has as evidence: run its study again")
    return f"[{name}]({there[0].relative_to(out)})"


# --- numbers as people read them ---------------------------------------------------------------------


def with_error(value: float, err: float) -> str:
    """17.5(15) for 17.5 +- 1.5: the error in units of the last digit, two of its digits where the first is 1.

    Without an error four digits.
    """
    if not math.isfinite(value):
        return "none"
    if not 0 < err < math.inf:
        return signed(f"{value:.4g}")
    size = math.floor(math.log10(err))
    digits = 2 if err/10**size < 2 else 1
    places = max(0, digits - 1 - size)
    if places >= 8:
        return signed(f"{value:.3g} ± {err:.1g}")
    last = round(err*10**places)
    return signed(f"{value:.{places}f}({last})")


def signed(text: str) -> str:
    """With the sign that type has for minus."""
    return text.replace("-", "−")


def short(value: object) -> str:
    """A cell of a table."""
    if isinstance(value, bool) or not isinstance(value, float | int):
        return str(value)
    if math.isnan(value):
        return ""
    return signed(f"{value:.5g}").replace("inf", "∞")
