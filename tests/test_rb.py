"""The study rb: its points, what it refuses, and what the committed tables must say of the solvers."""
from functools import partial

import numpy as np
import pandas as pd
import pytest

import studies.rb.cases as rb
from continuum.gas.solve import steady_on
from continuum.scene import RayleighBenard
from studies.build import spam
from studies.kit.sweep import RESULTS, NoSuchCase, load
from studies.kit.table import read
from studies.rb import own, tables
from studies.rb.runs.grid import BoussinesqSteady, CompressibleSteady, PypdeSteady
from studies.rb.runs.points import DihRun, MovingRun
from studies.rb.runs.spam import SpamRun
from studies.rb.tables import KINETIC


@pytest.mark.parametrize(("wrong", "words"), [
    ({"L": 25.5}, r"whole rows and columns, got height L = 25\.5: give L as the number of rows"),
    ({"L": 0.2}, r"got height L = 0\.2"),
    ({"L": 25.0, "aspect": 1.5}, r"got width aspect L = 37\.5: .* columns over rows")])
def test_a_box_that_no_lattice_fills_is_refused(wrong, words):
    scene = RayleighBenard(ra=1e4, **wrong)
    for asked in (partial(SpamRun, scene=scene), partial(DihRun, scene=scene),
                  partial(MovingRun, scene=scene)):
        with pytest.raises(ValueError, match=words):
            asked()


@pytest.mark.parametrize("sizes", [(), 24])
@pytest.mark.parametrize("kind",
                         [partial(CompressibleSteady, scene=RayleighBenard(ra=1e4)),
                          partial(PypdeSteady, ra=1e4),
                                  partial(BoussinesqSteady, ra=1e4, pr=1.0)])
def test_no_grids_are_refused(kind, sizes):
    with pytest.raises(ValueError,
                       match=r"sizes must be the rows of one grid or more, got .*: give them coarsest first"):
        kind(sizes=sizes)
    with pytest.raises(ValueError, match=r"no grids \(sizes = \(\)\): give their rows"):
        steady_on(RayleighBenard(ra=1e4), ())


def test_paper_holds_the_points_of_the_printed_figures():
    runs = [case for case in rb.cases("paper") if isinstance(case, SpamRun)]
    points = {(round(r.scene.L), r.scene.ra, type(r.scene.eos).__name__, r.particles) for r in runs}
    assert {(50, 5000, "IdealGas", 5000), (50, 10000, "IdealGas", 5000), (50, 10000, "VanDerWaals", 5000),
            (40, 10000, "IdealGas", 1600), (16, 10000, "VanDerWaals", 512)} <= points
    seeds = {(r.scene, r.variant.name): set() for r in runs}
    for r in runs:
        seeds[r.scene, r.variant.name].add(r.seed)
    assert min(len(s) for (scene, _), s in seeds.items() if scene.L > 16) >= 3


# --- committed tables -----------------------------------------------------------------------------

committed = pytest.mark.skipif(not (RESULTS/"rb"/"kinetic_energy.csv").exists(),
                               reason="no tables are committed yet")


@pytest.fixture(scope="module")
def kinetic():
    return read(RESULTS/"rb"/"kinetic_energy.csv", KINETIC.columns)


def limit(kinetic, method, ra, pr=1.0, transport="const-eta", eos="ideal"):
    kinetic = kinetic[np.isinf(kinetic["resolution"].astype(float)) & (kinetic["variant"] != "edge-heat")]
    rows = kinetic.query("method == @method and ra == @ra and pr == @pr and sides == 'periodic'"
                         " and eos in [@eos, ''] and transport in [@transport, '']")
    assert len(rows) == 1, f"{len(rows)} limits of {method} at Ra {ra}"
    return rows.iloc[0]


@committed
@pytest.mark.parametrize("ra", [5000.0, 10000.0])
@pytest.mark.parametrize(("one", "other", "pr"), [("compressible", "pypde-compressible", 1.0),
                                                  ("boussinesq", "pypde-boussinesq", 1.0),
                                                  ("boussinesq", "pypde-boussinesq", 7.0)])
@pytest.mark.parametrize("column", ["ke", "nu"])
def test_two_independent_solvers_agree_within_their_uncertainties(kinetic, ra, one, other, pr, column):
    a, b = limit(kinetic, one, ra, pr), limit(kinetic, other, ra, pr)
    # the sum of both 95 % intervals, and 1e-4: closer than any interval from three grids can tell
    assert abs(a[column] - b[column]) <= a[f"{column}_err"] + b[f"{column}_err"] + 1e-4*a[column]


@pytest.mark.parametrize(("text", "kinds"), [
    ("wendland-c4", ["SpamRun"]), ("moving", ["MovingRun"]), ("moving-literal", ["DriftRun"]),
    ("fixed-lattice", ["DihRun"]), ("Monaghan", ["DihRun", "SpamRun"])])
def test_a_text_names_a_method_or_all_that_have_it_in_their_names(text, kinds):
    cases = own.cases(text, 16, 2)
    assert sorted(type(case).__name__ for case in cases if case.seed == 1) == kinds
    assert len(cases) == 2*len(kinds) and {case.scene.L for case in cases} == {16}


def test_a_text_in_no_name_is_told_names_near_to_it():
    with pytest.raises(NoSuchCase, match=r"'wendland-c9' in its name; near to it are .*spam-wendland-c6"):
        own.cases("wendland-c9", 16, 1)


def test_what_is_tried_out_stands_beside_its_kin_with_the_nearest_rows():
    [case] = own.cases("wendland-c2", 25, 1)
    row = {**case.point, "ke_field": 1/7, "ke_field_err": 0.01}
    known = load(tables.ALL, "rb", RESULTS)
    head, mine, _, *kin = own.beside([case], {"means": pd.DataFrame([row])}, known)
    assert mine == " 25 rows  0.142857 +- 0.010000  spam-wendland-c2" and "Ra 10000" in head
    assert sum(line.endswith(" spam") for line in kin) == 1 and all(" fixed-" not in line for line in kin)
    assert any(line.startswith(" 50 rows") and "spam-wendland-c2" in line for line in kin), "25 is its own"
    assert any(line.startswith("   limit") and "grid" in line for line in kin)
    assert "diverged" in list(own.beside([case], {}, known))[1]


def test_a_run_that_diverges_is_a_row_without_energies(tmp_path):
    """Images with T -> 2 T_w - T and a pressure of their own get T < 0 behind the cold plate."""
    where = rb.RayleighBenard(ra=1e4, L=20.0)
    case = SpamRun(scene=where, variant=spam.VARIANTS["walls-odd-own-pressure"])
    [row] = case.run(lambda done: None, tmp_path).rows["kinetic_energy"]
    assert np.isnan([row["ke"], row["ke_field"], row["nu"]]).all()
    assert not row["converged"] and 0 < row["steps"] < case.plan(tmp_path).steps
    assert row["t_end"] == pytest.approx(row["steps"]*row["dt"])
