"""Sources name equations; each equation and figure of both papers has a line, its verdict from claims."""
from collections import Counter

import pandas as pd
import pytest

from studies.kit.claim import Claim, judge, listed, places
from studies.kit.sweep import RESULTS
from studies.kit.table import Tables
from studies.report.equations import Account, cells, lines, number, text
from studies.report.inventory import NoReport, claims_of

CLAIMS, LINES = claims_of(RESULTS), lines()
NAMED = [str(place) for line in LINES for place in line.places]
OTHER = {"holds": "fails", "fails": "holds", "undecidable": "fails"}


@pytest.mark.parametrize(("source", "column"), [
    ("RR98 Eqs 36, 9-11", "RR98 Eq. 9; RR98 Eq. 10; RR98 Eq. 11; RR98 Eq. 36"),
    ("RR98 after Eq. 48", "RR98 Eq. 48"), ("de Vahl Davis (1983)", "de Vahl Davis (1983)"),
    ("KHP95 Secs III, IV, Fig. 4", "KHP95 Fig. 4"), ("RR98, Secs III B, I", "RR98 Sec. I; RR98 Sec. III B"),
    ("KHP95 abstract", "KHP95 abstract"), ("Sod 1978", "Sod 1978"),
    ("Sangani & Acrivos 1982, Table 1", "Sangani & Acrivos 1982 Table 1")])
def test_a_source_names_each_of_its_equations_or_else_its_sections(source, column):
    assert listed(places(source)) == column


@pytest.mark.parametrize("source", ["RR98 Eq. 4b", "RR98 45", "RR98 Eqs 5-3", "RR98 page 2", "RR98 Sec. 3",
                                    "a friend"])
def test_what_is_no_place_is_refused_by_the_claim_in_one_line(source):
    with pytest.raises(ValueError, match=r"claim c: source .* is (no place: write|not a citation: begin)"):
        Claim(id="c", source=source, statement="", undecidable="not printed")


def test_a_claim_decides_all_or_some_of_what_its_source_names():
    def decides(headline: bool | str) -> str:
        claim = Claim(id="c", source="RR98 Eqs 3-5", statement="", undecidable="no number", headline=headline)
        return listed(claim.decides)
    assert [decides(False), decides("Eq. 4")] == ["", "RR98 Eq. 4"]
    assert decides(True) == "RR98 Eq. 3; RR98 Eq. 4; RR98 Eq. 5"
    with pytest.raises(ValueError, match=r"claim c: headline RR98 Eq. 6 is not in source"):
        decides("Eqs 5, 6")


def test_evidence_is_the_named_figure_and_the_tables_that_a_value_reads():
    def value(tables: Tables) -> tuple[float, float]:
        return float(tables["rows"]["x"].iloc[0] + ("other" in tables) + len(tables.get("more", ()))), 0.0
    claim = Claim(id="c", source="RR98 Eq. 3", statement="", value=value, at_least=0, because="a test",
                  evidence="toy/rows.png")
    [row] = judge([claim], Tables(rows=pd.DataFrame({"x": [1.0]}), other=pd.DataFrame()), "toy")
    assert row["evidence"] == "toy/rows.png; toy/rows.csv"


def test_each_equation_and_figure_of_both_papers_has_one_line_and_so_has_all_that_claims_cite():
    assert len(NAMED) == len({*NAMED})
    numbered = {*map(str, places("RR98 Eqs 1-51") + places("KHP95 Eqs 1-3, Figs 1-12"))}
    cited = {place for cell in CLAIMS["equation"] for place in cell.split("; ")
             if place.startswith(("RR98", "KHP95"))}
    assert numbered | cited == {*NAMED}


def test_one_to_three_claims_decide_what_is_tested():
    decided = Counter(place for cell in CLAIMS["headline"] for place in cell.split("; "))
    tested = {str(place) for line in LINES if not line.untested for place in line.places}
    assert all(1 <= decided[place] <= 3 if place in tested else not decided[place] for place in NAMED)


def test_the_file_is_what_the_command_writes():
    assert (RESULTS/"equations.md").read_text() == text(RESULTS), "make report writes it again"


def test_a_changed_verdict_changes_its_lines_or_asks_for_other_words():
    for line in LINES:
        before = cells(line, CLAIMS, RESULTS)
        names = {str(place) for place in line.places}
        for at in CLAIMS.index[[not names.isdisjoint(cell.split("; ")) for cell in CLAIMS["headline"]]]:
            changed = CLAIMS.copy()
            changed.loc[at, "verdict"] = OTHER[changed["verdict"][at]]
            try:
                assert cells(line, changed, RESULTS) != before
            except NoReport as told:
                assert "write the line anew" in str(told)


@pytest.mark.parametrize(("line", "words"), [
    ({"at": "RR98 Eq. 5", "condition": "it rains"}, "'it rains' does not fit fails"),
    ({"at": "RR98 Eq. 45"}, "condition '' does not fit"), ({"at": "RR98 Eq. 7"}, "has 0 claims that decide"),
    ({"at": "RR98 Eq. 5", "untested": "why?"}, "has 1 claims that decide"),
    ({"at": "RR98 Eq. 5", "why": "{rr98-eq5}"}, "no claim rr98-eq5,"),
    ({"at": "RR98 Eq. 5", "why": "`own-eq5`"}, "no claim own-eq5,"),
    ({"at": "RR98 Eq. 5", "why": "{khp95-list-cost}"}, "khp95-list-cost has no number")])
def test_words_that_do_not_fit_the_claims_are_refused(line, words):
    with pytest.raises(NoReport, match=words):
        cells(Account(says="", **line), CLAIMS, RESULTS)


def test_numbers_have_the_digits_that_are_asked_for():
    claim = pd.Series({"measured": -0.0123, "err": 0.0004}, name="c")
    forms = ("", "%", ".3f", "%.0f", ".0e")
    assert [number(claim, form) for form in forms] == ["−0.0123(4)", "−1.23(4) %", "−0.012", "−1 %", "−1e−2"]
