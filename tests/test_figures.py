"""Figures come from tables alone: all of them from full ones, some from few rows, none from nothing."""
import io
import math
import warnings

import numpy as np
import pandas as pd
import pytest
from figure_tables import LOST, cost, errors, fields, history, means, particles, runs, smoothed, walls
from matplotlib.container import ErrorbarContainer
from matplotlib.text import Text

from studies.kit.sweep import RESULTS, load
from studies.kit.table import Tables, merge
from studies.onset import figures as onset_figures
from studies.onset import tables as onset_tables
from studies.rb import figures, tables
from studies.rb import looks as pick
from studies.rb.figures import fields as figures_fields
from studies.rb.figures import time as figures_time
from studies.rb.figures.errors import power


@pytest.fixture(scope="module")
def full(tmp_path_factory) -> Tables:
    """Every table of the study, written and read as the study does."""
    folder, all_runs = tmp_path_factory.mktemp("full"), list(runs())
    mean = list(means(all_runs))
    rows = {"kinetic_energy": all_runs, "means": mean, "history": history(), "fields": fields(), "particles": particles(),
            "walls": walls(), "cost": cost(), "errors": errors(mean),
            "smoothed": smoothed()}
    for table in tables.ALL:
        if table.name in rows:
            merge(folder/"rb"/f"{table.name}.csv", table, list(rows[table.name]), size="quick")
    return load(tables.ALL, "rb", folder)


#: name -> tables -> figure
ALL = {drawing.name: drawing.page for drawing in figures.figures.drawings}


def pixels(page) -> bytes:
    picture = io.BytesIO()
    page.savefig(picture, format="png", metadata={"Software": None})
    return picture.getvalue()


def texts(page) -> str:
    """All words of a figure: titles, labels, legends."""
    return " ".join(found.get_text() for found in page.findobj(Text))


def test_full_tables_give_every_figure_with_labelled_axes(full):
    pages = figures.figures(full)
    assert list(pages) == list(ALL)
    for name, page in pages.items():
        assert page.get_suptitle() or page.axes[0].get_title(), f"{name} has no title"
        for side in ("x", "y"):
            assert any(getattr(axes, f"get_{side}label")() for axes in page.axes), f"{name} has no {side} label"


def test_no_tables_and_empty_tables_give_no_figures():
    assert figures.figures(Tables()) == {}
    assert figures.figures(Tables({t.name: pd.DataFrame(columns=t.columns) for t in tables.ALL})) == {}


@pytest.mark.parametrize("lost", [table.name for table in tables.ALL])
def test_each_table_may_be_missing(full, lost):
    figures.figures(Tables({name: frame for name, frame in full.items() if name != lost}))


def part(tables_there, **only) -> Tables:
    """Rows with these values, in the tables that have the columns."""
    few = Tables(tables_there)
    for column, value in only.items():
        few |= {name: frame[frame[column] == value] for name, frame in few.items() if column in frame}
    return few


def titles_fit(page) -> bool:
    """A page with fewer panels is narrower: its titles must still be inside."""
    found = [page.axes[0].title, *page.texts] if page.axes else page.texts
    boxes = [text.get_window_extent() for text in found if text.get_text()]
    return all(page.bbox.x0 <= box.x0 and box.x1 <= page.bbox.x1 for box in boxes)


@pytest.mark.parametrize("only", [{"ra": 5000.0}, {"ra": 1500.0}, {"method": "spam"}, {"method": "compressible"},
                                  {"resolution": 50.0}, {"seed": 1}, {"variant": "printed-fixed-rows"}], ids=str)
def test_figures_cope_with_few_rows(full, only):
    """Drawn from what is left or left out; a warning of matplotlib (empty legend, log of 0) is an error here."""
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        for page in figures.figures(part(full, **only)).values():
            if "ra" in only:
                page.draw_without_rendering()
                assert titles_fit(page)


def test_the_same_tables_give_the_same_bytes(full):
    """Also with rows in another order: a table is a set of rows."""
    shuffled = Tables({name: frame.sample(frac=1, random_state=1) for name, frame in full.items()})
    for name in ("main", "convergence", "fig9"):
        once = pixels(ALL[name](full))
        assert pixels(ALL[name](full)) == once, name
        assert pixels(ALL[name](shuffled)) == once, f"{name} depends on the order of rows"


