"""Names of methods, scenes, quantities, which words.csv explains; constants and columns of convection.

KHP95 is Kum, Hoover & Posch 1995 (smooth-particle applied mechanics, SPAM); RR98 is Romero-Rochin & Rubi 1998
(discretized integral hydrodynamics, DIH: fields on points that exchange over edges).
"""
import csv
from pathlib import Path
from typing import Any, NamedTuple

from continuum.published import published
from continuum.scene import ROLL_ENERGY
from particles.weights import WEIGHTS
from studies.kit.stats import Measured, with_errors

START_ENERGY = ROLL_ENERGY
START_JITTER = 0.2     # displacement at the start, in spacings: parts of a perfect lattice stay frozen
HALVES = 0.3           # a flow is not steady if K of both halves of the average differs by more, relative
EOS_NAMES = {"IdealGas": "ideal", "VanDerWaals": "vdw", "DenseFluid": "dense"}
TRANSPORT_NAMES = {"ConstEta": "const-eta", "ConstNu": "const-nu"}
#: result columns of `kinetic_energy`, not finite where a run diverged
VALUES = ("ke", "ke_err", "ke_field", "ke_field_err", "ke_mean", "ke_mean_err", "ke_fluctuation",
          "nu", "nu_err")
ENERGY = r"kinetic energy per mass $K$  [$\varepsilon/m$]"


class Word(NamedTuple):
    """A name, its meaning in a sentence, and its source."""
    name: str
    about: str
    source: str = ""


def words(kind: str) -> dict[str, Word]:
    """Words of a kind in words.csv, by name."""
    with Path(__file__).with_name("words.csv").open(newline="") as lines:
        return {row["name"]: Word(row["name"], row["about"], row["source"])
                for row in csv.DictReader(lines) if row["kind"] == kind}


METHODS, SCENES, QUANTITIES = words("method"), words("scene"), words("quantity")
#: spam with a weight that has no line in words.csv is explained by the first line of the weight's docstring
METHODS = {f"spam-{name}": Word(f"spam-{name}", f"spam with {str(kind.__doc__).splitlines()[0]} as weight")
           for name, kind in WEIGHTS.items() if name not in ("lucy", "monaghan")} | METHODS
#: further methods that tables and figures name: with another parameter, or of one study
VARIATIONS = words("variation")
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


# --- convection: columns, printed numbers -----------------------------------------------------------


def one_energy(ke: float, err: float) -> dict[str, float]:
    """Energy columns of a method without noise: particles, field and mean flow have the same K."""
    same = dict.fromkeys(("ke", "ke_field", "ke_mean"), Measured(ke, err))
    return {"ke_fluctuation": 0.0} | with_errors(**same)


def scene_columns(scene: Any) -> dict[str, Any]:
    """Columns that identify the scene."""
    eos, transport = type(scene.eos).__name__, scene.transport.__name__
    return {"eos": EOS_NAMES.get(eos, eos), "transport": TRANSPORT_NAMES.get(transport, transport),
            "sides": type(scene.sides).__name__.lower(), "ra": float(scene.ra), "pr": float(scene.pr)}


def number(key: str) -> float:
    """A number printed in KHP95."""
    return published(f"khp95-{key}").value


def as_printed(key: str) -> dict[str, Any]:
    """Accepted range of a printed number: its value, and the uncertainty of its last digit or wording."""
    value = published(f"khp95-{key}")
    return {"expect": value.value, "within": value.uncertainty}
