"""Cost: what is derived, figures and verdicts on tables, cases."""
import numpy as np
import pandas as pd
import pytest

from studies.cost import STUDY, cases, derive, figures, names, tables
from studies.cost.claims import ERRORS
from studies.cost.growth import Growth, Threads
from studies.cost.problem import Race
from studies.kit.claim import judge
from studies.kit.table import Tables


def lines(scale: dict[str, float], scene="convection", quantity="K", err=1e-6) -> Tables:
    """Methods with errors n^-2 and seconds scale n^3, n = 4, 8, 16, 24, as errors and runs."""
    key = {"scene": scene, "seed": 1}
    sizes = (4, 8, 16, 24)
    errors = [{**key, "method": name, "resolution": n, "quantity": quantity, "error": n**-2.0, "error_err": err, "share": 0.5}
              for name in scale for n in sizes]
    runs = [{**key, "method": name, "resolution": n, "points": n**2, "run_s": 2*factor*n**3, "run_s_err": 1e-3*factor*n**3,
             "setup_s": 0.0, "setup_s_err": 0.0, "bytes": 8.0*n**2} for name, factor in scale.items() for n in sizes]
    measured = Tables({"errors": pd.DataFrame(errors), "runs": pd.DataFrame(runs)})
    return Tables(measured | {name: pd.DataFrame(rows) for name, rows in derive.errors(measured).items() if rows})


def test_cost_at_a_level_and_exponent_are_those_of_the_power_law():
    found = lines({names.GRID: 1.0, names.LATTICE: 3.0})
    row = found["needed"].query(f"method == '{names.GRID}' and level == 0.01").iloc[0]
    assert row["reached"] == "yes" and row["cpu_s"] == pytest.approx(1000, rel=1e-9)       # n = 10
    assert row["low"] < 1000 < row["high"] and row["points"] == pytest.approx(100, rel=1e-9)
    assert found["exponents"]["exponent"].to_numpy() == pytest.approx([1.5, 1.5], rel=1e-9)
    best = found["cheapest"].set_index("level")
    assert best.loc[0.01, "method"] == names.GRID and best.loc[0.001, "method"] == "not reached"
    assert best.loc[0.1, "reached"] == "at most"        # n = 4 has 6 % already


def test_errors_that_come_back_above_a_level_have_not_reached_it():
    group = pd.DataFrame({"resolution": [1, 2, 3, 4], "error": [0.2, 0.005, 0.02, 0.004], "error_err": [1e-5]*4,
                          "cpu_s": [1.0, 2, 4, 8], "cpu_s_err": [0.1]*4, "points": [1.0, 2, 3, 4]})
    assert 4 < derive.reached(group, 0.01)["cpu_s"] < 8
    assert derive.reached(group.iloc[:3], 0.01)["reached"] == "no"
    crossing = group.iloc[:2].assign(error_err=[1e-5, 0.05])        # an error of either sign: 0.5 % +- 5 %
    assert derive.reached(crossing, 0.01)["reached"] == "no"


def test_the_interval_of_an_error_holds_what_half_of_the_chosen_step_changes():
    made = lines({"grid": 1.0})
    errors, rung = made["errors"], made["errors"][[*tables.RUN, "quantity"]]
    steps = pd.concat([rung.assign(of_limit=0.9, time_error=7.0, accepted=0),
                       rung.assign(of_limit=0.45, time_error=3e-3, accepted=1)])
    wider = derive.with_steps(errors.assign(error_err=4e-3), steps)
    assert wider["error_err"].to_numpy() == pytest.approx(5e-3) and wider["error"].equals(errors["error"])
    assert list(wider) == list(errors) and derive.with_steps(errors, pd.DataFrame()).equals(errors)


def test_the_interval_of_a_crossing_is_that_of_random_errors():
    error, err, cost, cost_err = np.array([0.04, 0.005]), np.array([2e-3, 4e-4]), np.array([1.0, 9.0]), np.array([0.05, 0.6])
    value, half = derive.crossing(error, err, cost, cost_err, 0.01)
    rng = np.random.default_rng(1)
    some = [derive.crossing(rng.normal(error, err/1.96), err, rng.normal(cost, cost_err/1.96), cost_err, 0.01)[0]
            for _ in range(4000)]
    assert np.std(np.log(some))*1.96 == pytest.approx(half, rel=0.08)     # 2 % of statistics, second order for the rest
    assert np.median(some) == pytest.approx(value, rel=0.02)


def verdicts(made):
    return {row["id"]: (row["verdict"], row["measured"]) for row in judge(ERRORS, made, "cost")}


def test_verdicts_follow_the_lines():
    said = verdicts(lines({names.GRID: 1.0, names.LATTICE: 1.5, names.MOVING: 40.0}))
    assert said["own-speed-fixed-points"] == ("holds", pytest.approx(1.5))
    assert said["own-speed-moving-points"] == ("fails", pytest.approx(40))
    assert said["own-speed-threads-spam"][0] == "undecidable"
    lower = verdicts(lines({names.GRID: 1.0, names.NEAREST: 1.5}, scene="convection-5000"))
    assert lower["own-speed-fixed-points-5000"][0] == "holds" and lower["own-speed-fixed-points"][0] == "undecidable"


def test_memory_is_that_of_the_finest_run():
    found, = (row for row in lines({names.GRID: 1.0})["memory"].to_dict("records"))
    assert (found["resolution"], found["points"], found["bytes_a_point"]) == (24, 576, 8)


