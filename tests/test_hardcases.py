"""The study hardcases: freezing, molecules, a small run of all, what the committed tables must say."""
from dataclasses import replace

import numpy as np
import pandas as pd
import pytest

import studies.hardcases as hardcases
from continuum.fluid import IdealGas, pressure
from particles.smooth.spam import Spam
from particles.threads import Team
from particles.weights import Lucy, Monaghan
from studies.build.spam import start
from studies.hardcases.interface.runs import Interface
from studies.hardcases.tube.spam import ShockTube
from studies.kit.claim import judge, judged
from studies.kit.sweep import RESULTS, load
from studies.kit.table import Tables, read
from studies.lattices import cases as khp95
from studies.lattices import derive as hard_derive
from studies.lattices import tables as hard_tables
from studies.lattices.figures import figures
from studies.lattices.freezing import Freezing, lindemann, neighbours
from studies.lattices.molecules import METHODS, RHO_SQUARED, Newton, Reversal, Twins, crowd, molecules
from studies.lattices.waves import lattice

BY_ID = {claim.id: claim for claim in khp95.PART.claims}


def rows(case, table):
    return case.run(lambda done: None, None).rows[table]


# --- freezing -----------------------------------------------------------------------------------------------------------


def test_neighbours_are_the_six_of_a_lattice_partners_left_out():
    at = lattice("hexagonal", (8, 5))
    i, j = neighbours(at.x, at.box[0])
    inner = np.abs(at.x[i, 1]) < at.box[1]/2 - 2
    apart = at.x[i] - at.x[j]
    apart[:, 0] -= at.box[0]*np.round(apart[:, 0]/at.box[0])
    assert (np.bincount(i) == 6).all() and np.hypot(*apart[inner].T) == pytest.approx(1.0745699, rel=1e-6)
    i, j = neighbours(np.concatenate([at.x, at.x + 0.01]), at.box[0])
    assert (np.abs(i - j) != len(at.x)).all()


def test_lindemann_ratio_of_particles_that_shake():
    """Independent shakes s of both partners along one line make distances fluctuate by sqrt 2 s times the cosine."""
    at, rng = lattice("hexagonal", (14, 8)), np.random.default_rng(1)
    places = at.x + 0.02*rng.standard_normal((200, *at.x.shape))
    assert lindemann(places, at.box[0]) == pytest.approx(np.sqrt(2)*0.02/1.0746, rel=0.1)      # ends have farther neighbours
    assert lindemann(np.repeat(at.x[None], 3, axis=0), at.box[0]) < 1e-15


def test_layers_tell_what_stays_from_what_goes():
    """The upper half goes on by a spacing along x, over the periodic side; the lower one stays."""
    case, at = Freezing(eos=IdealGas(), weight=Lucy), start(Freezing(eos=IdealGas(), weight=Lucy).scene, 1)
    way = np.where(at[1] > 0, 1.0, 0.0)
    places = np.stack([at[:2].T + step*np.stack([way, 0*way], axis=1) for step in (0.0, 0.5, 1.0)])
    found = case._layers(places, np.array([*at[:2], way, 0*way, at[4]]), K=0.5)
    assert [row["stuck"] for row in found] == [1, 1, 0, 0] and [row["kp"] for row in found] == [0, 0, 1, 1]
    assert found[0]["T"] > 1 > found[-1]["T"]
    assert found[0]["lindemann"] < 1e-12 and found[1]["lindemann"] > 0.05       # at mid-height neighbours part


def test_criteria_are_the_printed_inequalities():
    """By hand for Lucy: w(0) = 5/(9 pi), w(0.9) - w(1) = 0.010452."""
    found = Freezing(eos=IdealGas(), weight=Lucy)._criteria(0.002)
    assert found["barrier"]*2*5/(9*np.pi) == pytest.approx(2*0.002, rel=1e-12)
    assert found["melting"]*2*0.010452 == pytest.approx(2*0.002, rel=1e-3)


# --- molecules ----------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("weight", [Lucy, Monaghan])
def test_pressure_of_the_square_of_the_density_makes_molecules(weight):
    state = crowd(8, 3)
    method = molecules(Spam, weight.of(h=3.0), 8.0)
    kernel, ids = method.start(64, Team(1)), np.arange(64)
    ordered, out, expected = state.copy(), np.empty_like(state), np.empty_like(state)
    kernel.around.relist(ordered, ids, 0.0)
    kernel.rates(ordered, out)
    Newton(weight.of(h=3.0), 8.0).rates(state, expected)
    np.testing.assert_allclose(out[:4, np.argsort(ids)], expected[:4], atol=1e-13)
    assert pressure(RHO_SQUARED, 1.7, 900.0) == 1.7**2


def test_paths_come_back_as_their_steps_let_them():
    found = {name: rows(Reversal(integrator=name, weight=Lucy, times=(3.0,), side=8), "reversal")[0] for name in METHODS}
    assert found["whole numbers"]["equal"] == 1 and found["whole numbers"]["apart"] == 0
    assert 0 < found["leapfrog"]["apart"] < 1e-13 and found["leapfrog"]["equal"] < 1
    assert 1e-6 < found["rk4"]["apart"] < 0.1


def test_twins_stay_together_for_a_while():
    row = rows(Twins(weight=Lucy, every=1.0, samples=1), "twins")[0]
    assert 0 < row["apart"] < 1e-14


