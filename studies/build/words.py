"""Names of methods, scenes, quantities, in code, tables, figures and texts alike; words.csv explains them.

KHP95 is Kum, Hoover & Posch 1995 (smooth-particle applied mechanics, SPAM); RR98 is Romero-Rochin & Rubi 1998
(discretized integral hydrodynamics, DIH: fields on points that exchange over edges).
"""
import csv
from pathlib import Path
from typing import NamedTuple

from particles.weights import WEIGHTS


class Word(NamedTuple):
    """A name, its meaning in a sentence, and its source."""
    name: str
    about: str
    source: str = ""


def of(kind: str) -> dict[str, Word]:
    """Words of a kind in words.csv, by name."""
    with Path(__file__).with_suffix(".csv").open(newline="") as lines:
        return {row["name"]: Word(row["name"], row["about"], row["source"])
                for row in csv.DictReader(lines) if row["kind"] == kind}


METHODS, SCENES, QUANTITIES = of("method"), of("scene"), of("quantity")
#: spam with a weight that has no line in words.csv is explained by the first line of the weight's docstring
METHODS = {f"spam-{name}": Word(f"spam-{name}", f"spam with {str(kind.__doc__).splitlines()[0]} as weight")
           for name, kind in WEIGHTS.items() if name not in ("lucy", "monaghan")} | METHODS
#: further methods that tables and figures name: with another parameter, or of one study
VARIATIONS = of("variation")
#: column `method` of tables -> the family, and the variant that is called by the family's name alone
FAMILIES = {"compressible": ("grid", "flux-form"), "spam": ("spam", "printed"), "dih": ("", ""),
            "boussinesq": ("boussinesq", "mac"), "linear": ("linear-theory", ""),
            "pypde-compressible": ("py-pde", "staggered")}


def name_of(method: str, variant: str = "") -> str:
    """Name of the method with these columns `method` and `variant` in tables; empty if it has none."""
    family, usual = FAMILIES.get(method, (method, ""))
    name = "-".join(filter(None, (family, variant.removeprefix(usual).removeprefix("-"))))
    return name if name in METHODS or name in VARIATIONS else ""


def explained(text: str = "") -> str:
    """Lines of all words that contain a text, below a title for each kind."""
    lines = []
    for title, words in (("methods", METHODS), ("methods of single studies", VARIATIONS), ("scenes", SCENES),
                         ("quantities", QUANTITIES)):
        rows = [word for word in words.values() if text.casefold() in " ".join(word).casefold()]
        lines += [f"{title}:", *(f"  {word.name:40s}{word.about}{f'  [{word.source}]'*bool(word.source)}"
                                 for word in rows)]*bool(rows)
    return "\n".join(lines) or f"no name and no sentence has {text!r}: leave it out to see all"