def test_particles_are_compared_with_the_grid_of_the_same_error():
    said = verdicts(lines({names.GRID: 1.0, names.LUCY: 20.0}))
    assert said["own-speed-particles"] == ("fails", pytest.approx(20))
    assert said["own-speed-freedoms"] == ("fails", pytest.approx(1))


def test_growth_laws_are_those_of_the_table():
    n = np.array([1e3, 1e4, 1e5])
    cpu = pd.DataFrame({"method": names.LUCY, "points": n, "threads": 1, "clock": "cpu", "step_s": n**1.1, "step_s_err": 0.0})
    wall = pd.DataFrame({"method": names.LUCY, "points": 1e5, "threads": [1, 2], "clock": "wall", "step_s": [1.8, 1.0],
                         "step_s_err": [0.018, 0.01]})
    laws = {row["what"]: row for row in derive.growth_laws(pd.concat([cpu, wall]))}
    assert laws["exponent"]["value"] == pytest.approx(1.1, rel=1e-9)
    assert laws["two threads"]["value"] == pytest.approx(1.8)
    assert laws["two threads"]["value_err"] == pytest.approx(1.8*0.01*2**0.5, rel=1e-9)
    said = verdicts(Tables({"growth_laws": pd.DataFrame(laws.values())}))
    assert said["own-speed-growth-spam"][0] == "undecidable"        # a hundred thousand particles of a million
    assert said["own-speed-threads-spam"][0] == "holds"             # 1.8 +- 0.025 against 1.7
    assert figures.growth(pd.concat([cpu, wall])).axes[0].get_xscale() == "log"


def test_the_figure_has_a_line_a_method_with_errors_in_both_directions():
    pages = figures.ERRORS(lines({names.GRID: 1.0, names.LATTICE: 3.0}))
    axes = pages["work_precision"].axes[0]
    assert axes.get_legend_handles_labels()[1] == [names.GRID, names.LATTICE]
    assert all(drawn.has_xerr and drawn.has_yerr for drawn in axes.containers)
    assert set(pages) == {"work_precision", "memory"}


def test_every_method_has_a_look_of_its_own():
    """Without colour, too; a family has one marker, which is its own."""
    looks = {name: {**figures.style(name), "color": ""} for name in names.ORDER}
    assert len({str(sorted(look.items(), key=str)) for look in looks.values()}) == len(looks)
    markers = {(names.family(name), look["marker"]) for name, look in looks.items()}
    assert len(markers) == len({marker for _, marker in markers}) == len(names.FAMILIES)


def test_a_failing_run_does_not_stretch_the_axis_but_is_told_by_its_number():
    pages = []
    for worst in (2.0, 9770.0):
        points = lines({names.GRID: 1.0})["points"]
        points.loc[points.index[0], "error"] = worst
        pages.append(figures.work_precision(points).axes[0])
    assert not pages[0].texts and pages[0].get_ylim()[1] < 10
    assert [text.get_text() for text in pages[1].texts] == ["9800"] and pages[1].get_ylim()[1] == 10


def test_memory_has_no_bars_that_say_nothing():
    axes = figures.ERRORS(lines({names.GRID: 1.0}))["memory"].axes[0]
    assert axes.lines and not axes.containers


def test_cases_have_names_of_their_own_and_all_of_them_time_themselves_alone():
    for size in ("quick", "paper"):
        all_cases = list(STUDY.cases(size))
        assert len({case.label for case in all_cases}) == len(all_cases) and all(case.alone for case in all_cases)


def test_every_contestant_runs_at_four_resolutions_or_more():
    ladders = {}
    for case in cases.cases("paper"):
        if isinstance(case, Race):
            ladders.setdefault((case.scene, case.method.name), set()).add(case.resolution)
    assert set(ladders) == {(scene, name) for scene, contest in cases.CONTESTS.items() for name in contest}
    assert {name for _, name in ladders} == set(names.ORDER) and min(map(len, ladders.values())) >= 4


def test_all_cases_together_take_what_was_planned():
    seconds = [case.cost for case in cases.cases("paper")]
    assert sum(seconds) < cases.TOGETHER and max(seconds) < cases.DEAREST


def test_growth_has_a_row_for_each_size_clock_and_number_of_threads():
    """224 rows are timed by both clocks: no two rows of the table have the same key."""
    keys = [(case.name, case.points, threads, "wall" if isinstance(case, Threads) else "cpu")
            for case in cases.cases("paper") if isinstance(case, Growth)
            for threads in ((1, 2) if isinstance(case, Threads) else (1,))]
    assert len(set(keys)) == len(keys) == 2*13 + 2*2*2      # sizes; and at two of them one and two threads
    for method in (names.LUCY, names.LATTICE):
        points = [number for name, number, *_ in keys if name == method]
        assert min(points) < 1000 < 0.95e6 < max(points)


def test_moving_points_reach_one_percent():
    """Of size paper: a rung on either side of 1 % in K, whose error falls as rows^-2.1 from 3.2 % at 24."""
    rows = [case.resolution for case in cases.cases("paper") if isinstance(case, Race)
            and (case.scene, case.method.name) == ("convection", names.MOVING)]
    assert 0.032*(24/rows[-2])**2.1 > 0.01 > 0.032*(24/rows[-1])**2.1
