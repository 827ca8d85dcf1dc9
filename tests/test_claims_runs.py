"""Claims on what happens to runs: divergence, plates and walls, fluctuations, freezing."""
import math

import numpy as np
import pandas as pd
import pytest

from studies.kit.table import Tables
from studies.rb import snapshots
from studies.rb.tables import grid, particles
from tests.claim_tables import crystal, grids, judged, means, seeds, straight, verdict


def test_a_run_that_diverged_has_no_energy():
    """Its row is in kinetic_energy, without numbers; means leaves it out."""
    rows = grids() + [{**particles(1e4), "ke": 0.0048, "ke_err": 1e-7}]
    lost = pd.DataFrame([{**particles(ra), "seed": 1, "ke": math.nan, "t_end": 12.0, "rolls": 0}
                         for ra in (1e4, 1e5)])
    tables = Tables({**means(rows), "kinetic_energy": lost})
    assert "diverged" in judged("khp95-energy-error-10000", tables)["reason"]
    assert verdict("khp95-robust", tables) == "fails"
    none = Tables({**tables, "kinetic_energy": lost[:0]})
    assert "not run yet" in judged("khp95-robust", none)["reason"]
    paper = lost.assign(**grid(1e4, 48, "paper-form"), mass_drift=math.nan)
    assert "grid diverged" in judged("khp95-ghost-density-mass", Tables({"kinetic_energy": paper}))["reason"]


@pytest.mark.parametrize(("rolls", "steady", "ke", "said"), [
    (1, False, 1e-3, "holds"), (2, True, 1e-3, "fails"), (2, False, 1e-3, "undecidable"),
    (2, True, 1e-13, "undecidable"),
    (1, True, 1e-13, "undecidable")])
def test_two_rolls_that_still_change_or_have_died_are_no_answer(rolls, steady, ke, said):
    row = {**grid(7e3, 32, "two-rolls", sides="walls"), "ke": ke, "rolls": rolls, "converged": steady,
           "t_end": 9000.0}
    found = judged("khp95-one-roll-square", Tables({"kinetic_energy": pd.DataFrame([row])}))
    assert found["verdict"] == said and ("died" in found["reason"]) == (ke < 1e-6)


def test_what_smoothing_takes_is_told_from_what_is_lost():
    """The weight leaves 0.9 of K, the field has 0.8: half of the loss is smoothing, 1/9 is left."""
    tables = means(grids() + [{**particles(5e3), "ke": 0.8*0.0034, "ke_err": 1e-8}], kept=0.9)
    assert judged("own-smoothed-5000", tables)["measured"] == pytest.approx(1/9)
    assert judged("own-smoothing-share-5000", tables)["measured"] == pytest.approx(0.5)


def walled(reflections: int, variant: str = "printed-fixed-rows", fast: float = 0.5) -> Tables:
    """Two seeds, 1000 units of time, density 1 and T = 1 at both plates."""
    point = particles(1e4, variant=variant)
    layers = [{**point, "seed": seed, "plate": plate, "rho_layer": 1.0, "T_layer": 1.0,
               "reflections": reflections}
              for seed in (1, 2) for plate in ("lower", "upper")]
    runs = [{**point, "seed": seed, "ke": 0.004, "t_end": 1000.0} for seed in (1, 2)]
    ends = Tables(particles=crystal(1).assign(**point, vx=0.0, vy=fast, T=1.0))
    return Tables({"walls": pd.DataFrame(layers), "kinetic_energy": pd.DataFrame(runs),
                   "snapshots": pd.DataFrame(snapshots.snapshots(ends))})


def test_walls_are_needed_where_particles_reach_them():
    """Where none was turned back none would be lost; one that was may come back by itself."""
    assert verdict("khp95-walls-leakproof", walled(0)) == "fails"
    assert verdict("khp95-images-instead", walled(0, "printed")) == "holds"
    for name, variant in (("khp95-walls-leakproof", "printed-fixed-rows"),
                          ("khp95-images-instead", "printed")):
        found = judged(name, walled(3000, variant))
        assert found["verdict"] == "undecidable"
        assert "0.6 times a particle and run; but a turn is no loss" in found["reason"]


@pytest.mark.parametrize(("shares", "said"),
                         [((0.8, 0.7, 0.1), "holds"), ((0.8, 0.3, 0.1), "holds"), ((0.8, 0.3, 0.6), "")])
def test_the_pressure_that_freezes_is_found_between_two(shares, said):
    """K left at P = 1, 2, 5: the criterion's ratio is 2K/(2 P 0.01045)."""
    names = ("printed", "more-static-100", "more-static-400")
    rows = grids() + [{**particles(5e3, 50, name), "ke": share*0.0034, "ke_err": 1e-7}
                      for name, share in zip(names, shares, strict=True)]
    found = judged("khp95-melting-threshold", means(rows))
    if not said:
        assert "more than once" in found["reason"]
    else:
        ends = [0.0034/0.0104525/P for P in ((2, 5) if shares[1] > 0.5 else (1, 2))]
        assert min(ends) < found["measured"] < max(ends)


# --- what the start decides -----------------------------------------------------------------------


def started(weak: float, developed: float | None = None, settled: bool = True) -> Tables:
    """Particles at Ra 2500 that keep these shares of the grid's K, from weak rolls and from its flow."""
    shares = {"printed": weak} | ({} if developed is None else {"printed-from-flow": developed})
    points = [({**particles(2500, variant=name), "rolls": 2*(share > 0.1)}, share*straight(2500))
              for name, share in shares.items()] + [({**particles(1e4), "rolls": 2}, 0.8*straight(1e4))]
    runs = pd.concat([seeds(point, (0.99*ke, ke, 1.01*ke), rolls=point["rolls"],
                            converged=settled or point["variant"] == "printed") for point, ke in points])
    return Tables({**means(grids() + [{**point, "ke": ke, "ke_err": 0.01*ke} for point, ke in points]),
                   "kinetic_energy": runs})


@pytest.mark.parametrize(("weak", "developed", "said"), [
    (1e-4, None, "undecidable"), (1e-4, 0.8, "holds"), (0.8, 1e-4, "holds"), (1e-4, 1e-4, "fails"),
    (1e-4, 0.35, "fails")])
def test_flow_at_2500_is_judged_by_the_start_that_leaves_more(weak, developed, said):
    assert verdict("khp95-ra2500-flows", started(weak, developed)) == said


def test_fluctuations_are_those_of_the_flowing_state():
    """The same noise, 1e-4, over 0.2 of K at Ra 2500 and over 0.8 of it at Ra 10 000."""
    found = judged("khp95-ra2500-fluctuations", started(1e-4, 0.2))
    assert found["measured"] == pytest.approx(4*straight(1e4)/straight(2500),
                                              rel=1e-6) and found["verdict"] == "holds"
    assert verdict("khp95-ra2500-usable", started(1e-4, 0.2)) == "fails"
    assert "variant = printed-from-flow" in judged("khp95-ra2500-fluctuations", started(1e-4))["reason"]


# --- trajectories ---------------------------------------------------------------------------------


def test_what_bears_the_weight_is_no_correlation():
    rng = np.random.default_rng(1)
    a, b = rng.standard_normal((2, 4000, 2))
    weight = np.array([0.0, 5.0])
    assert snapshots.correlation(a + weight, a - weight) == pytest.approx(1.0)
    assert abs(snapshots.correlation(a + weight, b + weight)) < 4/math.sqrt(8000)
    assert snapshots.correlation(a + b, a) == pytest.approx(math.sqrt(0.5), abs=4/math.sqrt(8000))
