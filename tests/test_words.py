"""One name in code, tables and figures, and a sentence for each."""
import pytest

from studies.build import SCENES, words
from studies.front.solving import ALL
from studies.kit.csvfile import read
from studies.kit.key import ROOT

NAMES = {**words.METHODS, **words.VARIATIONS}
#: columns of tables -> what their texts name
NAMED = {"method": NAMES, "rival": NAMES, "base": NAMES, "quantity": words.QUANTITIES}


def test_every_name_has_its_word():
    assert {*ALL} == {*words.METHODS} and {*SCENES} == {*words.SCENES}
    assert not {*words.METHODS} & {*words.VARIATIONS}
    assert "spam-wendland-c2" in words.explained("Wendland") and "moving" not in words.explained("Wendland")
    assert "no name and no sentence has 'xyz'" in words.explained("xyz")


@pytest.mark.parametrize("study", ["cost", "hardcases", "operators"])
def test_every_name_in_tables_is_a_word(study):
    for table in (ROOT/"results"/study).glob("*.csv*"):
        frame = read(table)
        for column in {*NAMED} & {*frame}:
            assert {*frame[column]} <= {*NAMED[column]}, (table.name, column)


def test_methods_with_variants_have_names_too():
    pairs = {pair for table in ("rb/means", "rb/walls", "onset/critical_ra")
             for pair in read(ROOT/f"results/{table}.csv")[["method", "variant"]].itertuples(index=False)}
    assert all(words.name_of(*pair) for pair in pairs), [pair for pair in pairs if not words.name_of(*pair)]
    assert words.name_of("spam", "printed-monaghan") == "spam-monaghan" and not words.name_of("spam", "new")