def test_the_line_is_fitted_between_onset_and_four_times_onset(full):
    """The made-up K is exactly this line there and below it beyond, where no row may enter the fit."""
    constant, slope = pick.straight_line(pick.reference(full, **pick.LAYER)).coefficients
    assert slope == pytest.approx(-0.0082*math.sqrt(pick.RA_C), rel=1e-7)     # 9 digits in the CSV
    assert constant == pytest.approx(0.0082, rel=1e-7)
    above = pick.reference(full, **pick.LAYER)
    assert pick.straight_line(above[above["ra"] > 2500]) is None              # one row: no line


def test_errors_are_those_of_the_table_and_kg_is_apart_from_kp(full):
    """No figure computes an error: what the table has moves the marks."""
    mean = full["errors"].copy()
    chosen = mean["variant"].eq("printed") & mean["ra"].eq(5000.0) & mean["resolution"].eq(50.0) & mean["energy"].eq("Kg")
    mean.loc[chosen, "error"] = -0.123
    axes = ALL["convergence"](Tables(full | {"errors": mean})).axes[0]
    marks = {(x, y) for line in axes.lines if line.get_markerfacecolor() == "white"
             for x, y in zip(*line.get_data()) if y == pytest.approx(0.123)}
    assert marks == {(50.0, 0.123)}


def test_the_smoothed_reference_is_a_line(full):
    line = next(line for line in ALL["convergence"](full).axes[0].lines if "smoothing alone" in str(line.get_label()))
    assert line.get_ydata() == pytest.approx([60/rows**2 for rows in (25, 35, 50)], rel=1e-5)     # 9 digits in the CSV


def test_heat_transport_converges_beside_k(full):
    """Errors of the Nusselt number of particles alone, where there are any, and only where errors are drawn against rows."""
    words = texts(ALL["convergence"](full))
    assert words.count("Nusselt number, particles: slope -1.5") == 2 and "heat transport" in words
    without = Tables(full | {"errors": full["errors"][full["errors"]["energy"] != "Nu"]})
    assert "Nu" not in texts(ALL["convergence"](without))
    assert pixels(ALL["variants"](without)) == pixels(ALL["variants"](full))


def test_two_views_are_of_one_instant(full):
    """<v> by a double sum over all particles, images too; a mean field is not asked for."""
    run = full["particles"][full["particles"]["variant"].eq("printed") & full["particles"]["eos"].eq("ideal")]
    found = figures_fields.smoothed(run)
    assert len(found) == 12*24
    r = np.hypot(*(found[[name]].to_numpy() - run[name].to_numpy() for name in ("x", "y")))*12/3     # in ranges
    w = np.where(r < 1, (1 + 3*r)*(1 - r)**3, 0)
    for name in ("vx", "vy"):
        assert found[name].to_numpy() == pytest.approx(w@run[name].to_numpy()/w.sum(axis=1), abs=1e-14)     # sums of 30 terms
    for name in ("fig7", "fig12"):
        page = ALL[name](Tables({"particles": full["particles"]}))
        assert texts(page).count("instant") == 2 and "mean" not in texts(page)


def test_a_lag_is_told_from_a_difference():
    """The same K(t), a tenth less and 150 later: early, K changes by more than that."""
    t = np.linspace(0, 4500, 301)
    cells = pd.DataFrame({"t": t, "ke": 2 + np.sin(t/300)*np.exp(-t/1000)})
    late = pd.Series(np.interp(t - 150, t, cells["ke"]))
    shift, least = figures_time.lag(pd.Series(t), 0.9*late, cells)
    assert figures_time.apart(pd.Series(t), late, cells, 150.0) == pytest.approx(0, abs=1e-12)
    assert shift == pytest.approx(150, abs=30)                  # two samples
    assert least < 0.16 < figures_time.apart(pd.Series(t), 0.9*late, cells)     # 0.1 of K, which is 1.5 times the last at most


def test_particles_from_the_grids_flow_are_marked_apart(full):
    started = full["means"][full["means"]["variant"].eq("printed") & full["means"]["ra"].eq(2500.0)]
    more = Tables(full | {"means": pd.concat([full["means"], started.assign(variant="printed-from-flow")])})
    for name in ("main", "fig6"):
        told = [texts(ALL[name](known)).count("started from the grid's flow") for known in (full, more)]
        assert told == [0, 1], name


