"""The study speed: what is derived, figures and verdicts on tables, cases, what is committed."""
import numpy as np
import pandas as pd
import pytest

import studies.cost.cases as speed
from studies.cost import derive as speed_derive
from studies.cost import figures as speed_figures
from studies.cost import names as speed_names
from studies.cost import tables as speed_tables
from studies.cost.claims import CLAIMS, of_level, seconds
from studies.cost.plan import planned
from studies.cost.problem import Race
from studies.kit.claim import CannotTell, judge
from studies.kit.sweep import RESULTS, load
from studies.kit.table import Tables, read


def lines(scale: dict[str, float], scene="convection", quantity="K", err=1e-6) -> Tables:
    """Methods with errors n^-2 and seconds scale n^3, n = 4, 8, 16, 24, as errors and runs."""
    key = {"scene": scene, "seed": 1}
    sizes = (4, 8, 16, 24)
    errors = [{**key, "method": name, "resolution": n, "quantity": quantity, "error": n**-2.0, "error_err": err, "share": 0.5}
              for name in scale for n in sizes]
    runs = [{**key, "method": name, "resolution": n, "points": n**2, "run_s": 2*factor*n**3, "run_s_err": 1e-3*factor*n**3,
             "setup_s": 0.0, "setup_s_err": 0.0, "bytes": 8.0*n**2} for name, factor in scale.items() for n in sizes]
    repeats = [{name: row[name] for name in speed_tables.RUN} | {"early_s": row["run_s"], "late_s": row["run_s"]} for row in runs]
    found = Tables({"errors": pd.DataFrame(errors), "runs": pd.DataFrame(runs), "repeats": pd.DataFrame(repeats)})
    return Tables(found | {name: pd.DataFrame(rows) for name, rows in speed_derive.derive(found).items() if rows})


def test_cost_at_a_level_and_exponent_are_those_of_the_power_law():
    found = lines({speed_names.GRID: 1.0, speed_names.LATTICE: 3.0})
    row = found["needed"].query(f"method == '{speed_names.GRID}' and level == 0.01").iloc[0]
    assert row["reached"] == "yes" and row["cpu_s"] == pytest.approx(1000, rel=1e-9)       # n = 10
    assert row["low"] < 1000 < row["high"] and row["points"] == pytest.approx(100, rel=1e-9)
    assert found["exponents"]["exponent"].to_numpy() == pytest.approx([1.5, 1.5], rel=1e-9)
    best = found["cheapest"].set_index("level")
    assert best.loc[0.01, "method"] == speed_names.GRID and best.loc[0.001, "method"] == "not reached"
    assert best.loc[0.1, "reached"] == "at most"        # n = 4 has 6 % already


def test_errors_that_come_back_above_a_level_have_not_reached_it():
    group = pd.DataFrame({"resolution": [1, 2, 3, 4], "error": [0.2, 0.005, 0.02, 0.004], "error_err": [1e-5]*4,
                          "cpu_s": [1.0, 2, 4, 8], "cpu_s_err": [0.1]*4, "points": [1.0, 2, 3, 4]})
    assert 4 < speed_derive.reached(group, 0.01)["cpu_s"] < 8
    assert speed_derive.reached(group.iloc[:3], 0.01)["reached"] == "no"
    crossing = group.iloc[:2].assign(error_err=[1e-5, 0.05])        # an error of either sign: 0.5 % +- 5 %
    assert speed_derive.reached(crossing, 0.01)["reached"] == "no"


def test_the_interval_of_an_error_holds_what_half_of_the_chosen_step_changes():
    tables = lines({"grid": 1.0})
    found, rung = tables["errors"], tables["errors"][[*speed_tables.RUN, "quantity"]]
    steps = pd.concat([rung.assign(of_limit=0.9, time_error=7.0, accepted=0),
                       rung.assign(of_limit=0.45, time_error=3e-3, accepted=1)])
    given = speed_derive.with_steps(found.assign(error_err=4e-3), steps)
    assert given["error_err"].to_numpy() == pytest.approx(5e-3) and given["error"].equals(found["error"])
    assert list(given) == list(found)
    assert speed_derive.with_steps(found, pd.DataFrame()).equals(found)


