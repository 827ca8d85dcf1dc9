"""Cost: at a level of error, its interval, seeds that diverged; what all cases take."""
import numpy as np
import pandas as pd
import pytest

from studies.cost import STUDY, cases, tables
from studies.cost.tables import GRID, LATTICE
from studies.kit.fits import crossing
from studies.kit.table import Tables


def lines(scale: dict[str, float]) -> Tables:
    """Methods with errors n^-2 and seconds scale n^3, n = 4, 8, 16, 24, as errors and runs."""
    rows = [{"scene": "convection", "seed": 1, "method": name, "resolution": n, "quantity": "K",
             "points": n**2, "error": n**-2.0, "error_err": 1e-6, "share": 0.5, "run_s": 2*factor*n**3,
             "setup_s": 0.0, "run_s_err": 1e-3*factor*n**3, "setup_s_err": 0.0}
            for name, factor in scale.items() for n in (4, 8, 16, 24)]
    runs, only = pd.DataFrame(rows), ["quantity", "error", "error_err", "share"]
    return Tables(errors=runs[[*tables.A_RUN, *only]], runs=runs.drop(columns=only))


def test_cost_at_a_level_is_that_of_the_power_law():
    rows = tables.derived(lines({GRID: 1.0, LATTICE: 3.0}))["needed"]
    needed = pd.DataFrame(rows).set_index(["method", "level"])
    row = needed.loc[(GRID, 0.01)]
    assert row["reached"] == "yes" and row["cpu_s"] == pytest.approx(1000, rel=1e-9)       # n = 10
    assert row["low"] < 1000 < row["high"] and row["points"] == pytest.approx(100, rel=1e-9)
    assert needed.loc[(LATTICE, 0.01), "cpu_s"] == pytest.approx(3000, rel=1e-9)
    assert needed.loc[(GRID, 0.001), "reached"] == "no"
    assert needed.loc[(GRID, 0.1), "reached"] == "at most"        # n = 4 has 6 % already


@pytest.mark.parametrize("level", [0.03, 0.01])
def test_the_interval_of_a_crossing_is_that_of_errors_in_all_four_numbers(level):
    """Each shifted by a thousandth of its error: the logarithm is straight that near to 1e-3."""
    pair = pd.DataFrame({"error": [0.04, 0.005], "error_err": [2e-3, 4e-4], "cpu_s": [1.0, 9.0],
                         "cpu_s_err": [0.05, 0.6]})
    value, half = crossing(pair, "cpu_s", level)
    shifts = []
    for column in ("error", "cpu_s"):
        for row in (0, 1):
            other = pair.copy()
            other.loc[row, column] += 1e-3*pair.loc[row, f"{column}_err"]
            shifts.append(np.log(crossing(other, "cpu_s", level)[0]/value)*1e3)
    assert np.linalg.norm(shifts) == pytest.approx(half, rel=1e-3)


def test_all_cases_together_take_what_was_planned_alone_on_the_machine():
    seconds = [case.cost for case in cases.cases("paper")]
    assert sum(seconds) < cases.TOGETHER and max(seconds) < cases.DEAREST
    assert all(case.alone for case in STUDY.cases("paper"))


def test_a_resolution_at_which_a_seed_diverged_has_no_mean():
    made = lines({GRID: 1.0})
    lost = made["errors"].iloc[:1].assign(seed=2, quantity="diverged", error=np.nan)
    means = tables.over_seeds(pd.concat([made["errors"], lost]), made["runs"], pd.DataFrame())
    assert means["resolution"].tolist() == [8, 16, 24]


def test_lammps_is_judged_by_its_own_fluid_where_it_was_timed(tmp_path, monkeypatch):
    (tmp_path/"bench").mkdir()
    rows = "rheo,16,K,3,0.2,2", "rheo,16,seconds,5,0.5,", "rheo,25,K,2,0.1,2", "rheo-RK1,16,K,3,0.2,2"
    (tmp_path/"bench"/"lammps.csv").write_text("\n".join(("style,rows,quantity,value,err,expected", *rows)))
    monkeypatch.setattr(tables, "RESULTS", tmp_path)
    [row] = tables.lammps()
    assert (row["method"], row["points"]) == ("LAMMPS RHEO", 512)
    assert [row[name] for name in ("error", "error_err", "cpu_s", "cpu_s_err")] == [0.5, 0.1, 5, 0.5]