def test_variants_that_diverged_stand_in_words(full):
    """In place of all points of one variant, beside those of another that lost a seed."""
    told = [found.get_text() for found in ALL["variants"](full).findobj(Text) if "diverged" in found.get_text()]
    assert sum(words.startswith(("25 rows: diverged at t = 31 ", "50 rows: diverged at t = 31 ")) for words in told) == 4
    assert sum(words.startswith("25 rows: 1 of 3 seeds diverged at t = 32 ") for words in told) == 1
    assert len(told) == 5 and LOST in texts(ALL["variants"](full))


def test_errors_off_the_axis_of_the_variants_are_told_in_words(full):
    axes = ALL["variants"](full).axes[1]
    assert max(np.abs(axes.get_xlim())) < 150
    assert sum("K_p" in found.get_text() and "rightarrow" in found.get_text() for found in axes.texts) == 2     # 25 and 50 rows


@pytest.mark.parametrize("name", ["main", "convergence", "variants"])
def test_points_that_have_not_settled_are_crossed_and_the_legend_says_so(full, name):
    def crosses(known):
        page = ALL[name](known)
        marks = [line for axes in page.axes for line in axes.lines if line.get_marker() == "x"]
        return sum(len(line.get_xdata()) for line in marks), texts(page).count(pick.NOT_STEADY)
    found, told = crosses(full)
    # Kp and Kg, among errors against rows Nu, too: one printed point at 10 000; besides it range-6 at two sizes and two Ra
    assert (found, told) == ({"variants": 2*4, "convergence": 3}.get(name, 2), 1)
    settled = Tables(full | {"kinetic_energy": full["kinetic_energy"].assign(converged=True)})
    assert crosses(settled) == (0, 0)


def test_slopes_in_the_legend_are_those_of_the_rows(full):
    """Second order for the grid by construction; K_p changes sign: no slope there."""
    words = texts(ALL["convergence"](full))
    assert "compressible grid: slope -2.0" in words
    left, right = ALL["convergence"](full).axes
    assert not any("K_p" in label and "slope" in label for label in right.get_legend_handles_labels()[1])
    assert any("K_g" in label and "slope -1.1" in label for label in left.get_legend_handles_labels()[1])


def test_a_series_keeps_its_look_in_every_panel(full):
    """Also where one panel lacks series of the other; no two series look alike."""
    mean = full["errors"][~(full["errors"]["variant"].eq("fixed-lattice") & full["errors"]["ra"].eq(10000.0))]
    seen: dict[str, set] = {}
    for axes in ALL["convergence"](Tables(full | {"errors": mean})).axes[:2]:
        for handle, label in zip(*axes.get_legend_handles_labels()):
            if isinstance(handle, ErrorbarContainer):
                seen.setdefault(label.split(":")[0], set()).add((handle[0].get_color(), handle[0].get_marker()))
    assert {"compressible grid", "fixed points, lattice", "moving points"} <= set(seen)
    assert all(len(looks) == 1 for looks in seen.values()) and len(set.union(*seen.values())) == len(seen)


def test_errors_that_do_not_fall_have_a_range_and_no_slope(full):
    mean = full["errors"].copy()
    chosen = mean["variant"].eq("printed") & mean["energy"].eq("Kg") & mean["ra"].eq(5000.0) & mean["eos"].eq("ideal")
    mean.loc[chosen & mean["resolution"].eq(35.0), "error"] = -0.1
    mean.loc[chosen & mean["resolution"].eq(50.0), "error"] = -0.2
    labels = ALL["convergence"](Tables(full | {"errors": mean})).axes[0].get_legend_handles_labels()[1]
    coarse = mean.loc[chosen & mean["resolution"].eq(25.0), "error"].iloc[0]
    assert f"$K_g$, smoothed field: {100*min(coarse, -0.2):+.2g} to -10 %" in labels


def test_fixed_points_in_another_flow_and_those_that_diverged_are_drawn_or_told(full):
    """What `errors` leaves out: 40 rows with four rolls, -85 %; 50 rows without an end."""
    name, mean, runs = "fixed-lattice-nested-only", full["means"], full["kinetic_energy"]
    lattice = mean["variant"].eq("fixed-lattice") & mean["ra"].eq(10000.0) & mean["resolution"].eq(40.0)
    grid = mean[mean["method"].eq("compressible") & mean["eos"].eq("ideal") & mean["transport"].eq("const-eta")
                & mean["sides"].eq("periodic") & mean["ra"].eq(10000.0) & np.isinf(mean["resolution"])]
    other = mean[lattice].assign(variant=name, rolls=4, ke=0.15*grid["ke"].iloc[0])
    gone = runs[runs["variant"].eq("fixed-lattice") & runs["ra"].eq(10000.0) & runs["resolution"].eq(50.0)]
    page = ALL["fixed_points"](Tables(full | {"means": pd.concat([mean, other]), "kinetic_energy": pd.concat(
        [runs, gone.assign(variant=name, ke=math.nan)])}))
    marks = {(x, y) for line in page.axes[1].lines if line.get_markerfacecolor() == "white"
             for x, y in zip(*line.get_data()) if y == pytest.approx(0.85)}
    assert {x for x, _ in marks} == {40.0}
    assert "[40 rows: 4 rolls instead of two; 50 rows: diverged]" in texts(page)


