"""The page from texts and tables: what is in it, where its links lead, films; what is wrong is told."""
import math
import re
import sys
import tomllib

import numpy as np
import pandas as pd
import pytest
from imageio_ffmpeg import read_frames
from PIL import Image

from continuum.scene import RayleighBenard
from studies.build.names import START_ENERGY
from studies.kit.csvfile import read, write
from studies.kit.figure import Drawing, Drawings
from studies.kit.store import RESULTS
from studies.kit.study import Study
from studies.report import films, inventory, page, text
from studies.report.__main__ import main
from studies.report.equations import with_error
from studies.report.inventory import NoReport, claims_of, folders
from studies.report.page import PARTS, embedded, figures, render
from studies.report.tables import FILMS
from studies.report.text import examples, scripts

ERRORS, CLAIMS = (read(RESULTS/name).head(3) for name in ("rb/errors.csv", "claims.csv"))
HEAD = ["commit abc1234567"]


@pytest.fixture
def small(tmp_path):
    """Results of one study: a table, a figure, three claims."""
    out = tmp_path/"results"
    write(out/"rb/errors.csv", ERRORS, head=HEAD)
    write(out/"claims.csv", CLAIMS.assign(study="rb", statement="three <b>& more"), head=HEAD)
    Image.new("RGB", (200, 100), "white").save(out/"rb/fig12.png")
    return out


@pytest.fixture(scope="module")
def committed():
    return folders(RESULTS)


def made(out) -> str:
    """The page that the command writes."""
    assert main(["--out", str(out)]) == 0
    return (out/"index.html").read_text()


def test_the_page_is_one_file_and_the_same_again(small):
    whole = made(small)
    assert made(small) == whole
    assert "three &lt;b&gt;&amp; more" in whole and "<b>& more" not in whole
    assert not any(link in whole for link in ('src="http', 'href="http', "@import", "url("))
    assert whole.count('<tr id="claim-') == 3 and "abc1234567" in whole
    assert 'id="figure-rb-fig12"' in whole and embedded(small/"rb/fig12.png") in whole


def test_the_page_begins_as_the_readme_does(small, monkeypatch):
    begins = text.opening(small)
    assert begins["question"].startswith("Do fluid particles converge") and begins["words"].count("<li>") == 5
    assert '<a class="word" href="#word-moving-delaunay"><code>moving-delaunay</code></a>' in begins["choice"]
    monkeypatch.setattr(text, "ROOT", small)
    (small/"README.md").write_text("# Title\n\nNo question.\n\n## More\n")
    with pytest.raises(NoReport, match=r"does not begin with a bold question.*: let it begin so"):
        text.opening(small)


def test_examples_have_small_pictures(tmp_path, capsys):
    assert [one["name"] for one in examples(RESULTS)] == [path.stem for path in scripts()]
    assert main(["gallery", "--out", str(tmp_path)]) == 1
    assert "python -m examples.convection" in capsys.readouterr().err
    (tmp_path/"own").mkdir()
    Image.new("RGB", (1600, 400), "red").save(tmp_path/"own/convection.png")
    assert main(["gallery", "--out", str(tmp_path)]) == 0
    one, = examples(tmp_path)
    assert one["about"].startswith("Convection at Ra 10 000") and "import" in one["script"]
    assert Image.open(one["picture"]).size == (960, 240)


def toy(errors):
    """K over the height.

    Not a part of the caption.
    """


def test_a_figure_is_shown_with_the_tables_and_the_code_that_its_study_lists(small, monkeypatch):
    """Others, such as fig12, which this study does not list, are not shown."""
    study = Study(name="rb", question="Why?", cases=lambda size: [], tables=[],
                  figures=Drawings(Drawing("toy", ("errors",), toy)))
    monkeypatch.setattr(inventory, "study_of", lambda part: study)
    write(small/"rb/more.csv", ERRORS, head=["commit def"])
    Image.new("RGB", (20, 10)).save(small/"rb/toy.png")
    part, = folders(small)
    one, = figures(part, claims_of(small))
    assert (one.caption, one.see, one.made) == ("K over the height.", "K over the height.", "abc1234567")
    assert [sheet.stem for sheet in one.sheets] == ["errors"]
    assert one.code[1] == "toy" and (small/one.code[0]).samefile(__file__)


def test_every_figure_says_in_a_sentence_what_to_see(committed):
    """With the numbers of claims; no sentence is of a figure that is not there."""
    told = tomllib.loads((PARTS/"figures.toml").read_text())
    there = {part.name: {png.stem for png in part.pictures} for part in committed if part.pictures}
    assert {study: {*sentences} for study, sentences in told.items()} == there
    for part in committed:
        for one in figures(part, claims_of(RESULTS)):
            assert one.see.endswith(".") and "% %" not in one.see and len(one.see) < 200, one.name


