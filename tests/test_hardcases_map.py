"""The map of hard cases: exact numbers, what counts as flow, and the rules that name an outcome."""
import numpy as np
import pandas as pd
import pytest
from scipy.integrate import quad

from studies.hardcases.claims import MAP, SQUARES
from studies.hardcases.derive import derive
from studies.hardcases.figures import figures
from studies.hardcases.grids import Going, OnTorus
from studies.hardcases.methods import TAKES, Body, flow, kinetic
from studies.hardcases.points import amplitude
from studies.hardcases.scenes import BEGIN, BOXES, LAYERS, SOUND, ShearFlow, Strip, U, Vortex, fastest
from studies.hardcases.square import Neighbours
from studies.kit.claim import judged
from studies.kit.table import Tables


def test_two_rarefactions_have_the_kinetic_energy_that_is_told():
    rho, u = lambda s: (2 - s/SOUND)**2/9, lambda s: 2*(SOUND + s)/3      # of s = x/t, the fan of gamma = 2
    per_time, _ = quad(lambda s: rho(s)*u(s)**2/2, -SOUND, 2*SOUND)
    mass, _ = quad(rho, -SOUND, 2*SOUND)
    assert Strip().kinetic(2.0) == pytest.approx(per_time*2.0/Strip().L)
    assert mass == pytest.approx(SOUND)        # what the fan has came from where the strip was
    with pytest.raises(ValueError, match="met"):
        Strip().kinetic(6.0)


def test_flow_is_what_is_alike_in_a_cell_and_noise_what_is_not():
    x = np.stack(np.meshgrid(np.arange(8) - 3.5, np.arange(8) - 3.5), axis=-1).reshape(-1, 2)
    even, odd = np.ones((64, 2)), (-1.0)**np.arange(64)[:, None]*np.ones((64, 2))
    box, m = (8.0, 8.0), np.ones(64)
    assert flow(Body(x, even, m), box) == pytest.approx(kinetic(Body(x, even, m)))
    assert flow(Body(x, odd, m), box) == pytest.approx(0, abs=1e-12)
    assert kinetic(Body(x, odd, m)) == pytest.approx(1.0)


def test_the_vortex_passes_through_no_wall_and_is_free_of_divergence():
    scene, y = Vortex(), np.linspace(-8, 8, 5)
    assert np.abs(scene.flow(np.full(2, 1.3), np.array([-8.0, 8.0]))[1]).max() < 1e-15
    d = 1e-5
    u, v = (scene.flow(2.0 + d, y)[0] - scene.flow(2.0 - d, y)[0]), (scene.flow(2.0, y + d)[1] - scene.flow(2.0, y - d)[1])
    assert np.abs(u + v).max() < 1e-14


@pytest.mark.parametrize("case", [*LAYERS, *BOXES])
def test_methods_start_with_the_flow_and_mass_of_the_scene(case):
    scene, _ = {**LAYERS, **BOXES}[case]
    name = next(iter(TAKES[case])) if case != "narrow weight" else "fixed h 2"
    built = TAKES[case][name](scene=scene)
    body = built.body(built.start)
    wanted = 16*8 if case == "vacuum" else scene.width*scene.L
    assert body.m.sum() == pytest.approx(wanted, rel=0.02) and built.dt > 0
    if case in LAYERS:
        assert kinetic(body) == pytest.approx(9/5000, rel=0.02)


def run(case="Ra 1e5", method="fixed lattice", rows=16, k=0.01, flow=0.01, mass_drift=0.0, k_start=0.01, flow_start=0.01,
        reached=1.0, refused=""):
    """A row of `hard_runs`."""
    return locals()


def outcome(**values) -> str:
    """Of one run beside a fine grid."""
    grids = [run(case=values.get("case", "Ra 1e5"), method="grid", rows=rows) for rows in (32, 48)]
    [row] = [row for row in derive(Tables(hard_runs=pd.DataFrame([run(**values), *grids])))["map"] if row["method"] != "grid"]
    return row["outcome"]


