"""One name in code, tables and figures, and a sentence for each."""
import pytest

from studies.build import SCENES, names
from studies.front.solving import ALL
from studies.kit.csvfile import read
from studies.kit.key import ROOT

NAMES = {**names.METHODS, **names.VARIATIONS}
#: columns of tables -> what their texts name
NAMED = {"method": NAMES, "rival": NAMES, "base": NAMES, "quantity": names.QUANTITIES}


def test_every_name_has_its_word():
    assert {*ALL} == {*names.METHODS} and {*SCENES} == {*names.SCENES}
    assert not {*names.METHODS} & {*names.VARIATIONS}
    assert "spam-wendland-c2" in names.explained("Wendland") and "moving" not in names.explained("Wendland")
    assert "no name and no sentence has 'xyz'" in names.explained("xyz")


@pytest.mark.parametrize("study", ["cost", "hardcases", "operators"])
def test_every_name_in_tables_is_a_word(study):
    for table in (ROOT/"results"/study).glob("*.csv*"):
        frame = read(table)
        for column in {*NAMED} & {*frame}:
            assert {*frame[column]} <= {*NAMED[column]}, (table.name, column)


def test_methods_with_variants_have_names_too():
    pairs = {pair for table in ("rb/means", "rb/walls", "onset/critical_ra")
             for pair in read(ROOT/f"results/{table}.csv")[["method", "variant"]].itertuples(index=False)}
    assert all(names.name_of(*pair) for pair in pairs), [pair for pair in pairs if not names.name_of(*pair)]
    assert names.name_of("spam", "printed-monaghan") == "spam-monaghan" and not names.name_of("spam", "new")
