"""Figures come from tables alone: all of them from full ones, some from few rows, none from nothing."""
import io
import math
import warnings

import numpy as np
import pandas as pd
import pytest
from figure_tables import LOST, errors, fields, history, means, particles, runs, smoothed
from matplotlib.container import ErrorbarContainer
from matplotlib.text import Text

from studies.build.labels import label
from studies.kit.sweep import load
from studies.kit.table import Tables, merge
from studies.onset import figures as onset_figures
from studies.onset import tables as onset_tables
from studies.rb import tables
from studies.rb.figures import RA_C, figures, flow, straight_line
from studies.rb.looks import LAYER, NOT_STEADY, reference

#: name -> tables -> figure
ALL = {drawing.name: drawing.page for drawing in figures.drawings}


@pytest.fixture(scope="module")
def full(tmp_path_factory) -> Tables:
    """Every table of the figures, written and read as the study does."""
    folder, all_runs = tmp_path_factory.mktemp("full"), list(runs())
    mean = list(means(all_runs))
    rows = {"kinetic_energy": all_runs, "means": mean, "history": history(), "fields": fields(),
            "particles": particles(), "errors": errors(mean), "smoothed": smoothed()}
    for table in tables.ALL:
        merge(folder/"rb"/f"{table.name}.csv", table, list(rows.get(table.name, [])), size="quick")
    return load(tables.ALL, "rb", folder)


def texts(page) -> str:
    """All words of a figure: titles, labels, legends."""
    return " ".join(text.get_text() for text in page.findobj(Text))


def pixels(page) -> bytes:
    picture = io.BytesIO()
    page.savefig(picture, format="png", dpi=40, metadata={"Software": None})
    return picture.getvalue()


def changed(full: Tables, name: str, column: str, value, **where) -> Tables:
    """Another value in the rows of a table in which columns are as said."""
    frame = full[name].copy()
    frame.loc[np.logical_and.reduce([frame[key] == one for key, one in where.items()]), column] = value
    return Tables({**full, name: frame})


def test_full_tables_give_every_figure_with_labelled_axes(full):
    pages = figures(full)
    assert list(pages) == list(ALL)
    for name, page in pages.items():
        assert page.get_suptitle() or page.axes[0].get_title(), f"{name} has no title"
        for side in ("x", "y"):
            assert any(getattr(axes, f"get_{side}label")() for axes in page.axes), f"{name} has no {side} label"


def test_no_tables_and_empty_tables_give_no_figures():
    assert figures(Tables()) == {}
    assert figures(Tables({t.name: pd.DataFrame(columns=t.columns) for t in tables.ALL})) == {}


@pytest.mark.parametrize("lost", sorted({name for drawing in figures.drawings for name in drawing.tables}))
def test_each_table_may_be_missing(full, lost):
    figures(Tables({name: frame for name, frame in full.items() if name != lost}))


@pytest.mark.parametrize("only", [{"ra": 5000.0}, {"ra": 1500.0}, {"method": "spam"}, {"method": "compressible"},
                                  {"variant": "printed-fixed-rows"}], ids=str)
def test_figures_cope_with_few_rows(full, only):
    """Drawn from what is left or left out; a warning of matplotlib (empty legend, log of 0) is an error here."""
    [(column, value)] = only.items()
    few = {name: frame[frame[column] == value] if column in frame else frame for name, frame in full.items()}
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        figures(Tables(few))


def test_the_same_rows_give_the_same_bytes(full):
    """Also in another order: a table is a set of rows."""
    shuffled = Tables({name: frame.sample(frac=1, random_state=1) for name, frame in full.items()})
    for name in ("main", "fig9"):
        assert pixels(ALL[name](full)) == pixels(ALL[name](shuffled)), f"{name} depends on the order of rows"


def test_the_line_is_fitted_between_onset_and_four_times_onset(full):
    """The made-up K is exactly this line there and below it beyond, where no row may enter the fit."""
    limit = reference(full, **LAYER)
    constant, slope = straight_line(limit).coefficients
    assert slope == pytest.approx(-0.0082*math.sqrt(RA_C), rel=1e-7)     # 9 digits in the CSV
    assert constant == pytest.approx(0.0082, rel=1e-7)
    assert straight_line(limit[limit["ra"] > 2500]) is None              # one row: no line


def test_errors_are_those_of_the_table(full):
    """No figure computes an error: what the table has moves the marks."""
    where = {"variant": "printed", "ra": 5000.0, "resolution": 50.0, "energy": "Kg"}
    axes = ALL["convergence"](changed(full, "errors", "error", -0.123, **where)).axes[0]
    marks = {(x, y) for line in axes.lines if line.get_markerfacecolor() == "white"
             for x, y in zip(*line.get_data()) if y == pytest.approx(0.123)}
    assert marks == {(50.0, 0.123)}


def test_slopes_are_told_where_errors_fall_and_ranges_elsewhere(full):
    """Second order for the grid by construction; K_p changes sign: no slope there."""
    left, right = ALL["convergence"](full).axes
    words = [axes.get_legend_handles_labels()[1] for axes in (left, right)]
    assert any(one.startswith(f"{label('compressible', 'flux-form')}: slope -2.0") for one in words[0])
    assert any("K_g" in one and "slope -1.1" in one for one in words[0])
    assert any("K_p" in one and " to " in one for one in words[1])
    line = next(line for line in left.lines if "smoothing alone" in str(line.get_label()))
    assert line.get_ydata() == pytest.approx([60/rows**2 for rows in (25, 35, 50)], rel=1e-5)     # 9 digits in the CSV


