"""results/equations.md names claims that exist."""
import re
from collections.abc import Iterator
from importlib import import_module

from studies.kit.sweep import RESULTS

STUDIES = ("operators", "ordering", "conservation", "noise", "rb")


def named(text: str, known: set[str]) -> Iterator[str]:
    """Claims in `code`; `-2d` replaces the end of the last full name, or is added to it."""
    whole = ""
    for name in re.findall(r"`([^`]+)`", text):
        if name.startswith(("rr98-", "own-")):
            whole = name
            yield name
        elif name.startswith("-"):
            parts = whole.split("-")
            ends = ["-".join(parts[:number]) + name for number in range(len(parts), 1, -1)]
            yield next((full for full in ends if full in known), whole + name)


def test_the_table_of_equations_names_claims_that_exist():
    known = {claim.id for study in STUDIES for claim in import_module(f"studies.{study}").STUDY.claims}
    cited = set(named((RESULTS/"equations.md").read_text(), known))
    assert len(cited) > 100
    assert not cited - known
