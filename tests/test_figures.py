"""Figures come from tables alone: all of them from full ones, some from few rows, none from nothing."""
import io
import math
import subprocess
import sys
import warnings

import numpy as np
import pandas as pd
import pytest
from matplotlib.text import Text

from studies.convection import figures, pick, tables
from studies.convection.figures_errors import power
from studies.kit.source import ROOT
from studies.kit.sweep import RESULTS, load
from studies.kit.table import Tables, merge

SCENES = {"layer": ("ideal", "const-eta", "periodic"), "nu": ("ideal", "const-nu", "periodic"),
          "vdw": ("vdw", "const-eta", "periodic"), "box": ("ideal", "const-eta", "walls")}
RAS = (1500.0, 2000.0, 2500.0, 5000.0, 10000.0, 20000.0)
SPAM, GRID = ("spam", "printed"), ("compressible", "flux-form")
RULES = ("printed", "printed-fixed-rows", "walls-odd", "walls-own-pressure", "walls-odd-own-pressure")


def point(method, scene, ra, resolution, pr=1.0):
    name, variant = method
    eos, transport, sides = SCENES[scene] if name != "boussinesq" else ("", "", "periodic")
    return {"method": name, "variant": variant, "eos": eos, "transport": transport, "sides": sides, "ra": ra, "pr": pr,
            "resolution": float(resolution)}


def k(ra, scene="layer"):
    """K of a made-up fluid: the line A (1 - sqrt(Ra_c/Ra)) to 4 Ra_c, a little less beyond."""
    top = {"layer": 0.0082, "nu": 0.0079, "vdw": 0.0051, "box": 0.0043}[scene]
    onset = 3500 if scene == "box" else pick.RA_C
    return top*max(0.0, 1 - math.sqrt(onset/ra))*(1 - 0.02*max(0, ra/(4*onset) - 1))


def energies(method, scene, ra, resolution, kp, kg, seed=0, **more):
    return {**point(method, scene, ra, resolution), "particles": 0, "seed": seed, "ke": kp, "ke_err": 0.02*kp,
            "ke_field": kg, "ke_field_err": 0.02*kg, "ke_fluctuation": kp - kg, "nu": 1 + 100*kg, "nu_err": 0.02,
            "rolls": 2, "cpu_s": 1e-4*resolution**3, **more}


def grid_rows():
    for scene in SCENES:
        for ra in RAS:
            for resolution in (24, 32, 48, math.inf):
                ke = k(ra, scene)*(1 + 7/resolution**2)
                yield energies(GRID, scene, ra, resolution, ke, ke, cpu_s=1e-4*min(resolution, 48)**3)
    for ra in RAS:
        ke = 2*k(ra)*1.03
        yield energies(("boussinesq", "mac"), "layer", ra, math.inf, ke, ke) | {"pr": 2.0, "cpu_s": 3.0}


def spam_rows(variant, scene, ra, rows, worse=1.0):
    for seed in (1, 2, 3):
        kg = k(ra, scene)*(1 - 9*worse/rows)*(1 + 0.01*seed)
        yield energies(("spam", variant), scene, ra, rows, kg + worse*0.04/rows, kg, seed,
                       particles=rows**2*(1 if scene == "box" else 2))


def kinetic():
    yield from grid_rows()
    for ra in RAS[:1] + RAS[2:]:
        for rows in (25, 35, 50):
            yield from spam_rows("printed", "layer", ra, rows)
        for rows in (20, 28, 40):
            yield from spam_rows("printed", "box", ra, rows)
        for scene in ("nu", "vdw"):
            yield from spam_rows("printed", scene, ra, 50)
    for ra in (5000.0, 10000.0):
        for number, variant in enumerate((*RULES[1:], "direct", "less-static-90", "wendland-c2")):
            for rows in (25, 50):
                yield from spam_rows(variant, "layer", ra, rows, 0.5 + 0.2*number)