@pytest.mark.parametrize(("value", "err", "said"), [
    (17.5, 1.5, "17.5(15)"), (-0.42, 0.096, "−0.42(10)"), (2369.2, 80.8, "2369(81)"), (1.0, 0.0, "1"),
    (0.0349, 0.0445, "0.03(4)"), (math.nan, 0.1, "none")])
def test_numbers_with_their_errors(value, err, said):
    assert with_error(value, err) == said


def test_results_as_they_are_make_a_page(committed):
    """All claims are in it; links within it and to files lead somewhere; listed figures have their tables."""
    whole = render(RESULTS, committed)
    assert len(whole.encode()) < 8e6
    assert whole.count('<tr id="claim-') == len(claims_of(RESULTS))
    names = re.findall(r'\bid="([^"]*)"', whole)
    assert len(names) == len({*names})
    links = {*re.findall(r'href="([^"]*)"', whole)} - {"data:,"}
    lost = [link for link in links
            if not (link[1:] in names if link[0] == "#" else (RESULTS/link.split("#")[0]).exists())]
    assert not lost and len(links) > 200
    for part in committed:
        tables = {sheet.stem for sheet in part.sheets}
        for png, drawing in part.pictures.items():
            assert set(drawing.tables) <= tables, png


def test_a_film_shows_points_and_the_grid_and_is_the_same_again(tmp_path):
    """Both start from the same rolls and gain or lose energy from there; all pictures are there."""
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


# --- bad input: the way out is told, an older page stays ----------------------------------------------------


def refused(out, capsys) -> str:
    """What the command says when it fails."""
    out.mkdir(exist_ok=True)
    (out/"index.html").write_text("older")
    assert main(["--out", str(out)]) == 1
    assert (out/"index.html").read_text() == "older" and not list(out.glob(".index*"))
    return capsys.readouterr().err


def test_a_report_without_results_says_what_to_run(tmp_path, capsys):
    assert "make study-rb" in refused(tmp_path, capsys)
    assert "make study-rb" in refused(tmp_path/"nowhere", capsys)


@pytest.mark.parametrize(("file", "content", "words"), [
    ("claims.csv", CLAIMS.drop(columns="verdict"), "claims.csv has no column verdict"),
    ("claims.csv", None, "claims.csv does not exist"),
    ("rb/errors.csv", ERRORS.drop(columns="error_err"), "rb/errors.csv has no column error_err"),
    ("rb/errors.csv", 'a,b\n1,2\n3,4,5,6\n"', "rb/errors.csv is no table"),
    ("rb/fig12.png", "no picture", "fig12.png is no picture")])
def test_a_file_that_is_missing_or_wrong(small, capsys, file, content, words):
    (small/file).unlink()
    if isinstance(content, str):
        (small/file).write_text(content)
    elif content is not None:
        write(small/file, content, head=["x"])
    assert words in refused(small, capsys)


def test_a_link_that_leads_out_of_the_folder(small, tmp_path, capsys):
    (tmp_path/"secret.md").write_text("secret")
    (small/"findings.md").symlink_to(tmp_path/"secret.md")
    assert "findings.md leads out of" in refused(small, capsys)


def test_a_film_that_is_missing_or_broken(small, capsys):
    row = {**dict.fromkeys(FILMS.columns, 1.0), "seed": 1, "method": "gone", "caption": "c", "commit": "abc"}
    write(small/"films/films.csv", pd.DataFrame([row]), head=["x"])
    assert "gone.mp4 is missing: make films" in refused(small, capsys)
    films.write(small/"films/gone.mp4", [Image.new("RGB", (64, 32))])
    kept = (small/"films/gone.mp4").read_bytes()
    for broken in (b"", b"no film", kept[:100], kept[:-200]):
        (small/"films/gone.mp4").write_bytes(broken)
        assert "gone.mp4 is no film" in refused(small, capsys)


@pytest.mark.parametrize("fails", [("-f", "mp4", "-preset", "nonsense"), ("-f", "mp4", "-frames:v", "1")])
def test_a_film_that_cannot_be_written_leaves_the_one_that_was_there(tmp_path, monkeypatch, fails):
    """Nor does one with a part of the pictures, which ffmpeg leaves without a word, replace it."""
    path = tmp_path/"film.mp4"
    path.write_bytes(b"older")
    monkeypatch.setattr(films, "ENCODING", fails)
    with pytest.raises(ValueError, match=r"film.mp4 could not be written .*rm .venv/ready-films"):
        films.write(path, [Image.new("RGB", (640, 320))]*2)
    assert path.read_bytes() == b"older" and [*tmp_path.iterdir()] == [path]


def test_without_what_reads_films_and_for_a_heavy_page_the_way_out_is_told(small, monkeypatch):
    monkeypatch.setattr(page, "LIMIT", 1000)
    with pytest.raises(NoReport, match=r"the page has .* MB, 0.0 are allowed: draw smaller figures"):
        page.text(small)
    monkeypatch.setitem(sys.modules, "imageio_ffmpeg", None)
    with pytest.raises(NoReport, match=r"films need the package imageio-ffmpeg .*: make report installs it"):
        page.ffmpeg()
