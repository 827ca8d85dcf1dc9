"""Figures come from tables alone: all of them from full ones, some from few rows; what they say."""
import functools
import warnings
from importlib import import_module

import numpy as np
import pytest
from matplotlib.container import ErrorbarContainer
from matplotlib.lines import Line2D
from matplotlib.text import Text

from studies.hardcases import figures as hardcases_figures
from studies.hardcases.tables import TABLES
from studies.kit.sweep import load
from studies.kit.table import Tables
from studies.rb import tables
from studies.rb.figures import figures, flow
from studies.rb.looks import NOT_STEADY

#: name -> tables -> figure
ALL = {drawing.name: drawing.page for drawing in figures.drawings}
STUDIES = ("conservation", "cost", "hardcases", "lattices", "noise", "onset", "operators", "ordering", "rb",
           "streams")


@pytest.fixture(scope="module")
def full() -> Tables:
    """The committed tables."""
    return load(tables.ALL, "rb")


@functools.cache
def pages_of(study: str):
    """All figures of a study, from committed tables."""
    made = import_module(f"studies.{study}").STUDY
    return made.figures(load(made.tables, study))


def texts(page) -> str:
    """All words of a figure: titles, labels, legends."""
    return " ".join(text.get_text() for text in page.findobj(Text))


def changed(full: Tables, name: str, column: str, value, **where) -> Tables:
    """Another value in the rows of a table in which columns are as said."""
    frame = full[name].copy()
    frame.loc[np.logical_and.reduce([frame[key] == one for key, one in where.items()]), column] = value
    return Tables({**full, name: frame})


@pytest.mark.parametrize("only", [{"ra": 5000.0}, {"method": "spam"}, {"variant": "printed-fixed-rows"}],
                         ids=str)
def test_figures_cope_with_few_rows(full, only):
    """Drawn or left out; a warning of matplotlib (empty legend, log of 0) is an error here."""
    [(column, value)] = only.items()
    few = {name: frame[frame[column] == value] if column in frame else frame for name, frame in full.items()}
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        figures(Tables(few))


def test_slopes_are_told_where_errors_fall_and_ranges_elsewhere(full):
    """The grid's are made to fall in second order; K_p changes sign: no slope there."""
    grid = full["errors"]["method"].eq("compressible")
    square = full["errors"]["error"].where(~grid, -7/full["errors"]["resolution"]**2)
    second = Tables({**full, "errors": full["errors"].assign(error=square)})
    words = texts(ALL["convergence"](second))
    assert "slope -2.0" in words and " to " in words


def test_smoothed_velocities_are_those_of_a_double_sum(full):
    """<v> of one instant over all particles, images too."""
    run = full["particles"].query("variant == 'printed' and eos == 'vdw' and ra == 10000")
    seen = flow.smoothed(run)
    # in ranges
    r = np.hypot(*(seen[[name]].to_numpy() - run[name].to_numpy() for name in ("x", "y")))*16/3
    w = np.where(r < 1, (1 + 3*r)*(1 - r)**3, 0)
    for name in ("vx", "vy"):
        # 30 terms
        assert seen[name].to_numpy() == pytest.approx(w@run[name].to_numpy()/w.sum(axis=1), abs=1e-14)


def test_points_that_have_not_settled_are_crossed_and_the_legend_says_so(full):
    def seen(known):
        page = ALL["main"](known)
        marks = [line for axes in page.axes for line in axes.lines if line.get_marker() == "x"]
        return bool(marks), texts(page).count(NOT_STEADY)
    settled = Tables({**full, "kinetic_energy": full["kinetic_energy"].assign(converged=True)})
    where = {"variant": "printed", "eos": "ideal", "transport": "const-eta", "sides": "periodic", "ra": 1e4}
    assert seen(settled) == (False, 0)
    # one legend for both panels
    assert seen(changed(settled, "kinetic_energy", "converged", False, **where)) == (True, 1)


def looks(axes) -> dict[str, tuple]:
    """What tells the series of a panel apart without colour: marker and how it is filled, or the line."""
    handles, names = axes.get_legend_handles_labels()
    lines = [handle[0] if isinstance(handle, ErrorbarContainer) else handle for handle in handles]
    return {name: look_of(line) for name, line in zip(names, lines)
            if name != NOT_STEADY and isinstance(line, Line2D)}


def look_of(line: Line2D) -> tuple:
    if line.get_marker() in ("", "None"):
        return str(line._dash_pattern), line.get_linewidth()
    return line.get_marker(), line.get_fillstyle(), line.get_markerfacecolor() in ("white", "none")


@pytest.mark.parametrize("study", STUDIES)
def test_every_figure_has_a_title_and_series_that_differ_in_grey(study):
    for name, page in pages_of(study).items():
        assert page.get_suptitle() or page.axes[0].get_title(), f"{study}/{name} has no title"
        for axes in page.axes:
            panel = looks(axes)
            # eight, ten in a panel of more than 5 inches, and a line to compare them with
            most = 11 if axes.get_window_extent().width > 5*page.dpi else 9
            assert len(set(panel.values())) == len(panel) <= most, f"{study}/{name}: {panel}"


def test_colours_of_the_map_are_its_outcomes():
    """The lightest are all right, no others are; every method that meets three cases or more has its line."""
    table = load(TABLES, "hardcases")["map"]
    rows = hardcases_figures.judged(table)
    assert (rows["shade"] == 0).eq(rows["outcome"] == "right").all()
    words = " ".join(texts(hardcases_figures.chart(table)).split())
    cases = rows.groupby("method")["case"].nunique()
    assert all(name in words for name in cases.index[cases >= 3])


def test_frozen_particles_are_named(full):
    """Where particles have less than 0.01 of the grid's K: at Ra 2500, and at 5000 if it were so there."""
    thawed, more = (changed(full, "means", "ke_field", ke, method="spam", ra=ra)
                    for ke, ra in ((1.0, 2500.0), (1e-7, 5000.0)))
    assert [texts(ALL["main"](known)).count("at rest, st") for known in (thawed, full, more)] == [0, 1, 2]