@pytest.mark.parametrize("values, wanted", [
    ({}, "right"), ({"flow": 0.0105}, "right"), ({"flow": 0.008}, "wrong"), ({"flow": 1e-4}, "freezes"),
    ({"reached": 0.7, "flow": np.nan}, "diverges"), ({"reached": 0.0, "refused": "ValueError: no"}, "refused"),
    ({"mass_drift": 0.02}, "leaks"), ({"case": "zero viscosity", "k": 0.02}, "wrong"), ({"case": "zero viscosity"}, "right"),
    ({"case": "wall corner", "k": 1e-3}, "wrong"), ({"case": "wall corner", "k": 1e-8}, "right")])
def test_outcomes_follow_their_rules(values, wanted):
    assert outcome(**values) == wanted


def of_tube(L: int, reached: float = 1.0, wiggles: float = 0.01, v_exact: float = 0.02, step: float = 0.5) -> dict:
    """A row of `method_tubes` without viscosity."""
    return {"method": "grid", "eta": 0.0, "L": L, "seed": 1, "v_grid": np.nan, **locals()}


@pytest.mark.parametrize("rows, wanted, number", [
    ([of_tube(24, wiggles=0.9), of_tube(96)], "right", "ringing of v"),
    ([of_tube(24), of_tube(96, wiggles=0.3)], "wrong", "ringing of v"), ([of_tube(96, v_exact=0.2)], "wrong", "ringing of v"),
    ([of_tube(24, reached=0.4), of_tube(96)], "diverges", "part of the time"),
    ([of_tube(24), of_tube(24, reached=0.1, step=0.125)], "right", "ringing of v")])
def test_tubes_on_the_map_ring_are_off_or_end(rows, wanted, number):
    [row] = derive(Tables(method_tubes=pd.DataFrame(rows)))["map"]
    assert row["outcome"] == wanted and row["number"] == number


@pytest.mark.parametrize("measured, err, wanted", [(0.97, 0.01, "right"), (1.02, 0.11, "unjudged"), (0.81, 0.05, "wrong")])
def test_a_rate_that_is_not_known_well_is_not_judged(measured, err, wanted):
    row = {"method": "grid", "predicted": 1.0, "measured": measured, "measured_err": err, "reached": 1.0}
    assert derive(Tables(shear=pd.DataFrame([row])))["map"][0]["outcome"] == wanted


def test_the_grid_goes_round_a_box_without_plates():
    """A piece of a turn keeps mass and energy; a vacuum, even of a thousandth, ends the run."""
    going = Going(BOXES["zero viscosity"][0])
    bodies: list = []
    assert going.go(8.0, 2, lambda sums, S: bodies.append(going.built.body(S)), lambda done: None) == 1.0
    assert [len(body.m) for body in bodies] == [256, 256] and bodies[-1].m.sum() == pytest.approx(256, rel=1e-14)
    # the start has no pressure of its vortex: sound takes the square of the Mach number 0.07
    assert kinetic(bodies[-1]) == pytest.approx(kinetic(going.built.body(going.first)), rel=0.005)
    assert OnTorus(case="vacuum").run(lambda done: None, None).rows["hard_runs"][0]["reached"] < 1


def judged_grid(flows: dict[int, float]) -> dict:
    """The map's row of the grid of 16 rows, from flows of grids by rows."""
    rows = [run(method="grid", rows=number, flow=flow_, reached=1.0 if flow_ > 0 else 0.9) for number, flow_ in flows.items()]
    [row] = derive(Tables(hard_runs=pd.DataFrame(rows)))["map"]
    return row


def test_a_grid_is_not_held_against_itself():
    """With two grids the coarser one would be off by its own error, and right whatever its flow."""
    for wrong in (0.01, 0.02, 0.2):
        row = judged_grid({16: wrong, 32: 0.01, 48: np.nan})
        assert row["outcome"] == "unjudged" and np.isnan(row["measured"]) and np.isnan(row["measured_err"])
    row = judged_grid({16: 0.0105, 32: 0.0099, 48: 0.01})
    assert row["outcome"] == "right" and row["measured_err"] == pytest.approx(1.05*0.01)
    assert judged_grid({16: 0.02, 32: 0.0099, 48: 0.01})["outcome"] == "wrong"


def words(page) -> str:
    """All that is written on a page."""
    return "\n".join(text.get_text() for text in page.findobj(lambda one: hasattr(one, "get_text")))


