"""The page from texts and tables: what is in it, where its links lead, films."""
import math
import re
import tomllib

import numpy as np
import pytest
from imageio_ffmpeg import read_frames
from PIL import Image
from report_tables import committed, errors, one_study

from studies.kit.claim import paper_of
from studies.kit.csvfile import write
from studies.kit.figure import Drawing, Drawings
from studies.kit.store import RESULTS
from studies.kit.study import Study
from studies.report import inventory, text
from studies.report.__main__ import main
from studies.report.equations import with_error
from studies.report.inventory import claims_of, folders
from studies.report.page import PARTS, embedded, figures, render, write_page
from studies.report.text import examples, scripts


@pytest.fixture
def small(tmp_path):
    return one_study(tmp_path/"results")


def test_the_page_is_one_file_and_the_same_again(small):
    page = write_page(small).read_text()
    assert write_page(small).read_text() == page
    assert "three &lt;b&gt;&amp; more" in page and "<b>& more" not in page
    assert not any(link in page for link in ('src="http', 'href="http', "@import", "url("))
    assert page.count('<tr id="claim-') == 3 and "abc1234567" in page
    assert 'id="figure-rb-toy"' in page and embedded(small/"rb/toy.png") in page


def test_the_page_begins_as_the_readme_does(small, monkeypatch):
    begins = text.opening(small)
    assert begins.question.startswith("Do fluid particles converge") and begins.words.count("<li>") == 5
    assert '<a class="word" href="#word-moving-delaunay"><code>moving-delaunay</code></a>' in begins.choice
    monkeypatch.setattr(text, "ROOT", small)
    (small/"README.md").write_text("# Title\n\nNo question.\n\n## More\n")
    with pytest.raises(inventory.NoReport, match=r"does not begin with a bold question.*: let it begin so"):
        text.opening(small)


def test_examples_have_small_pictures(tmp_path, capsys):
    assert main(["gallery", "--out", str(tmp_path)]) == 1
    assert "python -m examples.convection" in capsys.readouterr().err
    (tmp_path/"own").mkdir()
    Image.new("RGB", (1600, 400), "red").save(tmp_path/"own/convection.png")
    assert main(["gallery", "--out", str(tmp_path)]) == 0
    one, = examples(tmp_path)
    assert one.about.startswith("Convection at Ra 10 000") and "import" in one.script
    assert Image.open(one.picture).size == (960, 240)


def test_every_example_is_in_the_gallery():
    assert [one.name for one in examples(RESULTS)] == [path.stem for path in scripts()]


def toy(errors):
    """K over the height.

    Not a part of the caption.
    """


def test_a_figure_is_shown_with_the_tables_and_the_code_that_its_study_lists(small, monkeypatch):
    """Others with all tables of their study, and its question."""
    study = Study(name="rb", question="Why?", cases=lambda size: [], tables=[],
                  figures=Drawings(Drawing("toy", ("errors",), toy)))
    monkeypatch.setattr(inventory, "study_of", lambda part: study)
    write(small/"rb/more.csv", errors(), head=["commit def"])
    Image.new("RGB", (20, 10)).save(small/"rb/old.png")
    part, = folders(small)
    old, one = figures(part, claims_of(small))
    assert (one.caption, one.see, one.made) == ("K over the height.", "K over the height.", "abc1234567")
    assert [sheet.stem for sheet in one.sheets] == ["errors"]
    assert one.code[1] == "toy" and (small/one.code[0]).samefile(__file__)
    assert len(old.sheets) == 2 and old.caption == f"old: {part.question}" and old.code is None


def test_every_figure_says_in_a_sentence_what_to_see():
    """With the numbers of claims; no sentence is of a figure that is not there."""
    told = tomllib.loads((PARTS/"figures.toml").read_text())
    there = {part.name: {png.stem for png in part.pictures} for part in committed() if part.pictures}
    assert {study: {*sentences} for study, sentences in told.items()} == there
    for part in committed():
        for one in figures(part, claims_of(RESULTS)):
            assert one.see.endswith(".") and "% %" not in one.see and len(one.see) < 200, one.name


@pytest.mark.parametrize(("value", "err", "said"), [
    (17.5, 1.5, "17.5(15)"), (-0.42, 0.096, "−0.42(10)"), (2369.2, 80.8, "2369(81)"), (1.0, 0.0, "1"),
    (0.0349, 0.0445, "0.03(4)"), (math.nan, 0.1, "none")])
def test_numbers_with_their_errors(value, err, said):
    assert with_error(value, err) == said
    assert paper_of("Sangani & Acrivos 1982, Table 1") == "Sangani & Acrivos 1982"


def test_a_film_shows_points_and_the_grid_and_is_the_same_again(tmp_path):
    """Both start from the same rolls and gain or lose energy from there; all pictures are there."""
    from continuum.scene import RayleighBenard
    from studies.build.names import START_ENERGY
    from studies.report import films
    times, scene = np.array([0.0, 0.1]), RayleighBenard(ra=1e4, L=16.0)
    grids = list(films.grid(scene, 16, times))
    for name in films.CAPTIONS:
        dots = list(films.points(name, scene, times))
        # particles lie at random: their sum of squares is not the integral, by 2/sqrt(512)
        assert dots[0].ke == pytest.approx(START_ENERGY, rel=0.09) and dots[1].ke != dots[0].ke
        assert np.abs(dots[0].T - 1).max() <= 0.5 + 1e-12 and np.abs(dots[1].x[:, 1]).max() <= 0.5
    for name in ("one", "two"):
        films.write(tmp_path/f"{name}.mp4", list(films.pages(dots, grids, times, ("dots", "grid"))))
    about, *shown = read_frames(tmp_path/"one.mp4")
    assert (about["codec"], about["size"], len(shown)) == ("h264", (640, 320), 2 + films.HOLD)
    assert (tmp_path/"one.mp4").read_bytes() == (tmp_path/"two.mp4").read_bytes()


def test_results_as_they_are_make_a_page():
    """All claims are in it; links within it and to files lead somewhere; listed figures have their tables."""
    page = render(RESULTS, committed())
    assert len(page.encode()) < 8e6
    assert page.count('<tr id="claim-') == len(claims_of(RESULTS))
    names = re.findall(r'\bid="([^"]*)"', page)
    assert len(names) == len({*names})
    links = {*re.findall(r'href="([^"]*)"', page)} - {"data:,"}
    lost = [link for link in links
            if not (link[1:] in names if link[0] == "#" else (RESULTS/link.split("#")[0]).exists())]
    assert not lost and len(links) > 200
    for part in committed():
        tables = {sheet.stem for sheet in part.sheets}
        for name, drawing in inventory.drawings(part).items():
            assert set(drawing.tables) <= tables, f"{part.name}/{name}"
