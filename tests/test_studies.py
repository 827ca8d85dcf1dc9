"""What is said of every study: its cases fill its tables, its tables give its figures and its verdicts."""
from dataclasses import replace

import matplotlib.pyplot as plt
import pandas as pd
import pytest

from studies.kit.case import Case
from studies.kit.claim import COLUMNS, judge, paper_of
from studies.kit.csvfile import read
from studies.kit.study import Study, names, study_of
from studies.kit.sweep import RESULTS, load
from studies.kit.table import SIZES, Tables

#: class of cases -> fields with which one of them is cheaper than any of size quick
SMALLER = {"Nonlinear": {"counts": (3, 3), "time": 93.0}}


@pytest.fixture(scope="module", params=names())
def study(request) -> Study:
    return study_of(request.param)


def kinds(study: Study) -> list[Case]:
    """The cheapest quick case of each class, smaller still where it can be."""
    cases = sorted(study.cases("quick"), key=lambda case: -case.cost)
    cheapest = {type(case): case for case in cases}
    return [replace(case, **SMALLER.get(kind.__name__, {})) for kind, case in cheapest.items()]


def test_the_question_is_one_sentence(study):
    assert study.question.strip().endswith("?") and len(study.question) < 140


def test_ids_say_whose_statement_it_is_and_what_a_paper_or_another_author_prints_is_beside_it(study):
    papers = ("KHP95", "RR98")
    for claim in study.claims:
        author, name = paper_of(claim.source), claim.id.split("-")[0]
        known = {"paper": papers, "own": (author,), "other": {author} - {*papers}}[claim.whose]
        assert author in known and (claim.whose != "paper" or name == author.lower()), claim.id
        assert bool(claim.printed) == (claim.whose != "own"), claim.id


@pytest.mark.parametrize("size", SIZES)
def test_every_case_has_its_own_label_and_key(study, size):
    cases = list(study.cases(size))
    assert cases and len({case.key for case in cases}) == len({repr(case) for case in cases})


def test_each_kind_of_case_fills_tables_of_the_study_and_runs_once(study, tmp_path, monkeypatch):
    monkeypatch.setattr("studies.noise.sampling.BATCHES", 4)
    small = replace(study, cases=lambda size: kinds(study))
    tables = small.run("quick", workers=1, out=tmp_path)
    assert set(tables) <= {table.name for table in study.tables} and any(map(len, tables.values()))
    for case in kinds(study):
        monkeypatch.setattr(type(case), "run", lambda *_: pytest.fail("a finished case runs again"))
    again = small.run("quick", workers=1, out=tmp_path)
    assert all(tables[name].equals(again[name]) for name in tables)


def same(made: pd.DataFrame, known: pd.DataFrame, key: list[str]) -> None:
    """Rows that are made are those that are known by this key."""
    kept = made[key].merge(known, how="left")[list(made)]
    pd.testing.assert_frame_equal(made, kept, check_dtype=False, rtol=1e-6, atol=1e-12)


def test_committed_rows_give_the_committed_rows_that_follow_from_them(study):
    known = load(study.tables, study.name, RESULTS)
    made = study.derive(known)
    for table in study.tables:
        if made.get(table.name):
            rows = pd.DataFrame(made[table.name]).reindex(columns=table.columns)
            same(rows, known[table.name], table.key)


def test_committed_tables_give_the_committed_verdicts_and_none_cannot_tell(study, tmp_path, monkeypatch):
    rows = pd.DataFrame(judge(study.claims, load(study.tables, study.name, RESULTS), study.name))
    known = read(RESULTS/"claims.csv", COLUMNS).query("study == @study.name")
    assert len(rows) == len(known)
    same(rows[["id", "measured", "err", "verdict"]], known, ["id"])
    monkeypatch.setattr("studies.kit.ask.RESULTS", tmp_path)        # some read tables of the bench
    told = [row["id"] for row in judge(study.claims, Tables(), study.name) if row["verdict"] != "undecidable"]
    assert told == []


def test_figures_are_drawn_from_committed_tables_and_none_without(study):
    pages = study.figures(load(study.tables, study.name, RESULTS))
    pictures = {path.stem for path in (RESULTS/study.name).glob("*.png")}
    plt.close("all")
    assert set(pages) == pictures
    assert study.figures(Tables()) == {}
