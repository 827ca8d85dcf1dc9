"""Bad input of the report is told with the way out, an older page stays."""
import sys

import pandas as pd
import pytest
from PIL import Image
from report_tables import claims, errors, one_study

from studies.kit.csvfile import write
from studies.report import films as draw
from studies.report.__main__ import main
from studies.report.inventory import NoReport
from studies.report.page import FILMS, ffmpeg, write_page


@pytest.fixture
def small(tmp_path):
    return one_study(tmp_path/"results")


def refused(out, capsys) -> str:
    """What the command says when it fails; the page that was there stays."""
    before = (out/"index.html").read_text() if (out/"index.html").exists() else None
    assert main(["--out", str(out)]) == 1
    after = (out/"index.html").read_text() if (out/"index.html").exists() else None
    assert after == before and not list(out.glob(".index*"))
    return capsys.readouterr().err


def test_a_report_without_results_says_what_to_run(tmp_path, capsys):
    assert "make study-rb" in refused(tmp_path, capsys)
    assert "make study-rb" in refused(tmp_path/"nowhere", capsys)


@pytest.mark.parametrize(("file", "content", "words"), [
    ("claims.csv", claims().drop(columns="verdict"), "claims.csv has no column verdict"),
    ("claims.csv", None, "claims.csv does not exist"),
    ("rb/errors.csv", errors().drop(columns="error_err"), "rb/errors.csv has no column error_err"),
    ("rb/errors.csv", 'a,b\n1,2\n3,4,5,6\n"', "rb/errors.csv is no table"),
    ("rb/errors.csv", "", "rb/errors.csv is no table")])
def test_a_file_that_is_missing_or_wrong(small, capsys, file, content, words):
    write_page(small)
    if content is None:
        (small/file).unlink()
    elif isinstance(content, str):
        (small/file).write_text(content)
    else:
        write(small/file, content, head=["x"])
    assert words in refused(small, capsys)


def test_a_figure_that_is_broken(small, capsys):
    write_page(small)
    (small/"rb/toy.png").write_bytes((small/"rb/toy.png").read_bytes()[:40])
    assert "toy.png is no picture" in refused(small, capsys)


def test_a_link_that_leads_out_of_the_folder(small, tmp_path, capsys):
    write_page(small)
    (tmp_path/"secret.md").write_text("secret")
    (small/"findings.md").unlink(missing_ok=True)
    (small/"findings.md").symlink_to(tmp_path/"secret.md")
    assert "findings.md leads out of" in refused(small, capsys)


def test_a_film_that_is_missing_or_broken(small, capsys):
    words = {"method": "gone", "caption": "c", "size": "fine", "commit": "abc"}
    row = {**dict.fromkeys(FILMS.columns, 1.0), "seed": 1, **words}
    write(small/"films/films.csv", pd.DataFrame([row]), head=["x"])
    assert "gone.mp4 is missing: make films" in refused(small, capsys)
    draw.write(small/"films/gone.mp4", [Image.new("RGB", (64, 32))])
    kept = (small/"films/gone.mp4").read_bytes()
    for broken in (b"", b"no film", kept[:100], kept[:-200]):
        (small/"films/gone.mp4").write_bytes(broken)
        assert "gone.mp4 is no film" in refused(small, capsys)


def test_without_what_reads_films_the_way_out_is_told(monkeypatch):
    monkeypatch.setitem(sys.modules, "imageio_ffmpeg", None)
    with pytest.raises(NoReport, match=r"films need the package imageio-ffmpeg .*: make report installs it"):
        ffmpeg()


@pytest.mark.parametrize("fails", [("-f", "mp4", "-preset", "nonsense"), ("-f", "mp4", "-frames:v", "1")])
def test_a_film_that_cannot_be_written(tmp_path, monkeypatch, fails):
    """At once, or without a word with a part of the pictures: the one that was there stays."""
    path = tmp_path/"film.mp4"
    path.write_bytes(b"older")
    monkeypatch.setattr(draw, "ENCODING", fails)
    with pytest.raises(ValueError, match=r"film.mp4 could not be written .*rm .venv/ready-films"):
        draw.write(path, [Image.new("RGB", (640, 320))]*2)
    assert path.read_bytes() == b"older" and [*tmp_path.iterdir()] == [path]


def test_a_page_that_is_too_heavy_is_not_written(small, monkeypatch):
    monkeypatch.setattr("studies.report.page.LIMIT", 1000)
    with pytest.raises(NoReport, match=r"the page has .* MB, 0.0 are allowed: draw smaller figures"):
        write_page(small)
    assert not (small/"index.html").exists()
