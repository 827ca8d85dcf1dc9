"""A study made of parts: what each brings is there once, and what two bring under one name is refused."""
from dataclasses import dataclass, replace

import pytest

from studies.kit.case import Case, Outcome
from studies.kit.claim import Claim
from studies.kit.figure import Drawing, Drawings, figure
from studies.kit.study import Part, Study, main
from studies.kit.table import Table


@dataclass(frozen=True, kw_only=True)
class Power(Case):
    x: float
    exponent: int

    def run(self, report, folder):
        return Outcome({f"power{self.exponent}": [{"x": self.x, "y": self.x**self.exponent}]})


def table(name):
    return Table(name, key=["x"], columns=["x", "y"], about="a test")


def halves(tables):
    return {"halves": [{"x": row.x, "y": row.y/2} for row in tables["power2"].itertuples()]}


def quarters(tables):
    """Of what the first part derives in the same run."""
    return {"quarters": [{"x": row.x, "y": row.y/2} for row in tables["halves"].itertuples()]}


def page(rows):
    return figure()[0]


PAGES = Drawings(Drawing("squares", ("power2",), page))
LARGE = Claim(id="large", source="KHP95, Sec. V", statement="quarters grow", at_least=1, because="by hand",
              value=lambda tables: (tables["quarters"].y.max(), 0.0))
SQUARES = Part(cases=lambda size: [Power(x=2.0, exponent=2)], tables=(table("power2"), table("halves")),
               derive=halves, figures=PAGES)
CUBES = Part(cases=lambda size: [Power(x=3.0, exponent=3)], tables=(table("power3"), table("quarters")),
             derive=quarters,
             claims=(LARGE,))


def test_a_study_of_parts_has_what_all_of_them_bring(tmp_path, capsys):
    study = Study.of("toy", "Do powers grow?", [SQUARES, CUBES])
    tables = study.run("paper", workers=1, out=tmp_path)
    values = {name: list(frame.y) for name, frame in tables.items()}
    assert values == {"power2": [4], "halves": [2], "power3": [27], "quarters": [1]}
    assert [path.name for path in study.draw(tmp_path)] == ["squares.png"]
    assert [row["verdict"] for row in study.judge(tmp_path)] == ["holds"]
    with pytest.raises(SystemExit, match="0"):
        main(study, ["--help"])
    assert "Do powers grow?" in capsys.readouterr().out


@pytest.mark.parametrize(("other", "words"), [
    (replace(CUBES, tables=(table("halves"),)), "two tables of one study are called 'halves'"),
    (replace(CUBES, claims=(LARGE, LARGE)), "two claims of one study are called 'large'"),
    (replace(CUBES, figures=PAGES), "two figures of one study are called 'squares'")])
def test_two_things_of_one_name_are_refused_when_a_study_is_made(other, words):
    with pytest.raises(ValueError, match=words):
        Study.of("toy", "", [SQUARES, other])


def test_two_derived_tables_of_one_name_are_refused_when_they_are_made(tmp_path):
    with pytest.raises(ValueError, match="two derived tables of one study are called 'halves'"):
        Study.of("toy", "", [SQUARES, replace(CUBES, derive=halves)]).run("paper", workers=1, out=tmp_path)
