"""The page from tables: what it says is computed, films, what is committed."""
import base64
import io
import itertools
import math
import subprocess
import sys

import numpy as np
import pandas as pd
import pytest
from imageio_ffmpeg import read_frames
from matplotlib.colors import to_rgb
from PIL import Image
from report_tables import errors, one_study

from studies.cost.names import FAMILIES
from studies.kit.csvfile import read, write
from studies.kit.figure import COLOURS, figure, save
from studies.kit.key import ROOT
from studies.kit.sweep import RESULTS
from studies.kit.table import Tables
from studies.report import behind, cost, draw, needs, pictures
from studies.report.chart import Scale, chart
from studies.report.findings import Known, answer, claims_of, ends, falls, findings
from studies.report.found import parts
from studies.report.numbers import grouped, many, seconds, told
from studies.report.page import LIMIT, accepted, fingerprint, found_value, paper, render, write_page


@pytest.fixture
def small(tmp_path):
    return one_study(tmp_path/"results")


def test_the_page_is_one_file_and_the_same_again(small):
    text = write_page(small).read_text()
    assert write_page(small).read_text() == text
    assert "three &lt;b&gt;&amp; more" in text and "<b>& more" not in text
    assert 'src="http' not in text and 'href="http' not in text and "@import" not in text and "url(" not in text
    assert text.count("<tr data-paper=") == 3 and "abc1234567" in text
    assert 'id="figure-rb-toy"' in text and 'alt="A toy. y over x"' in text


def test_what_is_said_comes_from_the_tables(small):
    known = Known(small, claims_of(small), cost.panels(parts(small)))
    first = findings(known)[0]
    assert "do not converge" in first.title and "−13.200(10)" in first.text
    assert "−20.000(10) % with 16, 25 and 50 rows" in first.text
    assert answer(known).endswith("Of 2 statements of the papers 1 hold, 1 fail, 0 are undecidable here.")
    better = errors().assign(error=lambda rows: rows["error"].where(rows["energy"] != "Kg", -40/rows["resolution"]**2))
    write(small/"rb/errors.csv", better, head=["commit abc1234567"])
    assert "come ever nearer" in findings(known)[0].title


def test_what_an_error_costs_is_read_where_it_stays_below(small):
    [panel] = [panel for panel in cost.panels(parts(small)) if "kinetic" in panel.title]
    costs = {series.label: {level: need.cpu_s for level, need in series.needs.items()} for series in panel.series}
    assert next(series.label for series in panel.series if series.usual) == "compressible grid"
    grid = {0.1: 1e-4*16**3, 0.03: 1e-4*16**3, 0.01: 1e-4*50**3}     # 7/16^2 = 0.027, 7/25^2 = 0.0112, 7/50^2 = 0.0028
    assert costs["compressible grid"] == pytest.approx(grid)
    spam = next(value for name, value in costs.items() if "all particles" in name)
    assert spam == {}, "0.05 with 25 rows is passed on the way to -0.2 with 50: it does not stay below 10 %"


def test_a_table_of_speed_needs_no_code(small):
    """As the study of speed writes it: scene, quantity, method, and intervals both ways."""
    rows = [{"scene": "taylor-green", "quantity": "velocity", "method": f"m{k}", "resolution": n, "points": n*n, "seeds": 1,
             "error": k/n**2, "error_err": 1e-5, "cpu_s": 1e-4*n**3, "cpu_s_err": 1e-6, "size": "fine", "commit": "abc1234567"}
            for k in (1, 2, 3) for n in (16, 32, 64)]
    write(small/"speed/points.csv", pd.DataFrame(rows), head=["commit abc1234567"])
    first = cost.panels(parts(small))[0]
    assert first.title == "speed: taylor-green, velocity"
    assert [series.label for series in first.series] == ["m1", "m2", "m3"] and all(series.usual for series in first.series)
    drawn = chart(first)
    assert all(mark.wide for curve in drawn.curves for mark in curve.marks)


def speed(out, names, found):
    """Points of these methods, all alike, and what an error costs: method -> (reached, seconds, low, high)."""
    points = [{"scene": "convection", "quantity": "K", "method": name, "resolution": n, "points": n*n, "seeds": 1,
               "error": 9/n**2, "error_err": 1e-5, "cpu_s": 1e-4*n**3, "cpu_s_err": 1e-6, "setup_s": 0.0, "bytes": 8,
               "size": "fine", "commit": "abc1"}
              for name in names for n in (16, 32, 64)]
    rows = [{"scene": "convection", "quantity": "K", "method": name, "level": level, "reached": reached, "cpu_s": cpu, "low": low,
             "high": high, "points": 9, "error": level, "size": "fine", "commit": "abc1"}
            for name, (reached, cpu, low, high) in found.items() for level in needs.LEVELS]
    write(out/"speed/points.csv", pd.DataFrame(points), head=["commit abc1"])
    write(out/"speed/needed.csv", pd.DataFrame(rows), head=["commit abc1"])