def test_smoothed_velocities_are_those_of_a_double_sum(full):
    """<v> of one instant over all particles, images too."""
    run = full["particles"][full["particles"]["variant"].eq("printed") & full["particles"]["eos"].eq("ideal")]
    seen = flow.smoothed(run)
    assert len(seen) == 12*24
    r = np.hypot(*(seen[[name]].to_numpy() - run[name].to_numpy() for name in ("x", "y")))*12/3     # in ranges
    w = np.where(r < 1, (1 + 3*r)*(1 - r)**3, 0)
    for name in ("vx", "vy"):
        assert seen[name].to_numpy() == pytest.approx(w@run[name].to_numpy()/w.sum(axis=1), abs=1e-14)    # 30 terms


def test_variants_that_diverged_stand_in_words(full):
    """In place of all points of one variant, beside those of another that lost a seed."""
    page = ALL["variants"](full)
    told = [text.get_text() for text in page.findobj(Text) if "diverged" in text.get_text()]
    assert sorted(told) == ["25 rows: 1 of 3 seeds diverged", "25 rows: diverged", "50 rows: diverged"]
    assert label("spam", LOST) in texts(page)


@pytest.mark.parametrize(("name", "crosses"), [("main", 2), ("convergence", 3), ("variants", 4)])
def test_points_that_have_not_settled_are_crossed_and_the_legend_says_so(full, name, crosses):
    """One printed point at Ra 10 000, Kp and Kg, among errors Nu, too; of the variants one at two sizes."""
    def seen(known):
        page = ALL[name](known)
        marks = [line for axes in page.axes for line in axes.lines if line.get_marker() == "x"]
        return sum(len(line.get_xdata()) for line in marks), texts(page).count(NOT_STEADY)
    assert seen(full) == (crosses, 1)
    assert seen(Tables({**full, "kinetic_energy": full["kinetic_energy"].assign(converged=True)})) == (0, 0)


def test_fixed_points_in_another_flow_are_crossed_and_those_that_diverged_told(full):
    """What `errors` leaves out: 40 rows with four rolls, -85 %; 50 rows without an end."""
    where, name = {"variant": "fixed-lattice", "ra": 10000.0}, "fixed-lattice-nested-only"
    lattice, gone = (frame[(frame[[*where]] == [*where.values()]).all(axis=1) & (frame["resolution"] == size)]
                     for frame, size in ((full["means"], 40.0), (full["kinetic_energy"], 50.0)))
    other = lattice.assign(variant=name, rolls=4, ke=0.15*reference(full, **LAYER).set_index("ra")["ke"][10000.0])
    more = {"means": pd.concat([full["means"], other]),
            "kinetic_energy": pd.concat([full["kinetic_energy"], gone.assign(variant=name, ke=math.nan)])}
    page = ALL["fixed_points"](Tables({**full, **more}))
    crosses = [line for line in page.axes[1].lines if line.get_marker() == "x"]
    assert [tuple(line.get_xydata()[0]) for line in crosses] == [(40.0, pytest.approx(0.85))]
    assert "[50 rows: diverged]" in texts(page)


def test_starts_and_frozen_particles_are_named(full):
    assert "frozen" not in texts(ALL["main"](full))      # at Ra = 1500 the grid is at rest, too
    still = changed(full, "means", "ke_field", 1e-7, method="spam", ra=2500.0)
    assert texts(ALL["main"](still)).count("frozen") == 1
    started = full["means"][full["means"]["variant"].eq("printed") & full["means"]["ra"].eq(2500.0)]
    more = Tables({**full, "means": pd.concat([full["means"], started.assign(variant="printed-from-flow")])})
    for name in ("main", "fig6"):
        assert [texts(ALL[name](known)).count("started from the grid's flow") for known in (full, more)] == [0, 1]


def test_circles_are_what_is_behind_the_plates(full):
    for axes in ALL["fig2_3"](full).axes:
        x, y = next(line for line in axes.lines if len(line.get_xdata()) > 2).get_data()
        assert len(x) == 2*3*24 and (np.abs(y) > 0.5).all() and (np.abs(x) <= 1).all()   # 3 rows of 24, two plates


def test_the_onset_draws_the_interval_of_each_zero():
    known = load(onset_tables.ALL, "onset")
    if not known:
        pytest.skip("no tables of onset committed yet: make study-onset writes them")
    zeros = next(axes for axes in onset_figures.FIGURES(known)["line"].axes if axes.get_ylabel() == "Ra$_c$")
    bars = [np.ptp(bar[:, 1]) for drawn in zeros.containers if isinstance(drawn, ErrorbarContainer)
            for bar in drawn[2][0].get_segments()]
    lines = onset_figures.rows(known["critical_ra"], **onset_figures.GAS, way="line")
    limits = np.isinf(lines["resolution"]) & lines["quantity"].str.contains("extrapolated")
    assert max(bars) == pytest.approx(2*lines.loc[limits, "err"].max())