def means(runs):
    """Means over seeds as the study has them."""
    for _, group in pd.DataFrame(runs).groupby(tables.POINT):
        row = group.iloc[0].to_dict()
        yield {name: row[name] for name in tables.MEANS.columns if name in row} | {
            "seeds": len(group), **{name: group[name].mean() for name in ("ke", "ke_field", "nu", "ke_fluctuation")}}


def history():
    t = np.linspace(0, 4500, 60)
    for method, seeds in ((SPAM, (1, 2, 3)), (GRID, (0,))):
        for seed in seeds:
            ke = 0.0048 + 0.003*np.exp(-t/800)*np.cos(t/300 + 0.1*seed)
            for at, value in zip(t, ke):
                yield {**point(method, "layer", 1e4, 50), "seed": seed, "t": at, "t_viscous": at/5000, "ke": value*1.1,
                       "ke_field": value}


def flow(x, y):
    return np.sin(np.pi*x)*np.sin(2*np.pi*y)*0.1, np.cos(np.pi*x)*np.cos(np.pi*y)*0.1


def fields():
    x, y = (q.ravel() for q in np.meshgrid((np.arange(20) + 0.5)/10 - 1, (np.arange(10) + 0.5)/10 - 0.5))
    vx, vy = flow(x, y)
    names = ("x", "y", "rho", "T", "vx", "vy")
    for method, scene, rows in ((SPAM, "layer", 12), (GRID, "layer", 48), (SPAM, "vdw", 8)):
        for values in zip(x, y, 1 - 2*vy*y, 1 - y + 2*vy, vx, vy):
            yield {**point(method, scene, 1e4, rows), "seed": 1, **dict(zip(names, values))}


def particles():
    for variant, scene, rows, behind in (("printed", "layer", 12, "image"), ("printed", "vdw", 8, "image"),
                                         ("printed-fixed-rows", "layer", 12, "fixed")):
        x, y = (q.ravel() for q in np.meshgrid((np.arange(-3, 2*rows + 3) + 0.5)/rows - 1,
                                               (np.arange(-3, rows + 3) + 0.5)/rows - 0.5))
        for number, (px, py, vx, vy) in enumerate(zip(x, y, *flow(x, y))):
            kind = "fluid" if abs(px) < 1 and abs(py) < 0.5 else behind if abs(px) < 1 else "image"
            yield {**point(("spam", variant), scene, 1e4, rows), "seed": 1, "number": number, "kind": kind, "x": px,
                   "y": py, "vx": vx, "vy": vy}


def walls():
    for number, variant in enumerate(RULES):
        for rows in (25, 50):
            for seed in (1, 2, 3):
                for plate, T, inward in (("lower", 1.5, -1), ("upper", 0.5, 1)):
                    yield {**point(("spam", variant), "layer", 1e4, rows), "seed": seed, "plate": plate, "T_wall": T,
                           "T_layer": T + inward*(0.05*number + 1/rows) + 0.002*seed, "reflections": 10,
                           "rho_layer": 1 - inward*(0.1 + 0.02*number)}


def cost():
    for method, variant, sizes, unit in ((*SPAM, (16, 25, 50), 1e-6), (*GRID, (16, 24, 48), 2e-7)):
        for rows in sizes:
            points = 2*rows**2
            yield {"method": method, "variant": variant, "eos": "ideal", "sides": "periodic", "resolution": rows,
                   "points": points, "step_s": unit*points + 1e-5, "step_s_err": 2e-6, "dt": 0.5, "threads": 1}


def errors(rows):
    for row in rows:
        if row["method"] != "boussinesq" and math.isfinite(row["resolution"]):
            yield {name: row[name] for name in tables.POINT} | {"cpu_s": 1e-3*row["resolution"]**3}