def test_each_family_is_shown_by_its_cheapest_grid_first(small):
    """However its name sorts; what an error costs is what the study's table says, not the next run tried."""
    costs = {"DIH Delaunay, jittered": 3.0, "DIH lattice, h = 1.2 a": 0.212, "DIH lattice, h = 2 a": 1.1,
             "DIH lattice, h = 3 a": 1.6, "SPAM, Lucy (as printed)": None, "SPAM, Monaghan": None, "SPAM, Wendland C2": 9.0,
             "compressible grid, Newton": 0.62, "compressible grid, RK4": 0.161, "moving points": 22.0, "py-pde, gas": 0.87}
    speed(small, costs, {name: ("yes", one, 0.96*one, 1.04*one) if one else ("no", *[math.nan]*3) for name, one in costs.items()})
    panel = cost.panels(parts(small))[0]
    assert [series.label for series in panel.series if series.usual] == [
        "compressible grid, RK4", "DIH lattice, h = 1.2 a", "DIH Delaunay, jittered", "moving points", "SPAM, Wendland C2",
        "SPAM, Lucy (as printed)", "py-pde, gas"]
    assert [f"{series.needs[0.01]}" for series in panel.series[:2]] == ["0.161(6)", "0.212(8)"]
    last = findings(Known(small, claims_of(small), [panel]))[-1]
    assert last.title == "An error of 1 % costs 0.161(6) CPU seconds at best" and last.source == "speed/needed"
    assert "0.161(6) s, compressible grid, RK4; 0.212(8) s, DIH lattice, h = 1.2 a; 0.87(3) s" in last.text


@pytest.mark.skipif(not (RESULTS/"speed/cheapest.csv").exists(), reason="no table of speed yet: make study-speed")
def test_what_is_said_of_cost_is_what_the_study_of_speed_found():
    """Its cheapest method in each panel; every family of contestants is in the diagram from the start."""
    best = read(RESULTS/"speed/cheapest.csv").set_index(["scene", "quantity", "level"])
    panels = [panel for panel in cost.panels(parts(RESULTS)) if panel.sheet.name == "speed/points"]
    for panel in panels:
        row = best.loc[(*panel.title.removeprefix("speed: ").split(", "), 0.01)]
        there = [series for series in panel.series if series.usual and 0.01 in series.needs]
        mine = min(there, key=lambda series: series.needs[0.01].cpu_s, default=None)
        assert (mine.label if mine else "not reached") == row["method"], panel.title
        assert mine is None or mine.needs[0.01].cpu_s == row["cpu_s"]
        there, first = ({start for start in cost.FAMILIES for series in panel.series if series.label.startswith(start)
                         and (series.usual or all_of_them)} for all_of_them in (True, False))
        assert there == first, panel.title
    first = findings(Known(RESULTS, claims_of(RESULTS), panels))[-1]
    row = best.loc[("convection", "K", 0.01)]
    assert told(row["cpu_s"], (row["high"] - row["low"])/2) in first.title and f"s, {row['method']};" in first.text


def rows_of_errors(*errors):
    return pd.DataFrame({"error": [e for e, _ in errors], "error_err": [d for _, d in errors]})


@pytest.mark.parametrize(("errors", "converges"), [
    ([(0.0277, 0.0015), (0.0089, 0.0016), (0.0047, 0.0016), (0.0018, 0.0016), (0.0003, 0.0021)], True),    # until it is noise
    ([(0.02, 1e-4), (0.005, 1e-4)], True), ([(-0.02, 1e-4), (0.001, 0.002)], True),
    ([(0.15, 1e-3), (0.15, 1e-3)], False), ([(0.05, 1e-3), (-0.2, 1e-3)], False),
    ([(0.01, 0.02), (0.005, 0.02)], False), ([(0.03, 1e-3), (0.001, 1e-3), (0.02, 1e-3), (0.001, 0.002)], False)])
def test_errors_that_fell_until_they_are_noise_converge(errors, converges):
    assert falls(rows_of_errors(*errors)) is converges


def test_a_limit_that_is_told_from_zero_is_what_points_come_to():
    closed = rows_of_errors((0.0277, 0.0015), (0.0003, 0.0021))
    limit = [pd.Series({"measured": size, "err": err}) for size, err in ((0.0027, 2e-4), (0.0018, 6e-4))]
    assert ends(closed, limit) == "end 0.2 to 0.3 % off" and ends(closed, limit[:1]) == "end 0.3 % off"
    assert ends(closed, [pd.Series({"measured": 0.0027, "err": 0.003})]) == ends(closed, []) == "converge"


