"""Sod's tube by the grid, by fixed and by moving points: set up, read off, judged. High Ra: how a limit is sought."""
import numpy as np
import pandas as pd
import pytest

from continuum.exact.riemann import middle
from continuum.fluid import ConstEta
from studies.hardcases.high_ra import methods as high_ra_methods
from studies.hardcases.high_ra import runs as high_ra
from studies.hardcases.tube import runs as tubes
from studies.hardcases.tube.claims import CLAIMS, stopped
from studies.hardcases.tube.methods import METHODS, Seen, binned, ended, gases
from studies.hardcases.tube.runs import MethodTube, centres, last_above, orders, places, told, viscous
from studies.hardcases.tube.spam import DENSE, EOS, GAMMA, HEIGHT, THIN, exact
from studies.kit.claim import CannotTell, judge
from studies.kit.table import Tables

SHORT = 12


def quiet(done: float) -> None:
    """No progress."""


# --- tubes --------------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("method", METHODS)
def test_every_method_has_sods_waves_and_the_gas_that_it_began_with(method):
    """Viscous fields of a fine grid to a few hundredths; mass and energy of both gases to round-off."""
    found = METHODS[method](SHORT, ConstEta(0.5, 0.5), 1, 0.5, quiet)
    rho, v, P = found.fields
    assert found.reached == 1
    np.testing.assert_allclose(np.abs(found.fields - viscous(SHORT, 0.5)).mean(axis=1), 0, atol=0.03)
    loose = 0.02 if method in tubes.RANDOM else 1e-10      # cells have not all one volume
    assert rho.sum()/SHORT == pytest.approx(DENSE.rho + THIN.rho, rel=loose)
    if method != "grid":        # whose energies are at nodes
        inner = (P*EOS.cv + rho*v**2/2).sum()/SHORT
        assert inner == pytest.approx(EOS.cv*(DENSE.P + THIN.P), rel=max(loose, 1e-4))


def test_nothing_happens_in_a_uniform_gas(monkeypatch):
    """The same pressure and density everywhere stay, on disordered points too."""
    monkeypatch.setattr("studies.hardcases.tube.methods.THIN", DENSE)
    for method in METHODS:
        if method != "grid":
            _, v, P = METHODS[method](SHORT, ConstEta(0.0, 0.0), 1, 0.5, quiet).fields
            np.testing.assert_allclose(v, 0, atol=1e-9)
            np.testing.assert_allclose(P, DENSE.P, rtol=1e-9)


def test_points_are_binned_by_volume_and_both_tubes_count():
    x, V = np.array([0.5, -0.5, 1.5]), np.array([1.0, 0.5, 0.8])
    sums = np.array([[1.0, 1.0, 4.0], [0.5, -1.5, 2.0], [0.0, 0.0, 4.0], [5.0, 7.0, 9.0]])
    rho, v, P = binned(1, x, V, sums)
    np.testing.assert_allclose(rho, [2/1.5, 5.0])
    np.testing.assert_allclose(v, [1.0, 0.5])
    inner = [(5 - 0.125) + (7 - 1.125), 9 - 20/8]
    np.testing.assert_allclose(P, np.array(inner)/[1.5, 0.8]/EOS.cv)
    wide = binned(2, np.array([0.5, 2.5]), np.array([1.0, 3.0]), np.array([[1.0, 3.0], [1.0, 6.0], [0, 0], [9.0, 99.0]]))
    np.testing.assert_allclose(wide[1], [1, 2, 2, 2])
    rho, T = gases(3, np.array([-4.0, -2.0, 2.0, 4.0]))
    np.testing.assert_allclose(rho*T, [THIN.P, DENSE.P, DENSE.P, THIN.P])
    assert HEIGHT == round(HEIGHT)      # a row of points in each spacing


def test_places_of_the_exact_solution_are_its_own():
    """Shock at 1.75216 t, contact at 0.92745 t    [Toro 1997, table 4.2]"""
    L = 400
    shock, contact = places(centres(L), exact(L, centres(L)))
    np.testing.assert_allclose([shock, contact], [L + 0.4*L*1.75216, L + 0.4*L*0.92745], atol=1.0)
    x = np.arange(5.0)
    assert last_above(x, np.array([3.0, 0, 3, 1, 0]), 2.0) == 2.5 and np.isnan(last_above(x, x, 2.0))


def test_rows_know_the_exact_solution_and_what_ended():
    truth = exact(SHORT, centres(SHORT))
    row = told(SHORT, 0.0, Seen(truth, 0.0))
    assert row["v_exact"] == row["wiggles"] == row["shock_exact"] == row["noise"] == 0 and np.isnan(row["v_grid"])
    wavy = truth + np.array([[0], [0.1], [0]])*(-1)**np.arange(2*SHORT)
    assert told(SHORT, 0.0, Seen(wavy, 0.0))["wiggles"] > 1
    late = told(SHORT, 0.5, ended(SHORT, 0.3))
    assert late["reached"] == 0.3 and all(np.isnan(value) for name, value in late.items() if name != "reached")


