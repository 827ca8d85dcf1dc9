"""The study rb: its points, what it refuses, and what the committed tables must say of the solvers."""
from functools import partial

import numpy as np
import pytest

import studies.rb.cases as rb
from continuum.gas.solve import steady_on
from continuum.scene import RayleighBenard
from studies.build import spam
from studies.kit.sweep import RESULTS
from studies.kit.table import read
from studies.rb.runs.grid import BoussinesqSteady, CompressibleSteady, PypdeSteady
from studies.rb.runs.points import DihRun, MovingRun
from studies.rb.runs.spam import SpamRun
from studies.rb.tables import KINETIC


@pytest.mark.parametrize(("wrong", "words"), [
    ({"L": 25.5}, r"whole rows and columns, got height L = 25\.5: give L as the number of rows"),
    ({"L": 0.2}, r"got height L = 0\.2"), ({"L": 25.0, "aspect": 1.5}, r"got width aspect L = 37\.5: .* columns over rows")])
def test_a_box_that_no_lattice_fills_is_refused(wrong, words):
    scene = RayleighBenard(ra=1e4, **wrong)
    for asked in (partial(SpamRun, scene=scene), partial(DihRun, scene=scene), partial(MovingRun, scene=scene)):
        with pytest.raises(ValueError, match=words):
            asked()


@pytest.mark.parametrize("sizes", [(), 24])
@pytest.mark.parametrize("kind", [partial(CompressibleSteady, scene=RayleighBenard(ra=1e4)), partial(PypdeSteady, ra=1e4),
                                  partial(BoussinesqSteady, ra=1e4, pr=1.0)])
def test_no_grids_are_refused(kind, sizes):
    with pytest.raises(ValueError, match=r"sizes must be the rows of one grid or more, got .*: give them coarsest first"):
        kind(sizes=sizes)
    with pytest.raises(ValueError, match=r"no grids \(sizes = \(\)\): give their rows"):
        steady_on(RayleighBenard(ra=1e4), ())


def test_sizes_nest():
    """fine holds paper, and no two cases of a size have one key."""
    keys = {size: [case.key for case in rb.cases(size)] for size in ("quick", "paper", "fine")}
    assert all(len(set(k)) == len(k) for k in keys.values())
    assert set(keys["paper"]) <= set(keys["fine"])


def test_paper_holds_the_points_of_the_printed_figures():
    runs = [case for case in rb.cases("paper") if isinstance(case, SpamRun)]
    points = {(round(r.scene.L), r.scene.ra, type(r.scene.eos).__name__, r.particles) for r in runs}
    assert {(50, 5000, "IdealGas", 5000), (50, 10000, "IdealGas", 5000), (50, 10000, "VanDerWaals", 5000),
            (40, 10000, "IdealGas", 1600), (16, 10000, "VanDerWaals", 512)} <= points
    seeds = {(r.scene, r.variant.name): set() for r in runs}
    for r in runs:
        seeds[r.scene, r.variant.name].add(r.seed)
    assert min(len(s) for (scene, _), s in seeds.items() if scene.L > 16) >= 3


# --- committed tables ---------------------------------------------------------------------------------------

committed = pytest.mark.skipif(not (RESULTS/"rb"/"kinetic_energy.csv").exists(), reason="no tables are committed yet")


@pytest.fixture(scope="module")
def kinetic():
    return read(RESULTS/"rb"/"kinetic_energy.csv", KINETIC.columns)


def limit(kinetic, method, ra, pr=1.0, transport="const-eta", eos="ideal"):
    rows = kinetic[(kinetic["method"] == method) & np.isinf(kinetic["resolution"].astype(float)) & (kinetic["ra"] == ra)
                   & (kinetic["pr"] == pr) & kinetic["eos"].isin([eos, ""]) & kinetic["transport"].isin([transport, ""])
                   & (kinetic["sides"] == "periodic") & (kinetic["variant"] != "edge-heat")]
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
    # the sum of the two 95 % intervals, and 1e-4 where both are closer than any interval from three grids can tell
    assert abs(a[column] - b[column]) <= a[f"{column}_err"] + b[f"{column}_err"] + 1e-4*a[column]


@committed
def test_compressible_limits_are_good_to_a_thousandth(kinetic):
    rows = kinetic[(kinetic["method"] == "compressible") & np.isinf(kinetic["resolution"].astype(float))
                   & (kinetic["ke"] > 1e-4) & (kinetic["ra"] <= 10000)]
    assert len(rows) > 10
    assert (rows["ke_err"]/rows["ke"]).max() < 1e-3     # a tenth of what decides claims on K


def test_a_run_that_diverges_is_a_row_without_energies(tmp_path):
    """Images with T -> 2 T_w - T and a pressure of their own get T < 0 behind the cold plate."""
    where = rb.RayleighBenard(ra=1e4, L=20.0)
    case = SpamRun(scene=where, variant=spam.VARIANTS["walls-odd-own-pressure"])
    [row] = case.run(lambda done: None, tmp_path).rows["kinetic_energy"]
    assert np.isnan([row["ke"], row["ke_field"], row["nu"]]).all()
    assert not row["converged"] and 0 < row["steps"] < case.plan(tmp_path).steps
    assert row["t_end"] == pytest.approx(row["steps"]*row["dt"])