def test_places_on_a_logarithmic_axis():
    scale = Scale(0.1, 1000.0, 50, 450)
    assert [scale(value) for value in (0.1, 10, 1000, 0.0, 1e9)] == [50, 250, 450, 50, 450]
    assert [value for value, _ in Scale(0.9, 30, 0, 1).ticks] == pytest.approx([1, 2, 5, 10, 20])


# --- what figures stand on --------------------------------------------------------------------------------------------


def toy_figures(tables: Tables) -> dict:
    """One figure of `a`, which `b` adds a line to, one of `c` alone; nothing without `e`, which may be empty."""
    made = {}
    tables["e"].sum()
    if "a" in tables:
        page, axes = figure()
        axes.plot(tables["a"]["x"], tables["a"]["x"]**2, label="a")
        if "b" in tables:
            axes.plot(tables["b"]["x"], tables["b"]["x"])
        axes.set(title="squares of $\\rho_0$", xlabel="$x$", ylabel=r"$\nu/\eta^{2}$")
        made["first"] = page
    if "c" in tables:
        page, axes = figure()
        axes.imshow(tables["c"].to_numpy())
        made["second"] = page
    return made


def test_a_figure_stands_on_the_tables_without_which_it_is_another_one():
    x = pd.DataFrame({"x": np.arange(4.0)})
    tables = Tables({"a": x, "b": x, "c": x, "d": x, "e": x})
    assert behind.needed(toy_figures, tables) == {"first": ["a", "b"], "second": ["c"]}
    first = toy_figures(tables)["first"]
    assert behind.title(first) == "squares of ρ0" and behind.panels(first) == "squares of ρ0: ν/η^2 over x"


# --- pictures ---------------------------------------------------------------------------------------------------------


def embedded(path, near):
    """A figure as a browser gets it, and as it was."""
    packed = base64.b64decode(pictures.webp(path, near).split(",")[1])
    return tuple(np.asarray(Image.open(one).convert("RGB")).astype(int) for one in (io.BytesIO(packed), path))


def series_stay_apart(path, colours, near):
    """No colour moves by more than it may; those of series are still told from each other."""
    got, was = embedded(path, near)
    assert np.linalg.norm(got - was, axis=2).max() <= near
    moved = [got[np.linalg.norm(was - one, axis=2) <= 3] for one in colours]      # 256 colours are not quite matplotlib's
    moved = [found.mean(axis=0) for found in moved if len(found) > 20]
    apart = [np.linalg.norm(one - other) for one, other in itertools.combinations(moved, 2)]
    assert len(moved) > 3 and min(apart) > 40
    return moved


def rgb(name):
    return 255*np.array(to_rgb(name))


@pytest.mark.parametrize("near", pictures.NEAR)
def test_colours_of_series_stay_apart_in_an_embedded_figure(tmp_path, near):
    """Of all that figures have, among many blends: thin lines over a field."""
    page, axes = figure()
    axes.imshow(np.linspace(0, 1, 10_000).reshape(100, 100), extent=(0, 1, 0, 1), aspect="auto", cmap="gray", alpha=0.3)
    for number, colour in enumerate(COLOURS):
        axes.plot([0, 1], [0.1*number, 0.1*number + 0.05], color=colour, linewidth=1.5)
    save(page, tmp_path/"lines.png")
    assert len(series_stay_apart(tmp_path/"lines.png", [rgb(name) for name in COLOURS], near)) == len(COLOURS)


@pytest.mark.skipif(not (RESULTS/"speed/work_precision.png").exists(), reason="no figure of speed yet: make study-speed")
def test_families_stay_apart_in_the_figure_that_has_most_of_them():
    colours = [rgb(colour) for colour, _ in FAMILIES.values()]
    assert len(series_stay_apart(RESULTS/"speed/work_precision.png", colours, pictures.NEAR[-1])) == len(FAMILIES)


def test_the_page_has_its_figures_in_the_most_colours_for_which_it_has_room(small):
    text = write_page(small).read_text()
    assert pictures.webp(small/"rb/toy.png", pictures.NEAR[0]) in text


# --- numbers ----------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(("value", "err", "text"), [
    (17.5, 1.5, "17.5(15)"), (-0.42, 0.096, "−0.42(10)"), (2369.2, 80.8, "2369(81)"), (1.0, 0.0, "1"),
    (0.0349, 0.0445, "0.03(4)"),
    (math.nan, 0.1, "none")])
def test_numbers_with_their_errors(value, err, text):
    assert told(value, err) == text