def test_orders_are_slopes_and_leave_out_what_ended():
    rows = pd.DataFrame([{"method": "grid", "eta": 0.5, "step": 0.5, "L": L, "seed": 1, "reached": reached, **{
        f"{name}_{of}": L**-power if of == "exact" else np.nan for name, power in (("rho", 0.5), ("v", 1.0), ("P", 2.0))
        for of in ("exact", "grid")}}
        for L, reached in ((10, 1.0), (20, 1.0), (40, 1.0), (80, 0.5))])
    found = {row["quantity"]: row for row in orders(rows)}
    assert {name: round(row["order"], 9) for name, row in found.items()} == {"rho": 0.5, "v": 1.0, "P": 2.0}
    assert found["v"]["lengths"] == 3 and not list(orders(rows[rows["L"] < 40]))


def test_claims_about_tubes_that_ended_say_so():
    row = MethodTube(method="fixed lattice", L=SHORT, eta=0.5).run(quiet, None).rows["method_tubes"][0]
    stopped_row = {**row, "reached": 0.4}
    tables = Tables(method_tubes=pd.DataFrame([stopped_row]))
    assert stopped(method="fixed lattice", eta=0.5)(tables).value == 1
    asked = [claim for claim in CLAIMS if claim.id == "sod-fixed-lattice-grid"]
    assert "0.4 of its time" in judge(asked, tables, "hardcases")[0]["reason"]
    good = judge(asked, Tables(method_tubes=pd.DataFrame([row])), "hardcases")[0]
    assert good["verdict"] in ("holds", "fails") and good["measured"] < 0.1
    with pytest.raises(CannotTell):
        asked[0].value(Tables())


def test_barely_viscous_gas_has_a_cell_number_of_two_behind_the_shock():
    between = middle(DENSE, THIN, GAMMA)
    assert between.v/(tubes.BARELY/between.right) == pytest.approx(2, rel=0.01)


# --- high Ra ------------------------------------------------------------------------------------------------------------


def test_a_limit_is_found_where_runs_turn_bad_and_each_runs_once(monkeypatch):
    runs = []

    def method(ra, seed, step):
        runs.append(ra)
        return high_ra.Trial(0.01*(1 if ra < 2e5 else 1.5), 1.0 if ra < 3e6 else 0.5)
    monkeypatch.setitem(high_ra.METHODS, "made up", method)
    monkeypatch.setattr(high_ra, "should_be", lambda ra: 0.01)
    rows = {row["kind"]: row for row in high_ra.HighRa(method="made up", seed=1).run(quiet, None).rows["high_ra"]}
    assert rows["wrong"]["ra"] == pytest.approx(2e5, rel=0.01) and rows["ends"]["ra"] == pytest.approx(3e6, rel=0.01)
    assert all(0 < row["ra_err"] < 0.01*row["ra"] for row in rows.values()) and len(runs) == len({f"{ra:.9g}" for ra in runs})


def test_no_limit_is_said_where_none_is():
    search = high_ra.Search("grid", 1, 1.0)
    search.found = {ra: high_ra.Trial(0.01, 1.0) for ra in (1e4, 1e5)}
    found = search.limit(search.ends, 1e8)
    assert np.isnan(found["ra"]) and found["tried"] == 1e5 and found["outcome"] == "none"


def test_a_limit_is_the_first_bad_trial_though_later_ones_are_good():
    search = high_ra.Search("grid", 1, 1.0)
    trials = ((4e4, 1.0), (1e4, 1.0), (9e4, 0.3), (2e5, 1.0), (1e6, 0.1))
    search.found = {ra: high_ra.Trial(0.01, reached) for ra, reached in trials}
    found = search.limit(search.ends, 1e8)
    assert found["ra"] == pytest.approx(6e4) and found["ra_err"] == 2.5e4 and found["again"] == 1 and found["outcome"] == "ends"


def test_expected_is_where_the_fastest_flow_has_a_cell_number_of_two():
    grid = pd.DataFrame({"ra": [1e4, 1e5, 1e6], "rows": high_ra.FINER, "cell_number": [2.0, 2*10**0.5, 20.0]})
    limits = pd.DataFrame([{"method": "grid", "step": 1.0, "seed": seed, "kind": kind, "ra": ra, "outcome": "wrong but stable"}
        for seed, kind, ra in (
        (1, "wrong", 1e5), (2, "wrong", 4e5), (1, "ends", 1e5), (2, "ends", np.nan))])
    rows = {row["kind"]: row for row in high_ra.derive({"high_ra": limits, "high_ra_grid": grid})["high_ra_summary"]}
    assert rows["wrong"]["predicted"] == pytest.approx(1e4) and rows["wrong"]["ra"] == pytest.approx(2e5)
    assert rows["wrong"]["outcome"] == "wrong but stable" and rows["ends"]["seeds"] == 1


@pytest.mark.parametrize("method", high_ra.METHODS)
def test_methods_convect_alike_where_rows_suffice(method, monkeypatch):
    """A few free-fall times at Ra 1e4: K within a fifth of the grid's: moving points begin a tenth too fast."""
    monkeypatch.setattr(high_ra_methods, "TIME", 8.0)
    found, grid = high_ra.METHODS[method](1e4, 1, 1.0), high_ra_methods.gridded(1e4, 2, 1.0)
    assert found.reached == 1 and found.k == pytest.approx(grid.k, rel=0.2)
