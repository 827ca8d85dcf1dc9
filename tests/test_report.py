"""The page from tables: what it says is computed, films, what is committed."""
import base64
import io
import itertools
import math
import re

import numpy as np
import pandas as pd
import pytest
from imageio_ffmpeg import read_frames
from matplotlib.colors import to_rgb
from PIL import Image
from report_tables import committed, errors, one_study

from studies.kit.csvfile import read, write
from studies.kit.figure import COLOURS, Drawing, Drawings, figure, save
from studies.kit.source import paper_of
from studies.kit.store import RESULTS
from studies.kit.study import Part, Study
from studies.report import cost, inventory
from studies.report.findings import Known, answer, claims_of, falls, findings
from studies.report.inventory import folders
from studies.report.numbers import with_error
from studies.report.page import NEAR, accepted, figures, render, webp, write_page


@pytest.fixture
def small(tmp_path):
    return one_study(tmp_path/"results")


def known(out):
    return Known(out, claims_of(out), cost.panels(folders(out)))


def test_the_page_is_one_file_and_the_same_again(small):
    text = write_page(small).read_text()
    assert write_page(small).read_text() == text
    assert "three &lt;b&gt;&amp; more" in text and "<b>& more" not in text
    assert not any(link in text for link in ('src="http', 'href="http', "@import", "url("))
    assert text.count("<tr data-paper=") == 3 and "abc1234567" in text
    assert 'id="figure-rb-toy"' in text and webp(small/"rb/toy.png") in text


def test_what_is_said_comes_from_the_tables(small):
    first = findings(known(small))[0]
    assert "do not converge" in first.title and "−13.200(10)" in first.text
    assert "−20.000(10) % with 16, 25 and 50 rows" in first.text
    assert answer(known(small)).endswith("2 statements of the papers 1 hold, 1 fail, 0 are undecidable here.")
    better = errors().assign(error=lambda rows: rows["error"].where(rows["energy"] != "Kg",
                                                                    -40/rows["resolution"]**2))
    write(small/"rb/errors.csv", better, head=["commit abc1234567"])
    assert "come ever nearer" in findings(known(small))[0].title


def raced(out, methods):
    """Points of these methods, all alike, and what an error costs: method -> (reached, seconds)."""
    about = {"scene": "convection", "quantity": "K", "size": "fine", "commit": "abc1"}
    points = [{**about, "method": name, "resolution": n, "points": n*n, "seeds": 1, "error": 9/n**2,
               "error_err": 1e-5,
               "cpu_s": 1e-4*n**3, "cpu_s_err": 1e-6, "setup_s": 0.0} for name in methods
               for n in (16, 32, 64)]
    needed = [{**about, "method": name, "level": level, "reached": "yes" if cpu else "no",
               "cpu_s": cpu or math.nan,
               "low": 0.96*(cpu or math.nan), "high": 1.04*(cpu or math.nan), "points": 9, "error": level}
              for name, cpu in methods.items() for level in cost.LEVELS]
    write(out/"cost/points.csv", pd.DataFrame(points), head=["commit abc1"])
    write(out/"cost/needed.csv", pd.DataFrame(needed), head=["commit abc1"])


def test_each_family_is_shown_by_its_cheapest_grid_first(small):
    """However its name sorts; what an error costs is what the study's table says, not the next run tried."""
    raced(small, {
        "fixed-jittered-plates": 3.0, "fixed-lattice-h1.2": 0.212, "fixed-lattice": 1.1, "spam": None,
        "spam-monaghan": None, "spam-wendland-c2": 9.0, "grid-edge-heat": 0.62, "grid": 0.161, "moving": 22.0,
        "py-pde": 0.87})
    panel = known(small).panels[0]
    assert panel.title == "cost: convection, K"
    assert [series.label for series in panel.lines if series.usual] == [
        "grid", "fixed-lattice-h1.2", "fixed-jittered-plates", "moving", "spam-wendland-c2", "spam", "py-pde"]
    assert [f"{series.needs[0.01]}" for series in panel.lines[:2]] == ["0.161(6)", "0.212(8)"]
    text = render(small, folders(small), lambda path: "data:,")
    points = sum(len(series.points) for series in panel.lines)
    bars = re.findall(r'class="bar" d="(.*?)"', text)[:points]
    assert len(bars) == points and all("H" in bar for bar in bars), "of error and of seconds"
    last = findings(known(small))[-1]
    assert last.title == "An error of 1 % costs 0.161(6) CPU seconds at best" and last.source == "cost/needed"
    assert "0.161(6) s, grid; 0.212(8) s, fixed-lattice-h1.2; 0.87(3) s" in last.text


def test_what_is_said_of_cost_is_what_the_study_found():
    """Its cheapest method in each panel."""
    needed = read(RESULTS/"cost/needed.csv").query("level == 0.01 and reached != 'no'").sort_values("cpu_s")
    best = needed.groupby(["scene", "quantity"])[["method", "cpu_s"]].first().to_dict("index")
    study, = (folder for folder in committed() if folder.name == "cost")
    panels = [panel for panel in cost.panels([study]) if panel.sheet.name == "cost/points"]
    assert panels
    for panel in panels:
        row = best.get(tuple(panel.title.removeprefix("cost: ").split(", ")), {"method": "not reached"})
        reach = [line for line in panel.lines if line.usual and 0.01 in line.needs]
        mine = min(reach, key=lambda series: series.needs[0.01].cpu_s, default=None)
        assert (mine.label if mine else "not reached") == row["method"], panel.title
        assert mine is None or mine.needs[0.01].cpu_s == row["cpu_s"]


def rows_of_errors(*pairs):
    return pd.DataFrame(pairs, columns=["error", "error_err"])