def test_the_interval_of_a_crossing_is_that_of_random_errors():
    error, err, cost, cost_err = np.array([0.04, 0.005]), np.array([2e-3, 4e-4]), np.array([1.0, 9.0]), np.array([0.05, 0.6])
    value, half = speed_derive.crossing(error, err, cost, cost_err, 0.01)
    rng = np.random.default_rng(1)
    some = [speed_derive.crossing(rng.normal(error, err/1.96), err, rng.normal(cost, cost_err/1.96), cost_err, 0.01)[0]
            for _ in range(4000)]
    assert np.std(np.log(some))*1.96 == pytest.approx(half, rel=0.08)     # 2 % of statistics, second order for the rest
    assert np.median(some) == pytest.approx(value, rel=0.02)


def test_verdicts_follow_the_lines():
    said = {row["id"]: (row["verdict"], row["measured"]) for row in judge(
        CLAIMS, lines({speed_names.GRID: 1.0, speed_names.LATTICE: 1.5, speed_names.MOVING: 40.0}), "speed")}
    assert said["own-speed-fixed-points"] == ("holds", pytest.approx(1.5))
    assert said["own-speed-moving-points"] == ("fails", pytest.approx(40))
    assert said["own-speed-exponent-grid"][0] == "holds" and said["own-speed-threads-spam"][0] == "undecidable"


def test_a_repeat_that_crosses_a_limit_moves_a_verdict():
    """1.5 times the grid's seconds against a limit of 2: the last repeats of all took as much longer, so nothing moves."""
    def said(late):
        tables = lines({speed_names.GRID: 1.0, speed_names.LATTICE: 1.5})
        slow = tables["repeats"]["method"] == speed_names.LATTICE
        tables["repeats"].loc[slow, "late_s"] *= late
        row, = (row for row in judge(CLAIMS, tables, "speed") if row["id"] == "own-speed-repeat")
        return row["verdict"], row["measured"]
    assert said(1.0) == ("holds", 0) and said(2.0) == ("fails", 2)     # fixed points, and the lattice among them


def test_memory_is_that_of_the_finest_run():
    found, = (row for row in lines({speed_names.GRID: 1.0})["memory"].to_dict("records"))
    assert (found["resolution"], found["points"], found["bytes_a_point"]) == (24, 576, 8)


def test_particles_are_compared_with_the_grid_of_the_same_error():
    found = lines({speed_names.GRID: 1.0, speed_names.LUCY: 20.0})
    value = of_level(found, speed_names.GRID, speed_names.LUCY, "cpu_s", scene="convection", quantity="K")
    assert value.value == pytest.approx(20)
    with pytest.raises(CannotTell, match="both sides"):
        seconds(found, speed_names.GRID, 0.001, scene="convection", quantity="K")


def test_growth_laws_are_those_of_the_table():
    n = np.array([1e3, 1e4, 1e5])
    cpu = pd.DataFrame({"method": speed_names.LUCY, "points": n, "threads": 1, "clock": "cpu", "step_s": n**1.1,
                        "step_s_err": 0.0, "early_s": n**1.1, "late_s": n**1.1})
    wall = pd.DataFrame({"method": speed_names.LUCY, "points": 1e5, "threads": [1, 2], "clock": "wall", "step_s": [1.8, 1.0],
                         "step_s_err": [0.018, 0.01], "early_s": [1.8, 1.0], "late_s": [1.8, 1.0]})
    found = {row["what"]: row for row in speed_derive.growth_laws(pd.concat([cpu, wall]))}
    assert found["exponent"]["value"] == pytest.approx(1.1, rel=1e-9)
    assert found["two threads"]["value"] == pytest.approx(1.8)
    assert found["two threads"]["value_err"] == pytest.approx(1.8*0.01*2**0.5, rel=1e-9)
    verdicts = {row["id"]: row for row in judge(CLAIMS, Tables({"growth_laws": pd.DataFrame(found.values())}), "speed")}
    assert verdicts["own-speed-growth-spam"]["reason"].startswith("100000 particles at most")     # of a million
    assert verdicts["own-speed-threads-spam"]["verdict"] == "holds"         # 1.8 +- 0.025 against 1.7
    assert speed_figures.growth(pd.concat([cpu, wall]).assign(bytes=1.0)).axes[0].get_xscale() == "log"


