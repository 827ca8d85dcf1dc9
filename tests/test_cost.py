"""Cost: what is derived, figures and verdicts on tables, cases."""
import numpy as np
import pandas as pd
import pytest

from studies.cost import STUDY, cases, derive, figures
from studies.cost.claims import ERRORS
from studies.cost.race import Race
from studies.cost.tables import GRID, LATTICE, LUCY, METHODS, MOVING, NEAREST, RUN
from studies.kit.claim import judge
from studies.kit.table import Tables


def lines(scale: dict[str, float], scene="convection", quantity="K", err=1e-6) -> Tables:
    """Methods with errors n^-2 and seconds scale n^3, n = 4, 8, 16, 24, as errors and runs."""
    rows = [{"scene": scene, "seed": 1, "method": name, "resolution": n, "quantity": quantity, "points": n**2,
             "error": n**-2.0, "error_err": err, "share": 0.5, "run_s": 2*factor*n**3, "setup_s": 0.0,
             "run_s_err": 1e-3*factor*n**3, "setup_s_err": 0.0}
            for name, factor in scale.items() for n in (4, 8, 16, 24)]
    runs, only = pd.DataFrame(rows), ["quantity", "error", "error_err", "share"]
    return with_derived(derive.errors, errors=runs[[*RUN, *only]], runs=runs.drop(columns=only))


def with_derived(rule, **tables) -> Tables:
    more = {name: pd.DataFrame(rows) for name, rows in rule(Tables(tables)).items() if rows}
    return Tables(tables | more)


def verdicts(claims, tables):
    return {row["id"]: (row["verdict"], row["measured"]) for row in judge(claims, tables, "cost")}


# --- what errors cost ---------------------------------------------------------------------------------------


def test_cost_at_a_level_is_that_of_the_power_law():
    needed = lines({GRID: 1.0, LATTICE: 3.0})["needed"].set_index(["method", "level"])
    row = needed.loc[(GRID, 0.01)]
    assert row["reached"] == "yes" and row["cpu_s"] == pytest.approx(1000, rel=1e-9)       # n = 10
    assert row["low"] < 1000 < row["high"] and row["points"] == pytest.approx(100, rel=1e-9)
    assert needed.loc[(LATTICE, 0.01), "cpu_s"] == pytest.approx(3000, rel=1e-9)
    assert needed.loc[(GRID, 0.001), "reached"] == "no"
    assert needed.loc[(GRID, 0.1), "reached"] == "at most"        # n = 4 has 6 % already


def test_errors_that_come_back_above_a_level_have_not_reached_it():
    group = pd.DataFrame({"error": [0.2, 0.005, 0.02, 0.004], "error_err": [1e-5]*4, "cpu_s": [1.0, 2, 4, 8],
                          "cpu_s_err": [0.1]*4, "points": [1.0, 2, 3, 4]})
    assert 4 < derive.reached(group, 0.01)["cpu_s"] < 8
    assert derive.reached(group.iloc[:3], 0.01)["reached"] == "no"
    crossing = group.iloc[:2].assign(error_err=[1e-5, 0.05])        # an error of either sign: 0.5 % +- 5 %
    assert derive.reached(crossing, 0.01)["reached"] == "no"


def test_the_interval_of_an_error_holds_what_half_of_the_chosen_step_changes():
    errors = lines({GRID: 1.0})["errors"].assign(error_err=4e-3)
    rung = errors[[*RUN, "quantity"]]
    steps = pd.concat([rung.assign(of_limit=0.9, time_error=7.0, accepted=0),
                       rung.assign(of_limit=0.45, time_error=3e-3, accepted=1)])
    wider = derive.with_steps(errors, steps)
    assert wider["error_err"].to_numpy() == pytest.approx(5e-3) and wider["error"].equals(errors["error"])
    assert list(wider) == list(errors) and derive.with_steps(errors, pd.DataFrame()).equals(errors)


@pytest.mark.parametrize("level", [0.03, 0.01])
def test_the_interval_of_a_crossing_is_that_of_errors_in_all_four_numbers(level):
    """Each shifted by a thousandth of its error: the logarithm is straight that near to 1e-3."""
    pair = pd.DataFrame({"error": [0.04, 0.005], "error_err": [2e-3, 4e-4], "cpu_s": [1.0, 9.0],
                         "cpu_s_err": [0.05, 0.6]})
    value, half = derive.crossing(pair, "cpu_s", level)
    shifts = []
    for column in ("error", "cpu_s"):
        for row in (0, 1):
            other = pair.copy()
            other.loc[row, column] += 1e-3*pair.loc[row, f"{column}_err"]
            shifts.append(np.log(derive.crossing(other, "cpu_s", level)[0]/value)*1e3)
    assert np.linalg.norm(shifts) == pytest.approx(half, rel=1e-3)


def test_a_resolution_at_which_a_seed_diverged_has_no_mean():
    made = lines({GRID: 1.0})
    lost = made["errors"].iloc[:1].assign(seed=2, quantity="diverged", error=np.nan)
    means = derive.over_seeds(pd.concat([made["errors"], lost]), made["runs"], pd.DataFrame())
    assert means["resolution"].tolist() == [8, 16, 24]