@pytest.fixture(scope="module")
def full(tmp_path_factory) -> Tables:
    """Every table of the study, written and read as the study does."""
    folder, runs = tmp_path_factory.mktemp("full"), list(kinetic())
    mean = list(means(runs))
    rows = {"kinetic_energy": runs, "means": mean, "history": history(), "fields": fields(), "particles": particles(),
            "walls": walls(), "cost": cost(), "errors": errors(mean)}
    for table in tables.ALL:
        if table.name in rows:
            merge(folder/"rb"/f"{table.name}.csv", table, list(rows[table.name]), size="quick")
    return load(tables.ALL, "rb", folder)


def pixels(page) -> bytes:
    picture = io.BytesIO()
    page.savefig(picture, format="png", metadata={"Software": None})
    return picture.getvalue()


def texts(page) -> str:
    """All words of a figure: titles, labels, legends."""
    return " ".join(found.get_text() for found in page.findobj(Text))


def test_full_tables_give_every_figure_with_labelled_axes(full):
    pages = figures.figures(full)
    assert list(pages) == list(figures.ALL)
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
    for name in ("main", "convergence", "walls", "fig9"):
        once = pixels(figures.ALL[name](full))
        assert pixels(figures.ALL[name](full)) == once, name
        assert pixels(figures.ALL[name](shuffled)) == once, f"{name} depends on the order of rows"


def test_figures_need_no_solver():
    """numba comes with every solver; a new process has loaded nothing else before."""
    code = "import sys, studies.convection.figures; print(sorted({'numba', 'pde', 'particles'} & set(sys.modules)))"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True, cwd=ROOT)
    assert done.stdout.strip() == "[]"


def test_the_line_is_fitted_between_onset_and_four_times_onset(full):
    """The made-up K is exactly this line there and below it beyond, where no row may enter the fit."""
    slope, constant = pick.straight_line(pick.reference(full, **pick.LAYER))
    assert slope == pytest.approx(-0.0082*math.sqrt(pick.RA_C), rel=1e-7)     # 9 digits in the CSV
    assert constant == pytest.approx(0.0082, rel=1e-7)
    above = pick.reference(full, **pick.LAYER)
    assert pick.straight_line(above[above["ra"] > 2500]) is None              # one row: no line


def test_errors_are_relative_to_the_extrapolated_grid_with_both_uncertainties(full):
    found = pick.errors_of_k(full, **pick.LAYER, ra=10000.0)
    row = found[(found["variant"] == "printed") & (found["resolution"] == 50)].iloc[0]
    assert row["kg"] == pytest.approx((1 - 9/50)*1.02 - 1, rel=1e-7)          # mean over seeds 1, 2, 3
    spread = math.hypot(0.02*(1 - 9/50)*1.01, 0.02)                           # the first seed's error, the grid's
    assert row["kg_err"] == pytest.approx(spread, rel=1e-7)
    grid = found[found["method"] == "compressible"].set_index("resolution")["kp"]
    assert grid.to_dict() == pytest.approx({n: 7/n**2 for n in (24, 32, 48)}, rel=1e-6)


def test_slopes_in_the_legend_are_those_of_the_rows(full):
    """Second order for the grid by construction; K_p changes sign at Ra = 10 000: no slope there."""
    words = texts(figures.ALL["convergence"](full))
    assert "compressible: slope -2.0" in words
    left, right = figures.ALL["convergence"](full).axes
    assert not any("K_p" in label and "slope" in label for label in right.get_legend_handles_labels()[1])
    assert any("K_g" in label and "slope -1.1" in label for label in left.get_legend_handles_labels()[1])


def test_only_particles_that_stand_still_where_the_grid_convects_are_called_frozen(full):
    assert "frozen" not in texts(figures.ALL["main"](full))      # at Ra = 1500 the grid is at rest, too
    mean = full["means"].copy()
    mean.loc[mean["method"].eq("spam") & mean["ra"].eq(2500.0), "ke_field"] = 1e-7
    words = [found.get_text() for found in figures.ALL["main"](Tables(full | {"means": mean})).findobj(Text)]
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
    upper, lower = figures.ALL["fig2_3"](full).axes
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