def test_the_figure_has_a_line_a_method_with_errors_in_both_directions():
    pages = speed_figures.figures(lines({speed_names.GRID: 1.0, speed_names.LATTICE: 3.0}))
    axes = pages["work_precision"].axes[0]
    assert axes.get_legend_handles_labels()[1] == [speed_names.GRID, speed_names.LATTICE]
    assert all(drawn.has_xerr and drawn.has_yerr for drawn in axes.containers)
    assert set(pages) == {"work_precision", "memory"}


def test_every_method_has_a_look_of_its_own():
    """Without colour, too; a family has one marker, which is its own."""
    looks = {name: {**speed_figures.style(name), "color": ""} for name in speed_names.ORDER}
    assert len({str(sorted(look.items(), key=str)) for look in looks.values()}) == len(looks)
    markers = {(speed_names.family(name), look["marker"]) for name, look in looks.items()}
    assert len(markers) == len({marker for _, marker in markers}) == len(speed_names.FAMILIES)


def test_a_failing_run_does_not_stretch_the_axis_but_is_told_by_its_number():
    pages = []
    for worst in (2.0, 9770.0):
        points = lines({speed_names.GRID: 1.0})["points"]
        points.loc[points.index[0], "error"] = worst
        pages.append(speed_figures.work_precision(points).axes[0])
    assert not pages[0].texts and pages[0].get_ylim()[1] < 10
    assert [text.get_text() for text in pages[1].texts] == ["9800"] and pages[1].get_ylim()[1] == 10


def test_memory_has_no_bars_that_say_nothing():
    axes = speed_figures.figures(lines({speed_names.GRID: 1.0}))["memory"].axes[0]
    assert axes.lines and not axes.containers


def test_without_tables_nothing_is_decided_or_drawn():
    assert {row["verdict"] for row in judge(CLAIMS, Tables(), "speed")} == {"undecidable"}
    assert speed_figures.figures(Tables()) == {} and speed_derive.derive(Tables()) == {"growth_laws": []}


@pytest.mark.parametrize("size", ["quick", "paper"])
def test_cases_have_names_of_their_own_and_all_of_them_time_themselves_alone(size):
    cases = speed.cases(size)
    assert len({case.label for case in cases}) == len(cases)
    assert all(case.alone for case in cases)
    methods = {(case.scene, case.method.name) for case in cases if isinstance(case, Race)}
    assert {name for _, name in methods} <= set(speed_names.ORDER)
    if size == "paper":
        for scene, name in methods:
            assert sum(case.scene == scene and case.method.name == name and case.seed == 1 for case in cases
                       if isinstance(case, Race)) >= 4


def test_all_cases_together_take_what_was_planned():
    plan = planned(speed.cases("paper"))
    assert plan["seconds"].sum() < speed.TOGETHER and plan["seconds"].max() < speed.DEAREST


@pytest.mark.skipif(not (RESULTS/"speed"/"points.csv").exists(), reason="no tables are committed yet")
def test_committed_verdicts_follow_from_committed_tables():
    found = judge(CLAIMS, load(speed_tables.ALL, "speed"), "speed")
    kept = read(RESULTS/"claims.csv")
    kept = kept[kept["study"] == "speed"]
    assert dict(zip(kept["id"], kept["verdict"], strict=True)) == {row["id"]: row["verdict"] for row in found}