def test_words_for_numbers():
    assert [seconds(value) for value in (0.4406, 1.0457, 143.2)] == ["0.44", "1.0", "143"]
    assert grouped(20000.0) == "20\N{NO-BREAK SPACE}000"
    assert many(["a", "b", "c"]) == "a, b and c" and many(["a"]) == "a"
    assert accepted(-math.inf, 2.0) == "≤ 2" and accepted(1.0, math.inf) == "≥ 1" and accepted(math.nan, math.nan) == ""
    assert found_value(math.nan, math.nan) == "—" and found_value(2.96e-15, 0.0) == "2.96e−15"
    assert found_value(2.0, 0.5) == "2.0(5)"
    assert [paper(text) for text in ("KHP95 Secs V, VI", "RR98 Eq. 42", "Sangani & Acrivos 1982, Table 1")] == [
        "KHP95", "RR98", "Sangani & Acrivos 1982"]


# --- films ------------------------------------------------------------------------------------------------------------


def test_a_film_has_all_its_pictures_and_is_the_same_again(tmp_path):
    """Motion is stood in for by dots that fall; drawing and writing are those of the films."""
    from studies.report.frames import Dots
    from studies.report.frames import Image as Field
    times = np.linspace(0, 2, 3)
    x, y = np.meshgrid(np.linspace(-0.95, 0.95, 8), np.linspace(-0.45, 0.45, 4))
    dots = [Dots(x.ravel(), y.ravel()*(1 - t/9), 1 - y.ravel(), 0.001*(t + 1)) for t in times]
    gx, gy = np.linspace(-1, 1, 17), np.linspace(-0.5, 0.5, 9)
    field = np.meshgrid(gx, gy)
    images = [Field(gx, gy, 1 - field[1], 0*field[0], 0.1*field[0], 0.002) for _ in times]
    for name in ("one", "two"):
        draw.write(tmp_path/f"{name}.mp4", list(draw.pages(dots, images, times, ("dots", "grid"))))
    about, *shown = read_frames(tmp_path/"one.mp4")
    assert (about["codec"], about["size"], len(shown)) == ("h264", (640, 320), 3 + draw.HOLD)
    assert (tmp_path/"one.mp4").read_bytes() == (tmp_path/"two.mp4").read_bytes()


def test_a_film_keeps_its_colours_from_its_first_picture_to_its_last(tmp_path):
    colours = [rgb(name).astype(int) for name in (COLOURS[1], "#30243a")]
    draw.write(tmp_path/"two.mp4", [Image.new("RGB", (64, 32), tuple(colour)) for colour in colours])
    _, first, *_, last = read_frames(tmp_path/"two.mp4")
    for picture, colour in zip((first, last), colours):
        assert np.abs(np.frombuffer(picture, np.uint8).reshape(-1, 3) - colour).max() < 8


def test_frames_are_those_of_the_solvers_at_these_times():
    """Particles, moving points and the grid start from the same rolls and gain or lose energy from there."""
    from continuum.scene import RayleighBenard
    from studies.build.names import START_ENERGY
    from studies.report import frames
    times, scene = np.array([0.0, 0.1]), RayleighBenard(ra=1e4, L=16.0)
    for made in (frames.smooth_particles(scene, 1, times), frames.closed_faces(scene, 1, times),
                 frames.printed_motion(scene, 1, times), frames.grid(scene, 16, times)):
        first, last = list(made)
        # particles lie at random: their sum of squares is not the integral, by 2/sqrt(512)
        assert first.ke == pytest.approx(START_ENERGY, rel=0.09) and last.ke != first.ke
        assert np.abs(first.T - 1).max() <= 0.5 + 1e-12 and np.abs(last.y).max() <= 0.5


# --- what is committed ------------------------------------------------------------------------------------------------


def test_the_page_needs_no_solver():
    code = "import sys, studies.report.page; print(sorted({'numba', 'pde', 'particles'} & set(sys.modules)))"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True, cwd=ROOT)
    assert done.stdout.strip() == "[]"


@pytest.mark.skipif(not (RESULTS/"index.html").exists(), reason="no page here: make report writes it")
def test_the_page_here_is_that_of_the_results_here():
    text = (RESULTS/"index.html").read_text()
    assert len(text.encode()) < LIMIT
    assert f'name="inputs" content="{fingerprint(RESULTS)}"' in text, "results changed since: make report"


def test_committed_films_are_small():
    films = list((RESULTS/"films").glob("*.mp4"))
    assert all(path.stat().st_size < 300_000 for path in films)


def test_results_as_they_are_make_a_page():
    """With figures left out: their packing is tested above."""
    if not (RESULTS/"claims.csv").exists():
        pytest.skip("no results yet: make study-rb writes them")
    text = render(RESULTS, parts(RESULTS), pd.DataFrame(columns=list(behind.COLUMNS)), lambda path: "data:,")
    assert text.count("<tr data-paper=") == len(claims_of(RESULTS))