def test_the_map_says_which_grid_it_is_held_against_what_was_not_judged_and_what_was_not_run():
    runs = [run(case="Prandtl 0.01"), *(run(case="Prandtl 0.01", method="grid", rows=rows) for rows in (16, 32)),
            run(case="Prandtl 0.01", method="grid", rows=48, flow=np.nan, reached=0.9)]
    tables = Tables(hard_runs=pd.DataFrame(runs))
    tables["map"] = pd.DataFrame(derive(tables)["map"])
    said = words(figures(tables)["map"])
    assert "grid of 32" in said and "?: not judged" in said and "empty: not run" in said and "Which method" in said


@pytest.mark.parametrize("swing, before, verdict", [(0.0026, 0.0433, "undecidable"), (0.06, 0.05, "holds"),
                                                    (0.0026, 0.0036, "fails"), (0.06, 0.001, "undecidable")])
def test_a_swing_is_as_uncertain_as_the_quarter_before_says(swing, before, verdict):
    rows = pd.DataFrame([{"ra": 3.5e5, "rows": 16, "swing": swing, "before": before, "reached": 1.0}])
    row = judged({claim.id: claim for claim in MAP}["map-grid-fluctuates"], Tables(steadiness=rows))
    assert row["verdict"] == verdict and row["err"] == pytest.approx(abs(swing - before))


def test_claims_of_the_map_can_fail():
    claims = {claim.id: claim for claim in MAP}
    for flow_, verdict in ((0.0100, "holds"), (0.0050, "fails")):
        case = "high pressure"
        rows = [run(case=case, flow=flow_), *(run(case=case, method="grid", rows=rows) for rows in (32, 48))]
        tables = Tables(hard_runs=pd.DataFrame(rows))
        tables["map"] = pd.DataFrame(derive(tables)["map"])
        assert judged(claims["map-high-pressure-fixed-lattice"], tables)["verdict"] == verdict


def test_the_growth_of_a_wave_on_a_shear_flow_follows_from_its_own_equation():
    """At long waves Kolmogorov's flow grows at k_x U/sqrt 2; short ones, k_x >= k, do not."""
    assert fastest(1.0, 1e-3).rate == pytest.approx(1e-3*U/2**0.5, rel=1e-3)
    assert fastest(1.0, 1.01).rate == pytest.approx(0, abs=1e-9)


def test_the_shear_flow_has_its_wave_and_no_divergence():
    scene, d = ShearFlow(), 1e-5
    x, y = np.random.default_rng(1).uniform(-8, 8, (2, 20))
    div = scene.flow(x + d, y)[0] - scene.flow(x - d, y)[0] + scene.flow(x, y + d)[1] - scene.flow(x, y - d)[1]
    assert np.abs(div/(2*d)).max() < 1e-9
    place = np.stack(np.meshgrid(np.arange(32) - 15.5, np.arange(16) - 7.5), axis=-1).reshape(-1, 2)
    body = Body(place, np.stack(scene.flow(*place.T), axis=1), np.ones(512))
    assert amplitude(body, scene.k/2) == pytest.approx(BEGIN*U/2, rel=1e-6)  # half, being real; harmonic 16 aliases


# --- the square of Fig. 10 ----------------------------------------------------------------------------------------------


@pytest.mark.parametrize("flow, rolls, verdict", [(0.02, 1, "holds"), (0.02, 2, "fails"), (0.0003, 2, "undecidable"),
                                                  (0.0003, 1, "undecidable")])
def test_rolls_of_a_flow_that_has_stopped_are_not_counted(flow, rolls, verdict):
    squares = pd.DataFrame([{"eos": "IdealGas", "weight": "Monaghan", "ra": 1e4, "begun": 0.03, "flow": flow, "rolls": rolls,
                             "shared": 0.92}])
    row = judged({claim.id: claim for claim in SQUARES}["khp95-hard-fig10-one-roll"], Tables(squares=squares))
    assert row["verdict"] == verdict and ("stopped" in row["reason"]) == (verdict == "undecidable")


def test_pairs_are_told_from_single_particles():
    x = np.stack(np.meshgrid(np.arange(50) - 24.5, np.arange(50) - 24.5), axis=-1).reshape(-1, 2)
    alone, twice = Neighbours.of(x, len(x)), Neighbours.of(np.concatenate([x, x + 0.01]), 2*len(x))
    assert alone.ratio.value == pytest.approx(1.0) and alone.shared == 0
    assert twice.ratio.value > 50 and twice.shared == 1