def test_time_of_return_is_read_off_the_distances():
    t = np.arange(10.0, 101, 10)
    twins = pd.DataFrame({"weight": "Lucy", "seed": 1, "time": t, "apart": 1e-16*np.exp(0.4*t)})
    back = pd.DataFrame({"integrator": "leapfrog", "weight": "Lucy", "seed": 1, "time": t, "apart": 2.0**-52*np.exp(0.4*t)})
    row = next(hard_derive.returns(twins, back))
    assert row["rate"] == pytest.approx(0.4) and row["measured"] == pytest.approx(row["predicted"])


# --- claims -------------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("flow, rolls, verdict", [(0.02, 1, "holds"), (0.02, 2, "fails"), (0.0003, 2, "undecidable"),
                                                  (0.0003, 1, "undecidable")])
def test_rolls_of_a_flow_that_has_stopped_are_not_counted(flow, rolls, verdict):
    squares = pd.DataFrame([{"eos": "IdealGas", "weight": "Monaghan", "ra": 1e4, "begun": 0.03, "flow": flow, "rolls": rolls,
                             "shared": 0.92}])
    row = judged(BY_ID["khp95-hard-fig10-one-roll"], Tables(squares=squares))
    assert row["verdict"] == verdict and ("stopped" in row["reason"]) == (verdict == "undecidable")


def layers(stuck: float, step: float = 1.0) -> pd.DataFrame:
    """Rows of `freezing_layers` at Ra 10 000."""
    of = {"eos": "IdealGas", "weight": "Lucy", "ra": 1e4, "step": step, "stuck": stuck}
    return pd.DataFrame([{**of, "P": P} for P in (1.4, 5.2)])


def test_what_freezes_with_a_quarter_of_the_step_is_not_what_is_said_of_the_whole():
    claim = BY_ID["khp95-hard-freezing-nowhere"]
    for stuck, verdict in ((0.1, "holds"), (0.9, "fails")):
        both = pd.concat([layers(stuck), layers(0.9, step=0.25)])
        assert judged(claim, Tables(freezing_layers=both))["verdict"] == verdict


@pytest.mark.skipif(not (RESULTS/"hardcases"/"freezing_layers.csv").exists(), reason="no tables are committed yet")
def test_words_tell_the_pressures_that_were_run():
    rows = load(hard_tables.ALL, "hardcases")["freezing_layers"]
    P = rows[(rows["ra"] == 1e4) & (rows["step"] == 1) & (rows["eos"] == "IdealGas") & (rows["weight"] == "Lucy")]["P"]
    assert f"runs come through, {P.min():.1f} to {P.max():.1f}," in BY_ID["khp95-hard-freezing-nowhere"].statement


# --- the study ----------------------------------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def small(tmp_path_factory):
    """The study with a few short cases."""
    out = tmp_path_factory.mktemp("results")
    cases = [*list(khp95.moduli(0.2))[::4], *khp95.newton((2.0,), 1, (1,)),
             *(ShockTube(L=L, eta=0.5, keep=L == 9) for L in (9.0, 12.0, 15.0)), Interface(scale=0.4)]
    study = replace(hardcases.STUDY, cases=lambda size: [replace(c, side=8) if isinstance(c, Reversal) else c for c in cases])
    return study, study.run("quick", workers=1, out=out), out


def test_small_study_writes_tables_figures_and_verdicts(small):
    study, found, out = small
    assert len(found["moduli"]) and len(found["modulus_orders"]) and len(found["tube_orders"]) == 3
    assert {path.stem for path in study.draw(out)} == {"map", "moduli", "reversal", "shocks"}
    verdicts = {row["id"]: row["verdict"] for row in study.judge(out)}
    assert verdicts["khp95-hard-modulus-summed"] == verdicts["khp95-hard-reversal"] == "holds"
    assert verdicts["khp95-hard-freezing-melting-lucy"] == "undecidable"


def test_without_tables_nothing_is_decided():
    for row in judge(khp95.PART.claims, Tables(), "hardcases"):
        assert row["verdict"] == "undecidable" and len(row["reason"]) > 20, row["id"]


def crossed(page) -> list[str]:
    """Axes whose legend lies on a line."""
    page.canvas.draw()
    legends = [(axes, axes.get_legend().get_window_extent()) for axes in page.axes if axes.get_legend()]
    return [axes.get_title() for axes, box in legends for line in axes.lines
            if line.get_transform().transform_path(line.get_path()).intersects_bbox(box, filled=False)]


@pytest.mark.skipif(not (RESULTS/"hardcases"/"moduli.csv").exists(), reason="no tables are committed yet")
def test_no_legend_lies_on_a_line_and_weights_are_not_told_by_colour_alone():
    pages = figures(load(hard_tables.ALL, "hardcases"))
    assert all(crossed(pages[name]) == [] and pages[name].legends for name in ("moduli", "pairs", "reversal"))
    assert [axes.get_ylabel().split("\n")[0] for axes in pages["moduli"].axes[::3]] == ["Lucy", "Monaghan", "Wendland C2"]
    pages["reversal"].axes[0].legend(loc="center right")        # where it was
    assert crossed(pages["reversal"])


@pytest.mark.skipif(not (RESULTS/"hardcases"/"moduli.csv").exists(), reason="no tables are committed yet")
def test_committed_verdicts_and_figures_follow_from_committed_tables():
    tables = load(hard_tables.ALL, "hardcases")
    found = {row["id"]: row["verdict"] for row in judge(khp95.PART.claims, tables, "hardcases")}
    kept = read(RESULTS/"claims.csv")
    kept = kept[kept["study"] == "hardcases"].set_index("id")["verdict"]
    assert {name: kept[name] for name in found} == found
    assert set(figures(tables)) <= {path.stem for path in (RESULTS/"hardcases").glob("*.png")}