@pytest.mark.parametrize(("pairs", "converges"), [
    # until it is noise
    ([(0.0277, 0.0015), (0.0089, 0.0016), (0.0047, 0.0016), (0.0018, 0.0016), (0.0003, 0.0021)], True),
    ([(0.02, 1e-4), (0.005, 1e-4)], True), ([(-0.02, 1e-4), (0.001, 0.002)], True),
    ([(0.15, 1e-3), (0.15, 1e-3)], False), ([(0.05, 1e-3), (-0.2, 1e-3)], False),
    ([(0.01, 0.02), (0.005, 0.02)], False),
    ([(0.03, 1e-3), (0.001, 1e-3), (0.02, 1e-3), (0.001, 0.002)], False)])
def test_errors_that_fell_until_they_are_noise_converge(pairs, converges):
    assert falls(rows_of_errors(*pairs)) is converges


# --- figures and their tables ---------------------------------------------------------------------


def toy(errors):
    """K over the height.

    Not a part of the caption.
    """


def test_a_figure_is_shown_with_the_tables_that_its_study_lists(small, monkeypatch):
    """Others with all tables of their study, and its question."""
    listed = Part(cases=lambda size: [], tables=[], figures=Drawings(Drawing("toy", ("errors",), toy)))
    study = Study.of("rb", "Why?", (listed, Part(cases=lambda size: [], tables=[])))
    monkeypatch.setattr(inventory, "study_of", lambda part: study)
    write(small/"rb/more.csv", errors(), head=["commit def"])
    Image.new("RGB", (20, 10)).save(small/"rb/old.png")
    part, = folders(small)
    old, one = figures(part, lambda path: "data:,")
    assert (one.caption, one.made, [sheet.name for sheet in one.sheets]) == ("K over the height.",
                                                                             "abc1234567", ["rb/errors"])
    assert len(old.sheets) == 2 and old.caption == f"old: {part.question}"


def rgb(name):
    return 255*np.array(to_rgb(name))


def test_colours_of_series_stay_apart_in_an_embedded_figure(tmp_path):
    """Thin lines in all colours over a field: none moves by much, all are told from each other."""
    page, axes = figure()
    axes.imshow(np.linspace(0, 1, 10_000).reshape(100, 100), extent=(0, 1, 0, 1), aspect="auto", cmap="gray",
                alpha=0.3)
    for number, colour in enumerate(COLOURS):
        axes.plot([0, 1], [0.1*number, 0.1*number + 0.05], color=colour, linewidth=1.5)
    save(page, tmp_path/"lines.png")
    packed = io.BytesIO(base64.b64decode(webp(tmp_path/"lines.png").split(",")[1]))
    new, old = (np.asarray(Image.open(one).convert("RGB")).astype(int)
                for one in (packed, tmp_path/"lines.png"))
    assert np.linalg.norm(new - old, axis=2).max() <= NEAR
    # 256 colours are not quite matplotlib's
    moved = [new[np.linalg.norm(old - rgb(name), axis=2) <= 3].mean(axis=0) for name in COLOURS]
    assert min(np.linalg.norm(one - other) for one, other in itertools.combinations(moved, 2)) > 40


# --- numbers --------------------------------------------------------------------------------------


@pytest.mark.parametrize(("value", "err", "text"), [
    (17.5, 1.5, "17.5(15)"), (-0.42, 0.096, "−0.42(10)"), (2369.2, 80.8, "2369(81)"), (1.0, 0.0, "1"),
    (0.0349, 0.0445, "0.03(4)"), (math.nan, 0.1, "none")])
def test_numbers_with_their_errors(value, err, text):
    assert with_error(value, err) == text
    assert accepted(-math.inf, 2.0) == "≤ 2" and accepted(1.0, math.inf) == "≥ 1"
    assert paper_of("Sangani & Acrivos 1982, Table 1") == "Sangani & Acrivos 1982"


# --- films ----------------------------------------------------------------------------------------


def test_a_film_shows_points_and_the_grid_and_is_the_same_again(tmp_path):
    """Both start from the same rolls and gain or lose energy from there; all pictures are there."""
    from continuum.scene import RayleighBenard
    from studies.build.names import START_ENERGY
    from studies.report import films
    times, scene = np.array([0.0, 0.1]), RayleighBenard(ra=1e4, L=16.0)
    grids = list(films.grid(scene, 16, times))
    for film in films.MAKERS.values():
        dots = list(films.points(film, scene, times))
        # particles lie at random: their sum of squares is not the integral, by 2/sqrt(512)
        assert dots[0].ke == pytest.approx(START_ENERGY, rel=0.09) and dots[1].ke != dots[0].ke
        assert np.abs(dots[0].T - 1).max() <= 0.5 + 1e-12 and np.abs(dots[1].x[:, 1]).max() <= 0.5
    for name in ("one", "two"):
        films.write(tmp_path/f"{name}.mp4", list(films.pages(dots, grids, times, ("dots", "grid"))))
    about, *shown = read_frames(tmp_path/"one.mp4")
    assert (about["codec"], about["size"], len(shown)) == ("h264", (640, 320), 2 + films.HOLD)
    assert (tmp_path/"one.mp4").read_bytes() == (tmp_path/"two.mp4").read_bytes()


# --- what is committed ----------------------------------------------------------------------------


def test_results_as_they_are_make_a_page():
    """Figures left out, whose packing is tested above; every listed figure has tables that are there."""
    text = render(RESULTS, committed(), lambda path: "data:,")
    assert text.count("<tr data-paper=") == len(claims_of(RESULTS))
    for part in committed():
        tables = {sheet.stem for sheet in part.sheets}
        for name, drawing in inventory.drawings(part).items():
            assert set(drawing.tables) <= tables, f"{part.name}/{name}"
