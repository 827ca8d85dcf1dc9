"""Committed tables read right with pandas alone; their columns and names are explained."""
import gzip
import re
import subprocess

import pandas as pd
import pytest
from PIL import Image

from studies.build import SCENES, names
from studies.front.solving import ALL
from studies.kit.csvfile import EMPTY, content, read
from studies.kit.key import ROOT
from studies.kit.store import RESULTS
from studies.kit.table import SPENT, STAMP
from studies.report.inventory import NoReport
from studies.report.tables import COLUMNS, folders, meaning, text

LONGEST = 500_000       # characters of a table that is not packed: what public sites show as a table
FILES = sorted(path for path in [*RESULTS.glob("*.csv"), *RESULTS.glob("*/*.csv*")]
               if path.parent.name not in ("raw", "quick", "own"))
TABLES = [(folder, table) for folder, tables in folders() for table in tables]


@pytest.mark.parametrize("path", FILES, ids=lambda path: f"{path.parent.name}/{path.name}")
def test_a_table_is_complete_for_pandas_alone(path):
    plain, ours = pd.read_csv(path, comment="#"), read(path)
    pd.testing.assert_frame_equal(plain.replace(EMPTY, ""), ours)
    texts = plain.select_dtypes(exclude=["number", "bool"])
    assert not texts.isna().any(axis=None), "an empty text has a word, so that it is no missing number"
    assert path.suffix == ".gz" or len(content(path)) < LONGEST, "large=True packs a table"


def test_no_committed_file_names_a_path_of_a_machine():
    names = subprocess.run(["git", "-C", ROOT, "ls-files", "-z"], capture_output=True, text=True).stdout
    if not names:
        pytest.skip("no repository")
    path = re.compile(rb"(?<![\w.)}>])/(?:home|root|tmp|work|opt|Users|mnt|private|var|srv)/\w")
    found = {}
    for name in filter(None, names.split("\0")):
        raw = (ROOT/name).read_bytes()
        whole = gzip.decompress(raw) if name.endswith(".gz") else raw
        if name.endswith(".png"):
            with Image.open(ROOT/name) as picture:
                whole += repr(picture.info).encode()        # texts may be packed in the file
        if match := path.search(whole):
            found[name] = whole[max(0, match.start() - 40):match.end() + 40]
    assert not found


@pytest.mark.parametrize("folder, table", TABLES, ids=lambda one: getattr(one, "name", one))
def test_each_column_of_each_table_has_a_meaning(folder, table):
    assert table.about.endswith((".", "?"))
    told = {*table.columns, *SPENT, *STAMP}
    assert not set(read(RESULTS/folder/table.file)) - told
    for column in table.columns:
        base = column.removesuffix("_err")
        assert all(meaning(table, base if base in table.columns else column)[:1])
    assert not [name for name, words in table.means.items() if COLUMNS.get(name) == words], "said twice"


def test_columns_of_the_dictionary_are_those_of_tables():
    used = {name for _, table in TABLES for name in table.columns if name not in table.means}
    assert {*COLUMNS} - used <= {*STAMP}, "no table has it"
    named = {name for _, table in TABLES for name in table.columns}
    assert not {name for _, table in TABLES for name in table.means} - named
    with pytest.raises(NoReport, match="column speeed of table kinetic_energy has no meaning: give it"):
        meaning(TABLES[0][1], "speeed")


def test_the_list_of_tables_is_up_to_date():
    assert (RESULTS/"tables.md").read_text() == text(), "python -m studies.report tables writes it"


def test_each_file_is_in_the_list():
    listed = {(RESULTS/folder/table.file).resolve() for folder, table in TABLES}
    assert {path.resolve() for path in FILES} - listed == {RESULTS/"claims.csv"}


# --- names --------------------------------------------------------------------------------------------

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
    for table in (RESULTS/study).glob("*.csv*"):
        frame = read(table)
        for column in {*NAMED} & {*frame}:
            assert {*frame[column]} <= {*NAMED[column]}, (table.name, column)


def test_methods_with_variants_have_names_too():
    pairs = {pair for table in ("rb/means", "rb/walls", "onset/critical_ra")
             for pair in read(RESULTS/f"{table}.csv")[["method", "variant"]].itertuples(index=False)}
    assert all(names.name_of(*pair) for pair in pairs), [pair for pair in pairs if not names.name_of(*pair)]
    assert names.name_of("spam", "printed-monaghan") == "spam-monaghan" and not names.name_of("spam", "new")