def test_verdicts_follow_the_lines():
    said = verdicts(ERRORS, lines({GRID: 1.0, LATTICE: 1.5, MOVING: 40.0, LUCY: 20.0}))
    assert said["own-speed-fixed-points"] == ("holds", pytest.approx(1.5))
    assert said["own-speed-moving-points"] == ("fails", pytest.approx(40))
    assert said["own-speed-particles"] == ("fails", pytest.approx(20))
    assert said["own-speed-freedoms"] == ("fails", pytest.approx(1))
    assert said["own-speed-threads-spam"][0] == "undecidable"
    lower = verdicts(ERRORS, lines({GRID: 1.0, NEAREST: 1.5}, scene="convection-5000"))
    assert lower["own-speed-fixed-points-5000"][0] == "holds"
    assert lower["own-speed-fixed-points"][0] == "undecidable"


def test_growth_laws_are_those_of_the_table():
    n = np.array([1e3, 1e4, 1e5])
    cpu = pd.DataFrame({"method": LUCY, "points": n, "threads": 1, "clock": "cpu", "step_s": n**1.1})
    wall = pd.DataFrame({"method": LUCY, "points": 1e5, "threads": [1, 2], "clock": "wall",
                         "step_s": [1.8, 1.0], "step_s_err": [0.018, 0.01]})
    tables = with_derived(derive.errors, growth=pd.concat([cpu, wall]))
    laws = tables["growth_laws"].set_index("what")
    assert laws.loc["exponent", "value"] == pytest.approx(1.1, rel=1e-9)
    assert laws.loc["two threads", "value"] == pytest.approx(1.8)
    assert laws.loc["two threads", "value_err"] == pytest.approx(1.8*0.01*2**0.5, rel=1e-9)
    said = verdicts(ERRORS, tables)
    assert said["own-speed-growth-spam"][0] == "undecidable"        # 1e5 particles of a million
    assert said["own-speed-threads-spam"][0] == "holds"             # 1.8 +- 0.025 against 1.7


# --- what terms cost ----------------------------------------------------------------------------------------


def left_out(**parts) -> Tables:
    """`measured` of one base; (step_s, time_s, bytes, changed) of what is left."""
    rows = [{"scene": "taylor-green", "base": "fixed-lattice", "left_out": name, "quantity": "velocity",
             "step_s": step, "step_s_err": 0.01*step, "time_s": time, "time_s_err": 0.01*time, "bytes": size,
             "error": 0.02, "changed": changed} for name, (step, time, size, changed) in parts.items()]
    return with_derived(derive.terms, measured=pd.DataFrame(rows))


SOME = {"nothing": (2.0, 4.0, 100.0, 0.0), "heat": (1.0, 3.0, 60.0, 0.001), "motion": (2.0, 4.0, 100.0, 0.88),
        "noise": (np.nan, np.nan, 100.0, np.nan)}


def test_ratios_are_to_the_whole_and_what_matters_is_needed():
    rows = left_out(**SOME)["scenes"].set_index("left_out")
    heat = rows.loc["heat", ["step_ratio", "time_ratio", "bytes_ratio"]]
    assert heat.tolist() == pytest.approx([0.5, 0.75, 0.6])
    assert rows.loc["heat", "step_ratio_err"] == pytest.approx(0.5*0.01*2**0.5)
    assert rows["needed"].to_dict() == {"nothing": "no", "heat": "no", "motion": "yes", "noise": "yes"}
    busy = derive.terms(Tables(measured=left_out(**SOME)["measured"].assign(step_s_err=3.0)))["scenes"]
    assert np.isnan([row["step_ratio"] for row in busy]).all()      # times that scatter as much as they last
    assert np.isfinite([row["time_ratio"] for row in busy]).sum() == 3


def test_the_figure_names_what_is_needed():
    axes, = figures.TERMS(left_out(**SOME))["scenes"].axes
    words = "\n".join(tick.get_text() for tick in axes.get_yticklabels())
    assert "without heat: off by 0.1 %, not needed" in words and "without noise: diverges, needed" in words


# --- the figure of errors -----------------------------------------------------------------------------------


def test_every_method_has_a_look_of_its_own():
    """Without colour, too; a family has one marker, which is its own."""
    looks = {name: {**figures.style(name), "color": ""} for name in METHODS}
    assert len({str(sorted(look.items(), key=str)) for look in looks.values()}) == len(looks)
    markers = {(figures.family(name), look["marker"]) for name, look in looks.items()}
    assert len(markers) == len({marker for _, marker in markers}) == len(figures.FAMILIES)


# --- cases --------------------------------------------------------------------------------------------------


def test_all_cases_together_take_what_was_planned_alone_on_the_machine():
    seconds = [case.cost for case in cases.cases("paper")]
    assert sum(seconds) < cases.TOGETHER and max(seconds) < cases.DEAREST
    assert all(case.alone for case in STUDY.cases("paper"))


def test_every_method_runs_at_four_resolutions_or_more():
    ladders = {}
    for case in cases.cases("paper"):
        if isinstance(case, Race):
            ladders.setdefault((case.scene, case.entry.name), set()).add(case.resolution)
    wanted = {(scene, name) for scene, contest in cases.CONTESTS.items() for name in contest}
    lower = {("convection-5000", GRID), ("convection-5000", NEAREST)}
    assert set(ladders) == {pair for pair in wanted if pair[0] != "convection-5000"} | lower
    assert {name for _, name in ladders} == set(METHODS) and min(map(len, ladders.values())) >= 4
    # of moving points a rung on either side of 1 % in K, whose error falls as rows^-2.1 from 3.2 % at 24
    *_, coarse, fine = sorted(ladders["convection", MOVING])
    assert 0.032*(24/coarse)**2.1 > 0.01 > 0.032*(24/fine)**2.1
