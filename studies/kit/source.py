"""Sources of claims: a paper and places in it, as in "RR98 Sec. III B, Eqs 42, 49-51" or "KHP95 Fig. 9"."""
import re
from collections.abc import Iterable
from typing import NamedTuple

PAPER = re.compile(r"(KHP95|RR98)\b|[A-Z].*?\b(1[89]|20)\d\d\b\)?", re.IGNORECASE)
ROMAN = ("I", "II", "III", "IV", "V", "VI", "VII", "VIII", "IX", "X")
COUNTED, CHAPTER = r"(\d+)(?:-(\d+))?", rf"({'|'.join(ROMAN)})(?: [A-Z])?"
#: kind of place -> what follows it, in the order in which places are listed
KINDS = {"Eq.": COUNTED, "Fig.": COUNTED, "Table": COUNTED, "abstract": "", "Sec.": CHAPTER,
         "example": r"\w+"}
#: kinds that say more than a section does
EXACT = ("Eq.", "Fig.", "Table")
PART = re.compile(r"(?:after )?(?:(Eq|Fig|Table|Sec|abstract|example)s?\.?(?: |$))?(.*)")


class Cited(NamedTuple):
    """An equation, a figure, a table or a section of a paper; without a kind the whole paper."""

    paper: str
    kind: str = ""
    number: str = ""

    def __str__(self) -> str:
        return " ".join(filter(None, self))

    @property
    def order(self) -> tuple:
        """By paper, kind and number: Eq. 9 before Eq. 10, Sec. III before Sec. III B."""
        kind = [*KINDS, ""].index(self.kind)
        first, _, rest = self.number.partition(" ")
        number = ROMAN.index(first) if first in ROMAN else int(first) if first.isdecimal() else 0
        return self.paper, kind, number, rest


def places(source: str) -> tuple[Cited, ...]:
    """What a source names, each equation of a range; of one with equations, figures or tables these alone.

    Raises ValueError: it does not begin with a paper, or something after it is no place.
    """
    paper, named = paper_of(source), []
    rest, kind = source.removeprefix(paper).lstrip(", "), ""
    for part in filter(None, re.split(r",\s*", rest)):
        kind, numbers = place(part, kind, source)
        named += [Cited(paper, kind, number) for number in numbers]
    return tuple([one for one in named if one.kind in EXACT] or named or [Cited(paper)])


def paper_of(source: str) -> str:
    """The paper that a source begins with. Raises ValueError: it begins with none."""
    known = PAPER.match(source)
    if not known:
        raise ValueError(f"source {source!r} is not a citation: begin with KHP95, RR98 or an author and a "
                         "year")
    return known.group(0)


def place(part: str, kind: str, source: str) -> tuple[str, list[str]]:
    """Kind and numbers of a part between commas, which is of the kind before it if it names none."""
    word, number = PART.fullmatch(part).groups()    # type: ignore[union-attr]  # it takes any text
    kind = next((known for known in KINDS if word and known.startswith(word)), kind)
    counted = re.fullmatch(KINDS[kind], number) if kind else None
    if counted and KINDS[kind] == COUNTED:
        first, last = int(counted[1]), int(counted[2] or counted[1])
        numbers = [str(one) for one in range(first, last + 1)]
    else:
        numbers = [number] if counted else []
    if not numbers:
        raise ValueError(f"source {source!r}: {part!r} is no place: write Eq. 45, Eqs 34-36, 39, Fig. 9, "
                         "Table 1, Sec. III B, Secs I, IV or abstract")
    return kind, numbers


def listed(several: Iterable[Cited]) -> str:
    """Places as a column has them, sorted: "RR98 Eq. 34; RR98 Eq. 35"."""
    return "; ".join(str(one) for one in sorted(set(several), key=lambda one: one.order))