def test_ingredients_of_moving_points_have_a_line_each(full):
    """As soon as there are some; a name that no list knows comes under others."""
    assert len(ALL["moving_points"](full).axes) == 1
    mean = full["errors"][full["errors"]["variant"].eq("moving")]
    more = [mean.assign(variant=name) for name in ("moving-no-shift", "moving-carried", "moving-new")]
    page = ALL["moving_points"](Tables(full | {"errors": pd.concat([full["errors"], *more])}))
    labels = [tick.get_text() for tick in page.axes[1].get_yticklabels()]
    assert labels == ["the scheme and its ingredients", "all ingredients  (moving)", "points not shifted  (moving-no-shift)",
                      "motions of RR98", "the same, volumes carried  (moving-carried)", "others", "moving-new"]


def test_only_particles_that_stand_still_where_the_grid_convects_are_called_frozen(full):
    assert "frozen" not in texts(ALL["main"](full))      # at Ra = 1500 the grid is at rest, too
    mean = full["means"].copy()
    mean.loc[mean["method"].eq("spam") & mean["ra"].eq(2500.0), "ke_field"] = 1e-7
    words = [found.get_text() for found in ALL["main"](Tables(full | {"means": mean})).findobj(Text)]
    assert sum("frozen" in word for word in words) == 1


def test_a_slope_is_as_uncertain_as_its_points_scatter():
    n = np.array([25.0, 35.0, 50.0])
    fit, err = power(n, 3/n, 0.1*3/n)
    assert fit[0] == pytest.approx(-1.0, abs=1e-12)             # an exact power law
    spread = np.sqrt(np.sum((np.log(n) - np.log(n).mean())**2))
    assert err == pytest.approx(0.1/spread, rel=1e-9)           # equal relative errors: sigma/sqrt(sum (x - <x>)^2)
    _, scattered = power(n, np.array([0.25, 0.19, 0.21]), np.full(3, 0.002))
    assert scattered > 5*power(n, 3/n, 0.01*3/n)[1]             # no power law: 12 % off, errors of 1 %


def test_circles_are_what_is_behind_the_plates(full):
    upper, lower = ALL["fig2_3"](full).axes
    for axes in (upper, lower):
        x, y = next(line for line in axes.lines if len(line.get_xdata()) > 2).get_data()
        assert len(x) == 2*3*24 and (np.abs(y) > 0.5).all() and (np.abs(x) <= 1).all()   # 3 rows of 24, two plates


def test_the_committed_tables_give_the_committed_figures():
    """Every figure of results/rb can be drawn again from the tables beside it."""
    known = load(tables.ALL, "rb")
    if not known:
        pytest.skip("no tables of rb committed yet: make study-rb writes them")
    committed = {path.stem for path in (RESULTS/"rb").glob("*.png")}
    assert committed <= set(figures.figures(known))


def test_the_onset_draws_its_committed_figures_too():
    """With the interval of each line's zero that the table has."""
    known = load(onset_tables.ALL, "onset")
    if not known:
        pytest.skip("no tables of onset committed yet: make study-onset writes them")
    pages = onset_figures.FIGURES(known)
    assert {path.stem for path in (RESULTS/"onset").glob("*.png")} == set(pages)
    zeros = next(axes for axes in pages["line"].axes if axes.get_ylabel() == "Ra$_c$")
    bars = [np.ptp(bar[:, 1]) for drawn in zeros.containers if isinstance(drawn, ErrorbarContainer)
            for bar in drawn[2][0].get_segments()]
    lines = onset_figures.rows(known["critical_ra"], **onset_figures.GAS, way="line")
    widest = lines.loc[np.isinf(lines["resolution"]) & lines["quantity"].str.contains("extrapolated"), "err"].max()
    assert max(bars) == pytest.approx(2*widest)
